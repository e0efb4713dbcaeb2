/* Which names hold what finishes, textures and materials begin with, where it comes through parameters of macros,
 * arrays and other names. */
#ifndef POVGLOSS_SCENE_SURFACES_H
#define POVGLOSS_SCENE_SURFACES_H

#include "scene.h"

/* Notes surfaces, arrays of them and the macros that take them, whose parameters become declared names: once, when all
 * files are known. */
void scene_note_surfaces(struct scene *scene);

#endif
