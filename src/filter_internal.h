/* What filter.c's stages and the fast filter share. */
#ifndef POVGLOSS_FILTER_INTERNAL_H
#define POVGLOSS_FILTER_INTERNAL_H

#include "filter.h"
#include "filter_kernel.h"
#include "filter_sight.h"

#include <stdatomic.h>

/* How far beyond the picture, which may be a part of the planes, results are looked at. */
enum { FILTER_EDGE_REACH_PX = 3 };

struct fast;

struct filter {
    const struct gbuffer *gbuffer;

    /* Built once; NULL: not yet. For the mode, formula and `without` of the options that it was built for. */
    struct filter_options built_for;
    float *planes;
    unsigned char *kinds;
    struct filter_box *boxes;
    float *table;
    double length_scale, radiance_scale; /* powers of two that keep squares and sums within the range of a float */
    struct fast *fast;                   /* the fast filter's part, which only that builds */

    /* Of one call. */
    const struct filter_options *options;
    filter_kernel *kernel;
    filter_see *see;
    const struct sight_kernel *sight;
    struct filter_taps taps;
    double floor; /* of the best filter's weights */
    double whole; /* the share of a lobe's integral that is seen of it where nothing hides any */
    double radius_limit_px;
    struct image radius, confidence;
    struct image *glossy;
    atomic_bool out_of_memory;
};

/* Up to 16 pixels that are summed together, each in its lane. */
struct filter_pixels {
    int xs[FILTER_LANES], ys[FILTER_LANES];
    bool used[FILTER_LANES];
};

/* What the sums over all endpoints about a pixel, seen from its a or not, count beside the sums over what is seen. */
struct filter_help {
    double share;   /* factor of these sums */
    double missing; /* their weights come to this many steradians besides */
};

static inline const float *filter_tap_at(const struct filter *filter, enum filter_plane plane, int x, int y)
{
    return filter->taps.planes[plane] + (size_t)y * filter->taps.stride + (size_t)x + FILTER_BORDER;
}

static inline bool filter_is_glossy(const struct filter *filter, int x, int y)
{
    return *filter_tap_at(filter, FILTER_PLANE_GAIN, x, y) > 0;
}

static inline bool filter_is_inside(const struct filter *filter, int x, int y)
{
    return x >= 0 && y >= 0 && x < filter->taps.width && y < filter->taps.height;
}

/* The exponent of a glossy pixel. */
double filter_exponent_at(const struct filter *filter, int x, int y);

/* a in the units of the taps. */
void filter_position_at(const struct filter *filter, int x, int y, float a[3]);

/* Unit direction from a to the tap's b, and its distance (1 for W = 0); a distance of 0 leaves the direction 0. */
double filter_direction_to(const struct filter *filter, const float a[3], int x, int y, double direction[3]);

/* Fills lane l of the best filter with pixel (x, y), but for its limit. False: nothing to sum, the result is L0. */
bool filter_lane_fill(const struct filter *filter, int x, int y, int l, struct filter_lanes *lanes);

/* Lanes of which none is used. */
struct filter_lanes filter_lanes_empty(int x, int y);

/* Whether the picture needs one of these pixels: a margin is only looked at. */
bool filter_is_needed(const struct filter *filter, int x, int y, int width, int height);

/* What the pixels need besides what is seen. Where any does, the limits of the lanes are set for the sums of the pool,
 * and the result is true. */
bool filter_help_needed(const struct filter *filter, const struct filter_pixels *pixels,
                        const struct filter_moments *seen, struct filter_lanes *lanes,
                        struct filter_help help[FILTER_LANES]);

/* The results of the pixels. */
void filter_write_best(struct filter *filter, const struct filter_pixels *pixels, const struct filter_moments *seen,
                       const struct filter_sums *pool, const struct filter_help help[FILTER_LANES]);

/* The exact sums of up to 16 pixels from column x of row y on, written. scratch: as for filter_see. */
void filter_best_lanes(struct filter *filter, int x, int y, float *scratch);

/* The pixel's own L0. */
void filter_write_mirror(struct filter *filter, int x, int y);

#endif
