/* Planes of floats as PNG files. */
#ifndef POVGLOSS_PNG_IO_H
#define POVGLOSS_PNG_IO_H

#include "image.h"

/* Writes the first 3 channels of a linear image through the sRGB transfer curve at 8 or 16 bits, tagged sRGB; values
 * are clipped to [0, 1], NaN becomes 0. `path` "-" is standard output; else through a temporary file in the same
 * folder. */
MUST_CHECK enum result png_write_srgb(const char *path, const struct image *image, int bits, struct error *err);

#endif
