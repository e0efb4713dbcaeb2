/* An image as planes of floats: the only form in which pixels travel through the library. */
#ifndef POVGLOSS_IMAGE_H
#define POVGLOSS_IMAGE_H

#include "error.h"

#include <stddef.h>
#include <stdint.h>

/* Limits on what is accepted from a file or a command line, per side and per plane. */
enum { IMAGE_MAX_SIDE = 65535 };

struct image {
    int width, height; /* pixels */
    int channels;
    size_t stride; /* floats from one row to the next: width rounded up to a multiple of 16 */
    float *pixels; /* channels planes of height rows, 64-byte aligned; NULL: there is no image */
};

/* A rectangle in pixels of an image, parts of which may lie outside of it. */
struct image_window {
    int64_t left, top;
    int width, height;
};

/* Allocates a zeroed image (the padding of each row included). Sizes from 1 to IMAGE_MAX_SIDE, else RESULT_DATA; so is
 * a lack of memory. On failure *image is empty. The caller frees it. */
MUST_CHECK enum result image_alloc(struct image *image, int width, int height, int channels, struct error *err);

/* Frees the pixels and leaves an empty image; an empty image is fine. */
void image_free(struct image *image);

/* Replaces the image by what the window shows of it, 0 outside of it. RESULT_DATA: sizes, memory; the image is then as
 * it was. */
MUST_CHECK enum result image_crop(struct image *image, const struct image_window *window, struct error *err);

/* First float of row y of a channel. */
static inline float *image_row(const struct image *image, int channel, int y)
{
    return image->pixels + ((size_t)channel * (size_t)image->height + (size_t)y) * image->stride;
}

#endif
