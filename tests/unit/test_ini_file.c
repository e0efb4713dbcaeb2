/* What is read from .ini files: settings, switches, quotes, comments, sections. */
#include "ini_file.h"

#include "gloss_support.h"
#include "mem.h"

#include <unistd.h>

static enum result add_line(void *context, const char *argument, struct error *err)
{
    if (!strcmp(argument, "Stop=now"))
        return error_set(err, RESULT_USAGE, "stopped");
    struct buffer *lines = context;
    enum result result = buffer_add_text(lines, argument, err);
    return result ? result : buffer_add_text(lines, "|", err);
}

/* Writes the text to a file and reads its section; the lines each end in "|". */
static enum result read_text(const char *text, const char *section, struct buffer *lines, struct error *err)
{
    char path[] = "/tmp/povgloss-test-XXXXXX", argument[100];
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text, strlen(text)), strlen(text));
    close(fd);
    snprintf(argument, sizeof argument, "%s%s", path, section);
    *lines = (struct buffer){0};
    assert_int_equal(buffer_add_text(lines, "", err), RESULT_OK);
    enum result result = ini_file_read(argument, add_line, lines, err);
    unlink(path);
    return result;
}

static void read__lines__as_arguments(void **state)
{
    (void)state;
    static const struct {
        const char *text, *lines;
    } cases[] = {
        {"", ""},
        {"Width=640", "Width=640|"},
        {"Width = 640\nHeight\t=\t480\n", "Width=640|Height=480|"},
        {"  Width=640\r\nHeight=480\r\n", "Width=640|Height=480|"},
        {"; Width=1\n# Height=2\n\n\n+W3 ; +H4\n+H5 # x", "+W3|+H5|"},
        {"+W640 +H480\t-D", "+W640|+H480|-D|"},
        {"Width=640 Height=480\n", "Width=640|"},
        {"Width=640;Height=480\n", "Width=640|"},
        {"Antialias=\nJitter=off", "Antialias=|Jitter=off|"},
        {"Input_File_Name=\"a b;c.pov\" ; d", "Input_File_Name=a b;c.pov|"},
        {"Input_File_Name='a \"b.pov'", "Input_File_Name=a \"b.pov|"},
        {"Input_File_Name=a b.pov  ; c\n+W1", "Input_File_Name=a b.pov|+W1|"},
        {"Width=5 +H6\n+W1", "Width=5|+W1|"},
        {"Input_File_Name=Grüße=1.pov", "Input_File_Name=Grüße=1.pov|"},
        {"Library_Path=a,\"b c\" , 'd'\n+W1", "Library_Path=a|Library_Path=b c|Library_Path=d|+W1|"},
        {"+L\"a b\" +I'c d.pov' +W1", "+La b|+Ic d.pov|+W1|"},
        {"Declare=x=1.5\n", "Declare=x=1.5|"},
        {"Post_Frame_Command=convert \"%o\" a,b ; c\n+W1", "Post_Frame_Command=convert \"%o\" a,b |+W1|"},
        {"scene.pov\n\"other scene.pov\"\nmore.ini[x]", "scene.pov|other scene.pov|more.ini[x]|"},
        {"+L\"no end\nWidth=3", "+Lno end\nWidth=3|"},
        {"= , \" x", "=| x|"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct buffer lines;
        struct error err;
        assert_ok(read_text(cases[i].text, "", &lines, &err), err);
        if (strcmp(lines.data, cases[i].lines))
            fail_msg("%s\ngives %s", cases[i].text, lines.data);
        buffer_free(&lines);
    }
}

static void read__sections__lines_before_them_and_the_one_named(void **state)
{
    (void)state;
    static const char text[] = "+W1\n[low]\n+A0.9\n[Final Cut]\n+A0.1\nQuality=9\n[low] +H7\n[]\n+H8";
    static const struct {
        const char *section, *lines;
    } cases[] = {{"", "+W1|"},
                 {"[low]", "+W1|+A0.9|+H7|"},
                 {"[LOW]", "+W1|+A0.9|+H7|"},
                 {"[final cut]", "+W1|+A0.1|Quality=9|"},
                 {"[]", "+W1|+H8|"}};
    struct buffer lines;
    struct error err;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_ok(read_text(text, cases[i].section, &lines, &err), err);
        assert_string_equal(lines.data, cases[i].lines);
        buffer_free(&lines);
    }
    assert_int_equal(read_text(text, "[fin]", &lines, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, "has no section [fin]"));
    buffer_free(&lines);
}

static void read__missing_file_or_refused_line__fails(void **state)
{
    (void)state;
    struct buffer lines;
    struct error err;
    assert_int_equal(ini_file_read("/nonexistent/a.ini[x]", add_line, NULL, &err), RESULT_DATA);
    assert_non_null(strstr(err.text, "/nonexistent/a.ini: "));
    assert_int_equal(read_text("+W1\nStop=now\n+H2", "", &lines, &err), RESULT_USAGE);
    assert_string_equal(err.text, "stopped");
    assert_string_equal(lines.data, "+W1|");
    buffer_free(&lines);
}

static void name__arguments__length_of_the_path(void **state)
{
    (void)state;
    static const struct {
        const char *argument;
        size_t length;
    } cases[] = {{"quality.ini", 11},   {"a/b.INI", 7}, {"quality.ini[High]", 11}, {"x.ini[a.b]", 5}, {"a=b.ini", 7},
                 {"star*[x].ini", 12},  {".ini", 0},    {"x.inix", 0},             {"ini", 0},        {"a.ini.pov", 0},
                 {"[a.ini]", 0},        {"+Ia.ini", 0}, {"", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(ini_file_name(cases[i].argument), cases[i].length);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(read__lines__as_arguments),
        cmocka_unit_test(read__sections__lines_before_them_and_the_one_named),
        cmocka_unit_test(read__missing_file_or_refused_line__fails),
        cmocka_unit_test(name__arguments__length_of_the_path),
    };
    return cmocka_run_group_tests_name("ini_file", tests, NULL, NULL);
}
