/* povgloss: a POV-Ray scene in, its glossy image (render), its passes file (passes) or true values of it (probe) out.
 *
 * The command line mixes POV-Ray's switches, which are passed through, with options of two hyphens.
 */
#include "cli.h"
#include "depfile.h"
#include "interrupt.h"
#include "output_file.h"
#include "own_files.h"
#include "passes.h"
#include "passes_file.h"
#include "povray_switches.h"
#include "probe_file.h"
#include "scene_list.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char help[] =
    "usage: povgloss render SCENE.pov [POV-Ray switches] [options] -o IMAGE\n"
    "       povgloss passes SCENE.pov [POV-Ray switches] [options] -o PASSES.exr\n"
    "       povgloss list SCENE.pov [POV-Ray switches]\n"
    "       povgloss probe SCENE.pov [POV-Ray switches] [options] -o PROBES.csv\n"
    "       povgloss brute SCENE.pov [POV-Ray switches] [options] -o IMAGE\n"
    "       povgloss compare PROBES.csv IMAGE.exr [--phong P]\n"
    "\n"
    "Glossy reflections for POV-Ray scenes that say Gloss(300) in a finish (povgloss.inc).\n"
    "render draws the glossy image; passes writes what glossfilter needs to draw it, again and again;\n"
    "list shows the finishes that reflect, and the exponent that each has or that --gloss auto gives it.\n"
    "probe measures the true blurred reflection at a grid of pixels, by thousands of POV-Ray's rays each;\n"
    "brute draws the glossy image by so many rays at every pixel, without a filter: slow and noisy;\n"
    "compare tells how far an image that was filtered with --layers is from it.\n"
    "POV-Ray's switches (+W640 +H480 +A0.3 +Ldir Declare=x=1 file.ini[section]) go to POV-Ray as they are.\n"
    "An animation (+KFF30) is drawn frame by frame, into files numbered as POV-Ray numbers them.\n"
    "\n"
    "Scene:\n"
    "  --gloss NAME=P       make a declared texture, finish or material glossy, P being its Phong exponent\n"
    "                       (inf: a mirror); may be given again; wins over the scene's Gloss()\n"
    "  --gloss auto         every finish with a reflection and phong_size (P is the same) or roughness\n"
    "                       (P is 1/(4 roughness), the lobe of POV-Ray's highlight)\n"
    "  --gloss all=P        every finish that reflects, but for those above\n"
    "  --from-scene         take POV-Ray's switches from the first comment like // +W640 +H480 +A0.3\n"
    "                       in the scene's first 50 lines; those on the command line come after it\n"
    "  --resume             skip every image whose file is there already\n"
    "  --subsample N        trace the reflection at every 1 (default), 2 or 4 pixels only, and\n"
    "                       interpolate; needs +W and +H\n"
    "  --jobs N             POV-Ray processes at the same time; 0: two more than processors (default)\n"
    "  --timeout SECONDS    end a POV-Ray process that runs longer, and fail; 0: never (default)\n"
    "  --no-check           don't compare the sum of the passes with a small picture by POV-Ray itself\n"
    "  --depfile FILE       write a make rule that names every file the scene read, but the system's\n"
    "  --keep DIR           leave the rewritten scenes and POV-Ray's images in DIR\n"
    "  --povray PROGRAM     the POV-Ray program (default povray)\n";

static const char help_end[] =
    "  -o, --output FILE    where to write; - is standard output\n"
    "  -h, --help           this text\n"
    "  --version            the version\n"
    "  --print-include-dir  the folder of povgloss.inc: povray +L$(povgloss --print-include-dir) ...\n"
    "Probes:\n"
    "  --grid N             probes across the picture's width (default 32), rows as far apart\n"
    "  --error E            rays are added until the 95 % confidence interval is within +-E, for values\n"
    "                       above 1 within +-E of the value (default 0.002)\n"
    "  --phong P            in place of the scene's exponent; may be given again: each is measured\n"
    "  --samples N          of brute: rays at every pixel, 1 to 65536 (default 64)\n"
    "  --seed N             of the random directions (default 0)\n"
    "\n"
    "Exit status: 0 ok, 2 wrong command line, 3 file, data or memory, 4 POV-Ray failed.\n";

enum kind { KIND_RENDER, KIND_PASSES, KIND_LIST, KIND_PROBE, KIND_BRUTE, KIND_COMPARE, KIND_NONE };

static const char *const kind_names[] = {"render", "passes", "list", "probe", "brute", "compare"};

struct command {
    enum kind kind;
    const char *scene, *output;
    const char *image; /* to compare with the probes, whose file is the scene then */
    struct probe_options probe;
    struct buffer exponents; /* of doubles, for the probes */
    const char *depfile; /* NULL: none */
    struct buffer reads; /* for its rule: what the outputs were made from, */
    struct text_list outputs; /* and their names */
    char *path; /* of the scene */
    struct passes_options passes;
    bool from_scene, resume, no_check;
    struct cli_filter filter;
    bool filter_options_used;
    bool lobe_options_used; /* those of the filter that say nothing of the output */
    bool help, version, print_include_dir;
};

static enum result take_scene(struct command *command, const char *scene, struct error *err)
{
    if (command->kind == KIND_COMPARE && command->scene && !command->image) {
        command->image = scene;
        return RESULT_OK;
    }
    if (command->kind == KIND_COMPARE && command->scene)
        return error_set(err, RESULT_USAGE, "povgloss compare needs two files, and not %s too", scene);
    if (command->scene)
        return error_set(err, RESULT_USAGE, "two scenes, %s and %s: give one", command->scene, scene);
    command->scene = scene;
    return RESULT_OK;
}

/* Options without a value. */
static bool take_flag(const char *argument, struct command *command)
{
    const struct {
        const char *name;
        bool *flag;
    } flags[] = {
        {"-h", &command->help},
        {"--help", &command->help},
        {"--version", &command->version},
        {"--print-include-dir", &command->print_include_dir},
        {"--from-scene", &command->from_scene},
        {"--resume", &command->resume},
        {"--no-check", &command->no_check},
    };
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        if (!strcmp(argument, flags[i].name))
            return *flags[i].flag = true;
    return false;
}

/* Options of povgloss alone; *taken is false if argv[*index] is none of them. */
static enum result take_own_option(int argc, char **argv, int *index, struct command *command, bool *taken,
                                   struct error *err)
{
    const struct {
        const char *name;
        const char **text;
        int *number, low, high;
    } options[] = {
        {"-o", &command->output, NULL, 0, 0},
        {"--output", &command->output, NULL, 0, 0},
        {"--depfile", &command->depfile, NULL, 0, 0},
        {"--keep", &command->passes.keep, NULL, 0, 0},
        {"--povray", &command->passes.povray, NULL, 0, 0},
        {"--jobs", NULL, &command->passes.jobs, 0, 64},
        {"--timeout", NULL, &command->passes.timeout_s, 0, 10000000},
        {"--subsample", NULL, &command->passes.subsample, 1, 4},
    };
    const char *value;
    enum result result = cli_value(argc, argv, index, "--gloss", &value, err);
    *taken = value;
    if (result || value)
        return result ? result : gloss_choice_take(&command->passes.gloss, value, err);
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        result = cli_value(argc, argv, index, options[i].name, &value, err);
        if (result)
            return result;
        if (!value)
            continue;
        *taken = true;
        if (options[i].text)
            *options[i].text = value;
        else
            result = cli_integer(options[i].name, value, options[i].low, options[i].high, options[i].number, err);
        if (!result && command->passes.subsample == 3)
            result = error_set(err, RESULT_USAGE, "--subsample 3: 1, 2 or 4 is allowed");
        return result;
    }
    return RESULT_OK;
}

/* Options of povgloss probe, brute and compare alone; *taken as above. */
static enum result take_probe_option(int argc, char **argv, int *index, struct command *command, bool *taken,
                                     struct error *err)
{
    const struct {
        const char *name;
        unsigned kinds;
        double low, high;
        double *number;
        int *whole;
    } options[] = {
        {"--phong", 1u << KIND_PROBE | 1u << KIND_BRUTE | 1u << KIND_COMPARE, 0, INFINITY, NULL, NULL},
        {"--error", 1u << KIND_PROBE, 1e-6, 1, &command->probe.error, NULL},
        {"--grid", 1u << KIND_PROBE, 1, IMAGE_MAX_SIDE, NULL, &command->probe.grid},
        {"--samples", 1u << KIND_BRUTE, 1, 65536, NULL, &command->probe.rays},
        {"--seed", 1u << KIND_PROBE | 1u << KIND_BRUTE, 0, 1e9, NULL, &command->probe.seed},
    };
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        if (!(options[i].kinds & 1u << command->kind))
            continue;
        const char *value;
        double number;
        enum result result = cli_value(argc, argv, index, options[i].name, &value, err);
        if (result || !value) {
            if (result)
                return result;
            continue;
        }
        *taken = true;
        if (options[i].whole)
            return cli_integer(options[i].name, value, (int)options[i].low, (int)options[i].high, options[i].whole,
                               err);
        result = cli_number(options[i].name, value, options[i].low, options[i].high, &number, err);
        if (!result && options[i].number)
            *options[i].number = number;
        else if (!result)
            result = buffer_add(&command->exponents, &number, sizeof number, err);
        return result;
    }
    return RESULT_OK;
}

static enum result take_argument(int argc, char **argv, int *index, struct command *command,
                                 struct povray_switches *switches, struct error *err)
{
    const char *argument = argv[*index];
    bool taken = false;
    if (take_flag(argument, command)) {
        ++*index;
        return RESULT_OK;
    }
    enum result result = take_own_option(argc, argv, index, command, &taken, err);
    if (!result && !taken)
        result = take_probe_option(argc, argv, index, command, &taken, err);
    if (result || taken)
        return result;
    result = cli_filter_option(argc, argv, index, &command->filter, &taken, err);
    if (result || taken) {
        bool says = !strcmp(argument, "--quiet") || !strcmp(argument, "-q") || !strcmp(argument, "--timings");
        bool writes = !strcmp(argument, "--layers") || !strncmp(argument, "--format", 8) ||
                      !strncmp(argument, "--bits", 6);
        command->filter_options_used |= !says;
        command->lobe_options_used |= !says && !writes;
        return result;
    }
    ++*index;
    if (povray_switch_is(argument))
        return povray_switch_take(switches, argument, err);
    if (argument[0] == '-' && argument[1])
        return error_set(err, RESULT_USAGE, "unknown option %s: see povgloss --help", argument);
    return take_scene(command, argument, err);
}

static bool is_stream(const char *path)
{
    struct stat there;
    return !strcmp(path, "-") || (!stat(path, &there) && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode));
}

/* The scene that the command line names, or else an .ini file. */
static enum result find_scene(struct command *command, const struct povray_switches *switches, struct error *err)
{
    if (switches->scene) {
        enum result result = take_scene(command, switches->scene, err);
        if (result)
            return result;
    }
    const char *scene = command->scene ? command->scene : switches->file_scene;
    if (!scene)
        return error_set(err, RESULT_USAGE, "no scene: name a .pov file");
    if (command->from_scene && is_stream(scene))
        return error_set(err, RESULT_USAGE, "--from-scene reads the scene twice: name its file in place of %s", scene);
    if (is_stream(scene))
        return text_printf(&command->path, err, "%s", scene);
    return povray_switches_find_scene(switches, scene, &command->path, err);
}

static enum result check_probe(const struct command *command, struct error *err)
{
    const char *name = kind_names[command->kind];
    bool filters = command->kind == KIND_BRUTE ? command->lobe_options_used : command->filter_options_used;
    if (filters || command->depfile || command->resume || command->passes.subsample > 1)
        return error_set(err, RESULT_USAGE,
                         "povgloss %s neither filters nor subsamples, and has no --depfile and no --resume", name);
    if (frames_count(&command->passes.frames) > 1)
        return error_set(err, RESULT_USAGE, "povgloss %s draws one frame: name it (+SF1 +EF1)", name);
    if (command->kind == KIND_BRUTE && command->exponents.size > sizeof(double))
        return error_set(err, RESULT_USAGE, "povgloss brute: an image has one --phong");
    if (command->kind == KIND_PROBE && !strcmp(command->output, "-") && isatty(STDOUT_FILENO))
        return error_set(err, RESULT_USAGE, "standard output is a terminal: redirect it, or name a file with -o");
    return command->kind == KIND_BRUTE ? cli_check_output(command->output, &command->filter, err) : RESULT_OK;
}

static enum result check_command(struct command *command, const struct povray_switches *switches, struct error *err)
{
    if (command->kind == KIND_LIST && (command->output || command->filter_options_used || command->depfile ||
                                       command->passes.keep || command->resume))
        return error_set(err, RESULT_USAGE,
                         "povgloss list takes a scene and POV-Ray's switches, and writes to standard output");
    if (command->kind == KIND_LIST)
        return RESULT_OK;
    if (!command->output)
        return error_set(err, RESULT_USAGE, "no output: add -o FILE (or -o - for standard output)");
    if (command->kind == KIND_PROBE || command->kind == KIND_BRUTE)
        return check_probe(command, err);
    if (command->depfile && !strcmp(command->output, "-"))
        return error_set(err, RESULT_USAGE, "--depfile needs the output's name for its rule: -o - has none");
    if (command->depfile && command->resume)
        return error_set(err, RESULT_USAGE,
                         "--depfile tells what every image was made from, and --resume skips some: leave one of them out");
    if (command->kind == KIND_PASSES && command->filter_options_used)
        return error_set(err, RESULT_USAGE, "povgloss passes doesn't filter: give the filter's options to glossfilter");
    int step = command->passes.subsample, count = frames_count(&command->passes.frames);
    if (count > 1 && is_stream(command->output))
        return error_set(err, RESULT_USAGE,
                         "%s takes one image, and the animation has %d: name a file, or one frame (+SF1 +EF1)",
                         output_file_name(command->output), count);
    if (step > 1 && (switches->width == 0 || switches->height == 0 || switches->width % step || switches->height % step))
        return error_set(err, RESULT_USAGE, "--subsample %d needs +W and +H, both multiples of %d", step, step);
    if (command->kind == KIND_PASSES) {
        enum image_format format;
        struct error ignored;
        if (!image_format_choose(command->output, NULL, &format, &ignored) && format != IMAGE_FORMAT_EXR)
            return error_set(err, RESULT_USAGE, "%s: passes need an EXR file: end the name in .exr", command->output);
        command->filter.format = "exr";
    }
    return RESULT_OK;
}

static enum result take_arguments(int argc, char **argv, struct command *command, struct povray_switches *switches,
                                  struct error *err)
{
    *command = (struct command){.kind = KIND_RENDER,
                                .probe = {.grid = 32, .error = 0.002},
                                .passes = {.povray = "povray", .subsample = 1},
                                .filter = cli_filter_default()};
    while (command->kind < KIND_NONE && strcmp(argv[1], kind_names[command->kind]) != 0)
        command->kind++;
    bool has_command = command->kind < KIND_NONE;
    if (!has_command && argv[1][0] != '-')
        return error_set(err, RESULT_USAGE,
                         "unknown command %s: render, passes, list, probe, brute or compare, see povgloss --help",
                         argv[1]);
    enum result result = RESULT_OK;
    for (int index = 1 + has_command; !result && index < argc;)
        result = take_argument(argc, argv, &index, command, switches, err);
    if (!result && !has_command && !command->help && !command->version && !command->print_include_dir)
        result = error_set(err, RESULT_USAGE, "no command: write render, passes or list first, see povgloss --help");
    return result;
}

static enum result check_comparison(const struct command *command, struct error *err)
{
    const struct passes_options *passes = &command->passes;
    if (command->output || command->filter_options_used || command->depfile || passes->keep || command->resume ||
        command->from_scene || passes->subsample > 1 || passes->gloss.automatic || passes->gloss.all)
        return error_set(err, RESULT_USAGE,
                         "povgloss compare takes probes, an image and --phong, and writes to standard output");
    if (!command->image)
        return error_set(err, RESULT_USAGE, "povgloss compare needs two files: PROBES.csv and IMAGE.exr");
    if (command->exponents.size > sizeof(double))
        return error_set(err, RESULT_USAGE, "povgloss compare: an image has one --phong");
    return RESULT_OK;
}

/* The switches of the scene's comment come before those of the command line: the last one counts. */
static enum result take_comment(int argc, char **argv, struct command *command, struct povray_switches *switches,
                                struct error *err)
{
    struct error line;
    char *path = command->path, *text = NULL;
    povray_switches_free(switches);
    gloss_choice_free(&command->passes.gloss);
    buffer_free(&command->exponents);
    enum result result = povray_switches_begin(switches, err);
    if (!result)
        result = povray_switches_take_comment(switches, path, &text, err);
    if (!result)
        result = take_arguments(argc, argv, command, switches, err);
    command->path = path;
    if (!result && !command->filter.quiet) {
        error_set(&line, RESULT_OK, "%s", text);
        cli_complain("povgloss", &line);
    }
    free(text);
    return result;
}

static enum result parse(int argc, char **argv, struct command *command, struct povray_switches *switches,
                         struct error *err)
{
    if (argc < 2)
        return error_set(err, RESULT_USAGE, "no command: povgloss render SCENE -o IMAGE, or see povgloss --help");
    enum result result = povray_switches_begin(switches, err);
    if (!result)
        result = take_arguments(argc, argv, command, switches, err);
    if (result || command->help || command->version || command->print_include_dir)
        return result;
    if (command->kind == KIND_COMPARE)
        return check_comparison(command, err);
    result = find_scene(command, switches, err);
    if (!result && command->from_scene)
        result = take_comment(argc, argv, command, switches, err);
    command->passes.scene = command->path;
    command->passes.switches = switches;
    command->passes.reads = command->depfile;
    command->passes.check = !command->no_check && !command->filter.quiet && command->kind <= KIND_PASSES;
    command->passes.frames = frames_plan(&switches->frames);
    return result ? result : check_command(command, switches, err);
}

/* A bar that is drawn again on a terminal, and a line for every quarter elsewhere. */
struct progress {
    bool terminal;
    const char *frame; /* "frame 3: ", or empty */
    int shown;         /* percent; -1: nothing yet */
};

static void show_progress(void *context, double done)
{
    struct progress *progress = context;
    int percent = (int)(100 * done), step = progress->terminal ? 1 : 25;
    if (percent / step == progress->shown / step && progress->shown >= 0)
        return;
    progress->shown = percent;
    if (!progress->terminal) {
        fprintf(stderr, "povgloss: %srendering passes, %d %%\n", progress->frame, percent / 25 * 25);
        return;
    }
    char bar[41];
    for (int i = 0; i < 40; i++)
        bar[i] = i < percent * 40 / 100 ? '#' : '.';
    bar[40] = 0;
    fprintf(stderr, "\rpovgloss: %spasses [%s] %3d %%%s", progress->frame, bar, percent, percent == 100 ? "\n" : "");
    fflush(stderr);
}

static void no_progress(void *context, double done)
{
    (void)context;
    (void)done;
}

/* A file that can't be made is told before the passes are rendered. Devices and pipes are opened only when they are
 * written. */
static enum result check_place(const char *path, struct error *err)
{
    struct output_file file;
    if (is_stream(path))
        return RESULT_OK;
    enum result result = output_file_open(&file, path, err);
    if (!result)
        output_file_abort(&file);
    return result;
}

static enum result list(const struct command *command, struct error *err)
{
    struct scene scene = {0};
    struct buffer text = {0};
    int count = 0;
    enum result result = passes_load_scene(&command->passes, &scene, err);
    if (!result)
        result = scene_list(&scene, &text, &count, err);
    if (!result && count > 0 && (fputs(text.data, stdout) < 0 || fflush(stdout)))
        result = error_set(err, RESULT_DATA, "standard output: cannot be written");
    if (!result && scene.needs_discovery)
        fprintf(stderr,
                "povgloss: warning: %s: files that are included by names that POV-Ray computes aren't looked into\n",
                command->path);
    if (!result && count == 0)
        fprintf(stderr, "povgloss: %s: no finish reflects\n", command->path);
    buffer_free(&text);
    scene_free(&scene);
    return result;
}

static void warn(const struct command *command, const char *frame, const struct error *note)
{
    struct error warning;
    if (!note->text[0] || command->filter.quiet)
        return;
    error_set(&warning, RESULT_OK, "%s%s", frame, note->text);
    cli_complain("povgloss: warning", &warning);
}

/* A folder that stays is no failure of the picture, but must not stay unknown. */
static void close_passes(struct passes **passes)
{
    struct error warning;
    if (passes_close(*passes, &warning))
        cli_complain("povgloss: warning", &warning);
    *passes = NULL;
}

/* One image to `path`; `frame` names it in messages. */
static enum result draw_frame(struct command *command, struct passes **passes, int number, const char *frame,
                              const char *path, struct error *err)
{
    const struct frames *frames = &command->passes.frames;
    bool last = number + frames->step > frames->last;
    struct progress progress = {.terminal = isatty(STDERR_FILENO), .frame = frame, .shown = -1};
    struct gbuffer gbuffer = {0};
    struct error note;

    /* 1. refuse what can't be written, before the work */
    enum result result = check_place(path, err);

    /* 2. the passes, from POV-Ray; the first frame reads the scene for all */
    command->passes.progress = command->filter.quiet ? no_progress : show_progress;
    command->passes.progress_context = &progress;
    if (!result && !*passes) {
        result = passes_open(&command->passes, passes, &note, err);
        if (!result)
            warn(command, "", &note);
    }
    if (!result)
        result = passes_render(*passes, number, &gbuffer, &note, err);
    if (result && progress.terminal && !command->filter.quiet && progress.shown >= 0 && progress.shown < 100)
        fputc('\n', stderr);
    if (!result)
        warn(command, frame, &note);
    if (!result)
        result = passes_check_sum(*passes, number, &gbuffer, &note, err);
    if (!result)
        warn(command, frame, &note);
    if (!result && last && command->depfile)
        result = passes_reads(*passes, &command->reads, err);
    /* A pipe whose reader went away ends the program as it writes: no folder is there then. */
    if (last)
        close_passes(passes);

    /* 3. the passes file, or the picture by the filter */
    if (!result && command->kind == KIND_PASSES) {
        struct timings_moment start = timings_now();
        result = passes_file_write(path, &gbuffer, err);
        timings_add(command->filter.timings, "write", start);
    } else if (!result) {
        result = cli_draw(path, &command->filter, &gbuffer, err);
    }
    gbuffer_free(&gbuffer);
    return result;
}

static enum result run(struct command *command, struct error *err)
{
    const struct frames *frames = &command->passes.frames;
    struct passes *passes = NULL;
    enum result result = cli_check_output(command->output, &command->filter, err);
    if (!result && command->depfile)
        result = depfile_check_name(command->output, err);
    if (!result && command->depfile)
        result = check_place(command->depfile, err);
    for (int number = frames->first; !result && number <= frames->last; number += frames->step) {
        char frame[32] = "", *path = NULL;
        struct stat there;
        if (frames->digits > 0)
            snprintf(frame, sizeof frame, "frame %d: ", number);
        result = is_stream(command->output) ? text_printf(&path, err, "%s", command->output)
                                            : frames_path(frames, command->output, number, &path, err);
        if (!result && !(command->resume && !stat(path, &there) && S_ISREG(there.st_mode))) {
            result = draw_frame(command, &passes, number, frame, path, err);
            struct error cause = *err;
            if (result)
                error_set(err, result, "%s%s", frame, cause.text);
        }
        if (!result && command->depfile)
            result = text_list_add(&command->outputs, err, "%s", path);
        free(path);
    }
    close_passes(&passes);
    return result || !command->depfile ? result
                                       : depfile_write(command->depfile, &command->outputs, &command->reads, err);
}

static enum result print_include_dir(struct error *err)
{
    char *path;
    enum result result = own_file("share/povgloss/include", &path, err);
    if (!result)
        puts(path);
    free(path);
    return result;
}

/* Rounds of rays until every probe is exact enough, or has as many as are allowed. */
static enum result measure(const struct command *command, struct passes *passes, struct probes *probes,
                           struct error *err)
{
    enum result result = RESULT_OK;
    long round = 0;
    while (!result && probes_left(probes)) {
        struct buffer view = {0};
        struct image image = {0};
        int width, height;
        if (round != probes->rays && !command->filter.quiet)
            fprintf(stderr, "povgloss: %d probes of %ld rays\n", probes_open(probes), probes->rays);
        round = probes->rays;
        result = probes_view(probes, &view, &width, &height, err);
        if (!result)
            result = passes_view(passes, command->passes.frames.first, &view, width, height, &image, err);
        if (!result)
            result = probes_take(probes, &image, err);
        image_free(&image);
        buffer_free(&view);
    }
    return result;
}

static enum result draw_probes(const struct command *command, const struct probes *probes,
                               const struct gbuffer *gbuffer, struct error *err)
{
    struct image glossy = {0};
    enum result result = probes_image(probes, gbuffer, &glossy, err);
    if (!result)
        result = cli_write(command->output, &command->filter, gbuffer, &glossy, NULL, err);
    image_free(&glossy);
    return result;
}

/* probe, and brute: that measures every pixel. */
static enum result probe(struct command *command, struct error *err)
{
    struct progress progress = {.terminal = isatty(STDERR_FILENO), .frame = "", .shown = -1};
    struct passes *passes = NULL;
    struct gbuffer gbuffer = {0};
    struct probes probes = {0};
    struct error note;
    enum result result = check_place(command->output, err);
    command->passes.progress = command->filter.quiet ? no_progress : show_progress;
    command->passes.progress_context = &progress;
    command->passes.rays = true;
    if (command->kind == KIND_BRUTE) {
        command->probe.grid = IMAGE_MAX_SIDE;
        command->probe.rays = command->probe.rays ? command->probe.rays : 64;
    }
    command->probe.exponents = (const double *)(const void *)command->exponents.data;
    command->probe.exponent_count = (int)(command->exponents.size / sizeof(double));
    if (!result)
        result = passes_open(&command->passes, &passes, &note, err);
    if (!result)
        warn(command, "", &note);
    if (!result)
        result = passes_render(passes, command->passes.frames.first, &gbuffer, &note, err);
    if (!result)
        warn(command, "", &note);
    if (!result)
        result = probes_begin(&probes, &gbuffer, &command->probe, err);
    if (!result)
        result = measure(command, passes, &probes, err);
    close_passes(&passes);
    int left = result || command->kind == KIND_BRUTE ? 0 : probes_open(&probes);
    if (left > 0)
        error_set(&note, RESULT_OK,
                  "%s: %d of %d probes have a larger error than %g after %d rays: see their column error",
                  command->path, left, probes.count, command->probe.error, PROBE_MOST_RAYS);
    if (left > 0)
        warn(command, "", &note);
    if (!result)
        result = command->kind == KIND_BRUTE ? draw_probes(command, &probes, &gbuffer, err)
                                             : probe_file_write(command->output, &probes, err);
    probes_free(&probes);
    gbuffer_free(&gbuffer);
    return result;
}

static enum result compare(const struct command *command, struct error *err)
{
    struct probe_comparison found;
    const double *phong = (const double *)(const void *)command->exponents.data;
    enum result result = probe_file_compare(command->scene, command->image, phong ? *phong : -1, &found, err);
    if (!result)
        printf("probes %d\nrmse %.6g\nbias %.6g\nmedian %.6g\np95 %.6g\nworst %.6g\nworst_at %d,%d\nnoise %.6g\n",
               found.count, found.rmse, found.bias, found.median, found.percentile_95, found.worst, found.worst_x,
               found.worst_y, found.noise);
    if (!result && (fflush(stdout) || ferror(stdout)))
        result = error_set(err, RESULT_DATA, "standard output: cannot be written");
    return result;
}

int main(int argc, char **argv)
{
    struct command command = {0};
    struct povray_switches switches = {0};
    struct timings timings = timings_begin();
    struct error err;
    interrupt_install();
    enum result result = parse(argc, argv, &command, &switches, &err);
    command.passes.timings = command.filter.timings = &timings;
    if (!result && command.help)
        printf("%s%s%s", help, cli_filter_help, help_end);
    else if (!result && command.version)
        printf("povgloss %s\n", POVGLOSS_VERSION);
    else if (!result && command.print_include_dir)
        result = print_include_dir(&err);
    else if (!result && command.kind == KIND_LIST)
        result = list(&command, &err);
    else if (!result && (command.kind == KIND_PROBE || command.kind == KIND_BRUTE))
        result = probe(&command, &err);
    else if (!result && command.kind == KIND_COMPARE)
        result = compare(&command, &err);
    else if (!result)
        result = run(&command, &err);
    if (!result && command.filter.show_timings)
        timings_print(&timings, stderr);
    if (!result && (command.help || command.version || command.print_include_dir) && (fflush(stdout) || ferror(stdout)))
        result = error_set(&err, RESULT_DATA, "standard output: cannot be written");
    free(command.path);
    buffer_free(&command.reads);
    buffer_free(&command.exponents);
    text_list_free(&command.outputs);
    povray_switches_free(&switches);
    gloss_choice_free(&command.passes.gloss);
    if (result == RESULT_INTERRUPTED)
        interrupt_reraise();
    if (result)
        cli_complain("povgloss", &err);
    return (int)result;
}
