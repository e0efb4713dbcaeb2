/* Images: sizes, alignment, rows, failure. */
#include "io_support.h"

#include <limits.h>
#include <sys/resource.h>

static void image_alloc__any_size__zeroed_and_aligned(void **state)
{
    (void)state;
    static const int sizes[][3] = {{1, 1, 1},  {1, 9, 3},     {16, 2, 4},   {17, 3, 3},
                                   {67, 5, 2}, {65535, 1, 1}, {1, 65535, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        struct image image;
        struct error err;
        assert_ok(image_alloc(&image, sizes[i][0], sizes[i][1], sizes[i][2], &err), err);
        assert_int_equal(image.width, sizes[i][0]);
        assert_int_equal(image.height, sizes[i][1]);
        assert_int_equal(image.channels, sizes[i][2]);
        assert_int_equal(image.stride % 16, 0);
        assert_true(image.stride >= (size_t)image.width && image.stride < (size_t)image.width + 16);
        assert_int_equal((uintptr_t)image.pixels % 64, 0);
        size_t floats = image.stride * (size_t)image.height * (size_t)image.channels;
        for (size_t n = 0; n < floats; n++)
            if (float_bits(image.pixels[n]) != 0)
                fail_msg("float %zu of %zu is not 0", n, floats);
        image_free(&image);
        assert_null(image.pixels);
        assert_int_equal(image.width, 0);
    }
}

static void image_row__all_rows__lie_one_after_another(void **state)
{
    (void)state;
    struct image image;
    struct error err;
    assert_ok(image_alloc(&image, 17, 3, 4, &err), err);
    float *expected = image.pixels;
    for (int channel = 0; channel < 4; channel++)
        for (int y = 0; y < 3; y++, expected += 32)
            assert_ptr_equal(image_row(&image, channel, y), expected);
    image_free(&image);
}

static void image_alloc__side_out_of_range__refused_and_empty(void **state)
{
    (void)state;
    static const int sizes[][2] = {{0, 1}, {1, 0}, {-1, 1}, {1, -1}, {65536, 1}, {1, 65536}, {INT_MIN, INT_MAX}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        struct image image = {.width = 7};
        struct error err;
        assert_int_equal(image_alloc(&image, sizes[i][0], sizes[i][1], 1, &err), RESULT_DATA);
        assert_contains(err.text, "65535");
        assert_null(image.pixels);
        assert_int_equal(image.width, 0);
    }
}

/* A sanitizer needs the address space that this test takes away. */
#if !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
static void image_alloc__no_memory__refused_and_empty(void **state)
{
    (void)state;
    struct rlimit before, tight;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    tight = before;
    tight.rlim_cur = 1u << 30;
    assert_int_equal(setrlimit(RLIMIT_AS, &tight), 0);
    struct image image;
    struct error err;
    enum result result = image_alloc(&image, 32768, 32768, 3, &err);
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
    assert_int_equal(result, RESULT_DATA);
    assert_contains(err.text, "out of memory: 12884901888 bytes");
    assert_null(image.pixels);
}
#endif

static void image_free__empty__does_nothing(void **state)
{
    (void)state;
    struct image image = {0};
    image_free(&image);
    assert_null(image.pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(image_alloc__any_size__zeroed_and_aligned),
        cmocka_unit_test(image_row__all_rows__lie_one_after_another),
        cmocka_unit_test(image_alloc__side_out_of_range__refused_and_empty),
#if !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
        cmocka_unit_test(image_alloc__no_memory__refused_and_empty),
#endif
        cmocka_unit_test(image_free__empty__does_nothing),
    };
    return cmocka_run_group_tests_name("image", tests, scratch_setup, scratch_teardown);
}
