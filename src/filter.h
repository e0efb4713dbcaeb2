/* Glossy radiance from a gbuffer: by the sum over what each point sees, or by the paper's filter.
 *
 * The paper, whose equations (1) to (6) keep their numbers: "Fuzzy reflections rendering", Kulikova and Dmitriev, 2002.
 */
#ifndef POVGLOSS_FILTER_H
#define POVGLOSS_FILTER_H

#include "cpu.h"
#include "gbuffer.h"

/* Tolerances of the best filter: 0, the sums as they are written below; else far pixels are taken together, and some
 * pixels computed and the others interpolated (filter_fast.c), so that on three scenes, at exponents of 30, 300 and
 * 3000, the RMSE of the picture against the exact one, linear, is no larger; see docs/performance.md. Exact in any case
 * are pictures of fewer than 16384 pixels, but for a draft, and all with a max_radius_px below 32. Only exact results
 * of flipped passes are the flipped results. */
#define FILTER_TOLERANCE_LEAST 0.0007
#define FILTER_TOLERANCE_HIGH 0.001
#define FILTER_TOLERANCE_NORMAL 0.0015
#define FILTER_TOLERANCE_DRAFT 0.002

enum filter_mode { FILTER_MODE_BEST, FILTER_MODE_PAPER };
enum filter_weights { FILTER_WEIGHTS_EXACT, FILTER_WEIGHTS_TABLE, FILTER_WEIGHTS_GAUSS };
enum filter_formula { FILTER_FORMULA_PHONG, FILTER_FORMULA_MAX }; /* equation (3), equation (2) */
enum filter_window { FILTER_WINDOW_ROUND, FILTER_WINDOW_SQUARE };

/* What the best filter may leave out, to measure what it is worth: the solid angle of each pixel (all count alike, but
 * for the carry to the receiver), visibility, the help of pixels that are not seen, and the fit to what is seen. */
enum filter_without {
    FILTER_WITHOUT_DENSITY = 1,
    FILTER_WITHOUT_VISIBILITY = 2,
    FILTER_WITHOUT_POOL = 4,
    FILTER_WITHOUT_FIT = 8
};

struct filter_options {
    enum filter_mode mode;
    enum filter_weights weights; /* weights, formula, window, radius_step: the paper's alone */
    enum filter_formula formula;
    enum filter_window window;
    double tolerance;     /* the best's alone: 0, or FILTER_TOLERANCE_LEAST to _DRAFT */
    unsigned without;     /* the best's alone: set of enum filter_without */
    float phong;          /* exponent where the gbuffer has none: 0 to infinity; NaN: none is known */
    bool phong_override;  /* phong takes the place of the gbuffer's exponents, too; not glossy stays not glossy */
    double energy;        /* share of the lobe's energy within Theta, (0, 1) */
    double max_angle_rad; /* upper limit of Theta, (0, pi/2] */
    int max_radius_px;    /* upper limit of the radius; 0: none but the picture's diagonal */
    int radius_step;      /* 1, 2, 4 or 8: the radius is computed at every so-many-th pixel and interpolated */
    int threads;          /* 0: as many as there are processors */
    enum cpu_isa isa;     /* the result is the same to the last bit */
};

/* Best, FILTER_TOLERANCE_NORMAL; exact weights, Phong formula, round window, no exponent, 0.99 of the energy, no
 * limits, radius at every pixel. */
struct filter_options filter_options_default(void);

/* A gbuffer, and what is built of it for filter_apply() whatever the exponents. */
struct filter;

/* *filter, which filter_close() frees, keeps the gbuffer: it must stay as it is until then. RESULT_DATA: memory. */
MUST_CHECK enum result filter_open(const struct gbuffer *gbuffer, struct filter **filter, struct error *err);

/* NULL is allowed. */
void filter_close(struct filter *filter);

const struct gbuffer *filter_gbuffer(const struct filter *filter);

/* glossy (allocated here, 3 channels; the caller frees it) = the specular plane blurred where the pixel is glossy;
 * where it is not glossy but the reflectance is above 0 (an antialiased edge) the mean of the nearest glossy pixels'
 * results, at most 3 pixels away; 0 elsewhere. measure, where not NULL, is allocated too, 1 channel, 0 where not
 * glossy: of the paper the radius of equation (5) in pixels, of the best filter the confidence.
 *
 * FILTER_MODE_PAPER: equation (1). FILTER_MODE_BEST: over the pixels whose endpoints b' the pixel's own a sees, with f
 * = max(cos^q(theta) - (1 - energy), 0) times the solid angle at a of the area that b' stands for, the value of L0 at
 * theta = 0 by a plane fitted to it with the weights f, within the range of what is seen (without the fit, sum f L0 /
 * sum f).
 * - That area: of the pixel's ray, the cross product of its shifts at b' to the next pixel across and down (of the two
 *   neighbours on an axis the one that shifts it less). From a it is the area over the distance from a squared, at
 *   most 10 times what it is from its own a', and less where that comes near a hemisphere: A / (max(r^2, r'^2 / 10) +
 *   A / 2 pi).
 * - Seen: see filter_see in filter_kernel.h. A non-glossy pixel hides what a surface that goes on like the pixel's own
 *   would no longer reflect.
 * - Where single things are much brighter than the rest of what is seen, E^2 < E(L0^2) / 3 of its R + G + B, the plane
 *   has less of its slope, by 3 E^2 / E(L0^2), and what isn't seen is taken to have fewer of them (part of the fit).
 * - q = p / (1 + 1 / (n + 1/8)), where the lobe of p holds n pixels like this one: a lobe as wide as p's and the pixel
 *   together, for what lies between two pixels is known by these alone (without density q = p).
 * - What is not seen helps by its sum over the window of equation (5), of at most 32 + sqrt(n) pixels' radius: half as
 *   much as the seen ones leave uncovered of the lobe, and (4 / (n + 4))^2. What is farther away on a bent or bumpy
 *   mirror, whose lobes hold few pixels, shows other things.
 * With rays in the gbuffer the result is then corrected by them: see control_variate.h.
 * Confidence, 0 to 1: the sum of f over what it is where nothing is hidden, the share of the lobe that what is seen
 * covers.
 *
 * Glossy is a pixel whose exponent is above 0 (with no phong plane: whatever the options say, 0 included), whose
 * position, endpoint and specular are finite, whose endpoint is not all zero and has W >= 0. Only glossy pixels are
 * averaged over, so no NaN or infinity spreads; filter_left_out() counts the others. W is divided out. An endpoint 1e12
 * times as far out as the farthest position counts as a direction; one nearer to its a than 1e-15 of the farthest
 * position's distance from the origin touches it: r = 0. Lengths times any factor (1e-24 to 1e24 is tested) give the
 * same picture.
 *
 * Weights are relative to the pixel's own endpoint and good to about 1e-6 + 1e-7 sqrt(p) (float positions are no
 * better), tabulated ones to 3.2e-5 more.
 *
 * A gbuffer with a window has the results that its picture needs alone; the rest of both images is 0.
 *
 * Only the angle theta between two endpoints, seen from a, counts: that an endpoint lies behind the surface isn't
 * known. The weight is 1 at theta = 0, and 0 from 90 degrees on, for p = 0, too. Weights below 2^-120 are 0. p is any
 * float from 0 to infinity; below about 1e-6 the lobe is uniform. Radiance may be negative and of any size; a result
 * that no float holds is the largest one, and denormal radiance keeps the digits that it has.
 *
 * The pixel itself always counts. The result is L0 itself where p is 1e20 or more, where r = 0 (wherever the eye is),
 * where no other weight is above 0 and, in the paper's filter, where the radius is below 1. An eye on the surface
 * (s = 0) gives the radius of Theta itself; no radius exceeds the picture's diagonal. Without an eye or view angle it
 * is Theta over the angle between the endpoints of neighbouring pixels, seen from a: the smallest over the glossy ones
 * of the four neighbours; 0 where there are none.
 *
 * One call at a time for each filter. The first one builds what doesn't depend on the exponents; one with another mode,
 * formula or `without` builds it anew. What calls came before makes no difference to the result.
 *
 * RESULT_USAGE: no exponent, or an instruction set this processor lacks. RESULT_DATA: missing planes or sizes that
 * differ, memory. RESULT_INTERRUPTED. On failure both images are empty, and the filter may be applied again.
 */
MUST_CHECK enum result filter_apply(struct filter *filter, const struct filter_options *options, struct image *glossy,
                                    struct image *measure, struct error *err);

/* filter_open(), filter_apply() and filter_close(). */
MUST_CHECK enum result filter_glossy(const struct gbuffer *gbuffer, const struct filter_options *options,
                                     struct image *glossy, struct image *measure, struct error *err);

/* Pixels that are meant to be glossy, by an endpoint that isn't all zero and an exponent that isn't 0, and yet are not:
 * an exponent below 0 or NaN, W below 0, or NaN or infinity in position, endpoint or specular. The planes must be
 * there, of one size. */
long filter_left_out(const struct gbuffer *gbuffer);

#endif
