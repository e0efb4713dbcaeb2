/* Reads .ini files as POV-Ray does: several switches may share a line, what follows a setting on its line doesn't
 * count, and a value without quotes ends at a blank unless the rest of the line can only belong to it. */
#include "ini_file.h"

#include "input_file.h"
#include "mem.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char key_letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";

struct reader {
    const char *at;
    ini_file_take *take;
    void *context;
};

size_t ini_file_path_length(const char *argument)
{
    size_t length = strlen(argument);
    const char *section = length && argument[length - 1] == ']' ? strrchr(argument, '[') : NULL;
    return section ? (size_t)(section - argument) : length;
}

size_t ini_file_name(const char *argument)
{
    size_t length = ini_file_path_length(argument);
    bool is_switch = argument[0] == '+' || argument[0] == '-';
    return !is_switch && length > 4 && !strncasecmp(argument + length - 4, ".ini", 4) ? length : 0;
}

static const char *skip_blanks(const char *at)
{
    return at + strspn(at, " \t");
}

static const char *line_end(const char *at)
{
    return at + strcspn(at, "\r\n");
}

/* Whether a value without quotes goes on after the blank at `at`: not before a switch or another setting. */
static bool goes_on(const char *at)
{
    at = skip_blanks(at);
    if (strchr("\r\n;#,", *at) || (strchr("+-", *at) && isalpha((unsigned char)at[1])))
        return false;
    at += strspn(at, key_letters);
    return *skip_blanks(at) != '=';
}

/* The value at reader->at, with or without quotes; moves past it. */
static void read_value(struct reader *reader, const char **begin, size_t *length)
{
    const char quote = *reader->at;
    if (quote == '"' || quote == '\'') {
        *begin = reader->at + 1;
        const char *end = strchr(*begin, quote);
        *length = end ? (size_t)(end - *begin) : strlen(*begin);
        reader->at = *begin + *length + (end != NULL);
        return;
    }
    *begin = reader->at;
    *length = strcspn(*begin, " \t\r\n,;#\"'");
    if (strchr(" \t", (*begin)[*length]) && goes_on(*begin + *length)) {
        *length = strcspn(*begin, "\r\n;#");
        while (isblank((unsigned char)(*begin)[*length - 1]))
            --*length;
    }
    reader->at = *begin + *length;
}

static enum result give(const struct reader *reader, const char *begin, size_t length, const char *value,
                        size_t value_length, struct error *err)
{
    char *argument;
    enum result result =
        text_printf(&argument, err, "%.*s%.*s", (int)length, begin, (int)value_length, value_length ? value : "");
    if (!result)
        result = reader->take(reader->context, argument, err);
    free(argument);
    return result;
}

static enum result read_switch(struct reader *reader, struct error *err)
{
    const char *begin = reader->at, *value = NULL;
    size_t length = strcspn(begin, " \t\r\n,;#\"'"), value_length = 0;
    reader->at += length;
    if (*reader->at == '"' || *reader->at == '\'')
        read_value(reader, &value, &value_length);
    return give(reader, begin, length, value, value_length, err);
}

/* `key = value, value`, at the key; `values` is what follows the equals sign. Shell commands have commas and quotes of
 * their own. */
static enum result read_setting(struct reader *reader, size_t key_length, const char *values, struct error *err)
{
    const char *key = reader->at, *value;
    char *name;
    size_t value_length;
    enum result result = text_printf(&name, err, "%.*s=", (int)key_length, key);
    reader->at = skip_blanks(values);
    if (!result && key_length > 8 && !strncasecmp(key + key_length - 8, "_Command", 8)) {
        result = give(reader, name, key_length + 1, reader->at, strcspn(reader->at, "\r\n;#"), err);
    } else {
        bool more = true;
        while (!result && more) {
            read_value(reader, &value, &value_length);
            result = give(reader, name, key_length + 1, value, value_length, err);
            const char *comma = skip_blanks(reader->at);
            more = *comma == ',';
            reader->at = more ? skip_blanks(comma + 1) : comma;
        }
    }
    free(name);
    reader->at = line_end(reader->at);
    return result;
}

static enum result read_entry(struct reader *reader, struct error *err)
{
    if (strchr("+-", *reader->at))
        return read_switch(reader, err);
    size_t key = strspn(reader->at, key_letters);
    const char *sign = skip_blanks(reader->at + key), *value;
    if (key && *sign == '=')
        return read_setting(reader, key, sign + 1, err);
    size_t length;
    read_value(reader, &value, &length);
    if (!length && *reader->at)
        reader->at++;
    return length ? give(reader, value, length, NULL, 0, err) : RESULT_OK;
}

static enum result read_text(struct reader *reader, const char *section, size_t section_length, bool *found,
                             struct error *err)
{
    bool wanted = true;
    enum result result = RESULT_OK;
    while (!result) {
        reader->at += strspn(reader->at, " \t\r\n");
        if (!*reader->at)
            break;
        if (*reader->at == '[') {
            size_t length = strcspn(reader->at + 1, "]\r\n");
            wanted = section && length == section_length && !strncasecmp(reader->at + 1, section, length);
            *found |= wanted;
            reader->at += 1 + length + (reader->at[1 + length] == ']');
        } else if (!wanted || strchr(";#", *reader->at)) {
            reader->at = line_end(reader->at);
        } else {
            result = read_entry(reader, err);
        }
    }
    return result;
}

enum result ini_file_read(const char *argument, ini_file_take *take, void *context, struct error *err)
{
    size_t length = ini_file_path_length(argument);
    const char *section = argument[length] == '[' ? argument + length + 1 : NULL;
    size_t section_length = section ? strlen(section) - 1 : 0;
    struct input_file input = {0};
    struct buffer text = {0};
    char *path;
    bool found = !section;
    enum result result = text_printf(&path, err, "%.*s", (int)length, argument);
    if (result)
        return result;
    result = input_file_read(path, &input, err);
    if (!result)
        result = buffer_add(&text, input.data, input.size, err);
    if (!result) {
        struct reader reader = {.at = text.data, .take = take, .context = context};
        result = read_text(&reader, section, section_length, &found, err);
    }
    if (!result && !found)
        result = error_set(err, RESULT_DATA, "%s: has no section [%.*s]", path, (int)section_length, section);
    buffer_free(&text);
    input_file_free(&input);
    free(path);
    return result;
}
