/* The passes of a POV-Ray scene: which are rendered, how each scene is written, and what is made of their images.
 *
 *   base         the scene with the glossy finishes' reflection switched off
 *   specular     L0: the camera sees a copy in which glossy surfaces are perfect mirrors and the rest is black, mirrored
 *                rays see the scene itself
 *   reflectance  glossy surfaces with their own reflection and no shading, under a sky of one half
 *   position     a, coded as a colour (position_code.h)
 *   endpoint     b: mirrors seen by the camera, coded positions seen by mirrored rays, coded directions where they miss
 *   direction    the camera's rays, coded: they give the eye and the view angle whatever the camera
 *   exponent     the Phong exponent, where the scene has more than one
 */
#ifndef POVGLOSS_PASSES_H
#define POVGLOSS_PASSES_H

#include "gbuffer.h"
#include "povray.h"
#include "scene_rewrite.h"
#include "scene_rewrite.h"

struct passes_options {
    const char *scene;             /* path of the .pov file */
    const char *povray;            /* the program: "povray" is looked up in PATH */
    const char *keep;              /* folder for the rewritten scenes and raw images, which stays; NULL: none */
    struct gloss_choice gloss;     /* finishes to make glossy */
    const char *const *switches;   /* POV-Ray's own, passed through in their order */
    int switch_count;
    const char *const *libraries;  /* the user's +L folders, in their order */
    int library_count;
    bool antialias;                /* the switches ask for it */
    int width, height;             /* of the image where the switches say it, else 0 */
    int subsample;                 /* 1; 2 or 4: specular, a and b are traced at every so-many-th pixel and interpolated */
    int jobs;                      /* POV-Ray processes at the same time; 0: two more than there are cores */
    struct buffer *reads;          /* gets the files that POV-Ray read (reads.h); NULL: not asked */
    povray_progress *progress;
    void *progress_context;
};

/* Renders all passes of the scene into *gbuffer, which the caller frees. RESULT_DATA for a scene that can't be taken (with
 * file and line) or that has nothing glossy, RESULT_POVRAY with POV-Ray's own message, named by the user's files. *note is
 * a warning worth a line to the user, or empty. No folder (but `keep`) and no process is left. */
MUST_CHECK enum result passes_render(const struct passes_options *options, struct gbuffer *gbuffer, struct error *note,
                                     struct error *err);

/* Reads the scene as passes_render does, and runs nothing; the caller frees it, also after a failure. */
MUST_CHECK enum result passes_load_scene(const struct passes_options *options, struct scene *scene, struct error *err);

#endif
