/* What the tests of files share: a scratch folder, other programs, and exact comparison of images. */
#ifndef POVGLOSS_IO_SUPPORT_H
#define POVGLOSS_IO_SUPPORT_H

#include "image.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

static char scratch[64];

static int scratch_setup(void **state)
{
    (void)state;
    strcpy(scratch, "/tmp/povgloss-test-XXXXXX");
    return mkdtemp(scratch) ? 0 : -1;
}

static int scratch_teardown(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", scratch);
    return system(command);
}

/* The path of a file in the scratch folder; valid until eight more calls. */
__attribute__((unused)) static const char *in_scratch(const char *name)
{
    static char paths[8][256];
    static unsigned next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", scratch, name);
    return path;
}

/* Number of entries of the scratch folder. */
__attribute__((unused)) static int scratch_entries(void)
{
    DIR *folder = opendir(scratch);
    assert_non_null(folder);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(folder));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(folder);
    return count;
}

/* Runs a command line in the scratch folder, which must succeed, and returns what it printed (its first 64 KB). */
__attribute__((unused, format(printf, 1, 2))) static const char *run(const char *format, ...)
{
    static char output[1 << 16];
    char arguments[2048], command[2304];
    va_list args;
    va_start(args, format);
    vsnprintf(arguments, sizeof arguments, format, args);
    va_end(args);
    snprintf(command, sizeof command, "cd '%s' && { %s ; } 2>&1", scratch, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    size_t length = fread(output, 1, sizeof output - 1, pipe);
    output[length] = '\0';
    while (fgetc(pipe) != EOF)
        ;
    if (pclose(pipe) != 0)
        fail_msg("%s: %s", arguments, output);
    return output;
}

__attribute__((unused)) static void write_bytes(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* All bytes of a file; the caller frees them. */
__attribute__((unused)) static unsigned char *read_bytes(const char *path, size_t *size)
{
    struct stat status;
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fstat(fileno(file), &status), 0);
    *size = (size_t)status.st_size;
    unsigned char *data = malloc(*size + 1);
    assert_non_null(data);
    assert_int_equal(fread(data, 1, *size, file), *size);
    fclose(file);
    return data;
}

/* A device that is always full, in the scratch folder where possible: run as root, broken code could replace the real
 * one by a plain file. */
__attribute__((unused)) static const char *full_device(void)
{
    if (geteuid() != 0)
        return "/dev/full";
    const char *path = in_scratch("full");
    if (access(path, F_OK) != 0 && mknod(path, S_IFCHR | 0666, makedev(1, 7)) != 0)
        return "/dev/full";
    return path;
}

#define assert_ok(call, err)                                                                                          \
    do {                                                                                                               \
        enum result result_ = (call);                                                                                  \
        if (result_)                                                                                                   \
            fail_msg("%s gives %d: %s", #call, result_, (err).text);                                                   \
    } while (0)

#define assert_contains(text, part)                                                                                    \
    do {                                                                                                               \
        if (!strstr(text, part))                                                                                       \
            fail_msg("'%s' is not in '%s'", part, text);                                                               \
    } while (0)

/* A failed comparison with NaN fails, unlike that of assert_float_equal. */
#define assert_near(a, b, tolerance)                                                                                   \
    do {                                                                                                               \
        double a_ = (a), b_ = (b);                                                                                     \
        if (!(fabs(a_ - b_) <= (tolerance)))                                                                           \
            fail_msg("%.9g is not %.9g", a_, b_);                                                                      \
    } while (0)

__attribute__((unused)) static uint32_t float_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Plane `b_channel` of b is plane `a_channel` of a, bit for bit. */
__attribute__((unused)) static void assert_same_plane(const struct image *a, int a_channel, const struct image *b,
                                                      int b_channel)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            float left = image_row(a, a_channel, y)[x], right = image_row(b, b_channel, y)[x];
            if (float_bits(left) != float_bits(right))
                fail_msg("%dx%d, channels %d and %d, pixel %d,%d: %.9g is not %.9g", a->width, a->height, a_channel,
                         b_channel, x, y, (double)left, (double)right);
        }
}

/* Fills an image with distinct values, and the awkward ones of 32-bit floats among them. */
__attribute__((unused)) static void fill_distinct(struct image *image)
{
    static const float awkward[] = {0.0f,   -0.0f,    INFINITY, -INFINITY, NAN,    1e-45f, -1e-40f, 1.17549435e-38f,
                                    65504.0f, 3.4028235e38f, -1.0f, 1.0f, 0.1f,   6e-8f,  65519.996f, 1e6f};
    uint32_t seed = 1;
    size_t n = 0;
    for (int channel = 0; channel < image->channels; channel++)
        for (int y = 0; y < image->height; y++)
            for (int x = 0; x < image->width; x++, n++) {
                seed = seed * 1664525u + 1013904223u;
                image_row(image, channel, y)[x] = n % 3 == 0 ? awkward[n / 3 % (sizeof awkward / sizeof awkward[0])]
                                                             : (float)(seed >> 8) * 0x1p-20f - 4.0f;
            }
}

#endif
