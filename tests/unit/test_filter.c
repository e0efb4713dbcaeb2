/* Both filters against their sums in double, all pixels by all pixels, and their properties. TESTS='*threads*' runs those
 * of that name. */
#include "cpu.h"
#include "gloss_support.h"
#include "interrupt.h"
#include "lobe.h"
#include "weights.h"

#include <float.h>
#include <signal.h>

static struct error err;
static const struct scene plain_scene = {.scale = 1, .ball = true};
static const struct scene bounded_scene = {.scale = 1, .bounded = true};

static enum filter_mode tested_mode = FILTER_MODE_PAPER;

static int setup_best(void **state)
{
    (void)state;
    tested_mode = FILTER_MODE_BEST;
    return 0;
}

static int teardown_best(void **state)
{
    (void)state;
    tested_mode = FILTER_MODE_PAPER;
    return 0;
}

static struct filter_options test_options(void)
{
    struct filter_options options = filter_options_default();
    options.mode = tested_mode;
    options.radius_step = 1;
    options.threads = 1;
    return options;
}

/* --- equation (1) --- */

static void filter__exact_weights__match_the_oracle(void **state)
{
    (void)state;
    static const float exponents[] = {1e-3f, 1, 10, 239, 241, 1000, 1e4f, 1e6f};
    static const double view_angles[] = {0, 0.02};
    for (int v = 0; v < 2; v++)
        for (int bounded = 0; bounded < 2; bounded++)
            for (int i = 0; i < 8; i++) {
                struct scene scene = {.scale = 1, .ball = true, .bounded = bounded, .view_angle = view_angles[v]};
                struct filter_options options = test_options();
                struct gbuffer gbuffer;
                scene_draw(&scene, 83, 61, exponents[i], &gbuffer);
                double error = oracle_error(&gbuffer, &options, lobe_weight, exponents[i] < 1000 ? 23 : 5);
                if (!(error < 1e-5))
                    fail_msg("p = %g, view angle %g: error %g", (double)exponents[i], view_angles[v], error);
                gbuffer_free(&gbuffer);
            }
}

static void filter__table_weights__match_the_oracle(void **state)
{
    (void)state;
    static const float exponents[] = {1e-3f, 1, 10, 300, 1e4f, 1e6f};
    for (int i = 0; i < 6; i++) {
        struct scene scene = {.scale = 1, .ball = true, .view_angle = exponents[i] > 1000 ? 0.02 : 0};
        struct filter_options options = test_options();
        options.weights = FILTER_WEIGHTS_TABLE;
        struct gbuffer gbuffer;
        scene_draw(&scene, 83, 61, exponents[i], &gbuffer);
        double error = oracle_error(&gbuffer, &options, lobe_weight, 23);
        if (!(error < 3.3e-5))
            fail_msg("p = %g: error %g", (double)exponents[i], error);
        gbuffer_free(&gbuffer);
    }
}

static void filter__gauss_weights__match_the_oracle(void **state)
{
    (void)state;
    static const float exponents[] = {1, 30, 1000};
    for (int i = 0; i < 3; i++) {
        struct filter_options options = test_options();
        options.weights = FILTER_WEIGHTS_GAUSS;
        struct gbuffer gbuffer;
        scene_draw(&plain_scene, 83, 61, exponents[i], &gbuffer);
        double error = oracle_error(&gbuffer, &options, weights_gauss, 23);
        if (!(error < 1e-5))
            fail_msg("p = %g: error %g", (double)exponents[i], error);
        gbuffer_free(&gbuffer);
    }
}

static void filter__square_window__matches_the_oracle(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    options.window = FILTER_WINDOW_SQUARE;
    struct gbuffer gbuffer;
    scene_draw(&bounded_scene, 67, 50, 200, &gbuffer);
    assert_true(oracle_error(&gbuffer, &options, lobe_weight, 7) < 1e-5);
    gbuffer_free(&gbuffer);
}

static void filter__widths_1_to_67__match_the_oracle(void **state)
{
    (void)state;
    for (int width = 1; width <= 67; width++) {
        struct filter_options options = test_options();
        struct gbuffer gbuffer;
        scene_draw(&plain_scene, width, 5, 20, &gbuffer);
        /* Whatever the camera sees in so small a picture, make the left part glossy: a patch of floor under the sky. */
        for (int y = 0; y < 5; y++)
            for (int x = 0; x < width; x++) {
                float values[10] = {(float)x, 0, (float)y, 0.3f * (float)x, 2 + 0.1f * (float)y, 1, 1, 0, 0, 0};
                for (int i = 0; i < 3; i++) {
                    image_row(&gbuffer.position, i, y)[x] = values[i];
                    image_row(&gbuffer.endpoint, i, y)[x] = values[3 + i];
                    image_row(&gbuffer.specular, i, y)[x] = 0.5f + 0.01f * (float)(x + i * y);
                }
                image_row(&gbuffer.endpoint, 3, y)[x] = (x + y) % 3 > 0;
                image_row(&gbuffer.phong, 0, y)[x] = (x * 7 + y) % 11 == 3 && width > 3 ? 0 : 4;
            }
        double error = oracle_error(&gbuffer, &options, lobe_weight, 1);
        if (!(error < 1e-5))
            fail_msg("width %d: error %g", width, error);
        gbuffer_free(&gbuffer);
    }
}

static void filter__exponent_of_each_pixel__matches_the_oracle(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    scene_draw(&plain_scene, 83, 61, 50, &gbuffer);
    for (int y = 0; y < 61; y++)
        for (int x = 0; x < 83; x++)
            if (scene_glossy(&gbuffer, x, y))
                image_row(&gbuffer.phong, 0, y)[x] = (x / 5 + y) % 2 ? 20 : 20 + 40 * (float)x;
    assert_true(oracle_error(&gbuffer, &options, lobe_weight, 7) < 1e-5);
    gbuffer_free(&gbuffer);
}

static void filter__homogeneous_scale_of_the_endpoint__does_not_matter(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image before, after;
    scene_draw(&plain_scene, 67, 50, 100, &gbuffer);
    filter_run(&gbuffer, &options, &before, NULL);
    for (int i = 0; i < 4; i++)
        for (int y = 0; y < 50; y++)
            for (int x = 0; x < 67; x++)
                image_row(&gbuffer.endpoint, i, y)[x] *= 1 << (x + y) % 5;
    filter_run(&gbuffer, &options, &after, NULL);
    double worst = 0; /* powers of two: only a direction's length is rounded anew */
    for (int y = 0; y < 50; y++)
        for (int x = 0; x < 67; x++)
            worst = fmax(worst, fabs((double)image_row(&before, 0, y)[x] - (double)image_row(&after, 0, y)[x]));
    assert_near(worst, 0, 1e-6);
    image_free(&before);
    image_free(&after);
    gbuffer_free(&gbuffer);
}

static void filter__lengths_1e_minus_24_to_1e24__give_one_picture(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    for (double scale = 1e-24; scale < 2e24; scale *= 1e6) {
        struct scene scene = {.scale = scale, .ball = true};
        struct gbuffer gbuffer;
        scene_draw(&scene, 67, 50, 300, &gbuffer);
        double error = oracle_error(&gbuffer, &options, lobe_weight, 11);
        if (!(error < 1e-5))
            fail_msg("scale %g: error %g", scale, error);
        gbuffer_free(&gbuffer);
    }
}

static void filter__very_far_endpoint__is_a_direction(void **state)
{
    (void)state;
    static const float distances[] = {1e9f, 1e15f, 1e30f};
    for (int i = 0; i < 3; i++) {
        struct filter_options options = test_options();
        struct gbuffer gbuffer;
        struct image expected, glossy;
        scene_draw(&plain_scene, 67, 50, 100, &gbuffer);
        filter_run(&gbuffer, &options, &expected, NULL);
        for (int y = 0; y < 50; y++)
            for (int x = 0; x < 67; x++) {
                float *w = image_row(&gbuffer.endpoint, 3, y) + x;
                if (*w > 0 || !scene_glossy(&gbuffer, x, y))
                    continue;
                *w = 1;
                for (int channel = 0; channel < 3; channel++)
                    image_row(&gbuffer.endpoint, channel, y)[x] *= distances[i];
            }
        filter_run(&gbuffer, &options, &glossy, NULL);
        for (int y = 0; y < 50; y++)
            for (int x = 0; x < 67; x++)
                assert_near(image_row(&glossy, 0, y)[x], image_row(&expected, 0, y)[x], 2e-6);
        image_free(&expected);
        image_free(&glossy);
        gbuffer_free(&gbuffer);
    }
}

/* --- the best filter --- */

static void filter_best__sums__match_the_oracle(void **state)
{
    (void)state;
    static const float exponents[] = {1, 10, 60, 300, 1000, 1e4f, 1e6f};
    for (int view = 0; view < 2; view++)
        for (int bounded = 0; bounded < 2; bounded++)
            for (int i = 0; i < 7; i++) {
                struct scene scene = {.scale = 1, .ball = true, .bounded = bounded, .view_angle = view * 0.1};
                struct filter_options options = test_options();
                struct gbuffer gbuffer;
                scene_draw(&scene, 83, 61, exponents[i], &gbuffer);
                double error = oracle_best_error(&gbuffer, &options, 23);
                if (!(error < 2e-5))
                    fail_msg("p = %g, bounded %d, view %d: error %g", (double)exponents[i], bounded, view, error);
                gbuffer_free(&gbuffer);
            }
}

static void filter_best__widths_1_to_67__match_the_oracle(void **state)
{
    (void)state;
    for (int width = 1; width <= 67; width++) {
        struct scene scene = {.scale = 1, .ball = true, .view_angle = 1.1};
        struct filter_options options = test_options();
        struct gbuffer gbuffer;
        scene_draw(&scene, width, width / 2 + 3, 50, &gbuffer);
        bool any = false;
        for (int y = 0; y < gbuffer.phong.height; y++)
            for (int x = 0; x < width; x++)
                any = any || scene_glossy(&gbuffer, x, y);
        double error = any ? oracle_best_error(&gbuffer, &options, 3) : 0;
        if (!(error < 2e-5))
            fail_msg("width %d: error %g", width, error);
        gbuffer_free(&gbuffer);
    }
}

/* A mirror in the plane z = 0 with an eye at z = -1 over it: pixel (x, y) looks at (x - 32, y - 32) / 100. Endpoints lie
 * in the plane z = -distance. */
static void wall_gbuffer(struct gbuffer *gbuffer, float phong, float near_columns, float near)
{
    gbuffer_alloc(gbuffer, 64, 64);
    gbuffer->has_eye = true;
    gbuffer->view_angle = 0.6f;
    gbuffer->eye[2] = -1;
    for (int y = 0; y < 64; y++)
        for (int x = 0; x < 64; x++) {
            float a[2] = {(float)(x - 32) / 100, (float)(y - 32) / 100}, distance = (float)x < near_columns ? near : 9;
            for (int i = 0; i < 2; i++) {
                image_row(&gbuffer->position, i, y)[x] = a[i];
                image_row(&gbuffer->endpoint, i, y)[x] = a[i] * (1 + distance);
            }
            image_row(&gbuffer->endpoint, 2, y)[x] = -distance;
            image_row(&gbuffer->endpoint, 3, y)[x] = 1;
            image_row(&gbuffer->specular, 0, y)[x] = (float)x < near_columns ? 1 : 0;
            image_row(&gbuffer->phong, 0, y)[x] = phong;
        }
}

static void filter_best__wall_across_the_lobe__is_seen_in_full(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy, confidence;
    options.mode = FILTER_MODE_BEST;
    wall_gbuffer(&gbuffer, 1000, 0, 1);
    filter_run(&gbuffer, &options, &glossy, &confidence);
    assert_near(image_row(&confidence, 0, 32)[32], 1, 0.005);
    const double half = (double)image_row(&confidence, 0, 32)[0];
    assert_near(half, 0.5, 0.08); /* the picture's border: with the pixel's own column somewhat more */
    assert_near(image_row(&confidence, 0, 0)[0], half * half, 0.02);
    image_free(&glossy);
    image_free(&confidence);
    gbuffer_free(&gbuffer);
}

static void filter_best__density__weighs_near_things_by_their_solid_angle(void **state)
{
    (void)state;
    /* Left: a bright wall 1 from the mirror that ends half a pixel left of the middle, 0.01 off; right: a dark one, 9.
     * The lobe is a Gaussian of variance 1/300: 0.43 of it are bright. By pixels it would be 0.19: a pixel of the near
     * wall covers 3.2 times the solid angle. */
    for (unsigned without = 0; without <= FILTER_WITHOUT_DENSITY; without++) {
        struct filter_options options = test_options();
        struct gbuffer gbuffer;
        struct image glossy;
        options.mode = FILTER_MODE_BEST;
        options.without = without | FILTER_WITHOUT_FIT;
        wall_gbuffer(&gbuffer, 300, 32, 1);
        filter_run(&gbuffer, &options, &glossy, NULL);
        if (without)
            assert_near(image_row(&glossy, 0, 32)[32], 0.19, 0.05);
        else
            assert_near(image_row(&glossy, 0, 32)[32], 0.43, 0.03);
        image_free(&glossy);
        gbuffer_free(&gbuffer);
    }
}

/* The result in the middle of the left border, where half of the lobe is missing, of radiance that depends on x. */
static double border_result(float phong, float (*radiance)(int x), unsigned without)
{
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy;
    options.mode = FILTER_MODE_BEST;
    options.without = without | FILTER_WITHOUT_POOL;
    wall_gbuffer(&gbuffer, phong, 0, 1);
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < 64; y++)
            for (int x = 0; x < 64; x++)
                image_row(&gbuffer.specular, i, y)[x] = radiance(x);
    filter_run(&gbuffer, &options, &glossy, NULL);
    double result = (double)image_row(&glossy, 0, 32)[0];
    image_free(&glossy);
    gbuffer_free(&gbuffer);
    return result;
}

static float slope(int x)
{
    return 10 + (float)x;
}

static float lamp(int x)
{
    return x == 3 ? 1000 : 1;
}

static void filter_best__fit__goes_on_with_a_slope_beyond_the_border(void **state)
{
    (void)state;
    const double ideal = 10, mean = border_result(1000, slope, FILTER_WITHOUT_FIT);
    assert_true(mean > ideal + 2);
    assert_true(fabs(border_result(1000, slope, 0) - ideal) < 0.7 * (mean - ideal));
}

static void filter_best__fit__expects_no_lamp_where_nothing_is_seen(void **state)
{
    (void)state;
    double mean = border_result(1000, lamp, FILTER_WITHOUT_FIT);
    assert_true(border_result(1000, lamp, 0) < 0.75 * mean);
}

/* The right half of the picture is a wall at x = 3 whose rays end 0.0005 above the floor of the left half, which sees
 * the sky: the middle one within the lobe of the floor's pixel (4, 4), at whose a it ends. */
static void floor_and_wall_gbuffer(struct gbuffer *gbuffer)
{
    gbuffer_alloc(gbuffer, 16, 9);
    for (int y = 0; y < 9; y++)
        for (int x = 0; x < 16; x++) {
            const bool wall = x >= 8;
            const float a[3] = {wall ? 3 : 0.1f * (float)x, wall ? 1 + 0.05f * (float)y : 0,
                                wall ? 0.4f + 0.1f * (float)(x - 8) : 0.1f * (float)y};
            const float b[3] = {wall ? 0.4001f + 0.05f * (float)(y - 4) : a[0] + 0.1f * (float)(x - 4),
                                wall ? 0.0005f : 10, wall ? 0.4f + 0.05f * (float)(x - 8) : a[2] + 0.1f * (float)(y - 4)};
            for (int i = 0; i < 3; i++) {
                image_row(&gbuffer->position, i, y)[x] = a[i];
                image_row(&gbuffer->endpoint, i, y)[x] = b[i];
                image_row(&gbuffer->specular, i, y)[x] = wall;
            }
            image_row(&gbuffer->endpoint, 3, y)[x] = 1;
            image_row(&gbuffer->phong, 0, y)[x] = 100;
        }
}

static void filter_best__ray_of_another_mirror_that_ends_at_a__does_not_fill_the_lobe(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy;
    options.mode = FILTER_MODE_BEST;
    options.without = FILTER_WITHOUT_FIT | FILTER_WITHOUT_POOL;
    floor_and_wall_gbuffer(&gbuffer);
    filter_run(&gbuffer, &options, &glossy, NULL);
    assert_true(image_row(&glossy, 0, 4)[4] > 0);
    assert_true(image_row(&glossy, 0, 4)[4] < 0.05f);
    image_free(&glossy);
    gbuffer_free(&gbuffer);
}

static void filter_best__what_a_near_wall_hides__is_not_seen(void **state)
{
    (void)state;
    /* Three pixels left of the near wall's edge its rest fills the right of the lobe up to 0.6 radians, far beyond
     * its end: nothing of the dark wall behind is seen. */
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image seen, all;
    options.mode = FILTER_MODE_BEST;
    options.without = FILTER_WITHOUT_POOL;
    wall_gbuffer(&gbuffer, 300, 40, 0.05f);
    filter_run(&gbuffer, &options, &seen, NULL);
    options.without |= FILTER_WITHOUT_VISIBILITY;
    filter_run(&gbuffer, &options, &all, NULL);
    assert_near(image_row(&seen, 0, 32)[36], 1, 1e-6);
    assert_true(image_row(&all, 0, 32)[36] < 0.95f);
    image_free(&seen);
    image_free(&all);
    gbuffer_free(&gbuffer);
}

/* --- properties --- */

static void filter__constant_radiance__stays_constant_with_every_option(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    scene_draw(&plain_scene, 48, 36, 60, &gbuffer);
    for (int y = 0; y < 36; y++)
        for (int x = 0; x < 48; x++)
            for (int i = 0; i < 3; i++)
                image_row(&gbuffer.specular, i, y)[x] = 0.1f * (float)(i + 1);
    for (int combination = 0; combination < 3 * 2 * 2 * 4 * 2 * 2 * 2; combination++) {
        struct filter_options options = test_options();
        int rest = combination;
        options.weights = (enum filter_weights)(rest % 3), rest /= 3;
        options.formula = (enum filter_formula)(rest % 2), rest /= 2;
        options.window = (enum filter_window)(rest % 2), rest /= 2;
        options.radius_step = 1 << rest % 4, rest /= 4;
        options.max_radius_px = rest % 2 ? 5 : 0, rest /= 2;
        options.max_angle_rad = rest % 2 ? 0.1 : options.max_angle_rad, rest /= 2;
        gbuffer.has_eye = rest % 2;
        struct image glossy;
        filter_run(&gbuffer, &options, &glossy, NULL);
        for (int y = 0; y < 36; y++)
            for (int x = 0; x < 48; x++)
                for (int i = 0; i < 3; i++) {
                    double expected = scene_glossy(&gbuffer, x, y) ? (double)(0.1f * (float)(i + 1)) : 0;
                    assert_near(image_row(&glossy, i, y)[x], expected, 1e-6 * expected);
                }
        image_free(&glossy);
    }
    gbuffer_free(&gbuffer);
}

static void filter__weights_of_one__sum_to_the_number_of_taps(void **state)
{
    (void)state;
    for (int window = 0; window < 2; window++)
        for (int limit = 0; limit <= 6; limit++) {
            struct filter_options options = test_options();
            struct gbuffer gbuffer;
            struct image glossy, radius;
            flat_gbuffer(&gbuffer, 41, 37, 10);
            options.window = (enum filter_window)window;
            options.max_radius_px = limit;
            /* One pixel of light: the result is light / taps wherever the window holds it. */
            image_row(&gbuffer.specular, 1, 18)[20] = 1;
            filter_run(&gbuffer, &options, &glossy, &radius);
            int taps = 0;
            double rho = (double)image_row(&radius, 0, 18)[20];
            for (int dy = -18; dy <= 18; dy++)
                for (int dx = -20; dx <= 20; dx++)
                    taps += window ? fmax(abs(dx), abs(dy)) <= rho : dx * dx + dy * dy <= rho * rho;
            assert_true(limit == 0 || fabs(rho - limit) < 1e-6);
            assert_near(image_row(&glossy, 1, 18)[20], 1.0 / taps, limit > 0 ? 1e-8 : 1);
            assert_near(image_row(&glossy, 0, 18)[20], 0, 0);
            if (limit > 0) {
                assert_near(image_row(&glossy, 1, 18)[20 + limit], 1.0 / taps, 1e-8);
                assert_near(image_row(&glossy, 1, 18)[20 + limit + 1], 0, 0);
            }
            image_free(&glossy);
            image_free(&radius);
            gbuffer_free(&gbuffer);
        }
}

static void filter__mirrored_gbuffer__gives_the_mirrored_picture(void **state)
{
    (void)state;
    enum { WIDTH = 53, HEIGHT = 40 };
    struct filter_options options = test_options();
    struct gbuffer gbuffer, mirrored;
    struct image one, other;
    scene_draw(&plain_scene, WIDTH, HEIGHT, 150, &gbuffer);
    gbuffer_alloc(&mirrored, WIDTH, HEIGHT);
    mirrored.has_eye = true;
    mirrored.view_angle = gbuffer.view_angle;
    for (int i = 0; i < 3; i++)
        mirrored.eye[i] = (i == 0 ? -1 : 1) * gbuffer.eye[i];
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            int u = WIDTH - 1 - x;
            for (int i = 0; i < 3; i++) {
                float sign = i == 0 ? -1 : 1;
                image_row(&mirrored.position, i, y)[u] = sign * image_row(&gbuffer.position, i, y)[x];
                image_row(&mirrored.endpoint, i, y)[u] = sign * image_row(&gbuffer.endpoint, i, y)[x];
                image_row(&mirrored.specular, i, y)[u] = image_row(&gbuffer.specular, i, y)[x];
            }
            image_row(&mirrored.endpoint, 3, y)[u] = image_row(&gbuffer.endpoint, 3, y)[x];
            image_row(&mirrored.phong, 0, y)[u] = image_row(&gbuffer.phong, 0, y)[x];
        }
    filter_run(&gbuffer, &options, &one, NULL);
    filter_run(&mirrored, &options, &other, NULL);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_near(image_row(&one, 2, y)[x], image_row(&other, 2, y)[WIDTH - 1 - x], 1e-6);
    image_free(&one);
    image_free(&other);
    gbuffer_free(&gbuffer);
    gbuffer_free(&mirrored);
}

static void filter__formula_max__gives_the_same_picture(void **state)
{
    (void)state;
    for (int weights = 0; weights < 3; weights++) {
        struct filter_options options = test_options();
        options.weights = (enum filter_weights)weights;
        struct gbuffer gbuffer;
        struct image phong, max;
        scene_draw(&plain_scene, 67, 50, 80, &gbuffer);
        filter_run(&gbuffer, &options, &phong, NULL);
        options.formula = FILTER_FORMULA_MAX;
        filter_run(&gbuffer, &options, &max, NULL);
        assert_true(image_same(&phong, &max)); /* twice every weight: a power of two rounds nothing */
        image_free(&phong);
        image_free(&max);
        gbuffer_free(&gbuffer);
    }
}

static void filter__instruction_sets_and_threads__give_the_same_bits(void **state)
{
    (void)state;
    static const float exponents[] = {400, 5};
#ifdef __SANITIZE_THREAD__ /* the wide windows take minutes, by the same code */
    const int exponent_count = 1;
#else
    const int exponent_count = 2;
#endif
    for (int e = 0; e < exponent_count; e++)
        for (int weights = 0; weights < 3; weights++) {
            struct filter_options options = test_options();
            struct gbuffer gbuffer;
            struct image reference, other;
            options.weights = (enum filter_weights)weights;
            options.isa = CPU_ISA_SSE2;
            scene_draw(&plain_scene, 83, 61, exponents[e], &gbuffer);
            filter_run(&gbuffer, &options, &reference, NULL);
            for (int isa = CPU_ISA_AUTO; isa < CPU_ISA_COUNT; isa++) {
                options.isa = (enum cpu_isa)isa;
                if (!cpu_isa_supported(options.isa)) {
                    print_message("# SKIP instruction set %d: this processor lacks it\n", isa);
                    continue;
                }
                for (options.threads = 0; options.threads <= 7; options.threads += 3) {
                    filter_run(&gbuffer, &options, &other, NULL);
                    assert_true(image_same(&reference, &other));
                    image_free(&other);
                }
            }
            image_free(&reference);
            gbuffer_free(&gbuffer);
        }
}

/* --- extremes --- */

static void filter__unusable_pixels__do_not_spread(void **state)
{
    (void)state;
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    for (int value = 0; value < 3; value++)
        for (int plane = 0; plane < 4; plane++)
            for (int weights = 0; weights < 3; weights++) {
                struct filter_options options = test_options();
                struct gbuffer with, without;
                struct image expected, glossy;
                options.weights = (enum filter_weights)weights;
                scene_draw(&plain_scene, 48, 36, 30, &with);
                scene_draw(&plain_scene, 48, 36, 30, &without);
                assert_true(scene_glossy(&with, 24, 25));
                image_row(&without.phong, 0, 25)[24] = 0;
                struct image *planes[] = {&with.specular, &with.position, &with.endpoint, &with.endpoint};
                image_row(planes[plane], plane == 3 ? 3 : 1, 25)[24] = bad[value];
                filter_run(&with, &options, &glossy, NULL);
                filter_run(&without, &options, &expected, NULL);
                assert_true(image_same(&glossy, &expected));
                assert_near(image_row(&glossy, 0, 25)[24], 0, 0);
                image_free(&glossy);
                image_free(&expected);
                gbuffer_free(&with);
                gbuffer_free(&without);
            }
}

static void filter__mirror__is_the_specular_plane(void **state)
{
    (void)state;
    static const float exponents[] = {INFINITY, 1e30f, 1e20f, 1e15f};
    for (int i = 0; i < 4; i++) {
        struct filter_options options = test_options();
        struct gbuffer gbuffer;
        struct image glossy;
        scene_draw(&plain_scene, 67, 50, exponents[i], &gbuffer);
        filter_run(&gbuffer, &options, &glossy, NULL);
        assert_true(exponents[i] < 1e20f || image_same(&glossy, &gbuffer.specular));
        for (int y = 0; y < 50; y++)
            for (int x = 0; x < 67; x++)
                assert_near(image_row(&glossy, 0, y)[x], image_row(&gbuffer.specular, 0, y)[x],
                            options.mode == FILTER_MODE_PAPER ? 0 : 1e-6);
        image_free(&glossy);
        gbuffer_free(&gbuffer);
    }
}

static void filter__exponent_zero_or_nan_in_the_passes__is_not_glossy(void **state)
{
    (void)state;
    static const float exponents[] = {0, -3, NAN};
    for (int i = 0; i < 3; i++) {
        struct filter_options options = test_options();
        struct gbuffer gbuffer;
        struct image glossy;
        flat_gbuffer(&gbuffer, 9, 9, exponents[i]);
        image_row(&gbuffer.specular, 0, 4)[4] = 1;
        options.phong = 10;
        options.phong_override = true;
        filter_run(&gbuffer, &options, &glossy, NULL);
        assert_near(image_row(&glossy, 0, 4)[4], 0, 0);
        image_free(&glossy);
        gbuffer_free(&gbuffer);
    }
}

static void filter__exponent_of_the_options__applies(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image expected, glossy;
    scene_draw(&plain_scene, 67, 50, 40, &gbuffer);
    filter_run(&gbuffer, &options, &expected, NULL);

    /* in place of the passes' own */
    gbuffer_free(&gbuffer);
    scene_draw(&plain_scene, 67, 50, 400, &gbuffer);
    options.phong = 40;
    filter_run(&gbuffer, &options, &glossy, NULL);
    assert_false(image_same(&expected, &glossy));
    image_free(&glossy);
    options.phong_override = true;
    filter_run(&gbuffer, &options, &glossy, NULL);
    assert_true(image_same(&expected, &glossy));
    image_free(&glossy);

    /* where the passes have none, wherever there is an endpoint */
    image_free(&gbuffer.phong);
    options.phong_override = false;
    filter_run(&gbuffer, &options, &glossy, NULL);
    assert_true(image_same(&expected, &glossy));
    image_free(&glossy);

    /* nowhere */
    options.phong = NAN;
    assert_int_equal(filter_glossy(&gbuffer, &options, &glossy, NULL, &err), RESULT_USAGE);
    assert_non_null(strstr(err.text, "--phong"));
    assert_null(glossy.pixels);
    image_free(&expected);
    gbuffer_free(&gbuffer);
}

static void filter__uniform_lobe__is_the_mean_of_the_window(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy;
    flat_gbuffer(&gbuffer, 9, 9, 1);
    image_free(&gbuffer.phong);
    options.phong = 0;
    options.max_radius_px = 2;
    image_row(&gbuffer.specular, 0, 4)[4] = 13; /* the disc of radius 2 has 13 pixels */
    filter_run(&gbuffer, &options, &glossy, NULL);
    assert_near(image_row(&glossy, 0, 4)[3], 1, 1e-6);
    assert_near(image_row(&glossy, 0, 3)[3], 1, 1e-6);
    assert_near(image_row(&glossy, 0, 2)[3], 0, 0);
    image_free(&glossy);
    gbuffer_free(&gbuffer);
}

static void filter__endpoint_on_the_surface__is_the_specular_value(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy, radius;
    flat_gbuffer(&gbuffer, 9, 9, 10);
    for (int i = 0; i < 3; i++) {
        image_row(&gbuffer.endpoint, i, 4)[4] = image_row(&gbuffer.position, i, 4)[4];
        image_row(&gbuffer.specular, i, 4)[4] = 7;
    }
    image_row(&gbuffer.endpoint, 3, 4)[4] = 1;
    for (int step = 1; step <= 4; step *= 4) {
        options.radius_step = step;
        filter_run(&gbuffer, &options, &glossy, &radius);
        assert_near(image_row(&glossy, 0, 4)[4], 7, 0);
        assert_near(image_row(&radius, 0, 4)[4], 0, 0);
        assert_true(isfinite(image_row(&glossy, 0, 4)[5]));
        image_free(&glossy);
        image_free(&radius);
    }
    gbuffer_free(&gbuffer);
}

static void filter__one_pixel_and_hdr_values__are_kept(void **state)
{
    (void)state;
    static const float values[] = {0, 1e-30f, 65504, 1e30f, 1e38f, -1e38f, FLT_MAX, -FLT_MAX};
    for (int i = 0; i < 8; i++) {
        struct filter_options options = test_options();
        struct gbuffer gbuffer;
        struct image glossy;
        flat_gbuffer(&gbuffer, 1, 1, 10);
        image_row(&gbuffer.specular, 0, 0)[0] = values[i];
        filter_run(&gbuffer, &options, &glossy, NULL);
        assert_near(image_row(&glossy, 0, 0)[0], values[i], fabs((double)values[i]) * 1e-6);
        image_free(&glossy);
        gbuffer_free(&gbuffer);

        flat_gbuffer(&gbuffer, 40, 30, 10);
        for (int y = 0; y < 30; y++)
            for (int x = 0; x < 40; x++)
                image_row(&gbuffer.specular, 0, y)[x] = values[i];
        filter_run(&gbuffer, &options, &glossy, NULL);
        assert_near(image_row(&glossy, 0, 15)[20], values[i], fabs((double)values[i]) * 1e-6);
        image_free(&glossy);
        gbuffer_free(&gbuffer);
    }
}

static void filter__wrong_planes__are_refused(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy, radius;
    flat_gbuffer(&gbuffer, 4, 4, 10);
    image_free(&gbuffer.endpoint);
    assert_int_equal(filter_glossy(&gbuffer, &options, &glossy, &radius, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, "endpoint"));
    assert_ok(image_alloc(&gbuffer.endpoint, 4, 5, 4, &err), err);
    assert_int_equal(filter_glossy(&gbuffer, &options, &glossy, &radius, &err), RESULT_DATA);
    assert_null(glossy.pixels);
    assert_null(radius.pixels);
    gbuffer_free(&gbuffer);
}

/* --- the radius --- */

static void filter_radius__with_an_eye__is_equations_4_and_5(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy, radius;
    flat_gbuffer(&gbuffer, 64, 8, 100);
    gbuffer.view_angle = 0.8f;
    gbuffer.eye[1] = 2; /* s = 2 at pixel (0, 0) */
    image_row(&gbuffer.endpoint, 1, 0)[0] = 6;
    image_row(&gbuffer.endpoint, 3, 0)[0] = 2; /* b = (0, 3, 0): r = 3 */
    filter_run(&gbuffer, &options, &glossy, &radius);
    double theta = lobe_half_angle(100, 0.99, 2);
    assert_near(theta, 0.2997, 1e-4); /* acos(0.01^(1/101)) */
    assert_near(image_row(&radius, 0, 0)[0], theta / (1 + 2.0 / 3) * 64 / (double)0.8f, 1e-5);
    assert_near(image_row(&radius, 0, 5)[40], theta * 64 / (double)0.8f, 1e-5); /* a miss */
    image_free(&glossy);
    image_free(&radius);

    options.max_radius_px = 10;
    filter_run(&gbuffer, &options, &glossy, &radius);
    assert_near(image_row(&radius, 0, 5)[40], 10, 0);
    image_free(&glossy);
    image_free(&radius);

    options.max_radius_px = 0;
    gbuffer.view_angle = 1e-6f;
    filter_run(&gbuffer, &options, &glossy, &radius);
    assert_near(image_row(&radius, 0, 5)[40], hypot(64, 8), 1e-4); /* the picture's diagonal */
    image_free(&glossy);
    image_free(&radius);
    gbuffer_free(&gbuffer);
}

static void filter_radius__without_an_eye__is_the_footprint_of_the_directions(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy, radius;
    flat_gbuffer(&gbuffer, 64, 8, 1000);
    gbuffer.has_eye = false;
    /* An orthographic camera over a flat mirror: the endpoints of neighbours are 1 unit apart and 50 away. */
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 64; x++) {
            image_row(&gbuffer.endpoint, 0, y)[x] = (float)x;
            image_row(&gbuffer.endpoint, 1, y)[x] = 50;
            image_row(&gbuffer.endpoint, 2, y)[x] = (float)y;
            image_row(&gbuffer.endpoint, 3, y)[x] = 1;
        }
    filter_run(&gbuffer, &options, &glossy, &radius);
    assert_near(image_row(&radius, 0, 4)[30], lobe_half_angle(1000, 0.99, 2) / atan(1 / 50.0), 1e-4);
    image_free(&glossy);
    image_free(&radius);
    /* A pixel without glossy neighbours sees no gradient. */
    for (int x = 1; x < 64; x++)
        image_row(&gbuffer.phong, 0, 0)[x] = 0;
    image_row(&gbuffer.phong, 0, 1)[0] = 0;
    filter_run(&gbuffer, &options, &glossy, &radius);
    assert_near(image_row(&radius, 0, 0)[0], 0, 0);
    image_free(&glossy);
    image_free(&radius);
    gbuffer_free(&gbuffer);
}

static void filter_radius__at_every_fourth_pixel__is_interpolated_bilinearly(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy, every, fourth;
    flat_gbuffer(&gbuffer, 13, 13, 100);
    for (int y = 0; y < 13; y++)
        for (int x = 0; x < 13; x++) {
            image_row(&gbuffer.endpoint, 1, y)[x] = 1 + 0.1f * (float)(x * y);
            image_row(&gbuffer.endpoint, 3, y)[x] = 1;
        }
    image_row(&gbuffer.phong, 0, 8)[8] = 0;    /* a corner that is not glossy */
    image_row(&gbuffer.phong, 0, 8)[4] = 1000; /* a corner of another exponent */
    filter_run(&gbuffer, &options, &glossy, &every);
    image_free(&glossy);
    options.radius_step = 4;
    filter_run(&gbuffer, &options, &glossy, &fourth);
    const float *top = image_row(&every, 0, 4), *zero = image_row(&every, 0, 0);
    assert_near(image_row(&fourth, 0, 4)[4], (double)top[4], 0);
    assert_near(image_row(&fourth, 0, 1)[2],
                0.75 * 0.5 * (double)(zero[0] + zero[4]) + 0.25 * 0.5 * (double)(top[0] + top[4]), 1e-5);
    /* Of the corners of (5, 6) two are left, with weights 0.75 * 0.5 and 0.25 * 0.5; of (5, 8) none. */
    assert_near(image_row(&fourth, 0, 6)[5], 0.75 * (double)top[4] + 0.25 * (double)top[8], 1e-5);
    assert_near(image_row(&fourth, 0, 8)[5], (double)image_row(&every, 0, 8)[5], 0);
    image_free(&glossy);
    image_free(&every);
    image_free(&fourth);
    gbuffer_free(&gbuffer);
}

/* --- antialiased edges --- */

static void filter__edge_pixels__take_the_nearest_ring(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy;
    flat_gbuffer(&gbuffer, 20, 9, INFINITY);
    assert_ok(image_alloc(&gbuffer.reflectance, 20, 9, 3, &err), err);
    for (int y = 0; y < 9; y++)
        for (int x = 0; x < 20; x++) {
            image_row(&gbuffer.phong, 0, y)[x] = x < 5 ? INFINITY : 0;
            image_row(&gbuffer.specular, 0, y)[x] = x == 4 ? (float)y : 100;
            image_row(&gbuffer.reflectance, 2, y)[x] = x != 6;
        }
    filter_run(&gbuffer, &options, &glossy, NULL);
    assert_near(image_row(&glossy, 0, 3)[4], 3, 0);
    assert_near(image_row(&glossy, 0, 3)[5], 3, 1e-6);               /* mean of 2, 3, 4 */
    assert_near(image_row(&glossy, 0, 0)[5], 0.5, 1e-6);             /* mean of 0, 1 */
    assert_near(image_row(&glossy, 0, 3)[6], 0, 0);                  /* reflects nothing */
    assert_near(image_row(&glossy, 0, 4)[7], 4, 1e-6);               /* 3 pixels away: mean of 1 to 7 */
    assert_near(image_row(&glossy, 0, 4)[8], 0, 0);                  /* too far */
    image_free(&glossy);
    gbuffer_free(&gbuffer);
}

/* --- signals: last, for the flag stays --- */

static void filter__signal__stops_all_threads(void **state)
{
    (void)state;
    struct filter_options options = test_options();
    struct gbuffer gbuffer;
    struct image glossy, radius;
    flat_gbuffer(&gbuffer, 40, 30, 10);
    interrupt_install();
    raise(SIGTERM);
    options.threads = 3;
    assert_int_equal(filter_glossy(&gbuffer, &options, &glossy, &radius, &err), RESULT_INTERRUPTED);
    assert_null(glossy.pixels);
    assert_null(radius.pixels);
    gbuffer_free(&gbuffer);
}

/* A test of the paper's filter that holds for the best one, too. */
#define BEST_TOO(test) {#test " (best)", test, setup_best, teardown_best, NULL}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filter__exact_weights__match_the_oracle),
        cmocka_unit_test(filter__table_weights__match_the_oracle),
        cmocka_unit_test(filter__gauss_weights__match_the_oracle),
        cmocka_unit_test(filter__square_window__matches_the_oracle),
        cmocka_unit_test(filter__widths_1_to_67__match_the_oracle),
        cmocka_unit_test(filter__exponent_of_each_pixel__matches_the_oracle),
        cmocka_unit_test(filter__homogeneous_scale_of_the_endpoint__does_not_matter),
        cmocka_unit_test(filter__lengths_1e_minus_24_to_1e24__give_one_picture),
        cmocka_unit_test(filter__very_far_endpoint__is_a_direction),
        {"filter_best__sums__match_the_oracle", filter_best__sums__match_the_oracle, setup_best, teardown_best, NULL},
        {"filter_best__widths_1_to_67__match_the_oracle", filter_best__widths_1_to_67__match_the_oracle, setup_best,
         teardown_best, NULL},
        cmocka_unit_test(filter_best__wall_across_the_lobe__is_seen_in_full),
        cmocka_unit_test(filter_best__density__weighs_near_things_by_their_solid_angle),
        cmocka_unit_test(filter_best__fit__goes_on_with_a_slope_beyond_the_border),
        cmocka_unit_test(filter_best__fit__expects_no_lamp_where_nothing_is_seen),
        cmocka_unit_test(filter_best__ray_of_another_mirror_that_ends_at_a__does_not_fill_the_lobe),
        cmocka_unit_test(filter_best__what_a_near_wall_hides__is_not_seen),
        BEST_TOO(filter__homogeneous_scale_of_the_endpoint__does_not_matter),
        BEST_TOO(filter__constant_radiance__stays_constant_with_every_option),
        BEST_TOO(filter__mirrored_gbuffer__gives_the_mirrored_picture),
        BEST_TOO(filter__instruction_sets_and_threads__give_the_same_bits),
        BEST_TOO(filter__unusable_pixels__do_not_spread),
        BEST_TOO(filter__mirror__is_the_specular_plane),
        BEST_TOO(filter__exponent_zero_or_nan_in_the_passes__is_not_glossy),
        BEST_TOO(filter__exponent_of_the_options__applies),
        BEST_TOO(filter__one_pixel_and_hdr_values__are_kept),
        BEST_TOO(filter__wrong_planes__are_refused),
        BEST_TOO(filter__edge_pixels__take_the_nearest_ring),
        cmocka_unit_test(filter__constant_radiance__stays_constant_with_every_option),
        cmocka_unit_test(filter__weights_of_one__sum_to_the_number_of_taps),
        cmocka_unit_test(filter__mirrored_gbuffer__gives_the_mirrored_picture),
        cmocka_unit_test(filter__formula_max__gives_the_same_picture),
        cmocka_unit_test(filter__instruction_sets_and_threads__give_the_same_bits),
        cmocka_unit_test(filter__unusable_pixels__do_not_spread),
        cmocka_unit_test(filter__mirror__is_the_specular_plane),
        cmocka_unit_test(filter__exponent_zero_or_nan_in_the_passes__is_not_glossy),
        cmocka_unit_test(filter__exponent_of_the_options__applies),
        cmocka_unit_test(filter__uniform_lobe__is_the_mean_of_the_window),
        cmocka_unit_test(filter__endpoint_on_the_surface__is_the_specular_value),
        cmocka_unit_test(filter__one_pixel_and_hdr_values__are_kept),
        cmocka_unit_test(filter__wrong_planes__are_refused),
        cmocka_unit_test(filter_radius__with_an_eye__is_equations_4_and_5),
        cmocka_unit_test(filter_radius__without_an_eye__is_the_footprint_of_the_directions),
        cmocka_unit_test(filter_radius__at_every_fourth_pixel__is_interpolated_bilinearly),
        cmocka_unit_test(filter__edge_pixels__take_the_nearest_ring),
        cmocka_unit_test(filter__signal__stops_all_threads),
    };
    cmocka_set_test_filter(getenv("TESTS"));
    return cmocka_run_group_tests_name("filter", tests, NULL, NULL);
}
