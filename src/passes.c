/* The way from a scene to a gbuffer: find its files, write the passes' scenes, run POV-Ray on all of them at the same time,
 * and read the images. The passes themselves stand in pass_scene.c, their decoding in pass_images.c.
 */
#include "passes.h"

#include "input_file.h"
#include "pass_images.h"
#include "pass_scene.h"
#include "povray_switches.h"
#include "reads.h"
#include "work_folder.h"

#include <assert.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Everything about one run. */
struct run {
    const struct passes_options *options;
    struct scene scene;
    struct work_folder folder;
    char **directories; /* where includes are looked for, absolute; those up to linked_count have links lib0, lib1, ... */
    char **directory_names; /* the same as the user wrote them */
    int directory_count, linked_count;
    char **environment; /* of POV-Ray: the strings are those of environ, and `variables` */
    char *variables[2];
    struct povray_job jobs[PASS_COUNT];
    enum pass_id ids[PASS_COUNT];
    int job_count;
};

/* Makes the folder and writes the scene in it that POV-Ray reads. */
static enum result write_wrapper(const struct run *run, const char *folder, const struct buffer *text,
                                 struct error *err)
{
    char *path = NULL;
    enum result result = work_folder_add(&run->folder, folder, err);
    if (!result)
        result = text_printf(&path, err, "%s/%s/pass.pov", run->folder.path, folder);
    if (!result)
        result = file_write(path, text, err);
    free(path);
    return result;
}

static enum result write_copy(const struct run *run, enum scene_copy copy, struct error *err)
{
    char *copies = NULL;
    enum result result = text_printf(&copies, err, "%s/copies", run->folder.path);
    if (!result)
        result = scene_write_copy(&run->scene, copy, copies, err);
    free(copies);
    return result;
}

static enum result write_scenes(struct run *run, struct error *err)
{
    bool needed[SCENE_COPY_COUNT] = {false}, several = run->scene.exponent < 0;
    enum result result = RESULT_OK;
    for (int id = 0; !result && id < PASS_COUNT; id++) {
        if ((id == PASS_EXPONENT && !several) || (id != PASS_BASE && !run->scene.glossy))
            continue;
        run->ids[run->job_count++] = (enum pass_id)id;
        pass_copies(&run->scene, (enum pass_id)id, needed);
        struct buffer text = {0};
        result = pass_scene_text(&run->scene, (enum pass_id)id, &text, err);
        if (!result)
            result = write_wrapper(run, pass_table[id].name, &text, err);
        buffer_free(&text);
    }
    for (int copy = 0; !result && copy < SCENE_COPY_COUNT; copy++)
        if (needed[copy])
            result = write_copy(run, (enum scene_copy)copy, err);
    return result;
}

/* ---- where POV-Ray looks for files ---- */

static enum result add_directory(struct run *run, const char *path, struct error *err)
{
    char *absolute = realpath(path, NULL);
    if (!absolute)
        return RESULT_OK; /* POV-Ray too passes over a folder that isn't there */
    size_t size = ((size_t)run->directory_count + 1) * sizeof(char *);
    char *name = strdup(path);
    char **directories = realloc(run->directories, size);
    run->directories = directories ? directories : run->directories;
    char **names = realloc(run->directory_names, size);
    run->directory_names = names ? names : run->directory_names;
    if (!name || !directories || !names) {
        free(absolute);
        free(name);
        return error_memory(err, (double)size);
    }
    directories[run->directory_count] = absolute;
    names[run->directory_count++] = name;
    return RESULT_OK;
}

/* The Library_Path lines of one .ini file; a file that can't be read has none. */
static enum result add_ini_directories(struct run *run, const char *ini, struct error *err)
{
    FILE *file = fopen(ini, "r");
    char line[4096];
    enum result result = RESULT_OK;
    while (file && !result && fgets(line, sizeof line, file)) {
        char path[4096];
        const char *start = line + strspn(line, " \t");
        if (!strncasecmp(start, "Library_Path", 12) &&
            (sscanf(start + 12, " = \"%4095[^\"]", path) == 1 || sscanf(start + 12, " = %4095[^\r\n]", path) == 1))
            result = add_directory(run, path, err);
    }
    if (file)
        fclose(file);
    return result;
}

/* The .ini file that POV-Ray reads before its command line: the first that exists of $POVINI, ./povray.ini,
 * ~/.povray/3.7/povray.ini and /etc/povray/3.7/povray.ini. The caller frees *path. */
static enum result find_ini(char **path, struct error *err)
{
    const char *variable = getenv("POVINI"), *home = getenv("HOME");
    char *candidates[4] = {0};
    enum result result = variable && *variable ? text_printf(&candidates[0], err, "%s", variable) : RESULT_OK;
    if (!result)
        result = text_printf(&candidates[1], err, "povray.ini");
    if (!result)
        result = text_printf(&candidates[2], err, "%s/.povray/3.7/povray.ini", home ? home : "");
    if (!result)
        result = text_printf(&candidates[3], err, "/etc/povray/3.7/povray.ini");
    *path = NULL;
    for (int i = 0; i < 4; i++) {
        if (!result && !*path && candidates[i] && access(candidates[i], R_OK) == 0)
            *path = realpath(candidates[i], NULL);
        free(candidates[i]);
    }
    return result;
}

/* POV-Ray looks in its folder, in those of +L, and in those of its .ini file; the scene's own folder comes last of +L. */
static enum result find_directories(struct run *run, const char *ini, struct error *err)
{
    const struct passes_options *options = run->options;
    enum result result = add_directory(run, ".", err);
    for (int i = 0; !result && i < options->library_count; i++)
        result = add_directory(run, options->libraries[i], err);
    char *scene_folder = strdup(options->scene);
    if (!scene_folder)
        return error_memory(err, (double)strlen(options->scene));
    char *slash = strrchr(scene_folder, '/');
    if (slash)
        slash[slash == scene_folder] = 0;
    if (!result)
        result = add_directory(run, slash ? scene_folder : ".", err);
    free(scene_folder);
    run->linked_count = run->directory_count;
    return result || !ini ? result : add_ini_directories(run, ini, err);
}

static enum result link_directories(const struct run *run, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < run->linked_count; i++) {
        char name[32];
        snprintf(name, sizeof name, "lib%d", i);
        result = work_folder_link(&run->folder, name, run->directories[i], err);
    }
    return result;
}

static void free_directories(struct run *run)
{
    for (int i = 0; i < run->directory_count; i++) {
        free(run->directories[i]);
        free(run->directory_names[i]);
    }
    free(run->directories);
    free(run->directory_names);
}

static enum result load_scene(struct run *run, const char *ini, struct error *err)
{
    enum result result = find_directories(run, ini, err);
    return result ? result
                  : scene_load(&run->scene, run->options->scene, &run->options->gloss,
                               (const char *const *)run->directories, run->directory_count, err);
}

enum result passes_load_scene(const struct passes_options *options, struct scene *scene, struct error *err)
{
    struct run run = {.options = options};
    char *ini = NULL;
    enum result result = find_ini(&ini, err);
    if (!result)
        result = load_scene(&run, ini, err);
    *scene = run.scene;
    free_directories(&run);
    free(ini);
    return result;
}

/* ---- running ---- */

static enum result add_argument(char ***arguments, int *count, struct error *err, const char *format, const char *value)
{
    char **grown = realloc(*arguments, ((size_t)*count + 2) * sizeof *grown);
    if (!grown)
        return error_memory(err, sizeof *grown);
    *arguments = grown;
    grown[*count + 1] = NULL;
    enum result result = text_printf(&grown[*count], err, format, value);
    *count += !result;
    return result;
}

/* The user's .ini files are reached through links, since POV-Ray's command line can't take every path. */
static enum result add_switch(const struct run *run, char ***arguments, int *count, int index, struct error *err)
{
    const char *text = run->options->switches[index];
    size_t ini = povray_switch_ini(text);
    if (!ini)
        return add_argument(arguments, count, err, "%s", text);
    char *link;
    enum result result = text_printf(&link, err, "../ini%d.ini%s", index, text + ini);
    if (!result)
        result = add_argument(arguments, count, err, "%s", link);
    free(link);
    return result;
}

static enum result link_ini_files(const struct run *run, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < run->options->switch_count; i++) {
        const char *text = run->options->switches[i];
        size_t ini = povray_switch_ini(text);
        if (!ini)
            continue;
        char *path = strndup(text, ini), *absolute = path ? realpath(path, NULL) : NULL, name[64];
        snprintf(name, sizeof name, "ini%d.ini", i);
        result = absolute ? work_folder_link(&run->folder, name, absolute, err)
                          : error_set(err, RESULT_DATA, "%s: can't be read: %s", text, strerror(errno));
        free(path);
        free(absolute);
    }
    return result;
}

/* The program, the user's switches, where files are looked for, and the scene. */
static enum result scene_arguments(const struct run *run, char ***arguments, int *count, struct error *err)
{
    const struct passes_options *options = run->options;
    /* POV-Ray runs in a folder of its own. */
    char *program = strchr(options->povray, '/') ? realpath(options->povray, NULL) : NULL;
    enum result result = add_argument(arguments, count, err, "%s", program ? program : options->povray);
    free(program);
    for (int i = 0; !result && i < options->switch_count; i++)
        result = add_switch(run, arguments, count, i, err);
    if (!result)
        result = add_argument(arguments, count, err, "%s", "+L../copies");
    for (int i = 0; !result && i < run->linked_count; i++) {
        char name[32];
        snprintf(name, sizeof name, "lib%d", i);
        result = add_argument(arguments, count, err, "+L../%s", name);
    }
    static const char *const always[] = {"+Ipass.pov", "-D", "-P", "-C", "-UA", "+GA", "+V", NULL};
    for (int i = 0; !result && always[i]; i++)
        result = add_argument(arguments, count, err, "%s", always[i]);
    return result;
}

/* The user's switches first, then those on which the pass depends: POV-Ray takes the last one. */
static enum result job_arguments(const struct run *run, enum pass_id id, char ***arguments, struct error *err)
{
    const struct passes_options *options = run->options;
    const struct pass *pass = &pass_table[id];
    int count = 0;
    enum result result = scene_arguments(run, arguments, &count, err);
    static const char *const codes[] = {"+Oimage.png", "+FN16", "File_Gamma=1.0", "Dither=off", NULL};
    static const char *const radiance[] = {"+Oimage.exr", "+FE", NULL};
    const char *const *format = pass->codes ? codes : radiance;
    for (int i = 0; !result && format[i]; i++)
        result = add_argument(arguments, &count, err, "%s", format[i]);
    if (!result && !pass->full_size)
        result = add_argument(arguments, &count, err, "%s", "-A");
    /* Reflectivities are small, and their edges show as much as those of the picture. */
    if (!result && id == PASS_REFLECTANCE && options->antialias)
        result = add_argument(arguments, &count, err, "%s", "+A0.01");
    if (!result && pass->technical)
        result = add_argument(arguments, &count, err, "%s", "+Q8");
    if (!result && options->subsample > 1 && !pass->full_size) {
        char size[32];
        snprintf(size, sizeof size, "%d", options->width / options->subsample);
        result = add_argument(arguments, &count, err, "+W%s", size);
        snprintf(size, sizeof size, "%d", options->height / options->subsample);
        if (!result)
            result = add_argument(arguments, &count, err, "+H%s", size);
    }
    return result;
}

/* POV-Ray's messages with the names of the user's files in place of the copies'. */
static enum result report_failure(const struct run *run, const struct povray_job *job, struct error *err)
{
    struct buffer text = {0}, translated = {0};
    struct error ignored = {0};
    enum result result = povray_error_text(&job->messages, &text, &ignored);
    const char *at = text.data ? text.data : "";
    while (!result && *at) {
        const char *name = strstr(at, "File '");
        if (!name) {
            result = buffer_add_text(&translated, at, &ignored);
            break;
        }
        name += strlen("File '");
        const char *end = strchr(name, '\'');
        char copy[1024];
        snprintf(copy, sizeof copy, "%.*s", end ? (int)(end - name) : 0, name);
        const char *slash = strrchr(copy, '/');
        int file = scene_file_of_copy(&run->scene, slash ? slash + 1 : copy);
        result = buffer_add(&translated, at, (size_t)(name - at), &ignored);
        bool wrapper = !strcmp(copy, "pass.pov");
        const char *path = file >= 0 ? run->scene.files[file].path : wrapper ? run->options->scene : copy;
        if (!result)
            result = buffer_add_text(&translated, path, &ignored);
        at = end ? end : name + strlen(name);
        /* The wrapper's own lines mean nothing to the user: what is found there was left open by the scene. */
        size_t line = wrapper && end ? strspn(end + 1, " line0123456789") : 0;
        if (line && !result) {
            result = buffer_add_text(&translated, "' at its end", &ignored);
            at = end + 1 + line;
        }
    }
    if (!result && translated.size) {
        ignored = *err;
        error_set(err, RESULT_POVRAY, "%s: %s\n%s", run->options->scene, ignored.text, translated.data);
    }
    buffer_free(&text);
    buffer_free(&translated);
    return RESULT_POVRAY;
}

/* The environment with POVINI set to the .ini file that holds where povgloss was started (NULL: none), and LD_PRELOAD
 * where what is read is to be noted. */
static enum result make_environment(struct run *run, const char *ini, struct error *err)
{
    bool reads = run->options->reads;
    int count = 0, kept = 0;
    while (environ[count])
        count++;
    run->environment = calloc((size_t)count + 3, sizeof *run->environment);
    if (!run->environment)
        return error_memory(err, (double)count * sizeof *run->environment);
    for (int i = 0; i < count; i++)
        if (strncmp(environ[i], "POVINI=", 7) && !(reads && !strncmp(environ[i], "LD_PRELOAD=", 11)))
            run->environment[kept++] = environ[i];
    enum result result = ini ? text_printf(&run->variables[0], err, "POVINI=%s", ini) : RESULT_OK;
    if (!result && reads)
        result = reads_variable(&run->variables[1], err);
    for (int i = 0; i < 2; i++)
        if (run->variables[i])
            run->environment[kept++] = run->variables[i];
    return result;
}

static enum result prepare_environment(struct run *run, const char *ini, struct error *err)
{
    enum result result = link_ini_files(run, err);
    if (!result && run->options->reads)
        result = reads_begin(&run->folder, err);
    return result ? result : make_environment(run, ini, err);
}

static void free_arguments(char **arguments)
{
    for (char **argument = arguments; argument && *argument; argument++)
        free(*argument);
    free(arguments);
}

static void no_progress(void *context, double done)
{
    (void)context;
    (void)done;
}

/* POV-Ray parses the scene and is stopped by the wrapper before it draws: that is a success if the log has its last
 * line. */
static enum result run_discovery(struct run *run, const char *name, const char *folder, struct error *err)
{
    char **arguments = NULL, *path = NULL;
    int count = 0, failed = -1;
    struct input_file log = {0};
    struct error ignored;
    enum result result = scene_arguments(run, &arguments, &count, err);
    struct povray_job job = {.name = name, .folder = folder, .arguments = arguments};
    if (!result)
        result = text_printf(&path, err, "%s/" SCENE_DISCOVERY_LOG, folder);
    if (!result)
        result = povray_run(&job, 1, 1, run->environment, no_progress, NULL, &failed, err);
    if (failed >= 0 && !input_file_read(path, &log, &ignored) && log.size >= 4 &&
        !memcmp(log.data + log.size - 4, "end\n", 4))
        result = RESULT_OK;
    else if (failed >= 0)
        result = report_failure(run, &job, err);
    input_file_free(&log);
    povray_jobs_free(&job, 1);
    free_arguments(arguments);
    free(path);
    return result;
}

/* Finds the files that only POV-Ray knows; what is included by a new file is found in a further run. */
static enum result discover(struct run *run, struct error *err)
{
    bool again = run->scene.needs_discovery;
    enum result result = RESULT_OK;
    for (int round = 1; !result && again; round++) {
        char name[32], *folder = NULL;
        struct buffer text = {0};
        snprintf(name, sizeof name, "discovery%d", round);
        result = text_printf(&folder, err, "%s/%s", run->folder.path, name);
        if (!result)
            result = pass_discovery_text(&run->scene, &text, err);
        if (!result)
            result = write_wrapper(run, name, &text, err);
        if (!result)
            result = write_copy(run, SCENE_COPY_DISCOVERY, err);
        if (!result)
            result = run_discovery(run, name, folder, err);
        if (!result)
            result = scene_discover(&run->scene, folder, (const char *const *)run->directories,
                                    run->directory_count, &again, err);
        buffer_free(&text);
        free(folder);
    }
    return result;
}

static enum result run_passes(struct run *run, struct error *err)
{
    const struct passes_options *options = run->options;
    char **arguments[PASS_COUNT] = {0}, *folders[PASS_COUNT] = {0};
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < run->job_count; i++) {
        result = job_arguments(run, run->ids[i], &arguments[i], err);
        if (!result)
            result = text_printf(&folders[i], err, "%s/%s", run->folder.path, pass_table[run->ids[i]].name);
        run->jobs[i] = (struct povray_job){
            .name = pass_table[run->ids[i]].name, .folder = folders[i], .arguments = arguments[i]};
    }
    int failed = -1, at_once = options->jobs > 0 ? options->jobs : (int)sysconf(_SC_NPROCESSORS_ONLN) + 2;
    if (!result)
        result = povray_run(run->jobs, run->job_count, at_once, run->environment, options->progress,
                            options->progress_context, &failed, err);
    if (failed >= 0)
        result = report_failure(run, &run->jobs[failed], err);
    for (int i = 0; i < run->job_count; i++) {
        free_arguments(arguments[i]);
        free(folders[i]);
    }
    return result;
}

static enum result collect_reads(const struct run *run, struct error *err)
{
    const struct passes_options *options = run->options;
    struct reads_places places = {.scene = &run->scene,
                                  .directories = (const char *const *)run->directories,
                                  .names = (const char *const *)run->directory_names,
                                  .count = run->linked_count,
                                  .switches = options->switches,
                                  .switch_count = options->switch_count};
    return reads_collect(&run->folder, &places, options->reads, err);
}

static enum result check_scene(const struct run *run, struct error *note, struct error *err)
{
    const struct scene *scene = &run->scene;
    bool chosen = scene->choice->automatic || scene->choice->all;
    if (!scene->glossy && !chosen)
        return error_set(err, RESULT_DATA,
                         "%s: nothing in this scene is glossy: write #include \"povgloss.inc\", and Gloss(300) in a finish "
                         "that has a reflection, or choose finishes with --gloss",
                         run->options->scene);
    if (!scene->glossy)
        error_set(note, RESULT_OK, "%s: no finish is glossy with this --gloss: the picture is POV-Ray's own",
                  run->options->scene);
    if (scene->atmosphere)
        error_set(note, RESULT_OK,
                  "%s: the scene's %s between the eye and a glossy surface is also seen in its reflection; the picture "
                  "there is too bright by its share",
                  run->options->scene, scene->atmosphere);
    return RESULT_OK;
}

enum result passes_render(const struct passes_options *options, struct gbuffer *gbuffer, struct error *note,
                          struct error *err)
{
    assert(options->subsample >= 1 && (options->subsample == 1 || (options->width > 0 && options->height > 0)));
    struct run run = {.options = options};
    char *ini = NULL;
    *gbuffer = (struct gbuffer){0};
    note->text[0] = 0;
    enum result result = find_ini(&ini, err);
    if (!result)
        result = work_folder_make(&run.folder, options->keep, err);
    if (!result)
        result = load_scene(&run, ini, err);
    if (!result)
        result = link_directories(&run, err);
    if (!result)
        result = work_folder_add(&run.folder, "copies", err);
    if (!result)
        result = prepare_environment(&run, ini, err);
    if (!result)
        result = discover(&run, err);
    if (!result)
        result = check_scene(&run, note, err);
    if (!result)
        result = write_scenes(&run, err);
    if (!result)
        result = run_passes(&run, err);
    if (!result && options->reads)
        result = collect_reads(&run, err);
    if (!result) {
        struct pass_images images = {
            .folder = run.folder.path, .name = options->scene, .scene = &run.scene, .subsample = options->subsample};
        result = pass_images_read(&images, gbuffer, note, err);
    }
    if (result)
        gbuffer_free(gbuffer);
    povray_jobs_free(run.jobs, run.job_count);
    scene_free(&run.scene);
    free_directories(&run);
    free(run.environment);
    free(run.variables[0]);
    free(run.variables[1]);
    free(ini);
    work_folder_remove(&run.folder);
    return result;
}
