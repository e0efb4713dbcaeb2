/* One table says how every pass is rendered; what follows writes the scenes, runs POV-Ray and reads its images.
 *
 * A pass is one or two copies of the scene (scene_rewrite.h), each in a union whose flags say which rays see it. See the
 * table in passes.h for what each pass is, and DESIGN in README.md for why.
 */
#include "passes.h"

#include "exr_io.h"
#include "eye.h"
#include "gamma.h"
#include "interpolate.h"
#include "png_io.h"
#include "position_code.h"
#include "povray_switches.h"
#include "scene_rewrite.h"
#include "work_folder.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum pass_id {
    PASS_BASE,
    PASS_SPECULAR,
    PASS_REFLECTANCE,
    PASS_POSITION,
    PASS_POSITION_LOW,
    PASS_ENDPOINT,
    PASS_ENDPOINT_LOW,
    PASS_DIRECTION,
    PASS_EXPONENT,
    PASS_COUNT,
};

/* What povgloss_end puts last into every finish. Later items of a finish override earlier ones; povgloss_phong is 0 or more
 * when the finish called Gloss() or began with a glossy one, povgloss_reflects is 1 when it names a reflection of its own.
 * A finish without either keeps what it has. */
static const char end_base[] = "#if (povgloss_phong >= 0) reflection { 0 } #end";
static const char end_mirror[] = "povgloss_dark()\n"
                                 "  #if (povgloss_phong >= 0) reflection { povgloss_mirror_colour() fresnel off falloff 1 "
                                 "exponent 1 metallic 0 }\n"
                                 "  #else #if (povgloss_reflects) reflection { 0 } #end #end";
/* An exponent of 0.001 takes the sky's one half to nothing, and leaves the reflectivity for a later Gloss(). */
static const char end_reflectance[] = "povgloss_dark()\n"
                                      "  #if (povgloss_phong >= 0) reflection_exponent 1\n"
                                      "  #else #if (povgloss_reflects) reflection_exponent 0.001 #end #end";

static const char mirror_white[] = "rgb 1";
/* log2(1 + p)/128 in two digits of 16 bits. */
static const char mirror_exponent[] = "#local povgloss_v = 65535*log(1 + povgloss_phong)/log(2)/128;\n"
                                      "  rgb <floor(povgloss_v)/65535, povgloss_v - floor(povgloss_v), 1>";

static const char sky_half[] = "sphere { 0, 9e6 inverse hollow pigment { rgb 0 } no_reflection no_shadow }\n"
                               "sky_sphere { pigment { rgb 0.5 } }\n";
static const char sky_white[] = "sky_sphere { pigment { rgb 1 } }\n";

struct scene_part {
    int copy; /* enum scene_copy, or -1 */
    const char *modifiers;
    bool coded; /* the position-coding texture on the union */
};

struct pass {
    const char *name;
    bool codes;     /* a 16-bit PNG of codes; else EXR of radiance */
    bool full_size; /* rendered as the user asks, antialiasing and size; else one ray a pixel, subsampled */
    bool technical;
    enum position_digits digits;
    const char *finish_end;
    const char *mirror_colour;
    struct scene_part first, second;
    bool coded_sky;
    const char *trailer;
};

#define MIRRORS "no_reflection no_shadow no_radiosity"
#define SEEN_IN_MIRRORS "no_image"

static const struct pass passes[PASS_COUNT] = {
    [PASS_BASE] = {.name = "base",
                   .full_size = true,
                   .finish_end = end_base,
                   .first = {SCENE_COPY_PLAIN, SEEN_IN_MIRRORS, false},
                   .second = {SCENE_COPY_BASE_SECOND, MIRRORS, false}},
    [PASS_SPECULAR] = {.name = "specular",
                       .finish_end = end_mirror,
                       .mirror_colour = mirror_white,
                       .first = {SCENE_COPY_PLAIN, SEEN_IN_MIRRORS, false},
                       .second = {SCENE_COPY_MIRROR_SECOND, MIRRORS, false}},
    [PASS_REFLECTANCE] = {.name = "reflectance",
                          .full_size = true,
                          .finish_end = end_reflectance,
                          .first = {SCENE_COPY_REFLECTANCE, MIRRORS, false},
                          .second = {-1, NULL, false},
                          .trailer = sky_half},
    [PASS_POSITION] = {.name = "position",
                       .codes = true,
                       .technical = true,
                       .digits = POSITION_DIGITS_HIGH,
                       .first = {SCENE_COPY_CODED, "", true},
                       .second = {-1, NULL, false}},
    [PASS_POSITION_LOW] = {.name = "position-low",
                           .codes = true,
                           .technical = true,
                           .digits = POSITION_DIGITS_LOW,
                           .first = {SCENE_COPY_CODED, "", true},
                           .second = {-1, NULL, false}},
    [PASS_ENDPOINT] = {.name = "endpoint",
                       .codes = true,
                       .technical = true,
                       .digits = POSITION_DIGITS_HIGH,
                       .finish_end = end_mirror,
                       .mirror_colour = mirror_white,
                       .first = {SCENE_COPY_CODED, SEEN_IN_MIRRORS, true},
                       .second = {SCENE_COPY_MIRROR_SECOND, MIRRORS, false},
                       .coded_sky = true},
    [PASS_ENDPOINT_LOW] = {.name = "endpoint-low",
                           .codes = true,
                           .technical = true,
                           .digits = POSITION_DIGITS_LOW,
                           .finish_end = end_mirror,
                           .mirror_colour = mirror_white,
                           .first = {SCENE_COPY_CODED, SEEN_IN_MIRRORS, true},
                           .second = {SCENE_COPY_MIRROR_SECOND, MIRRORS, false},
                           .coded_sky = true},
    [PASS_DIRECTION] = {.name = "direction",
                        .codes = true,
                        .technical = true,
                        .digits = POSITION_DIGITS_HIGH,
                        .first = {SCENE_COPY_CODED, SEEN_IN_MIRRORS, false},
                        .second = {-1, NULL, false},
                        .coded_sky = true},
    [PASS_EXPONENT] = {.name = "exponent",
                       .codes = true,
                       .technical = true,
                       .finish_end = end_mirror,
                       .mirror_colour = mirror_exponent,
                       .first = {SCENE_COPY_MIRROR, MIRRORS, false},
                       .second = {-1, NULL, false},
                       .trailer = sky_white},
};

/* Everything about one run. */
struct run {
    const struct passes_options *options;
    struct scene scene;
    struct work_folder folder;
    char **directories; /* where includes are looked for, absolute; those up to linked_count have links lib0, lib1, ... */
    int directory_count, linked_count;
    struct povray_job jobs[PASS_COUNT];
    enum pass_id ids[PASS_COUNT];
    int job_count;
};

/* ---- the wrapper scene of a pass ---- */

/* What a copy with marked finishes refers to. */
static enum result add_macros(const struct pass *pass, struct buffer *text, struct error *err)
{
    enum result result = buffer_add_text(
        text,
        "#macro povgloss_dark() ambient 0 emission 0 diffuse 0 specular 0 phong 0 #end\n"
        "#macro povgloss_begin(povgloss_of)\n"
        "  #declare povgloss_inherited = povgloss_of; #declare povgloss_reflects = 0; #declare povgloss_phong = -1;\n"
        "#end\n"
        "#declare povgloss_pigment = pigment { rgb 0 };\n"
        "#declare povgloss_reflects = 0; #declare povgloss_texture = -1; #declare povgloss_last = -1;\n",
        err);
    if (!result && pass->mirror_colour)
        result = buffer_printf(text, err, "#macro povgloss_mirror_colour() %s #end\n", pass->mirror_colour);
    if (!result)
        result = buffer_printf(text, err, "#macro povgloss_end()\n"
                               "  #if (povgloss_phong < 0) #declare povgloss_phong = povgloss_inherited; #end\n"
                               "  #declare povgloss_last = povgloss_phong;\n"
                               "  %s\n#end\n",
                               pass->finish_end);
    if (!result && pass->finish_end != end_base)
        result = buffer_add_text(text, "#default { pigment { povgloss_pigment } finish { povgloss_dark() } }\n", err);
    return result;
}

static enum result add_coding_texture(const struct pass *pass, struct buffer *text, struct error *err)
{
    enum result result = buffer_add_text(text, "texture { ", err);
    if (!result)
        result = position_code_pigment(text, false, pass->digits, err);
    return result ? result : buffer_add_text(text, "finish { emission 1 ambient 0 diffuse 0 specular 0 phong 0 } }\n", err);
}

static enum result add_part(const struct run *run, const struct pass *pass, const struct scene_part *part,
                            struct buffer *text, struct error *err)
{
    bool marked = part->copy != SCENE_COPY_PLAIN && part->copy != SCENE_COPY_CODED;
    enum result result = marked ? add_macros(pass, text, err) : RESULT_OK;
    char *name = NULL;
    if (!result)
        result = scene_copy_name(&run->scene, (enum scene_copy)part->copy, 0, &name, err);
    if (!result && part->copy == SCENE_COPY_BASE) {
        result = buffer_printf(text, err, "#include \"%s\"\n", name);
        free(name);
        return result;
    }
    if (!result)
        result = buffer_printf(text, err, "#macro povgloss_modifiers()\n%s\n", part->modifiers);
    if (!result && part->coded)
        result = add_coding_texture(pass, text, err);
    if (!result)
        result = buffer_printf(text, err,
                               "#end\nunion { povgloss_nothing()\n#include \"%s\"\npovgloss_modifiers() }\n"
                               "#undef povgloss_modifiers\n",
                               name);
    free(name);
    return result;
}

/* Between two copies: neither names nor defaults of the first one hold for the second. */
static enum result add_separation(const struct run *run, struct buffer *text, struct error *err)
{
    enum result result = scene_restore_names(&run->scene, text, err);
    if (result)
        return result;
    return buffer_add_text(text,
                           "#default { pigment { rgb 0 } finish { ambient 0.1 diffuse 0.6 emission 0 specular 0 phong 0 "
                           "reflection { 0 } } }\n",
                           err);
}

static enum result add_coded_sky(const struct pass *pass, struct buffer *text, struct error *err)
{
    enum result result = buffer_add_text(text, "sky_sphere { ", err);
    if (!result)
        result = position_code_pigment(text, true, pass->digits, err);
    return result ? result : buffer_add_text(text, "}\n", err);
}

/* The base pass needs its second copy only where a mirror may show a glossy surface. */
static bool has_second_part(const struct run *run, enum pass_id id)
{
    return passes[id].second.copy >= 0 && (id != PASS_BASE || run->scene.plain_mirrors);
}

static struct scene_part first_part(const struct run *run, enum pass_id id)
{
    struct scene_part part = passes[id].first;
    if (id == PASS_BASE && !has_second_part(run, id))
        part.copy = SCENE_COPY_BASE;
    return part;
}

static enum result wrapper_text(const struct run *run, enum pass_id id, struct buffer *text, struct error *err)
{
    const struct pass *pass = &passes[id];
    struct scene_part first = first_part(run, id);
    enum result result = RESULT_OK;
    if (run->scene.version > 0)
        result = buffer_printf(text, err, "#version %.9g;\n", run->scene.version);
    if (!result && pass->technical)
        result = buffer_add_text(text, "global_settings { assumed_gamma 1.0 }\n", err);
    if (!result)
        result = buffer_add_text(
            text, "#macro povgloss_nothing() sphere { 0, 1e-6 no_image no_reflection no_shadow no_radiosity } #end\n", err);
    /* Codes must not be averaged: focal blur is for the passes that are drawn as the user asks. */
    if (!result)
        result = buffer_printf(text, err, "#macro povgloss_camera() %s #end\n", pass->full_size ? "" : "aperture 0");
    if (!result)
        result = scene_save_names(&run->scene, text, err);
    if (!result)
        result = add_part(run, pass, &first, text, err);
    if (!result && has_second_part(run, id)) {
        result = add_separation(run, text, err);
        if (!result)
            result = add_part(run, pass, &pass->second, text, err);
    }
    if (!result && pass->coded_sky)
        result = add_coded_sky(pass, text, err);
    if (!result && pass->trailer)
        result = buffer_add_text(text, pass->trailer, err);
    if (!result && pass->technical)
        result = buffer_add_text(text, "global_settings { max_trace_level 3 adc_bailout 1/255 }\n", err);
    return result;
}

static enum result write_wrapper(const struct run *run, enum pass_id id, struct error *err)
{
    struct buffer text = {0};
    char *path = NULL;
    enum result result = work_folder_add(&run->folder, passes[id].name, err);
    if (!result)
        result = wrapper_text(run, id, &text, err);
    if (!result)
        result = text_printf(&path, err, "%s/%s/pass.pov", run->folder.path, passes[id].name);
    if (!result)
        result = file_write(path, &text, err);
    buffer_free(&text);
    free(path);
    return result;
}

static enum result write_scenes(struct run *run, struct error *err)
{
    bool needed[SCENE_COPY_COUNT] = {false}, several = run->scene.exponent < 0;
    enum result result = work_folder_add(&run->folder, "copies", err);
    for (int id = 0; !result && id < PASS_COUNT; id++) {
        if (id == PASS_EXPONENT && !several)
            continue;
        run->ids[run->job_count++] = (enum pass_id)id;
        needed[first_part(run, (enum pass_id)id).copy] = true;
        if (has_second_part(run, (enum pass_id)id))
            needed[passes[id].second.copy] = true;
        result = write_wrapper(run, (enum pass_id)id, err);
    }
    char *copies = NULL;
    if (!result)
        result = text_printf(&copies, err, "%s/copies", run->folder.path);
    for (int copy = 0; !result && copy < SCENE_COPY_COUNT; copy++)
        if (needed[copy])
            result = scene_write_copy(&run->scene, (enum scene_copy)copy, copies, err);
    free(copies);
    return result;
}

/* ---- where POV-Ray looks for files ---- */

static enum result add_directory(struct run *run, const char *path, struct error *err)
{
    char *absolute = realpath(path, NULL);
    if (!absolute)
        return RESULT_OK; /* POV-Ray too passes over a folder that isn't there */
    char **directories = realloc(run->directories, ((size_t)run->directory_count + 1) * sizeof *directories);
    if (!directories) {
        free(absolute);
        return error_memory(err, sizeof *directories);
    }
    run->directories = directories;
    directories[run->directory_count++] = absolute;
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
    for (int i = 0; !result && i < run->linked_count; i++) {
        char name[32];
        snprintf(name, sizeof name, "lib%d", i);
        result = work_folder_link(&run->folder, name, run->directories[i], err);
    }
    return result || !ini ? result : add_ini_directories(run, ini, err);
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

/* The user's switches first, then those on which the pass depends: POV-Ray takes the last one. */
static enum result job_arguments(const struct run *run, enum pass_id id, char ***arguments, struct error *err)
{
    const struct passes_options *options = run->options;
    const struct pass *pass = &passes[id];
    int count = 0;
    /* POV-Ray runs in a folder of its own. */
    char *program = strchr(options->povray, '/') ? realpath(options->povray, NULL) : NULL;
    enum result result = add_argument(arguments, &count, err, "%s", program ? program : options->povray);
    free(program);
    for (int i = 0; !result && i < options->switch_count; i++)
        result = add_switch(run, arguments, &count, i, err);
    if (!result)
        result = add_argument(arguments, &count, err, "%s", "+L../copies");
    for (int i = 0; !result && i < run->linked_count; i++) {
        char name[32];
        snprintf(name, sizeof name, "lib%d", i);
        result = add_argument(arguments, &count, err, "+L../%s", name);
    }
    static const char *const always[] = {"+Ipass.pov", "-D", "-P", "-C", "-UA", "+GA", "+V", NULL};
    static const char *const codes[] = {"+Oimage.png", "+FN16", "File_Gamma=1.0", "Dither=off", NULL};
    static const char *const radiance[] = {"+Oimage.exr", "+FE", NULL};
    for (int i = 0; !result && always[i]; i++)
        result = add_argument(arguments, &count, err, "%s", always[i]);
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

static enum result run_passes(struct run *run, const char *ini, struct error *err)
{
    const struct passes_options *options = run->options;
    char **arguments[PASS_COUNT] = {0}, *folders[PASS_COUNT] = {0}, *variable = NULL, **environment = NULL;
    enum result result = link_ini_files(run, err);
    for (int i = 0; !result && i < run->job_count; i++) {
        result = job_arguments(run, run->ids[i], &arguments[i], err);
        if (!result)
            result = text_printf(&folders[i], err, "%s/%s", run->folder.path, passes[run->ids[i]].name);
        run->jobs[i] = (struct povray_job){
            .name = passes[run->ids[i]].name, .folder = folders[i], .arguments = arguments[i]};
    }
    int variables = 0;
    while (environ[variables])
        variables++;
    if (!result && !(environment = calloc((size_t)variables + 2, sizeof *environment)))
        result = error_memory(err, variables);
    if (!result && ini)
        result = text_printf(&variable, err, "POVINI=%s", ini);
    int kept = 0;
    for (int i = 0; !result && i < variables; i++)
        if (strncmp(environ[i], "POVINI=", 7))
            environment[kept++] = environ[i];
    if (!result)
        environment[kept] = variable;
    int failed = -1, at_once = options->jobs > 0 ? options->jobs : (int)sysconf(_SC_NPROCESSORS_ONLN) + 2;
    if (!result)
        result = povray_run(run->jobs, run->job_count, at_once, environment, options->progress,
                            options->progress_context, &failed, err);
    if (failed >= 0)
        result = report_failure(run, &run->jobs[failed], err);
    for (int i = 0; i < run->job_count; i++) {
        for (char **argument = arguments[i]; argument && *argument; argument++)
            free(*argument);
        free(arguments[i]);
        free(folders[i]);
    }
    free(environment);
    free(variable);
    return result;
}

/* ---- the images ---- */

static enum result read_codes(const struct run *run, enum pass_id id, struct image *image, struct error *err)
{
    char *path;
    enum result result = text_printf(&path, err, "%s/%s/image.png", run->folder.path, passes[id].name);
    if (result)
        return result;
    result = png_read(path, image, err);
    free(path);
    return result;
}

static enum result read_radiance(const struct run *run, enum pass_id id, struct image *image, struct error *err)
{
    struct exr_contents contents = {0};
    char *path;
    enum result result = text_printf(&path, err, "%s/%s/image.exr", run->folder.path, passes[id].name);
    if (result)
        return result;
    result = exr_read(path, &contents, err);
    if (!result)
        result = image_alloc(image, contents.image.width, contents.image.height, 3, err);
    static const char *const names[] = {"R", "G", "B"};
    for (int channel = 0; !result && channel < 3; channel++) {
        int from = exr_find(&contents, names[channel]);
        if (from < 0)
            result = error_set(err, RESULT_POVRAY, "%s: has no channel %s", path, names[channel]);
        for (int y = 0; !result && y < image->height; y++)
            memcpy(image_row(image, channel, y), image_row(&contents.image, from, y),
                   (size_t)image->width * sizeof(float));
    }
    exr_contents_free(&contents);
    free(path);
    return result;
}

static enum result read_coded(const struct run *run, enum pass_id high_id, enum pass_id low_id, struct image *decoded,
                              struct error *err)
{
    struct image high = {0}, low = {0};
    enum result result = read_codes(run, high_id, &high, err);
    if (!result && low_id != high_id)
        result = read_codes(run, low_id, &low, err);
    if (!result)
        result = position_code_decode(&high, low_id != high_id ? &low : NULL, decoded, err);
    image_free(&high);
    image_free(&low);
    return result;
}

/* The pass is rendered under a sky of one half of the working space. */
static void scale_reflectance(struct image *reflectance, double gamma)
{
    for (int channel = 0; channel < 3; channel++)
        for (int y = 0; y < reflectance->height; y++) {
            float *row = image_row(reflectance, channel, y);
            for (int x = 0; x < reflectance->width; x++)
                row[x] = (float)(gamma_encode(gamma, row[x]) / 0.5);
        }
}

/* The exponent of a pixel whose code is (high, low, 1), see mirror_exponent. */
static float decode_exponent(double high, double low)
{
    double code = (round(65535 * high) + low) / 65535; /* a float holds the 16 bits, but not their quotient */
    return (float)fmax(expm1(128 * code * log(2)), 1e-6);
}

/* Codes of the exponents, where the scene has several; else an image of the positions' size. */
static enum result read_exponents(const struct run *run, struct gbuffer *gbuffer, struct image *codes, struct error *err)
{
    if (run->scene.exponent < 0) {
        enum result result = read_codes(run, PASS_EXPONENT, codes, err);
        if (result)
            return result;
    }
    const struct image *like = run->scene.exponent < 0 ? codes : &gbuffer->position;
    return image_alloc(&gbuffer->phong, like->width, like->height, 1, err);
}

static bool any_nonzero(const struct image *image, int x, int y)
{
    bool any = false;
    for (int channel = 0; channel < image->channels; channel++)
        any |= image_row(image, channel, y)[x] != 0;
    return any;
}

/* phong: 0 where the camera sees nothing glossy. */
static void fill_exponents(struct gbuffer *gbuffer, double single, const struct image *codes)
{
    for (int y = 0; y < gbuffer->phong.height; y++)
        for (int x = 0; x < gbuffer->phong.width; x++) {
            bool glossy = any_nonzero(&gbuffer->position, x, y) && any_nonzero(&gbuffer->endpoint, x, y);
            float exponent = 0;
            if (glossy && single >= 0)
                exponent = (float)fmax(single, 1e-6);
            else if (glossy && image_row(codes, 2, y)[x] > 0.5f)
                exponent = decode_exponent(image_row(codes, 0, y)[x], image_row(codes, 1, y)[x]);
            image_row(&gbuffer->phong, 0, y)[x] = exponent >= 1e20f ? INFINITY : exponent;
        }
}

/* Where nothing is glossy a is 0 and so is b: the passes file holds what the filter needs. */
static void clear_unused(struct gbuffer *gbuffer)
{
    for (int y = 0; y < gbuffer->phong.height; y++)
        for (int x = 0; x < gbuffer->phong.width; x++) {
            if (image_row(&gbuffer->phong, 0, y)[x] > 0)
                continue;
            for (int channel = 0; channel < 4; channel++) {
                image_row(&gbuffer->endpoint, channel, y)[x] = 0;
                if (channel < 3) {
                    image_row(&gbuffer->position, channel, y)[x] = 0;
                    image_row(&gbuffer->specular, channel, y)[x] = 0;
                }
            }
        }
}

static enum result drop_w(struct image *image, struct error *err)
{
    struct image three;
    enum result result = image_alloc(&three, image->width, image->height, 3, err);
    if (result)
        return result;
    memcpy(three.pixels, image->pixels, three.stride * (size_t)three.height * 3 * sizeof(float));
    image_free(image);
    *image = three;
    return RESULT_OK;
}

/* The passes of full size are as large as the base, the others as its subsampling says. */
static enum result check_sizes(const struct run *run, const struct gbuffer *gbuffer, const struct image *directions,
                               struct error *err)
{
    const struct {
        const struct image *image;
        const char *pass;
        int step;
    } images[] = {
        {&gbuffer->reflectance, "reflectance", 1},
        {&gbuffer->specular, "specular", run->options->subsample},
        {&gbuffer->position, "position", run->options->subsample},
        {&gbuffer->endpoint, "endpoint", run->options->subsample},
        {directions, "direction", run->options->subsample},
        {&gbuffer->phong, "exponent", run->options->subsample},
    };
    const struct image *base = &gbuffer->base;
    for (size_t i = 0; i < sizeof images / sizeof *images; i++) {
        int width = base->width / images[i].step, height = base->height / images[i].step;
        if (images[i].image->width != width || images[i].image->height != height)
            return error_set(err, RESULT_DATA,
                             "%s: POV-Ray's image of the %s pass is %dx%d, and %dx%d goes with the base: give +W and +H",
                             run->options->scene, images[i].pass, images[i].image->width, images[i].image->height, width,
                             height);
    }
    return RESULT_OK;
}

static void note_invisible(const struct gbuffer *gbuffer, const char *scene, struct error *note)
{
    for (int y = 0; y < gbuffer->phong.height; y++)
        for (int x = 0; x < gbuffer->phong.width; x++)
            if (image_row(&gbuffer->phong, 0, y)[x] > 0)
                return;
    error_set(note, RESULT_OK,
              "%s: the camera sees no glossy surface: does the finish with Gloss() reflect, and is it used?", scene);
}

static enum result read_images(const struct run *run, struct gbuffer *gbuffer, struct error *note, struct error *err)
{
    struct image directions = {0}, codes = {0};
    enum result result = read_radiance(run, PASS_BASE, &gbuffer->base, err);
    if (!result)
        result = read_radiance(run, PASS_SPECULAR, &gbuffer->specular, err);
    if (!result)
        result = read_radiance(run, PASS_REFLECTANCE, &gbuffer->reflectance, err);
    if (!result)
        result = read_coded(run, PASS_POSITION, PASS_POSITION_LOW, &gbuffer->position, err);
    if (!result)
        result = drop_w(&gbuffer->position, err);
    if (!result)
        result = read_coded(run, PASS_ENDPOINT, PASS_ENDPOINT_LOW, &gbuffer->endpoint, err);
    if (!result)
        result = read_coded(run, PASS_DIRECTION, PASS_DIRECTION, &directions, err);
    if (!result)
        result = read_exponents(run, gbuffer, &codes, err);
    if (!result)
        result = check_sizes(run, gbuffer, &directions, err);
    if (!result) {
        fill_exponents(gbuffer, run->scene.exponent, &codes);
        scale_reflectance(&gbuffer->reflectance, run->scene.working_gamma);
        gbuffer->working_gamma = run->scene.working_gamma == 1 ? 0 : (float)run->scene.working_gamma;
        eye_find(gbuffer, &directions);
        clear_unused(gbuffer);
        note_invisible(gbuffer, run->options->scene, note);
        if (run->options->subsample > 1)
            result = interpolate_gbuffer(gbuffer, err);
    }
    image_free(&directions);
    image_free(&codes);
    return result;
}

static enum result check_scene(const struct run *run, struct error *note, struct error *err)
{
    const struct scene *scene = &run->scene;
    if (scene->gloss_calls == 0)
        return error_set(err, RESULT_DATA,
                         "%s: nothing in this scene is glossy: write #include \"povgloss.inc\", and Gloss(300) in a finish "
                         "that has a reflection",
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
        result = find_directories(&run, ini, err);
    if (!result)
        result = scene_load(&run.scene, options->scene, (const char *const *)run.directories, run.directory_count, err);
    if (!result)
        result = check_scene(&run, note, err);
    if (!result)
        result = write_scenes(&run, err);
    if (!result)
        result = run_passes(&run, ini, err);
    if (!result)
        result = read_images(&run, gbuffer, note, err);
    if (result)
        gbuffer_free(gbuffer);
    povray_jobs_free(run.jobs, run.job_count);
    scene_free(&run.scene);
    for (int i = 0; i < run.directory_count; i++)
        free(run.directories[i]);
    free(run.directories);
    free(ini);
    work_folder_remove(&run.folder);
    return result;
}
