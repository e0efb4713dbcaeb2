/* The finished image as a file: EXR (linear) or PNG (sRGB). */
#ifndef POVGLOSS_IMAGE_FILE_H
#define POVGLOSS_IMAGE_FILE_H

#include "exr_io.h"

enum image_format { IMAGE_FORMAT_EXR, IMAGE_FORMAT_PNG };

/* The format of that name ("exr", "png"), or with `name` NULL the one of the path's extension; case doesn't matter.
 * RESULT_USAGE for any other, with a message that says how to choose. */
MUST_CHECK enum result image_format_choose(const char *path, const char *name, enum image_format *format,
                                           struct error *err);

/* Writes the first 3 channels of a linear image as R G B. EXR: 32-bit float, with the layers (further channels of
 * images of the same size; none: NULL, 0); PNG: sRGB of 8 or 16 bits, and RESULT_USAGE if there are layers. "-" is
 * standard output; otherwise the file appears whole or not at all. */
MUST_CHECK enum result image_write(const char *path, enum image_format format, int bits, const struct image *image,
                                   const struct exr_channel *layers, int layer_count, struct error *err);

#endif
