/* Finishes that the user makes glossy on the command line: NAME=p, auto, all=p. They win over what the scene says. */
#ifndef POVGLOSS_GLOSS_CHOICE_H
#define POVGLOSS_GLOSS_CHOICE_H

#include "error.h"

#include <stdbool.h>

struct gloss_name {
    char *name; /* of a declared texture, finish or material */
    double exponent;
};

struct gloss_choice {
    struct gloss_name *names;
    int name_count;
    bool automatic; /* finishes with both a reflection and a highlight's phong_size or roughness take the highlight's lobe */
    bool all;       /* every other finish that reflects is glossy, too, with this exponent: */
    double all_exponent;
};

/* Takes one choice: "auto", "all=P" or "NAME=P", P being a Phong exponent of 0 or more, or inf. RESULT_USAGE else. */
MUST_CHECK enum result gloss_choice_take(struct gloss_choice *choice, const char *text, struct error *err);
void gloss_choice_free(struct gloss_choice *choice);

#endif
