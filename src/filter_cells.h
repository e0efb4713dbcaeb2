/* The taps as clusters: cells of 2 x 2 pixels, of 4 x 4, and so on. */
#ifndef POVGLOSS_FILTER_CELLS_H
#define POVGLOSS_FILTER_CELLS_H

#include "filter_internal.h"

#include <math.h>

enum { CELL_LEVELS = 8 };

/* What of it is near and what is far, by the mean of W/r': between the two lies a gap or nothing. Together the one
 * would hide where the other lies. solid is 0 where there is nothing; column and row are not set. */
struct filter_cell {
    struct filter_node layer[2];
    float a[3];   /* mean of those of its pixels */
    float pixels; /* that are taps */
};

struct filter_cells {
    int width[CELL_LEVELS], height[CELL_LEVELS]; /* of level k, in cells of 2^k pixels; level 0 is the picture itself */
    struct filter_cell *level[CELL_LEVELS];      /* [0] is NULL */
};

/* How far the directions of a node may spread, seen from `from`, when its own a's have the mean a: at most, as a
 * standard deviation, in units of r'. */
static inline float filter_node_spread(const struct filter_node *node, const float a[3], const float from[3])
{
    const float x = from[0] - a[0], y = from[1] - a[1], z = from[2] - a[2];
    return node->spread + node->depth * sqrtf(x * x + y * y + z * z);
}

/* One pixel as a node; false where it is no tap. */
bool filter_cell_of_pixel(const struct filter *filter, int x, int y, struct filter_node *node);

/* RESULT_DATA: memory. Free them in any case. */
MUST_CHECK enum result filter_cells_build(const struct filter *filter, struct filter_cells *cells, struct error *err);
void filter_cells_free(struct filter_cells *cells);

#endif
