/* One argument at a time: a flag, an option of povgloss, one of the filter, a switch of POV-Ray's, or the scene. */
#include "command.h"

#include "output_file.h"
#include "povray_switches.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *const kind_names[] = {"render", "passes", "list", "probe", "brute", "compare"};

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
        {"--sandbox", &command->passes.sandbox},
        {"--no-means", &command->no_means},
        {"--no-check", &command->no_check},
    };
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        if (!strcmp(argument, flags[i].name))
            return *flags[i].flag = true;
    return false;
}

/* --margin 10% or --margin 64, in pixels. */
static enum result take_margin(const char *value, struct passes_options *passes, struct error *err)
{
    size_t length = strlen(value);
    char *number = strndup(value, length > 0 && value[length - 1] == '%' ? length - 1 : length);
    if (!number)
        return error_memory(err, (double)length);
    double percent;
    enum result result = RESULT_OK;
    passes->margin = 0;
    passes->margin_px = 0;
    if (strlen(number) == length) {
        result = cli_integer("--margin", number, 0, IMAGE_MAX_SIDE / 2, &passes->margin_px, err);
    } else if (!(result = cli_number("--margin", number, 0, 100, &percent, err))) {
        passes->margin = percent / 100;
    }
    free(number);
    return result;
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
        {"--rays", NULL, &command->rays, 0, 4096},
    };
    const char *value;
    enum result result = cli_value(argc, argv, index, "--gloss", &value, err);
    *taken = value;
    if (result || value)
        return result ? result : gloss_choice_take(&command->passes.gloss, value, err);
    result = cli_value(argc, argv, index, "--margin", &value, err);
    *taken = value;
    if (result || value)
        return result ? result : take_margin(value, &command->passes, err);
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
        if (!result && command->rays && command->kind > KIND_PASSES)
            result = error_set(err, RESULT_USAGE, "--rays is an option of povgloss render and povgloss passes");
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
    enum cli_option option;
    result = cli_filter_option(argc, argv, index, &command->filter, &option, err);
    if (result || option) {
        command->filter_options_used |= option == CLI_OPTION_FILTER;
        command->output_options_used |= option == CLI_OPTION_OUTPUT;
        return result;
    }
    ++*index;
    if (povray_switch_is(argument))
        return povray_switch_take(switches, argument, err);
    if (argument[0] == '-' && argument[1])
        return error_set(err, RESULT_USAGE, "unknown option %s: see povgloss --help", argument);
    return take_scene(command, argument, err);
}

bool command_is_stream(const char *path)
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
    if (command->from_scene && command_is_stream(scene))
        return error_set(err, RESULT_USAGE, "--from-scene reads the scene twice: name its file in place of %s", scene);
    if (command_is_stream(scene))
        return text_printf(&command->path, err, "%s", scene);
    return povray_switches_find_scene(switches, scene, &command->path, err);
}

static enum result check_probe(const struct command *command, struct error *err)
{
    const char *name = kind_names[command->kind];
    const struct passes_options *passes = &command->passes;
    if (command->filter_options_used || (command->kind == KIND_PROBE && command->output_options_used) ||
        command->depfile || command->resume || passes->subsample > 1 || passes->margin > 0 || passes->margin_px > 0)
        return error_set(err, RESULT_USAGE,
                         "povgloss %s neither filters nor subsamples, and has no --margin, --depfile or --resume", name);
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
    bool writes = command->filter_options_used || command->output_options_used || command->output;
    if (command->kind == KIND_LIST && (writes || command->depfile || command->passes.keep || command->resume))
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
    if (command->kind == KIND_PASSES && (command->filter_options_used || command->output_options_used))
        return error_set(err, RESULT_USAGE, "povgloss passes doesn't filter: give the filter's options to glossfilter");
    int step = command->passes.subsample, count = frames_count(&command->passes.frames);
    if (count > 1 && command_is_stream(command->output))
        return error_set(err, RESULT_USAGE,
                         "%s takes one image, and the animation has %d: name a file, or one frame (+SF1 +EF1)",
                         output_file_name(command->output), count);
    if (step > 1 && (switches->width == 0 || switches->height == 0 || switches->width % step || switches->height % step))
        return error_set(err, RESULT_USAGE, "--subsample %d needs +W and +H, both multiples of %d", step, step);
    if ((step > 1 || command->rays) && (command->passes.margin > 0 || command->passes.margin_px > 0))
        return error_set(err, RESULT_USAGE, "%s and --margin don't go together: leave one of them out",
                         step > 1 ? "--subsample" : "--rays");
    const struct filter_options *filter = &command->filter.filter;
    if (command->rays && (step > 1 || (filter->phong_override && !(filter->phong > 0))))
        return error_set(err, RESULT_USAGE, "--rays needs every pixel and an exponent above 0: leave out %s",
                         step > 1 ? "--subsample" : "--phong 0");
    if (command->kind == KIND_PASSES) {
        enum image_format format;
        struct error ignored;
        if (!image_format_choose(command->output, NULL, &format, &ignored) && format != IMAGE_FORMAT_EXR)
            return error_set(err, RESULT_USAGE, "%s: passes need an EXR file: end the name in .exr", command->output);
        command->filter.format = "exr";
    }
    enum result result = cli_check_output(command->output, &command->filter, err);
    return result ? result : cli_check_filter(&command->filter, err);
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
    if (command->output || command->filter_options_used || command->output_options_used || command->depfile ||
        passes->keep || command->resume || command->from_scene || passes->subsample > 1 || passes->gloss.automatic ||
        passes->gloss.all)
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

enum result command_parse(int argc, char **argv, struct command *command, struct povray_switches *switches,
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
    command->passes.rays = command->rays > 0;
    const bool draft = command->kind == KIND_RENDER && command->filter.filter.tolerance >= FILTER_TOLERANCE_DRAFT;
    command->passes.means = !command->no_means && !draft && command->kind <= KIND_PASSES;
    command->passes.check = !command->no_check && !command->filter.quiet && command->kind <= KIND_PASSES;
    command->passes.frames = frames_plan(&switches->frames);
    return result ? result : check_command(command, switches, err);
}

void command_free(struct command *command)
{
    free(command->path);
    buffer_free(&command->exponents);
    gloss_choice_free(&command->passes.gloss);
}
