/* The frames of an animation, chosen, counted and numbered as POV-Ray does it. */
#ifndef POVGLOSS_FRAMES_H
#define POVGLOSS_FRAMES_H

#include "error.h"

#include <stdbool.h>

enum { FRAMES_UNSAID = -1000000000, FRAMES_NUMBER_SIZE = 16 };

/* POV-Ray's settings as the user gives them; FRAMES_UNSAID where there is none. */
struct frames_options {
    int initial, final, step;        /* Initial_Frame, Final_Frame, Frame_Step */
    bool cyclic;                     /* Cyclic_Animation */
    double subset_start, subset_end; /* Subset_Start_Frame, Subset_End_Frame: frames, or shares of them in (0, 1) */
};

struct frames {
    int first, last, step;
    int digits; /* of the numbers in file names; 0: no animation, but one image without a number */
};

struct frames_options frames_options_default(void);
struct frames frames_plan(const struct frames_options *options);

/* How many images there are: 1 or more. */
int frames_count(const struct frames *frames);

/* What POV-Ray puts before the extension of a frame's file: "03" where the last frame is 10; empty for a single
 * image. */
void frames_number(const struct frames *frames, int frame, char number[FRAMES_NUMBER_SIZE]);

/* The path with the frame's number before its extension; the caller frees it. */
MUST_CHECK enum result frames_path(const struct frames *frames, const char *path, int frame, char **numbered,
                                   struct error *err);

#endif
