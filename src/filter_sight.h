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
    SIGHT_MARGIN = 64
};

/* Floats of scratch of sight_march for pictures of `longest` pixels on their longer side. */
#define SIGHT_SCRATCH(longest) (2 * ((size_t)(longest) + 3 * SIGHT_MARGIN))

/* The taps by rows of the picture, or by columns (width and height exchanged): planes as in struct filter_taps. */
struct sight_planes {
    int width, height;
    size_t stride;
    const float *x, *y, *z, *w, *area;
};

/* The pixel that looks: its a, unit direction, and what struct filter_lanes says of them. */
struct sight_eye {
    float a[3], direction[3], blind, fade, step;
};

struct sight_extent {
    int left, top, right, bottom; /* inclusive */
};

/* The share of each tap that is hidden from the eye at pixel (x, y) of `planes`, 0 to SIGHT_HIDDEN, by the rule of
 * filter_see(): less than would be seen of it if all on the way were at its own angle. One of four wedges of the
 * picture: rows beyond y in the direction of `step` (1 or -1), as far from column x as from row y, to `limit` pixels
 * away. The share of column u and row v is written to hidden[u * column + v * row]; what no way reaches is left as it
 * is. *extent grows by what was written. scratch: SIGHT_SCRATCH(longest) floats. */
typedef void sight_march(const struct sight_planes *planes, int x, int y, int step, int limit,
                         const struct sight_eye *eye, float *scratch, uint8_t *hidden, ptrdiff_t column, ptrdiff_t row,
                         struct sight_extent *extent);

/* The next coarser level of three maps of width x height (both even): means, least and largest of 2 x 2. */
typedef void sight_reduce(const uint8_t *const from[3], int width, int height, uint8_t *const to[3]);

/* A cluster of taps. With r' the distance of each from its own a', x, y, z, w are the means of b'/r' (W = 1) or of the
 * direction (W = 0), and of W/r': its direction from any a is (x, y, z) - w a, in units of r'. */
struct filter_node {
    float x, y, z, w;
    float solid;         /* steradians from their own a's, all together */
    float cap;           /* mean of one's over 2 pi */
    float spread;        /* variance of their directions, seen from the mean of their own a's, radians^2 */
    float radiance[3];   /* mean of L0, R, G, B, and of (R + G + B)^2, by the solid angle */
    float square;
    float column, row;   /* middle, pixels */
    bool visible;        /* from any of the group's sights */
};

/* 16 pixels anywhere, and how they see: the hidden share of a node for lane l is the sum of share[s][l] times that in
 * sight s. */
struct filter_group {
    struct filter_lanes lanes;
    float column[FILTER_LANES], row[FILTER_LANES];
    int sights;
    float share[SIGHTS_OF_GROUP][FILTER_LANES];
    float nearest[FILTER_LANES]; /* set by nodes_see: 1/r' of the nearest thing that counts, 0 where none does */
};

/* The sums of filter_see() over nodes in place of taps; hidden: SIGHTS_OF_GROUP shares, 0 to 1, of each node. */
typedef void nodes_see(const struct filter_node *nodes, const float *hidden, int count, struct filter_group *group,
                       struct filter_moments *sums);

/* The sums of filter_kernel() (FILTER_SHAPE_SOLID, round window) over nodes in place of taps, by their middles. */
typedef void nodes_pool(const struct filter_node *nodes, int count, const struct filter_group *group,
                        struct filter_sums *sums);

struct sight_kernel {
    sight_march *march;
    sight_reduce *reduce;
    nodes_see *see;
    nodes_pool *pool;
};

extern const struct sight_kernel sight_kernel_sse2, sight_kernel_avx2, sight_kernel_avx512;

#endif
