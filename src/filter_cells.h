/* Taps for the fast filter: cells of 2^n x 2^n pixels, in the order in which 16 pixels some columns apart look at
 * them. */
#ifndef POVGLOSS_FILTER_CELLS_H
#define POVGLOSS_FILTER_CELLS_H

#include "filter_level.h"

MUST_CHECK enum result filter_cells_view(const struct filter_level *level, int shift, int cells, struct filter_view *view,
                                         struct error *err);
void filter_cells_view_free(struct filter_view *view);

#endif
