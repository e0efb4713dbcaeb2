/* A perspective camera from what its rays look like. */
#ifndef POVGLOSS_CAMERA_H
#define POVGLOSS_CAMERA_H

#include "image.h"
#include "mem.h"

#include <stdbool.h>

/* POV-Ray's: the ray through the picture's point (u, v), both from -1/2 (left, top) to 1/2, is direction + u right - v
 * up. */
struct camera {
    double location[3], direction[3], right[3], up[3];
};

/* Finds direction, right and up (their common length is free) from the directions of all pixels' rays: X Y Z planes of
 * unit vectors. The ratio of two components of the ray is the ratio of two affine functions of (u, v): a homography, by
 * linear least squares. False where that isn't what they are, to within their coding (5e-5): the camera isn't a
 * perspective one. */
bool camera_fit(const struct image *directions, struct camera *camera);

/* The rays' directions at the centres of width x height pixels, allocated here; the caller frees them. */
MUST_CHECK enum result camera_directions(const struct camera *camera, int width, int height, struct image *directions,
                                         struct error *err);

/* Appends the camera as scene text, its picture wider and higher by the factors. */
MUST_CHECK enum result camera_text(const struct camera *camera, double wider, double higher, struct buffer *text,
                                   struct error *err);

/* Horizontal, radians, between the middles of the left and the right edge. */
double camera_view_angle(const struct camera *camera);

#endif
