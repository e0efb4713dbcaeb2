#include "gloss_choice.h"

#include <stdlib.h>
#include <string.h>

enum result gloss_choice_take(struct gloss_choice *choice, const char *text, struct error *err)
{
    if (!strcmp(text, "auto")) {
        choice->automatic = true;
        return RESULT_OK;
    }
    const char *equals = strchr(text, '=');
    char *end = NULL;
    double exponent = equals ? strtod(equals + 1, &end) : -1;
    if (!equals || equals == text || end == equals + 1 || *end || !(exponent >= 0))
        return error_set(err, RESULT_USAGE,
                         "--gloss %s: must be auto, all=P or NAME=P, P being a Phong exponent of 0 or more, or inf", text);
    if (!strncmp(text, "all=", 4)) {
        choice->all = true;
        choice->all_exponent = exponent;
        return RESULT_OK;
    }
    size_t size = ((size_t)choice->name_count + 1) * sizeof *choice->names;
    struct gloss_name *names = realloc(choice->names, size);
    if (!names)
        return error_memory(err, (double)size);
    choice->names = names;
    char *name = strndup(text, (size_t)(equals - text));
    if (!name)
        return error_memory(err, (double)(equals - text));
    names[choice->name_count++] = (struct gloss_name){.name = name, .exponent = exponent};
    return RESULT_OK;
}

void gloss_choice_free(struct gloss_choice *choice)
{
    for (int i = 0; i < choice->name_count; i++)
        free(choice->names[i].name);
    free(choice->names);
    *choice = (struct gloss_choice){0};
}
