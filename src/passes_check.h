/* What is wrong with a passes file: the renderer wrote it, and the picture alone doesn't tell. */
#ifndef POVGLOSS_PASSES_CHECK_H
#define POVGLOSS_PASSES_CHECK_H

#include "passes_file.h"

/* Appends to *report, a line each: under which names the channels were found, what is missing and what follows, and
 * what is wrong with the values. `found` and `gbuffer` are of passes_file_read_mapped(). *wrong is the number of lines
 * about a required channel that is missing and of those that begin with "wrong:". Those are, with all channels there:
 *   nothing is glossy;
 *   values that aren't finite, an endpoint's W below 0, or a position of 0, 0, 0, where a pixel is glossy;
 *   an exponent below 0 or NaN;
 *   1 % of the positions lie more than 0.1 pixels off the ray through their pixel's centre (if the eye is known);
 *   the position or endpoint lies between near and far at 3 of 10 silhouettes, as an average over the pixel does;
 *   W is 0 or 1, but in 0.1 % of the glossy pixels something else;
 *   1 % of the mirrored rays end where they begin.
 */
MUST_CHECK enum result passes_check(const struct gbuffer *gbuffer, const struct passes_found *found,
                                    struct buffer *report, int *wrong, struct error *err);

#endif
