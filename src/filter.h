/* The paper's filter, equations (1) to (6): glossy radiance from a gbuffer.
 *
 * "Fuzzy reflections rendering", Kulikova and Dmitriev, 2002.
 */
#ifndef POVGLOSS_FILTER_H
#define POVGLOSS_FILTER_H

#include "gbuffer.h"

enum filter_weights { FILTER_WEIGHTS_EXACT, FILTER_WEIGHTS_TABLE, FILTER_WEIGHTS_GAUSS };
enum filter_formula { FILTER_FORMULA_PHONG, FILTER_FORMULA_MAX }; /* equation (3), equation (2) */
enum filter_window { FILTER_WINDOW_ROUND, FILTER_WINDOW_SQUARE };

struct filter_options {
    enum filter_weights weights;
    enum filter_formula formula;
    enum filter_window window;
    float phong;          /* exponent where the gbuffer has none: 0 to infinity */
    double energy;        /* share of the lobe's energy within Theta, (0, 1) */
    double max_angle_rad; /* upper limit of Theta, (0, pi/2] */
    int max_radius_px;    /* upper limit of the radius; 0: none */
    int radius_step;      /* 1, 2, 4 or 8: the radius is computed at every so-many-th pixel and interpolated */
    int threads;          /* 0: as many as there are cores */
};

struct filter_options filter_options_default(void);

/* glossy (allocated here, 3 channels; the caller frees it) = the specular plane blurred where the pixel is glossy; where
 * it is not glossy but the reflectance is above 0 (an antialiased edge) the mean of the nearest glossy pixels' results;
 * 0 elsewhere. radius, where not NULL, is allocated too: 1 channel, the radius of equation (5) in pixels.
 */
MUST_CHECK enum result filter_glossy(const struct gbuffer *gbuffer, const struct filter_options *options,
                                     struct image *glossy, struct image *radius, struct error *err);

#endif
