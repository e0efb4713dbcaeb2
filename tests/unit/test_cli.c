/* The command line of glossfilter, and the shared options one at a time. */
#include "cli.h"
#include "gloss_support.h"

static struct error err;

#define ARGUMENTS_MAX 16

/* Parses a command line written as words with single spaces between them. */
static enum result parse(const char *line, struct cli_glossfilter *command)
{
    static char text[512];
    char *argv[ARGUMENTS_MAX + 1] = {0};
    int argc = 0;
    snprintf(text, sizeof text, "glossfilter %s", line);
    for (char *word = strtok(text, " "); word && argc < ARGUMENTS_MAX; word = strtok(NULL, " "))
        argv[argc++] = word;
    return cli_glossfilter(argc, argv, command, &err);
}

static void cli__plain_command__has_the_defaults(void **state)
{
    (void)state;
    struct cli_glossfilter command;
    assert_ok(parse("in.exr -o out.exr", &command), err);
    assert_string_equal(command.input, "in.exr");
    assert_string_equal(command.output, "out.exr");
    const struct filter_options *filter = &command.options.filter;
    assert_int_equal(filter->weights, FILTER_WEIGHTS_EXACT);
    assert_int_equal(filter->formula, FILTER_FORMULA_PHONG);
    assert_int_equal(filter->window, FILTER_WINDOW_ROUND);
    assert_int_equal(filter->isa, CPU_ISA_AUTO);
    assert_int_equal(filter->mode, FILTER_MODE_BEST);
    assert_int_equal(filter->without, 0);
    assert_int_equal(filter->radius_step, 1);
    assert_int_equal(filter->max_radius_px, 0);
    assert_int_equal(filter->threads, 0);
    assert_true(isnan(filter->phong) && !filter->phong_override);
    assert_near(filter->energy, 0.99, 0);
    assert_near(filter->max_angle_rad, 1.5707963267948966, 1e-15);
    assert_int_equal(command.options.bits, 8);
    assert_false(command.options.layers || command.options.quiet || command.help || command.version);
}

static void cli__every_option__is_stored(void **state)
{
    (void)state;
    struct cli_glossfilter command;
    assert_ok(parse("a --mode paper --phong 300 --weights=table --formula max --window square -o b.exr", &command), err);
    assert_near(command.options.filter.phong, 300, 0);
    assert_true(command.options.filter.phong_override);
    assert_int_equal(command.options.filter.weights, FILTER_WEIGHTS_TABLE);
    assert_int_equal(command.options.filter.formula, FILTER_FORMULA_MAX);
    assert_int_equal(command.options.filter.window, FILTER_WINDOW_SQUARE);
    assert_ok(parse("a --mode paper --max-radius 40 --radius-step=2 --energy 0.9 -o b.exr", &command), err);
    assert_int_equal(command.options.filter.max_radius_px, 40);
    assert_int_equal(command.options.filter.radius_step, 2);
    assert_near(command.options.filter.energy, 0.9, 0);
    assert_ok(parse("a --max-angle 10 --threads 3 -o b.exr", &command), err);
    assert_near(command.options.filter.max_angle_rad, 0.17453292519943295, 1e-15);
    assert_int_equal(command.options.filter.threads, 3);
    assert_ok(parse("a --isa sse2 --mode paper --weights gauss --layers -q --format exr -o -", &command), err);
    assert_int_equal(command.options.filter.isa, CPU_ISA_SSE2);
    assert_int_equal(command.options.filter.weights, FILTER_WEIGHTS_GAUSS);
    assert_true(command.options.layers && command.options.quiet);
    assert_int_equal(command.options.filter.mode, FILTER_MODE_PAPER);
    assert_ok(parse("a --mode best --without pool --without=density -o b.exr", &command), err);
    assert_int_equal(command.options.filter.mode, FILTER_MODE_BEST);
    assert_int_equal(command.options.filter.without, FILTER_WITHOUT_POOL | FILTER_WITHOUT_DENSITY);
    assert_ok(parse("- --output=b.png --bits 16 --roughness 0.5", &command), err);
    assert_string_equal(command.input, "-");
    assert_int_equal(command.options.bits, 16);
    assert_near(command.options.filter.phong, 7.5, 1e-6);
    assert_ok(parse("a -o b.png --phong inf", &command), err);
    assert_true(isinf(command.options.filter.phong));
    assert_ok(parse("-o b.png -- --phong", &command), err);
    assert_string_equal(command.input, "--phong");
    assert_ok(parse("--help", &command), err);
    assert_true(command.help);
    assert_ok(parse("--version", &command), err);
    assert_true(command.version);
}

static void cli__option_of_the_other_mode__is_refused(void **state)
{
    (void)state;
    static const char *const lines[] = {"--weights table", "--formula max", "--window square", "--radius-step 4",
                                        "--mode paper --without pool"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        struct cli_glossfilter command;
        char line[64];
        snprintf(line, sizeof line, "a -o b.exr %s", lines[i]);
        if (parse(line, &command) != RESULT_USAGE || !strstr(err.text, "--mode"))
            fail_msg("%s: %s", line, err.text);
    }
}

static void cli__wrong_value__is_refused_by_name(void **state)
{
    (void)state;
    static const char *const lines[][2] = {
        {"--phong", "-1"},      {"--phong", "nan"},    {"--phong", "3x"},       {"--phong", ""},
        {"--roughness", "1.1"}, {"--mode", "fast"},    {"--weights", "tables"}, {"--formula", "2"},
        {"--window", "Round"},  {"--max-radius", "-1"}, {"--max-radius", "1.5"}, {"--radius-step", "3"},
        {"--energy", "1"},      {"--energy", "0"},     {"--max-angle", "0"},    {"--max-angle", "90.1"},
        {"--threads", "1e1"},   {"--threads", "9999"}, {"--isa", "avx"},        {"--format", "jpg"},
        {"--bits", "12"},       {"--without", "all"},
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        struct cli_glossfilter command;
        char line[64];
        snprintf(line, sizeof line, "a -o b.exr %s=%s", lines[i][0], lines[i][1]);
        if (parse(line, &command) != RESULT_USAGE || !strstr(err.text, lines[i][0]))
            fail_msg("%s: %s", line, err.text);
    }
}

static void cli__wrong_command__is_refused(void **state)
{
    (void)state;
    static const char *const lines[] = {
        "",           "a",         "-o b.exr",      "a b --check",            "a -o",      "a -o b.exr --phong",
        "a -o b.jpg", "a -o b",    "a -o b.exr -x", "a -o b.exr --phongs 3", "a -o -",    "a -o b.png --layers",
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        struct cli_glossfilter command;
        if (parse(lines[i], &command) != RESULT_USAGE)
            fail_msg("accepted: %s", lines[i]);
    }
}

static void cli_filter_option__another_programs_switch__is_left_alone(void **state)
{
    (void)state;
    char *argv[] = {"+W640", "-A", "Declare=x=1", "--phongy", "--phong=7", "--layers", "--phong"};
    struct cli_filter options = cli_filter_default();
    enum cli_option option;
    int index;
    for (index = 0; index < 4;) {
        int before = index;
        assert_ok(cli_filter_option(7, argv, &index, &options, &option, &err), err);
        assert_int_equal(option, CLI_OPTION_NONE);
        assert_int_equal(index, before);
        index++;
    }
    assert_ok(cli_filter_option(7, argv, &index, &options, &option, &err), err);
    assert_true(option == CLI_OPTION_FILTER && index == 5);
    assert_near(options.filter.phong, 7, 0);
    assert_ok(cli_filter_option(7, argv, &index, &options, &option, &err), err);
    assert_true(option == CLI_OPTION_OUTPUT && index == 6 && options.layers);
    assert_int_equal(cli_filter_option(7, argv, &index, &options, &option, &err), RESULT_USAGE);
    assert_non_null(strstr(err.text, "--phong needs a value"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cli__plain_command__has_the_defaults),
        cmocka_unit_test(cli__every_option__is_stored),
        cmocka_unit_test(cli__option_of_the_other_mode__is_refused),
        cmocka_unit_test(cli__wrong_value__is_refused_by_name),
        cmocka_unit_test(cli__wrong_command__is_refused),
        cmocka_unit_test(cli_filter_option__another_programs_switch__is_left_alone),
    };
    return cmocka_run_group_tests_name("cli", tests, NULL, NULL);
}
