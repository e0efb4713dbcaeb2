/* The finishes of a scene that reflect, as its text tells: nothing is executed. */
#ifndef POVGLOSS_SCENE_LIST_H
#define POVGLOSS_SCENE_LIST_H

#include "scene.h"

/* Appends a table to *text: a header and a line for each finish, in the order of the files and lines. Columns are
 * aligned and `-` where there is nothing; none but the last holds a space of its own:
 *   NAME        of the innermost #declare or #local around
 *   PLACE       file:line
 *   EXPONENT    that of Gloss() or Gloss_Roughness(), both ends of a Gloss_Map(), else that of --gloss auto; an
 *               expression as it is written
 *   REFLECTION  as it is written
 * A finish that begins with a declared one has what that one has. Of included files, only finishes whose declared
 * names the scene uses, itself or through other names. *count is the number of finishes; without one nothing is
 * appended. */
MUST_CHECK enum result scene_list(const struct scene *scene, struct buffer *text, int *count, struct error *err);

#endif
