/* A reduced gbuffer: which pixels it has, and what it keeps. */
#include "picture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Every pixel of the exponents is its own number: 100 y + x. */
static void make(struct gbuffer *gbuffer, int width, int height)
{
    struct error err;
    *gbuffer = (struct gbuffer){.has_eye = true, .eye = {1, 2, 3}, .view_angle = 0.5f, .working_gamma = 2.2f,
                                .window = {.left = 4, .top = -4, .width = width - 4, .height = 2}};
    assert_int_equal(image_alloc(&gbuffer->phong, width, height, 1, &err), RESULT_OK);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            image_row(&gbuffer->phong, 0, y)[x] = (float)(100 * y + x);
}

static void picture_reduce__fourth_pixels__those_in_the_middle(void **state)
{
    (void)state;
    struct gbuffer gbuffer, reduced;
    struct error err;
    make(&gbuffer, 14, 9);
    assert_int_equal(picture_reduce(&gbuffer, 4, &reduced, &err), RESULT_OK);
    assert_int_equal(reduced.phong.width, 3);
    assert_int_equal(reduced.phong.height, 2);
    for (int y = 0; y < 2; y++)
        for (int x = 0; x < 3; x++)
            assert_true(image_row(&reduced.phong, 0, y)[x] == (float)(100 * (4 * y + 2) + 4 * x + 2));
    assert_null(reduced.base.pixels);
    assert_true(reduced.has_eye && reduced.eye[2] == 3 && reduced.view_angle == 0.5f && reduced.working_gamma == 2.2f);
    assert_true(reduced.window.left == 1 && reduced.window.top == -1 && reduced.window.width == 2 &&
                reduced.window.height == 1);
    gbuffer_free(&reduced);
    gbuffer_free(&gbuffer);
}

static void picture_reduce__less_than_a_step__one_pixel(void **state)
{
    (void)state;
    struct gbuffer gbuffer, reduced;
    struct error err;
    make(&gbuffer, 5, 1);
    assert_int_equal(picture_reduce(&gbuffer, 16, &reduced, &err), RESULT_OK);
    assert_true(reduced.phong.width == 1 && reduced.phong.height == 1 && image_row(&reduced.phong, 0, 0)[0] == 0);
    gbuffer_free(&reduced);
    gbuffer_free(&gbuffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picture_reduce__fourth_pixels__those_in_the_middle),
        cmocka_unit_test(picture_reduce__less_than_a_step__one_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
