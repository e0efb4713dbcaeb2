/* A search tree of the C library holds the words; what is declared is also a list, in the order of the declarations. */
#include "scene_names.h"

#include <search.h>
#include <stdlib.h>
#include <string.h>

static int compare(const void *first, const void *second)
{
    const struct scene_name *a = first, *b = second;
    if (a->length != b->length)
        return a->length < b->length ? -1 : 1;
    return memcmp(a->text, b->text, a->length);
}

static struct scene_name *find(const struct scene_names *names, const char *text, size_t length)
{
    const struct scene_name key = {.text = text, .length = length};
    struct scene_name *const *found = tfind(&key, &names->tree, compare);
    return found ? *found : NULL;
}

enum result scene_names_add(struct scene_names *names, const char *text, size_t length, struct scene_name **name,
                            struct error *err)
{
    *name = find(names, text, length);
    if (*name)
        return RESULT_OK;
    size_t size = sizeof **name + length + 1;
    struct scene_name *added = calloc(1, size);
    if (!added)
        return error_memory(err, (double)size);
    char *copy = memcpy(added + 1, text, length);
    *added = (struct scene_name){.text = copy, .length = length, .index = -1};
    if (!tsearch(added, &names->tree, compare)) {
        free(added);
        return error_memory(err, (double)size);
    }
    *name = added;
    return RESULT_OK;
}

const struct scene_name *scene_names_find(const struct scene_names *names, const char *text)
{
    return find(names, text, strlen(text));
}

void scene_names_note(struct scene_names *names, struct scene_name *name, enum name_fact fact)
{
    if (name->facts & fact)
        return;
    name->facts |= fact;
    names->facts++;
    if (fact != NAME_DECLARED)
        return;
    name->index = names->declared_count++;
    if (names->last)
        names->last->next = name;
    else
        names->declared = name;
    names->last = name;
}

void scene_names_free(struct scene_names *names)
{
    tdestroy(names->tree, free);
    *names = (struct scene_names){0};
}
