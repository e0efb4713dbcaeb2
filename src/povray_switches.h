/* POV-Ray's own switches on povgloss's command line: passed through, but for those that the passes decide. */
#ifndef POVGLOSS_POVRAY_SWITCHES_H
#define POVGLOSS_POVRAY_SWITCHES_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>

struct povray_switches {
    const char **passed; /* in their order; they belong to the caller's argv */
    int passed_count;
    const char **libraries; /* folders of +L and Library_Path */
    int library_count;
    const char *scene; /* +I or Input_File_Name; NULL: none */
    int width, height; /* +W, +H or Width=, Height=; 0: not there */
    bool antialias;    /* +A or Antialias=on, by the last of them */
};

/* Room for `capacity` switches; povray_switches_free gives it back. */
MUST_CHECK enum result povray_switches_make(struct povray_switches *switches, int capacity, struct error *err);
void povray_switches_free(struct povray_switches *switches);

/* Whether an argument looks like one: +W640, -D, Width=640, quality.ini. Options with two hyphens are not. */
bool povray_switch_is(const char *argument);

/* The length of the path if the argument names an .ini file (`quality.ini`, `quality.ini[final]`), else 0. */
size_t povray_switch_ini(const char *argument);

/* Takes one. RESULT_USAGE for those that povgloss decides itself (output file and format, header file, several frames). */
MUST_CHECK enum result povray_switch_take(struct povray_switches *switches, const char *argument, struct error *err);

#endif
