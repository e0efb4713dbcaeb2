/* World positions and directions as colours: what the coded passes render, and its way back.
 *
 * A point p is coded by its place in the net of a cube about the origin, as POV-Ray's cubic warp unfolds it, and by the
 * logarithm of its largest coordinate m = max(|x|, |y|, |z|):
 *
 *            top                       Y = 1
 *   left     front     right    back   Y = 2/3 .. 1/3      X = 0 .. 1, a quarter a face
 *            bottom                    Y = 0
 *
 * On the front (z = m) X = 1/4 + (x/z + 1)/8, Y = 1/3 + (y/z + 1)/6. The digits v = 0.001 + 0.998 X, 0.001 + 0.998 Y
 * and 1/20 + 9/10 (log10 m + 12)/24, for m from 1e-12 to 1e12, lie strictly inside (0, 1): black is "nothing here". A
 * first image holds v in 16 bits, a second one the fraction of 16384 v; together they have 30 bits, a relative error of
 * |p| below 1e-7 at every scale. The third digits of a direction are 0.975 in both images.
 *
 * A unit direction d where no positions are is v = 1/2 + 0.499 d in 16 bits.
 */
#ifndef POVGLOSS_POSITION_CODE_H
#define POVGLOSS_POSITION_CODE_H

#include "gbuffer.h"
#include "mem.h"

enum position_digits {
    POSITION_DIGITS_HIGH,
    POSITION_DIGITS_LOW,
    POSITION_DIGITS_ALL, /* of a direction */
};

/* Scene text of a pigment that colours every point (for a sky_sphere with `direction`: every direction) by its
 * digits. */
MUST_CHECK enum result position_code_pigment(struct buffer *text, bool direction, enum position_digits digits,
                                             struct error *err);

/* Decodes two images of digits (codes from 0 to 1, 3 channels) into X Y Z W planes (allocated here): W = 1 a position,
 * W = 0 a unit direction, all 0 where the image is black. Without low digits (NULL) the image has all digits of
 * directions, about 1e-5 of each. */
MUST_CHECK enum result position_code_decode(const struct image *high, const struct image *low, struct image *decoded,
                                            struct error *err);

/* Undoes the mixing of coded surfaces with black ones: where `share` (the plane of that channel, 0 to 1) says which
 * part of a pixel's texture was coded, both images of digits are divided by it. Of a share below 0.3 the high digits
 * alone are kept, about 1e-3 of the distance; one below 0.02 is left as it is. The three images are of one size. */
void position_code_unmix(struct image *high, struct image *low, const struct image *share, int channel);

#endif
