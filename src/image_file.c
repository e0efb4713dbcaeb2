/* The finished image as a file: which format, and which channels. */
#include "image_file.h"

#include "output_file.h"
#include "png_io.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *name;
    enum image_format format;
} formats[] = {{"exr", IMAGE_FORMAT_EXR}, {"png", IMAGE_FORMAT_PNG}};

static bool find_format(const char *name, enum image_format *format)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (strcasecmp(name, formats[i].name) == 0) {
            *format = formats[i].format;
            return true;
        }
    }
    return false;
}

enum result image_format_choose(const char *path, const char *name, enum image_format *format, struct error *err)
{
    if (name) {
        if (find_format(name, format))
            return RESULT_OK;
        return error_set(err, RESULT_USAGE, "unknown image format '%s'; choose --format exr or --format png", name);
    }
    const char *dot = strrchr(path, '.');
    if (dot && find_format(dot + 1, format))
        return RESULT_OK;
    return error_set(err, RESULT_USAGE,
                     "%s: the name doesn't tell the image format; end it in .exr or .png, or add --format exr|png",
                     output_file_name(path));
}

enum result image_write(const char *path, enum image_format format, int bits, const struct image *image,
                        const struct exr_channel *layers, int layer_count, struct error *err)
{
    assert(image->channels >= 3);
    if (format == IMAGE_FORMAT_PNG) {
        if (layer_count > 0)
            return error_set(err, RESULT_USAGE, "%s: a PNG holds no layers; write an EXR (--format exr)",
                             output_file_name(path));
        return png_write_srgb(path, image, bits, err);
    }

    static const char colour_names[3][2] = {"R", "G", "B"};
    size_t count = 3 + (size_t)layer_count;
    struct exr_channel *channels = calloc(count, sizeof *channels);
    if (!channels)
        return error_memory(err, (double)count * (double)sizeof *channels);
    for (int i = 0; i < 3; i++) {
        channels[i] = (struct exr_channel){.image = image, .channel = i};
        strcpy(channels[i].name, colour_names[i]);
    }
    if (layer_count > 0)
        memcpy(channels + 3, layers, (size_t)layer_count * sizeof *layers);
    enum result result = exr_write(path, channels, (int)count, NULL, err);
    free(channels);
    return result;
}
