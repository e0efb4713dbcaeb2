/* OpenEXR files against oiiotool in both directions, and damaged ones.
 *
 * The floats travel between this test and oiiotool as a TIFF that is written and read here by hand, so that no OpenEXR
 * code of ours is its own judge.
 */
#include "exr_io.h"

#include "io_support.h"

#include <fcntl.h>
#include <sys/resource.h>

enum { TIFF_HEADER = 8, TIFF_TAGS = 10, TIFF_DATA = TIFF_HEADER + 2 + 12 * TIFF_TAGS + 4 + 2 };

static void put(unsigned char *at, uint32_t value, int size)
{
    for (int i = 0; i < size; i++)
        at[i] = (unsigned char)(value >> 8 * i);
}

static uint32_t get(const unsigned char *at, int size)
{
    uint32_t value = 0;
    for (int i = 0; i < size; i++)
        value |= (uint32_t)at[i] << 8 * i;
    return value;
}

/* One plane as a grey little-endian TIFF of 32-bit floats, or of 32-bit unsigned integers. */
static void tiff_write(const char *path, const struct image *image, bool as_unsigned)
{
    size_t size = TIFF_DATA + 4 * (size_t)image->width * (size_t)image->height;
    unsigned char *data = calloc(size, 1);
    assert_non_null(data);
    const uint32_t tags[TIFF_TAGS][2] = {
        {256, (uint32_t)image->width},  {257, (uint32_t)image->height}, {258, 32}, {259, 1}, {262, 1}, {273, TIFF_DATA},
        {277, 1}, {278, (uint32_t)image->height}, {279, (uint32_t)(size - TIFF_DATA)}, {339, as_unsigned ? 1 : 3}};
    memcpy(data, "II*\0", 4);
    put(data + 4, TIFF_HEADER, 4);
    put(data + TIFF_HEADER, TIFF_TAGS, 2);
    for (int i = 0; i < TIFF_TAGS; i++) {
        unsigned char *tag = data + TIFF_HEADER + 2 + 12 * i;
        put(tag, tags[i][0], 2);
        put(tag + 2, 4, 2);
        put(tag + 4, 1, 4);
        put(tag + 8, tags[i][1], 4);
    }
    unsigned char *to = data + TIFF_DATA;
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++, to += 4) {
            float value = image_row(image, 0, y)[x];
            put(to, as_unsigned ? (uint32_t)value : float_bits(value), 4);
        }
    write_bytes(path, data, size);
    free(data);
}

/* A grey TIFF of 32-bit floats in one strip; the caller frees the image. */
static void tiff_read(const char *path, struct image *image)
{
    size_t size;
    unsigned char *data = read_bytes(path, &size);
    assert_int_equal(memcmp(data, "II*\0", 4), 0);
    const unsigned char *tag = data + get(data + 4, 4);
    uint32_t width = 0, height = 0, strip = 0, strips = 0;
    for (uint32_t i = 0, count = get(tag, 2); i < count; i++) {
        const unsigned char *entry = tag + 2 + 12 * i;
        uint32_t value = get(entry + 8, get(entry + 2, 2) == 3 ? 2 : 4);
        switch (get(entry, 2)) {
        case 256: width = value; break;
        case 257: height = value; break;
        case 258: assert_int_equal(value, 32); break;
        case 259: assert_int_equal(value, 1); break;
        case 273: strip = value, strips = get(entry + 4, 4); break;
        case 339: assert_int_equal(value, 3); break;
        }
    }
    assert_int_equal(strips, 1);
    struct error err;
    assert_ok(image_alloc(image, (int)width, (int)height, 1, &err), err);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            uint32_t bits = get(data + strip + 4 * (y * width + x), 4);
            memcpy(image_row(image, 0, (int)y) + x, &bits, 4);
        }
    free(data);
}

static void make_image(struct image *image, int width, int height, int channels)
{
    struct error err;
    assert_ok(image_alloc(image, width, height, channels, &err), err);
    fill_distinct(image);
}

/* Writes the planes of an image as channels a, b, c ... of an EXR. */
static void write_planes(const char *path, const struct image *image, const struct exr_attributes *attributes)
{
    struct exr_channel channels[26];
    struct error err;
    assert_true(image->channels <= 26);
    for (int i = 0; i < image->channels; i++)
        channels[i] = (struct exr_channel){.name = {(char)('a' + i)}, .image = image, .channel = i};
    assert_ok(exr_write(path, channels, image->channels, attributes, &err), err);
}

static const int sizes[][2] = {{1, 1}, {1, 40}, {17, 3}, {67, 35}, {40, 1}, {16, 16}, {16, 17}, {300, 33}};
enum { SIZE_COUNT = sizeof sizes / sizeof sizes[0], OIIOTOOL_SIZE_COUNT = 4 };

static void exr_write__several_sizes__oiiotool_reads_the_same_floats(void **state)
{
    (void)state;
    for (int i = 0; i < OIIOTOOL_SIZE_COUNT; i++) {
        struct image image, seen;
        make_image(&image, sizes[i][0], sizes[i][1], 2);
        write_planes(in_scratch("a.exr"), &image, NULL);
        const char *info = run("oiiotool --info -v a.exr");
        assert_contains(info, "2 channel, float openexr");
        assert_contains(info, "compression: \"zip\"");
        for (int channel = 0; channel < 2; channel++) {
            run("oiiotool a.exr --ch %c -d float --compression none --attrib tiff:RowsPerStrip 65535 -o a.tif",
                'a' + channel);
            tiff_read(in_scratch("a.tif"), &seen);
            assert_same_plane(&image, channel, &seen, 0);
            image_free(&seen);
        }
        image_free(&image);
    }
}

static void exr_read__what_exr_write_wrote__bit_for_bit(void **state)
{
    (void)state;
    for (int i = 0; i < SIZE_COUNT; i++)
        for (int channels = 1; channels <= 26; channels += 5) {
            struct image image;
            struct exr_contents contents;
            struct error err;
            make_image(&image, sizes[i][0], sizes[i][1], channels);
            write_planes(in_scratch("a.exr"), &image, NULL);
            assert_ok(exr_read(in_scratch("a.exr"), &contents, &err), err);
            assert_int_equal(contents.image.channels, channels);
            for (int channel = 0; channel < channels; channel++) {
                const char name[2] = {(char)('a' + channel)};
                int plane = exr_find(&contents, name);
                assert_true(plane >= 0);
                assert_same_plane(&image, channel, &contents.image, plane);
            }
            assert_int_equal(exr_find(&contents, "no such channel"), -1);
            exr_contents_free(&contents);
            image_free(&image);
        }
}

/* Random floats, more and more of them 0: the deflated size of their chunk comes down by steps of about
 * a byte, and so to that of the chunk itself, which tells a reader that it isn't deflated. */
static void exr_write__chunks_about_as_long_deflated__read_as_they_were(void **state)
{
    enum { SIZE = 16 };
    (void)state;
    for (int zeros = 0; zeros < 2 * SIZE; zeros++)
        for (uint32_t seed = 1; seed <= 8; seed++) {
            struct image image;
            struct exr_contents contents;
            struct error err;
            uint32_t random = seed;
            assert_ok(image_alloc(&image, SIZE, SIZE, 1, &err), err);
            for (int i = 0; i < SIZE * SIZE; i++) {
                uint32_t bits = 0;
                for (int k = 0; k < 2; k++) {
                    random = random * 1664525u + 1013904223u;
                    bits = bits << 16 | random >> 16;
                }
                bits &= i < zeros ? 0 : 0xff7fffffu; /* finite */
                memcpy(&image_row(&image, 0, i / SIZE)[i % SIZE], &bits, sizeof bits);
            }
            write_planes(in_scratch("a.exr"), &image, NULL);
            assert_ok(exr_read(in_scratch("a.exr"), &contents, &err), err);
            assert_same_plane(&image, 0, &contents.image, 0);
            exr_contents_free(&contents);
            image_free(&image);
        }
}

/* Offset of the bytes `what` in a file. */
static size_t find_bytes(const unsigned char *data, size_t size, const void *what, size_t length)
{
    for (size_t at = 0; at + length <= size; at++)
        if (memcmp(data + at, what, length) == 0)
            return at;
    fail_msg("not in the file");
    return 0;
}

/* Converts `from` into 0.exr, 1.exr ... by one oiiotool, each with its options (which stay on for the next ones), that
 * begin with --compression. oiiotool replaces a compression that it finds unsuitable, so that is checked. */
static void convert(const char *from, const char *type, const char *const *options, int count)
{
    char command[2000];
    int length = snprintf(command, sizeof command, "oiiotool --nosoftwareattrib %s -d %s", from, type);
    for (int i = 0; i < count; i++)
        length += snprintf(command + length, sizeof command - (size_t)length, " %s -o %d.exr", options[i], i);
    assert_true(length < (int)sizeof command);
    run("%s", command);
    for (int i = 0; i < count; i++) {
        char name[16], kind[16], expected[64];
        size_t size;
        assert_int_equal(sscanf(options[i], "--compression %15s", kind), 1);
        snprintf(name, sizeof name, "%d.exr", i);
        unsigned char *data = read_bytes(in_scratch(name), &size);
        static const char *const kinds[] = {"none", "rle", "zips", "zip", "piz", "pxr24"};
        int code = 0;
        while (strcmp(kinds[code], kind) != 0)
            code++;
        length = snprintf(expected, sizeof expected, "compression%ccompression%c%c%c%c%c%c", 0, 0, 1, 0, 0, 0, code);
        find_bytes(data, size, expected, (size_t)length);
        free(data);
    }
}

static void exr_read__what_oiiotool_wrote__same_floats(void **state)
{
    (void)state;
    static const char *const options[] = {
        "--compression none",
        "--compression rle",
        "--compression zips",
        "--compression zip",
        "--compression piz",
        "--compression zip --tile 16 16",
        "--compression piz --tile 32 8",
        "--compression none --tile 64 64",
        "--compression rle --tile 16 16 --origin -100+3",
        "--compression zip --tile 16 16 --attrib openexr:lineOrder randomY",
        "--compression zip --scanline --origin +7-5 --attrib openexr:lineOrder increasingY",
        "--compression zip --attrib openexr:lineOrder decreasingY",
    };
    enum { COUNT = sizeof options / sizeof options[0] };
    for (int i = 0; i < OIIOTOOL_SIZE_COUNT; i++) {
        struct image image;
        make_image(&image, sizes[i][0], sizes[i][1], 1);
        tiff_write(in_scratch("b.tif"), &image, false);
        convert("b.tif", "float", options, COUNT);
        for (int layout = 0; layout < COUNT; layout++) {
            struct exr_contents contents;
            struct error err;
            char name[16];
            snprintf(name, sizeof name, "%d.exr", layout);
            assert_ok(exr_read(in_scratch(name), &contents, &err), err);
            assert_int_equal(contents.image.channels, 1);
            assert_same_plane(&image, 0, &contents.image, 0);
            exr_contents_free(&contents);
        }
        image_free(&image);
    }
    assert_contains(run("oiiotool --info -v %d.exr", COUNT - 1), "origin: x=7, y=-5");
    assert_contains(run("oiiotool --info -v %d.exr", 9), "tile size: 16 x 16");
    size_t size;
    unsigned char *data = read_bytes(in_scratch("11.exr"), &size);
    find_bytes(data, size, "lineOrder\0lineOrder\0\1\0\0\0\1", 25); /* decreasing y */
    free(data);
}

static void exr_read__mipmapped__level_0(void **state)
{
    (void)state;
    struct image image;
    struct exr_contents contents;
    struct error err;
    assert_ok(image_alloc(&image, 67, 35, 1, &err), err);
    for (int y = 0; y < 35; y++)
        for (int x = 0; x < 67; x++)
            image_row(&image, 0, y)[x] = (float)(100 * y + x);
    tiff_write(in_scratch("m.tif"), &image, false);
    run("oiiotool m.tif --tile 16 16 --compression zip -d float -otex m.exr");
    assert_ok(exr_read(in_scratch("m.exr"), &contents, &err), err);
    assert_same_plane(&image, 0, &contents.image, 0);
    exr_contents_free(&contents);
    image_free(&image);
}

/* All halves but NaN; PXR24 keeps them too. */
static void exr_read__half__every_half_exact(void **state)
{
    (void)state;
    static const char *const options[] = {"--compression none", "--compression rle", "--compression zips",
                                          "--compression zip",  "--compression piz", "--compression pxr24"};
    enum { COUNT = sizeof options / sizeof options[0] };
    struct image image;
    struct error err;
    assert_ok(image_alloc(&image, 256, 248, 1, &err), err);
    for (int n = 0; n < 256 * 248; n++) {
        int code = n % (31 << 10), exponent = code >> 10;
        double magnitude = exponent ? ldexp((code & 1023) + 1024, exponent - 25) : ldexp(code & 1023, -24);
        image_row(&image, 0, n / 256)[n % 256] = (float)(n < 31 << 10 ? magnitude : -magnitude);
    }
    tiff_write(in_scratch("h.tif"), &image, false);
    convert("h.tif", "half", options, COUNT);
    assert_contains(run("oiiotool --info 0.exr"), "half openexr");
    for (int i = 0; i < COUNT; i++) {
        struct exr_contents contents;
        char name[16];
        snprintf(name, sizeof name, "%d.exr", i);
        assert_ok(exr_read(in_scratch(name), &contents, &err), err);
        assert_same_plane(&image, 0, &contents.image, 0);
        exr_contents_free(&contents);
    }
    image_free(&image);
}

static void exr_read__uint__as_floats(void **state)
{
    (void)state;
    static const float values[] = {0, 1, 2, 255, 65535, 65536, 16777215, 16777216, 2147483648.0f, 4294967040.0f};
    struct image image;
    struct exr_contents contents;
    struct error err;
    assert_ok(image_alloc(&image, 10, 3, 1, &err), err);
    for (int y = 0; y < 3; y++)
        memcpy(image_row(&image, 0, y), values, sizeof values);
    tiff_write(in_scratch("u.tif"), &image, true);
    run("oiiotool u.tif -d uint32 --compression zip -o u.exr");
    assert_contains(run("oiiotool --info u.exr"), "uint openexr");
    assert_ok(exr_read(in_scratch("u.exr"), &contents, &err), err);
    assert_same_plane(&image, 0, &contents.image, 0);
    exr_contents_free(&contents);
    image_free(&image);
}

static void exr_write__channels_of_several_images__in_any_order(void **state)
{
    (void)state;
    struct image first, second;
    struct exr_contents contents;
    struct error err;
    make_image(&first, 33, 20, 3);
    make_image(&second, 33, 20, 1);
    image_row(&second, 0, 19)[32] = 42;
    struct exr_channel channels[] = {{"radius.V", &second, 0}, {"R", &first, 0}, {"G", &first, 1},
                                     {"B", &first, 2},         {"again", &first, 2}, {"", &second, 0}};
    memset(channels[5].name, 'n', EXR_NAME_SIZE - 1);
    assert_ok(exr_write(in_scratch("c.exr"), channels, 6, NULL, &err), err);
    assert_ok(exr_read(in_scratch("c.exr"), &contents, &err), err);
    assert_int_equal(contents.image.channels, 6);
    for (int i = 0; i < 6; i++)
        assert_same_plane(channels[i].image, channels[i].channel, &contents.image,
                          exr_find(&contents, channels[i].name));
    exr_contents_free(&contents);
    image_free(&first);
    image_free(&second);
}

static void exr_write__twice__same_bytes(void **state)
{
    (void)state;
    struct image image;
    make_image(&image, 67, 35, 3);
    write_planes(in_scratch("1.exr"), &image, NULL);
    write_planes(in_scratch("2.exr"), &image, NULL);
    run("cmp 1.exr 2.exr");
    image_free(&image);
}

static void exr_write__attributes__only_those_that_are_set(void **state)
{
    (void)state;
    static const struct exr_attributes cases[] = {
        {0},
        {.has_eye = true, .eye = {1.5f, -2.25f, 1e-30f}},
        {.view_angle = 1.25f},
        {.working_gamma = 2.5f},
        {.has_eye = true, .eye = {0, 0, 0}, .view_angle = 0.75f, .working_gamma = -1},
    };
    struct image image;
    make_image(&image, 5, 4, 1);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct exr_contents contents;
        struct error err;
        write_planes(in_scratch("t.exr"), &image, &cases[i]);
        const char *info = run("oiiotool --info -v t.exr");
        assert_contains(info, "povgloss:version: \"" POVGLOSS_VERSION "\"");
        assert_true(cases[i].has_eye == !!strstr(info, "povgloss:eye:"));
        assert_true((cases[i].view_angle != 0) == !!strstr(info, "povgloss:viewAngle:"));
        assert_true((cases[i].working_gamma != 0) == !!strstr(info, "povgloss:workingGamma:"));
        assert_ok(exr_read(in_scratch("t.exr"), &contents, &err), err);
        assert_true(contents.attributes.has_eye == cases[i].has_eye);
        assert_memory_equal(contents.attributes.eye, cases[i].eye, sizeof cases[i].eye);
        assert_near(contents.attributes.view_angle, cases[i].view_angle, 0);
        assert_near(contents.attributes.working_gamma, cases[i].working_gamma, 0);
        exr_contents_free(&contents);
    }
    write_planes(in_scratch("t.exr"), &image, &cases[4]);
    assert_contains(run("oiiotool --info -v t.exr"), "povgloss:viewAngle: 0.75");
    image_free(&image);
}

/* The file is refused with a message that holds `part`; returns the message. */
static const char *assert_refused(const char *name, const char *part)
{
    static struct error err;
    struct exr_contents contents;
    enum result result = exr_read(in_scratch(name), &contents, &err);
    if (result != RESULT_DATA)
        fail_msg("%s: result %d", name, result);
    assert_null(contents.image.pixels);
    assert_null(contents.names);
    assert_contains(err.text, name);
    assert_contains(err.text, part);
    return err.text;
}

/* Runs the command that the message names, on `name`, and reads what it makes. */
static void assert_cure_works(const char *name, const char *message)
{
    struct exr_contents contents;
    struct error err;
    const char *command = strstr(message, "oiiotool in.exr");
    assert_non_null(command);
    run("cp %s in.exr && rm -f out.exr && %s", name, command);
    assert_ok(exr_read(in_scratch("out.exr"), &contents, &err), err);
    exr_contents_free(&contents);
}

static void exr_read__attribute_of_another_type__refused(void **state)
{
    (void)state;
    struct image image;
    make_image(&image, 5, 4, 1);
    write_planes(in_scratch("t.exr"), &image, NULL);
    run("oiiotool t.exr --attrib povgloss:viewAngle wide -o text.exr");
    assert_refused("text.exr", "attribute povgloss:viewAngle must be a float");
    run("oiiotool t.exr --attrib povgloss:eye 3.5 -o eye.exr");
    assert_refused("eye.exr", "attribute povgloss:eye must be a v3f");
    image_free(&image);
}

static void exr_read__unsupported_compression__refused_with_a_cure_that_works(void **state)
{
    (void)state;
    static const char *const names[][2] = {{"dwaa", "DWAA"}, {"dwab", "DWAB"}, {"b44", "B44"}, {"b44a", "B44A"}};
    for (int i = 0; i < 4; i++) {
        run("oiiotool --pattern noise 40x40 3 -d half --compression %s -o d.exr", names[i][0]);
        const char *message = assert_refused("d.exr", names[i][1]);
        assert_contains(message, "oiiotool in.exr --compression zip -o out.exr");
        assert_cure_works("d.exr", message);
    }
}

static void exr_read__deep__refused_with_a_cure_that_works(void **state)
{
    (void)state;
    run("oiiotool --pattern constant:color=0.1,0.2,0.3,1,5 8x8 5 --chnames R,G,B,A,Z --deepen -d half -o deep.exr");
    assert_cure_works("deep.exr", assert_refused("deep.exr", "deep data"));
}

static void assert_channel(const struct exr_contents *contents, const char *name, int x, int y, float value)
{
    int plane = exr_find(contents, name);
    if (plane < 0)
        fail_msg("no channel %s", name);
    assert_near(image_row(&contents->image, plane, y)[x], value, 0);
}

static void exr_read__parts_numbered_by_oiiotool__channels_by_their_own_names(void **state)
{
    (void)state;
    struct exr_contents contents;
    struct error err;
    run("oiiotool --pattern constant:color=1,2,3 9x5 3 -d float --compression piz -o p1.exr");
    run("oiiotool --pattern constant:color=4,5,6 9x5 3 -d half --tile 4 4 --chnames s.R,s.G,s.B -o p2.exr");
    run("oiiotool --pattern constant:color=7,8,9 9x5 3 -d half --chnames t.R,t.G,t.B -o p3.exr");
    run("oiiotool p1.exr p2.exr p3.exr --siappendall -o three.exr");
    assert_contains(run("exrheader three.exr"), "\"subimage02\"");
    assert_ok(exr_read(in_scratch("three.exr"), &contents, &err), err);
    assert_int_equal(contents.image.channels, 9);
    static const char *const names[] = {"R", "G", "B", "s.R", "s.G", "s.B", "t.R", "t.G", "t.B"};
    for (int i = 0; i < 9; i++) {
        assert_channel(&contents, names[i], 0, 0, (float)(i + 1));
        assert_channel(&contents, names[i], 8, 4, (float)(i + 1));
    }
    exr_contents_free(&contents);
}

static void exr_read__named_parts__names_before_the_channels(void **state)
{
    (void)state;
    struct exr_contents contents;
    struct error err;
    run("oiiotool --pattern constant:color=1,2,3 9x5 3 -d float -o p1.exr");
    run("oiiotool --pattern constant:color=4,5,6 9x5 3 -d float --chnames s.R,s.G,s.B -o p2.exr");
    run("oiiotool --pattern constant:color=7,8,9 9x5 3 -d half -o p3.exr");
    run("exrmultipart -combine -i p1.exr::View.P p2.exr::s p3.exr::sum -o named.exr");
    assert_ok(exr_read(in_scratch("named.exr"), &contents, &err), err);
    static const char *const names[] = {"View.P.R", "View.P.G", "View.P.B", "s.R",   "s.G",
                                        "s.B",      "sum.R",    "sum.G",    "sum.B"};
    assert_int_equal(contents.image.channels, 9);
    for (int i = 0; i < 9; i++)
        assert_channel(&contents, names[i], 3, 2, (float)(i + 1));
    exr_contents_free(&contents);
}

static void exr_read__two_channels_of_one_name__refused_with_a_cure_that_works(void **state)
{
    (void)state;
    run("oiiotool --pattern noise 8x8 3 -d float -o p1.exr && oiiotool p1.exr p1.exr --siappend -o double.exr");
    assert_cure_works("double.exr", assert_refused("double.exr", "has two channels B, the second in part 2"));
}

/* Data windows 4x3 at (2,1) and 6x2 at (-1,2): the image is 7x3 at (-1,1). */
static void exr_read__parts_of_several_windows__all_in_one_image(void **state)
{
    (void)state;
    struct exr_contents contents;
    struct error err;
    run("oiiotool --pattern constant:color=1 4x3 1 --chnames a -d float --origin +2+1 --fullsize 10x8+0+0 -o w1.exr");
    run("oiiotool --pattern constant:color=2 6x2 1 --chnames b -d float --origin -1+2 --fullsize 10x8+0+0 -o w2.exr");
    run("oiiotool w1.exr w2.exr --siappend -o windows.exr");
    assert_ok(exr_read(in_scratch("windows.exr"), &contents, &err), err);
    assert_int_equal(contents.image.width, 7);
    assert_int_equal(contents.image.height, 3);
    assert_int_equal(contents.window.left, 1);
    assert_int_equal(contents.window.top, -1);
    assert_int_equal(contents.window.width, 10);
    assert_int_equal(contents.window.height, 8);
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 7; x++) {
            assert_channel(&contents, "a", x, y, x >= 3 ? 1 : 0);
            assert_channel(&contents, "b", x, y, x < 6 && y >= 1 ? 2 : 0);
        }
    exr_contents_free(&contents);
}

static void exr_read__attributes_of_a_later_part__found(void **state)
{
    (void)state;
    struct exr_contents contents;
    struct error err;
    struct image image;
    make_image(&image, 5, 4, 1);
    write_planes(in_scratch("t.exr"), &image, &(struct exr_attributes){.view_angle = 0.75f});
    run("oiiotool --pattern noise 5x4 3 -d float -o p1.exr && oiiotool p1.exr t.exr --siappend -o late.exr");
    assert_ok(exr_read(in_scratch("late.exr"), &contents, &err), err);
    assert_near(contents.attributes.view_angle, 0.75, 0);
    exr_contents_free(&contents);
    image_free(&image);
}

/* Mitsuba writes its floats so. */
static void exr_read__double_attribute__as_float(void **state)
{
    (void)state;
    struct exr_contents contents;
    struct error err;
    static const char before[] = "povgloss:viewAngle\0float\0\4\0\0\0";
    enum { NAME = 19, MORE = 1 + 4 }; /* a letter of the type's name, and bytes of its value */
    struct image image;
    size_t size, chunk = 0;
    const double angle = 0.75;
    make_image(&image, 5, 4, 1);
    write_planes(in_scratch("t.exr"), &image, &(struct exr_attributes){.view_angle = 0.5f});
    unsigned char *data = read_bytes(in_scratch("t.exr"), &size);
    size_t at = find_bytes(data, size, before, sizeof before - 1);
    unsigned char *wide = calloc(size + MORE, 1);
    assert_non_null(wide);
    memcpy(wide, data, at + NAME);
    memcpy(wide + at + NAME, "double\0\10\0\0", 11);
    memcpy(wide + at + NAME + 11, &angle, sizeof angle);
    memcpy(wide + at + NAME + 19, data + at + sizeof before - 1 + 4, size - (at + sizeof before - 1 + 4));
    /* The table of the one chunk's place lies right before the chunk. */
    for (size_t i = at; i + 8 < size && !chunk; i++)
        if (get(data + i, 4) == i + 8 && get(data + i + 4, 4) == 0)
            chunk = i + 8;
    put(wide + chunk - 8 + MORE, (uint32_t)chunk + MORE, 4);
    write_bytes(in_scratch("double.exr"), wide, size + MORE);
    free(data);
    free(wide);
    image_free(&image);
    assert_contains(run("exrheader double.exr"), "povgloss:viewAngle (type double)");
    assert_ok(exr_read(in_scratch("double.exr"), &contents, &err), err);
    assert_near(contents.attributes.view_angle, 0.75, 0);
    exr_contents_free(&contents);
}

static void exr_read__display_window_of_any_size__refused_where_too_large(void **state)
{
    (void)state;
    run("oiiotool --pattern noise 8x8 1 -d float --fullsize 65536x8+0+0 -o wide.exr");
    assert_refused("wide.exr", "65536 x 8 pixels");
    run("oiiotool --pattern noise 8x8 1 -d float --fullsize 65535x65535+0+0 -o all.exr");
    assert_refused("all.exr", "more than half of this machine's memory");
}

static void exr_read__subsampled_channel__refused_by_name(void **state)
{
    (void)state;
    struct image image;
    size_t size;
    make_image(&image, 16, 16, 2);
    write_planes(in_scratch("s.exr"), &image, NULL);
    unsigned char *data = read_bytes(in_scratch("s.exr"), &size);
    static const unsigned char entry_b[] = {'b', 0, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    size_t at = find_bytes(data, size, entry_b, sizeof entry_b);
    data[at + 10] = data[at + 14] = 2;
    write_bytes(in_scratch("s.exr"), data, size);
    assert_refused("s.exr", "channel b is subsampled (2 x 2)");
    free(data);
    image_free(&image);
}

static void exr_read__header_of_a_huge_image__refused_without_the_memory(void **state)
{
    (void)state;
    struct image image;
    size_t size;
    make_image(&image, 16, 16, 1);
    write_planes(in_scratch("g.exr"), &image, NULL);
    unsigned char *data = read_bytes(in_scratch("g.exr"), &size);
    size_t at = find_bytes(data, size, "dataWindow\0box2i\0\20\0\0\0", 21) + 21;
    static const int32_t maxima[][2] = {{65534, 65534}, {65535, 15}, {15, 65535}, {2147483647, 15},
                                        {-2, 15},       {15, -2},    {15, 16},    {15, 31}};
    for (size_t i = 0; i < sizeof maxima / sizeof maxima[0]; i++) {
        put(data + at + 8, (uint32_t)maxima[i][0], 4);
        put(data + at + 12, (uint32_t)maxima[i][1], 4);
        write_bytes(in_scratch("g.exr"), data, size);
        assert_refused("g.exr", "");
    }
    /* 3.6 GB: told apart from a lack of memory, since none of it is asked for. */
    put(data + at + 8, 29999, 4);
    put(data + at + 12, 29999, 4);
    write_bytes(in_scratch("g.exr"), data, size);
    free(data);
#if !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
    struct rlimit before, tight;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    tight = before;
    tight.rlim_cur = 1u << 30;
    assert_int_equal(setrlimit(RLIMIT_AS, &tight), 0);
#endif
    struct exr_contents contents;
    struct error err;
    enum result result = exr_read(in_scratch("g.exr"), &contents, &err);
#if !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
#endif
    assert_int_equal(result, RESULT_DATA);
    assert_contains(err.text, "damaged or cut short");
    image_free(&image);
}

static void exr_read__not_an_exr__says_so(void **state)
{
    (void)state;
    write_bytes(in_scratch("empty.exr"), "", 0);
    assert_refused("empty.exr", "is empty");
    write_bytes(in_scratch("text.exr"), "#version 3.7;\n", 14);
    assert_refused("text.exr", "text.exr: not an OpenEXR file");
    write_bytes(in_scratch("magic.exr"), "\x76\x2f\x31\x01", 4);
    assert_refused("magic.exr", "header is damaged, cut short");
    assert_refused("absent.exr", "No such file or directory");
    assert_int_equal(mkdir(in_scratch("folder.exr"), 0777), 0);
    assert_refused("folder.exr", "Is a directory");
    rmdir(in_scratch("folder.exr"));
}

/* Makes small files of every layout that is read, 0.exr ... */
enum { SMALL_COUNT = 8 };
static void make_small_files(void)
{
    static const char *const options[SMALL_COUNT] = {"--compression none",
                                                     "--compression rle",
                                                     "--compression zips",
                                                     "--compression zip",
                                                     "--compression piz",
                                                     "--compression pxr24",
                                                     "--compression zip --tile 16 16",
                                                     "--compression none --tile 16 16"};
    struct image image;
    make_image(&image, 17, 19, 1);
    tiff_write(in_scratch("k.tif"), &image, false);
    convert("k.tif", "float", options, SMALL_COUNT);
    image_free(&image);
}

static unsigned char *read_small_file(int number, size_t *size)
{
    char name[16];
    snprintf(name, sizeof name, "%d.exr", number);
    return read_bytes(in_scratch(name), size);
}

static void exr_read__cut_at_every_length__refused(void **state)
{
    (void)state;
    make_small_files();
    for (int i = 0; i < SMALL_COUNT; i++) {
        size_t size;
        unsigned char *data = read_small_file(i, &size);
        for (size_t length = 0; length < size; length++) {
            write_bytes(in_scratch("cut.exr"), data, length);
            assert_refused("cut.exr", "");
        }
        free(data);
    }
}

static void exr_read__uncompressed_chunk_of_the_wrong_size__refused(void **state)
{
    (void)state;
    enum { CHUNK_BYTES = 17 * 4 };
    size_t size;
    make_small_files();
    unsigned char *data = read_small_file(0, &size);
    unsigned char *chunk_size = data + size - CHUNK_BYTES - 4; /* of the last row */
    assert_int_equal(get(chunk_size, 4), CHUNK_BYTES);
    static const uint32_t wrong[] = {0, 4, CHUNK_BYTES - 4, CHUNK_BYTES + 4};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        put(chunk_size, wrong[i], 4);
        write_bytes(in_scratch("bad.exr"), data, size);
        assert_refused("bad.exr", "damaged or cut short");
    }
    free(data);
}

static void exr_read__every_byte_damaged__result_or_refusal(void **state)
{
    (void)state;
    int accepted = 0, refused = 0;
    make_small_files();
    for (int i = 0; i < SMALL_COUNT; i++) {
        size_t size;
        unsigned char *data = read_small_file(i, &size);
        for (size_t at = 0; at < size; at++) {
            struct exr_contents contents;
            struct error err = {""};
            unsigned char good = data[at];
            data[at] ^= (unsigned char)(at % 3 == 0 ? 0xff : at % 3 == 1 ? 0x80 : 0x01);
            write_bytes(in_scratch("bad.exr"), data, size);
            data[at] = good;
            enum result result = exr_read(in_scratch("bad.exr"), &contents, &err);
            assert_true(result == RESULT_OK || (result == RESULT_DATA && err.text[0]));
            result ? refused++ : accepted++;
            exr_contents_free(&contents);
        }
        free(data);
    }
    assert_true(accepted > 100 && refused > 100);
}

static void exr_read__standard_input__from_a_pipe_and_a_file(void **state)
{
    (void)state;
    struct image image;
    make_image(&image, 300, 200, 2);
    write_planes(in_scratch("i.exr"), &image, NULL);
    char command[256];
    snprintf(command, sizeof command, "cat '%s'", in_scratch("i.exr"));
    for (int from_pipe = 0; from_pipe < 2; from_pipe++) {
        struct exr_contents contents;
        struct error err;
        FILE *input = from_pipe ? popen(command, "r") : fopen(in_scratch("i.exr"), "rb");
        assert_non_null(input);
        int before = dup(STDIN_FILENO);
        assert_true(dup2(fileno(input), STDIN_FILENO) >= 0);
        enum result result = exr_read("-", &contents, &err);
        assert_true(dup2(before, STDIN_FILENO) >= 0);
        close(before);
        from_pipe ? pclose(input) : fclose(input);
        assert_ok(result, err);
        assert_same_plane(&image, 1, &contents.image, exr_find(&contents, "b"));
        exr_contents_free(&contents);
    }
    image_free(&image);
}

static void exr_write__output_fails__says_why_and_leaves_nothing(void **state)
{
    (void)state;
    struct image image;
    struct error err;
    make_image(&image, 100, 100, 1);
    struct exr_channel channel = {"R", &image, 0};
    assert_int_equal(exr_write(full_device(), &channel, 1, NULL, &err), RESULT_DATA);
    assert_contains(err.text, "full: cannot be written: No space left on device");
    assert_int_equal(exr_write(in_scratch("missing/a.exr"), &channel, 1, NULL, &err), RESULT_DATA);
    assert_contains(err.text, "mkdir -p");
    assert_int_equal(exr_write(in_scratch("twice.exr"), (struct exr_channel[]){channel, channel}, 2, NULL, &err),
                     RESULT_DATA);
    assert_int_not_equal(access(in_scratch("twice.exr"), F_OK), 0);
    assert_string_equal(run("ls -A | grep '^\\.' || true"), "");
    image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exr_write__several_sizes__oiiotool_reads_the_same_floats),
        cmocka_unit_test(exr_read__what_exr_write_wrote__bit_for_bit),
        cmocka_unit_test(exr_write__chunks_about_as_long_deflated__read_as_they_were),
        cmocka_unit_test(exr_read__what_oiiotool_wrote__same_floats),
        cmocka_unit_test(exr_read__mipmapped__level_0),
        cmocka_unit_test(exr_read__half__every_half_exact),
        cmocka_unit_test(exr_read__uint__as_floats),
        cmocka_unit_test(exr_write__channels_of_several_images__in_any_order),
        cmocka_unit_test(exr_write__twice__same_bytes),
        cmocka_unit_test(exr_write__attributes__only_those_that_are_set),
        cmocka_unit_test(exr_read__attribute_of_another_type__refused),
        cmocka_unit_test(exr_read__unsupported_compression__refused_with_a_cure_that_works),
        cmocka_unit_test(exr_read__deep__refused_with_a_cure_that_works),
        cmocka_unit_test(exr_read__parts_numbered_by_oiiotool__channels_by_their_own_names),
        cmocka_unit_test(exr_read__named_parts__names_before_the_channels),
        cmocka_unit_test(exr_read__two_channels_of_one_name__refused_with_a_cure_that_works),
        cmocka_unit_test(exr_read__parts_of_several_windows__all_in_one_image),
        cmocka_unit_test(exr_read__attributes_of_a_later_part__found),
        cmocka_unit_test(exr_read__double_attribute__as_float),
        cmocka_unit_test(exr_read__display_window_of_any_size__refused_where_too_large),
        cmocka_unit_test(exr_read__subsampled_channel__refused_by_name),
        cmocka_unit_test(exr_read__header_of_a_huge_image__refused_without_the_memory),
        cmocka_unit_test(exr_read__not_an_exr__says_so),
        cmocka_unit_test(exr_read__cut_at_every_length__refused),
        cmocka_unit_test(exr_read__uncompressed_chunk_of_the_wrong_size__refused),
        cmocka_unit_test(exr_read__every_byte_damaged__result_or_refusal),
        cmocka_unit_test(exr_read__standard_input__from_a_pipe_and_a_file),
        cmocka_unit_test(exr_write__output_fails__says_why_and_leaves_nothing),
    };
    return cmocka_run_group_tests_name("exr_io", tests, scratch_setup, scratch_teardown);
}
