/* The table of the steps' times. */
#include "timings.h"

#include "gloss_support.h"

static void add__a_step_of_two_frames__one_row_with_both_times(void **state)
{
    (void)state;
    struct timings timings = {.begin = {.clock_s = 100}};
    timings_add_povray(&timings, "base", 101, 2, 1);
    timings_add_povray(&timings, "position", 102, 1, 0.5);
    timings_add_povray(&timings, "base", 110, 3, 1.5);
    assert_int_equal(timings.count, 2);
    assert_string_equal(timings.rows[0].step, "base");
    assert_near(timings.rows[0].start_s, 1, 1e-12);
    assert_near(timings.rows[0].wall_s, 5, 1e-12);
    assert_near(timings.rows[0].cpu_s, 2.5, 1e-12);
    assert_near(timings.rows[1].start_s, 2, 1e-12);
}

static void add__a_pass_and_a_step_of_one_name__two_rows(void **state)
{
    (void)state;
    struct timings timings = timings_begin();
    timings_add_povray(&timings, "base", 0, 1, 1);
    timings_add(&timings, "base", timings_now());
    assert_int_equal(timings.count, 2);
}

static void add__busy_work__its_processor_time(void **state)
{
    (void)state;
    struct timings timings = timings_begin();
    struct timings_moment start = timings_now();
    while (timings_now().cpu_s < start.cpu_s + 0.02)
        ;
    timings_add(&timings, "work", start);
    assert_true(timings.rows[0].cpu_s >= 0.02 && timings.rows[0].wall_s >= 0.9 * timings.rows[0].cpu_s);
}

static void add__no_timings__nothing(void **state)
{
    (void)state;
    timings_add(NULL, "work", timings_now());
    timings_add_povray(NULL, "base", 0, 1, 1);
}

static void print__rows__four_words_a_line(void **state)
{
    (void)state;
    struct timings timings = timings_begin();
    char *text = NULL;
    size_t size = 0;
    timings_add_povray(&timings, "base", timings.begin.clock_s + 0.25, 2.5, 1.125);
    timings_add(&timings, "filter", timings_now());
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    timings_print(&timings, stream);
    fclose(stream);
    static const char *const first_words[] = {"STEP", "povray:base", "filter", "total"};
    char *line = text;
    for (int i = 0; i < 4; i++) {
        char word[32];
        int start, end;
        assert_int_equal(sscanf(line, "%31s %n%*s %*s %*s%n", word, &start, &end), 1);
        assert_string_equal(word, first_words[i]);
        assert_int_equal(line[end], '\n');
        if (i == 1)
            assert_memory_equal(line + start, "0.250     2.500     1.125", 25);
        line += end + 1;
    }
    assert_int_equal(*line, 0);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(add__a_step_of_two_frames__one_row_with_both_times),
        cmocka_unit_test(add__a_pass_and_a_step_of_one_name__two_rows),
        cmocka_unit_test(add__busy_work__its_processor_time),
        cmocka_unit_test(add__no_timings__nothing),
        cmocka_unit_test(print__rows__four_words_a_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
