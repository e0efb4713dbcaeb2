/* The way from a scene to a gbuffer: find its files (with a run of POV-Ray where only it knows them), write the passes'
 * scenes, run POV-Ray on all of them at the same time, and read the images. The passes themselves stand in
 * pass_scene.c, their decoding in pass_images.c.
 */
#include "passes.h"

#include "compose.h"
#include "input_file.h"
#include "own_files.h"
#include "pass_images.h"
#include "picture_check.h"
#include "preload.h"
#include "reads.h"
#include "sandbox.h"
#include "scene_discover.h"
#include "work_folder.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define EMPTY_INI "empty.ini"

enum { POVRAY_BLOCK = 32 }; /* pixels a side of what POV-Ray renders at a time */

struct passes {
    const struct passes_options *options;
    struct scene scene;
    struct work_folder folder;
    int frame;                        /* for which the scene was read */
    struct text_list directories;     /* where includes are looked for, absolute; they have links lib0, lib1, ... */
    struct text_list directory_names; /* the same as the user wrote them */
    struct text_list command;         /* the sandbox, if there is one, and the program */
    char **environment;               /* of POV-Ray: the strings are those of environ, a constant and `preload` */
    char *preload;
    struct reads reads;
    int discoveries;
    char version[POVRAY_VERSION_SIZE]; /* of a POV-Ray that isn't 3.7; told is whether the user knows */
    bool version_told;
    bool has_folder[PASS_COUNT];
    bool margin;          /* is wanted; of the frame that is rendered: */
    bool has_view;        /* whether the camera's rays are known, */
    struct camera view;
    bool has_camera;      /* and its place, too */
    struct camera camera;
    int margin_x, margin_y; /* pixels on each side of the picture */
    struct povray_job jobs[PASS_COUNT];
    enum pass_id ids[PASS_COUNT];
    int job_count;
    bool ending;          /* the jobs' processes may not all have ended */
};

/* Writes the scene that POV-Ray reads in a folder. For each call of its macros in an included file POV-Ray looks for it
 * again, and in all folders first for a name with .inc at its end. */
static enum result write_wrapper(const struct passes *passes, const char *folder, const struct buffer *text,
                                 struct error *err)
{
    char *path;
    enum result result = text_printf(&path, err, "%s/%s/pass.inc", passes->folder.path, folder);
    if (!result)
        result = file_write(path, text, err);
    free(path);
    return result;
}

static enum result write_copy(const struct passes *passes, enum scene_copy copy, struct error *err)
{
    char *copies;
    enum result result = text_printf(&copies, err, "%s/copies", passes->folder.path);
    if (!result)
        result = scene_write_copy(&passes->scene, copy, copies, err);
    free(copies);
    return result;
}

static enum result write_empty_ini(const struct passes *passes, struct error *err)
{
    const struct buffer empty = {0};
    char *path;
    enum result result = text_printf(&path, err, "%s/" EMPTY_INI, passes->folder.path);
    if (!result)
        result = file_write(path, &empty, err);
    free(path);
    return result;
}

static enum result write_pass(struct passes *passes, enum pass_id id, struct error *err)
{
    struct buffer text = {0};
    enum result result = RESULT_OK;
    if (!passes->has_folder[id])
        result = work_folder_add(&passes->folder, pass_table[id].name, err);
    passes->has_folder[id] = true;
    if (!result)
        result = pass_scene_text(&passes->scene, id, &text, err);
    if (!result && passes->margin && pass_table[id].margin)
        result = buffer_add_text(&text, "#include \"" PASS_MARGIN_CAMERA "\"\n", err);
    if (!result)
        result = write_wrapper(passes, pass_table[id].name, &text, err);
    buffer_free(&text);
    return result;
}

/* What is only a part of POV-Ray's picture has nothing to be compared with. */
static bool is_checked(const struct passes *passes)
{
    return passes->options->check && !passes->options->switches->partial;
}

/* Whether the camera's rays may be found in a small picture. */
static bool seeks_view(const struct passes *passes)
{
    const struct passes_options *options = passes->options;
    return !options->rays && !options->switches->partial && !passes->scene.depends_on_size;
}

static bool has_means(const struct passes *passes)
{
    const struct passes_options *options = passes->options;
    return options->means && options->switches->antialias && options->subsample == 1 &&
           pass_of(&passes->scene, PASS_SPECULAR).marked;
}

static enum result write_scenes(struct passes *passes, struct error *err)
{
    bool needed[SCENE_COPY_COUNT] = {false};
    enum result result = RESULT_OK;
    const struct passes_options *options = passes->options;
    passes->margin = (options->margin > 0 || options->margin_px > 0) && passes->scene.glossy &&
                     !options->switches->partial && !passes->scene.depends_on_size && !passes->scene.focal_blur;
    passes->job_count = 0;
    for (int id = 0; !result && id < PASS_COUNT; id++) {
        bool asked = (passes->options->rays && passes->scene.glossy && pass_is_mirror((enum pass_id)id)) ||
                     (passes->margin && pass_is_place((enum pass_id)id));
        bool unasked = (id == PASS_OWN && !is_checked(passes)) || (id == PASS_VIEW && !seeks_view(passes));
        if (unasked || (!asked && !pass_needed(&passes->scene, (enum pass_id)id)))
            continue;
        passes->ids[passes->job_count++] = (enum pass_id)id;
        pass_copies(&passes->scene, (enum pass_id)id, needed);
        result = write_pass(passes, (enum pass_id)id, err);
    }
    for (int copy = 0; !result && copy < SCENE_COPY_COUNT; copy++)
        if (needed[copy])
            result = write_copy(passes, (enum scene_copy)copy, err);
    return result;
}

/* ---- where POV-Ray looks for files ---- */

static enum result add_directory(struct passes *passes, const char *path, struct error *err)
{
    char *absolute = realpath(path, NULL);
    if (!absolute && errno == ENOMEM)
        return error_memory(err, 0);
    /* POV-Ray too passes over a folder that isn't there. */
    enum result result = absolute ? text_list_add(&passes->directories, err, "%s", absolute) : RESULT_OK;
    if (!result && absolute)
        result = text_list_add(&passes->directory_names, err, "%s", path);
    free(absolute);
    return result;
}

/* The folder of povgloss.inc, for a scene that has no copy of it. */
static enum result add_own_directory(struct passes *passes, struct error *err)
{
    char *folder;
    struct error ignored;
    enum result result = RESULT_OK;
    if (!own_file("share/povgloss/include", &folder, &ignored)) {
        result = add_directory(passes, folder, err);
        free(folder);
    }
    return result;
}

/* POV-Ray looks in its folder, in those of its .ini file and in those of +L; then come the scene's own folder and ours.
 * They are reached through links, since POV-Ray's command line can't take every path. */
static enum result find_directories(struct passes *passes, struct error *err)
{
    const struct passes_options *options = passes->options;
    enum result result = add_directory(passes, ".", err);
    for (int i = 0; !result && i < options->switches->libraries.count; i++)
        result = add_directory(passes, options->switches->libraries.texts[i], err);
    char *scene_folder = strdup(options->scene);
    if (!scene_folder)
        return error_memory(err, (double)strlen(options->scene));
    char *slash = strrchr(scene_folder, '/');
    if (slash)
        slash[slash == scene_folder] = 0;
    if (!result)
        result = add_directory(passes, slash ? scene_folder : ".", err);
    free(scene_folder);
    return result ? result : add_own_directory(passes, err);
}

static enum result link_directories(const struct passes *passes, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < passes->directories.count; i++) {
        char name[32];
        snprintf(name, sizeof name, "lib%d", i);
        result = work_folder_link(&passes->folder, name, passes->directories.texts[i], err);
    }
    return result;
}

static enum result load_scene(struct passes *passes, struct error *err)
{
    return scene_load(&passes->scene, passes->options->scene, &passes->options->gloss,
                      (const char *const *)passes->directories.texts, passes->directories.count, err);
}

static void free_scene(struct passes *passes)
{
    scene_free(&passes->scene);
    text_list_free(&passes->directories);
    text_list_free(&passes->directory_names);
}

enum result passes_load_scene(const struct passes_options *options, struct scene *scene, struct error *err)
{
    struct passes passes = {.options = options};
    enum result result = find_directories(&passes, err);
    if (!result)
        result = load_scene(&passes, err);
    *scene = passes.scene;
    passes.scene = (struct scene){0};
    free_scene(&passes);
    return result;
}

/* ---- running ---- */

/* POV-Ray's sandbox and program; it runs in a folder of its own. */
static enum result find_command(struct passes *passes, struct error *err)
{
    const char *name = passes->options->povray;
    char *program = NULL, *object = NULL;
    enum result result = RESULT_OK;
    if (strchr(name, '/') || passes->options->sandbox)
        result = program_find(name, &program, err);
    if (!result && passes->options->sandbox && !program)
        result = povray_missing(name, err);
    if (!result && passes->options->sandbox && passes->preload)
        result = text_printf(&object, err, "%s/" PRELOAD_LINK, passes->folder.path);
    if (!result && passes->options->sandbox)
        result = sandbox_begin(passes->folder.path, &passes->directories, (const char *const[]){program, object}, 2,
                               &passes->command, err);
    if (!result)
        result = text_list_add(&passes->command, err, "%s", program ? program : name);
    free(program);
    free(object);
    return result;
}

/* The program, the user's switches, where files are looked for, the scene and its frame. */
static enum result scene_arguments(const struct passes *passes, int frame, struct text_list *arguments,
                                   struct error *err)
{
    const struct passes_options *options = passes->options;
    const struct povray_switches *switches = options->switches;
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < passes->command.count; i++)
        result = text_list_add(arguments, err, "%s", passes->command.texts[i]);
    for (int i = 0; !result && i < switches->passed.count; i++)
        result = text_list_add(arguments, err, "%s", switches->passed.texts[i]);
    if (!result)
        result = text_list_add(arguments, err, "+L../copies");
    for (int i = 0; !result && i < passes->directories.count; i++)
        result = text_list_add(arguments, err, "+L../lib%d", i);
    static const char *const always[] = {"+Ipass.inc", "-D", "-P", "-C", "-UA", "+GA", "+V", NULL};
    for (int i = 0; !result && always[i]; i++)
        result = text_list_add(arguments, err, "%s", always[i]);
    if (!result && options->frames.digits > 0)
        result = text_list_add(arguments, err, "Subset_Start_Frame=%d", frame);
    if (!result && options->frames.digits > 0)
        result = text_list_add(arguments, err, "Subset_End_Frame=%d", frame);
    return result;
}

static enum result add_size(struct text_list *arguments, int width, int height, struct error *err)
{
    enum result result = text_list_add(arguments, err, "+W%d", width);
    return result ? result : text_list_add(arguments, err, "+H%d", height);
}

static void picture_size(const struct passes *passes, int *width, int *height)
{
    enum { POVRAY_WIDTH = 160, POVRAY_HEIGHT = 120 }; /* where nothing is said */
    const struct povray_switches *switches = passes->options->switches;
    *width = switches->width ? switches->width : POVRAY_WIDTH;
    *height = switches->height ? switches->height : POVRAY_HEIGHT;
}

/* A few thousand rays and positions tell the camera; the proportion, on which it may depend, is that of the picture. */
static enum result add_few_pixels(const struct passes *passes, struct text_list *arguments, struct error *err)
{
    enum { LEAST_SIDE = 32 };
    int width, height, divisor = 1;
    picture_size(passes, &width, &height);
    for (int i = 2; i * LEAST_SIDE <= width && i * LEAST_SIDE <= height; i++)
        if (width % i == 0 && height % i == 0)
            divisor = i;
    return add_size(arguments, width / divisor, height / divisor, err);
}

/* POV-Ray's own picture is small, unless the scene isn't the same in another size. */
static enum result add_own_size(const struct passes *passes, struct text_list *arguments, struct error *err)
{
    int width, height;
    picture_size(passes, &width, &height);
    if (!passes->scene.depends_on_size)
        picture_check_size(width, height, &width, &height);
    return add_size(arguments, width, height, err);
}

static enum result add_all(struct text_list *arguments, const char *const *texts, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; !result && texts[i]; i++)
        result = text_list_add(arguments, err, "%s", texts[i]);
    return result;
}

/* Reflectivities are small, and their edges show as much as those of the picture, which multiplies them by what is
 * bright. */
static double reflectance_threshold(double threshold)
{
    return fmin(threshold, fmax(threshold / 3, 0.01));
}

/* The user's switches first, then those on which the pass depends: POV-Ray takes the last one. */
static enum result job_arguments(const struct passes *passes, enum pass_id id, int frame, struct text_list *arguments,
                                 struct error *err)
{
    const struct passes_options *options = passes->options;
    const struct povray_switches *switches = options->switches;
    const struct pass pass = pass_of(&passes->scene, id);
    static const char *const codes[] = {"+Oimage.ppm", "+FP16", "File_Gamma=1.0", "Dither=off", NULL};
    static const char *const radiance[] = {"+Oimage.exr", "+FE", NULL};
    /* 2 x 2 rays, where the pixel isn't like those beside it: 3 x 3 are no better where the filter blurs. */
    static const char *const mean[] = {"+AM1", "+R2", "-J", NULL};
    static const char *const smooth[] = {"+A0.0", "+AM1", "+R3", "-J", "Antialias_Gamma=1.0", NULL};
    static const char *const one_pixel[] = {"+SR1", "+ER1", "+SC1", "+EC1", NULL};
    enum result result = scene_arguments(passes, frame, arguments, err);
    if (!result)
        result = add_all(arguments, pass.codes ? codes : radiance, err);
    if (!result && id == PASS_SPECULAR && has_means(passes))
        result = add_all(arguments, mean, err);
    else if (!result && (!pass.full_size || id == PASS_OWN))
        result = text_list_add(arguments, err, "-A");
    if (!result && id == PASS_OWN)
        result = add_own_size(passes, arguments, err);
    if (!result && (id == PASS_VIEW || pass_is_place(id)))
        result = add_few_pixels(passes, arguments, err);
    if (!result && id == PASS_REFLECTANCE && switches->antialias)
        result = text_list_add(arguments, err, "+A%g", reflectance_threshold(switches->threshold));
    if (!result && pass.smooth)
        result = add_all(arguments, smooth, err);
    if (!result && pass.technical)
        result = text_list_add(arguments, err, "+Q8");
    if (!result && id == PASS_PHOTONS)
        result = add_all(arguments, one_pixel, err);
    if (!result && options->subsample > 1 && !pass.full_size && id != PASS_VIEW)
        result = add_size(arguments, switches->width / options->subsample, switches->height / options->subsample, err);
    return result;
}

/* A failure may come from a switch or a word that another version doesn't know. */
static void blame_version(const struct povray_job *job, struct error *err)
{
    char version[POVRAY_VERSION_SIZE];
    struct error cause = *err;
    if (povray_is_other_version(&job->messages, version))
        error_set(err, RESULT_POVRAY, "%s; this is POV-Ray %s, and povgloss needs 3.7", cause.text, version);
}

/* POV-Ray stops without a word where its image can't be written. */
static void blame_disk(const struct passes *passes, struct error *err)
{
    struct error cause = *err;
    if (folder_is_full(passes->folder.path))
        error_set(err, RESULT_POVRAY, "%s; less than 1 MB is left in %s: set TMPDIR to a folder with more space",
                  cause.text, passes->folder.path);
}

/* A file that POV-Ray found in a library folder, by the user's name of the folder. */
static enum result add_user_name(const struct passes *passes, const char *path, struct buffer *text, struct error *err)
{
    int index, length = 0;
    if (sscanf(path, "../lib%d/%n", &index, &length) < 1 || !length || index < 0 ||
        index >= passes->directory_names.count)
        return buffer_add_text(text, path, err);
    const char *folder = passes->directory_names.texts[index];
    bool here = !strcmp(folder, ".");
    return buffer_printf(text, err, "%s%s%s", here ? "" : folder, here ? "" : "/", path + length);
}

/* POV-Ray's messages with the names of the user's files in place of the copies'. */
static enum result report_failure(const struct passes *passes, const struct povray_job *job, struct error *err)
{
    bool verbatim = job->name == pass_table[PASS_OWN].name && pass_is_verbatim(&passes->scene, PASS_OWN);
    struct buffer text = {0}, translated = {0};
    struct error ignored = {0};
    enum result result = povray_error_text(&job->messages, &text, &ignored);
    const char *at = text.data ? text.data : "";
    blame_version(job, err);
    blame_disk(passes, err);
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
        int file = scene_file_of_copy(&passes->scene, slash ? slash + 1 : copy);
        result = buffer_add(&translated, at, (size_t)(name - at), &ignored);
        bool is_pass = !strcmp(copy, "pass.inc"), wrapper = is_pass && !verbatim;
        const char *path = file >= 0 ? passes->scene.files[file].path : is_pass ? passes->options->scene : copy;
        if (!result)
            result = add_user_name(passes, path, &translated, &ignored);
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
        error_set(err, RESULT_POVRAY, "%s: %s\n%s", passes->options->scene, ignored.text, translated.data);
    }
    buffer_free(&text);
    buffer_free(&translated);
    return RESULT_POVRAY;
}

/* The environment, but for the .ini file that POV-Ray reads by itself, which the switches hold, and with LD_PRELOAD. */
static enum result make_environment(struct passes *passes, struct error *err)
{
    static char no_ini[] = "POVINI=../" EMPTY_INI;
    int count = 0, kept = 0;
    while (environ[count])
        count++;
    char **environment = passes->environment = calloc((size_t)count + 3, sizeof *environment);
    if (!environment)
        return error_memory(err, (double)count * sizeof *environment);
    for (int i = 0; i < count; i++)
        if (strncmp(environ[i], "POVINI=", 7) && !(passes->preload && !strncmp(environ[i], "LD_PRELOAD=", 11)))
            environment[kept++] = environ[i];
    environment[kept++] = no_ini;
    environment[kept] = passes->preload;
    return RESULT_OK;
}

/* Without the shared object POV-Ray takes longer, and what it reads can't be noted. */
static enum result prepare_preload(struct passes *passes, struct error *err)
{
    struct error missing;
    enum result result = preload_begin(&passes->folder, &missing);
    if (!result)
        return preload_variable(&passes->preload, err);
    if (passes->options->reads)
        *err = missing;
    return passes->options->reads ? result : RESULT_OK;
}

static enum result prepare_environment(struct passes *passes, struct error *err)
{
    enum result result = write_empty_ini(passes, err);
    if (!result && passes->options->reads)
        result = reads_begin(&passes->folder, err);
    if (!result)
        result = prepare_preload(passes, err);
    return result ? result : make_environment(passes, err);
}

static void add_wall_times(const struct passes *passes, const struct povray_job *jobs, int count)
{
    for (int i = 0; i < count; i++)
        if (jobs[i].delivered)
            timings_add_povray(passes->options->timings, jobs[i].name, jobs[i].start_s, jobs[i].wall_s, 0);
}

static void add_processor_times(const struct passes *passes, const struct povray_job *jobs, int count)
{
    for (int i = 0; i < count; i++)
        if (jobs[i].finished)
            timings_add_povray(passes->options->timings, jobs[i].name, jobs[i].start_s, 0, jobs[i].child.cpu_s);
}

/* POV-Ray parses the scene and is stopped by the wrapper before it draws: that is a success if the log has its last
 * line. */
static enum result run_discovery(struct passes *passes, const char *name, const char *folder, struct error *err)
{
    struct text_list arguments = {0};
    char *path = NULL;
    int failed = -1;
    struct input_file log = {0};
    struct error ignored;
    enum result result = scene_arguments(passes, passes->frame, &arguments, err);
    struct povray_job job = {
        .name = name, .folder = folder, .arguments = arguments.texts, .timeout_s = passes->options->timeout_s};
    if (!result)
        result = text_printf(&path, err, "%s/" SCENE_DISCOVERY_LOG, folder);
    if (!result)
        result = povray_run(&job, 1, 1, passes->environment, NULL, NULL, &failed, err);
    if (failed >= 0 && !input_file_read(path, &log, &ignored) && log.size >= 4 &&
        !memcmp(log.data + log.size - 4, "end\n", 4))
        result = RESULT_OK;
    else if (failed >= 0)
        result = report_failure(passes, &job, err);
    add_wall_times(passes, &job, 1);
    add_processor_times(passes, &job, 1);
    input_file_free(&log);
    povray_jobs_free(&job, 1);
    text_list_free(&arguments);
    free(path);
    return result;
}

/* Finds the files that only POV-Ray knows; what is included by a new file is found in a further run. */
static enum result discover(struct passes *passes, struct error *err)
{
    enum result result = RESULT_OK;
    for (bool again = true; !result && again;) {
        char name[32], *folder = NULL;
        struct buffer text = {0};
        snprintf(name, sizeof name, "discovery%d", ++passes->discoveries);
        result = text_printf(&folder, err, "%s/%s", passes->folder.path, name);
        if (!result)
            result = work_folder_add(&passes->folder, name, err);
        if (!result)
            result = pass_discovery_text(&passes->scene, &text, err);
        if (!result)
            result = write_wrapper(passes, name, &text, err);
        if (!result)
            result = write_copy(passes, SCENE_COPY_DISCOVERY, err);
        if (!result)
            result = run_discovery(passes, name, folder, err);
        if (!result)
            result = scene_discover(&passes->scene, folder, (const char *const *)passes->directories.texts,
                                    passes->directories.count, &again, err);
        buffer_free(&text);
        free(folder);
    }
    return result ? result : scene_settle(&passes->scene, err);
}

/* Another frame's. */
static enum result remove_left(const struct passes *passes, enum pass_id id, const char *name, struct error *err)
{
    char *path;
    enum result result = text_printf(&path, err, "%s/%s/%s", passes->folder.path, pass_table[id].name, name);
    if (!result)
        remove(path);
    free(path);
    return result;
}

/* What the base pass may have noted of an object. */
static const struct {
    const char *file, *text;
} object_notes[] = {
    {PASS_MIXED_FILE, "this object holds something transparent and something glossy: reflections inside the transparent part "
                      "are left out; make them objects of their own"},
    {PASS_GLASS_FILE, "a glossy surface reflects nothing where it is seen by a reflection in this object and then through "
                      "something transparent"},
};
enum { OBJECT_NOTES = sizeof object_notes / sizeof *object_notes };

/* Adds those to *note. */
static enum result note_objects(const struct passes *passes, struct error *note, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < OBJECT_NOTES; i++) {
        char *path;
        result = text_printf(&path, err, "%s/%s/%s", passes->folder.path, pass_table[PASS_BASE].name, object_notes[i].file);
        FILE *stream = result ? NULL : fopen(path, "r");
        int file, line;
        if (stream && fscanf(stream, "%d %d", &file, &line) == 2 && file >= 0 && file < passes->scene.file_count) {
            size_t length = strlen(note->text);
            snprintf(note->text + length, sizeof note->text - length, "%s%s:%d: %s", length ? "; " : "",
                     passes->scene.files[file].path, line, object_notes[i].text);
        }
        if (stream)
            fclose(stream);
        free(path);
    }
    return result;
}

static struct pass_images images_of(const struct passes *passes, const char *number)
{
    return (struct pass_images){.folder = passes->folder.path,
                                .number = number,
                                .name = passes->options->scene,
                                .scene = &passes->scene,
                                .subsample = passes->options->subsample,
                                .means = has_means(passes),
                                .rays = passes->options->rays,
                                .margin_x = passes->margin_x,
                                .margin_y = passes->margin_y,
                                .view = passes->has_view ? &passes->view : NULL,
                                .camera = passes->has_camera ? &passes->camera : NULL};
}

/* Rows and columns to render; `left` and `top` count from 0. */
static enum result add_window(struct text_list *arguments, int left, int top, int width, int height, struct error *err)
{
    enum result result = text_list_add(arguments, err, "+SC%d", left + 1);
    if (!result)
        result = text_list_add(arguments, err, "+EC%d", left + width);
    if (!result)
        result = text_list_add(arguments, err, "+SR%d", top + 1);
    return result ? result : text_list_add(arguments, err, "+ER%d", top + height);
}

/* The jobs of a frame while they run. */
struct run {
    struct passes *passes;
    char number[FRAMES_NUMBER_SIZE]; /* of the frame */
    struct text_list arguments[PASS_COUNT];
    char *folders[PASS_COUNT], *images[PASS_COUNT];
    bool view_sought, camera_sought; /* it is known, or can't be */
    bool narrows, narrowed; /* to the glossy window: whether passes are, and whether they have been */
};

static struct povray_job *job_of(struct passes *passes, enum pass_id id)
{
    for (int i = 0; i < passes->job_count; i++)
        if (passes->ids[i] == id)
            return &passes->jobs[i];
    return NULL;
}

static bool has_ended(struct passes *passes, enum pass_id id)
{
    const struct povray_job *job = job_of(passes, id);
    return !job || job->delivered;
}

/* What the passes with a margin include: nothing as long as the camera isn't known. */
static enum result write_camera(const struct passes *passes, const struct buffer *text, struct error *err)
{
    char *path;
    enum result result = text_printf(&path, err, "%s/copies/" PASS_MARGIN_CAMERA, passes->folder.path);
    if (!result)
        result = file_write(path, text, err);
    free(path);
    return result;
}

/* Where the camera's rays are found among few of them the others needn't be rendered. */
static enum result seek_view(struct passes *passes, const struct pass_images *images, struct error *err)
{
    enum result result = pass_images_view(images, &passes->view, &passes->has_view, err);
    job_of(passes, PASS_DIRECTION)->dropped = passes->has_view;
    return result;
}

/* The picture's camera is found: with a margin it sees more. */
static enum result add_margin(struct run *run, const struct pass_images *images, struct error *err)
{
    struct passes *passes = run->passes;
    const struct passes_options *options = passes->options;
    struct buffer text = {0};
    int width, height;
    enum result result = pass_images_camera(images, &passes->camera, &passes->has_camera, err);
    if (result || !passes->has_camera)
        return result;
    picture_size(passes, &width, &height);
    passes->margin_x = options->margin_px > 0 ? options->margin_px : (int)lround(options->margin * width);
    passes->margin_y = options->margin_px > 0 ? options->margin_px : (int)lround(options->margin * height);
    int all_width = width + 2 * passes->margin_x, all_height = height + 2 * passes->margin_y;
    if (all_width > IMAGE_MAX_SIDE || all_height > IMAGE_MAX_SIDE)
        return error_set(err, RESULT_DATA, "%s: the picture with its margin is %dx%d pixels, more than %d: give less --margin",
                         options->scene, all_width, all_height, IMAGE_MAX_SIDE);
    result = camera_text(&passes->camera, (double)all_width / width, (double)all_height / height, &text, err);
    if (!result)
        result = write_camera(passes, &text, err);
    for (int i = 0; !result && i < passes->job_count; i++)
        if (pass_table[passes->ids[i]].margin) {
            result = add_size(&run->arguments[i], all_width, all_height, err);
            passes->jobs[i].arguments = run->arguments[i].texts;
        }
    buffer_free(&text);
    return result;
}

static int clamp(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

/* Limits the pass to the glossy window, whose pixels are those of pass_of_glossy. It begins where a block of the
 * whole picture begins: POV-Ray antialiases block by block. */
static enum result add_glossy_window(struct run *run, int index, const struct image_window *window, struct error *err)
{
    struct passes *passes = run->passes;
    const struct pass pass = pass_of(&passes->scene, passes->ids[index]);
    int step = pass.full_size ? passes->options->subsample : 1;
    int left = (int)window->left * step, right = left + window->width * step;
    int top = (int)window->top * step, bottom = top + window->height * step;
    if (passes->has_camera && !pass.margin) {
        int width, height;
        picture_size(passes, &width, &height);
        left = clamp(left - passes->margin_x, 0, width - 1);
        right = clamp(right - passes->margin_x, left + 1, width);
        top = clamp(top - passes->margin_y, 0, height - 1);
        bottom = clamp(bottom - passes->margin_y, top + 1, height);
    }
    left -= left % POVRAY_BLOCK;
    top -= top % POVRAY_BLOCK;
    enum result result = add_window(&run->arguments[index], left, top, right - left, bottom - top, err);
    passes->jobs[index].arguments = run->arguments[index].texts;
    return result;
}

/* Where pass_of_glossy saw nothing others have nothing to do. */
static enum result narrow(struct run *run, const struct pass_images *images, struct error *err)
{
    struct image_window window;
    enum result result = pass_images_glossy(images, &window, err);
    for (int i = 0; !result && i < run->passes->job_count; i++)
        if (pass_of(&run->passes->scene, run->passes->ids[i]).glossy_part)
            result = add_glossy_window(run, i, &window, err);
    return result;
}

/* Holds what needs something that isn't there yet: photons, the camera's rays and its place, the glossy window. */
static void hold(struct run *run)
{
    struct passes *passes = run->passes;
    for (int i = 0; i < passes->job_count; i++) {
        enum pass_id id = passes->ids[i];
        passes->jobs[i].held = (id != PASS_PHOTONS && !has_ended(passes, PASS_PHOTONS)) ||
                               (id == PASS_DIRECTION && !run->view_sought) ||
                               (passes->margin && pass_table[id].margin && !run->camera_sought) ||
                               (run->narrows && pass_of(&passes->scene, id).glossy_part && !run->narrowed);
    }
}

/* A pass has ended, and others may have waited for it. */
static enum result go_on(void *context, struct error *err)
{
    struct run *run = context;
    struct passes *passes = run->passes;
    enum result result = RESULT_OK;
    if (!run->view_sought && has_ended(passes, PASS_VIEW)) {
        const struct pass_images images = images_of(passes, run->number);
        run->view_sought = true;
        result = seek_view(passes, &images, err);
    }
    if (!result && passes->margin && !run->camera_sought && run->view_sought && has_ended(passes, PASS_PLACE) &&
        has_ended(passes, PASS_PLACE_LOW)) {
        const struct pass_images images = images_of(passes, run->number);
        run->camera_sought = true;
        result = add_margin(run, &images, err);
    }
    if (!result && run->narrows && !run->narrowed && has_ended(passes, pass_of_glossy(&passes->scene))) {
        const struct pass_images images = images_of(passes, run->number);
        run->narrowed = true;
        result = narrow(run, &images, err);
    }
    hold(run);
    return result;
}

static enum result run_passes(struct passes *passes, int frame, struct error *err)
{
    const struct passes_options *options = passes->options;
    struct run run = {.passes = passes, .narrows = passes->scene.glossy && !options->switches->partial};
    const struct buffer none = {0};
    enum result result = passes->margin ? write_camera(passes, &none, err) : RESULT_OK;
    povray_jobs_free(passes->jobs, PASS_COUNT);
    passes->has_view = passes->has_camera = false;
    passes->margin_x = passes->margin_y = 0;
    frames_number(&options->frames, frame, run.number);
    for (int i = 0; !result && i < passes->job_count; i++) {
        result = job_arguments(passes, passes->ids[i], frame, &run.arguments[i], err);
        if (!result)
            result = text_printf(&run.folders[i], err, "%s/%s", passes->folder.path, pass_table[passes->ids[i]].name);
        if (!result)
            result = pass_image_name(passes->ids[i], run.number, &run.images[i], err);
        passes->jobs[i] = (struct povray_job){.name = pass_table[passes->ids[i]].name,
                                              .folder = run.folders[i],
                                              .arguments = run.arguments[i].texts,
                                              .image = run.images[i],
                                              .timeout_s = options->timeout_s,
                                              .ended = go_on,
                                              .context = &run};
    }
    run.view_sought = !job_of(passes, PASS_VIEW);
    hold(&run);
    int failed = -1, at_once = options->jobs > 0 ? options->jobs : (int)sysconf(_SC_NPROCESSORS_ONLN) + 2;
    if (!result && job_of(passes, PASS_PHOTONS))
        result = remove_left(passes, PASS_PHOTONS, PASS_PHOTONS_FILE, err);
    for (int i = 0; !result && i < OBJECT_NOTES; i++)
        result = remove_left(passes, PASS_BASE, object_notes[i].file, err);
    if (!result)
        result = povray_run(passes->jobs, passes->job_count, at_once, passes->environment, options->progress,
                            options->progress_context, &failed, err);
    if (failed >= 0)
        result = report_failure(passes, &passes->jobs[failed], err);
    if (!result && !povray_is_other_version(&passes->jobs[0].messages, passes->version))
        passes->version[0] = 0;
    add_wall_times(passes, passes->jobs, passes->job_count);
    for (int i = 0; i < passes->job_count; i++) {
        text_list_free(&run.arguments[i]);
        free(run.folders[i]);
        free(run.images[i]);
    }
    passes->ending = true;
    return result;
}

static enum result run_view(const struct passes *passes, int frame, int width, int height, struct error *err)
{
    struct text_list arguments = {0};
    char *folder = NULL;
    int failed = -1;
    enum result result = job_arguments(passes, PASS_PROBE, frame, &arguments, err);
    if (!result)
        result = add_size(&arguments, width, height, err);
    if (!result)
        result = add_window(&arguments, 0, 0, width, height, err);
    if (!result)
        result = text_printf(&folder, err, "%s/%s", passes->folder.path, pass_table[PASS_PROBE].name);
    struct povray_job job = {
        .name = pass_table[PASS_PROBE].name, .folder = folder, .arguments = arguments.texts};
    if (!result)
        result = povray_run(&job, 1, 1, passes->environment, NULL, NULL, &failed, err);
    if (failed >= 0)
        result = report_failure(passes, &job, err);
    add_wall_times(passes, &job, 1);
    add_processor_times(passes, &job, 1);
    povray_jobs_free(&job, 1);
    text_list_free(&arguments);
    free(folder);
    return result;
}

static enum result collect_reads(struct passes *passes, struct error *err)
{
    const struct reads_places places = {.scene = &passes->scene,
                                        .directories = &passes->directories,
                                        .names = &passes->directory_names};
    return reads_collect(&passes->folder, &places, &passes->reads, err);
}

/* What in the scene the picture can't be right about, in one message. */
static enum result note_limits(const struct passes *passes, struct error *note, struct error *err)
{
    const struct scene *scene = &passes->scene;
    struct buffer text = {0};
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < SCENE_LIMIT_COUNT; i++) {
        const struct scene_place *place = &scene->limits[i];
        if (place->line && (i != SCENE_LIMIT_SUBSURFACE || scene->plain_mirrors))
            result = buffer_printf(&text, err, "; %s:%d: %s", scene->files[place->file].path, place->line,
                                   scene_limit_text((enum scene_limit)i));
    }
    if (!result && text.size)
        error_set(note, RESULT_OK, "%s", text.data + 2);
    buffer_free(&text);
    return result;
}

static enum result check_scene(const struct passes *passes, struct error *note, struct error *err)
{
    const struct scene *scene = &passes->scene;
    bool chosen = scene->choice->automatic || scene->choice->all;
    if (!scene->glossy && !chosen)
        return error_set(err, RESULT_DATA,
                         "%s: nothing in this scene is glossy: write #include \"povgloss.inc\", and Gloss(300) in a finish "
                         "that has a reflection, or choose finishes with --gloss",
                         passes->options->scene);
    if (!scene->glossy)
        error_set(note, RESULT_OK, "%s: no finish is glossy with this --gloss: the picture is POV-Ray's own",
                  passes->options->scene);
    else
        return note_limits(passes, note, err);
    return RESULT_OK;
}

static void note_version(struct passes *passes, struct error *note)
{
    struct error before = *note;
    if (!passes->version[0] || passes->version_told)
        return;
    passes->version_told = true;
    error_set(note, RESULT_OK, "%s%sthis is POV-Ray %s: povgloss is made for 3.7, and the picture may be another",
              before.text, before.text[0] ? "; " : "", passes->version);
}

static void note_margin(const struct passes *passes, struct error *note)
{
    const struct passes_options *options = passes->options;
    struct error before = *note;
    bool asked = (options->margin > 0 || options->margin_px > 0) && passes->scene.glossy;
    const char *reason = options->switches->partial      ? "only a part of the picture is rendered"
                         : passes->scene.focal_blur        ? "the camera has an aperture"
                         : passes->scene.depends_on_size ? "the scene depends on the picture's size"
                                                           : "the camera isn't a perspective one";
    if (asked && !passes->has_camera)
        error_set(note, RESULT_OK, "%s%s%s: there is no margin: %s", before.text, before.text[0] ? "; " : "",
                  options->scene, reason);
}

/* The images of a long animation don't pile up. */
static enum result remove_image(const struct passes *passes, const struct pass_images *images, enum pass_id id,
                                struct error *err)
{
    char *path;
    enum result result = passes->options->keep ? RESULT_OK : pass_image_path(images, id, &path, err);
    if (result || passes->options->keep)
        return result;
    remove(path);
    free(path);
    return RESULT_OK;
}

static enum result remove_images(const struct passes *passes, const struct pass_images *images, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < passes->job_count; i++)
        if (passes->ids[i] != PASS_OWN)
            result = remove_image(passes, images, passes->ids[i], err);
    return result;
}

/* Reads the scene and writes those of the passes. */
static enum result prepare(struct passes *passes, int frame, struct error *note, struct error *err)
{
    struct timings_moment start = timings_now();
    passes->frame = frame;
    note->text[0] = 0;
    enum result result = load_scene(passes, err);
    if (!result && passes->scene.needs_discovery)
        result = discover(passes, err);
    if (!result)
        result = check_scene(passes, note, err);
    if (!result)
        result = write_scenes(passes, err);
    timings_add(passes->options->timings, "scene", start);
    return result;
}

/* What POV-Ray computes may be something else in another frame. */
static enum result prepare_frame(struct passes *passes, int frame, struct error *err)
{
    struct error ignored;
    if (frame == passes->frame || !passes->scene.needs_discovery)
        return RESULT_OK;
    scene_free(&passes->scene);
    return prepare(passes, frame, &ignored, err);
}

enum result passes_open(const struct passes_options *options, struct passes **opened, struct error *note,
                        struct error *err)
{
    const struct povray_switches *switches = options->switches;
    assert(!((options->rays || options->margin > 0 || options->margin_px > 0) && options->subsample > 1));
    assert(!(options->rays && (options->margin > 0 || options->margin_px > 0)));
    assert(options->subsample >= 1 && (options->subsample == 1 || (switches->width > 0 && switches->height > 0)));
    struct passes *passes = *opened = calloc(1, sizeof *passes);
    if (!passes)
        return error_memory(err, sizeof *passes);
    passes->options = options;
    enum result result = work_folder_make(&passes->folder, options->keep, err);
    if (!result)
        result = work_folder_add(&passes->folder, "copies", err);
    if (!result)
        result = find_directories(passes, err);
    if (!result)
        result = link_directories(passes, err);
    if (!result)
        result = prepare_environment(passes, err);
    if (!result)
        result = find_command(passes, err);
    return result ? result : prepare(passes, options->frames.first, note, err);
}

/* Waits for the ends of the last frame's processes. */
static enum result end_jobs(struct passes *passes, int *failed, struct error *err)
{
    *failed = -1;
    if (!passes->ending)
        return RESULT_OK;
    passes->ending = false;
    enum result result = povray_end(passes->jobs, passes->job_count, failed, err);
    add_processor_times(passes, passes->jobs, passes->job_count);
    return result;
}

enum result passes_settle(struct passes *passes, struct error *err)
{
    int failed;
    if (!passes)
        return RESULT_OK;
    enum result result = end_jobs(passes, &failed, err);
    return failed >= 0 ? report_failure(passes, &passes->jobs[failed], err) : result;
}

enum result passes_render(struct passes *passes, int frame, struct gbuffer *gbuffer, struct error *note,
                          struct error *err)
{
    const struct passes_options *options = passes->options;
    char number[FRAMES_NUMBER_SIZE];
    frames_number(&options->frames, frame, number);
    *gbuffer = (struct gbuffer){0};
    note->text[0] = 0;
    enum result result = passes_settle(passes, err);
    if (!result)
        result = prepare_frame(passes, frame, err);
    struct timings_moment start = timings_now();
    if (!result)
        result = run_passes(passes, frame, err);
    timings_add(options->timings, "passes", start);
    if (!result && options->reads)
        result = collect_reads(passes, err);
    start = timings_now();
    const struct pass_images images = images_of(passes, number);
    if (!result)
        result = pass_images_read(&images, gbuffer, note, err);
    timings_add(options->timings, "decode", start);
    if (!result) {
        note_margin(passes, note);
        note_version(passes, note);
    }
    if (!result)
        result = note_objects(passes, note, err);
    if (!result)
        result = remove_images(passes, &images, err);
    if (result)
        gbuffer_free(gbuffer);
    return result;
}

static void note_difference(const struct passes *passes, const struct picture_difference *difference, struct error *note)
{
    const float *sum = difference->sum, *own = difference->own;
    if (difference->found)
        error_set(note, RESULT_OK,
                  "%s: the passes don't add up to POV-Ray's own picture in %.2g %% of the image, most at pixel %d,%d: %.2g "
                  "%.2g %.2g in place of %.2g %.2g %.2g; something there isn't modelled (Limits in the README names the "
                  "usual: fog, media, glass, focal blur): look there at base, specular.* and reflectance.* of povgloss "
                  "passes, and leave the finish to POV-Ray by --gloss NAME=inf",
                  passes->options->scene, 100 * difference->share, difference->x, difference->y, (double)sum[0],
                  (double)sum[1], (double)sum[2], (double)own[0], (double)own[1], (double)own[2]);
}

enum result passes_check_sum(const struct passes *passes, int frame, const struct gbuffer *gbuffer, struct error *note,
                         struct error *err)
{
    const struct passes_options *options = passes->options;
    /* Radiosity is interpolated between random places, others in each picture. */
    const double tolerance = passes->scene.radiosity ? 0.03 : 0.01;
    bool single_rays = options->subsample == 1 && !options->switches->antialias && !passes->scene.focal_blur &&
                       !passes->scene.radiosity;
    struct picture_difference difference;
    struct image sum = {0}, own = {0};
    char number[FRAMES_NUMBER_SIZE];
    note->text[0] = 0;
    if (!is_checked(passes))
        return RESULT_OK;
    frames_number(&options->frames, frame, number);
    const struct pass_images images = images_of(passes, number);
    struct timings_moment start = timings_now();
    enum result result = pass_images_radiance(&images, PASS_OWN, &own, err);
    if (!result)
        result = compose(gbuffer, &gbuffer->specular, &sum, err);
    if (!result && gbuffer->window.width > 0)
        result = image_crop(&sum, &gbuffer->window, err);
    if (!result)
        result = picture_check(&sum, &own, single_rays, tolerance, &difference, err);
    if (!result)
        note_difference(passes, &difference, note);
    if (!result)
        result = remove_image(passes, &images, PASS_OWN, err);
    timings_add(options->timings, "check", start);
    image_free(&sum);
    image_free(&own);
    return result;
}

enum result passes_view(struct passes *passes, int frame, const struct buffer *view, int width, int height,
                        struct image *image, struct error *err)
{
    char number[FRAMES_NUMBER_SIZE], *path = NULL;
    frames_number(&passes->options->frames, frame, number);
    const struct pass_images images = images_of(passes, number);
    enum result result = write_pass(passes, PASS_PROBE, err);
    if (!result)
        result = text_printf(&path, err, "%s/%s/" PASS_PROBE_VIEW, passes->folder.path, pass_table[PASS_PROBE].name);
    if (!result)
        result = file_write(path, view, err);
    if (!result)
        result = run_view(passes, frame, width, height, err);
    if (!result)
        result = pass_images_radiance(&images, PASS_PROBE, image, err);
    if (!result && (image->width != width || image->height != height))
        result = error_set(err, RESULT_DATA, "%s: POV-Ray's image of the probe pass is %dx%d, not %dx%d",
                           passes->options->scene, image->width, image->height, width, height);
    free(path);
    return result;
}

enum result passes_reads(const struct passes *passes, struct buffer *files, struct error *err)
{
    return reads_list(&passes->reads, passes->options->scene, &passes->options->switches->ini_files, files, err);
}

enum result passes_close(struct passes *passes, struct error *err)
{
    if (!passes)
        return RESULT_OK;
    struct error ignored;
    int failed;
    end_jobs(passes, &failed, &ignored);
    povray_jobs_free(passes->jobs, PASS_COUNT);
    free_scene(passes);
    reads_free(&passes->reads);
    text_list_free(&passes->command);
    free(passes->environment);
    free(passes->preload);
    if (passes->options->sandbox)
        sandbox_end();
    enum result result = work_folder_remove(&passes->folder, err);
    free(passes);
    return result;
}
