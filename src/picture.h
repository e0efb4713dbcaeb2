/* The finished picture of a gbuffer in one call, and smaller gbuffers for a quick look at it. */
#ifndef POVGLOSS_PICTURE_H
#define POVGLOSS_PICTURE_H

#include "filter.h"

/* picture (allocated here, 3 channels, linear; the caller frees it): filter_apply, compose, and what the window of the
 * filter's gbuffer shows of it. Fails as they do; *picture is then empty. */
MUST_CHECK enum result picture_draw(struct filter *filter, const struct filter_options *options, struct image *picture,
                                    struct error *err);

/* reduced (the caller frees it) has every step-th pixel across and down, and the gbuffer's view of them; what only
 * probes need is left out. RESULT_DATA: memory; *reduced is then empty. */
MUST_CHECK enum result picture_reduce(const struct gbuffer *gbuffer, int step, struct gbuffer *reduced, struct error *err);

#endif
