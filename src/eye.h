/* The eye and the view angle from what the camera's rays look like, whatever the camera. */
#ifndef POVGLOSS_EYE_H
#define POVGLOSS_EYE_H

#include "gbuffer.h"

/* Fills eye and view_angle of the gbuffer from its positions and the directions of the rays that found them (X Y Z
 * planes of unit vectors, same size as the positions).
 *
 * The eye is the point nearest to all the lines through the positions along their directions (least squares, each line
 * weighted by the inverse square of its position's distance). There is none (has_eye false) when the rays are parallel
 * or don't meet: an orthographic camera, for instance. The view angle is that of the middle row, from its outer edges.
 */
void eye_find(struct gbuffer *gbuffer, const struct image *directions);

#endif
