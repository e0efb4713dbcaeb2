/* Whether the parts of a picture add up to the renderer's own, told by a small picture that the renderer makes of the
 * same scene, one ray a pixel. */
#ifndef POVGLOSS_PICTURE_CHECK_H
#define POVGLOSS_PICTURE_CHECK_H

#include "image.h"

#include <stdbool.h>

/* The size of the small picture: the smallest of at least 2000 pixels whose pixels' centres are centres in the full
 * one, too (the ratio is an odd whole number). Where there is none, about a fifth of the width and height in the same
 * proportion, and a full picture of at most 160 x 160 pixels is its own. */
void picture_check_size(int width, int height, int *small_width, int *small_height);

struct picture_difference {
    bool found;           /* more than can be chance */
    double share;         /* of the picture that differs */
    int x, y;             /* where it differs most, in the full picture from 0 */
    float sum[3], own[3]; /* there */
};

/* Compares `sum`, the full picture, with `own`, the small one: both linear, of 3 channels, of any sizes. `single_rays`:
 * a pixel of `sum` is one ray through its centre, neither antialiased nor interpolated.
 *
 * d = own - sum, bilinear at the pixels' centres; a difference of t = tolerance (1 + 2 v), v the larger value, is
 * allowed. Antialiasing, other places in the pixels and random samples change single pixels, upwards and downwards at
 * random. So two things are counted:
 *
 * - blocks of about 4 x 4 pixels whose mean d is further from 0 than t and 5 times its standard error (Student's
 *   t-test); found is a share above 0.5 % of them, and above 5 % where the pixels' centres don't coincide;
 * - with single rays and the same centres: pixels with |d| above t. Of the pairs of neighbours that both are such, S
 *   differ in the same direction and O in opposite ones (the join-count statistic; Cliff and Ord, Spatial Processes,
 *   1981). The share is that of the pixels times (S - O)/(S + O); found is one above 0.25 %, with S - O above 6
 *   standard deviations, sqrt(S + O).
 *
 * NaN and two equal infinities don't differ. RESULT_DATA: memory. */
MUST_CHECK enum result picture_check(const struct image *sum, const struct image *own, bool single_rays, double tolerance,
                                     struct picture_difference *difference, struct error *err);

#endif
