/* The log is read whole, each name is turned into the user's, and the list is sorted: passes that run at the same time
 * write their entries in any order. */
#include "reads.h"

#include "input_file.h"
#include "povray_switches.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum result reads_begin(const struct work_folder *folder, struct error *err)
{
    char program[4096], *object = NULL, *log = NULL;
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    char *slash = strrchr(program, '/');
    enum result result = text_printf(&object, err, "%.*s/../lib/povgloss_reads.so", slash ? (int)(slash - program) : 0,
                                     program);
    if (!result && access(object, R_OK))
        result = error_set(err, RESULT_DATA, "%s: isn't there, and --depfile needs it: build or install povgloss anew",
                           object);
    if (!result)
        result = work_folder_link(folder, "reads.so", object, err);
    if (!result)
        result = text_printf(&log, err, "%s/reads.log", folder->path);
    if (!result)
        result = file_write(log, &(struct buffer){0}, err);
    free(object);
    free(log);
    return result;
}

enum result reads_variable(char **variable, struct error *err)
{
    const char *old = getenv("LD_PRELOAD");
    return text_printf(variable, err, "LD_PRELOAD=../reads.so%s%s", old ? ":" : "", old ? old : "");
}

static bool is_below(const char *path, const char *directory)
{
    size_t length = strlen(directory);
    return !strncmp(path, directory, length) && (path[length] == '/' || (length && path[length - 1] == '/'));
}

/* An absolute path by the user's name of the innermost directory around it; NULL for a file of the system. */
static enum result user_path(const struct reads_places *places, const char *path, char **name, struct error *err)
{
    static const char *const system[] = {"/usr", "/etc", "/proc", "/sys"};
    int best = -1;
    for (int i = 0; i < places->count; i++)
        if (is_below(path, places->directories[i]) &&
            (best < 0 || strlen(places->directories[i]) > strlen(places->directories[best])))
            best = i;
    if (best >= 0) {
        const char *rest = path + strlen(places->directories[best]), *directory = places->names[best];
        rest += strspn(rest, "/");
        bool here = !strcmp(directory, "."), slash = here || directory[strlen(directory) - 1] == '/';
        return text_printf(name, err, "%s%s%s", here ? "" : directory, slash ? "" : "/", rest);
    }
    *name = NULL;
    for (size_t i = 0; i < sizeof system / sizeof *system; i++)
        if (is_below(path, system[i]))
            return RESULT_OK;
    return text_printf(name, err, "%s", path);
}

/* The user's name for a name that POV-Ray opened; NULL for a file of ours, of the system or of the pass. */
static enum result user_name(const struct reads_places *places, const char *opened, char **name, struct error *err)
{
    int index, length = 0;
    *name = NULL;
    if (opened[0] == '/')
        return user_path(places, opened, name, err);
    if (sscanf(opened, "../lib%d/%n", &index, &length) == 1 && length && index >= 0 && index < places->count) {
        char *path;
        enum result result = text_printf(&path, err, "%s/%s", places->directories[index], opened + length);
        if (!result)
            result = user_path(places, path, name, err);
        free(path);
        return result;
    }
    if (sscanf(opened, "../ini%d.in%n", &index, &length) == 1 && length && index >= 0 && index < places->switch_count)
        return text_printf(name, err, "%.*s", (int)povray_switch_ini(places->switches[index]), places->switches[index]);
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

/* Appends the names in `reads`, sorted and each once, but for those in `but`. */
static enum result add_sorted(const struct buffer *reads, const struct buffer *but, struct buffer *files,
                              struct error *err)
{
    size_t count = 0;
    for (size_t i = 0; i < reads->size; i++)
        count += !reads->data[i];
    const char **names = calloc(count + 1, sizeof *names), *next = reads->data;
    if (!names)
        return error_memory(err, (double)count * sizeof *names);
    for (size_t i = 0; i < count; i++, next += strlen(next) + 1)
        names[i] = next;
    qsort(names, count, sizeof *names, compare_names);
    enum result result = RESULT_OK;
    for (size_t i = 0; !result && i < count; i++)
        if ((i == 0 || strcmp(names[i], names[i - 1])) && !has_name(but, names[i]))
            result = buffer_add(files, names[i], strlen(names[i]) + 1, err);
    free(names);
    return result;
}

enum result reads_collect(const struct work_folder *folder, const struct reads_places *places, struct buffer *files,
                          struct error *err)
{
    const char *scene = places->scene->files[0].path;
    struct buffer reads = {0}, but = {0};
    struct input_file log = {0};
    char *path = NULL;
    bool noted = false;
    enum result result = text_printf(&path, err, "%s/reads.log", folder->path);
    if (!result)
        result = input_file_read(path, &log, err);
    const char *at = (const char *)log.data, *end = at + log.size;
    for (; !result && at < end; at += strlen(at) + 1) {
        char *name;
        noted |= !strcmp(at, "rpass.pov");
        result = user_name(places, at + 1, &name, err);
        if (!result && name)
            result = buffer_add(at[0] == 'r' ? &reads : &but, name, strlen(name) + 1, err);
        free(name);
    }
    if (!result && !noted)
        result = error_set(err, RESULT_DATA,
                           "%s: what POV-Ray reads can't be noted, and --depfile needs it: POV-Ray must be a program "
                           "to which LD_PRELOAD applies",
                           scene);
    if (!result)
        result = buffer_add(files, scene, strlen(scene) + 1, err);
    if (!result)
        result = buffer_add(&but, scene, strlen(scene) + 1, err);
    if (!result)
        result = add_sorted(&reads, &but, files, err);
    buffer_free(&reads);
    buffer_free(&but);
    input_file_free(&log);
    free(path);
    return result;
}
