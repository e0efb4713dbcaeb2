/* Allocation of planes: one block of memory, rows padded to whole vectors. */
#include "image.h"

#include <assert.h>
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

enum result image_crop(struct image *image, const struct image_window *window, struct error *err)
{
    struct image cropped;
    enum result result = image_alloc(&cropped, window->width, window->height, image->channels, err);
    if (result)
        return result;
    int64_t first = window->left > 0 ? window->left : 0;
    int64_t end = window->left + window->width < image->width ? window->left + window->width : image->width;
    for (int channel = 0; channel < image->channels; channel++)
        for (int y = 0; y < cropped.height; y++) {
            int64_t from = window->top + y;
            if (from >= 0 && from < image->height && first < end)
                memcpy(image_row(&cropped, channel, y) + (first - window->left),
                       image_row(image, channel, (int)from) + first, (size_t)(end - first) * sizeof(float));
        }
    image_free(image);
    *image = cropped;
    return RESULT_OK;
}
