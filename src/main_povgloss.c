/* povgloss: a POV-Ray scene in, its glossy image (render), its passes file (passes) or true values of it (probe)
 * out. */
#include "draw.h"
#include "interrupt.h"
#include "measure.h"
#include "own_files.h"
#include "povray_switches.h"
#include "scene_list.h"

#include <stdio.h>
#include <stdlib.h>

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
    "  --margin M           let the blur see what is M pixels, or M% of width and height, beyond the\n"
    "                       picture's border (default 0); for perspective cameras\n"
    "  --rays N             trace N further rays of the lobe at every glossy pixel: what no mirrored ray\n"
    "                       meets is in the blur, and the error falls with N (default 0)\n"
    "  --jobs N             POV-Ray processes at the same time; 0: two more than processors (default)\n"
    "  --timeout SECONDS    end a POV-Ray process that runs longer, and fail; 0: never (default)\n"
    "  --sandbox            run POV-Ray under bubblewrap: no network, no files but the scene's folders (read\n"
    "                       only) and the system's\n"
    "  --no-means           L0 by one ray a pixel, also where the picture is antialiased (+A); render --quality\n"
    "                       draft does the same\n"
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

static enum result print_include_dir(struct error *err)
{
    char *path;
    enum result result = own_file("share/povgloss/include", &path, err);
    if (!result)
        puts(path);
    free(path);
    return result;
}

int main(int argc, char **argv)
{
    struct command command = {0};
    struct povray_switches switches = {0};
    struct timings timings = timings_begin();
    struct error err;
    interrupt_install();
    enum result result = command_parse(argc, argv, &command, &switches, &err);
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
        result = measure_probes(&command, &err);
    else if (!result && command.kind == KIND_COMPARE)
        result = measure_compare(&command, &err);
    else if (!result)
        result = draw_frames(&command, &err);
    if (!result && command.filter.show_timings)
        timings_print(&timings, stderr);
    if (!result && (command.help || command.version || command.print_include_dir) && (fflush(stdout) || ferror(stdout)))
        result = error_set(&err, RESULT_DATA, "standard output: cannot be written");
    command_free(&command);
    povray_switches_free(&switches);
    if (result == RESULT_INTERRUPTED)
        interrupt_reraise();
    if (result)
        cli_complain("povgloss", &err);
    return (int)result;
}
