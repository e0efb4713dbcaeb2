/* The table and the Gaussian against cos^p in double. */
#include "gloss_support.h"
#include "lobe.h"
#include "weights.h"

static float table[WEIGHTS_TABLE_SIZE];

static void weights_table__between_entries__keeps_its_bound(void **state)
{
    (void)state;
    double worst = 0;
    for (int i = 0; i < 1000000; i++) {
        double x = 82.0 * i / 1000000;
        worst = fmax(worst, fabs((double)weights_table_lookup(table, (float)x) / exp(-(double)(float)x) - 1));
    }
    assert_true(worst < 3.2e-5);
    assert_true(worst > 2.9e-5); /* the bound is the bound of a straight line, not a generous one */
}

static void weights_table__exponents_1_to_1e8__match_the_lobe(void **state)
{
    (void)state;
    for (double phong = 1; phong <= 1e8; phong *= 10)
        for (int i = 0; i <= 1000; i++) {
            /* Angles out to the weight e^-20, or nearly 90 degrees. */
            double versine = fmin(1 - exp(-20 / phong), 0.999) * i / 1000, cosine = 1 - versine;
            double x = weights_table_argument(phong, cosine), exact = lobe_weight(phong, cosine);
            /* As a float x is off by up to 6e-8 of itself, and so is the weight by that times x. */
            assert_near(weights_table_lookup(table, (float)x), exact, exact * (3.2e-5 + 6e-8 * x));
        }
}

static void weights_table__ends__are_one_and_zero(void **state)
{
    (void)state;
    assert_near(weights_table_lookup(table, 0), 1, 0);
    assert_near(weights_table_lookup(table, 83), 0, 0);
    assert_near(weights_table_lookup(table, 1e30f), 0, 0);
    assert_near(weights_table_lookup(table, INFINITY), 0, 0);
    assert_near(weights_table_lookup(table, NAN), 0, 0);
    assert_true(isinf(weights_table_argument(3, 0)));
    assert_near(weights_table_argument(3, 1.0000001), 0, 0);
}

static void weights_gauss__against_the_lobe__keeps_its_bound(void **state)
{
    (void)state;
    for (double phong = 1; phong <= 1e8; phong *= 10) {
        double worst = 0;
        for (int i = 0; i < 100000; i++) {
            double cosine = 1 - fmin(1 - exp(-20 / phong), 0.9999) * i / 100000;
            double difference = lobe_weight(phong, cosine) - weights_gauss(phong, cosine);
            assert_true(difference > -1e-7);
            worst = fmax(worst, difference);
        }
        assert_true(worst < 0.55 / phong);
        assert_true(phong < 10 || phong > 1e6 || worst > 0.4 / phong);
    }
    assert_near(weights_gauss(5, 1), 1, 0);
    assert_near(weights_gauss(5, 0), 0, 0);
    assert_near(weights_gauss(2, sqrt(0.5)), exp(-1), 1e-15); /* 45 degrees: tan = 1 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_table__between_entries__keeps_its_bound),
        cmocka_unit_test(weights_table__exponents_1_to_1e8__match_the_lobe),
        cmocka_unit_test(weights_table__ends__are_one_and_zero),
        cmocka_unit_test(weights_gauss__against_the_lobe__keeps_its_bound),
    };
    weights_table_build(table);
    return cmocka_run_group_tests_name("weights", tests, NULL, NULL);
}
