/* The command lines: one table for the options that glossfilter and `povgloss render` share, one strict parser.
 *
 * Only this file and the programs print or exit.
 */
#ifndef POVGLOSS_CLI_H
#define POVGLOSS_CLI_H

#include "filter.h"
#include "image_file.h"
#include "mem.h"
#include "timings.h"

#include <stdbool.h>

/* What the shared options say about filtering and writing. */
struct cli_filter {
    struct filter_options filter;
    const char *format; /* "exr" or "png"; NULL: by the output's extension */
    int bits;           /* of a PNG: 8 or 16 */
    bool layers;        /* further channels in an EXR: the blurred reflection, the confidence or the radius */
    bool quiet, show_timings;
    struct timings *timings; /* gets a row for each step; NULL: none */
};

struct cli_filter cli_filter_default(void);

/* What an option is about. */
enum cli_option { CLI_OPTION_NONE, CLI_OPTION_FILTER, CLI_OPTION_OUTPUT, CLI_OPTION_REPORT };

/* Looks at argv[*index]. If it is one of the shared options, applies it, moves *index past it and its value, and
 * *option says what it is about; else *option is CLI_OPTION_NONE and nothing changes. A value follows as the next
 * argument or after "=".
 * RESULT_USAGE with the option and what is allowed for a value that is missing or wrong. */
MUST_CHECK enum result cli_filter_option(int argc, char **argv, int *index, struct cli_filter *options,
                                         enum cli_option *option, struct error *err);

/* The shared options' lines of --help. */
extern const char cli_filter_help[];

/* If argv[*index] is the option `name` (such as "--phong") with a value, *value is that and *index moves past both;
 * else *value is NULL. RESULT_USAGE where the value is missing. */
MUST_CHECK enum result cli_value(int argc, char **argv, int *index, const char *name, const char **value,
                                 struct error *err);

/* The whole text as a number from low to high (RESULT_USAGE names option, text and range otherwise, and for NaN).
 * "inf" is a number where high is infinite. */
MUST_CHECK enum result cli_number(const char *option, const char *text, double low, double high, double *value,
                                  struct error *err);

/* The same for a whole number. */
MUST_CHECK enum result cli_integer(const char *option, const char *text, int low, int high, int *value,
                                   struct error *err);

/* Filters the passes as filter_glossy() does. */
MUST_CHECK enum result cli_blur(const struct cli_filter *options, const struct gbuffer *gbuffer, struct image *glossy,
                                struct image *measure, struct error *err);

/* Composes the picture with the blurred reflection and writes it to `path`; with --layers also glossy.R/.G/.B and
 * `measure`, unless it is NULL, as confidence.V, of the paper radius.V. All are cropped to the window. */
MUST_CHECK enum result cli_write(const char *path, const struct cli_filter *options, const struct gbuffer *gbuffer,
                                 struct image *glossy, struct image *measure, struct error *err);

/* Warns, unless asked to be quiet, of the pixels of `name` that the filter leaves out, or whose base or reflectance
 * isn't finite. */
void cli_warn_of_pixels(const char *program, const char *name, const struct cli_filter *options,
                        const struct gbuffer *gbuffer);

/* cli_blur() and cli_write(). */
MUST_CHECK enum result cli_draw(const char *path, const struct cli_filter *options, const struct gbuffer *gbuffer,
                                struct error *err);

/* Exponents of a contact sheet's pictures. */
enum { CLI_SHEET_MAX = 100 };
struct cli_sheet {
    float phong[CLI_SHEET_MAX];
    int count; /* 0: no sheet */
};

/* Filters the passes by each exponent, in place of their own, and writes a sheet of the pictures to `path`. */
MUST_CHECK enum result cli_draw_sheet(const char *path, const struct cli_filter *options,
                                      const struct cli_sheet *exponents, const struct gbuffer *gbuffer,
                                      struct error *err);

/* Refuses a path and options of the output that cli_write would refuse, before the work and not after it. */
MUST_CHECK enum result cli_check_output(const char *path, const struct cli_filter *options, struct error *err);

/* Refuses options of the filter that don't go with its mode. */
MUST_CHECK enum result cli_check_filter(const struct cli_filter *options, struct error *err);

/* The command line of glossfilter. */
enum { CLI_BANDS_MAX = 999 };
struct cli_glossfilter {
    struct cli_filter options;
    const char *input, *output;
    const char *bands[CLI_BANDS_MAX]; /* further passes files: bands of the same picture */
    int band_count;
    struct cli_sheet sheet;
    struct text_list map; /* CHANNEL=NAME; the caller frees it */
    bool check, view, help, version;
};

MUST_CHECK enum result cli_glossfilter(int argc, char **argv, struct cli_glossfilter *command, struct error *err);

/* Reads the passes file, or joins its bands, into *gbuffer, which the caller frees. */
MUST_CHECK enum result cli_read(const struct cli_glossfilter *command, struct gbuffer *gbuffer, struct error *err);

/* Prints "program: message" to standard error. */
void cli_complain(const char *program, const struct error *err);

#endif
