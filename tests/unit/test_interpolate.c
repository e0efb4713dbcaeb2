/* Bilinear samples worked out by hand, glossy edges, misses among positions. */
#include "interpolate.h"

#include "gloss_support.h"

/* A gbuffer of samples, all glossy with exponent 100, endpoints at W = 1; the reflectance of the full size is 1. */
static struct gbuffer make(int samples_x, int samples_y, int width, int height)
{
    struct gbuffer gbuffer;
    struct error err;
    gbuffer_alloc(&gbuffer, samples_x, samples_y);
    assert_ok(image_alloc(&gbuffer.reflectance, width, height, 3, &err), err);
    for (int y = 0; y < samples_y; y++)
        for (int x = 0; x < samples_x; x++) {
            image_row(&gbuffer.phong, 0, y)[x] = 100;
            image_row(&gbuffer.endpoint, 3, y)[x] = 1;
        }
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int channel = 0; channel < 3; channel++)
                image_row(&gbuffer.reflectance, channel, y)[x] = 1;
    return gbuffer;
}

static void set(struct image *image, int x, int y, const float *values)
{
    for (int channel = 0; channel < image->channels; channel++)
        image_row(image, channel, y)[x] = values[channel];
}

static void assert_pixel(const struct image *image, int x, int y, const double *values)
{
    for (int channel = 0; channel < image->channels; channel++)
        assert_near(image_row(image, channel, y)[x], values[channel], 1e-6 * (1 + fabs(values[channel])));
}

static void interpolate(struct gbuffer *gbuffer)
{
    struct error err;
    assert_ok(interpolate_gbuffer(gbuffer, &err), err);
}

/* Specular values 1 2 / 3 4 (times 1, 10, 100) at the four samples. */
static struct gbuffer make_four(void)
{
    struct gbuffer gbuffer = make(2, 2, 4, 4);
    for (int i = 0; i < 4; i++) {
        float value = (float)i + 1;
        set(&gbuffer.specular, i % 2, i / 2, (float[]){value, 10 * value, 100 * value});
        set(&gbuffer.position, i % 2, i / 2, (float[]){-value, value, 0.5f * value});
        set(&gbuffer.endpoint, i % 2, i / 2, (float[]){2 * value, -value, 7, 1});
    }
    return gbuffer;
}

static void interpolate__four_samples__bilinear(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make_four();
    interpolate(&gbuffer);
    /* Pixel (1, 1) lies at (0.25, 0.25) between the samples: 9/16, 3/16, 3/16, 1/16. */
    double inner = 9 / 16.0 * 1 + 3 / 16.0 * 2 + 3 / 16.0 * 3 + 1 / 16.0 * 4;
    assert_pixel(&gbuffer.specular, 1, 1, (double[]){inner, 10 * inner, 100 * inner});
    assert_pixel(&gbuffer.position, 1, 1, (double[]){-inner, inner, 0.5 * inner});
    assert_pixel(&gbuffer.endpoint, 1, 1, (double[]){2 * inner, -inner, 7, 1});
    /* (2, 1) at (0.75, 0.25). */
    double right = 3 / 16.0 * 1 + 9 / 16.0 * 2 + 1 / 16.0 * 3 + 3 / 16.0 * 4;
    assert_pixel(&gbuffer.specular, 2, 1, (double[]){right, 10 * right, 100 * right});
    /* Outside the outermost samples: the corner has one sample, the edge two. */
    assert_pixel(&gbuffer.specular, 0, 0, (double[]){1, 10, 100});
    assert_pixel(&gbuffer.specular, 3, 3, (double[]){4, 40, 400});
    double edge = 0.75 * 1 + 0.25 * 3;
    assert_pixel(&gbuffer.specular, 0, 1, (double[]){edge, 10 * edge, 100 * edge});
    gbuffer_free(&gbuffer);
}

static void interpolate__a_sample_not_glossy__others_normalised(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make_four();
    image_row(&gbuffer.phong, 0, 0)[1] = 0;
    interpolate(&gbuffer);
    double mean = (9 * 1 + 3 * 3 + 1 * 4) / 13.0;
    assert_pixel(&gbuffer.specular, 1, 1, (double[]){mean, 10 * mean, 100 * mean});
    assert_pixel(&gbuffer.endpoint, 1, 1, (double[]){2 * mean, -mean, 7, 1});
    gbuffer_free(&gbuffer);
}

static void interpolate__only_a_farther_sample__taken_alone(void **state)
{
    (void)state;
    for (int down = 0; down < 2; down++) {
        struct gbuffer gbuffer = down ? make(1, 6, 1, 12) : make(6, 1, 12, 1);
        for (int n = 0; n < 6; n++) {
            image_row(&gbuffer.phong, 0, down ? n : 0)[down ? 0 : n] = n == 3 ? 50 : 0;
            set(&gbuffer.specular, down ? 0 : n, down ? n : 0, (float[]){(float)n, 0, 0});
        }
        interpolate(&gbuffer);
        /* Pixel 3 lies at sample 1.25: the four samples around are 0 to 3. Pixel 2 lies at 0.75: -1 to 2, none is glossy.
         * From the other side: pixel 10 at 4.75 has 3 to 6, pixel 11 at 5.25 has 4 to 7. */
        static const bool glossy[12] = {[3] = true, [4] = true, [5] = true, [6] = true, [7] = true,
                                        [8] = true, [9] = true, [10] = true};
        for (int n = 0; n < 12; n++) {
            int x = down ? 0 : n, y = down ? n : 0;
            assert_near(image_row(&gbuffer.phong, 0, y)[x], glossy[n] ? 50 : 0, 0);
            assert_near(image_row(&gbuffer.specular, 0, y)[x], glossy[n] ? 3 : 0, 0);
            assert_near(image_row(&gbuffer.endpoint, 3, y)[x], glossy[n] ? 1 : 0, 0);
        }
        gbuffer_free(&gbuffer);
    }
}

static void interpolate__two_farther_samples__nearest(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make(4, 4, 4, 4);
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 4; x++) {
            image_row(&gbuffer.phong, 0, y)[x] = 0;
            set(&gbuffer.specular, x, y, (float[]){(float)(10 * y + x), 0, 0});
        }
    image_row(&gbuffer.phong, 0, 3)[3] = 7; /* sqrt(8) from pixel (1, 1) */
    image_row(&gbuffer.phong, 0, 0)[2] = 5; /* sqrt(2) */
    interpolate(&gbuffer);
    assert_near(image_row(&gbuffer.specular, 0, 1)[1], 2, 0);
    assert_near(image_row(&gbuffer.phong, 0, 1)[1], 5, 0);
    gbuffer_free(&gbuffer);
}

static void interpolate__no_reflectance__not_glossy(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make_four();
    for (int channel = 0; channel < 3; channel++)
        image_row(&gbuffer.reflectance, channel, 1)[1] = 0;
    image_row(&gbuffer.reflectance, 0, 1)[2] = image_row(&gbuffer.reflectance, 1, 1)[2] = 0; /* blue is left */
    image_row(&gbuffer.reflectance, 1, 2)[2] = image_row(&gbuffer.reflectance, 2, 2)[2] = 0; /* red is left */
    interpolate(&gbuffer);
    assert_near(image_row(&gbuffer.phong, 0, 1)[1], 0, 0);
    assert_pixel(&gbuffer.endpoint, 1, 1, (double[]){0, 0, 0, 0});
    assert_pixel(&gbuffer.specular, 1, 1, (double[]){0, 0, 0});
    assert_pixel(&gbuffer.position, 1, 1, (double[]){0, 0, 0});
    assert_near(image_row(&gbuffer.phong, 0, 1)[2], 100, 0);
    assert_near(image_row(&gbuffer.phong, 0, 2)[2], 100, 0);
    gbuffer_free(&gbuffer);
}

static void interpolate__miss_among_positions__mean_of_unit_directions(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make(2, 1, 4, 1);
    set(&gbuffer.position, 0, 0, (float[]){1, 1, 1});
    set(&gbuffer.endpoint, 0, 0, (float[]){1, 31, 41, 1}); /* from a: (0, 0.6, 0.8) */
    set(&gbuffer.position, 1, 0, (float[]){5, 5, 5});
    set(&gbuffer.endpoint, 1, 0, (float[]){1, 0, 0, 0});
    interpolate(&gbuffer);
    /* Pixel 1: 3/4 of the first, 1/4 of the second: (0.25, 0.45, 0.6) of length sqrt(0.625). */
    double length = sqrt(0.625);
    assert_pixel(&gbuffer.endpoint, 1, 0, (double[]){0.25 / length, 0.45 / length, 0.6 / length, 0});
    assert_pixel(&gbuffer.position, 1, 0, (double[]){2, 2, 2});
    assert_pixel(&gbuffer.endpoint, 0, 0, (double[]){1, 31, 41, 1});
    assert_pixel(&gbuffer.endpoint, 3, 0, (double[]){1, 0, 0, 0});
    gbuffer_free(&gbuffer);
}

static void interpolate__opposite_directions__no_nan(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make(2, 1, 3, 1);
    set(&gbuffer.endpoint, 0, 0, (float[]){0, 1, 0, 0});
    set(&gbuffer.endpoint, 1, 0, (float[]){0, -1, 0, 0});
    interpolate(&gbuffer);
    assert_pixel(&gbuffer.endpoint, 1, 0, (double[]){0, 0, 0, 0});
    gbuffer_free(&gbuffer);
}

static void interpolate__endpoint_on_its_own_surface__no_nan(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make(2, 1, 4, 1);
    set(&gbuffer.position, 0, 0, (float[]){1, 2, 3});
    set(&gbuffer.endpoint, 0, 0, (float[]){1, 2, 3, 1}); /* b = a has no direction */
    set(&gbuffer.endpoint, 1, 0, (float[]){0, 0, 1, 0});
    interpolate(&gbuffer);
    assert_pixel(&gbuffer.endpoint, 1, 0, (double[]){0, 0, 1, 0});
    gbuffer_free(&gbuffer);
}

static void interpolate__several_exponents__nearest_not_mixed(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make(2, 2, 4, 4);
    static const float exponents[] = {10, 200, 3000, INFINITY};
    for (int i = 0; i < 4; i++)
        image_row(&gbuffer.phong, 0, i / 2)[i % 2] = exponents[i];
    interpolate(&gbuffer);
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 4; x++)
            assert_true(image_row(&gbuffer.phong, 0, y)[x] == exponents[y / 2 * 2 + x / 2]);
    gbuffer_free(&gbuffer);
}

static void interpolate__sample_of_every_pixel__unchanged(void **state)
{
    (void)state;
    struct gbuffer gbuffer = make(5, 3, 5, 3);
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 5; x++)
            set(&gbuffer.specular, x, y, (float[]){(float)(x * x), (float)y, (float)(x + y)});
    interpolate(&gbuffer);
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 5; x++)
            assert_pixel(&gbuffer.specular, x, y, (double[]){x * x, y, x + y});
    gbuffer_free(&gbuffer);
}

/* A linear function of the pixel's place comes back between the outermost samples; sizes needn't be multiples. */
static void interpolate__linear_planes__reproduced(void **state)
{
    (void)state;
    static const int sizes[][4] = {{4, 3, 16, 12}, {5, 4, 11, 9}, {1, 5, 3, 20}, {6, 1, 24, 4}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        int samples_x = sizes[i][0], samples_y = sizes[i][1], width = sizes[i][2], height = sizes[i][3];
        double step_x = (double)width / samples_x, step_y = (double)height / samples_y;
        struct gbuffer gbuffer = make(samples_x, samples_y, width, height);
        for (int y = 0; y < samples_y; y++)
            for (int x = 0; x < samples_x; x++)
                set(&gbuffer.specular, x, y,
                    (float[]){(float)((x + 0.5) * step_x), (float)((y + 0.5) * step_y), 1});
        interpolate(&gbuffer);
        assert_int_equal(gbuffer.specular.width, width);
        assert_int_equal(gbuffer.endpoint.height, height);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                double u = fmin(fmax(x + 0.5, step_x / 2), width - step_x / 2);
                double v = fmin(fmax(y + 0.5, step_y / 2), height - step_y / 2);
                for (int channel = 0; channel < 3; channel++)
                    assert_near(image_row(&gbuffer.specular, channel, y)[x], channel == 0 ? u : channel == 1 ? v : 1,
                                1e-5);
            }
        gbuffer_free(&gbuffer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interpolate__four_samples__bilinear),
        cmocka_unit_test(interpolate__a_sample_not_glossy__others_normalised),
        cmocka_unit_test(interpolate__only_a_farther_sample__taken_alone),
        cmocka_unit_test(interpolate__two_farther_samples__nearest),
        cmocka_unit_test(interpolate__no_reflectance__not_glossy),
        cmocka_unit_test(interpolate__miss_among_positions__mean_of_unit_directions),
        cmocka_unit_test(interpolate__opposite_directions__no_nan),
        cmocka_unit_test(interpolate__endpoint_on_its_own_surface__no_nan),
        cmocka_unit_test(interpolate__several_exponents__nearest_not_mixed),
        cmocka_unit_test(interpolate__sample_of_every_pixel__unchanged),
        cmocka_unit_test(interpolate__linear_planes__reproduced),
    };
    return cmocka_run_group_tests_name("interpolate", tests, NULL, NULL);
}
