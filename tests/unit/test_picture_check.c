/* The comparison of a picture with a small one: what is another sampling of the same picture passes, what is another
 * picture doesn't. */
#include "picture_check.h"
#include "gloss_support.h"

static struct error err;

/* A scene for all sizes, over the unit square: a slope, a disc with a sharp edge, thin lines, and fine stripes below. */
static double shade(double x, double y)
{
    if (hypot(x - 0.4, y - 0.4) < 0.2)
        return 0.9;
    if (fmod(x + 0.31 * y, 0.1) < 0.002)
        return 1;
    if (y > 0.8)
        return fmod(x, 0.02) < 0.01 ? 0.1 : 0.6;
    return 0.2 + 0.3 * x + 0.2 * sin(6 * y);
}

static double random_value(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

/* The scene with `samples` squared rays a pixel, and noise. */
static struct image draw(int width, int height, int samples, double noise, unsigned seed)
{
    struct image image;
    assert_ok(image_alloc(&image, width, height, 3, &err), err);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double sum = noise * (random_value(&seed) - 0.5) * samples * samples;
            for (int i = 0; i < samples * samples; i++)
                sum += shade((x + (i % samples + 0.5) / samples) / width, (y + (i / samples + 0.5) / samples) / height);
            for (int channel = 0; channel < 3; channel++)
                image_row(&image, channel, y)[x] = (float)(sum / (samples * samples));
        }
    return image;
}

/* Adds to a rectangle of the unit square. */
static void paint(struct image *image, double left, double top, double right, double bottom, float value)
{
    for (int y = (int)(top * image->height); y < bottom * image->height; y++)
        for (int x = (int)(left * image->width); x < right * image->width; x++)
            image_row(image, 1, y)[x] += value;
}

static struct picture_difference compare(const struct image *sum, const struct image *own, bool single_rays)
{
    struct picture_difference difference;
    assert_ok(picture_check(sum, own, single_rays, 0.01, &difference, &err), err);
    return difference;
}

static struct picture_difference compare_sizes(int width, int height, int samples, double noise)
{
    int small_width, small_height;
    picture_check_size(width, height, &small_width, &small_height);
    struct image sum = draw(width, height, samples, noise, 1), own = draw(small_width, small_height, 1, noise, 2);
    struct picture_difference difference = compare(&sum, &own, samples == 1);
    image_free(&sum);
    image_free(&own);
    return difference;
}

static const int sizes[][2] = {{640, 480}, {320, 240}, {160, 120}, {512, 384}, {500, 377}, {331, 457}, {720, 576}};
enum { SIZE_COUNT = sizeof sizes / sizeof *sizes };

static void picture_check_size__centres__coincide_where_they_can(void **state)
{
    (void)state;
    static const int expected[][4] = {
        {640, 480, 128, 96}, {1920, 1080, 128, 72}, {320, 240, 64, 48}, {160, 120, 160, 120}, {1280, 720, 256, 144},
        {1024, 768, 204, 153}, {1, 1, 1, 1}, {7, 1, 7, 1}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        int width, height;
        picture_check_size(expected[i][0], expected[i][1], &width, &height);
        assert_int_equal(width, expected[i][2]);
        assert_int_equal(height, expected[i][3]);
    }
}

static void picture_check_size__any_size__has_a_picture_of_its_proportion(void **state)
{
    (void)state;
    for (int width = 1; width < 3000; width += 13)
        for (int height = 1; height < 3000; height += 17) {
            int w, h;
            picture_check_size(width, height, &w, &h);
            assert_true(w >= 1 && w <= width && h >= 1 && h <= height);
            if (width >= 200 && height >= 200) /* the edges of both are the same to 2.5 pixels of the full one */
                assert_true(fabs((double)h / w * width / height - 1) * height < 2.5);
        }
}

static void picture_check__same_scene_in_any_size__is_the_same(void **state)
{
    (void)state;
    for (int i = 0; i < SIZE_COUNT; i++)
        assert_false(compare_sizes(sizes[i][0], sizes[i][1], 1, 0).found);
}

static void picture_check__antialiased__is_the_same(void **state)
{
    (void)state;
    for (int i = 0; i < SIZE_COUNT; i++)
        assert_false(compare_sizes(sizes[i][0], sizes[i][1], 4, 0).found);
}

static void picture_check__noise__is_the_same(void **state)
{
    (void)state;
    for (int i = 0; i < SIZE_COUNT; i++)
        assert_false(compare_sizes(sizes[i][0], sizes[i][1], 1, 0.3).found);
}

static void picture_check__patch__is_found_with_its_place_and_values(void **state)
{
    (void)state;
    for (int i = 0; i < SIZE_COUNT; i++)
        for (int samples = 1; samples <= 4; samples += 3) {
            int width = sizes[i][0], height = sizes[i][1], small_width, small_height;
            picture_check_size(width, height, &small_width, &small_height);
            struct image sum = draw(width, height, samples, 0, 1), own = draw(small_width, small_height, 1, 0, 2);
            paint(&sum, 0.5, 0.05, 0.9, 0.35, -0.2f); /* 12 % */
            struct picture_difference difference = compare(&sum, &own, samples == 1);
            assert_true(difference.found);
            assert_true(difference.share > 0.06 && difference.share < 0.13);
            assert_true(difference.x > 0.5 * width - 2 && difference.x < 0.9 * width + 2);
            assert_true(difference.y > 0.05 * height - 2 && difference.y < 0.35 * height + 2);
            assert_true(difference.own[1] > difference.sum[1] + 0.1f);
            image_free(&sum);
            image_free(&own);
        }
}

static void picture_check__patch_in_noise__is_found(void **state)
{
    (void)state;
    struct image sum = draw(640, 480, 1, 0.2, 1), own = draw(128, 96, 1, 0.2, 2);
    paint(&sum, 0.6, 0.1, 0.8, 0.3, 0.2f);
    assert_true(compare(&sum, &own, false).found);
    image_free(&sum);
    image_free(&own);
}

static void picture_check__smallest_defects__are_found_only_above_the_limit(void **state)
{
    (void)state;
    struct image sum = draw(640, 480, 1, 0, 1), own = draw(128, 96, 1, 0, 2);
    paint(&sum, 0.1, 0.1, 0.15, 0.15, 0.1f); /* a quarter of a percent */
    assert_false(compare(&sum, &own, true).found);
    paint(&sum, 0.6, 0.1, 0.7, 0.2, 0.005f); /* within the tolerance */
    assert_false(compare(&sum, &own, true).found);
    paint(&sum, 0.2, 0.1, 0.3, 0.15, 0.1f); /* three quarters together */
    struct picture_difference difference = compare(&sum, &own, true);
    assert_true(difference.found);
    assert_near(difference.share, 0.0075, 0.002);
    image_free(&sum);
    image_free(&own);
}

static void picture_check__single_pixels__are_the_same(void **state)
{
    (void)state;
    struct image sum = draw(640, 480, 1, 0, 1), own = draw(128, 96, 1, 0, 2);
    for (int i = 0; i < 60; i++) /* half a percent, of which two are neighbours */
        image_row(&own, 1, 5 + 9 * (i / 12))[i == 1 ? 6 : 5 + 10 * (i % 12)] += 0.2f;
    assert_false(compare(&sum, &own, true).found);
    image_free(&sum);
    image_free(&own);
}

static void picture_check__nan_and_infinity__do_not_differ_from_themselves(void **state)
{
    (void)state;
    struct image sum = draw(160, 120, 1, 0, 1), own = draw(160, 120, 1, 0, 1);
    for (int i = 0; i < 160; i++) {
        image_row(&sum, 0, 5)[i] = image_row(&own, 0, 5)[i] = INFINITY;
        image_row(&sum, 0, 6)[i] = image_row(&own, 0, 6)[i] = NAN;
        image_row(&own, 0, 7)[i] = NAN;
    }
    assert_false(compare(&sum, &own, true).found);
    assert_false(compare(&sum, &own, false).found);
    for (int i = 0; i < 160; i++)
        image_row(&sum, 0, 5)[i] = 1;
    assert_true(compare(&sum, &own, true).found);
    image_free(&sum);
    image_free(&own);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picture_check_size__centres__coincide_where_they_can),
        cmocka_unit_test(picture_check_size__any_size__has_a_picture_of_its_proportion),
        cmocka_unit_test(picture_check__same_scene_in_any_size__is_the_same),
        cmocka_unit_test(picture_check__antialiased__is_the_same),
        cmocka_unit_test(picture_check__noise__is_the_same),
        cmocka_unit_test(picture_check__patch__is_found_with_its_place_and_values),
        cmocka_unit_test(picture_check__patch_in_noise__is_found),
        cmocka_unit_test(picture_check__smallest_defects__are_found_only_above_the_limit),
        cmocka_unit_test(picture_check__single_pixels__are_the_same),
        cmocka_unit_test(picture_check__nan_and_infinity__do_not_differ_from_themselves),
    };
    return cmocka_run_group_tests_name("picture_check", tests, NULL, NULL);
}
