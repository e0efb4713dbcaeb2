/* Stand-ins for the weight cos^p: the paper's table, and the Gaussian. */
#ifndef POVGLOSS_WEIGHTS_H
#define POVGLOSS_WEIGHTS_H

/* cos^p is no function of p (1 - cos): by that argument a wide lobe is wrong (cos^1 at 60 degrees is 0.5, e^-0.5 is
 * 0.61). It is e^-x with x = -p log(cos), and the table runs over x: one table for all exponents. */
enum {
    WEIGHTS_TABLE_STEPS = 64, /* entries per unit of x */
    WEIGHTS_TABLE_LAST = 83 * WEIGHTS_TABLE_STEPS,
    WEIGHTS_TABLE_SIZE = WEIGHTS_TABLE_LAST + 2 /* a lookup at LAST reads the entry after it, too */
};

/* Fills table[WEIGHTS_TABLE_SIZE] with e^-x; the last two entries are 0. */
void weights_table_build(float *table);

/* e^-x between entries by a straight line, x >= 0. Relative error below 3.2e-5 (step^2/8, and rounding) for x < 82; 0
 * where x is 83 (weight 9e-37) or more, or NaN. */
float weights_table_lookup(const float *table, float x);

/* x = -p log(cosine), natural logarithm; infinite for a cosine of 0 or less. */
double weights_table_argument(double phong, double cosine);

/* The Gaussian in place of the lobe: e^(-p tan^2(theta)/2), round in the plane across the mirror direction; 0 from 90
 * degrees. Its difference from cos^p is at most 0.55/p, and it never lies above cos^p. */
double weights_gauss(double phong, double cosine);

#endif
