/* The command lines: a table of options, each with a function for its value.
 *
 * No getopt: povgloss takes these options from among POV-Ray's own switches (+W640, -A, Declare=x=1), one argument at a
 * time. Values are parsed whole or refused.
 */
#include "cli.h"

#include "channels.h"
#include "compose.h"
#include "input_file.h"
#include "lobe.h"
#include "passes_file.h"
#include "picture.h"
#include "sheet.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double radians_per_degree = 0.017453292519943295;

struct cli_filter cli_filter_default(void)
{
    return (struct cli_filter){.filter = filter_options_default(), .bits = 8};
}

static bool is(const char *argument, const char *name)
{
    return strcmp(argument, name) == 0;
}

enum result cli_value(int argc, char **argv, int *index, const char *name, const char **value, struct error *err)
{
    const char *argument = argv[*index];
    size_t length = strlen(name);
    *value = NULL;
    if (strncmp(argument, name, length) != 0)
        return RESULT_OK;
    if (argument[length] == '=') {
        *value = argument + length + 1;
        *index += 1;
    } else if (argument[length] == '\0') {
        if (*index + 1 >= argc)
            return error_set(err, RESULT_USAGE, "%s needs a value", name);
        *value = argv[*index + 1];
        *index += 2;
    }
    return RESULT_OK;
}

enum result cli_number(const char *option, const char *text, double low, double high, double *value, struct error *err)
{
    char *end;
    *value = 0;
    double number = strtod(text, &end);
    if (end == text || *end != '\0' || !(number >= low && number <= high) || isspace((unsigned char)*text))
        return error_set(err, RESULT_USAGE, "%s %s: must be a number from %g to %g", option, text, low, high);
    *value = number;
    return RESULT_OK;
}

enum result cli_integer(const char *option, const char *text, int low, int high, int *value, struct error *err)
{
    char *end;
    errno = 0;
    long number = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || number < low || number > high || isspace((unsigned char)*text))
        return error_set(err, RESULT_USAGE, "%s %s: must be a whole number from %d to %d", option, text, low, high);
    *value = (int)number;
    return RESULT_OK;
}

/* Index of text in a NULL-terminated list of words. */
static enum result choose(const char *option, const char *text, const char *const *words, int *chosen,
                          struct error *err)
{
    char allowed[256] = "";
    for (int i = 0; words[i]; i++) {
        if (strcmp(text, words[i]) == 0) {
            *chosen = i;
            return RESULT_OK;
        }
        strncat(allowed, i > 0 ? ", " : "", sizeof allowed - strlen(allowed) - 1);
        strncat(allowed, words[i], sizeof allowed - strlen(allowed) - 1);
    }
    return error_set(err, RESULT_USAGE, "%s %s: must be one of %s", option, text, allowed);
}

/* A share or an angle: the ends of the range are not allowed, or the lower one is not. */
static enum result above_zero(const char *option, const char *text, double high, bool high_allowed, double *value,
                              struct error *err)
{
    enum result result = cli_number(option, text, 0, high, value, err);
    if (result != RESULT_OK || (*value > 0 && (high_allowed || *value < high)))
        return result;
    return error_set(err, RESULT_USAGE, "%s %s: must be above 0 and %s %g", option, text,
                     high_allowed ? "at most" : "below", high);
}

static enum result set_phong(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    double phong;
    enum result result = cli_number(name, value, 0, INFINITY, &phong, err);
    if (result != RESULT_OK)
        return result;
    options->filter.phong = (float)phong;
    options->filter.phong_override = true;
    return RESULT_OK;
}

static enum result set_roughness(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    double roughness;
    enum result result = cli_number(name, value, 0, 1, &roughness, err);
    if (result != RESULT_OK)
        return result;
    options->filter.phong = (float)lobe_phong_from_roughness(roughness);
    options->filter.phong_override = true;
    return RESULT_OK;
}

static enum result set_mode(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {[FILTER_MODE_BEST] = "best", [FILTER_MODE_PAPER] = "paper", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->filter.mode = (enum filter_mode)chosen;
    return result;
}

static enum result set_quality(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {"draft", "normal", "high", "exact", NULL};
    static const double tolerances[] = {FILTER_TOLERANCE_DRAFT, FILTER_TOLERANCE_NORMAL, FILTER_TOLERANCE_HIGH, 0};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->filter.tolerance = tolerances[chosen];
    return result;
}

static enum result set_tolerance(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    return cli_number(name, value, FILTER_TOLERANCE_LEAST, FILTER_TOLERANCE_DRAFT, &options->filter.tolerance, err);
}

static enum result set_without(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {"density", "visibility", "pool", "fit", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->filter.without |= 1u << chosen;
    return result;
}

static enum result set_weights(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {
        [FILTER_WEIGHTS_EXACT] = "exact", [FILTER_WEIGHTS_TABLE] = "table", [FILTER_WEIGHTS_GAUSS] = "gauss", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->filter.weights = (enum filter_weights)chosen;
    return result;
}

static enum result set_formula(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {[FILTER_FORMULA_PHONG] = "phong", [FILTER_FORMULA_MAX] = "max", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->filter.formula = (enum filter_formula)chosen;
    return result;
}

static enum result set_window(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {[FILTER_WINDOW_ROUND] = "round", [FILTER_WINDOW_SQUARE] = "square", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->filter.window = (enum filter_window)chosen;
    return result;
}

static enum result set_isa(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {[CPU_ISA_AUTO] = "auto", [CPU_ISA_SSE2] = "sse2", [CPU_ISA_AVX2] = "avx2",
                                        [CPU_ISA_AVX512] = "avx512", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result != RESULT_OK)
        return result;
    if (!cpu_isa_supported((enum cpu_isa)chosen))
        return error_set(err, RESULT_USAGE, "%s %s: this processor lacks it; leave it to --isa auto", name, value);
    options->filter.isa = (enum cpu_isa)chosen;
    return RESULT_OK;
}

static enum result set_max_radius(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    return cli_integer(name, value, 0, IMAGE_MAX_SIDE, &options->filter.max_radius_px, err);
}

static enum result set_radius_step(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {"1", "2", "4", "8", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->filter.radius_step = 1 << chosen;
    return result;
}

static enum result set_energy(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    return above_zero(name, value, 1, false, &options->filter.energy, err);
}

static enum result set_max_angle(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    double degrees;
    enum result result = above_zero(name, value, 90, true, &degrees, err);
    if (result == RESULT_OK)
        options->filter.max_angle_rad = degrees * radians_per_degree;
    return result;
}

static enum result set_threads(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    return cli_integer(name, value, 0, 256, &options->filter.threads, err);
}

static enum result set_format(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {"exr", "png", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->format = words[chosen];
    return result;
}

static enum result set_bits(const char *name, const char *value, struct cli_filter *options, struct error *err)
{
    static const char *const words[] = {"8", "16", NULL};
    int chosen;
    enum result result = choose(name, value, words, &chosen, err);
    if (result == RESULT_OK)
        options->bits = 8 << chosen;
    return result;
}

typedef enum result set_function(const char *name, const char *value, struct cli_filter *options, struct error *err);

static const struct {
    const char *name;
    set_function *set;
} filter_options_table[] = {
    {"--phong", set_phong},           {"--roughness", set_roughness},     {"--mode", set_mode},
    {"--weights", set_weights},       {"--formula", set_formula},         {"--window", set_window},
    {"--max-radius", set_max_radius}, {"--radius-step", set_radius_step}, {"--energy", set_energy},
    {"--max-angle", set_max_angle},   {"--threads", set_threads},         {"--isa", set_isa},
    {"--format", set_format},         {"--bits", set_bits},               {"--without", set_without},
    {"--quality", set_quality},       {"--tolerance", set_tolerance},
};

const char cli_filter_help[] =
    "Filter:\n"
    "  --phong P            Phong exponent, 0 to inf (a mirror): replaces the passes' own at every\n"
    "                       glossy pixel; what is not glossy stays so\n"
    "  --roughness R        the same by roughness, 0 (a mirror) to 1: P = (1/R^4 - 1)/2\n"
    "  --mode M             best (default): what each point of the mirror sees, by solid angle; paper:\n"
    "                       Kulikova and Dmitriev, Fuzzy reflections rendering, 2002\n"
    "  --energy E           share of the lobe's energy that is looked at, 0 to 1 (default 0.99)\n"
    "  --max-angle DEG      limit of the lobe's half-angle, up to 90 (default 90)\n"
    "  --max-radius PX      limit of the window's radius; 0: none (default)\n"
    "  --without W          best: leave out density, visibility, pool or fit, to see what it is worth; may be\n"
    "                       given again\n"
    "  --quality Q          of best: draft, normal (default) or high: --tolerance 0.002, 0.0015 or 0.001;\n"
    "                       exact: every pixel that is seen counts by itself, in up to a hundred times the time\n"
    "  --tolerance E        of best: about the RMSE of the picture against an exact one, 0.0007 to 0.002\n"
    "Filter of --mode paper:\n"
    "  --weights W          exact (default), table (within 0.003 %), or gauss in place of the lobe\n"
    "  --formula F          phong: cos^P, equation (3), default; max: 2 strength cos^P, equation (2);\n"
    "                       the picture is the same\n"
    "  --window W           round (default) or square\n"
    "  --radius-step N      radius computed at every 1 (default), 2, 4 or 8 pixels\n"
    "Speed:\n"
    "  --threads N          0: one for each processor (default)\n"
    "  --isa I              auto (default), sse2, avx2 or avx512; the picture is the same\n"
    "Output:\n"
    "  --format F           exr (linear) or png (sRGB); default: by the name's extension\n"
    "  --bits N             of a PNG: 8 (default) or 16\n"
    "  --layers             EXR: also the blurred reflection (glossy.*), and how much of the lobe the\n"
    "                       samples cover (confidence.V) or the paper's radius (radius.V)\n"
    "  --timings            print a table of where the time went to standard error\n"
    "  -q, --quiet          no messages but errors\n";

enum result cli_filter_option(int argc, char **argv, int *index, struct cli_filter *options, enum cli_option *option,
                              struct error *err)
{
    const struct {
        const char *name;
        bool *flag;
        enum cli_option option;
    } flags[] = {
        {"--layers", &options->layers, CLI_OPTION_OUTPUT},
        {"--timings", &options->show_timings, CLI_OPTION_REPORT},
        {"--quiet", &options->quiet, CLI_OPTION_REPORT},
        {"-q", &options->quiet, CLI_OPTION_REPORT},
    };
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        if (is(argv[*index], flags[i].name)) {
            *flags[i].flag = true;
            *option = flags[i].option;
            *index += 1;
            return RESULT_OK;
        }
    for (size_t i = 0; i < sizeof filter_options_table / sizeof *filter_options_table; i++) {
        const char *name = filter_options_table[i].name, *value;
        enum result result = cli_value(argc, argv, index, name, &value, err);
        if (result != RESULT_OK)
            return result;
        if (value) {
            set_function *set = filter_options_table[i].set;
            *option = set == set_format || set == set_bits ? CLI_OPTION_OUTPUT : CLI_OPTION_FILTER;
            return set(name, value, options, err);
        }
    }
    *option = CLI_OPTION_NONE;
    return RESULT_OK;
}

enum result cli_check_output(const char *path, const struct cli_filter *options, struct error *err)
{
    enum image_format format;
    enum result result = image_format_choose(path, options->format, &format, err);
    if (result != RESULT_OK)
        return result;
    if (options->layers && format == IMAGE_FORMAT_PNG)
        return error_set(err, RESULT_USAGE, "--layers: a PNG has no layers; write an EXR (--format exr)");
    if (strcmp(path, "-") == 0 && isatty(STDOUT_FILENO))
        return error_set(err, RESULT_USAGE, "standard output is a terminal: redirect it, or name a file with -o");
    return RESULT_OK;
}

enum result cli_check_filter(const struct cli_filter *options, struct error *err)
{
    const struct filter_options *filter = &options->filter;
    const bool of_paper = filter->weights != FILTER_WEIGHTS_EXACT || filter->formula != FILTER_FORMULA_PHONG ||
                          filter->window != FILTER_WINDOW_ROUND || filter->radius_step != 1;
    if (of_paper && filter->mode != FILTER_MODE_PAPER)
        return error_set(err, RESULT_USAGE,
                         "--weights, --formula, --window and --radius-step are the paper's: add --mode paper");
    if (filter->without && filter->mode != FILTER_MODE_BEST)
        return error_set(err, RESULT_USAGE, "--without is for --mode best");
    if (filter->tolerance != FILTER_TOLERANCE_NORMAL && filter->mode != FILTER_MODE_BEST)
        return error_set(err, RESULT_USAGE, "--quality and --tolerance are for --mode best");
    return RESULT_OK;
}

static enum result write_picture(const char *path, const struct cli_filter *options, const struct image *image,
                                 const struct image *glossy, const struct image *measure, struct error *err)
{
    enum image_format format;
    enum result result = image_format_choose(path, options->format, &format, err);
    if (result != RESULT_OK)
        return result;
    struct exr_channel layers[] = {
        {"glossy.R", glossy, 0}, {"glossy.G", glossy, 1}, {"glossy.B", glossy, 2}, {"confidence.V", measure, 0}};
    if (options->filter.mode == FILTER_MODE_PAPER)
        layers[3] = (struct exr_channel){"radius.V", measure, 0};
    int count = options->layers ? 3 + (measure != NULL) : 0;
    return image_write(path, format, options->bits, image, count > 0 ? layers : NULL, count, err);
}

enum result cli_draw_sheet(const char *path, const struct cli_filter *options, const struct cli_sheet *exponents,
                           const struct gbuffer *gbuffer, struct error *err)
{
    struct image sheet = {0};
    struct filter *filter;
    enum result result = filter_open(gbuffer, &filter, err);
    for (int i = 0; !result && i < exponents->count; i++) {
        struct filter_options one = options->filter;
        one.phong = exponents->phong[i];
        one.phong_override = true;
        struct image image = {0};
        char label[32];
        snprintf(label, sizeof label, "p = %g", (double)one.phong);
        result = picture_draw(filter, &one, &image, err);
        if (!result && i == 0)
            result = sheet_alloc(&sheet, exponents->count, image.width, image.height, err);
        if (!result)
            sheet_put(&sheet, exponents->count, i, &image, label);
        image_free(&image);
    }
    filter_close(filter);
    if (!result)
        result = write_picture(path, options, &sheet, NULL, NULL, err);
    image_free(&sheet);
    return result;
}

enum result cli_write(const char *path, const struct cli_filter *options, const struct gbuffer *gbuffer,
                      struct image *glossy, struct image *measure, struct error *err)
{
    struct image image = {0};
    struct timings_moment start = timings_now();
    enum result result = compose(gbuffer, glossy, &image, err);
    struct image *const images[] = {&image, glossy, measure};
    for (int i = 0; i < 3 && result == RESULT_OK && gbuffer->window.width > 0; i++)
        if (images[i])
            result = image_crop(images[i], &gbuffer->window, err);
    timings_add(options->timings, "compose", start);
    start = timings_now();
    if (result == RESULT_OK)
        result = write_picture(path, options, &image, glossy, measure, err);
    timings_add(options->timings, "write", start);
    image_free(&image);
    return result;
}

static bool is_finite(const struct image *image, int x, int y)
{
    bool finite = true;
    for (int i = 0; i < 3 && image->pixels; i++)
        finite = finite && isfinite(image_row(image, i, y)[x]);
    return finite;
}

void cli_warn_of_pixels(const char *program, const char *name, const struct cli_filter *options,
                        const struct gbuffer *gbuffer)
{
    if (options->quiet)
        return;
    const struct filter_options *filter = &options->filter;
    bool other = filter->phong_override && gbuffer->rays.pixels && gbuffer->phong.pixels;
    long left_out = filter_left_out(gbuffer), spoilt = 0, unused = 0;
    for (int y = 0; y < gbuffer->specular.height; y++)
        for (int x = 0; x < gbuffer->specular.width; x++) {
            spoilt += !is_finite(&gbuffer->base, x, y) || !is_finite(&gbuffer->reflectance, x, y);
            unused += other && image_row(&gbuffer->rays, 3, y)[x] > 0 &&
                      image_row(&gbuffer->phong, 0, y)[x] != filter->phong;
        }
    if (left_out > 0)
        fprintf(stderr,
                "%s: warning: %s: %ld glossy pixel%s left out, without a reflection: exponent, position, endpoint or "
                "specular radiance isn't finite there, or W or the exponent is below 0 (glossfilter --check counts each)\n",
                program, name, left_out, left_out > 1 ? "s are" : " is");
    if (spoilt > 0)
        fprintf(stderr,
                "%s: warning: %s: base or reflectance isn't finite at %ld pixel%s, and so the picture may not be\n",
                program, name, spoilt, spoilt > 1 ? "s" : "");
    if (unused > 0)
        fprintf(stderr,
                "%s: warning: %s: the further rays of %ld pixel%s were drawn for another exponent than %g and are left "
                "out: trace them again by povgloss render --rays N --phong %g, or leave out --phong\n",
                program, name, unused, unused > 1 ? "s" : "", (double)filter->phong, (double)filter->phong);
}

enum result cli_blur(const struct cli_filter *options, const struct gbuffer *gbuffer, struct image *glossy,
                     struct image *measure, struct error *err)
{
    struct timings_moment start = timings_now();
    enum result result = filter_glossy(gbuffer, &options->filter, glossy, measure, err);
    timings_add(options->timings, "filter", start);
    return result;
}

enum result cli_draw(const char *path, const struct cli_filter *options, const struct gbuffer *gbuffer,
                     struct error *err)
{
    struct image glossy = {0}, measure = {0};
    enum result result = cli_blur(options, gbuffer, &glossy, &measure, err);
    if (result == RESULT_OK)
        result = cli_write(path, options, gbuffer, &glossy, &measure, err);
    image_free(&glossy);
    image_free(&measure);
    return result;
}

/* Exponents with commas between them. */
static enum result set_sheet(const char *value, struct cli_sheet *sheet, struct error *err)
{
    enum { MAX_TEXT = 64 };
    sheet->count = 0;
    for (const char *at = value; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        char text[MAX_TEXT];
        double phong;
        snprintf(text, sizeof text, "%.*s", (int)strcspn(at, ","), at);
        enum result result = cli_number("--sheet", text, 0, INFINITY, &phong, err);
        if (result)
            return result;
        if (sheet->count == CLI_SHEET_MAX)
            return error_set(err, RESULT_USAGE, "--sheet: at most %d exponents", CLI_SHEET_MAX);
        sheet->phong[sheet->count++] = (float)phong;
    }
    return RESULT_OK;
}

/* One argument that begins with "-". */
static enum result glossfilter_option(int argc, char **argv, int *index, struct cli_glossfilter *command,
                                      struct error *err)
{
    const char *argument = argv[*index], *value;
    if (is(argument, "-h") || is(argument, "--help") || is(argument, "--version") || is(argument, "--check") ||
        is(argument, "--view")) {
        *(is(argument, "--check")     ? &command->check
          : is(argument, "--view")    ? &command->view
          : is(argument, "--version") ? &command->version
                                      : &command->help) = true;
        *index += 1;
        return RESULT_OK;
    }
    enum result result = cli_value(argc, argv, index, "-o", &value, err);
    if (result == RESULT_OK && !value)
        result = cli_value(argc, argv, index, "--output", &value, err);
    if (result != RESULT_OK || value) {
        command->output = value;
        return result;
    }
    result = cli_value(argc, argv, index, "--map", &value, err);
    if (result == RESULT_OK && value)
        result = channels_check_map(value, err);
    if (result == RESULT_OK && value)
        return text_list_add(&command->map, err, "%s", value);
    if (result == RESULT_OK)
        result = cli_value(argc, argv, index, "--sheet", &value, err);
    if (result == RESULT_OK && value)
        return set_sheet(value, &command->sheet, err);
    if (result != RESULT_OK)
        return result;
    enum cli_option option;
    result = cli_filter_option(argc, argv, index, &command->options, &option, err);
    if (result == RESULT_OK && option == CLI_OPTION_NONE)
        result = error_set(err, RESULT_USAGE, "%s: unknown option; see --help", argument);
    return result;
}

enum result cli_glossfilter(int argc, char **argv, struct cli_glossfilter *command, struct error *err)
{
    *command = (struct cli_glossfilter){.options = cli_filter_default()};
    bool options_ended = false;
    for (int index = 1; index < argc;) {
        if (!options_ended && is(argv[index], "--")) {
            options_ended = true;
            index++;
        } else if (!options_ended && argv[index][0] == '-' && argv[index][1] != '\0') {
            enum result result = glossfilter_option(argc, argv, &index, command, err);
            if (result != RESULT_OK)
                return result;
        } else if (command->input && command->band_count == CLI_BANDS_MAX) {
            return error_set(err, RESULT_USAGE, "%s: at most %d passes files; see --help", argv[index], CLI_BANDS_MAX + 1);
        } else if (command->input) {
            command->bands[command->band_count++] = argv[index++];
        } else {
            command->input = argv[index++];
        }
    }
    if (command->help || command->version)
        return RESULT_OK;
    if (!command->input)
        return error_set(err, RESULT_USAGE, "no passes file: glossfilter PASSES.exr -o OUT.exr; see --help");
    if (command->check && command->output)
        return error_set(err, RESULT_USAGE, "--check only looks at the passes: leave out -o");
    if (command->check && command->band_count)
        return error_set(err, RESULT_USAGE, "%s: --check looks at one passes file", command->bands[0]);
    if (command->view && (command->check || command->sheet.count))
        return error_set(err, RESULT_USAGE, "--view opens a window: leave out --check and --sheet");
    if (command->check || (command->view && !command->output))
        return RESULT_OK;
    if (!command->output)
        return error_set(err, RESULT_USAGE, "no output: say where with -o FILE; see --help");
    if (command->sheet.count && (command->options.filter.phong_override || command->options.layers))
        return error_set(err, RESULT_USAGE, "--sheet has exponents of its own and no layers: leave out %s",
                         command->options.layers ? "--layers" : "--phong and --roughness");
    enum result result = cli_check_output(command->output, &command->options, err);
    return result == RESULT_OK ? cli_check_filter(&command->options, err) : result;
}

enum result cli_read(const struct cli_glossfilter *command, struct gbuffer *gbuffer, struct error *err)
{
    enum result result = passes_file_read_mapped(command->input, &command->map, gbuffer, NULL, err);
    for (int i = 0; !result && i < command->band_count; i++) {
        struct gbuffer band;
        struct error cause;
        result = passes_file_read_mapped(command->bands[i], &command->map, &band, NULL, err);
        if (!result && gbuffer_join(gbuffer, &band, &cause))
            result = error_set(err, RESULT_DATA, "%s: %s", input_file_name(command->bands[i]), cause.text);
    }
    if (result)
        gbuffer_free(gbuffer);
    return result;
}

void cli_complain(const char *program, const struct error *err)
{
    fprintf(stderr, "%s: %s\n", program, err->text);
}
