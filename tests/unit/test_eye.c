/* The eye and the view angle of synthetic cameras, whose directions come in 16 bits as the direction pass has them. */
#include "eye.h"

#include "gloss_support.h"

struct camera {
    double eye[3], right[3], up[3], forward[3]; /* unit vectors */
    double view_angle;                          /* 0: orthographic */
    double scale;                               /* of the visible things, in world units */
};

/* A right-handed frame that looks along (yaw, pitch). */
static struct camera camera_at(double x, double y, double z, double yaw, double pitch, double view_angle, double scale)
{
    return (struct camera){.eye = {x, y, z},
                           .right = {cos(yaw), 0, -sin(yaw)},
                           .up = {-sin(yaw) * sin(pitch), cos(pitch), -cos(yaw) * sin(pitch)},
                           .forward = {sin(yaw) * cos(pitch), sin(pitch), cos(yaw) * cos(pitch)},
                           .view_angle = view_angle,
                           .scale = scale};
}

/* What a 16-bit code of a direction's coordinate gives back. */
static double quantised(double q)
{
    return (round((0.5 + 0.499 * q) * 65535) / 65535 - 0.5) / 0.499;
}

/* Draws positions at bumpy distances of 2 to 4 times the scale, and the directions of all rays. */
static void draw(const struct camera *camera, int width, int height, struct gbuffer *gbuffer, struct image *directions)
{
    struct error err;
    gbuffer_alloc(gbuffer, width, height);
    assert_ok(image_alloc(directions, width, height, 3, &err), err);
    double side = camera->view_angle > 0 ? 2 * tan(camera->view_angle / 2) / width : 2 * camera->scale / width;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double u = (x + 0.5 - width / 2.0) * side, v = -(y + 0.5 - height / 2.0) * side, d[3], from[3], q[3];
            double length = 0, coded_length = 0, distance = camera->scale * (3 + sin(x * 0.31) * cos(y * 0.17));
            for (int i = 0; i < 3; i++) {
                double off = u * camera->right[i] + v * camera->up[i];
                d[i] = camera->forward[i] + (camera->view_angle > 0 ? off : 0);
                from[i] = camera->eye[i] + (camera->view_angle > 0 ? 0 : off);
                length += d[i] * d[i];
            }
            for (int i = 0; i < 3; i++) {
                d[i] /= sqrt(length);
                q[i] = quantised(d[i]);
                coded_length += q[i] * q[i];
            }
            for (int i = 0; i < 3; i++) {
                image_row(&gbuffer->position, i, y)[x] = (float)(from[i] + distance * d[i]);
                image_row(directions, i, y)[x] = (float)(q[i] / sqrt(coded_length));
            }
        }
}

static void release(struct gbuffer *gbuffer, struct image *directions)
{
    gbuffer_free(gbuffer);
    image_free(directions);
}

static void assert_eye(const struct camera *camera, const struct gbuffer *gbuffer, double tolerance)
{
    assert_true(gbuffer->has_eye);
    for (int i = 0; i < 3; i++)
        assert_near(gbuffer->eye[i], camera->eye[i], tolerance * 3 * camera->scale);
}

/* Nothing is glossy there, or the camera sees nothing there. */
static void erase(struct image *image, int x, int y)
{
    for (int i = 0; i < 3; i++)
        image_row(image, i, y)[x] = 0;
}

static void eye__perspective_cameras__found(void **state)
{
    (void)state;
    const struct camera cameras[] = {
        camera_at(0, 0, 0, 0, 0, 1.1, 1),
        camera_at(0.3, 2, -7, 0.4, -0.3, 0.73, 2),
        camera_at(-5000, 800, 3000, 2.5, -0.9, 1.4, 900),
        camera_at(1e-5, -2e-5, 4e-5, -1.2, 0.7, 1.0, 1e-5),
        camera_at(10, 10, 10, 3, 0.2, 2.4, 5),
        camera_at(1, 2, 3, 1, 0.5, 0.35, 1),
    };
    static const int sizes[][2] = {{320, 240}, {161, 121}, {128, 96}};
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++)
        for (size_t j = 0; j < sizeof sizes / sizeof *sizes; j++) {
            struct gbuffer gbuffer;
            struct image directions;
            draw(&cameras[i], sizes[j][0], sizes[j][1], &gbuffer, &directions);
            eye_find(&gbuffer, &directions);
            assert_eye(&cameras[i], &gbuffer, 1e-4);
            assert_near(gbuffer.view_angle, cameras[i].view_angle, 1e-4 * cameras[i].view_angle);
            release(&gbuffer, &directions);
        }
}

static void eye__positions_only_here_and_there__found(void **state)
{
    (void)state;
    struct camera camera = camera_at(0.3, 2, -7, 0.4, -0.3, 0.9, 2);
    struct gbuffer gbuffer;
    struct image directions;
    draw(&camera, 200, 150, &gbuffer, &directions);
    for (int y = 0; y < 150; y++)
        for (int x = 0; x < 200; x++)
            if (x < 120 || y < 90 || (x + y) % 3 == 0)
                erase(&gbuffer.position, x, y);
    eye_find(&gbuffer, &directions);
    assert_eye(&camera, &gbuffer, 1e-4);
    assert_near(gbuffer.view_angle, 0.9, 1e-4);
    release(&gbuffer, &directions);
}

/* A far wall must not outweigh what is near: its quantised directions miss the eye by more. */
static void eye__near_and_very_far_things__found(void **state)
{
    (void)state;
    struct camera camera = camera_at(0.3, 2, -7, 0.4, -0.3, 0.9, 1);
    struct gbuffer gbuffer;
    struct image directions;
    draw(&camera, 128, 96, &gbuffer, &directions);
    for (int y = 0; y < 48; y++)
        for (int x = 0; x < 128; x++)
            for (int i = 0; i < 3; i++) {
                float *position = &image_row(&gbuffer.position, i, y)[x];
                *position = (float)(camera.eye[i] + 1e4 * (*position - camera.eye[i]));
            }
    eye_find(&gbuffer, &directions);
    assert_eye(&camera, &gbuffer, 1e-4);
    release(&gbuffer, &directions);
}

static void assert_no_eye(const struct gbuffer *gbuffer)
{
    assert_false(gbuffer->has_eye);
    assert_true(gbuffer->view_angle == 0);
    for (int i = 0; i < 3; i++)
        assert_true(gbuffer->eye[i] == 0);
}

static void eye__orthographic_camera__none(void **state)
{
    (void)state;
    static const double scales[] = {1e-3, 1, 1e4};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        struct camera camera = camera_at(1, 2, -3, 0.3, -0.5, 0, scales[i]);
        struct gbuffer gbuffer;
        struct image directions;
        draw(&camera, 100, 80, &gbuffer, &directions);
        gbuffer.has_eye = true;
        gbuffer.eye[0] = gbuffer.view_angle = 9;
        eye_find(&gbuffer, &directions);
        assert_no_eye(&gbuffer);
        release(&gbuffer, &directions);
    }
}

static void eye__rays_that_do_not_meet__none(void **state)
{
    (void)state;
    struct camera camera = camera_at(0, 1, -5, 0, 0, 1, 1);
    struct gbuffer gbuffer;
    struct image directions;
    draw(&camera, 64, 48, &gbuffer, &directions);
    for (int y = 0; y < 48; y++) /* a camera whose columns have eyes of their own, far apart */
        for (int x = 0; x < 64; x++)
            image_row(&gbuffer.position, 0, y)[x] += (float)(x - 32) * 0.05f;
    eye_find(&gbuffer, &directions);
    assert_no_eye(&gbuffer);
    release(&gbuffer, &directions);
}

static void eye__rays_that_meet_behind_what_they_see__none(void **state)
{
    (void)state;
    struct camera camera = camera_at(0, 1, -5, 0, 0, 1, 1);
    struct gbuffer gbuffer;
    struct image directions;
    draw(&camera, 64, 48, &gbuffer, &directions);
    for (int y = 0; y < 48; y++)
        for (int x = 0; x < 64; x++)
            for (int i = 0; i < 3; i++)
                image_row(&directions, i, y)[x] *= -1;
    eye_find(&gbuffer, &directions);
    assert_no_eye(&gbuffer);
    release(&gbuffer, &directions);
}

static void eye__no_or_one_position__none(void **state)
{
    (void)state;
    struct camera camera = camera_at(0, 1, -5, 0, 0, 1, 1);
    for (int left = 0; left < 2; left++) {
        struct gbuffer gbuffer;
        struct image directions;
        draw(&camera, 16, 12, &gbuffer, &directions);
        for (int y = 0; y < 12; y++)
            for (int x = 0; x < 16; x++)
                if (!left || x != 3 || y != 4)
                    erase(&gbuffer.position, x, y);
        eye_find(&gbuffer, &directions);
        assert_no_eye(&gbuffer);
        release(&gbuffer, &directions);
    }
}

static void eye__two_positions__where_their_rays_meet(void **state)
{
    (void)state;
    struct camera camera = camera_at(0.5, 1, -5, 0.2, 0.1, 1, 1);
    struct gbuffer gbuffer;
    struct image directions;
    draw(&camera, 16, 12, &gbuffer, &directions);
    for (int y = 0; y < 12; y++)
        for (int x = 0; x < 16; x++)
            if (!(x == 1 && y == 2) && !(x == 14 && y == 9))
                erase(&gbuffer.position, x, y);
    eye_find(&gbuffer, &directions);
    assert_eye(&camera, &gbuffer, 1e-3); /* nothing averages the quantisation away */
    release(&gbuffer, &directions);
}

static void eye__one_pixel_wide__no_view_angle(void **state)
{
    (void)state;
    struct camera camera = camera_at(0.5, 1, -5, 0.2, 0.1, 0.01, 1);
    struct gbuffer gbuffer;
    struct image directions;
    draw(&camera, 1, 100, &gbuffer, &directions);
    eye_find(&gbuffer, &directions);
    assert_eye(&camera, &gbuffer, 1e-3);
    assert_true(gbuffer.view_angle == 0);
    release(&gbuffer, &directions);
}

static void eye__one_pixel__none(void **state)
{
    (void)state;
    struct camera camera = camera_at(0.5, 1, -5, 0.2, 0.1, 0.5, 1);
    struct gbuffer gbuffer;
    struct image directions;
    draw(&camera, 1, 1, &gbuffer, &directions);
    eye_find(&gbuffer, &directions);
    assert_no_eye(&gbuffer);
    release(&gbuffer, &directions);
}

/* The rays at the centres of the outermost pixels are not the edges of the picture. */
static void eye__few_columns__view_angle_of_the_whole_pixels(void **state)
{
    (void)state;
    struct camera camera = camera_at(0, 0, 0, 0, 0, 1.2, 1);
    for (int width = 2; width < 6; width++) {
        struct gbuffer gbuffer;
        struct image directions;
        draw(&camera, width, 5, &gbuffer, &directions); /* an odd height has a row in the middle */
        eye_find(&gbuffer, &directions);
        assert_near(gbuffer.view_angle, 1.2, 1e-4);
        release(&gbuffer, &directions);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eye__perspective_cameras__found),
        cmocka_unit_test(eye__positions_only_here_and_there__found),
        cmocka_unit_test(eye__near_and_very_far_things__found),
        cmocka_unit_test(eye__orthographic_camera__none),
        cmocka_unit_test(eye__rays_that_do_not_meet__none),
        cmocka_unit_test(eye__rays_that_meet_behind_what_they_see__none),
        cmocka_unit_test(eye__no_or_one_position__none),
        cmocka_unit_test(eye__two_positions__where_their_rays_meet),
        cmocka_unit_test(eye__one_pixel_wide__no_view_angle),
        cmocka_unit_test(eye__one_pixel__none),
        cmocka_unit_test(eye__few_columns__view_angle_of_the_whole_pixels),
    };
    return cmocka_run_group_tests_name("eye", tests, NULL, NULL);
}
