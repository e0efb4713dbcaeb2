/* POV-Ray's command line is a row of +X and -X switches, whose letters' case doesn't matter, of Name=Value settings, and of
 * .ini files. */
#include "povray_switches.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum result povray_switches_make(struct povray_switches *switches, int capacity, struct error *err)
{
    size_t size = (size_t)capacity + 1;
    *switches = (struct povray_switches){.passed = calloc(size, sizeof(char *)), .libraries = calloc(size, sizeof(char *))};
    if (switches->passed && switches->libraries)
        return RESULT_OK;
    povray_switches_free(switches);
    return error_memory(err, 2.0 * (double)size * sizeof(char *));
}

void povray_switches_free(struct povray_switches *switches)
{
    free(switches->passed);
    free(switches->libraries);
    *switches = (struct povray_switches){0};
}

size_t povray_switch_ini(const char *argument)
{
    size_t length = strlen(argument);
    const char *section = length && argument[length - 1] == ']' ? strrchr(argument, '[') : NULL;
    if (section)
        length = (size_t)(section - argument);
    bool is_switch = argument[0] == '+' || argument[0] == '-';
    return !is_switch && length > 4 && !strncasecmp(argument + length - 4, ".ini", 4) ? length : 0;
}

/* The name of a setting is a word: a path may have a = of its own. */
static bool is_setting(const char *argument)
{
    size_t length = strspn(argument, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_");
    return length > 0 && argument[length] == '=';
}

bool povray_switch_is(const char *argument)
{
    if ((argument[0] == '+' || argument[0] == '-') && argument[1] && argument[1] != '-')
        return true;
    return povray_switch_ini(argument) > 0 || is_setting(argument);
}

/* The value of a switch such as +L or of a setting such as Library_Path=, else NULL. */
static const char *value_of(const char *argument, const char *letters, const char *setting)
{
    if (argument[0] == '+' || argument[0] == '-')
        return strncasecmp(argument + 1, letters, strlen(letters)) ? NULL : argument + 1 + strlen(letters);
    size_t length = strlen(setting);
    return !strncasecmp(argument, setting, length) && argument[length] == '=' ? argument + length + 1 : NULL;
}

static int size_of(const char *argument, const char *letter, const char *setting)
{
    const char *value = value_of(argument, letter, setting);
    char *end;
    long size = value ? strtol(value, &end, 10) : 0;
    return value && end != value && !*end && size > 0 && size < 1 << 24 ? (int)size : 0;
}

enum result povray_switch_take(struct povray_switches *switches, const char *argument, struct error *err)
{
    static const struct {
        const char *letters, *setting, *cure;
    } refused[] = {
        {"HI", "Include_Header", "write the #include into the scene"},
        {"O", "Output_File_Name", "name the output with -o"},
        {"F", "Output_File_Type", "choose the format with --format or by the ending of -o"},
        {"KFI", "Initial_Frame", "render one frame at a time, with +K and its clock value"},
        {"KFF", "Final_Frame", "render one frame at a time, with +K and its clock value"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (value_of(argument, refused[i].letters, refused[i].setting))
            return error_set(err, RESULT_USAGE, "%s can't be passed on to POV-Ray: %s", argument, refused[i].cure);
    const char *library = value_of(argument, "L", "Library_Path"), *scene = value_of(argument, "I", "Input_File_Name");
    if (scene) {
        switches->scene = scene;
        return RESULT_OK;
    }
    if (library) {
        switches->libraries[switches->library_count++] = library;
        return RESULT_OK;
    }
    const char *sampling = value_of(argument, "AM", "Sampling_Method"), *setting = value_of(argument, "A", "Antialias");
    if (setting && !sampling)
        switches->antialias = argument[0] == '+' || (argument[0] != '-' && !strncasecmp(setting, "on", 2));
    int width = size_of(argument, "W", "Width"), height = size_of(argument, "H", "Height");
    switches->width = width ? width : switches->width;
    switches->height = height ? height : switches->height;
    switches->passed[switches->passed_count++] = argument;
    return RESULT_OK;
}
