/* The paper's subsampling mode: L0, a and b of few pixels, interpolated bilinearly to all of them. */
#ifndef POVGLOSS_INTERPOLATE_H
#define POVGLOSS_INTERPOLATE_H

#include "gbuffer.h"

/* Replaces specular, position, endpoint and phong by planes of the size of the reflectance. A pixel with any
 * reflectance is glossy; its values are bilinear between the (up to 4) glossy samples around its centre, or those of
 * the nearest of the 16 around it if there is none; without one it isn't glossy. Endpoints are interpolated as
 * positions when all of them are positions, and as directions otherwise; the exponent is the nearest sample's. */
MUST_CHECK enum result interpolate_gbuffer(struct gbuffer *gbuffer, struct error *err);

#endif
