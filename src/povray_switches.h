/* POV-Ray's own switches, from povgloss's command line, .ini files and a scene's comment: passed through, but for those
 * that the passes decide. */
#ifndef POVGLOSS_POVRAY_SWITCHES_H
#define POVGLOSS_POVRAY_SWITCHES_H

#include "error.h"
#include "frames.h"
#include "mem.h"

#include <stdbool.h>

struct povray_switches {
    struct text_list passed;    /* in their order, .ini files replaced by what they say */
    struct text_list libraries; /* folders of +L and Library_Path */
    struct text_list ini_files; /* that were read, POV-Ray's own among them */
    char *scene;                /* +I or Input_File_Name on the command line; NULL: none */
    char *file_scene;           /* the same in .ini files */
    struct frames_options frames;
    int width, height; /* 0: not said */
    bool antialias;
    double threshold; /* of antialiasing; without any POV-Ray's 0.3 */
    bool partial; /* some rows or columns only */
    int depth; /* of .ini files that read others */
};

/* Begins with the .ini file that POV-Ray would read by itself. The caller frees the switches, also after a failure. */
MUST_CHECK enum result povray_switches_begin(struct povray_switches *switches, struct error *err);
void povray_switches_free(struct povray_switches *switches);

/* Whether an argument looks like one: +W640, -D, Width=640, quality.ini. Options with two hyphens are not. */
bool povray_switch_is(const char *argument);

/* Takes one of the command line; an .ini file is read. RESULT_USAGE for those that povgloss decides itself (output file
 * and format; in an .ini file they are passed over) or that passes can't have (header file, shell commands). */
MUST_CHECK enum result povray_switch_take(struct povray_switches *switches, const char *argument, struct error *err);

/* Takes the switches of the scene's own comment, the first line like `// +W640 +H480 +A0.3` among its first 50, as
 * POV-Ray's render_scene.sh does; *line is a copy of it behind path and line number. RESULT_DATA where there is
 * none. */
MUST_CHECK enum result povray_switches_take_comment(struct povray_switches *switches, const char *scene, char **line,
                                                    struct error *err);

/* The path of a scene as POV-Ray finds it: as it is, with .pov added, or in a library folder; a copy of `name` where
 * there is none. The caller frees it. */
MUST_CHECK enum result povray_switches_find_scene(const struct povray_switches *switches, const char *name, char **path,
                                                  struct error *err);

#endif
