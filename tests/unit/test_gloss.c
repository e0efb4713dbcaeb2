/* The public function against the filter that it wraps, and what it refuses. */
#include "gloss.h"

#include "filter.h"
#include "io_support.h"

enum { WIDTH = 37, HEIGHT = 11, STRIDE = 41 };

static float planes_of[14][STRIDE * HEIGHT], glossy_of[3][STRIDE * HEIGHT];
static float *const glossy[3] = {glossy_of[0], glossy_of[1], glossy_of[2]};
static const struct gloss_options options = {.phong = 80};

/* A floor with a wall behind it; no plane is like another. */
static struct gloss_planes make_planes(void)
{
    struct gloss_planes planes = {.width = WIDTH, .height = HEIGHT, .stride = STRIDE};
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < STRIDE; x++) {
            float values[14] = {(float)(x % 5), (float)(y % 3), (float)(x > 9), (float)x * 0.1f, 0, (float)y * 0.1f,
                                (float)x * 0.2f, 3 - (float)y * 0.1f, 2, 1, x > 3 ? 50 : 0, 0.5f, 0.5f, 0.5f};
            for (int i = 0; i < 14; i++)
                planes_of[i][y * STRIDE + x] = values[i];
        }
    for (int i = 0; i < 3; i++) {
        planes.specular[i] = planes_of[i];
        planes.position[i] = planes_of[3 + i];
        planes.reflectance[i] = planes_of[11 + i];
    }
    for (int i = 0; i < 4; i++)
        planes.endpoint[i] = planes_of[6 + i];
    planes.phong = planes_of[10];
    return planes;
}

static void gloss_filter__planes_with_a_stride__as_the_filter(void **state)
{
    (void)state;
    struct gloss_planes planes = make_planes();
    struct gbuffer gbuffer = {0};
    struct filter_options filter = filter_options_default();
    struct image blurred;
    struct error err;
    char message[64] = "x";
    const float eye[3] = {1, 2, -3};
    planes.eye = eye;
    planes.view_angle = gbuffer.view_angle = 1;
    gbuffer.has_eye = true;
    memcpy(gbuffer.eye, eye, sizeof eye);
    struct image *images[] = {&gbuffer.specular, &gbuffer.position, &gbuffer.endpoint, &gbuffer.phong,
                              &gbuffer.reflectance};
    static const int counts[] = {3, 3, 4, 1, 3};
    for (int i = 0, plane = 0; i < 5; i++) {
        assert_ok(image_alloc(images[i], WIDTH, HEIGHT, counts[i], &err), err);
        for (int channel = 0; channel < counts[i]; channel++, plane++)
            for (int y = 0; y < HEIGHT; y++)
                memcpy(image_row(images[i], channel, y), planes_of[plane] + y * STRIDE, WIDTH * sizeof(float));
    }
    for (int for_all = 0; for_all < 2; for_all++) {
        filter.phong = 80;
        filter.phong_override = for_all;
        assert_ok(filter_glossy(&gbuffer, &filter, &blurred, NULL, &err), err);
        for (int i = 0; i < 3; i++)
            for (int n = 0; n < STRIDE * HEIGHT; n++)
                glossy[i][n] = -1;
        assert_int_equal(gloss_filter(&planes, &(struct gloss_options){.phong = 80, .phong_for_all = for_all}, glossy,
                                      message, sizeof message),
                         GLOSS_OK);
        assert_string_equal(message, "");
        for (int i = 0; i < 3; i++)
            for (int y = 0; y < HEIGHT; y++) {
                assert_memory_equal(glossy[i] + y * STRIDE, image_row(&blurred, i, y), WIDTH * sizeof(float));
                assert_true(glossy[i][y * STRIDE + WIDTH] == -1); /* between the rows nothing is written */
            }
        image_free(&blurred);
    }
    gbuffer_free(&gbuffer);
}

static void gloss_apply__one_exponent_after_another__each_as_gloss_filter(void **state)
{
    (void)state;
    struct gloss_planes planes = make_planes();
    struct gloss *gloss;
    static const float phongs[] = {80, 5, 2000, 80};
    static float expected_of[3][STRIDE * HEIGHT];
    assert_int_equal(gloss_open(&planes, &gloss, NULL, 0), GLOSS_OK);
    for (size_t n = 0; n < sizeof phongs / sizeof *phongs; n++) {
        const struct gloss_options one = {.phong = phongs[n], .phong_for_all = n != 1};
        planes = make_planes();
        assert_int_equal(gloss_filter(&planes, &one, (float *const[]){expected_of[0], expected_of[1], expected_of[2]},
                                      NULL, 0),
                         GLOSS_OK);
        for (int i = 0; i < 14; i++)
            memset(planes_of[i], 0, sizeof planes_of[i]); /* the caller's planes aren't needed any more */
        assert_int_equal(gloss_apply(gloss, &one, glossy, NULL, 0), GLOSS_OK);
        for (int i = 0; i < 3; i++)
            for (int y = 0; y < HEIGHT; y++)
                assert_memory_equal(glossy[i] + y * STRIDE, expected_of[i] + y * STRIDE, WIDTH * sizeof(float));
    }
    char message[128];
    const struct gloss_options wrong = {.phong = -1};
    assert_int_equal(gloss_apply(gloss, &wrong, glossy, message, sizeof message), GLOSS_USAGE);
    assert_contains(message, "below 0 or NaN");
    gloss_close(gloss);
    gloss_close(NULL);
    planes.specular[1] = NULL;
    assert_int_equal(gloss_open(&planes, &gloss, message, sizeof message), GLOSS_USAGE);
    assert_null(gloss);
}

static void assert_refused(const struct gloss_planes *planes, struct gloss_options with, enum gloss_status status,
                           const char *part)
{
    char message[128];
    glossy[0][0] = 7;
    assert_int_equal(gloss_filter(planes, &with, glossy, message, sizeof message), status);
    assert_contains(message, part);
    assert_true(glossy[0][0] == 7);
    assert_int_equal(gloss_filter(planes, &with, glossy, NULL, 0), status);
}

static void gloss_filter__wrong_planes_or_options__refused(void **state)
{
    (void)state;
    struct gloss_planes planes = make_planes();
    assert_refused(&planes, (struct gloss_options){.phong = -1}, GLOSS_USAGE, "below 0 or NaN");
    assert_refused(&planes, (struct gloss_options){.phong = NAN}, GLOSS_USAGE, "below 0 or NaN");
    assert_refused(&planes, (struct gloss_options){.threads = -1}, GLOSS_USAGE, "below 0");
    static const float angles[] = {-1, NAN, INFINITY};
    for (int i = 0; i < 3; i++) {
        planes.view_angle = angles[i];
        assert_refused(&planes, options, GLOSS_USAGE, "isn't finite");
    }
    planes.view_angle = 0;
    planes.eye = (const float[]){0, 1, NAN};
    assert_refused(&planes, options, GLOSS_USAGE, "isn't finite");
    planes.eye = NULL;
    planes.endpoint[3] = NULL;
    assert_refused(&planes, options, GLOSS_USAGE, "plane 3 of endpoint is missing");
    planes = make_planes();
    planes.stride = WIDTH - 1;
    assert_refused(&planes, options, GLOSS_USAGE, "less than the width");
    planes = make_planes();
    planes.height = 0;
    assert_refused(&planes, options, GLOSS_DATA, "37 x 0 pixels");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gloss_filter__planes_with_a_stride__as_the_filter),
        cmocka_unit_test(gloss_filter__wrong_planes_or_options__refused),
        cmocka_unit_test(gloss_apply__one_exponent_after_another__each_as_gloss_filter),
    };
    return cmocka_run_group_tests_name("gloss", tests, scratch_setup, scratch_teardown);
}
