/* Probes under skies whose blurred reflection is known in closed form: what POV-Ray would see is computed here. */
#include "probe.h"

#include "gloss_support.h"

static struct error err;
static const double pi = 3.14159265358979323846;

/* Radiance from a direction; the vector is the sky's own. */
typedef double sky(const double direction[3], const double vector[3]);

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double uniform(const double direction[3], const double vector[3])
{
    (void)direction;
    return vector[0];
}

/* 1 on the vector's side. */
static double half(const double direction[3], const double vector[3])
{
    return dot(direction, vector) > 0;
}

static double gradient(const double direction[3], const double vector[3])
{
    return dot(direction, vector);
}

static double height(const double direction[3], const double vector[3])
{
    (void)vector;
    return direction[1];
}

static double holed(const double direction[3], const double vector[3])
{
    return direction[1] > 0 ? vector[0] : 1000;
}

static double too_bright(const double direction[3], const double vector[3])
{
    (void)direction;
    (void)vector;
    return INFINITY;
}

/* A floor y = 0 under nothing but sky. The eye's rays come down by `steepness` radians in the plane z = 0; one pixel
 * more to the right is one unit more of x. */
static void make_floor(struct gbuffer *gbuffer, int width, int height_px, double steepness, float phong)
{
    gbuffer_alloc(gbuffer, width, height_px);
    assert_ok(image_alloc(&gbuffer->direction, width, height_px, 3, &err), err);
    assert_ok(image_alloc(&gbuffer->mirrored, width, height_px, 3, &err), err);
    for (int y = 0; y < height_px; y++)
        for (int x = 0; x < width; x++) {
            image_row(&gbuffer->position, 0, y)[x] = (float)x;
            image_row(&gbuffer->position, 2, y)[x] = (float)y;
            image_row(&gbuffer->direction, 0, y)[x] = (float)cos(steepness);
            image_row(&gbuffer->direction, 1, y)[x] = (float)-sin(steepness);
            image_row(&gbuffer->mirrored, 0, y)[x] = (float)cos(steepness);
            image_row(&gbuffer->mirrored, 1, y)[x] = (float)sin(steepness);
            image_row(&gbuffer->specular, 0, y)[x] = 0.25f;
            image_row(&gbuffer->phong, 0, y)[x] = phong;
        }
}

/* What POV-Ray makes of the last view: every row of faces comes one row late. */
static void render(const struct probes *probes, sky *of, const double vector[3], struct image *image)
{
    long rays = probes->rays - probes->rays_before;
    for (int i = 0; i < probes->viewed_count; i++) {
        const struct probe *probe = &probes->list[probes->viewed[i]];
        for (long face = 0; face < rays; face++) {
            double ray[3], direction[3];
            long pixel = PROBE_VIEW_WIDTH + i * rays + face;
            probes_ray(probes, probe, face, ray);
            for (int axis = 0; axis < 3; axis++)
                direction[axis] = ray[0] * probe->across[axis] + ray[1] * probe->up[axis] + ray[2] * probe->axis[axis];
            double along = 2 * dot(direction, probe->normal);
            for (int axis = 0; axis < 3; axis++)
                direction[axis] -= along * probe->normal[axis];
            for (int channel = 0; channel < 3; channel++)
                image_row(image, channel, (int)(pixel / image->width))[pixel % image->width] =
                    (float)of(direction, vector);
        }
    }
}

static void measure(const struct gbuffer *gbuffer, const struct probe_options *options, sky *of, const double vector[3],
                    struct probes *probes)
{
    assert_ok(probes_begin(probes, gbuffer, options, &err), err);
    while (probes_left(probes)) {
        struct buffer text = {0};
        struct image image;
        int width, rows;
        assert_ok(probes_view(probes, &text, &width, &rows, &err), err);
        assert_ok(image_alloc(&image, width, rows, 3, &err), err);
        render(probes, of, vector, &image);
        assert_ok(probes_take(probes, &image, &err), err);
        image_free(&image);
        buffer_free(&text);
    }
}

/* One probe's value. */
static struct probe measure_one(double steepness, double phong, double error, sky *of, const double vector[3])
{
    struct gbuffer gbuffer;
    struct probes probes;
    make_floor(&gbuffer, 1, 1, steepness, (float)phong);
    measure(&gbuffer, &(struct probe_options){.grid = 1, .error = error}, of, vector, &probes);
    assert_int_equal(probes.count, 1);
    struct probe probe = probes.list[0];
    probes_free(&probes);
    gbuffer_free(&gbuffer);
    return probe;
}

static void probe__uniform_sky__its_radiance(void **state)
{
    (void)state;
    static const double phongs[] = {1e-6, 1, 30, 1e6, 1e20};
    for (int i = 0; i < 5; i++)
        for (double steepness = 0.05; steepness < 1.6; steepness += 0.3) {
            struct probe probe = measure_one(steepness, phongs[i], 1e-3, uniform, (double[3]){0.7});
            assert_near(probe.value[1], 0.7, 1e-6);
            assert_near(probe.error, 0, 1e-6);
            assert_int_equal(probe.x, 0);
            assert_near(probe.specular[0], 0.25, 0);
        }
}

/* The half space is tilted by an angle from the plane through the mirror direction: for p = 1 the lit part of the lobe
 * is a half disc and a half ellipse (Nusselt), (1 + sin angle)/2 of it; for p = 0 a lune. Seen straight from above, so
 * that no direction lies below the horizon. */
static void probe__half_black_half_white_sky__the_share_of_the_white(void **state)
{
    (void)state;
    for (double angle = -1.5; angle < 1.6; angle += 0.25) {
        const double towards[3] = {cos(angle), sin(angle), 0};
        struct probe cosine = measure_one(pi / 2, 1, 2e-3, half, towards);
        struct probe even = measure_one(pi / 2, 1e-7, 2e-3, half, towards);
        assert_near(cosine.value[0], (1 + sin(angle)) / 2, 3e-3);
        assert_near(even.value[0], 0.5 + angle / pi, 3e-3);
    }
    for (double phong = 3; phong < 1e7; phong *= 10)
        assert_near(measure_one(pi / 2, phong, 1e-3, half, (double[]){1, 0, 0.3}).value[2], 0.5, 1.5e-3);
}

/* The mean of d.v over the lobe is m.v (p + 1)/(p + 2). */
static void probe__gradient__shrinks_with_the_lobe(void **state)
{
    (void)state;
    const double v[3] = {0.2, 0.9, 0.1};
    for (double phong = 1; phong < 1e7; phong *= 7)
        assert_near(measure_one(pi / 2, phong, 3e-4, gradient, v).value[0], 0.9 * (phong + 1) / (phong + 2), 5e-4);
}

/* What lies between the horizon and the lobe's own end is a lune of the angle 90 degrees + steepness: its solid angle
 * is pi + 2 steepness, and its projection on the floor (1 + sin)/2 of the disc. */
static void probe__wide_lobe__cut_at_the_horizon(void **state)
{
    (void)state;
    for (double steepness = 0.1; steepness < 1.6; steepness += 0.2) {
        struct probe probe = measure_one(steepness, 1e-7, 1e-3, height, NULL);
        assert_near(probe.value[0], pi * (1 + sin(steepness)) / 2 / (pi + 2 * steepness), 1.5e-3);
        assert_near(probe.above, 0.5 + steepness / pi, 2e-3);
        assert_near(measure_one(steepness, 3, 1e-3, holed, (double[3]){0.4}).value[0], 0.4, 1e-6);
    }
}

static void probe__infinite_exponent__the_mirror_direction_alone(void **state)
{
    (void)state;
    struct probe probe = measure_one(0.4, (double)INFINITY, 1e-3, gradient, (double[]){0.3, 0.7, 0.1});
    assert_near(probe.value[0], 0.3 * cos(0.4) + 0.7 * sin(0.4), 1e-6);
    assert_near(probe.error, 0, 1e-6);
    assert_int_equal(probe.samples, PROBE_FIRST_RAYS);
}

static void probe__infinite_radiance__the_largest_half_float(void **state)
{
    (void)state;
    assert_near(measure_one(0.4, 10, 1e-3, too_bright, NULL).value[0], 65504, 0.1);
}

/* With a lobe that is cut in two the stated interval holds the truth 95 times in 100: of 300 seeds at least 90 %, at
 * all steps of refinement. */
static void probe__stated_error__holds_the_truth(void **state)
{
    (void)state;
    const double angle = 0.02, towards[3] = {cos(angle), sin(angle), 0}, truth = (1 + sin(angle)) / 2;
    static const double errors[] = {1, 6e-3};
    for (int i = 0; i < 2; i++) {
        int held = 0, count = 300;
        double squares = 0, stated = 0;
        for (int seed = 0; seed < count; seed++) {
            struct gbuffer gbuffer;
            struct probes probes;
            make_floor(&gbuffer, 1, 1, pi / 2, 1);
            measure(&gbuffer, &(struct probe_options){.grid = 1, .error = errors[i], .seed = seed}, half, towards,
                    &probes);
            double off = probes.list[0].value[0] - truth;
            assert_true(probes.list[0].error <= errors[i]);
            held += fabs(off) <= probes.list[0].error;
            squares += off * off;
            stated += probes.list[0].error * probes.list[0].error;
            probes_free(&probes);
            gbuffer_free(&gbuffer);
        }
        if (held < 0.9 * count || squares * 9 < stated)
            fail_msg("error %g: %d of %d held, off by %g, stated %g", errors[i], held, count, sqrt(squares / count),
                     sqrt(stated / count));
    }
}

static void probe__small_error__more_rays(void **state)
{
    (void)state;
    const double towards[3] = {1, 0.02, 0.03};
    struct probe coarse = measure_one(pi / 2, 10, 1, half, towards);
    struct probe fine = measure_one(pi / 2, 10, 1e-3, half, towards);
    struct probe finest = measure_one(pi / 2, 10, 1e-6, half, towards);
    assert_int_equal(coarse.samples, PROBE_FIRST_RAYS);
    assert_in_range(fine.samples, 4 * PROBE_FIRST_RAYS, PROBE_MOST_RAYS / 4);
    assert_int_equal(finest.samples, PROBE_MOST_RAYS);
    assert_true(finest.error < fine.error && fine.error <= 1e-3);
    assert_true(finest.error > 1e-6);
}

/* Of values above 1 the error is relative. */
static void probe__bright_sky__relative_error(void **state)
{
    (void)state;
    struct probe probe = measure_one(pi / 2, 2, 0.01, gradient, (double[]){500, 100, 15});
    assert_true(probe.error > 0.01 && probe.error <= 0.01 * probe.value[0]);
}

/* Every box 2^-i by 2^-j holds one point of the first 2^(i+j) of a set: a (0, 2)-sequence. */
static void probe_ray__each_set__stratified(void **state)
{
    (void)state;
    enum { LOG = 6, COUNT = 1 << LOG };
    const double phong = 3;
    for (int set = 0; set < PROBE_SETS; set++)
        for (int i = 0; i <= LOG; i++) {
            int held[COUNT] = {0};
            for (int point = 0; point < COUNT; point++) {
                double ray[3];
                probe_ray(phong, 5, (long)point * PROBE_SETS + set, ray);
                assert_near(dot(ray, ray), 1, 1e-12);
                double u = pow(ray[2], phong + 1), v = atan2(ray[1], ray[0]) / (2 * pi);
                v += v < 0;
                int column = (int)(u * (1 << i)), row = (int)(v * (1 << (LOG - i)));
                held[(column << (LOG - i)) + row]++;
            }
            for (int box = 0; box < COUNT; box++)
                assert_int_equal(held[box], 1);
        }
}

static void probes_begin__grid__glossy_centres_of_its_cells(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct probes probes;
    make_floor(&gbuffer, 40, 20, 0.5, 100);
    image_row(&gbuffer.phong, 0, 5)[25] = 0;
    assert_ok(probes_begin(&probes, &gbuffer, &(struct probe_options){.grid = 4, .error = 1}, &err), err);
    assert_int_equal(probes.count, 7);
    assert_int_equal(probes.list[0].x, 5);
    assert_int_equal(probes.list[0].y, 5);
    assert_int_equal(probes.list[2].x, 35);
    assert_int_equal(probes.list[6].x, 35);
    assert_int_equal(probes.list[6].y, 15);
    assert_near(probes.list[6].phong, 100, 0);
    probes_free(&probes);
    assert_ok(probes_begin(&probes, &gbuffer, &(struct probe_options){.grid = 1000, .error = 1}, &err), err);
    assert_int_equal(probes.count, 40 * 20 - 1);
    probes_free(&probes);
    for (int y = 0; y < 20; y++)
        for (int x = 0; x < 40; x++)
            image_row(&gbuffer.phong, 0, y)[x] = 0;
    const struct probe_options options = {.grid = 4, .error = 1};
    assert_int_equal(probes_begin(&probes, &gbuffer, &options, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, "--grid above 4"));
    probes_free(&probes);
    gbuffer_free(&gbuffer);
}

static void probes__several_exponents__each_at_every_pixel(void **state)
{
    (void)state;
    static const double exponents[] = {1000, 3};
    struct gbuffer gbuffer;
    struct probes probes;
    make_floor(&gbuffer, 4, 2, pi / 2, 100);
    measure(&gbuffer,
            &(struct probe_options){.grid = 4, .error = 1e-3, .exponents = exponents, .exponent_count = 2}, gradient,
            (double[]){0.1, 1, 0}, &probes);
    assert_int_equal(probes.count, 16);
    for (int i = 0; i < 16; i++) {
        double phong = i < 8 ? 3 : 1000;
        assert_near(probes.list[i].phong, phong, 0);
        assert_int_equal(probes.list[i].y * 4 + probes.list[i].x, i % 8);
        assert_near(probes.list[i].value[0], (phong + 1) / (phong + 2), 1.5e-3);
    }
    probes_free(&probes);
    gbuffer_free(&gbuffer);
}

/* More probes than one image holds: several views, in which none is left out. */
static void probes__more_than_one_view__all_measured(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct probes probes;
    make_floor(&gbuffer, 90, 90, 0.8, 20);
    assert_ok(probes_begin(&probes, &gbuffer, &(struct probe_options){.grid = 90, .error = 1}, &err), err);
    int views = 0;
    while (probes_left(&probes)) {
        struct buffer text = {0};
        struct image image;
        int width, rows;
        assert_ok(probes_view(&probes, &text, &width, &rows, &err), err);
        assert_true((long)width * (rows - 1) <= PROBE_VIEW_RAYS);
        assert_ok(image_alloc(&image, width, rows, 3, &err), err);
        render(&probes, uniform, (double[3]){0.5}, &image);
        assert_ok(probes_take(&probes, &image, &err), err);
        image_free(&image);
        buffer_free(&text);
        views++;
    }
    assert_int_equal(views, 6);
    for (int i = 0; i < probes.count; i++)
        assert_near(probes.list[i].value[0], 0.5, 1e-6);
    assert_int_equal(probes_open(&probes), 0);
    probes_free(&probes);
    gbuffer_free(&gbuffer);
}

static void probe__fixed_rays__no_more_and_no_fewer(void **state)
{
    (void)state;
    static const int rays[] = {1, 7, 100};
    for (int i = 0; i < 3; i++) {
        struct gbuffer gbuffer;
        struct probes probes;
        double sum = 0;
        make_floor(&gbuffer, 40, 40, pi / 2, 1);
        measure(&gbuffer, &(struct probe_options){.grid = 40, .error = 1e-6, .rays = rays[i]}, half,
                (double[]){1, 0, 0}, &probes);
        assert_int_equal(probes.count, 1600);
        for (int j = 0; j < probes.count; j++) {
            assert_int_equal(probes.list[j].samples, rays[i]);
            sum += probes.list[j].value[0];
        }
        assert_near(sum / probes.count, 0.5, 2 / sqrt(1600.0 * rays[i]));
        probes_free(&probes);
        gbuffer_free(&gbuffer);
    }
}

/* A probe's value is at its pixel; a pixel beside glossy ones, at a silhouette, has their mean; others are black. */
static void probes_image__silhouettes__mean_of_the_probes_around(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct probes probes;
    struct image image;
    make_floor(&gbuffer, 6, 1, 1, 50);
    for (int x = 2; x < 6; x++)
        image_row(&gbuffer.phong, 0, 0)[x] = x == 4 ? 50 : 0;
    measure(&gbuffer, &(struct probe_options){.grid = 6, .rays = 16}, uniform, (double[3]){1}, &probes);
    assert_int_equal(probes.count, 3);
    for (int i = 0; i < 3; i++)
        probes.list[i].value[2] = 1 + probes.list[i].x;
    assert_ok(probes_image(&probes, &gbuffer, &image, &err), err);
    static const float blue[] = {1, 2, 2, 5, 5, 5};
    for (int x = 0; x < 6; x++)
        assert_near(image_row(&image, 2, 0)[x], blue[x], 1e-6);
    image_free(&image);
    probes_free(&probes);
    gbuffer_free(&gbuffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probe__uniform_sky__its_radiance),
        cmocka_unit_test(probe__half_black_half_white_sky__the_share_of_the_white),
        cmocka_unit_test(probe__gradient__shrinks_with_the_lobe),
        cmocka_unit_test(probe__wide_lobe__cut_at_the_horizon),
        cmocka_unit_test(probe__infinite_exponent__the_mirror_direction_alone),
        cmocka_unit_test(probe__infinite_radiance__the_largest_half_float),
        cmocka_unit_test(probe__stated_error__holds_the_truth),
        cmocka_unit_test(probe__small_error__more_rays),
        cmocka_unit_test(probe__bright_sky__relative_error),
        cmocka_unit_test(probe__fixed_rays__no_more_and_no_fewer),
        cmocka_unit_test(probes_image__silhouettes__mean_of_the_probes_around),
        cmocka_unit_test(probe_ray__each_set__stratified),
        cmocka_unit_test(probes_begin__grid__glossy_centres_of_its_cells),
        cmocka_unit_test(probes__several_exponents__each_at_every_pixel),
        cmocka_unit_test(probes__more_than_one_view__all_measured),
    };
    return cmocka_run_group_tests_name("probe", tests, NULL, NULL);
}
