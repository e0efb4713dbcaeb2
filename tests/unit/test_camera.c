/* Cameras from their rays: what is found is what drew them, or nothing. */
#include "camera.h"

#include "gloss_support.h"

static struct image coded(const struct camera *camera, int width, int height)
{
    struct image directions = {0};
    struct error err;
    assert_ok(camera_directions(camera, width, height, &directions, &err), err);
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                float *value = &image_row(&directions, i, y)[x];
                *value = (float)(round((double)*value * 0.499 * 65535) / 65535 / 0.499);
            }
    return directions;
}

/* In units of the picture: the largest error of a ray over the angle of a pixel. */
static double error_px(const struct camera *found, const struct camera *camera, int width, int height)
{
    struct image a = {0}, b = {0};
    struct error err;
    double worst = 0, angle = camera_view_angle(camera) / width;
    assert_ok(camera_directions(found, width, height, &a, &err), err);
    assert_ok(camera_directions(camera, width, height, &b, &err), err);
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                worst = fmax(worst, fabs((double)image_row(&a, i, y)[x] - (double)image_row(&b, i, y)[x]));
    image_free(&a);
    image_free(&b);
    return worst / angle;
}

static const struct camera cameras[] = {
    {.direction = {0, 0, 1}, .right = {1.33, 0, 0}, .up = {0, 1, 0}},
    {.direction = {0.3, -0.2, 2}, .right = {-1.2, 0.1, 0.2}, .up = {0.05, 0.9, 0.1}}, /* mirrored, and askew */
    {.direction = {5, 0, 0}, .right = {0, 0, -0.4}, .up = {0, 0.3, 0}},
    {.direction = {0, 0, 0.3}, .right = {1.33, 0, 0}, .up = {0, 1, 0}}, /* 131 degrees */
};

static void fit__rays_of_a_perspective_camera__within_a_hundredth_of_a_pixel(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++) {
        struct image directions = coded(&cameras[i], 320, 240);
        struct camera found = {0};
        assert_true(camera_fit(&directions, &found));
        assert_near(error_px(&found, &cameras[i], 320, 240), 0, 0.01);
        image_free(&directions);
    }
}

static void fit__other_rays__refused(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        struct image directions = coded(&cameras[0], 64, 48);
        struct camera found;
        for (int y = 0; y < 48; y++)
            for (int x = 0; x < 64; x++) {
                double u = (x - 31.5) / 64, v = (y - 23.5) / 64, r = hypot(u, v) + 1e-9;
                double ray[3] = {sin(2 * r) * u / r, sin(2 * r) * v / r, cos(2 * r)}; /* a fisheye */
                if (kind == 1)
                    memcpy(ray, (double[]){0, 0, 1}, sizeof ray); /* orthographic */
                for (int i = 0; i < 3 && kind < 2; i++)
                    image_row(&directions, i, y)[x] = (float)ray[i];
            }
        if (kind == 2)
            image_row(&directions, 0, 5)[7] += 0.001f;
        assert_false(camera_fit(&directions, &found));
        image_free(&directions);
    }
}

static void text__factors__wider_and_higher(void **state)
{
    (void)state;
    struct camera camera = {.location = {1, 2, 3}, .direction = {0, 0, 1}, .right = {1.5, 0, 0}, .up = {0, 1, 0}};
    struct buffer text = {0};
    struct error err;
    assert_ok(camera_text(&camera, 1.5, 2, &text, &err), err);
    assert_string_equal(text.data, "camera { perspective location <1, 2, 3> direction <0, 0, 1>\n"
                                   "  right <2.25, 0, 0> up <0, 2, 0> }\n");
    buffer_free(&text);
    assert_near(camera_view_angle(&camera), 2 * atan(0.75), 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fit__rays_of_a_perspective_camera__within_a_hundredth_of_a_pixel),
        cmocka_unit_test(fit__other_rays__refused),
        cmocka_unit_test(text__factors__wider_and_higher),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
