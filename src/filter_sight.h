/* The innermost loops of the clustered sums: what one pixel's a sees, and the sums of 16 pixels over a list of nodes.
 *
 * filter_sight.c is compiled once per instruction set; all builds give the same bits.
 */
#ifndef POVGLOSS_FILTER_SIGHT_H
#define POVGLOSS_FILTER_SIGHT_H

#include "filter_kernel.h"

#include <stdint.h>

enum {
    SIGHTS_OF_GROUP = 4 + FILTER_LANES, /* that its pixels may use: 4 corners and one for each pixel */
    SIGHT_HIDDEN = 255,                 /* all of it */
    SIGHT_TILE_LEVEL = 4,
    SIGHT_TILE = 1 << SIGHT_TILE_LEVEL, /* pixels across a tile; a cell of it is 4 across */
    SIGHT_TILE_AREA = SIGHT_TILE * SIGHT_TILE,
    SIGHT_LARGE = 4,                    /* tiles across a large square */
    SIGHT_PACKED = 512,                 /* bytes of a tile's levels */
    SIGHT_MARGIN = 64
};

/* Bytes of scratch of sight_march for pictures of `longest` pixels on their longer side. */
#define SIGHT_SCRATCH(longest) ((2 * sizeof(uint16_t) + 2 * SIGHT_TILE + 1) * ((size_t)(longest) + 4 * SIGHT_MARGIN))

/* 16 x 16 taps: x, y, z, w and area as in struct filter_taps, 0 beyond the picture. */
struct sight_taps {
    float planes[5][SIGHT_TILE_AREA];
};

/* The means of 4 x 4 of them each, of all five planes. */
struct sight_tile {
    float cells[5][FILTER_LANES];
    float off[4]; /* of a row of cells: no tap is farther from where its cell's mean and the row's slope put it;
                     INFINITY: some are taps, and some aren't */
};

/* Bounds of the taps of a square in x, y, z and w; low above high where there are none. */
struct sight_box {
    float low[4], high[4];
    bool gaps; /* some of its pixels aren't taps */
};

/* Whether none is a tap. */
static inline bool sight_box_is_empty(const struct sight_box *box)
{
    return box->low[0] > box->high[0];
}

/* The picture by rows, or by columns (`turned`: all that is of columns and rows is exchanged). */
struct sight_field {
    const struct sight_tile *tiles;
    const struct sight_taps *taps;
    const struct sight_box *boxes, *large_boxes; /* of the tiles, and of squares of SIGHT_LARGE x SIGHT_LARGE of them */
    int width, height;                           /* pixels */
    ptrdiff_t column, row;                       /* from a tile to the next one */
    ptrdiff_t large_column, large_row;           /* from a large square to the next one */
    bool turned;
};

/* The pixel that looks: its a, unit direction, and what struct filter_lanes says of them. */
struct sight_eye {
    float a[3], direction[3], blind, fade, step;
    float steepest; /* by how much the share that is seen changes with theta at most, per radian */
};

/* Tiles. */
struct sight_extent {
    int left, top, right, bottom; /* inclusive */
};

/* The share of each tap that is hidden from the eye at pixel (x, y) of the field, 0 to SIGHT_HIDDEN, by the rule of
 * filter_see(): less than would be seen of it if all on the way were at its own angle. One of four wedges of the
 * picture: rows beyond y in the direction of `step` (1 or -1), as far from column x as from row y, to `limit` pixels
 * away. Where the taps of a tile lie as good as in a plane, those of a cell are taken to be at one angle. The shares
 * go to the map, SIGHT_TILE_AREA of each tile with taps by rows of the picture, where they are less than what is there.
 * *extent grows by what was looked at. scratch: SIGHT_SCRATCH(longest) bytes. */
typedef void sight_march(const struct sight_field *field, int x, int y, int step, int limit,
                         const struct sight_eye *eye, uint8_t *scratch, uint8_t *map, struct sight_extent *extent);

/* Where a tile's level k begins, of cells of 2^k pixels: of single pixels their shares, of others the means, the least
 * and the largest. */
static inline int sight_level(int k)
{
    return k == 0 ? 0 : SIGHT_PACKED - (SIGHT_PACKED * 2 >> 2 * k);
}

/* A tile's shares, taken from the map, where all is hidden again: SEEN and HIDDEN whole, or its levels from single
 * pixels to the whole tile. */
enum sight_kind { SIGHT_MIXED, SIGHT_ALL_SEEN, SIGHT_ALL_HIDDEN };
typedef enum sight_kind sight_pack(uint8_t map[SIGHT_TILE_AREA], uint8_t levels[SIGHT_PACKED]);

/* A cluster of taps. With r' the distance of each from its own a', x, y, z, w are the means of b'/r' (W = 1) or of the
 * direction (W = 0), and of W/r': its direction from any a is (x, y, z) - w a, in units of r'. */
struct filter_node {
    float x, y, z, w;
    float solid;         /* steradians from their own a's, all together */
    float cap;           /* mean of one's over 2 pi */
    float spread;        /* standard deviation of their directions, seen from the mean of their own a's, radians */
    float depth;         /* that of W/r' */
    float radiance[3];   /* mean of L0, R, G, B, and of (R + G + B)^2, by the solid angle */
    float square;
    float column, row;   /* middle, pixels */
    float unlike;        /* by how much of it the group's sights differ */
};

/* 16 pixels anywhere, and how they see: the hidden share of a node for lane l is the sum of share[s][l] times that in
 * sight s. */
struct filter_group {
    struct filter_lanes lanes;
    float column[FILTER_LANES], row[FILTER_LANES];
    float limit; /* farthest node that is seen, from its middle, pixels^2 */
    int sights;
    float share[SIGHTS_OF_GROUP][FILTER_LANES];
    float turn, move; /* how far the direction and a shift over the group, of how far things may */
    /* Set by nodes_see, sums of weights: what is seen that shifts farther, whole from twice on; and by how much of what
     * is there the group's sights differ. */
    float unsteady[FILTER_LANES], unlike[FILTER_LANES];
};

/* The sums of filter_see() over nodes in place of taps; hidden: SIGHTS_OF_GROUP shares, 0 to 1, of each node. */
typedef void nodes_see(const struct filter_node *nodes, const float *hidden, int count, struct filter_group *group,
                       struct filter_moments *sums);

/* The sums of filter_kernel() (FILTER_SHAPE_SOLID, round window) over nodes in place of taps, by their middles. */
typedef void nodes_pool(const struct filter_node *nodes, int count, const struct filter_group *group,
                        struct filter_sums *sums);

struct sight_kernel {
    sight_march *march;
    sight_pack *pack;
    nodes_see *see;
    nodes_pool *pool;
};

extern const struct sight_kernel sight_kernel_sse2, sight_kernel_avx2, sight_kernel_avx512;

#endif
