/* Which arguments belong to POV-Ray, and what is taken out of them. */
#include "povray_switches.h"

#include "gloss_support.h"

#include <math.h>
#include <unistd.h>

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

/* Begins with none of POV-Ray's own .ini files. */
static void begin(struct povray_switches *switches)
{
    struct error err;
    setenv("POVINI", "/dev/null", 1);
    assert_ok(povray_switches_begin(switches, &err), err);
}

static void take_all(struct povray_switches *switches, const char *const *arguments, int count)
{
    struct error err;
    begin(switches);
    for (int i = 0; i < count; i++)
        assert_ok(povray_switch_take(switches, arguments[i], &err), err);
}

/* A file of the test's own, which the caller removes. */
static void write_text(char path[64], const char *ending, const char *text)
{
    snprintf(path, 64, "/tmp/povgloss-test-XXXXXX%s", ending);
    int fd = mkstemps(path, (int)strlen(ending));
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text, strlen(text)), strlen(text));
    close(fd);
}

static void take__several__kept_in_order(void **state)
{
    (void)state;
    static const char *const arguments[] = {"+A0.3", "-P", "Declare=x=1", "+K0.5", "+SF1", "+Q9"};
    struct povray_switches switches;
    take_all(&switches, arguments, 6);
    assert_int_equal(switches.passed.count, 6);
    for (int i = 0; i < 6; i++)
        assert_string_equal(switches.passed.texts[i], arguments[i]);
    assert_int_equal(switches.libraries.count, 0);
    assert_null(switches.scene);
    assert_int_equal(switches.width, 0);
    assert_int_equal(switches.height, 0);
    povray_switches_free(&switches);
    assert_null(switches.passed.texts);
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
        take_all(&switches, &cases[i].argument, 1);
        if (switches.width != cases[i].width || switches.height != cases[i].height || switches.passed.count != 1)
            fail_msg("%s: %d %d", cases[i].argument, switches.width, switches.height);
        povray_switches_free(&switches);
    }
}

static void take__size_twice__last_wins(void **state)
{
    (void)state;
    static const char *const arguments[] = {"+W640", "Width=320", "+H10", "+Hbad", "+A"};
    struct povray_switches switches;
    take_all(&switches, arguments, 5);
    assert_int_equal(switches.width, 320);
    assert_int_equal(switches.height, 10);
    assert_int_equal(switches.passed.count, 5);
    povray_switches_free(&switches);
}

static void take__libraries_and_scene__taken_out(void **state)
{
    (void)state;
    static const char *const arguments[] = {"+L/a/b", "-lc d", "Library_Path=/e=f", "+Iscene.pov", "LIBRARY_PATH='g h'",
                                            "+L\"it's\""};
    static const char *const folders[] = {"/a/b", "c d", "/e=f", "g h", "it's"};
    struct povray_switches switches;
    struct error err;
    take_all(&switches, arguments, 6);
    assert_int_equal(switches.passed.count, 0);
    assert_int_equal(switches.libraries.count, 5);
    for (int i = 0; i < 5; i++)
        assert_string_equal(switches.libraries.texts[i], folders[i]);
    assert_string_equal(switches.scene, "scene.pov");
    assert_ok(povray_switch_take(&switches, "input_file_name=\"other.pov\"", &err), err);
    assert_string_equal(switches.scene, "other.pov");
    povray_switches_free(&switches);
}

static void take__what_povgloss_decides__refused_with_a_cure(void **state)
{
    (void)state;
    static const struct {
        const char *argument, *cure;
    } cases[] = {
        {"+Oout.png", "-o"},
        {"-o", "-o"},
        {"Output_File_Name=x.png", "-o"},
        {"+FN16", "--format"},
        {"-F", "--format"},
        {"output_file_type=E", "--format"},
        {"+HIheader.inc", "#include"},
        {"Include_Header=h", "#include"},
        {"Pre_Scene_Command=make", "before or after"},
        {"post_frame_command=show %o", "before or after"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct povray_switches switches;
        struct error err;
        begin(&switches);
        if (povray_switch_take(&switches, cases[i].argument, &err) != RESULT_USAGE)
            fail_msg("%s is taken", cases[i].argument);
        assert_memory_equal(err.text, cases[i].argument, strlen(cases[i].argument));
        assert_non_null(strstr(err.text, cases[i].cure));
        assert_int_equal(switches.passed.count, 0);
        povray_switches_free(&switches);
    }
}

static void take__antialiasing__last_wins(void **state)
{
    (void)state;
    static const struct {
        const char *arguments[2];
        bool antialias;
    } cases[] = {
        {{"+A0.3", "+W9"}, true},  {{"+A", "-A"}, false},             {{"-A", "+a0.1"}, true}, {{"+AM2", "+H9"}, false},
        {{"+A0.3", "+AM2"}, true}, {{"+A0.3", "Antialias=off"}, false}, {{"-AM1", "antialias=On"}, true},
        {{"-A", "Antialias=true"}, true}, {{"-A", "Antialias=1"}, true}, {{"+A", "Antialias=0"}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct povray_switches switches;
        take_all(&switches, cases[i].arguments, 2);
        if (switches.antialias != cases[i].antialias)
            fail_msg("%s %s", cases[i].arguments[0], cases[i].arguments[1]);
        povray_switches_free(&switches);
    }
}

static void take__antialiasing__has_threshold(void **state)
{
    (void)state;
    static const struct {
        const char *arguments[2];
        double threshold;
    } cases[] = {
        {{"+A", "+W9"}, 0.3},      {{"+a0.1", "+AM2"}, 0.1},          {{"+A0.1", "-A"}, 0.1}, {{"+AM1", "+A.05"}, 0.05},
        {{"+A0.2", "+A0.1"}, 0.1}, {{"antialias_threshold=0.25", "Antialias=on"}, 0.25},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct povray_switches switches;
        take_all(&switches, cases[i].arguments, 2);
        if (fabs(switches.threshold - cases[i].threshold) > 1e-12)
            fail_msg("%s %s", cases[i].arguments[0], cases[i].arguments[1]);
        povray_switches_free(&switches);
    }
}

static void take__frames__read_and_passed(void **state)
{
    (void)state;
    enum { UNSAID = FRAMES_UNSAID };
    static const struct {
        const char *arguments[2];
        struct frames_options frames;
    } cases[] = {
        {{"+KFI2", "+KFF30"}, {2, 30, 1, false, UNSAID, UNSAID}},
        {{"Initial_Frame=2", "final_frame=30"}, {2, 30, 1, false, UNSAID, UNSAID}},
        {{"-kff7", "+KFF8x"}, {UNSAID, 8, 1, false, UNSAID, UNSAID}},
        {{"+KF2.5", "+KI0.5"}, {UNSAID, UNSAID, 1, false, UNSAID, UNSAID}},
        {{"Final_Clock=2.5", "+K0.5"}, {UNSAID, UNSAID, 1, false, UNSAID, UNSAID}},
        {{"+KFF3.9", "+KC"}, {UNSAID, 3, 1, true, UNSAID, UNSAID}},
        {{"+KC", "-kc"}, {UNSAID, UNSAID, 1, false, UNSAID, UNSAID}},
        {{"Cyclic_Animation=yes", "+KFFx"}, {UNSAID, UNSAID, 1, true, UNSAID, UNSAID}},
        {{"+SF0.25", "+EF4"}, {UNSAID, UNSAID, 1, false, 0.25, 4}},
        {{"Subset_Start_Frame=3", "Subset_End_Frame=.5"}, {UNSAID, UNSAID, 1, false, 3, 0.5}},
        {{"+STP3", "+SP4"}, {UNSAID, UNSAID, 3, false, UNSAID, UNSAID}},
        {{"Frame_Step=4", "+KFF99999999999"}, {UNSAID, UNSAID, 4, false, UNSAID, UNSAID}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct povray_switches switches;
        const struct frames_options *got = &switches.frames, *wanted = &cases[i].frames;
        take_all(&switches, cases[i].arguments, 2);
        if (got->initial != wanted->initial || got->final != wanted->final || got->step != wanted->step ||
            got->cyclic != wanted->cyclic || got->subset_start != wanted->subset_start ||
            got->subset_end != wanted->subset_end || switches.passed.count != 2)
            fail_msg("%s %s", cases[i].arguments[0], cases[i].arguments[1]);
        povray_switches_free(&switches);
    }
}

static void take__ini_file__its_lines_in_its_place(void **state)
{
    (void)state;
    char inner[64], outer[64], text[200];
    write_text(inner, ".ini", "Width=7\nLibrary_Path=\"a b\"\nFinal_Frame=9\n");
    snprintf(text, sizeof text,
             "+Q3\nInput_File_Name=\"in ini.pov\"\nInclude_Ini=%s\nOutput_File_Name=x.tga\n+FT -oy\nInclude_Header=\n"
             "Post_Scene_Command=\n[x]\nHeight=5",
             inner);
    write_text(outer, ".ini", text);
    char with_section[80];
    snprintf(with_section, sizeof with_section, "%s[x]", outer);
    const char *const arguments[] = {"+W1", with_section, "+W3"};
    static const char *const passed[] = {"+W1", "+Q3", "Width=7", "Final_Frame=9", "Height=5", "+W3"};
    struct povray_switches switches;
    take_all(&switches, arguments, 3);
    assert_int_equal(switches.passed.count, 6);
    for (int i = 0; i < 6; i++)
        assert_string_equal(switches.passed.texts[i], passed[i]);
    assert_string_equal(switches.libraries.texts[0], "a b");
    assert_null(switches.scene);
    assert_string_equal(switches.file_scene, "in ini.pov");
    assert_int_equal(switches.width, 3);
    assert_int_equal(switches.height, 5);
    assert_int_equal(switches.frames.final, 9);
    povray_switches_free(&switches);
    unlink(inner);
    unlink(outer);
}

static void take__ini_file_of_itself__refused(void **state)
{
    (void)state;
    char path[64], text[100];
    write_text(path, ".ini", "");
    snprintf(text, sizeof text, "Include_Ini=%s", path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(fclose(file), 0);
    struct povray_switches switches;
    struct error err;
    begin(&switches);
    assert_int_equal(povray_switch_take(&switches, path, &err), RESULT_DATA);
    assert_memory_equal(err.text, path, strlen(path));
    povray_switches_free(&switches);
    unlink(path);
}

static void begin__povrays_own_ini_file__comes_first(void **state)
{
    (void)state;
    char path[64];
    struct povray_switches switches;
    struct error err;
    write_text(path, ".conf", "+W5\nLibrary_Path=/lib\nInput_File_Name=default.pov\n");
    setenv("POVINI", path, 1);
    assert_ok(povray_switches_begin(&switches, &err), err);
    assert_ok(povray_switch_take(&switches, "+L/own", &err), err);
    assert_int_equal(switches.width, 5);
    assert_string_equal(switches.passed.texts[0], "+W5");
    assert_string_equal(switches.libraries.texts[0], "/lib");
    assert_string_equal(switches.libraries.texts[1], "/own");
    assert_string_equal(switches.file_scene, "default.pov");
    povray_switches_free(&switches);
    unlink(path);
}

static void comment__line_of_switches__taken(void **state)
{
    (void)state;
    static const struct {
        const char *text, *line, *passed;
    } cases[] = {
        {"// -w320 -h240\n// -w800 -h600 +a0.3\n", ":1: // -w320 -h240", "-w320 -h240 "},
        {"#version 3.7;\r\n//  +W640 +H480 +A0.3\r\n", ":2: //  +W640 +H480 +A0.3", "+W640 +H480 +A0.3 "},
        {"//\t+W64 Declare=x=1 +fN -d Output_File_Name=a.png  ", ":1: //\t+W64 Declare=x=1 +fN -d Output_File_Name=a.png  ",
         "+W64 Declare=x=1 -d "},
        {"// -- prose\n// - prose\n//+W1\n// +w512 or so\n// with +W9\n +W8\n// +W7 // +W6\n// +W5", ":8: // +W5", "+W5 "},
        {"//\n// \n// -f", ":3: // -f", ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[64], *line = NULL, passed[200] = "";
        struct povray_switches switches;
        struct error err;
        write_text(path, ".pov", cases[i].text);
        begin(&switches);
        assert_ok(povray_switches_take_comment(&switches, path, &line, &err), err);
        assert_string_equal(line + strlen(path), cases[i].line);
        for (int j = 0; j < switches.passed.count; j++) {
            strcat(passed, switches.passed.texts[j]);
            strcat(passed, " ");
        }
        assert_string_equal(passed, cases[i].passed);
        free(line);
        povray_switches_free(&switches);
        unlink(path);
    }
}

static void comment__none_in_50_lines__refused_with_a_cure(void **state)
{
    (void)state;
    char text[200] = "", path[64], *line = NULL;
    memset(text, '\n', 50);
    strcpy(text + 50, "// +W640 +H480\n");
    struct povray_switches switches;
    struct error err;
    write_text(path, ".pov", text);
    begin(&switches);
    assert_int_equal(povray_switches_take_comment(&switches, path, &line, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, "--from-scene"));
    assert_null(line);
    unlink(path);
    write_text(path, ".pov", text + 1);
    assert_ok(povray_switches_take_comment(&switches, path, &line, &err), err);
    assert_int_equal(switches.width, 640);
    free(line);
    povray_switches_free(&switches);
    unlink(path);
}

static void find_scene__as_povray_does(void **state)
{
    (void)state;
    char path[64], stem[64], *found;
    write_text(path, ".pov", "");
    snprintf(stem, sizeof stem, "%.*s", (int)strlen(path) - 4, path);
    const char *const arguments[] = {"+L/nonexistent", "+L/tmp"}, *name = strrchr(stem, '/') + 1;
    struct povray_switches switches;
    struct error err;
    take_all(&switches, arguments, 2);
    assert_ok(povray_switches_find_scene(&switches, stem, &found, &err), err);
    assert_string_equal(found, path);
    free(found);
    assert_ok(povray_switches_find_scene(&switches, name, &found, &err), err);
    assert_string_equal(found, path);
    free(found);
    assert_ok(povray_switches_find_scene(&switches, "none", &found, &err), err);
    assert_string_equal(found, "none");
    free(found);
    povray_switches_free(&switches);
    unlink(path);
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
        cmocka_unit_test(take__antialiasing__has_threshold),
        cmocka_unit_test(take__frames__read_and_passed),
        cmocka_unit_test(take__ini_file__its_lines_in_its_place),
        cmocka_unit_test(take__ini_file_of_itself__refused),
        cmocka_unit_test(begin__povrays_own_ini_file__comes_first),
        cmocka_unit_test(comment__line_of_switches__taken),
        cmocka_unit_test(comment__none_in_50_lines__refused_with_a_cure),
        cmocka_unit_test(find_scene__as_povray_does),
    };
    return cmocka_run_group_tests_name("povray_switches", tests, NULL, NULL);
}
