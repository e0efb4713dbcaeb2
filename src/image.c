/* Allocation of planes: one block of memory, rows padded to whole vectors. */
#include "image.h"

#include <assert.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum result image_alloc(struct image *image, int width, int height, int channels, struct error *err)
{
    assert(channels > 0);
    *image = (struct image){0};
    if (width < 1 || height < 1 || width > IMAGE_MAX_SIDE || height > IMAGE_MAX_SIDE)
        return error_set(err, RESULT_DATA, "an image of %d x %d pixels: each side must be from 1 to %d", width, height,
                         IMAGE_MAX_SIDE);
    size_t stride = ((size_t)width + 15) / 16 * 16;
    size_t bytes = stride * (size_t)height * (size_t)channels * sizeof(float);
    float *pixels = aligned_alloc(64, bytes);
    if (!pixels)
        return error_memory(err, (double)bytes);
    memset(pixels, 0, bytes);
    *image = (struct image){.width = width, .height = height, .channels = channels, .stride = stride, .pixels = pixels};
    return RESULT_OK;
}

void image_free(struct image *image)
{
    free(image->pixels);
    *image = (struct image){0};
}
