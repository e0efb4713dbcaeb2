/* PNG files against libpng, oiiotool and POV-Ray, and damaged ones. */
#include "png_io.h"

#include "io_support.h"

#include <png.h>
#include <stdbool.h>

/* Writes codes (interleaved; 2 bytes a sample at 16 bits, packed below 8) as they are, as a PNG of any kind. */
static void make_png(const char *path, int width, int height, int bits, int colour_type, bool interlaced,
                     const unsigned char *rows, size_t row_bytes)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, bits, colour_type,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    /* What a reader could wrongly apply. */
    png_set_gAMA(png, info, 0.45455);
    if (colour_type == PNG_COLOR_TYPE_PALETTE) {
        png_color palette[4] = {{0, 1, 2}, {10, 20, 30}, {255, 254, 253}, {127, 128, 129}};
        png_byte alpha[2] = {0, 128};
        png_set_PLTE(png, info, palette, 4);
        png_set_tRNS(png, info, alpha, 2, NULL);
    }
    png_write_info(png, info);
    int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; pass++)
        for (int y = 0; y < height; y++)
            png_write_row(png, rows + (size_t)y * row_bytes);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(file), 0);
}

static int code_of(const struct image *image, int channel, int x, int y, int largest)
{
    float value = image_row(image, channel, y)[x];
    long code = lrintf(value * (float)largest);
    assert_near(value, (float)code / (float)largest, 0);
    return (int)code;
}

static void png_read__16_bit__every_code_exact(void **state)
{
    (void)state;
    unsigned char *rows = malloc(256 * 256 * 6);
    assert_non_null(rows);
    for (int n = 0; n < 256 * 256; n++)
        for (int channel = 0; channel < 3; channel++) {
            int code = (n + channel * 21845) & 65535;
            rows[6 * n + 2 * channel] = (unsigned char)(code >> 8);
            rows[6 * n + 2 * channel + 1] = (unsigned char)code;
        }
    for (int interlaced = 0; interlaced < 2; interlaced++) {
        struct image image;
        struct error err;
        make_png(in_scratch("a.png"), 256, 256, 16, PNG_COLOR_TYPE_RGB, interlaced, rows, 256 * 6);
        assert_ok(png_read(in_scratch("a.png"), &image, &err), err);
        assert_int_equal(image.channels, 3);
        for (int n = 0; n < 256 * 256; n++)
            for (int channel = 0; channel < 3; channel++)
                assert_int_equal(code_of(&image, channel, n % 256, n / 256, 65535), (n + channel * 21845) & 65535);
        image_free(&image);
    }
    free(rows);
}

static void png_read__8_bit_with_and_without_alpha__colours_as_stored(void **state)
{
    (void)state;
    unsigned char rows[256 * 4];
    for (int channels = 3; channels <= 4; channels++) {
        struct image image;
        struct error err;
        for (int n = 0; n < 256; n++)
            for (int channel = 0; channel < channels; channel++)
                rows[channels * n + channel] = (unsigned char)(n + 50 * channel);
        make_png(in_scratch("b.png"), 256, 1, 8, channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, false,
                 rows, sizeof rows);
        assert_ok(png_read(in_scratch("b.png"), &image, &err), err);
        assert_int_equal(image.channels, 3);
        for (int n = 0; n < 256; n++)
            for (int channel = 0; channel < 3; channel++)
                assert_int_equal(code_of(&image, channel, n, 0, 255), (n + 50 * channel) & 255);
        image_free(&image);
    }
}

static void png_read__grey__three_equal_channels(void **state)
{
    (void)state;
    for (int bits = 1; bits <= 16; bits *= 2)
        for (int alpha = 0; alpha < 2; alpha++) {
            if (alpha && bits < 8)
                continue;
            enum { WIDTH = 16 };
            unsigned char row[WIDTH * 4] = {0};
            int largest = (1 << bits) - 1, codes[WIDTH];
            for (int x = 0; x < WIDTH; x++) {
                int code = codes[x] = (x * 4097) & largest;
                if (bits == 16) {
                    row[2 * x * (1 + alpha)] = (unsigned char)(code >> 8);
                    row[2 * x * (1 + alpha) + 1] = (unsigned char)code;
                } else if (bits == 8) {
                    row[x * (1 + alpha)] = (unsigned char)code;
                } else {
                    row[x * bits / 8] |= (unsigned char)(code << (8 - bits - x * bits % 8));
                }
            }
            struct image image;
            struct error err;
            make_png(in_scratch("c.png"), WIDTH, 1, bits, alpha ? PNG_COLOR_TYPE_GRAY_ALPHA : PNG_COLOR_TYPE_GRAY,
                     false, row, sizeof row);
            assert_ok(png_read(in_scratch("c.png"), &image, &err), err);
            for (int x = 0; x < WIDTH; x++)
                for (int channel = 0; channel < 3; channel++)
                    assert_near(image_row(&image, channel, 0)[x], (double)codes[x] / largest, 1e-7);
            image_free(&image);
        }
}

static void png_read__palette_with_transparency__its_colours(void **state)
{
    (void)state;
    static const int expected[4][3] = {{0, 1, 2}, {10, 20, 30}, {255, 254, 253}, {127, 128, 129}};
    const unsigned char row[1] = {0x1b}; /* 0 1 2 3 at two bits */
    struct image image;
    struct error err;
    make_png(in_scratch("d.png"), 4, 1, 2, PNG_COLOR_TYPE_PALETTE, false, row, 1);
    assert_ok(png_read(in_scratch("d.png"), &image, &err), err);
    for (int x = 0; x < 4; x++)
        for (int channel = 0; channel < 3; channel++)
            assert_int_equal(code_of(&image, channel, x, 0, 255), expected[x][channel]);
    image_free(&image);
}

/* The sRGB curve in double. */
static double srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

static void png_write_srgb__values_in_range__nearest_code_of_the_curve(void **state)
{
    (void)state;
    for (int bits = 8; bits <= 16; bits += 8) {
        int largest = bits == 8 ? 255 : 65535;
        struct image image, seen;
        struct error err;
        assert_ok(image_alloc(&image, 1000, 3, 3, &err), err);
        for (int n = 0; n < 9000; n++) /* finest near 0, the straight piece and its end included */
            image_row(&image, n / 3000, n / 1000 % 3)[n % 1000] = (float)pow(n / 8999.0, 3);
        assert_ok(png_write_srgb(in_scratch("e.png"), &image, bits, &err), err);
        assert_contains(run("oiiotool --info -v e.png"), bits == 8 ? "3 channel, uint8 png" : "3 channel, uint16 png");
        run("head -c 64 e.png | grep -q sRGB"); /* the chunk that names the curve */
        assert_ok(png_read(in_scratch("e.png"), &seen, &err), err);
        for (int n = 0; n < 9000; n++) {
            int channel = n / 3000, y = n / 1000 % 3, x = n % 1000;
            double exact = srgb(image_row(&image, channel, y)[x]) * largest;
            /* Half a code, and the rounding of a float at 65535. */
            assert_near(code_of(&seen, channel, x, y, largest), exact, bits == 8 ? 0.5001 : 0.52);
        }
        image_free(&image);
        image_free(&seen);
    }
}

static void png_write_srgb__values_out_of_range__clipped(void **state)
{
    (void)state;
    static const float values[] = {-1, -0.0f, NAN, -NAN, -INFINITY, INFINITY, 1, 1.0000001f, 65504, 3e38f, 1e-45f};
    static const int expected[] = {0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 0};
    enum { COUNT = sizeof values / sizeof values[0] };
    for (int bits = 8; bits <= 16; bits += 8) {
        struct image image, seen;
        struct error err;
        assert_ok(image_alloc(&image, COUNT, 1, 4, &err), err);
        for (int channel = 0; channel < 4; channel++)
            memcpy(image_row(&image, channel, 0), values, sizeof values);
        assert_ok(png_write_srgb(in_scratch("f.png"), &image, bits, &err), err);
        assert_ok(png_read(in_scratch("f.png"), &seen, &err), err);
        assert_int_equal(seen.channels, 3);
        for (int x = 0; x < COUNT; x++)
            for (int channel = 0; channel < 3; channel++)
                assert_int_equal(code_of(&seen, channel, x, 0, 1), expected[x]);
        image_free(&image);
        image_free(&seen);
    }
}

static void png_write_srgb__all_sizes__read_back(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 40}, {40, 1}, {17, 3}, {300, 33}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        struct image image, seen;
        struct error err;
        assert_ok(image_alloc(&image, sizes[i][0], sizes[i][1], 3, &err), err);
        int n = 0;
        for (int channel = 0; channel < 3; channel++)
            for (int y = 0; y < image.height; y++)
                for (int x = 0; x < image.width; x++)
                    image_row(&image, channel, y)[x] = (float)(n++ % 997) / 996.0f;
        assert_ok(png_write_srgb(in_scratch("g.png"), &image, 16, &err), err);
        assert_ok(png_read(in_scratch("g.png"), &seen, &err), err);
        assert_int_equal(seen.width, image.width);
        assert_int_equal(seen.height, image.height);
        for (int channel = 0; channel < 3; channel++)
            for (int y = 0; y < image.height; y++)
                for (int x = 0; x < image.width; x++)
                    assert_near(image_row(&seen, channel, y)[x], srgb(image_row(&image, channel, y)[x]), 1e-5);
        image_free(&image);
        image_free(&seen);
    }
}

static void png_write_srgb__values_rendered_by_povray__same_codes_as_povray(void **state)
{
    (void)state;
    static const char scene[] =
        "#version 3.7; global_settings { assumed_gamma 1.0 }\n"
        "camera { orthographic location <128, 128, -10> right x*256 up y*256 direction z }\n"
        "#declare F = function(x, y, z) { (floor(x) + 256*(255 - floor(y)))/65535 }\n"
        "plane { z, 0 pigment { function { F(x, y, z) } color_map { [0 rgb 0] [1 rgb 1] } }\n"
        "        finish { emission 1 ambient 0 diffuse 0 } }\n";
    struct image linear, povray, ours;
    struct error err;
    write_bytes(in_scratch("scene.pov"), scene, sizeof scene - 1);
    run("POVINI= povray +Iscene.pov +Olinear.png +FN16 File_Gamma=1.0 +W256 +H256 -A -D -GA");
    assert_ok(png_read(in_scratch("linear.png"), &linear, &err), err);
    for (int n = 0; n < 65536; n++)
        assert_int_equal(code_of(&linear, 0, n % 256, n / 256, 65535), n);
    for (int bits = 8; bits <= 16; bits += 8) {
        run("POVINI= povray +Iscene.pov +Opovray.png +FN%d +W256 +H256 -A -D -GA", bits);
        assert_ok(png_read(in_scratch("povray.png"), &povray, &err), err);
        assert_ok(png_write_srgb(in_scratch("ours.png"), &linear, bits, &err), err);
        assert_ok(png_read(in_scratch("ours.png"), &ours, &err), err);
        for (int channel = 0; channel < 3; channel++)
            assert_same_plane(&povray, channel, &ours, channel);
        image_free(&povray);
        image_free(&ours);
    }
    image_free(&linear);
}

/* The file is refused with a message that holds its name and `part`. */
static void assert_refused(const char *name, const char *part)
{
    struct image image;
    struct error err;
    enum result result = png_read(in_scratch(name), &image, &err);
    if (result != RESULT_DATA)
        fail_msg("%s: result %d", name, result);
    assert_null(image.pixels);
    assert_contains(err.text, name);
    assert_contains(err.text, part);
}

static void png_read__not_a_png__says_so(void **state)
{
    (void)state;
    write_bytes(in_scratch("empty.png"), "", 0);
    assert_refused("empty.png", "is empty");
    write_bytes(in_scratch("text.png"), "not a picture", 13);
    assert_refused("text.png", "not a PNG file");
    write_bytes(in_scratch("signature.png"), "\x89PNG\r\n\x1a\n", 8);
    assert_refused("signature.png", "ends too early");
    assert_refused("absent.png", "No such file or directory");
}

static void png_read__cut_or_damaged_anywhere__refused_or_read(void **state)
{
    (void)state;
    struct image image;
    struct error err;
    size_t size;
    assert_ok(image_alloc(&image, 17, 3, 3, &err), err);
    fill_distinct(&image);
    assert_ok(png_write_srgb(in_scratch("h.png"), &image, 16, &err), err);
    image_free(&image);
    unsigned char *data = read_bytes(in_scratch("h.png"), &size);
    for (size_t length = 0; length < size; length++) {
        write_bytes(in_scratch("cut.png"), data, length);
        assert_refused("cut.png", "");
    }
    int refused = 0;
    for (size_t at = 0; at < size; at++) {
        data[at] ^= 0x55;
        write_bytes(in_scratch("bad.png"), data, size);
        data[at] ^= 0x55;
        enum result result = png_read(in_scratch("bad.png"), &image, &err);
        assert_true(result == RESULT_OK || result == RESULT_DATA);
        refused += result != RESULT_OK;
        image_free(&image);
    }
    assert_true(refused > 100);
    free(data);
}

static void png_read__huge_size_in_the_header__refused(void **state)
{
    (void)state;
    static const char *const sizes[] = {"65536x1", "1x65536"};
    for (int i = 0; i < 2; i++) {
        run("oiiotool --create %s 3 -d uint8 -o big.png", sizes[i]);
        assert_refused("big.png", "too large");
    }
}

/* One row more than so few bytes can hold. */
static void png_read__more_pixels_than_deflate_can_hold__refused_without_the_memory(void **state)
{
    (void)state;
    static const unsigned char header[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R',
                                           0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff, 8, 2, 0, 0, 0, 0x39, 0x67, 0x4e, 0x07,
                                           0, 0, 0, 0, 'I', 'D', 'A', 'T', 0x35, 0xaf, 0x06, 0x1e};
    write_bytes(in_scratch("bomb.png"), header, sizeof header);
    assert_refused("bomb.png", "so few bytes");
}

static void png_write_srgb__output_fails__says_why_and_leaves_nothing(void **state)
{
    (void)state;
    struct image image;
    struct error err;
    assert_ok(image_alloc(&image, 300, 300, 3, &err), err);
    fill_distinct(&image);
    assert_int_equal(png_write_srgb(full_device(), &image, 16, &err), RESULT_DATA);
    assert_contains(err.text, "full: cannot be written: No space left on device");
    assert_int_equal(png_write_srgb(in_scratch("missing/a.png"), &image, 8, &err), RESULT_DATA);
    assert_contains(err.text, "mkdir -p");
    assert_string_equal(run("ls -A | grep '^\\.' || true"), "");
    image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_read__16_bit__every_code_exact),
        cmocka_unit_test(png_read__8_bit_with_and_without_alpha__colours_as_stored),
        cmocka_unit_test(png_read__grey__three_equal_channels),
        cmocka_unit_test(png_read__palette_with_transparency__its_colours),
        cmocka_unit_test(png_write_srgb__values_in_range__nearest_code_of_the_curve),
        cmocka_unit_test(png_write_srgb__values_out_of_range__clipped),
        cmocka_unit_test(png_write_srgb__all_sizes__read_back),
        cmocka_unit_test(png_write_srgb__values_rendered_by_povray__same_codes_as_povray),
        cmocka_unit_test(png_read__not_a_png__says_so),
        cmocka_unit_test(png_read__cut_or_damaged_anywhere__refused_or_read),
        cmocka_unit_test(png_read__huge_size_in_the_header__refused),
        cmocka_unit_test(png_read__more_pixels_than_deflate_can_hold__refused_without_the_memory),
        cmocka_unit_test(png_write_srgb__output_fails__says_why_and_leaves_nothing),
    };
    return cmocka_run_group_tests_name("png_io", tests, scratch_setup, scratch_teardown);
}
