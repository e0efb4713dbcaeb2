/* The passes of a POV-Ray scene: which are rendered, how each scene is written, and what is made of their images.
 *
 *   base         the scene with the glossy finishes' reflection switched off
 *   specular     L0: the camera sees a copy in which glossy surfaces are perfect mirrors, mirrored rays see the scene
 *                itself. Antialiased where the picture is: the rest has one radiance, which tells how much of a pixel is
 *                glossy. With fog, a rainbow or media one ray a pixel, and the rest is black; with focal blur and mixed
 *                textures, too, and L0 times the reflectivity
 *   haze         where there is fog, a rainbow or media, or L0 is weighted: the same without mirrors, which is what
 *                they add before the glossy surface to the specular pass
 *   reflectance  glossy surfaces with their own reflection and no shading, under a sky of one half
 *   reflectivity the same by one ray a pixel, by which a weighted L0 is divided
 *   position     a, coded as a colour (position_code.h)
 *   endpoint     b: mirrors seen by the camera, coded positions seen by mirrored rays, coded directions where they miss
 *   view         some of the camera's rays, coded: all are known by them where they are those of a perspective camera
 *   direction    all of its rays where they aren't: they give the eye and the view angle whatever the camera
 *   exponent     the Phong exponent, where there are several; the passes that only the reflection needs wait for it, or
 *                else for the endpoint, to be rendered where something is glossy alone
 *   place        few positions, which tell the eye's where the passes are rendered with a margin
 *   exponent-mean  the same antialiased, where an exponent is painted, so that its edges are as smooth as the picture's
 *   own          POV-Ray's own picture, small: what the parts must add up to
 */
#ifndef POVGLOSS_PASSES_H
#define POVGLOSS_PASSES_H

#include "gbuffer.h"
#include "povray.h"
#include "povray_switches.h"
#include "scene.h"
#include "timings.h"

struct passes_options {
    const char *scene;  /* path of the .pov file */
    const char *povray; /* the program: "povray" is looked up in PATH */
    const char *keep;   /* folder for the rewritten scenes and raw images, which stays; NULL: none */
    const struct povray_switches *switches;
    struct gloss_choice gloss; /* finishes to make glossy */
    struct frames frames; /* those that the switches ask for */
    int subsample;        /* 1; 2 or 4: specular, a and b are traced at every so-many-th pixel and interpolated; then the
                             switches say the size */
    double margin;        /* in which the reflection is rendered around the picture, as a share of its width and height, and */
    int margin_px;        /* in pixels; one of them is 0. Only for perspective cameras, without subsampling and rays */
    int jobs;             /* POV-Ray processes at the same time; 0: two more than there are cores */
    int timeout_s;        /* for each POV-Ray process; 0: none */
    bool check;           /* POV-Ray's own picture is rendered, too, for passes_check_sum */
    bool means;           /* L0 is the mean over a pixel where the switches ask for antialiasing; not with subsampling */
    bool rays;            /* the gbuffer gets the eye's rays and the mirrored ones; not with subsampling */
    bool sandbox;         /* POV-Ray runs in one (sandbox.h) */
    bool reads;           /* what POV-Ray reads is noted, for passes_reads */
    povray_progress *progress;
    void *progress_context;
    struct timings *timings; /* gets a row for each step; NULL: none */
};

struct passes;

/* Reads the scene as passes_open does, and runs nothing: it may need a discovery. The caller frees it, also after a
 * failure. */
MUST_CHECK enum result passes_load_scene(const struct passes_options *options, struct scene *scene, struct error *err);

/* Reads the scene and writes the passes' scenes. RESULT_DATA for a scene that can't be taken (with file and line) or
 * that has nothing glossy. *note is a warning worth a line to the user, or empty. The options are not copied: they must
 * outlive *passes. The caller closes *passes, also after a failure. */
MUST_CHECK enum result passes_open(const struct passes_options *options, struct passes **passes, struct error *note,
                                   struct error *err);

/* Renders all passes of one frame into *gbuffer, which the caller frees. RESULT_POVRAY with POV-Ray's own message,
 * named by the user's files. *note as above. No process is left. */
MUST_CHECK enum result passes_render(struct passes *passes, int frame, struct gbuffer *gbuffer, struct error *note,
                                     struct error *err);

/* Compares what passes_render made of the frame with POV-Ray's own picture, unless `check` is false or only a part of
 * the picture is rendered. *note is a warning where they differ: something in the scene isn't modelled by the
 * passes. */
MUST_CHECK enum result passes_check_sum(const struct passes *passes, int frame, const struct gbuffer *gbuffer,
                                    struct error *note, struct error *err);
/* Renders what mirrored rays see of the frame that passes_render drew last. `view` is scene text: a camera, and mirrors
 * that no mirrored ray sees; the camera sees nothing but those. *image (R G B, linear) has the size given; the caller
 * frees it. */
MUST_CHECK enum result passes_view(struct passes *passes, int frame, const struct buffer *view, int width, int height,
                                   struct image *image, struct error *err);

/* Adds the files that POV-Ray and povgloss read for the frames that were rendered to *files, as reads_list does. */
MUST_CHECK enum result passes_reads(const struct passes *passes, struct buffer *files, struct error *err);

/* Waits for the ends of POV-Ray's processes, some tenths of a second after their images: the next frame does so, and
 * passes_close, but a frame is right only if none failed. NULL is allowed, here and below. */
MUST_CHECK enum result passes_settle(struct passes *passes, struct error *err);

/* Leaves no folder but `keep`, and no process; RESULT_DATA where the temporary folder can't be removed. */
MUST_CHECK enum result passes_close(struct passes *passes, struct error *err);

#endif
