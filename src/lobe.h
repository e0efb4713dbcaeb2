/* The glossy lobe: equations (2) to (5) of "Fuzzy reflections rendering", Kulikova and Dmitriev, 2002.
 *
 * No function has an argument below 0 or NaN but for cosines and roughness; the callers refuse those.
 */
#ifndef POVGLOSS_LOBE_H
#define POVGLOSS_LOBE_H

/* Equation (3): f = cos^p, for p from 0 to infinity. 0 where the cosine is 0 or less (90 degrees and more). At p =
 * infinity 1 for a cosine of 1 and 0 below. */
double lobe_weight(double phong, double cosine);

/* Equation (2), the form of 3ds Max: f = 2 strength cos^shininess. In the normalised sum of equation (1) the factor
 * cancels. */
double lobe_weight_max(double strength, double shininess, double cosine);

/* Theta, radians: the half-angle of the cone that holds the share `energy` of the lobe cos^p over the hemisphere,
 *   energy = 1 - cos^(p+1)(Theta),
 * but at most max_angle_rad. energy in (0, 1); p from 0 to infinity; p = infinity gives 0. */
double lobe_half_angle(double phong, double energy, double max_angle_rad);

/* Integral over the hemisphere of max(cos^p - floor, 0), steradians; 2 pi / (p + 1) for floor = 0. floor in [0, 1), p
 * from 0 to infinity. */
double lobe_integral(double phong, double floor);

/* Equation (4): alpha = Theta / (1 + s/r), radians: the lobe's half-angle as the eye sees it. s = |a - eye| and r = |b
 * - a| in one unit, 0 to infinity. r = infinity (a miss) and s = 0 give Theta; r = 0 gives 0, whatever s. */
double lobe_alpha(double half_angle_rad, double eye_distance, double endpoint_distance);

/* Equation (5): rho = alpha width / view angle, pixels; the view angle is above 0. */
double lobe_radius_px(double alpha_rad, double width_px, double view_angle_rad);

/* p = (1/r^4 - 1)/2: the Phong exponent of the reflected lobe of a microfacet surface of slope parameter r^2 (Walter
 * et al., 2007: exponent 2/r^4 - 2 about the half vector, a quarter of that about the mirror direction). r <= 0 gives
 * infinity, r >= 1 gives 0. */
double lobe_phong_from_roughness(double roughness);

/* The inverse: r = (1/(2p + 1))^(1/4), for p from 0 to infinity. */
double lobe_roughness_from_phong(double phong);

#endif
