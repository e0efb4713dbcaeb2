/* glossfilter: glossy reflections from the passes of any renderer.
 *
 * It reads them and leaves the rest (filter, compose, write) to what povgloss render calls, too.
 */
#include "cli.h"
#include "interrupt.h"
#include "passes_file.h"

#include <stdio.h>

static const char program[] = "glossfilter";

static const char help[] =
    "usage: glossfilter PASSES.exr -o OUT.exr [options]\n"
    "\n"
    "Blurs the mirror reflections of a passes file by the lobe of each glossy surface, and adds\n"
    "them to the rest of the picture. \"-\" is standard input or output.\n"
    "\n"
    "  glossfilter passes.exr -o glossy.png\n"
    "  glossfilter - --phong 300 -o - --format exr < passes.exr > glossy.exr\n"
    "\n";

static const char help_end[] =
    "  -o, --output FILE    where to write\n"
    "  -h, --help           this text\n"
    "  --version            the version\n"
    "\n"
    "Channels of a passes file: R G B, specular.R/.G/.B, reflectance.R/.G/.B, P.X/.Y/.Z,\n"
    "endpoint.X/.Y/.Z/.W, phong.V.\n"
    "Exit status: 0 ok, 2 wrong command line, 3 file, data or memory.\n";

static enum result run(const struct cli_glossfilter *command, struct error *err)
{
    struct gbuffer gbuffer = {0};
    enum result result = passes_file_read(command->input, &gbuffer, err);
    if (result == RESULT_OK)
        result = cli_draw(command->output, &command->options, &gbuffer, err);
    gbuffer_free(&gbuffer);
    return result;
}

static enum result print(const char *first, const char *second, const char *third, struct error *err)
{
    if (printf("%s%s%s", first, second, third) < 0 || fflush(stdout) != 0)
        return error_set(err, RESULT_DATA, "standard output: cannot write");
    return RESULT_OK;
}

int main(int argc, char **argv)
{
    struct cli_glossfilter command;
    struct error err;
    interrupt_install();
    enum result result = cli_glossfilter(argc, argv, &command, &err);
    if (result == RESULT_OK) {
        if (command.help)
            result = print(help, cli_filter_help, help_end, &err);
        else if (command.version)
            result = print(program, " ", POVGLOSS_VERSION "\n", &err);
        else
            result = run(&command, &err);
    }
    if (result == RESULT_INTERRUPTED)
        interrupt_reraise();
    if (result != RESULT_OK)
        cli_complain(program, &err);
    return (int)result;
}
