/* A contact sheet: pictures of one size side by side, with a line of text above each. */
#ifndef POVGLOSS_SHEET_H
#define POVGLOSS_SHEET_H

#include "image.h"

/* Allocates a sheet (3 channels, linear) of `count` pictures of width x height pixels in as many columns as the square
 * root of their number, rounded up. The caller frees it. RESULT_DATA: a side above IMAGE_MAX_SIDE, memory. */
MUST_CHECK enum result sheet_alloc(struct image *sheet, int count, int width, int height, struct error *err);

/* Copies the first 3 channels of the picture to its place, and the label above it: of a text, the letters e f i n p,
 * digits and . + - = are drawn, everything else is a space; what is too long is cut off. */
void sheet_put(struct image *sheet, int count, int index, const struct image *picture, const char *label);

#endif
