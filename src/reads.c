/* The log is read whole, each name is turned into the user's, and the list is sorted: passes that run at the same time
 * write their entries in any order. */
#include "reads.h"

#include "input_file.h"
#include "scene_rewrite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void reads_free(struct reads *reads)
{
    buffer_free(&reads->read);
    buffer_free(&reads->written);
}

enum result reads_begin(const struct work_folder *folder, struct error *err)
{
    char *path;
    enum result result = text_printf(&path, err, "%s/reads.log", folder->path);
    if (!result)
        result = file_write(path, &(struct buffer){0}, err);
    free(path);
    return result;
}

static bool is_below(const char *path, const char *directory)
{
    size_t length = strlen(directory);
    return !strncmp(path, directory, length) && (path[length] == '/' || (length && path[length - 1] == '/'));
}

static bool is_system(const char *path)
{
    static const char *const system[] = {"/usr", "/etc", "/proc", "/sys"};
    for (size_t i = 0; i < sizeof system / sizeof *system; i++)
        if (is_below(path, system[i]))
            return true;
    return false;
}

/* An absolute path by the user's name of the innermost directory around it; NULL for a file of the system. */
static enum result user_path(const struct reads_places *places, const char *path, char **name, struct error *err)
{
    char *const *directories = places->directories->texts;
    int best = -1;
    for (int i = 0; i < places->directories->count; i++)
        if (is_below(path, directories[i]) && (best < 0 || strlen(directories[i]) > strlen(directories[best])))
            best = i;
    if (best >= 0) {
        const char *rest = path + strlen(directories[best]), *directory = places->names->texts[best];
        rest += strspn(rest, "/");
        bool here = !strcmp(directory, "."), slash = here || directory[strlen(directory) - 1] == '/';
        return text_printf(name, err, "%s%s%s", here ? "" : directory, slash ? "" : "/", rest);
    }
    *name = NULL;
    return is_system(path) ? RESULT_OK : text_printf(name, err, "%s", path);
}

/* The user's name for a name that POV-Ray opened; NULL for a file of ours, of the system or of the pass. */
static enum result user_name(const struct reads_places *places, const char *opened, char **name, struct error *err)
{
    int index, length = 0;
    *name = NULL;
    if (opened[0] == '/')
        return user_path(places, opened, name, err);
    if (sscanf(opened, "../lib%d/%n", &index, &length) == 1 && length && index >= 0 && index < places->directories->count) {
        char *path;
        enum result result = text_printf(&path, err, "%s/%s", places->directories->texts[index], opened + length);
        if (!result)
            result = user_path(places, path, name, err);
        free(path);
        return result;
    }
    if (strncmp(opened, "../copies/", strlen("../copies/")))
        return RESULT_OK;
    int file = scene_file_of_copy(places->scene, opened + strlen("../copies/"));
    if (file < 0 || places->scene->files[file].written)
        return RESULT_OK;
    if (file == 0)
        return text_printf(name, err, "%s", places->scene->files[0].path);
    return user_path(places, places->scene->files[file].path, name, err);
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool has_name(const struct buffer *names, const char *name)
{
    const char *at = names->data, *end = at + names->size;
    for (; at < end; at += strlen(at) + 1)
        if (!strcmp(at, name))
            return true;
    return false;
}

static enum result add_once(struct buffer *names, const char *name, struct error *err)
{
    return has_name(names, name) ? RESULT_OK : buffer_add(names, name, strlen(name) + 1, err);
}

enum result reads_collect(const struct work_folder *folder, const struct reads_places *places, struct reads *reads,
                          struct error *err)
{
    struct input_file log = {0};
    char *path = NULL;
    bool noted = false;
    enum result result = text_printf(&path, err, "%s/reads.log", folder->path);
    if (!result)
        result = input_file_read(path, &log, err);
    const char *at = (const char *)log.data, *end = at + log.size;
    for (; !result && at < end; at += strlen(at) + 1) {
        char *name;
        noted |= !strcmp(at, "rpass.inc");
        result = user_name(places, at + 1, &name, err);
        if (!result && name)
            result = add_once(at[0] == 'r' ? &reads->read : &reads->written, name, err);
        free(name);
    }
    if (!result && !noted)
        result = error_set(err, RESULT_DATA,
                           "%s: what POV-Ray reads can't be noted, and --depfile needs it: POV-Ray must be a program "
                           "to which LD_PRELOAD applies",
                           places->scene->files[0].path);
    input_file_free(&log);
    free(path);
    return result ? result : reads_begin(folder, err);
}

enum result reads_list(const struct reads *reads, const char *scene, const struct text_list *ini_files,
                       struct buffer *files, struct error *err)
{
    size_t count = 0;
    for (size_t i = 0; i < reads->read.size; i++)
        count += !reads->read.data[i];
    const char **names = calloc(count + (size_t)ini_files->count + 1, sizeof *names), *next = reads->read.data;
    if (!names)
        return error_memory(err, (double)count * sizeof *names);
    for (size_t i = 0; i < count; i++, next += strlen(next) + 1)
        names[i] = next;
    for (int i = 0; i < ini_files->count; i++)
        if (!is_system(ini_files->texts[i]))
            names[count++] = ini_files->texts[i];
    qsort(names, count, sizeof *names, compare_names);
    enum result result = add_once(files, scene, err);
    for (size_t i = 0; !result && i < count; i++)
        if (!has_name(&reads->written, names[i]))
            result = add_once(files, names[i], err);
    free(names);
    return result;
}
