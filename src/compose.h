/* The finished picture from the passes and the blurred reflection. */
#ifndef POVGLOSS_COMPOSE_H
#define POVGLOSS_COMPOSE_H

#include "gbuffer.h"

/* image (allocated here, 3 channels, linear; the caller frees it) = base + reflectance * glossy, added and multiplied
 * in the space of the renderer, in which a linear value v is v^(1/g), g being gbuffer->working_gamma (0 or 1: linear;
 * GBUFFER_GAMMA_SRGB: the sRGB curve):
 *   image = (base^(1/g) + reflectance glossy^(1/g))^g
 * A power keeps the sign of a negative value. A missing base is 0, a missing reflectance 1 (glossy is 0 where nothing
 * is glossy). NaN and infinity stay in their pixel; 0 times infinity is 0. RESULT_DATA: sizes that differ, memory; the
 * image is then empty.
 */
MUST_CHECK enum result compose(const struct gbuffer *gbuffer, const struct image *glossy, struct image *image,
                               struct error *err);

#endif
