/* Which names hold what finishes, textures and materials begin with, where it comes through parameters of macros, arrays and
 * other names. */
#ifndef POVGLOSS_SCENE_SURFACES_H
#define POVGLOSS_SCENE_SURFACES_H

#include "scene.h"

/* Fills surfaces, surface_arrays and surface_macros of the scene, and adds the parameters among the surfaces to its names:
 * once, when all files are known. */
MUST_CHECK enum result scene_note_surfaces(struct scene *scene, struct error *err);

#endif
