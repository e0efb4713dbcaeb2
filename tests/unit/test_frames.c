/* Frames and their numbers. What is wanted is what POV-Ray 3.7.0.10 wrote for these switches. */
#include "frames.h"

#include "gloss_support.h"

enum { UNSAID = FRAMES_UNSAID };

static void plan__settings__povrays_frames_and_digits(void **state)
{
    (void)state;
    static const struct {
        const char *switches;
        struct frames_options options;
        int first, last, step, digits;
    } cases[] = {
        {"", {UNSAID, UNSAID, 1, false, UNSAID, UNSAID}, 0, 0, 1, 0},
        {"+KFF3", {UNSAID, 3, 1, false, UNSAID, UNSAID}, 1, 3, 1, 1},
        {"+KFI1 +KFF1", {1, 1, 1, false, UNSAID, UNSAID}, 0, 0, 1, 0},
        {"+KFI1 +KFF1 +KC", {1, 1, 1, true, UNSAID, UNSAID}, 0, 0, 1, 0},
        {"+KFF1", {UNSAID, 1, 1, false, UNSAID, UNSAID}, 1, 1, 1, 1},
        {"+KFF1 +KC", {UNSAID, 1, 1, true, UNSAID, UNSAID}, 1, 1, 1, 1},
        {"+KFI2 +KFF2", {2, 2, 1, false, UNSAID, UNSAID}, 2, 2, 1, 1},
        {"+KFI3", {3, UNSAID, 1, false, UNSAID, UNSAID}, 3, 3, 1, 1},
        {"+KFI0", {0, UNSAID, 1, false, UNSAID, UNSAID}, 0, 0, 1, 0},
        {"+KFF0", {UNSAID, 0, 1, false, UNSAID, UNSAID}, 0, 0, 1, 0},
        {"+KFI1 +KFF0", {1, 0, 1, false, UNSAID, UNSAID}, 1, 1, 1, 1},
        {"+KFF-1", {UNSAID, -1, 1, false, UNSAID, UNSAID}, 1, 1, 1, 1},
        {"+KFI0 +KFF-1", {0, -1, 1, false, UNSAID, UNSAID}, 0, 0, 1, 1},
        {"+KFI-2 +KFF1", {-2, 1, 1, false, UNSAID, UNSAID}, 0, 1, 1, 1},
        {"+KFI10 +KFF5", {10, 5, 1, false, UNSAID, UNSAID}, 10, 10, 1, 2},
        {"+KFI0 +KFF2", {0, 2, 1, false, UNSAID, UNSAID}, 0, 2, 1, 1},
        {"+KFI8 +KFF11", {8, 11, 1, false, UNSAID, UNSAID}, 8, 11, 1, 2},
        {"+KFF9 +KC", {UNSAID, 9, 1, true, UNSAID, UNSAID}, 1, 9, 1, 2},
        {"+KFF10 +KC +SF10 +EF11", {UNSAID, 10, 1, true, 10, 11}, 10, 11, 1, 2},
        {"+KFF10 +SF3 +EF4", {UNSAID, 10, 1, false, 3, 4}, 3, 4, 1, 2},
        {"+KFF10 +SF20", {UNSAID, 10, 1, false, 20, UNSAID}, 20, 20, 1, 2},
        {"+KFF10 +SF5 +EF3", {UNSAID, 10, 1, false, 5, 3}, 5, 5, 1, 2},
        {"+KFF10 +EF20 +SF9", {UNSAID, 10, 1, false, 9, 20}, 9, 20, 1, 2},
        {"+KFF10 +SF0.25 +EF0.5", {UNSAID, 10, 1, false, 0.25, 0.5}, 2, 5, 1, 2},
        {"+KFI5 +KFF14 +SF0.3 +EF0.5", {5, 14, 1, false, 0.3, 0.5}, 5, 5, 1, 2},
        {"+KFF3 +SF0 +EF1", {UNSAID, 3, 1, false, 0, 1}, 1, 1, 1, 1},
        {"+KFF3 +SF1.7 +EF2.9", {UNSAID, 3, 1, false, 1.7, 2.9}, 1, 2, 1, 1},
        {"+KFF10 +STP3", {UNSAID, 10, 3, false, UNSAID, UNSAID}, 1, 10, 3, 2},
        {"+KFF10 +STP4", {UNSAID, 10, 4, false, UNSAID, UNSAID}, 1, 10, 4, 2},
        {"+KFF3 +STP-1", {UNSAID, 3, -1, false, UNSAID, UNSAID}, 1, 3, 1, 1},
        {"+KFF1000 +SF999", {UNSAID, 1000, 1, false, 999, UNSAID}, 999, 1000, 1, 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct frames frames = frames_plan(&cases[i].options);
        if (frames.first != cases[i].first || frames.last != cases[i].last || frames.step != cases[i].step ||
            frames.digits != cases[i].digits)
            fail_msg("%s: %d to %d by %d, %d digits", cases[i].switches, frames.first, frames.last, frames.step,
                     frames.digits);
    }
}

static void plan__wild_numbers__some_frame(void **state)
{
    (void)state;
    static const double wild[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 1e9};
    for (size_t i = 0; i < sizeof wild / sizeof *wild; i++) {
        struct frames_options options = {999999999, 999999999, 999999999, true, wild[i], wild[i]};
        struct frames frames = frames_plan(&options);
        assert_true(frames.first >= 999999999 && frames.last >= frames.first && frames.digits == 10);
    }
}

static void count__steps__frames_that_are_drawn(void **state)
{
    (void)state;
    static const struct {
        struct frames frames;
        int count;
    } cases[] = {{{0, 0, 1, 0}, 1}, {{1, 10, 1, 2}, 10}, {{1, 10, 3, 2}, 4}, {{1, 10, 4, 2}, 3}, {{5, 5, 9, 1}, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(frames_count(&cases[i].frames), cases[i].count);
}

static void path__frame__number_before_the_extension(void **state)
{
    (void)state;
    static const struct {
        int digits, frame;
        const char *path, *numbered;
    } cases[] = {
        {2, 3, "out.png", "out03.png"},     {1, 3, "out.png", "out3.png"},     {0, 0, "out.png", "out.png"},
        {2, 120, "out.png", "out120.png"},  {1, 0, "out", "out0"},             {1, 2, "a.b/out", "a.b/out2"},
        {1, 2, "./out.png", "./out2.png"},  {3, 7, "a.b.exr", "a.b007.exr"},   {1, 2, ".png", ".png2"},
        {1, 2, "d/.hidden", "d/.hidden2"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct frames frames = {.first = 0, .last = 999, .step = 1, .digits = cases[i].digits};
        struct error err;
        char *numbered;
        assert_ok(frames_path(&frames, cases[i].path, cases[i].frame, &numbered, &err), err);
        assert_string_equal(numbered, cases[i].numbered);
        free(numbered);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plan__settings__povrays_frames_and_digits),
        cmocka_unit_test(plan__wild_numbers__some_frame),
        cmocka_unit_test(count__steps__frames_that_are_drawn),
        cmocka_unit_test(path__frame__number_before_the_extension),
    };
    return cmocka_run_group_tests_name("frames", tests, NULL, NULL);
}
