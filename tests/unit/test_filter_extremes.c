/* What filter.h defines for the extremes of its inputs: exponents, distances, angles, radii, sizes and radiance, of both
 * filters. */
#include "gloss_support.h"

#include <float.h>

static const double pi = 3.14159265358979324;

/* Both filters where every pixel counts alike, so that the result is a mean that can be worked out by hand. */
static const enum filter_mode modes[] = {FILTER_MODE_PAPER, FILTER_MODE_BEST};
enum { MODES = 2 };

static struct filter_options counting(enum filter_mode mode)
{
    struct filter_options options = filter_options_default();
    options.mode = mode;
    options.without = FILTER_WITHOUT_DENSITY | FILTER_WITHOUT_POOL | FILTER_WITHOUT_FIT;
    options.threads = 1;
    return options;
}

static void point_set(struct image *image, int x, int y, double first, double second, double third)
{
    image_row(image, 0, y)[x] = (float)first;
    image_row(image, 1, y)[x] = (float)second;
    image_row(image, 2, y)[x] = (float)third;
}

/* The red result at a pixel. */
static double result_at(const struct gbuffer *gbuffer, const struct filter_options *options, int x, int y)
{
    struct image glossy;
    filter_run(gbuffer, options, &glossy, NULL);
    double value = (double)image_row(&glossy, 0, y)[x];
    image_free(&glossy);
    return value;
}

/* --- exponents --- */

static void extremes__exponents_1e_minus_6_to_1e8__match_the_oracle(void **state)
{
    (void)state;
    static const float exponents[] = {1e-6f, 0.5f, 1, 10, 100, 1000, 1e4f, 1e5f, 1e6f, 1e7f, 1e8f};
    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++) {
        struct filter_options options = filter_options_default();
        struct scene scene = {.scale = 1, .ball = true, .view_angle = scene_view_angle((double)exponents[i])};
        struct gbuffer gbuffer;
        double allowed = 1e-5 + 1e-7 * sqrt((double)exponents[i]);
        options.threads = 1;
        scene_draw(&scene, 83, 61, exponents[i], &gbuffer);
        double best = oracle_best_error(&gbuffer, &options, 41);
        options.mode = FILTER_MODE_PAPER;
        double paper = oracle_error(&gbuffer, &options, lobe_weight, 41);
        if (!(best < 2 * allowed && paper < allowed))
            fail_msg("p = %g: error %g of the best filter, %g of the paper's, %g allowed", (double)exponents[i], best,
                     paper, allowed);
        gbuffer_free(&gbuffer);
    }
}

/* --- angles --- */

/* tan^2(theta) from which on the best filter sees nothing. */
static double blind_of(double phong, double floor_weight)
{
    return 1.21 * fmin(pow(floor_weight, -2 / phong) - 1, 0x1p99);
}

/* Two pixels, whose endpoints are in directions at an angle; the first one's result is (0 + f)/(1 + f). */
static void extremes__angle_from_0_to_180_degrees__weighs_by_the_power(void **state)
{
    (void)state;
    static const double angles[] = {0, 1e-6, 1e-3, 1, 10, 45, 89.99, 90, 90.01, 135, 180};
    static const double exponents[] = {0, 1e-6, 0.5, 1, 10, 1e4, 1e8, 1e20, INFINITY};
    const double floor_weight = 0.01; /* of the best filter */
    for (int turn = 0; turn < 2; turn++) /* the endpoint above the surface, and behind it: only the angle counts */
        for (int m = 0; m < MODES; m++)
            for (size_t i = 0; i < sizeof angles / sizeof *angles; i++)
                for (size_t j = 0; j < sizeof exponents / sizeof *exponents; j++) {
                    struct filter_options options = counting(modes[m]);
                    struct gbuffer gbuffer;
                    double angle = angles[i] * pi / 180, side = turn ? -1 : 1;
                    flat_gbuffer(&gbuffer, 2, 1, 1);
                    gbuffer.view_angle = 1e-12f; /* the window holds the whole picture, whatever the lobe */
                    image_free(&gbuffer.phong);
                    options.phong = (float)exponents[j];
                    image_row(&gbuffer.specular, 0, 0)[1] = 1;
                    point_set(&gbuffer.endpoint, 0, 0, 0, side, 0);
                    point_set(&gbuffer.endpoint, 1, 0, angles[i] == 180 ? 0 : sin(angle),
                              angles[i] == 90 ? 0 : side * cos(angle), 0);
                    double f = lobe_weight((double)options.phong, angles[i] >= 90 ? 0 : cos(angle));
                    if (exponents[j] >= 1e20)
                        f = 0; /* narrower than any pixel */
                    else if (m == 1)
                        f = fmax(f - floor_weight, 0) / (1 - floor_weight) *
                            fmax(0, fmin((1 - pow(tan(angle), 2) / blind_of(exponents[j], floor_weight)) / 0.7, 1));
                    double result = result_at(&gbuffer, &options, 0, 0), expected = f / (1 + f);
                    if (!(fabs(result - expected) <= 1e-6 + 1e-5 * expected))
                        fail_msg("mode %d, %g degrees, p = %g: %.9g in place of %.9g", m, angles[i], exponents[j],
                                 result, expected);
                    gbuffer_free(&gbuffer);
                }
}

/* --- distances --- */

enum { SIDE = 11, MIDDLE = SIDE / 2, PIXELS = SIDE * SIDE };

/* A floor of 11 x 11 pixels about the origin, a tenth apart, that all see straight up; the middle one is brighter. */
static void small_floor(struct gbuffer *gbuffer, double distance)
{
    flat_gbuffer(gbuffer, SIDE, SIDE, 1);
    gbuffer->view_angle = 1e-12f;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            point_set(&gbuffer->position, x, y, (x - MIDDLE) * 0.1, 0, (y - MIDDLE) * 0.1);
            point_set(&gbuffer->specular, x, y, 1, 0, 0);
        }
    image_row(&gbuffer->specular, 0, MIDDLE)[MIDDLE] = 7;
    if (distance < INFINITY) {
        point_set(&gbuffer->endpoint, MIDDLE, MIDDLE, 0, distance, 0);
        image_row(&gbuffer->endpoint, 3, MIDDLE)[MIDDLE] = 1;
    }
}

static void extremes__endpoint_distance__below_1e_minus_15_is_0_and_the_largest_infinite(void **state)
{
    (void)state;
    static const double distances[] = {0,    1e-45, 1e-30, 1e-17, 1e-14, 1e-10, 1e-3,
                                       1,    1e5,   1e15,  1e30,  FLT_MAX, INFINITY};
    const double mean = (PIXELS - 1 + 7.0) / PIXELS;
    for (int m = 0; m < MODES; m++)
        for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
            struct filter_options options = counting(modes[m]);
            struct gbuffer gbuffer;
            small_floor(&gbuffer, distances[i]);
            gbuffer.has_eye = false; /* the radius is that of the gradient, whatever the distance */
            options.max_radius_px = SIDE * 2;
            double expected = distances[i] < 1e-16 ? 7 : mean, result = result_at(&gbuffer, &options, MIDDLE, MIDDLE);
            /* Seen from beside it the point is at the horizon, or overhead like the others' endpoints. */
            double beside = result_at(&gbuffer, &options, MIDDLE + 1, MIDDLE);
            bool overhead = distances[i] >= 1e15, horizon = distances[i] < 1e-5;
            if (!(fabs(result - expected) <= 1e-5) || (overhead && !(fabs(beside - mean) <= 1e-5)) ||
                (horizon && !(fabs(beside - 1) <= 1e-5)))
                fail_msg("mode %d, r = %g: %.9g in place of %.9g, beside it %.9g", m, distances[i], result, expected,
                         beside);
            gbuffer_free(&gbuffer);
        }
}

static void extremes__eye_from_the_surface_to_the_largest_float__gives_the_radius_of_equation_4(void **state)
{
    (void)state;
    static const double eyes[] = {0, 1e-45, 1e-30, 1e-3, 1, 1e10, 1e30, FLT_MAX};
    static const double distances[] = {1e-20, 1, 1e6, INFINITY};
    for (size_t i = 0; i < sizeof eyes / sizeof *eyes; i++)
        for (size_t j = 0; j < sizeof distances / sizeof *distances; j++)
            for (int m = 0; m < MODES; m++) {
                struct filter_options options = counting(modes[m]);
                struct gbuffer gbuffer;
                struct image glossy, radius;
                small_floor(&gbuffer, distances[j]);
                gbuffer.view_angle = 1;
                gbuffer.eye[1] = (float)eyes[i];
                filter_run(&gbuffer, &options, &glossy, &radius);
                double theta = lobe_half_angle(1, 0.99, pi / 2), r = distances[j];
                double rho = SIDE * (isinf(r) ? theta : theta / (1 + (double)gbuffer.eye[1] / r));
                rho = fmin(rho, hypot(SIDE, SIDE));
                double found = (double)image_row(&radius, 0, MIDDLE)[MIDDLE];
                double middle = (double)image_row(&glossy, 0, MIDDLE)[MIDDLE];
                if ((m == 0 && !(fabs(found - rho) <= 1e-5)) || !(middle >= 1 - 1e-6 && middle <= 7 + 1e-6) ||
                    (m == 0 && rho < 1 && !(middle == 7)))
                    fail_msg("mode %d, s = %g, r = %g: radius %g in place of %g, result %g", m, eyes[i], r, found, rho,
                             middle);
                image_free(&glossy);
                image_free(&radius);
                gbuffer_free(&gbuffer);
            }
}

static void extremes__radius_from_below_a_pixel_to_beyond_the_picture__holds_its_pixels(void **state)
{
    (void)state;
    static const struct {
        double radius;
        int limit, pixels;
    } rows[] = {{1e-30, 0, 1}, {0.5, 0, 1}, {0.9999, 0, 1}, {1.0001, 0, 5}, {1.4143, 0, 9}, {2.9999, 3, 25},
                {3.0001, 3, 29}, {1e9, 3, 29}, {1e9, 0, PIXELS}, {1e38, 0, PIXELS}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct filter_options options = counting(FILTER_MODE_PAPER);
        struct gbuffer gbuffer;
        small_floor(&gbuffer, INFINITY);
        gbuffer.view_angle = (float)(lobe_half_angle(1, 0.99, pi / 2) * SIDE / rows[i].radius);
        options.max_radius_px = rows[i].limit;
        double expected = (rows[i].pixels - 1 + 7.0) / rows[i].pixels;
        double result = result_at(&gbuffer, &options, MIDDLE, MIDDLE);
        if (!(fabs(result - expected) <= 1e-6))
            fail_msg("radius %g, limit %d: %.9g in place of %.9g", rows[i].radius, rows[i].limit, result, expected);
        gbuffer_free(&gbuffer);
    }
}

/* --- sizes --- */

/* A ramp along the longer side, averaged over 2 pixels to each side. */
static void extremes__one_pixel_wide_or_65535_long__is_averaged_to_its_ends(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {2, 1}, {1, 2}, {7, 1}, {1, 7}, {65535, 1}, {1, 65535}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int m = 0; m < MODES; m++) {
            const int width = sizes[i][0], height = sizes[i][1], length = width > height ? width : height;
            struct filter_options options = counting(modes[m]);
            struct gbuffer gbuffer;
            struct image glossy;
            options.max_radius_px = 2;
            flat_gbuffer(&gbuffer, width, height, 10);
            gbuffer.view_angle = 1e-12f;
            for (int n = 0; n < length; n++)
                image_row(&gbuffer.specular, 0, width > 1 ? 0 : n)[width > 1 ? n : 0] = (float)n;
            filter_run(&gbuffer, &options, &glossy, NULL);
            for (int n = 0; n < length; n++) {
                int first = n < 2 ? 0 : n - 2, last = n + 2 < length ? n + 2 : length - 1;
                double expected = (first + last) / 2.0;
                double result = (double)image_row(&glossy, 0, width > 1 ? 0 : n)[width > 1 ? n : 0];
                if (!(fabs(result - expected) <= 1e-6 * (1 + expected)))
                    fail_msg("mode %d, %d x %d: %.9g at %d in place of %.9g", m, width, height, result, n, expected);
            }
            image_free(&glossy);
            gbuffer_free(&gbuffer);
        }
}

static void extremes__none_one_or_all_glossy__blur_those_alone(void **state)
{
    (void)state;
    for (int m = 0; m < MODES; m++)
        for (int glossy_pixels = 0; glossy_pixels < 3; glossy_pixels++) {
            struct filter_options options = counting(modes[m]);
            struct gbuffer gbuffer;
            struct image glossy;
            small_floor(&gbuffer, INFINITY);
            for (int y = 0; y < SIDE && glossy_pixels < 2; y++)
                for (int x = 0; x < SIDE; x++)
                    image_row(&gbuffer.phong, 0, y)[x] = glossy_pixels == 1 && x == MIDDLE && y == MIDDLE;
            filter_run(&gbuffer, &options, &glossy, NULL);
            static const double middle[] = {0, 7, (PIXELS - 1 + 7.0) / PIXELS};
            for (int y = 0; y < SIDE; y++)
                for (int x = 0; x < SIDE; x++) {
                    bool is_middle = x == MIDDLE && y == MIDDLE;
                    double expected = glossy_pixels == 2 || is_middle ? middle[glossy_pixels] : 0;
                    assert_near(image_row(&glossy, 0, y)[x], expected, 1e-6);
                }
            image_free(&glossy);
            gbuffer_free(&gbuffer);
        }
}

/* --- radiance --- */

static void extremes__radiance_from_denormal_to_the_largest_float__is_averaged(void **state)
{
    (void)state;
    static const float values[] = {0, 1e-45f, -1e-45f, 1e-40f, FLT_MIN, 1e-20f, -1, 65504, -65504, 1e30f, FLT_MAX,
                                   -FLT_MAX};
    static const float others[] = {0, 1, -3}; /* the rest of the picture: times the value, so that both are extreme */
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        for (int j = 0; j < 3; j++)
            for (int m = 0; m < MODES; m++) {
                struct filter_options options = counting(modes[m]);
                struct gbuffer gbuffer;
                float other = fabsf(values[i]) > 1e38f ? others[j] : others[j] * values[i];
                small_floor(&gbuffer, INFINITY);
                for (int y = 0; y < SIDE; y++)
                    for (int x = 0; x < SIDE; x++)
                        image_row(&gbuffer.specular, 0, y)[x] = other;
                image_row(&gbuffer.specular, 0, MIDDLE)[MIDDLE] = values[i];
                double expected = ((PIXELS - 1) * (double)other + (double)values[i]) / PIXELS;
                double largest = fmax(fabs((double)values[i]), fabs((double)other));
                double result = result_at(&gbuffer, &options, MIDDLE, MIDDLE);
                if (!(fabs(result - expected) <= fmax(1e-6 * largest, 1e-45)))
                    fail_msg("mode %d, %g among %g: %.9g in place of %.9g", m, (double)values[i], (double)other, result,
                             expected);
                gbuffer_free(&gbuffer);
            }
}

static void extremes__nan_or_infinity_in_any_channel__is_left_out_and_counted(void **state)
{
    (void)state;
    static const float values[] = {NAN, INFINITY, -INFINITY};
    for (int channel = 0; channel < 11; channel++)
        for (int i = 0; i < 3; i++)
            for (int m = 0; m < MODES; m++) {
                struct filter_options options = counting(modes[m]);
                struct gbuffer gbuffer;
                struct image glossy;
                small_floor(&gbuffer, INFINITY);
                struct image *image = channel < 3    ? &gbuffer.specular
                                      : channel < 6  ? &gbuffer.position
                                      : channel < 10 ? &gbuffer.endpoint
                                                     : &gbuffer.phong;
                int first = channel < 3 ? 0 : channel < 6 ? 3 : channel < 10 ? 6 : 10;
                image_row(image, channel - first, MIDDLE)[MIDDLE] = values[i];
                bool mirror = channel == 10 && values[i] > 0; /* an infinite exponent is nothing wrong */
                assert_int_equal(filter_left_out(&gbuffer), !mirror);
                filter_run(&gbuffer, &options, &glossy, NULL);
                for (int y = 0; y < SIDE; y++)
                    for (int x = 0; x < SIDE; x++) {
                        bool is_middle = x == MIDDLE && y == MIDDLE;
                        double expected = mirror ? is_middle ? 7 : (PIXELS - 1 + 7.0) / PIXELS : !is_middle;
                        assert_near(image_row(&glossy, 0, y)[x], expected, 1e-6);
                    }
                image_free(&glossy);
                gbuffer_free(&gbuffer);
            }
    struct gbuffer gbuffer;
    small_floor(&gbuffer, INFINITY);
    assert_int_equal(filter_left_out(&gbuffer), 0);
    image_row(&gbuffer.endpoint, 3, 2)[1] = -1;
    image_row(&gbuffer.phong, 0, 2)[2] = -1;
    image_row(&gbuffer.phong, 0, 2)[3] = 0;                               /* not meant to be glossy, */
    point_set(&gbuffer.endpoint, 4, 2, 0, 0, 0);                          /* nor this */
    image_row(&gbuffer.specular, 0, 2)[3] = NAN;
    assert_int_equal(filter_left_out(&gbuffer), 2);
    image_free(&gbuffer.phong);
    assert_int_equal(filter_left_out(&gbuffer), 2); /* without exponents the third one is meant, the second one right */
    gbuffer_free(&gbuffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extremes__exponents_1e_minus_6_to_1e8__match_the_oracle),
        cmocka_unit_test(extremes__angle_from_0_to_180_degrees__weighs_by_the_power),
        cmocka_unit_test(extremes__endpoint_distance__below_1e_minus_15_is_0_and_the_largest_infinite),
        cmocka_unit_test(extremes__eye_from_the_surface_to_the_largest_float__gives_the_radius_of_equation_4),
        cmocka_unit_test(extremes__radius_from_below_a_pixel_to_beyond_the_picture__holds_its_pixels),
        cmocka_unit_test(extremes__one_pixel_wide_or_65535_long__is_averaged_to_its_ends),
        cmocka_unit_test(extremes__none_one_or_all_glossy__blur_those_alone),
        cmocka_unit_test(extremes__radiance_from_denormal_to_the_largest_float__is_averaged),
        cmocka_unit_test(extremes__nan_or_infinity_in_any_channel__is_left_out_and_counted),
    };
    return cmocka_run_group_tests_name("filter_extremes", tests, NULL, NULL);
}
