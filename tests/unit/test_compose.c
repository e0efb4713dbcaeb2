/* base + reflectance * glossy in each working space. */
#include "compose.h"
#include "gloss_support.h"

static struct error err;

/* One pixel through compose(); base or reflectance NAN: no such image. */
static float composed(float gamma, float base, float reflectance, float glossy_value)
{
    struct gbuffer gbuffer = {.working_gamma = gamma};
    struct image glossy, image;
    assert_ok(image_alloc(&glossy, 1, 1, 3, &err), err);
    if (!isnan(base))
        assert_ok(image_alloc(&gbuffer.base, 1, 1, 3, &err), err);
    if (!isnan(reflectance))
        assert_ok(image_alloc(&gbuffer.reflectance, 1, 1, 3, &err), err);
    for (int i = 0; i < 3; i++) {
        image_row(&glossy, i, 0)[0] = glossy_value;
        if (!isnan(base))
            image_row(&gbuffer.base, i, 0)[0] = base;
        if (!isnan(reflectance))
            image_row(&gbuffer.reflectance, i, 0)[0] = reflectance;
    }
    assert_ok(compose(&gbuffer, &glossy, &image, &err), err);
    float value = image_row(&image, 0, 0)[0];
    assert_true(memcmp(&value, image_row(&image, 2, 0), sizeof value) == 0);
    image_free(&image);
    image_free(&glossy);
    gbuffer_free(&gbuffer);
    return value;
}

static void compose__linear__adds(void **state)
{
    (void)state;
    assert_near(composed(0, 0.25f, 0.5f, 0.5f), 0.5, 0);
    assert_near(composed(1, 0.25f, 0.5f, 0.5f), 0.5, 0);
}

static void compose__gamma_2__adds_square_roots(void **state)
{
    (void)state;
    assert_near(composed(2, 0.25f, 0.5f, 0.25f), 0.5625, 1e-7); /* (0.5 + 0.5 * 0.5)^2 */
    assert_near(composed(2, -0.25f, 1, 0.0625f), -0.0625, 1e-7);
    assert_near(composed(2, 0.25f, 0.5f, -0.25f), 0.0625, 1e-7);
}

static void compose__srgb__adds_coded_values(void **state)
{
    (void)state;
    /* The codes of 0.5 and 0.1, from 1.055 v^(1/2.4) - 0.055. */
    double coded = 0.7353569830524495 + 0.5 * 0.3491901976246434;
    assert_near(composed(GBUFFER_GAMMA_SRGB, 0.5f, 0.5f, 0.1f), pow((coded + 0.055) / 1.055, 2.4), 1e-6);
    assert_near(composed(GBUFFER_GAMMA_SRGB, 0.001f, 1, 0.001f), 0.002, 1e-8);
}

static void compose__missing_images__are_black_base_and_full_reflectance(void **state)
{
    (void)state;
    assert_near(composed(0, NAN, 0.5f, 0.5f), 0.25, 0);
    assert_near(composed(0, 0.25f, NAN, 0.5f), 0.75, 0);
    assert_near(composed(2.2f, NAN, NAN, 0.5f), 0.5, 1e-7);
}

static void compose__nothing_reflected__leaves_the_base(void **state)
{
    (void)state;
    assert_near(composed(2.2f, 0.3f, 0, 5), (double)0.3f, 0);
    assert_near(composed(2.2f, 0.3f, 1, 0), (double)0.3f, 0);
    assert_near(composed(0, 0.3f, 0, INFINITY), (double)0.3f, 0);
}

static void compose__other_size__is_refused(void **state)
{
    (void)state;
    struct gbuffer gbuffer = {0};
    struct image glossy, image;
    assert_ok(image_alloc(&glossy, 2, 3, 3, &err), err);
    assert_ok(image_alloc(&gbuffer.base, 3, 2, 3, &err), err);
    assert_int_equal(compose(&gbuffer, &glossy, &image, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, "base"));
    assert_null(image.pixels);
    image_free(&glossy);
    gbuffer_free(&gbuffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compose__linear__adds),
        cmocka_unit_test(compose__gamma_2__adds_square_roots),
        cmocka_unit_test(compose__srgb__adds_coded_values),
        cmocka_unit_test(compose__missing_images__are_black_base_and_full_reflectance),
        cmocka_unit_test(compose__nothing_reflected__leaves_the_base),
        cmocka_unit_test(compose__other_size__is_refused),
    };
    return cmocka_run_group_tests_name("compose", tests, NULL, NULL);
}
