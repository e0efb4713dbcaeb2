/* The paper's filter, equations (1) to (6): glossy radiance from a gbuffer.
 *
 * "Fuzzy reflections rendering", Kulikova and Dmitriev, 2002.
 */
#ifndef POVGLOSS_FILTER_H
#define POVGLOSS_FILTER_H

#include "cpu.h"
#include "gbuffer.h"

enum filter_weights { FILTER_WEIGHTS_EXACT, FILTER_WEIGHTS_TABLE, FILTER_WEIGHTS_GAUSS };
enum filter_formula { FILTER_FORMULA_PHONG, FILTER_FORMULA_MAX }; /* equation (3), equation (2) */
enum filter_window { FILTER_WINDOW_ROUND, FILTER_WINDOW_SQUARE };

struct filter_options {
    enum filter_weights weights;
    enum filter_formula formula;
    enum filter_window window;
    float phong;          /* exponent where the gbuffer has none: 0 to infinity; NaN: none is known */
    bool phong_override;  /* phong takes the place of the gbuffer's exponents, too; not glossy stays not glossy */
    double energy;        /* share of the lobe's energy within Theta, (0, 1) */
    double max_angle_rad; /* upper limit of Theta, (0, pi/2] */
    int max_radius_px;    /* upper limit of the radius; 0: none but the picture's diagonal */
    int radius_step;      /* 1, 2, 4 or 8: the radius is computed at every so-many-th pixel and interpolated */
    int threads;          /* 0: as many as there are processors */
    enum cpu_isa isa;     /* the result is the same to the last bit */
};

/* Exact weights, Phong formula, round window, no exponent, 0.99 of the energy, no limits, radius at every 4th pixel. */
struct filter_options filter_options_default(void);

/* glossy (allocated here, 3 channels; the caller frees it) = the specular plane blurred where the pixel is glossy;
 * where it is not glossy but the reflectance is above 0 (an antialiased edge) the mean of the nearest glossy pixels'
 * results, at most 3 pixels away; 0 elsewhere. radius, where not NULL, is allocated too: 1 channel, the radius of
 * equation (5) in pixels, 0 where not glossy.
 *
 * Glossy is a pixel whose exponent is above 0 (with no phong plane: whatever the options say, 0 included), whose
 * position, endpoint and specular are finite, whose endpoint is not all zero and has W >= 0. Only glossy pixels are
 * averaged over, so no NaN or infinity spreads. W is divided out. An endpoint 1e12 times as far out as the farthest
 * position counts as a direction; lengths below 1e-24 of the farthest position's count as 0.
 *
 * Weights are relative to the pixel's own endpoint and good to about 1e-6 + 1e-7 sqrt(p) (float positions are no
 * better), tabulated ones to 3.2e-5 more.
 *
 * The pixel itself always counts: with a radius below 1 (a mirror: p of 1e20 and more; a = b, where equation (4) gives
 * 0) the result is L0 itself. Without an eye or view angle the radius is Theta over the angle between the endpoints of
 * neighbouring pixels, seen from a: the smallest over the glossy ones of the four neighbours; 0 where there are none.
 *
 * RESULT_USAGE: no exponent, or an instruction set this processor lacks. RESULT_DATA: missing planes or sizes that
 * differ, memory. RESULT_INTERRUPTED. On failure both images are empty.
 */
MUST_CHECK enum result filter_glossy(const struct gbuffer *gbuffer, const struct filter_options *options,
                                     struct image *glossy, struct image *radius, struct error *err);

#endif
