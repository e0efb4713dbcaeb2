/* Planes of floats as PNG files, by libpng.
 *
 * libpng reports an error by a call that must not return, so there is one function with a setjmp.
 * Everything that it changes and that is needed after the jump lives in a struct behind a pointer, never in a local
 * variable, which a longjmp may leave with an old value.
 */
#include "png_io.h"

#include "output_file.h"

#include <assert.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A PNG that is being written. */
struct codec {
    jmp_buf failed;
    char message[256]; /* libpng's, valid after the jump */
    png_structp png;
    png_infop info;
    int bits;
    png_bytep pixels; /* a row of RGB */
    struct output_file output;
    enum result result; /* of the output, its message in *err */
    struct error *err;
    size_t bytes_lacking; /* memory that libpng couldn't have */
};

static png_voidp allocate(png_structp png, png_alloc_size_t size)
{
    struct codec *codec = png_get_mem_ptr(png);
    void *block = malloc(size);
    if (!block)
        codec->bytes_lacking = size;
    return block;
}

static void release(png_structp png, png_voidp block)
{
    (void)png;
    free(block);
}

static PNG_NORETURN void on_error(png_structp png, png_const_charp message)
{
    struct codec *codec = png_get_error_ptr(png);
    snprintf(codec->message, sizeof codec->message, "%s", message);
    longjmp(codec->failed, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png, (void)message;
}

/* The code of a linear value on the sRGB transfer curve (IEC 61966-2-1), to the nearest. */
static unsigned srgb_code(float linear, float largest)
{
    if (!(linear > 0))
        return 0;
    if (linear >= 1)
        return (unsigned)largest;
    float encoded = linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1 / 2.4f) - 0.055f;
    return (unsigned)(encoded * largest + 0.5f);
}

static void write_bytes(png_structp png, png_bytep data, size_t size)
{
    struct codec *codec = png_get_io_ptr(png);
    codec->result = output_file_write(&codec->output, data, size, codec->err);
    if (codec->result)
        png_error(png, codec->err->text);
}

static void flush_bytes(png_structp png)
{
    (void)png;
}

/* Encodes into codec->output. False: libpng or the output failed. */
static bool encode(struct codec *codec, const struct image *image)
{
    if (setjmp(codec->failed))
        return false;
    codec->png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, codec, on_error, on_warning, codec, allocate, release);
    codec->info = codec->png ? png_create_info_struct(codec->png) : NULL;
    if (!codec->info) {
        snprintf(codec->message, sizeof codec->message, "libpng cannot be started");
        return false;
    }
    png_set_write_fn(codec->png, codec, write_bytes, flush_bytes);
    png_set_IHDR(codec->png, codec->info, (png_uint_32)image->width, (png_uint_32)image->height, codec->bits,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(codec->png, codec->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(codec->png, codec->info);
    for (int y = 0; y < image->height; y++) {
        for (int channel = 0; channel < 3; channel++) {
            const float *from = image_row(image, channel, y);
            for (int x = 0; x < image->width; x++) {
                int sample = 3 * x + channel;
                unsigned code = srgb_code(from[x], codec->bits == 16 ? 65535.0f : 255.0f);
                if (codec->bits == 16) {
                    codec->pixels[2 * sample] = (png_byte)(code >> 8);
                    codec->pixels[2 * sample + 1] = (png_byte)(code & 255);
                } else {
                    codec->pixels[sample] = (png_byte)code;
                }
            }
        }
        png_write_row(codec->png, codec->pixels);
    }
    png_write_end(codec->png, codec->info);
    return true;
}

enum result png_write_srgb(const char *path, const struct image *image, int bits, struct error *err)
{
    assert((bits == 8 || bits == 16) && image->channels >= 3);
    struct codec codec = {.bits = bits, .err = err};
    enum result result = output_file_open(&codec.output, path, err);
    if (result)
        return result;
    size_t row_bytes = 3 * (size_t)image->width * (size_t)bits / 8;
    codec.pixels = malloc(row_bytes);
    if (!codec.pixels) {
        result = error_memory(err, (double)row_bytes);
        goto out;
    }
    if (!encode(&codec, image)) {
        result = codec.result          ? codec.result
                 : codec.bytes_lacking ? error_memory(err, (double)codec.bytes_lacking)
                                       : error_set(err, RESULT_DATA, "%s: the PNG file cannot be made (%s)",
                                          output_file_name(path), codec.message);
        goto out;
    }
    result = output_file_commit(&codec.output, err);
out:
    output_file_abort(&codec.output);
    png_destroy_write_struct(&codec.png, &codec.info);
    free(codec.pixels);
    return result;
}
