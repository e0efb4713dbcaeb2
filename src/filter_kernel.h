/* The innermost loops of the filter: equation (1) for 16 neighbouring pixels of a row at once.
 *
 * filter_kernel.c is compiled once per instruction set; all builds give the same bits.
 */
#ifndef POVGLOSS_FILTER_KERNEL_H
#define POVGLOSS_FILTER_KERNEL_H

#include <stdbool.h>
#include <stddef.h>

enum {
    FILTER_LANES = 16,
    /* Unusable columns left and right of the picture, so that no lane reads outside and no column needs a test. */
    FILTER_BORDER = FILTER_LANES
};

/* Channels of the planes of taps. */
enum filter_plane {
    FILTER_PLANE_X, /* b: a position (W = 1) or a unit direction (W = 0) */
    FILTER_PLANE_Y,
    FILTER_PLANE_Z,
    FILTER_PLANE_W,
    FILTER_PLANE_GAIN, /* 0: this tap counts for nothing, and its other planes are 0 */
    FILTER_PLANE_R,    /* L0 */
    FILTER_PLANE_G,
    FILTER_PLANE_B,
    FILTER_PLANE_AREA, /* of the pixel at b, across the ray (length^2), or its solid angle for W = 0; 0: unusable */
    FILTER_PLANE_NEAREST, /* least distance^2 at which that area is seen whole */
    FILTER_PLANES
};

/* How many times larger than from its own a the solid angle of a pixel may be from another: from so near it is no
 * longer one point. */
#define FILTER_MOST_ENLARGED 10.0

/* What kinds of usable endpoints a block of 16 columns holds. */
enum { FILTER_KIND_POSITION = 1, FILTER_KIND_DIRECTION = 2 };

/* SOLID: the power times the solid angle of the tap's pixel. */
enum filter_shape { FILTER_SHAPE_POWER, FILTER_SHAPE_TABLE, FILTER_SHAPE_GAUSS, FILTER_SHAPE_SOLID };

/* Bounds of the usable positions in a block; low above high where there are none. */
struct filter_box {
    float low[3], high[3];
};

/* All pixels as taps: what a neighbour gives. Column x of the picture is column x + FILTER_BORDER of the planes. */
struct filter_taps {
    int width, height;                   /* of the picture */
    size_t stride;                       /* floats from row to row of a plane: a multiple of 16 */
    const float *planes[FILTER_PLANES];
    const unsigned char *kinds;          /* stride / 16 blocks a row */
    const struct filter_box *boxes;      /* as many */
    bool square;                         /* window: max(|dx|, |dy|) <= rho, else dx^2 + dy^2 <= rho^2 */
    enum filter_shape shape;
    const float *table;                  /* weights_table_build(), for FILTER_SHAPE_TABLE */
};

/* What is computed: 16 pixels of row y from column x on (a multiple of 16). Unused lanes: limit -1, the rest 0. */
struct filter_lanes {
    int x, y;
    unsigned char kinds;               /* of the used lanes */
    bool narrow;                       /* the slope of every used lane is at least FILTER_NARROW_SLOPE; for filter_see
                                          the reach at most FILTER_NARROW_REACH */
    struct filter_box box;             /* of a, used lanes */
    float farthest;                    /* the largest distance of the used lanes with W = 1 */
    float a[3][FILTER_LANES];
    float b[4][FILTER_LANES];          /* as in the planes */
    float direction[3][FILTER_LANES];  /* unit vector from a to b */
    float distance[FILTER_LANES];      /* |b - a|; 1 for a direction */
    /* The weight is 2^-(slope log2(1 + t)) for the power, table[slope log2(1 + t)] for the table, 2^-(slope t) for the
     * Gaussian; t = tan^2(theta). */
    float slope[FILTER_LANES];
    float limit[FILTER_LANES];         /* rho^2, pixels^2 */
    /* For filter_see alone: */
    float across[2][3][FILTER_LANES];  /* unit vectors at right angles to the direction and to each other */
    float reach[FILTER_LANES];         /* largest tan^2(theta) of the lobe */
    float blind[FILTER_LANES];         /* nothing beyond a tap of a larger tan^2(theta) is seen; -1: an unused lane */
    float fade[FILTER_LANES];          /* by how much more is seen the smaller that tan^2(theta) is, up to all */
    float step[FILTER_LANES];          /* tan^2(theta) at least, per pixel^2, where no endpoint is known */
    float floor;                       /* taken off cos^p; what would be negative is 0 */
    int limit_px;                      /* farthest tap from the lanes' own pixels */
};

/* sum f L0 (R, G, B) and sum f of equation (1). */
struct filter_sums {
    double value[4][FILTER_LANES];
};

/* sum f L0 and sum f, and those times where in the lobe a tap lies: u and v are sin(theta) cos(theta) along the axes
 * across[0] and across[1] of the lanes. */
enum filter_moment {
    FILTER_MOMENT_R,
    FILTER_MOMENT_G,
    FILTER_MOMENT_B,
    FILTER_MOMENT_1,
    FILTER_MOMENT_U,
    FILTER_MOMENT_V,
    FILTER_MOMENT_UU,
    FILTER_MOMENT_UV,
    FILTER_MOMENT_VV,
    FILTER_MOMENT_RU,
    FILTER_MOMENT_GU,
    FILTER_MOMENT_BU,
    FILTER_MOMENT_RV,
    FILTER_MOMENT_GV,
    FILTER_MOMENT_BV,
    FILTER_MOMENT_SQUARE, /* of R + G + B */
    FILTER_MOMENTS
};

struct filter_moments {
    double value[FILTER_MOMENTS][FILTER_LANES];
    float low[3][FILTER_LANES], high[3][FILTER_LANES]; /* of L0 where f is above 0 */
};

/* From this slope of the power (p = 240 and more) on, the weights are below 2^-120, that is 0, before tan(theta)
 * reaches 1. */
#define FILTER_NARROW_SLOPE 120.0f
#define FILTER_NARROW_REACH 0.13f

/* Sums over the window of every lane (lanes with a limit below 0: sums of 0). Weights below 2^-120 are 0; so are those
 * of taps at 90 degrees and more from a lane's direction. */
typedef void filter_kernel(const struct filter_taps *taps, const struct filter_lanes *lanes, struct filter_sums *sums);

filter_kernel filter_kernel_sse2, filter_kernel_avx2, filter_kernel_avx512;

/* Sums over the taps that every lane's a sees: weights (cos^p - floor) times the solid angle of the tap's pixel.
 *
 * All that the camera sees in the mirror along a straight line of pixels from the lane's own lies in one plane, and is
 * in front of what follows on the line: what comes back into the lobe after a tap at a larger angle theta is another
 * thing behind that one, or what another mirror saw. A tap hides 1 - (blind - t) fade, 0 to 1, of itself and of what
 * follows, with t its tan^2(theta), and no more than the most on the line counts: shares of all or none would show in
 * the picture as lines. The taps that are seen are thus one patch around the lane's own pixel, which grows until all
 * of its rim is out of reach. The straight line to a tap comes in between two neighbours, each of which counts the more
 * the nearer the line is to it.
 *
 * scratch: FILTER_SEE_SCRATCH(width) bytes, aligned to 64, with any content. */
typedef void filter_see(const struct filter_taps *taps, const struct filter_lanes *lanes, float *scratch,
                        struct filter_moments *sums);

#define FILTER_SEE_COLUMNS(width) ((size_t)(width) + 64)
#define FILTER_SEE_SCRATCH(width) (FILTER_SEE_COLUMNS(width) * 3 * FILTER_LANES * sizeof(float))

filter_see filter_see_sse2, filter_see_avx2, filter_see_avx512;

#endif
