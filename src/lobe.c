/* The glossy lobe as pure functions in double.
 *
 * Equations (2) and (3): the weight; (4) and (5): the radius of the filter, with Theta from the lobe's energy; and the
 * two ways to say how glossy a surface is.
 */
#include "lobe.h"

#include <math.h>

double lobe_weight(double phong, double cosine)
{
    if (!(cosine > 0))
        return 0;
    return pow(fmin(cosine, 1), phong);
}

double lobe_weight_max(double strength, double shininess, double cosine)
{
    return 2 * strength * lobe_weight(shininess, cosine);
}

double lobe_half_angle(double phong, double energy, double max_angle_rad)
{
    /* 1 - cos(Theta), and the angle from it: an arc cosine would round narrow lobes to nothing. */
    double versine = -expm1(log1p(-energy) / (phong + 1));
    return fmin(2 * asin(sqrt(versine / 2)), max_angle_rad);
}

double lobe_integral(double phong, double floor)
{
    const double pi = 3.14159265358979324;
    double cosine = pow(floor, 1 / phong); /* where cos^p is the floor; 0 for p = 0 */
    return 2 * pi * ((1 - cosine * floor) / (phong + 1) - floor * (1 - cosine));
}

double lobe_alpha(double half_angle_rad, double eye_distance, double endpoint_distance)
{
    if (endpoint_distance == 0)
        return 0;
    if (isinf(endpoint_distance))
        return half_angle_rad;
    return half_angle_rad / (1 + eye_distance / endpoint_distance); /* eq. (4) */
}

double lobe_radius_px(double alpha_rad, double width_px, double view_angle_rad)
{
    return alpha_rad * width_px / view_angle_rad; /* eq. (5) */
}

double lobe_phong_from_roughness(double roughness)
{
    if (roughness <= 0)
        return INFINITY;
    if (roughness >= 1)
        return 0;
    return (1 / pow(roughness, 4) - 1) / 2;
}

double lobe_roughness_from_phong(double phong)
{
    return pow(2 * phong + 1, -0.25);
}
