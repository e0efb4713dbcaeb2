/* PPM files: POV-Ray's, of every header, and damaged ones. */
#include "ppm_io.h"

#include "io_support.h"

static int code_of(const struct image *image, int channel, int x, int y)
{
    float value = image_row(image, channel, y)[x];
    long code = lrintf(value * 65535.0f);
    assert_near(value, (float)code / 65535.0f, 0);
    return (int)code;
}

static void ppm_read__every_code_by_povray__exact(void **state)
{
    (void)state;
    static const char scene[] =
        "#version 3.7; global_settings { assumed_gamma 1.0 }\n"
        "camera { orthographic location <128, 128, -10> right x*256 up y*256 direction z }\n"
        "#declare F = function(x, y, z) { (floor(x) + 256*(255 - floor(y)))/65535 }\n"
        "plane { z, 0 pigment { function { F(x, y, z) } color_map { [0 rgb 0] [1 rgb <1, 0.5, 0>] } }\n"
        "        finish { emission 1 ambient 0 diffuse 0 } }\n";
    struct image image;
    struct error err;
    write_bytes(in_scratch("scene.pov"), scene, sizeof scene - 1);
    run("POVINI= povray +Iscene.pov +Oa.ppm +FP16 File_Gamma=1.0 +W256 +H256 -A -D -GA");
    assert_ok(ppm_read(in_scratch("a.ppm"), &image, &err), err);
    assert_int_equal(image.channels, 3);
    for (int n = 0; n < 65536; n++) {
        assert_int_equal(code_of(&image, 0, n % 256, n / 256), n);
        assert_near(code_of(&image, 1, n % 256, n / 256), n / 2.0, 0.51);
        assert_int_equal(code_of(&image, 2, n % 256, n / 256), 0);
    }
    image_free(&image);
}

/* Writes the header and `size` bytes 0, 1, 2 ... after it. */
static const char *make_ppm(const char *header, size_t size)
{
    unsigned char data[256];
    size_t length = strlen(header);
    assert_true(length + size <= sizeof data);
    memcpy(data, header, length);
    for (size_t i = 0; i < size; i++)
        data[length + i] = (unsigned char)i;
    write_bytes(in_scratch("b.ppm"), data, length + size);
    return in_scratch("b.ppm");
}

static void ppm_read__white_space_and_comments__passed_over(void **state)
{
    (void)state;
    static const char *const headers[] = {
        "P6 2 1 65535 ", "P6\n2 1\n65535\n", "P6\n# Render of: a.pov\n2 1\n65535\n", "P6#\n#2 2\n\t02#x\n\r 1 065535\n",
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        struct image image;
        struct error err;
        assert_ok(ppm_read(make_ppm(headers[i], 12 + i), &image, &err), err);
        assert_int_equal(image.width, 2);
        assert_int_equal(image.height, 1);
        for (int n = 0; n < 6; n++)
            assert_int_equal(code_of(&image, n % 3, n / 3, 0), 256 * (2 * n) + 2 * n + 1);
        image_free(&image);
    }
}

static void assert_refused(const char *path, const char *part)
{
    struct image image;
    struct error err;
    assert_int_equal(ppm_read(path, &image, &err), RESULT_DATA);
    assert_null(image.pixels);
    assert_contains(err.text, path);
    assert_contains(err.text, part);
}

static void ppm_read__not_such_a_file__says_so(void **state)
{
    (void)state;
    static const char *const headers[] = {
        "P",          "P5 2 1 65535 ", "P6 2 1 255 ",   "P6 2 1 65536 ", "P6 2 1 65535",         "P6 2 1 65535x", "P6 0 1 65535 ",
        "P6 -2 1 65535 ", "P6 2 65535 ",  "P6 65536 1 65535 ", "P6 99999999999999999999 1 65535 ", "P6 2 1 #65535 ",
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++)
        assert_refused(make_ppm(headers[i], 0), "not a PPM file of 16 bits");
    assert_refused(make_ppm("", 0), "is empty");
    assert_refused(in_scratch("absent.ppm"), "No such file or directory");
}

static void ppm_read__cut_anywhere__refused(void **state)
{
    (void)state;
    static const char header[] = "P6\n2 1\n65535\n";
    for (size_t size = 0; size < 12; size++)
        assert_refused(make_ppm(header, size), "ends too early");
    assert_refused(make_ppm("P6 65535 65535 65535 ", 12), "ends too early");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ppm_read__every_code_by_povray__exact),
        cmocka_unit_test(ppm_read__white_space_and_comments__passed_over),
        cmocka_unit_test(ppm_read__not_such_a_file__says_so),
        cmocka_unit_test(ppm_read__cut_anywhere__refused),
    };
    return cmocka_run_group_tests_name("ppm_io", tests, scratch_setup, scratch_teardown);
}
