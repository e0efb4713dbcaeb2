/* Which unions may be taken apart: a transparent object is drawn once, while what is glossy stands in both copies of
 * the base pass, each part seen by other rays. */
#ifndef POVGLOSS_SCENE_UNIONS_H
#define POVGLOSS_SCENE_UNIONS_H

#include "scene.h"

/* Notes the unions that hold nothing but objects, and the names of such: once, when it is known what may be
 * transparent. */
MUST_CHECK enum result scene_note_unions(struct scene *scene, struct error *err);

/* Whether the objects in these braces are placed one by one: those of a union that may hold something transparent, at
 * the top level, in such a union, or declared or made by a macro for such places alone. */
bool union_splits(const struct scene_file *file, int brace, bool in_macro);

/* Whether `object { X ... }` or `object { M(...) ... }` at `token` is such a declared union. */
bool is_split_object(const struct scene_file *file, int token);

#endif
