/* The log is text; a line of another form ends it. */
#include "scene_discover.h"

#include "gbuffer.h"
#include "input_file.h"
#include "scene_tokens.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct scene_found *find_found(const struct scene *scene, const char *name)
{
    for (int i = 0; i < scene->found_count; i++)
        if (!strcmp(scene->found[i].name, name))
            return &scene->found[i];
    return NULL;
}

/* An entry of the log: `include F T NAME`, `write F T NAME` or `gamma F T VALUE`; F is a file and T a token of it. */
struct log_entry {
    char kind; /* its first letter */
    int file, line;
    char *value;
};

/* Reads what was included; `changes` says that it may not always have been the same. */
static enum result add_found(struct scene *scene, const struct log_entry *entry, bool changes, const char *folder,
                             const char *const *directories, int directory_count, struct error *err)
{
    const char *name = entry->value;
    struct scene_found *found = realloc(scene->found, ((size_t)scene->found_count + 1) * sizeof *found);
    if (!found)
        return error_memory(err, sizeof *found);
    scene->found = found;
    found += scene->found_count;
    *found = (struct scene_found){.name = strdup(name), .file = scene->file_count};
    if (!found->name)
        return error_memory(err, (double)strlen(name));
    scene->found_count++;
    char *path;
    enum result result = scene_find_file(name, &folder, 1, &path, err);
    bool written = !result && path && name[0] != '/';
    if (!result && !path)
        result = scene_find_file(name, directories, directory_count, &path, err);
    if (result)
        return result;
    if (!path)
        return error_set(err, RESULT_DATA,
                         "%s:%d: %s, which this #include names, isn't found: write the whole name of a file in the "
                         "scene's folder or in one of +L",
                         scene->files[entry->file].path, entry->line, name);
    result = scene_add_file(scene, path, directories, directory_count, &found->file, err);
    if (result || !written)
        return result;
    struct scene_file *file = &scene->files[found->file];
    file->written = true;
    strcpy(file->path, name);
    /* What was in it before is gone. */
    if (changes && memchr(file->source.data, '{', file->source.size))
        return error_set(err, RESULT_DATA,
                         "%s:%d: %s is written by the scene itself more than once, and may hold something else each "
                         "time that it is included: write several files",
                         scene->files[entry->file].path, entry->line, name);
    if (changes)
        scene->found[scene->found_count - 1].file = -1;
    return RESULT_OK;
}

/* Cuts the next entry off at *text, which it changes; false where there is none, or another line. */
static bool next_entry(const struct scene *scene, char **text, struct log_entry *entry)
{
    int token, length = 0;
    char *at = *text, *end = strchr(at, '\n');
    entry->kind = *at;
    if (!strchr("giw", *at) || sscanf(at, "%*s %d %d %n", &entry->file, &token, &length) != 2)
        return false;
    if (!end || !length || entry->file < 0 || entry->file >= scene->file_count || token < 0 ||
        token >= scene->files[entry->file].list.count)
        return false;
    *end = 0;
    *text = end + 1;
    entry->line = scene->files[entry->file].list.tokens[token].line;
    entry->value = at + length;
    return true;
}

/* The number of entries of a kind with this value. */
static int count_entries(const struct scene *scene, const struct input_file *log, char kind, const char *value)
{
    int count = 0;
    char *copy = strndup((const char *)log->data, log->size), *at = copy;
    struct log_entry entry;
    while (copy && next_entry(scene, &at, &entry))
        count += entry.kind == kind && !strcmp(entry.value, value);
    free(copy);
    return count;
}

static enum result take_entries(struct scene *scene, const struct input_file *log, const char *folder,
                                const char *const *directories, int directory_count, struct error *err)
{
    char *text = strndup((const char *)log->data, log->size), *at = text;
    if (!text)
        return error_memory(err, (double)log->size);
    enum result result = RESULT_OK;
    struct log_entry entry;
    bool settled = false;
    scene->working_gamma = scene_default_gamma(scene);
    while (!result && next_entry(scene, &at, &entry)) {
        if (entry.kind == 'g' && !settled) {
            settled = true;
            scene->working_gamma = strcmp(entry.value, "srgb") ? strtod(entry.value, NULL) : GBUFFER_GAMMA_SRGB;
        } else if (entry.kind == 'i' && !find_found(scene, entry.value)) {
            bool changes = count_entries(scene, log, 'i', entry.value) > 1 &&
                           count_entries(scene, log, 'w', entry.value) > 1;
            result = add_found(scene, &entry, changes, folder, directories, directory_count, err);
        }
    }
    free(text);
    return result;
}

enum result scene_discover(struct scene *scene, const char *folder, const char *const *directories,
                           int directory_count, bool *again, struct error *err)
{
    int files = scene->file_count, gammas = scene->gammas;
    char *path;
    struct input_file log = {0};
    enum result result = text_printf(&path, err, "%s/" SCENE_DISCOVERY_LOG, folder);
    if (!result)
        result = input_file_read(path, &log, err);
    if (!result)
        result = take_entries(scene, &log, folder, directories, directory_count, err);
    *again = scene->gammas > gammas;
    for (int i = files; i < scene->file_count; i++)
        *again |= scene_has_unknown_include(&scene->files[i]);
    input_file_free(&log);
    free(path);
    return result;
}
