/* POV-Ray's command line is a row of +X and -X switches, whose letters' case doesn't matter, of Name=Value settings,
 * and of .ini files. */
#include "povray_switches.h"

#include "ini_file.h"
#include "input_file.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { MAX_DEPTH = 8, MAX_COMMENT_LINES = 50 };

static enum result take(struct povray_switches *switches, const char *argument, bool in_file, struct error *err);

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
    return ini_file_name(argument) > 0 || is_setting(argument);
}

/* The value of a switch such as +L or of a setting such as Library_Path=, else NULL. Settings may have no letters. */
static const char *value_of(const char *argument, const char *letters, const char *setting)
{
    if (argument[0] == '+' || argument[0] == '-')
        return !letters || strncasecmp(argument + 1, letters, strlen(letters)) ? NULL : argument + 1 + strlen(letters);
    size_t length = strlen(setting);
    return !strncasecmp(argument, setting, length) && argument[length] == '=' ? argument + length + 1 : NULL;
}

/* A copy of the value without the quotes that POV-Ray would take off. */
static enum result unquote(const char *value, char **copy, struct error *err)
{
    size_t length = strlen(value);
    bool quoted = length > 1 && strchr("\"'", value[0]) && value[length - 1] == value[0];
    return text_printf(copy, err, "%.*s", (int)length - 2 * quoted, value + quoted);
}

static int size_of(const char *argument, const char *letter, const char *setting)
{
    const char *value = value_of(argument, letter, setting);
    char *end;
    long size = value ? strtol(value, &end, 10) : 0;
    return value && end != value && !*end && size > 0 && size < 1 << 24 ? (int)size : 0;
}

static void note_number(const char *argument, const char *letters, const char *setting, double *number)
{
    const char *value = value_of(argument, letters, setting);
    char *end;
    double found = value ? strtod(value, &end) : 0;
    if (value && end != value)
        *number = found;
}

static void note_integer(const char *argument, const char *letters, const char *setting, int *number)
{
    double found = *number;
    note_number(argument, letters, setting, &found);
    if (found > FRAMES_UNSAID && found < -FRAMES_UNSAID)
        *number = (int)found;
}

/* POV-Ray compares as many letters as both words have. */
static void note_switch(const char *argument, const char *letters, const char *setting, bool *on)
{
    const char *value = value_of(argument, letters, setting);
    static const char *const words[] = {"on", "true", "yes", "1"};
    bool is_word = false;
    for (size_t i = 0; value && i < sizeof words / sizeof *words; i++)
        is_word |= !strncasecmp(value, words[i], strlen(value) < strlen(words[i]) ? strlen(value) : strlen(words[i]));
    if (value)
        *on = argument[0] == '+' || (argument[0] != '-' && is_word);
}

static bool is_partial(const char *argument)
{
    static const char *const parts[][2] = {
        {"SR", "Start_Row"}, {"ER", "End_Row"}, {"SC", "Start_Column"}, {"EC", "End_Column"}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (value_of(argument, parts[i][0], parts[i][1]))
            return true;
    return false;
}

static void note(struct povray_switches *switches, const char *argument)
{
    struct frames_options *frames = &switches->frames;
    note_integer(argument, "KFI", "Initial_Frame", &frames->initial);
    note_integer(argument, "KFF", "Final_Frame", &frames->final);
    note_integer(argument, "STP", "Frame_Step", &frames->step);
    note_number(argument, "SF", "Subset_Start_Frame", &frames->subset_start);
    note_number(argument, "EF", "Subset_End_Frame", &frames->subset_end);
    note_switch(argument, "KC", "Cyclic_Animation", &frames->cyclic);
    if (!value_of(argument, "AM", "Sampling_Method")) {
        note_switch(argument, "A", "Antialias", &switches->antialias);
        note_number(argument, "A", "Antialias_Threshold", &switches->threshold);
    }
    switches->partial |= is_partial(argument);
    int width = size_of(argument, "W", "Width"), height = size_of(argument, "H", "Height");
    switches->width = width ? width : switches->width;
    switches->height = height ? height : switches->height;
}

/* *taken is true for what isn't passed on; RESULT_USAGE for what can't be. */
static enum result refuse(const char *argument, bool in_file, bool *taken, struct error *err)
{
    static const char commands[] = "run the command before or after povgloss";
    static const struct {
        const char *letters, *setting;
        bool overridden; /* the passes' own comes after it */
        const char *cure;
    } refused[] = {
        {"O", "Output_File_Name", true, "name the output with -o"},
        {"F", "Output_File_Type", true, "choose the format with --format or by the ending of -o"},
        {"HI", "Include_Header", false, "write the #include into the scene"},
        {NULL, "Pre_Scene_Command", false, commands},
        {NULL, "Pre_Frame_Command", false, commands},
        {NULL, "Post_Frame_Command", false, commands},
        {NULL, "Post_Scene_Command", false, commands},
        {NULL, "User_Abort_Command", false, commands},
        {NULL, "Fatal_Error_Command", false, commands},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        const char *value = value_of(argument, refused[i].letters, refused[i].setting);
        if (!value)
            continue;
        *taken = true;
        if (refused[i].overridden ? in_file : !*value)
            return RESULT_OK;
        return error_set(err, RESULT_USAGE, "%s can't be passed on to POV-Ray: %s", argument, refused[i].cure);
    }
    return RESULT_OK;
}

static enum result take_scene(struct povray_switches *switches, const char *value, bool in_file, struct error *err)
{
    char **scene = in_file ? &switches->file_scene : &switches->scene;
    free(*scene);
    return unquote(value, scene, err);
}

static enum result take_library(struct povray_switches *switches, const char *value, struct error *err)
{
    char *folder;
    enum result result = unquote(value, &folder, err);
    if (!result)
        result = text_list_add(&switches->libraries, err, "%s", folder);
    free(folder);
    return result;
}

static enum result take_line(void *switches, const char *argument, struct error *err)
{
    return take(switches, argument, true, err);
}

static enum result take_ini(struct povray_switches *switches, const char *argument, struct error *err)
{
    if (switches->depth == MAX_DEPTH)
        return error_set(err, RESULT_DATA, "%s: .ini files that read each other %d deep", argument, MAX_DEPTH);
    switches->depth++;
    enum result result =
        text_list_add(&switches->ini_files, err, "%.*s", (int)ini_file_path_length(argument), argument);
    if (!result)
        result = ini_file_read(argument, take_line, switches, err);
    switches->depth--;
    return result;
}

static enum result take(struct povray_switches *switches, const char *argument, bool in_file, struct error *err)
{
    bool taken = false;
    enum result result = refuse(argument, in_file, &taken, err);
    if (result || taken)
        return result;
    const char *library = value_of(argument, "L", "Library_Path"), *scene = value_of(argument, "I", "Input_File_Name");
    const char *ini = value_of(argument, NULL, "Include_Ini");
    if (ini || ini_file_name(argument))
        return take_ini(switches, ini ? ini : argument, err);
    if (library)
        return take_library(switches, library, err);
    if (scene || !povray_switch_is(argument))
        return take_scene(switches, scene ? scene : argument, in_file, err);
    note(switches, argument);
    return text_list_add(&switches->passed, err, "%s", argument);
}

enum result povray_switch_take(struct povray_switches *switches, const char *argument, struct error *err)
{
    return take(switches, argument, false, err);
}

/* The .ini file that POV-Ray reads before its command line: the first that exists of $POVINI, ./povray.ini,
 * ~/.povray/3.7/povray.ini and /etc/povray/3.7/povray.ini. The caller frees *path; it is NULL where there is none. */
static enum result find_defaults(char **path, struct error *err)
{
    *path = NULL;
    const char *variable = getenv("POVINI"), *home = getenv("HOME");
    struct text_list candidates = {0};
    enum result result = variable && *variable ? text_list_add(&candidates, err, "%s", variable) : RESULT_OK;
    if (!result)
        result = text_list_add(&candidates, err, "povray.ini");
    if (!result)
        result = text_list_add(&candidates, err, "%s/.povray/3.7/povray.ini", home ? home : "");
    if (!result)
        result = text_list_add(&candidates, err, "/etc/povray/3.7/povray.ini");
    for (int i = 0; !result && !*path && i < candidates.count; i++)
        if (access(candidates.texts[i], R_OK) == 0)
            result = text_printf(path, err, "%s", candidates.texts[i]);
    text_list_free(&candidates);
    return result;
}

enum result povray_switches_begin(struct povray_switches *switches, struct error *err)
{
    *switches = (struct povray_switches){.frames = frames_options_default(), .threshold = 0.3};
    char *defaults;
    enum result result = find_defaults(&defaults, err);
    if (!result && defaults)
        result = take_ini(switches, defaults, err);
    free(defaults);
    return result;
}

void povray_switches_free(struct povray_switches *switches)
{
    text_list_free(&switches->passed);
    text_list_free(&switches->libraries);
    text_list_free(&switches->ini_files);
    free(switches->scene);
    free(switches->file_scene);
    *switches = (struct povray_switches){0};
}

/* ---- the scene ---- */

/* The switches of one line of the scene, in *words; none if it is no comment of switches only. */
static enum result split_comment(const char *line, size_t length, struct text_list *words, struct error *err)
{
    static const char blanks[] = " \t\r";
    const char *at = line + 2, *end = line + length;
    if (length < 4 || strncmp(line, "//", 2) || !strchr(" \t", *at))
        return RESULT_OK;
    enum result result = RESULT_OK;
    while (!result) {
        at += strspn(at, blanks);
        if (at >= end)
            break;
        size_t word = strcspn(at, " \t\r\n");
        result = text_list_add(words, err, "%.*s", (int)word, at);
        bool is_switch = !result && (words->count == 1 ? strchr("+-", *at) != NULL : true) &&
                         povray_switch_is(words->texts[words->count - 1]);
        if (!is_switch) {
            text_list_free(words);
            break;
        }
        at += word;
    }
    return result;
}

enum result povray_switches_take_comment(struct povray_switches *switches, const char *scene, char **line,
                                         struct error *err)
{
    struct input_file input = {0};
    struct buffer text = {0};
    struct text_list words = {0};
    *line = NULL;
    enum result result = input_file_read(scene, &input, err);
    if (!result)
        result = buffer_add(&text, input.data, input.size, err);
    const char *at = text.data;
    for (int number = 1; !result && !words.count && *at && number <= MAX_COMMENT_LINES; number++) {
        size_t length = strcspn(at, "\n");
        result = split_comment(at, length, &words, err);
        if (!result && words.count)
            result = text_printf(line, err, "%s:%d: %.*s", scene, number, (int)strcspn(at, "\r\n"), at);
        at += length + (at[length] == '\n');
    }
    if (!result && !words.count)
        result = error_set(err, RESULT_DATA,
                           "%s: no comment such as // +W640 +H480 +A0.3 in its first %d lines: leave --from-scene out "
                           "and give POV-Ray's switches yourself",
                           scene, MAX_COMMENT_LINES);
    for (int i = 0; !result && i < words.count; i++)
        result = take(switches, words.texts[i], true, err);
    text_list_free(&words);
    buffer_free(&text);
    input_file_free(&input);
    return result;
}

enum result povray_switches_find_scene(const struct povray_switches *switches, const char *name, char **path,
                                       struct error *err)
{
    static const char *const endings[] = {"", ".pov"};
    for (int folder = -1; folder < (name[0] == '/' ? 0 : switches->libraries.count); folder++)
        for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
            enum result result =
                folder < 0 ? text_printf(path, err, "%s%s", name, endings[i])
                           : text_printf(path, err, "%s/%s%s", switches->libraries.texts[folder], name, endings[i]);
            if (result || access(*path, R_OK) == 0)
                return result;
            free(*path);
        }
    return text_printf(path, err, "%s", name);
}
