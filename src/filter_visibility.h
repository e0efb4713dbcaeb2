/* What single pixels see of the others, by the rule of filter_see(), as maps with means of 2 x 2, 4 x 4 and so on. */
#ifndef POVGLOSS_FILTER_VISIBILITY_H
#define POVGLOSS_FILTER_VISIBILITY_H

#include "filter_cells.h"

struct filter_visibility {
    const struct filter *filter;
    struct sight_tile *tiles;
    struct sight_taps *taps;
    struct sight_box *boxes, *large_boxes;
    int across, down; /* tiles */
    struct sight_field rows, columns;
};

/* Levels of cells of one tile and more. */
enum { SIGHT_COARSE_LEVELS = CELL_LEVELS - SIGHT_TILE_LEVEL };

/* The cells of a level that lie in a rectangle outside which all is hidden. */
struct sight_coarse {
    int left, top, across, down;
    size_t first; /* place of the first one's shares */
};

/* What a pixel sees. All 0: nothing is kept. */
struct sight {
    int x, y;
    long used; /* when; 0: never */
    struct sight_coarse coarse[SIGHT_COARSE_LEVELS];
    uint8_t (*shares)[3];        /* mean, least and largest hidden share of each cell */
    int32_t *tiles;              /* each one's place among the levels, or below 0: all of it is seen, or hidden */
    size_t cell_capacity;
    uint8_t *levels; /* sight_pack() */
    size_t capacity;
};

/* What a thread makes sights with. */
struct sight_scratch {
    uint8_t *map; /* of the picture, tile by tile: all hidden but while a sight is made */
    uint8_t *march;
};

/* RESULT_DATA: memory. Free it in any case. */
MUST_CHECK enum result filter_visibility_build(const struct filter *filter, struct filter_visibility *visibility,
                                               struct error *err);
void filter_visibility_free(struct filter_visibility *visibility);

/* False: no memory. Free them in any case. */
MUST_CHECK bool sight_scratch_make(const struct filter_visibility *visibility, struct sight_scratch *scratch);
void sight_scratch_free(struct sight_scratch *scratch);

/* What glossy pixel (x, y) sees, in place of what the sight held. False: no memory; the sight is as good as empty. */
MUST_CHECK bool sight_make(const struct filter_visibility *visibility, int x, int y, struct sight_scratch *scratch,
                           struct sight *sight);
void sight_free(struct sight *sight);

/* Mean, least and largest hidden share, 0 to SIGHT_HIDDEN, of the cell in column x and row y of those of 2^k pixels, a
 * tile or more. */
void sight_share(const struct sight *sight, int k, int x, int y, int share[3]);

/* The levels of the tile in column x and row y, for sight_share_within(); NULL: all of it is seen, or hidden. */
const uint8_t *sight_levels(const struct sight *sight, int x, int y);

/* As sight_share(), of a cell that is smaller than a tile, from the levels of the tile that it lies in. */
static inline void sight_share_within(const uint8_t *levels, int k, int x, int y, int share[3])
{
    const int across = SIGHT_TILE >> k, at = (y & (across - 1)) * across + (x & (across - 1));
    const uint8_t *level = levels + sight_level(k);
    for (int i = 0; i < 3; i++)
        share[i] = level[k > 0 ? i * across * across + at : at];
}

#endif
