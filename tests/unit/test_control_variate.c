/* The correction of a filtered reflection by further rays. */
#include "control_variate.h"
#include "gloss_support.h"

static struct error err;

enum { WIDTH = 40, HEIGHT = 30 };

/* Points of a plane that mirror a wall 5 away, p = 100; a filtered value of 1; 4 rays a pixel whose mean is 1.25. */
static void make(struct gbuffer *gbuffer, struct image *glossy)
{
    *gbuffer = (struct gbuffer){0};
    assert_ok(image_alloc(&gbuffer->specular, WIDTH, HEIGHT, 3, &err), err);
    assert_ok(image_alloc(&gbuffer->position, WIDTH, HEIGHT, 3, &err), err);
    assert_ok(image_alloc(&gbuffer->endpoint, WIDTH, HEIGHT, 4, &err), err);
    assert_ok(image_alloc(&gbuffer->phong, WIDTH, HEIGHT, 1, &err), err);
    assert_ok(image_alloc(&gbuffer->rays, WIDTH, HEIGHT, 4, &err), err);
    assert_ok(image_alloc(glossy, WIDTH, HEIGHT, 3, &err), err);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            for (int i = 0; i < 3; i++) {
                image_row(&gbuffer->rays, i, y)[x] = 1.25f;
                image_row(glossy, i, y)[x] = 1;
            }
            image_row(&gbuffer->position, 0, y)[x] = image_row(&gbuffer->endpoint, 0, y)[x] = 0.1f * (float)x;
            image_row(&gbuffer->position, 1, y)[x] = image_row(&gbuffer->endpoint, 1, y)[x] = 0.1f * (float)y;
            image_row(&gbuffer->endpoint, 2, y)[x] = 5;
            image_row(&gbuffer->endpoint, 3, y)[x] = 1;
            image_row(&gbuffer->phong, 0, y)[x] = 100;
            image_row(&gbuffer->rays, 3, y)[x] = 4;
        }
}

static void end(struct gbuffer *gbuffer, struct image *glossy)
{
    gbuffer_free(gbuffer);
    image_free(glossy);
}

static void control_variate__same_residual_everywhere__rays_mean(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct image glossy;
    make(&gbuffer, &glossy);
    assert_ok(control_variate(&gbuffer, NAN, 1, &glossy, &err), err);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_near(image_row(&glossy, 1, y)[x], 1.25, 1e-6);
    end(&gbuffer, &glossy);
}

/* The formula of the header, at a pixel off the middle. */
static void control_variate__single_residual__weight_of_the_formula(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct image glossy;
    make(&gbuffer, &glossy);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            image_row(&gbuffer.rays, 0, y)[x] = 1;
    image_row(&gbuffer.rays, 0, 15)[20] = 9;
    image_row(&gbuffer.rays, 3, 15)[20] = 3;
    assert_ok(control_variate(&gbuffer, NAN, 1, &glossy, &err), err);
    const double tent = 1 + 9 / sqrt(4), least = pow(0.1 / 5, 2), spread = 2 / 100.0 + 9 * least / 16;
    double own = 0, sum = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double dx = x - 18, dy = y - 16, tangent = (dx * dx + dy * dy) * least;
            double weight = fmax(1 - fabs(dx) / tent, 0) * fmax(1 - fabs(dy) / tent, 0) * exp(-tangent / 2 / spread);
            weight /= sqrt(1 + tangent); /* b(x') is farther away */
            bool bright = x == 20 && y == 15;
            sum += weight * (bright ? 3 : 4);
            own += bright ? weight * 3 : 0;
        }
    assert_near(image_row(&glossy, 0, 16)[18], 1 + 8 * own / sum, 1e-5);
    end(&gbuffer, &glossy);
}

/* Where no ray of a pixel counts its neighbours' do; of another exponent none do. */
static void control_variate__pixel_without_rays__neighbours_of_its_exponent(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct image glossy;
    make(&gbuffer, &glossy);
    image_row(&gbuffer.rays, 3, 15)[20] = 0;
    image_row(&gbuffer.rays, 0, 15)[20] = 0;
    image_row(&gbuffer.rays, 0, 16)[20] = NAN;
    image_row(&gbuffer.rays, 3, 4)[4] = 0;
    image_row(&gbuffer.phong, 0, 4)[4] = 30;
    image_row(&gbuffer.phong, 0, 9)[9] = INFINITY;
    assert_ok(control_variate(&gbuffer, NAN, 1, &glossy, &err), err);
    assert_near(image_row(&glossy, 0, 15)[20], 1.25, 1e-6);
    assert_near(image_row(&glossy, 0, 16)[21], 1.25, 1e-6);
    assert_near(image_row(&glossy, 0, 4)[4], 1, 0);
    assert_near(image_row(&glossy, 0, 9)[9], 1, 0);
    end(&gbuffer, &glossy);
}

/* A pixel at a contact, whose ray ends near by: what is right there is not mixed with the wall behind. */
static void control_variate__nearer_endpoint__little_of_the_farther_ones(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct image glossy;
    make(&gbuffer, &glossy);
    image_row(&gbuffer.endpoint, 2, 15)[20] = 0.01f;
    for (int i = 0; i < 3; i++)
        image_row(&gbuffer.rays, i, 15)[20] = 0.5f;
    assert_ok(control_variate(&gbuffer, NAN, 1, &glossy, &err), err);
    assert_near(image_row(&glossy, 0, 15)[20], 0.5, 0.05);
    assert_near(image_row(&glossy, 0, 15)[21], 1.25, 0.001);
    end(&gbuffer, &glossy);
}

static void control_variate__another_exponent__as_it_was(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct image glossy;
    make(&gbuffer, &glossy);
    assert_ok(control_variate(&gbuffer, 99, 1, &glossy, &err), err);
    assert_near(image_row(&glossy, 0, 15)[20], 1, 0);
    assert_ok(control_variate(&gbuffer, 100, 1, &glossy, &err), err);
    assert_near(image_row(&glossy, 0, 15)[20], 1.25, 1e-6);
    end(&gbuffer, &glossy);
}

static void control_variate__darker_rays__not_below_black(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct image glossy;
    make(&gbuffer, &glossy);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            image_row(&gbuffer.rays, 0, y)[x] = 0;
    image_row(&glossy, 0, 15)[20] = 0.25f;
    image_row(&glossy, 0, 5)[5] = -0.25f;
    assert_ok(control_variate(&gbuffer, NAN, 1, &glossy, &err), err);
    assert_near(image_row(&glossy, 0, 15)[20], 0, 0);
    assert_true(image_row(&glossy, 0, 5)[5] < -0.25f);
    end(&gbuffer, &glossy);
}

static void control_variate__threads__same_bits(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct image one, many;
    make(&gbuffer, &one);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            image_row(&gbuffer.rays, 0, y)[x] = (float)((x * 7 + y * 13) % 11);
    assert_ok(image_alloc(&many, WIDTH, HEIGHT, 3, &err), err);
    memcpy(many.pixels, one.pixels, 3 * one.stride * HEIGHT * sizeof *one.pixels);
    assert_ok(control_variate(&gbuffer, NAN, 1, &one, &err), err);
    assert_ok(control_variate(&gbuffer, NAN, 5, &many, &err), err);
    assert_true(image_same(&one, &many));
    image_free(&many);
    end(&gbuffer, &one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(control_variate__same_residual_everywhere__rays_mean),
        cmocka_unit_test(control_variate__single_residual__weight_of_the_formula),
        cmocka_unit_test(control_variate__pixel_without_rays__neighbours_of_its_exponent),
        cmocka_unit_test(control_variate__nearer_endpoint__little_of_the_farther_ones),
        cmocka_unit_test(control_variate__another_exponent__as_it_was),
        cmocka_unit_test(control_variate__darker_rays__not_below_black),
        cmocka_unit_test(control_variate__threads__same_bits),
    };
    cmocka_set_test_filter(getenv("TESTS"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}
