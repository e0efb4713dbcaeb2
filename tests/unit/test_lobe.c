/* Equations (2) to (5) against hand-worked values, their limits and numerical integrals. */
#include "gloss_support.h"
#include "lobe.h"

static const double pi = 3.14159265358979324;

static void lobe_weight__hand_worked__matches(void **state)
{
    (void)state;
    assert_near(lobe_weight(2, 0.5), 0.25, 1e-15);
    assert_near(lobe_weight(0, 0.3), 1, 0);
    assert_near(lobe_weight(5, 0), 0, 0);
    assert_near(lobe_weight(0, -0.5), 0, 0);
    assert_near(lobe_weight(INFINITY, 1), 1, 0);
    assert_near(lobe_weight(INFINITY, 0.999), 0, 0);
    assert_near(lobe_weight(1, -1e-300), 0, 0);
    assert_near(lobe_weight(1, 1 + 1e-15), 1, 0); /* a rounded cosine */
    assert_near(lobe_weight(1e-6, 4.9e-324), 1, 1e-3); /* (2^-1074)^1e-6 */
    assert_near(lobe_weight(1e8, cos(1e-4)), exp(-0.5), 1e-6);
    assert_near(lobe_weight(1e8, 0.9), 0, 0);
    assert_near(lobe_weight_max(0.7, 2, 0.5), 0.35, 1e-15);
}

/* Share of the lobe's energy within an angle, by the midpoint rule in the angle. */
static double energy_within(double phong, double angle)
{
    const int steps = 200000;
    double inside = 0, all = 0;
    for (int i = 0; i < steps; i++) {
        double theta = pi / 2 * (i + 0.5) / steps, value = pow(cos(theta), phong) * sin(theta);
        all += value;
        if (theta < angle)
            inside += value;
    }
    return inside / all;
}

static void lobe_half_angle__integral_over_the_hemisphere__holds_the_energy(void **state)
{
    (void)state;
    static const double exponents[] = {0, 1, 10, 300, 10000};
    static const double energies[] = {0.5, 0.9, 0.99};
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 3; j++)
            assert_near(energy_within(exponents[i], lobe_half_angle(exponents[i], energies[j], pi / 2)), energies[j],
                        1e-3);
}

static void lobe_half_angle__limits__are_exact(void **state)
{
    (void)state;
    assert_near(lobe_half_angle(INFINITY, 0.99, pi / 2), 0, 0);
    assert_near(lobe_half_angle(0, 0.5, pi / 2), pi / 3, 1e-15); /* cos = 1 - E */
    assert_near(lobe_half_angle(1e-6, 0.5, pi / 2), pi / 3, 1e-6);
    assert_near(lobe_half_angle(10, 0.99, 0.1), 0.1, 0);
    /* Narrow lobes: Theta^2/2 = -log(1 - E)/(p + 1). */
    double narrow = sqrt(2 * log(100) / 1e14);
    assert_near(lobe_half_angle(1e14, 0.99, pi / 2), narrow, 1e-12 * narrow);
}

static void lobe_alpha__hand_worked__matches(void **state)
{
    (void)state;
    assert_near(lobe_alpha(0.3, 2, 1), 0.1, 1e-16);
    assert_near(lobe_alpha(0.3, 1, 2), 0.2, 1e-16);
    assert_near(lobe_alpha(0.3, 0, 2), 0.3, 0);
    assert_near(lobe_alpha(0.3, 2, INFINITY), 0.3, 0);
    assert_near(lobe_alpha(0.3, INFINITY, INFINITY), 0.3, 0);
    assert_near(lobe_alpha(0.3, INFINITY, 2), 0, 0);
    assert_near(lobe_alpha(0.3, 2, 0), 0, 0);
    assert_near(lobe_alpha(0.3, 0, 0), 0, 0);
    assert_near(lobe_alpha(0.3, 4.9e-324, 4.9e-324), 0.15, 1e-16);
    assert_near(lobe_alpha(0.3, 1e308, 4.9e-324), 0, 0);
    assert_near(lobe_alpha(0.3, 4.9e-324, 1e308), 0.3, 0);
}

static void lobe_radius__hand_worked__matches(void **state)
{
    (void)state;
    assert_near(lobe_radius_px(0.1, 640, 0.8), 80, 1e-12);
    assert_near(lobe_radius_px(0, 640, 0.8), 0, 0);
}

static void lobe_phong__from_roughness_and_back__agrees(void **state)
{
    (void)state;
    assert_near(lobe_phong_from_roughness(0.5), 7.5, 1e-12); /* (16 - 1)/2 */
    assert_near(lobe_phong_from_roughness(1), 0, 0);
    assert_true(isinf(lobe_phong_from_roughness(0)));
    assert_near(lobe_roughness_from_phong(INFINITY), 0, 0);
    for (double r = 0.01; r < 1; r += 0.01)
        assert_near(lobe_roughness_from_phong(lobe_phong_from_roughness(r)), r, 1e-12);
}

static void lobe_integral__midpoint_rule__is_the_same(void **state)
{
    (void)state;
    assert_near(lobe_integral(INFINITY, 0.001), 0, 0);
    assert_near(lobe_integral(INFINITY, 0), 0, 0);
    static const double exponents[] = {0, 1e-6, 0.5, 10, 3000}, floors[] = {0, 0.001, 0.3};
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 3; j++) {
            const int steps = 400000;
            double sum = 0;
            for (int k = 0; k < steps; k++) {
                double angle = (k + 0.5) / steps * pi / 2;
                sum += fmax(pow(cos(angle), exponents[i]) - floors[j], 0) * 2 * pi * sin(angle) * pi / 2 / steps;
            }
            assert_near(lobe_integral(exponents[i], floors[j]), sum, 1e-6 * sum);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lobe_weight__hand_worked__matches),
        cmocka_unit_test(lobe_integral__midpoint_rule__is_the_same),
        cmocka_unit_test(lobe_half_angle__integral_over_the_hemisphere__holds_the_energy),
        cmocka_unit_test(lobe_half_angle__limits__are_exact),
        cmocka_unit_test(lobe_alpha__hand_worked__matches),
        cmocka_unit_test(lobe_radius__hand_worked__matches),
        cmocka_unit_test(lobe_phong__from_roughness_and_back__agrees),
    };
    return cmocka_run_group_tests_name("lobe", tests, NULL, NULL);
}
