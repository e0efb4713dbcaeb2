/* GNU make's escapes: `$` is doubled; a backslash goes before white space, `#`, `:` and wildcards, and the backslashes
 * before those are doubled. */
#include "depfile.h"

#include "output_file.h"

#include <stdbool.h>
#include <string.h>

enum result depfile_check_name(const char *name, struct error *err)
{
    bool control = false;
    size_t length = strlen(name);
    for (const char *c = name; *c; c++)
        control |= (unsigned char)*c < ' ';
    if (length && !control && !strpbrk(name, "%;=|") && name[0] != '~' && !strchr(" &\\", name[length - 1]))
        return RESULT_OK;
    return error_set(err, RESULT_DATA,
                     "%s: make can't take this name in a rule: rename the file, or leave --depfile out", name);
}

static enum result add_name(struct buffer *rule, const char *name, struct error *err)
{
    enum result result = depfile_check_name(name, err);
    size_t backslashes = 0;
    for (const char *c = name; !result && *c; c++) {
        if (*c == '$')
            result = buffer_add_text(rule, "$", err);
        else if (strchr(" #:*?[", *c))
            for (size_t i = 0; !result && i < backslashes + 1; i++)
                result = buffer_add_text(rule, "\\", err);
        if (!result)
            result = buffer_add(rule, c, 1, err);
        backslashes = *c == '\\' ? backslashes + 1 : 0;
    }
    return result;
}

static enum result make_rules(const struct text_list *targets, const struct buffer *files, struct buffer *rules,
                              struct error *err)
{
    const char *end = files->data + files->size;
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < targets->count; i++) {
        result = i > 0 ? buffer_add_text(rules, " \\\n ", err) : RESULT_OK;
        if (!result)
            result = add_name(rules, targets->texts[i], err);
    }
    if (!result)
        result = buffer_add_text(rules, ":", err);
    for (const char *file = files->data; !result && file < end; file += strlen(file) + 1) {
        result = buffer_add_text(rules, file == files->data ? " " : " \\\n ", err);
        if (!result)
            result = add_name(rules, file, err);
    }
    if (!result)
        result = buffer_add_text(rules, "\n", err);
    for (const char *file = files->data + strlen(files->data) + 1; !result && file < end; file += strlen(file) + 1) {
        result = buffer_add_text(rules, "\n", err);
        if (!result)
            result = add_name(rules, file, err);
        if (!result)
            result = buffer_add_text(rules, ":\n", err);
    }
    return result;
}

enum result depfile_write(const char *path, const struct text_list *targets, const struct buffer *files,
                          struct error *err)
{
    struct buffer rules = {0};
    struct output_file file;
    enum result result = make_rules(targets, files, &rules, err);
    if (!result)
        result = output_file_open(&file, path, err);
    if (!result) {
        result = output_file_write(&file, rules.data, rules.size, err);
        if (!result)
            result = output_file_commit(&file, err);
        output_file_abort(&file);
    }
    buffer_free(&rules);
    return result;
}
