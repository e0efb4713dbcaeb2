/* Which arguments belong to POV-Ray, and what is taken out of them. */
#include "povray_switches.h"

#include "gloss_support.h"

static void is__switches_settings_and_ini_files__yes(void **state)
{
    (void)state;
    static const char *const yes[] = {"+W640",        "-D",       "+a0.3", "-A",     "Width=640", "Declare=x=1.5",
                                      "quality.ini",  "a/b.INI",  "quality.ini[High]", "x.ini[a.b]",     "-=",
                                      "Antialias=on", "+L/a b/c", "a=b.ini", "star*[x].ini"};
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++)
        if (!povray_switch_is(yes[i]))
            fail_msg("%s", yes[i]);
}

static void is__other_arguments__no(void **state)
{
    (void)state;
    static const char *const no[] = {"", "-", "+", "--help", "--phong=100", "--", "scene.pov", "scene", ".ini", "x.inix",
                                     "ini", "a.ini.pov", "[a.ini]", "=", "a.b=c", "./a=b.pov"};
    for (size_t i = 0; i < sizeof no / sizeof *no; i++)
        if (povray_switch_is(no[i]))
            fail_msg("%s", no[i]);
}

static void take__several__kept_in_order(void **state)
{
    (void)state;
    static const char *const arguments[] = {"+A0.3", "-P", "Declare=x=1", "quality.ini", "+K0.5", "+SF1", "+Q9"};
    struct povray_switches switches;
    struct error err;
    assert_ok(povray_switches_make(&switches, 7, &err), err);
    for (int i = 0; i < 7; i++)
        assert_ok(povray_switch_take(&switches, arguments[i], &err), err);
    assert_int_equal(switches.passed_count, 7);
    for (int i = 0; i < 7; i++)
        assert_ptr_equal(switches.passed[i], arguments[i]);
    assert_int_equal(switches.library_count, 0);
    assert_null(switches.scene);
    assert_int_equal(switches.width, 0);
    assert_int_equal(switches.height, 0);
    povray_switches_free(&switches);
    assert_null(switches.passed);
    povray_switches_free(&switches);
}

static void take__sizes__read_and_passed(void **state)
{
    (void)state;
    static const struct {
        const char *argument;
        int width, height;
    } cases[] = {
        {"+W640", 640, 0},     {"-w320", 320, 0},        {"Width=17", 17, 0},   {"WIDTH=18", 18, 0},
        {"+H480", 0, 480},     {"+h9", 0, 9},            {"height=4", 0, 4},    {"+WT4", 0, 0},
        {"Work_Threads=4", 0, 0}, {"+W", 0, 0},          {"+Wx", 0, 0},         {"+W12x", 0, 0},
        {"Width=", 0, 0},      {"+W0", 0, 0},            {"+W-5", 0, 0},        {"+W99999999999999999999", 0, 0},
        {"Widths=5", 0, 0},    {"Declare=Width=5", 0, 0}, {"+HT", 0, 0},        {"+W16777216", 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct povray_switches switches;
        struct error err;
        assert_ok(povray_switches_make(&switches, 1, &err), err);
        assert_ok(povray_switch_take(&switches, cases[i].argument, &err), err);
        if (switches.width != cases[i].width || switches.height != cases[i].height || switches.passed_count != 1)
            fail_msg("%s: %d %d", cases[i].argument, switches.width, switches.height);
        povray_switches_free(&switches);
    }
}

static void take__size_twice__last_wins(void **state)
{
    (void)state;
    static const char *const arguments[] = {"+W640", "Width=320", "+H10", "+Hbad", "+A"};
    struct povray_switches switches;
    struct error err;
    assert_ok(povray_switches_make(&switches, 5, &err), err);
    for (int i = 0; i < 5; i++)
        assert_ok(povray_switch_take(&switches, arguments[i], &err), err);
    assert_int_equal(switches.width, 320);
    assert_int_equal(switches.height, 10);
    assert_int_equal(switches.passed_count, 5);
    povray_switches_free(&switches);
}

static void take__libraries_and_scene__taken_out(void **state)
{
    (void)state;
    static const char *const arguments[] = {"+L/a/b", "-lc d", "Library_Path=/e=f", "+Iscene.pov", "LIBRARY_PATH=g"};
    static const char *const folders[] = {"/a/b", "c d", "/e=f", "g"};
    struct povray_switches switches;
    struct error err;
    assert_ok(povray_switches_make(&switches, 5, &err), err);
    for (int i = 0; i < 5; i++)
        assert_ok(povray_switch_take(&switches, arguments[i], &err), err);
    assert_int_equal(switches.passed_count, 0);
    assert_int_equal(switches.library_count, 4);
    for (int i = 0; i < 4; i++)
        assert_string_equal(switches.libraries[i], folders[i]);
    assert_string_equal(switches.scene, "scene.pov");
    assert_ok(povray_switch_take(&switches, "input_file_name=other.pov", &err), err);
    assert_string_equal(switches.scene, "other.pov");
    povray_switches_free(&switches);
}

static void take__what_povgloss_decides__refused_with_a_cure(void **state)
{
    (void)state;
    static const struct {
        const char *argument, *cure;
    } cases[] = {
        {"+Oout.png", "-o"},       {"-o", "-o"},           {"Output_File_Name=x.png", "-o"},
        {"+FN16", "--format"},     {"-F", "--format"},     {"output_file_type=E", "--format"},
        {"+HIheader.inc", "#include"}, {"Include_Header=h", "#include"},
        {"+KFI1", "+K"},           {"+kff30", "+K"},       {"Initial_Frame=1", "+K"},
        {"Final_Frame=9", "+K"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct povray_switches switches;
        struct error err;
        assert_ok(povray_switches_make(&switches, 1, &err), err);
        if (povray_switch_take(&switches, cases[i].argument, &err) != RESULT_USAGE)
            fail_msg("%s is taken", cases[i].argument);
        assert_memory_equal(err.text, cases[i].argument, strlen(cases[i].argument));
        assert_non_null(strstr(err.text, cases[i].cure));
        assert_int_equal(switches.passed_count, 0);
        povray_switches_free(&switches);
    }
}

static void take__antialiasing__last_wins(void **state)
{
    (void)state;
    static const struct {
        const char *first, *second;
        bool antialias;
    } cases[] = {
        {"+A0.3", "+W9", true}, {"+A", "-A", false}, {"-A", "+a0.1", true},          {"+AM2", "+H9", false},
        {"+A0.3", "+AM2", true}, {"+A0.3", "Antialias=off", false}, {"-AM1", "antialias=On", true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct povray_switches switches;
        struct error err;
        assert_int_equal(povray_switches_make(&switches, 2, &err), RESULT_OK);
        assert_int_equal(povray_switch_take(&switches, cases[i].first, &err), RESULT_OK);
        assert_int_equal(povray_switch_take(&switches, cases[i].second, &err), RESULT_OK);
        if (switches.antialias != cases[i].antialias)
            fail_msg("%s %s", cases[i].first, cases[i].second);
        povray_switches_free(&switches);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is__switches_settings_and_ini_files__yes),
        cmocka_unit_test(is__other_arguments__no),
        cmocka_unit_test(take__several__kept_in_order),
        cmocka_unit_test(take__sizes__read_and_passed),
        cmocka_unit_test(take__size_twice__last_wins),
        cmocka_unit_test(take__libraries_and_scene__taken_out),
        cmocka_unit_test(take__what_povgloss_decides__refused_with_a_cure),
        cmocka_unit_test(take__antialiasing__last_wins),
    };
    return cmocka_run_group_tests_name("povray_switches", tests, NULL, NULL);
}
