/* The best filter's sums over clusters of pixels, at some pixels, and interpolated between those. */
#ifndef POVGLOSS_FILTER_FAST_H
#define POVGLOSS_FILTER_FAST_H

#include "filter_internal.h"

/* Whether the options want it, and the picture is so large that it helps. */
bool filter_fast_applies(const struct filter *filter);

/* Writes the result and the confidence of every glossy pixel that is needed, as the sums over every tap would give it
 * but for what filter.h says of the tolerance. The taps, their areas and the radii must be there; clusters and
 * what else doesn't depend on the exponent stay in filter->fast for the next call. RESULT_DATA: memory;
 * RESULT_INTERRUPTED. */
MUST_CHECK enum result filter_fast(struct filter *filter, struct error *err);

/* Frees what stayed; NULL is allowed. */
void filter_fast_free(struct fast *fast);

#endif
