/* Everything the filter knows of a picture: the passes, as planes of floats of one size.
 *
 * The paper's names: position is a, endpoint is b, specular is L0.
 */
#ifndef POVGLOSS_GBUFFER_H
#define POVGLOSS_GBUFFER_H

#include "image.h"

#include <stdbool.h>

struct gbuffer {
    struct image base;        /* R G B, linear: the picture without the glossy reflection; may be empty (black) */
    struct image specular;    /* R G B, linear: L0, radiance along the ideal mirror direction */
    struct image reflectance; /* R G B: reflectivity times coverage; may be empty (1 where glossy) */
    struct image position;    /* X Y Z: a, world units */
    struct image endpoint;    /* X Y Z W: b, homogeneous; W = 0 is a direction */
    struct image phong;       /* 1 channel: Phong exponent; 0 (or less, or NaN) not glossy, infinity a mirror; may be empty
                                 (the filter's exponent applies wherever the endpoint is not all zero) */
    struct image direction;   /* X Y Z: unit vectors along the eye's rays, */
    struct image mirrored;    /* and along the mirrored ones; for probes, else empty: no passes file holds them */
    struct image rays;        /* R G B A: mean radiance of further rays of the lobe of `phong`, and how many; may be empty */
    bool has_eye;
    float eye[3];       /* world units; without it the footprint comes from the gradient of the direction field */
    float view_angle;   /* of the planes' width, radians; 0: unknown */
    float working_gamma; /* exponent of the space in which the renderer added its terms (POV-Ray's assumed_gamma);
                            0 or 1: linear; GBUFFER_GAMMA_SRGB: the sRGB curve */
    struct image_window window; /* the picture in the planes, which may be wider or smaller; width 0: all of them */
};

#define GBUFFER_GAMMA_SRGB (-1.0f)

/* Whether something glossy is at the pixel: its exponent is above 0 (or there is no plane of them), its endpoint not
 * all zero. */
bool gbuffer_is_glossy(const struct gbuffer *gbuffer, int x, int y);

/* Puts the pixels of `part` where all planes of *whole are 0, and frees it: bands of one picture, each rendered by
 * itself in planes of the whole size that are 0 elsewhere. Of the eye and the view angle those of the first that has
 * them count. RESULT_DATA: planes or sizes differ; *part is freed then, too. */
MUST_CHECK enum result gbuffer_join(struct gbuffer *whole, struct gbuffer *part, struct error *err);

/* Frees all planes and clears the rest. */
void gbuffer_free(struct gbuffer *gbuffer);

#endif
