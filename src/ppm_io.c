/* The header is text (netpbm's ppm(5)): P6, width, height and largest code, with comments between them; then come two
 * bytes a sample, the high one first. */
#include "ppm_io.h"

#include "input_file.h"

#include <ctype.h>
#include <stdbool.h>

enum { LARGEST = 65535, SAMPLE_BYTES = 2, CHANNELS = 3 };

/* What is still to be read. */
struct bytes {
    const unsigned char *at, *end;
};

static void skip_space(struct bytes *bytes)
{
    bool comment = false;
    for (; bytes->at < bytes->end && (comment || *bytes->at == '#' || isspace(*bytes->at)); bytes->at++)
        comment = (comment || *bytes->at == '#') && *bytes->at != '\n';
}

/* A number of the header, at most LARGEST; -1: there is none. */
static int read_number(struct bytes *bytes)
{
    int number = -1;
    skip_space(bytes);
    for (; bytes->at < bytes->end && isdigit(*bytes->at) && number <= LARGEST; bytes->at++)
        number = (number < 0 ? 0 : 10 * number) + (*bytes->at - '0');
    return number <= LARGEST ? number : -1;
}

/* The last white space of the header is one byte: what follows may look like more of it. */
static bool read_header(struct bytes *bytes, int *width, int *height)
{
    if (bytes->end - bytes->at < 2 || bytes->at[0] != 'P' || bytes->at[1] != '6')
        return false;
    bytes->at += 2;
    *width = read_number(bytes);
    *height = read_number(bytes);
    return read_number(bytes) == LARGEST && *width > 0 && *height > 0 && bytes->at < bytes->end && isspace(*bytes->at++);
}

static void unpack(const unsigned char *from, struct image *image)
{
    for (int y = 0; y < image->height; y++) {
        float *rows[CHANNELS];
        for (int channel = 0; channel < CHANNELS; channel++)
            rows[channel] = image_row(image, channel, y);
        for (int x = 0; x < image->width; x++)
            for (int channel = 0; channel < CHANNELS; channel++, from += SAMPLE_BYTES)
                rows[channel][x] = (float)(from[0] << 8 | from[1]) / (float)LARGEST;
    }
}

enum result ppm_read(const char *path, struct image *image, struct error *err)
{
    struct input_file input;
    int width, height;
    *image = (struct image){0};
    enum result result = input_file_read(path, &input, err);
    if (result)
        return result;
    struct bytes bytes = {.at = input.data, .end = input.data + input.size};
    if (!read_header(&bytes, &width, &height))
        result = error_set(err, RESULT_DATA, "%s: %s", path, input.size == 0 ? "is empty" : "not a PPM file of 16 bits");
    else if ((bytes.end - bytes.at) / (CHANNELS * SAMPLE_BYTES) / width < height)
        result = error_set(err, RESULT_DATA, "%s: the PPM file ends too early", path);
    else
        result = image_alloc(image, width, height, CHANNELS, err);
    if (!result)
        unpack(bytes.at, image);
    input_file_free(&input);
    return result;
}
