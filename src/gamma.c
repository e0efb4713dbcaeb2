/* Powers and the sRGB curve for positive values; the sign is carried over. */
#include "gamma.h"

#include <math.h>

static double encode_positive(double gamma, double v)
{
    if (gamma < 0)
        return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
    return pow(v, 1 / gamma);
}

static double decode_positive(double gamma, double v)
{
    if (gamma < 0)
        return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
    return pow(v, gamma);
}

double gamma_encode(double gamma, double linear)
{
    if (gamma == 0 || gamma == 1)
        return linear;
    return copysign(encode_positive(gamma, fabs(linear)), linear);
}

double gamma_decode(double gamma, double encoded)
{
    if (gamma == 0 || gamma == 1)
        return encoded;
    return copysign(decode_positive(gamma, fabs(encoded)), encoded);
}
