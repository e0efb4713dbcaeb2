/* The working space against the standard's own numbers and against long double powers. */
#include "gamma.h"

#include "gbuffer.h"
#include "gloss_support.h"

#define assert_relative(a, b, tolerance) assert_near(a, b, (tolerance)*fabs(b))

/* IEC 61966-2-1, in long double. */
static double srgb_encode(double v)
{
    return (double)(v <= 0.0031308 ? 12.92L * v : 1.055L * powl(v, 1 / 2.4L) - 0.055L);
}

static double srgb_decode(double v)
{
    return (double)(v <= 0.04045 ? v / 12.92L : powl((v + 0.055L) / 1.055L, 2.4L));
}

static void gamma__srgb__known_values(void **state)
{
    (void)state;
    static const struct {
        double linear, encoded;
    } known[] = {
        {0, 0},
        {0.001, 0.01292},
        {0.0031308, 0.040449936},
        {0.18, 0.46135612950044164},
        {0.21404114048223255, 0.5},
        {0.5, 0.7353569830524495},
        {1, 1},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        assert_near(gamma_encode(GBUFFER_GAMMA_SRGB, known[i].linear), known[i].encoded, 1e-12);
        assert_near(gamma_decode(GBUFFER_GAMMA_SRGB, known[i].encoded), known[i].linear, 1e-12);
    }
}

static void gamma__srgb__the_curve_at_every_scale(void **state)
{
    (void)state;
    for (double v = 1e-9; v < 1e6; v *= 1.01) {
        assert_relative(gamma_encode(GBUFFER_GAMMA_SRGB, v), srgb_encode(v), 1e-13);
        assert_relative(gamma_decode(GBUFFER_GAMMA_SRGB, v), srgb_decode(v), 1e-13);
    }
}

static void gamma__srgb_knee__continuous(void **state)
{
    (void)state;
    double below = gamma_encode(GBUFFER_GAMMA_SRGB, 0.0031308), above = gamma_encode(GBUFFER_GAMMA_SRGB, 0.00313081);
    assert_true(above > below);
    assert_near(above, below, 1e-6);
    below = gamma_decode(GBUFFER_GAMMA_SRGB, 0.04045);
    above = gamma_decode(GBUFFER_GAMMA_SRGB, 0.0404501);
    assert_true(above > below);
    assert_near(above, below, 1e-7);
}

static void gamma__powers__long_double_power(void **state)
{
    (void)state;
    static const double gammas[] = {0.45, 1.8, 2.2, 3};
    for (size_t i = 0; i < sizeof gammas / sizeof *gammas; i++)
        for (double v = 1e-6; v < 1e4; v *= 1.1) {
            assert_relative(gamma_encode(gammas[i], v), (double)powl(v, 1 / (long double)gammas[i]), 1e-13);
            assert_relative(gamma_decode(gammas[i], v), (double)powl(v, gammas[i]), 1e-13);
        }
    assert_near(gamma_encode(2, 0.25), 0.5, 1e-15);
    assert_near(gamma_decode(2, 0.5), 0.25, 1e-15);
}

static void gamma__zero_or_one__nothing_changes(void **state)
{
    (void)state;
    static const double values[] = {-3, -0.5, 0, 1e-30, 0.2, 1, 65504, INFINITY};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        for (int gamma = 0; gamma < 2; gamma++) {
            assert_true(gamma_encode(gamma, values[i]) == values[i]);
            assert_true(gamma_decode(gamma, values[i]) == values[i]);
        }
}

static void gamma__negative_values__odd_function(void **state)
{
    (void)state;
    static const double gammas[] = {GBUFFER_GAMMA_SRGB, 2.2, 0.5};
    for (size_t i = 0; i < sizeof gammas / sizeof *gammas; i++)
        for (double v = 1e-5; v < 100; v *= 2) {
            assert_true(gamma_encode(gammas[i], -v) == -gamma_encode(gammas[i], v));
            assert_true(gamma_decode(gammas[i], -v) == -gamma_decode(gammas[i], v));
            assert_true(gamma_encode(gammas[i], v) > 0);
        }
}

static void gamma__there_and_back__the_same(void **state)
{
    (void)state;
    static const double gammas[] = {GBUFFER_GAMMA_SRGB, 0, 1, 1.8, 2.2};
    for (size_t i = 0; i < sizeof gammas / sizeof *gammas; i++)
        for (double v = 1e-6; v < 1e4; v *= 1.07) {
            assert_relative(gamma_decode(gammas[i], gamma_encode(gammas[i], v)), v, 1e-12);
            assert_relative(gamma_encode(gammas[i], gamma_decode(gammas[i], -v)), -v, 1e-12);
        }
}

static void gamma__zero_and_infinity__themselves(void **state)
{
    (void)state;
    static const double gammas[] = {GBUFFER_GAMMA_SRGB, 2.2};
    for (size_t i = 0; i < 2; i++) {
        assert_true(gamma_encode(gammas[i], 0) == 0 && gamma_decode(gammas[i], 0) == 0);
        assert_true(isinf(gamma_encode(gammas[i], INFINITY)) && isinf(gamma_decode(gammas[i], INFINITY)));
        assert_true(isnan(gamma_encode(gammas[i], NAN)) && isnan(gamma_decode(gammas[i], NAN)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gamma__srgb__known_values),
        cmocka_unit_test(gamma__srgb__the_curve_at_every_scale),
        cmocka_unit_test(gamma__srgb_knee__continuous),
        cmocka_unit_test(gamma__powers__long_double_power),
        cmocka_unit_test(gamma__zero_or_one__nothing_changes),
        cmocka_unit_test(gamma__negative_values__odd_function),
        cmocka_unit_test(gamma__there_and_back__the_same),
        cmocka_unit_test(gamma__zero_and_infinity__themselves),
    };
    return cmocka_run_group_tests_name("gamma", tests, NULL, NULL);
}
