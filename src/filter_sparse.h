/* The fast filter: exact results at some pixels, interpolation between them where it is good enough. */
#ifndef POVGLOSS_FILTER_SPARSE_H
#define POVGLOSS_FILTER_SPARSE_H

#include "filter_level.h"

/* Fills level->glossy and ->confidence (taps, areas and radii are there) within about `tolerance` of the exact sums. */
MUST_CHECK enum result filter_sparse(struct filter_level *level, double tolerance, struct error *err);

#endif
