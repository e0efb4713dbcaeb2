/* glossfilter: glossy reflections from the passes of any renderer.
 *
 * It reads them and leaves the rest (filter, compose, write) to what povgloss render calls, too.
 */
#include "cli.h"
#include "input_file.h"
#include "interrupt.h"
#include "own_files.h"
#include "passes_check.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char program[] = "glossfilter";

static const char help[] =
    "usage: glossfilter PASSES.exr [BAND.exr ...] -o OUT.exr [options]\n"
    "\n"
    "Blurs the mirror reflections of a passes file by the lobe of each glossy surface, and adds\n"
    "them to the rest of the picture. \"-\" is standard input or output. Several passes files are bands\n"
    "of one picture (povgloss passes +SR1 +ER64 ...), which are joined.\n"
    "\n"
    "  glossfilter passes.exr -o glossy.png\n"
    "  glossfilter - --phong 300 -o - --format exr < passes.exr > glossy.exr\n"
    "\n";

static const char help_end[] =
    "  -o, --output FILE    where to write\n"
    "  --sheet P,P,...      several exponents: one picture with all of them side by side, labelled\n"
    "  --view               open a window with a slider for the roughness: left and right change it, s saves\n"
    "                       to -o, q ends\n"
    "Passes:\n"
    "  --map CHANNEL=NAME   take a channel (P.X) or a group of them (P) from the file's channel or layer\n"
    "                       of that name; may be given again\n"
    "  --check              write nothing; tell which channels were found, what is missing, and whether\n"
    "                       the values look right (status 3 if not)\n"
    "  -h, --help           this text\n"
    "  --version            the version\n"
    "\n"
    "Channels of a passes file: R G B (base), specular.R/.G/.B, reflectance.R/.G/.B, P.X/.Y/.Z,\n"
    "endpoint.X/.Y/.Z/.W, phong.V; those of other renderers go by their names, too.\n"
    "Exit status: 0 ok, 2 wrong command line, 3 file, data or memory.\n";

static enum result print(const char *first, const char *second, const char *third, struct error *err)
{
    if (printf("%s%s%s", first, second, third) < 0 || fflush(stdout) != 0)
        return error_set(err, RESULT_DATA, "standard output: cannot write");
    return RESULT_OK;
}

/* RESULT_DATA, after the report, if something is wrong. */
static enum result check(const struct cli_glossfilter *command, struct error *err)
{
    struct gbuffer gbuffer = {0};
    struct passes_found found;
    struct buffer report = {0};
    int wrong = 0;
    enum result result = passes_file_read_mapped(command->input, &command->map, &gbuffer, &found, err);
    if (result)
        return result;
    result = passes_check(&gbuffer, &found, &report, &wrong, err);
    if (!result)
        result = print(report.data, "", "", err);
    if (!result && wrong > 0)
        result = error_set(err, RESULT_DATA, "%s: %d thing%s wrong with these passes", input_file_name(command->input),
                           wrong, wrong > 1 ? "s are" : " is");
    buffer_free(&report);
    text_list_free(&found.channels);
    gbuffer_free(&gbuffer);
    return result;
}

static enum result run(const struct cli_glossfilter *command, struct error *err)
{
    struct gbuffer gbuffer = {0};
    struct timings_moment start = timings_now();
    enum result result = cli_read(command, &gbuffer, err);
    timings_add(command->options.timings, "read", start);
    if (result == RESULT_OK)
        cli_warn_of_pixels(program, input_file_name(command->input), &command->options, &gbuffer);
    if (result == RESULT_OK)
        result = command->sheet.count
                     ? cli_draw_sheet(command->output, &command->options, &command->sheet, &gbuffer, err)
                     : cli_draw(command->output, &command->options, &gbuffer, err);
    gbuffer_free(&gbuffer);
    return result;
}

/* Goes on as the program of the window; returns only where that can't be. */
static enum result view(char **argv, struct error *err)
{
    char *path;
    struct error missing;
    if (own_file("lib/povgloss/view", &path, &missing))
        return error_set(err, RESULT_DATA,
                         "--view: povgloss was built without SDL2: install libsdl2-dev and build it anew");
    execv(path, argv);
    enum result result = error_set(err, RESULT_DATA, "%s: %s", path, strerror(errno));
    free(path);
    return result;
}

int main(int argc, char **argv)
{
    struct cli_glossfilter command;
    struct timings timings = timings_begin();
    struct error err;
    interrupt_install();
    enum result result = cli_glossfilter(argc, argv, &command, &err);
    command.options.timings = &timings;
    if (result == RESULT_OK) {
        if (command.help)
            result = print(help, cli_filter_help, help_end, &err);
        else if (command.version)
            result = print(program, " ", POVGLOSS_VERSION "\n", &err);
        else
            result = command.check  ? check(&command, &err)
                     : command.view ? view(argv, &err)
                                    : run(&command, &err);
        if (result == RESULT_OK && command.options.show_timings)
            timings_print(&timings, stderr);
    }
    text_list_free(&command.map);
    if (result == RESULT_INTERRUPTED)
        interrupt_reraise();
    if (result != RESULT_OK)
        cli_complain(program, &err);
    return (int)result;
}
