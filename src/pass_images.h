/* The images that POV-Ray made of the passes, as a gbuffer. */
#ifndef POVGLOSS_PASS_IMAGES_H
#define POVGLOSS_PASS_IMAGES_H

#include "camera.h"
#include "gbuffer.h"
#include "pass_scene.h"

/* Where the images are, and what their decoding needs. */
struct pass_images {
    const char *folder; /* the image of each pass in a folder of its name, see pass_image_path */
    const char *number; /* of the frame in the images' names, or empty */
    const char *name;   /* of the scene, for messages */
    const struct scene *scene;
    int subsample;
    bool means; /* the specular pass is antialiased */
    bool rays;  /* with those of the mirror */
    int margin_x, margin_y; /* in which the passes for the filter are wider than the picture, on each side; px */
    const struct camera *view;   /* has the picture's rays; NULL: the direction pass has them */
    const struct camera *camera; /* of the picture, with its eye; NULL without a margin */
};

/* The name of a pass's image, which the caller frees: image03.exr, .ppm for codes. */
MUST_CHECK enum result pass_image_name(enum pass_id id, const char *number, char **name, struct error *err);

/* Its path, which the caller frees, too: folder/pass/image03.exr. */
MUST_CHECK enum result pass_image_path(const struct pass_images *images, enum pass_id id, char **path,
                                       struct error *err);

/* The radiance that a pass saw, R G B, linear. */
MUST_CHECK enum result pass_images_radiance(const struct pass_images *images, enum pass_id id, struct image *image,
                                            struct error *err);

/* The smallest window with all pixels at which pass_of_glossy saw something, and 2 more on each side (the
 * others' silhouettes are antialiased); a corner of the picture where it saw nothing. */
MUST_CHECK enum result pass_images_glossy(const struct pass_images *images, struct image_window *window,
                                          struct error *err);

/* The camera, but for its location, whose rays the view pass shows some of. *found is false where it isn't a perspective
 * camera. */
MUST_CHECK enum result pass_images_view(const struct pass_images *images, struct camera *camera, bool *found,
                                        struct error *err);

/* The picture's camera, with its location, from the view and the passes of places. *found is false without a view, or
 * where it sees nothing to tell its location by. */
MUST_CHECK enum result pass_images_camera(const struct pass_images *images, struct camera *camera, bool *found,
                                          struct error *err);

/* Reads and decodes all of them into *gbuffer: a and b, the eye, exponents, reflectance in the working space;
 * subsampled passes interpolated; with a margin the window is the picture in them. RESULT_DATA where an image is
 * missing, broken or of another size than the others; then, too, the caller frees the gbuffer. *note is a warning worth
 * a line where nothing glossy is seen. */
MUST_CHECK enum result pass_images_read(const struct pass_images *images, struct gbuffer *gbuffer, struct error *note,
                                        struct error *err);

#endif
