/* PNG files against libpng, oiiotool and POV-Ray. */
#include "png_io.h"

#include "io_support.h"

#include <png.h>
#include <stdbool.h>

/* The codes of an RGB file, divided by the largest one. */
static struct image read_png(const char *path)
{
    struct image image;
    struct error err;
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    assert_int_equal(png_get_channels(png, info), 3);
    assert_ok(image_alloc(&image, (int)png_get_image_width(png, info), (int)png_get_image_height(png, info), 3, &err), err);
    bool two_bytes = png_get_bit_depth(png, info) == 16;
    for (int y = 0; y < image.height; y++)
        for (int n = 0; n < 3 * image.width; n++) {
            const png_byte *row = png_get_rows(png, info)[y];
            image_row(&image, n % 3, y)[n / 3] =
                two_bytes ? (float)(row[2 * n] << 8 | row[2 * n + 1]) / 65535.0f : (float)row[n] / 255.0f;
        }
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
    return image;
}

static int code_of(const struct image *image, int channel, int x, int y, int largest)
{
    float value = image_row(image, channel, y)[x];
    long code = lrintf(value * (float)largest);
    assert_near(value, (float)code / (float)largest, 0);
    return (int)code;
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
        seen = read_png(in_scratch("e.png"));
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
        seen = read_png(in_scratch("f.png"));
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
        seen = read_png(in_scratch("g.png"));
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
    linear = read_png(in_scratch("linear.png"));
    for (int n = 0; n < 65536; n++)
        assert_int_equal(code_of(&linear, 0, n % 256, n / 256, 65535), n);
    for (int bits = 8; bits <= 16; bits += 8) {
        run("POVINI= povray +Iscene.pov +Opovray.png +FN%d +W256 +H256 -A -D -GA", bits);
        povray = read_png(in_scratch("povray.png"));
        assert_ok(png_write_srgb(in_scratch("ours.png"), &linear, bits, &err), err);
        ours = read_png(in_scratch("ours.png"));
        for (int channel = 0; channel < 3; channel++)
            assert_same_plane(&povray, channel, &ours, channel);
        image_free(&povray);
        image_free(&ours);
    }
    image_free(&linear);
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
        cmocka_unit_test(png_write_srgb__values_in_range__nearest_code_of_the_curve),
        cmocka_unit_test(png_write_srgb__values_out_of_range__clipped),
        cmocka_unit_test(png_write_srgb__all_sizes__read_back),
        cmocka_unit_test(png_write_srgb__values_rendered_by_povray__same_codes_as_povray),
        cmocka_unit_test(png_write_srgb__output_fails__says_why_and_leaves_nothing),
    };
    return cmocka_run_group_tests_name("png_io", tests, scratch_setup, scratch_teardown);
}
