/* What of a scene's files the scene itself may use: a library declares much that stands in no picture. */
#ifndef POVGLOSS_SCENE_USES_H
#define POVGLOSS_SCENE_USES_H

#include "scene.h"

/* The last token of `#declare X = keyword {...};` whose directive is at `token`, if it does nothing but give X a value;
 * else -1. */
int end_of_block(const struct scene_file *file, int token);

/* Gives the fact NAME_USED to the declared names that the scene's own file names and what stands outside of such
 * declarations and of macros, and to those that the declarations and macros of these name in turn; to all where the scene
 * includes a file that only POV-Ray knows. */
void scene_note_uses(struct scene *scene);

/* Calls `note` for every token that isn't part of such a declaration, or of a macro, of a name without that fact. */
void scene_walk_used(struct scene *scene, void (*note)(struct scene *scene, const struct scene_file *file, int token));

#endif
