/* Stand-ins for the weight cos^p of equation (3): the tabulated weights and the Gaussian that the paper names among its
 * optimisations. The kernel of the filter reads the same table by the same formula.
 */
#include "weights.h"

#include <math.h>

void weights_table_build(float *table)
{
    for (int i = 0; i < WEIGHTS_TABLE_LAST; i++)
        table[i] = (float)exp(-(double)i / WEIGHTS_TABLE_STEPS);
    table[WEIGHTS_TABLE_LAST] = 0;
    table[WEIGHTS_TABLE_LAST + 1] = 0;
}

float weights_table_lookup(const float *table, float x)
{
    float position = x * WEIGHTS_TABLE_STEPS;
    position = position < WEIGHTS_TABLE_LAST ? position : WEIGHTS_TABLE_LAST; /* NaN goes to the end */
    int i = (int)position;
    return table[i] + (position - (float)i) * (table[i + 1] - table[i]);
}

double weights_table_argument(double phong, double cosine)
{
    if (!(cosine > 0))
        return INFINITY;
    return -phong * log(fmin(cosine, 1));
}

double weights_gauss(double phong, double cosine)
{
    if (!(cosine > 0))
        return 0;
    double tangent_squared = fmax((1 - cosine) * (1 + cosine), 0) / (cosine * cosine);
    return exp(-phong * tangent_squared / 2);
}
