/* The command line of povgloss: POV-Ray's switches, which are passed through, among options of two hyphens. */
#ifndef POVGLOSS_COMMAND_H
#define POVGLOSS_COMMAND_H

#include "cli.h"
#include "passes.h"
#include "probe.h"

enum kind { KIND_RENDER, KIND_PASSES, KIND_LIST, KIND_PROBE, KIND_BRUTE, KIND_COMPARE, KIND_NONE };

struct command {
    enum kind kind;
    const char *scene, *output;
    const char *image; /* to compare with the probes, whose file is the scene then */
    struct probe_options probe;
    struct buffer exponents; /* of doubles, for the probes */
    int rays; /* further rays of the lobe at every glossy pixel */
    const char *depfile; /* NULL: none */
    char *path; /* of the scene */
    struct passes_options passes;
    bool from_scene, resume, no_means, no_check;
    struct cli_filter filter;
    bool filter_options_used, output_options_used;
    bool help, version, print_include_dir;
};

/* Takes the whole command line and refuses what can't be drawn (RESULT_USAGE, or RESULT_DATA for an .ini file or a
 * scene's comment that can't be read). With `help`, `version` or `print_include_dir` nothing else is looked at. The
 * switches are what command->passes refers to. The caller frees both, also after a failure. */
MUST_CHECK enum result command_parse(int argc, char **argv, struct command *command, struct povray_switches *switches,
                                     struct error *err);
void command_free(struct command *command);

/* Whether a path is a pipe, a device or standard input or output. */
bool command_is_stream(const char *path);

#endif
