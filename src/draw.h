/* povgloss render and passes: every frame from its scene to its file. Messages go to standard error. */
#ifndef POVGLOSS_DRAW_H
#define POVGLOSS_DRAW_H

#include "command.h"

/* Draws all frames of the command, and writes its make rule. */
MUST_CHECK enum result draw_frames(struct command *command, struct error *err);

/* Refuses a file that can't be made. Devices and pipes are opened only when they are written. */
MUST_CHECK enum result draw_check_place(const char *path, struct error *err);

/* Opens the passes unless they are, renders and checks one frame, shows how far it is, and warns; `frame` ("frame 3: ",
 * or empty) names it in messages. The caller frees *gbuffer and closes *passes, also after a failure. */
MUST_CHECK enum result draw_passes(struct command *command, struct passes **passes, int number, const char *frame,
                                   struct gbuffer *gbuffer, struct error *err);

/* Prints a note as a warning, unless it is empty or the command quiet. */
void draw_warn(const struct command *command, const char *frame, const struct error *note);

/* A folder that stays is no failure of the picture, but must not stay unknown: a warning. */
void draw_close_passes(struct passes **passes);

#endif
