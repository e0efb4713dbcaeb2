/* Which clusters of taps stand for all taps, to a block of pixels. */
#ifndef POVGLOSS_FILTER_WALK_H
#define POVGLOSS_FILTER_WALK_H

#include "filter_cells.h"
#include "filter_visibility.h"

/* Nodes in a row, and, of what is seen, the hidden share of each, 0 to 1, for each sight: SIGHTS_OF_GROUP. All 0:
 * none. */
struct filter_nodes {
    struct filter_node *nodes;
    float *hidden;
    int count, capacity, hidden_capacity;
    bool out_of_memory;
};

/* A cell is used whole where it is small for its distance, its directions differ by little of the lobe, and what part
 * of it is hidden counts for little. */
struct filter_walk {
    int left, top, right, bottom;     /* of the block, pixels, inclusive */
    int finest;                       /* cells of so many pixels are always used whole */
    int reach_px;                     /* of the pool, from the block */
    int limit_px;                     /* nothing farther from a pixel is seen */
    const struct filter_lanes *lanes; /* of the block's pixels */
    int middle;                       /* a lane in the middle */
    float turn;                       /* of the pixels' directions from the middle one, radians */
    float lobe;                       /* its integral, steradians */
    float size;                       /* of a cell, of its distance in pixels */
    float spread;                     /* of a cell's directions, radians */
    float hidden;                     /* what the hidden share of a cell may be off, of the whole lobe's weight */
    const struct sight *sights[SIGHTS_OF_GROUP];
    int sight_count;                  /* 0: all is seen */
};

/* The nodes that are seen, in place of what was there. */
void filter_walk(const struct filter *filter, const struct filter_cells *cells, const struct filter_walk *walk,
                 struct filter_nodes *nodes);

/* Those of the pool, seen or not. */
void filter_walk_pool(const struct filter *filter, const struct filter_cells *cells, const struct filter_walk *walk,
                      struct filter_nodes *nodes);

void filter_nodes_free(struct filter_nodes *nodes);

#endif
