/* What is known from further rays of the lobe, N at each pixel in random directions, put into a filtered reflection.
 *
 * The mean M of a pixel's own rays is right on average and noisy; the filtered F is smooth, and wrong where no mirrored
 * ray went. The filter's error changes slowly over the picture, so it is the mean of M - F over neighbours, and F is a
 * control variate of M:
 *
 *   L(x) = F(x) + sum w n (M - F)(x') / sum w n
 *   w    = (1 - |dx|/T)+ (1 - |dy|/T)+ exp(-tan^2(theta) / (2 s^2)) min(r, r') / max(r, r'),
 *   T    = 1 + 9/sqrt(N) pixels,  s^2 = 2/p + (3g/N)^2
 *
 * n: how many of the pixel's rays count; theta: the angle at a(x) between b(x) and b(x'), as in the filter; g: its
 * least tan to one of the four next pixels; r, r': the distances of b(x) and b(x') from a(x), for what is right at a
 * contact says nothing of the wall behind. exp(-theta^2 p / 4) is how much the lobes of x and x' have in common; a lobe
 * of less than 3/N pixels counts as one of these, for few rays need many neighbours. T and s make the number of rays in
 * the mean grow slowly with N, and its window shrink, so that L goes to the truth.
 */
#ifndef POVGLOSS_CONTROL_VARIATE_H
#define POVGLOSS_CONTROL_VARIATE_H

#include "gbuffer.h"

/* Adds that to `glossy` (3 channels, the gbuffer's size) at the pixels whose rays were drawn with the exponent in use:
 * that of the gbuffer's plane; `phong` in its place, unless it is NaN, changes nothing where it is another, or without
 * that plane. Exponents of 1e20 and more are mirrors, without error. A radiance that was not negative doesn't get so.
 * Rays (R G B: M, A: n) that are not finite, or 0 of them, don't count. threads as for bands_run. RESULT_DATA: memory;
 * RESULT_INTERRUPTED. */
MUST_CHECK enum result control_variate(const struct gbuffer *gbuffer, float phong, int threads, struct image *glossy,
                                       struct error *err);

#endif
