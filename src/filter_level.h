/* The filter at one resolution: the picture's own, or one at which a pixel stands for a square of pixels.
 */
#ifndef POVGLOSS_FILTER_LEVEL_H
#define POVGLOSS_FILTER_LEVEL_H

#include "filter.h"
#include "filter_kernel.h"

/* What all resolutions of one picture have in common. */
struct filter_shared {
    const struct gbuffer *gbuffer;
    const struct filter_options *options;
    filter_kernel *kernel;
    filter_see *see;
    float *table;
    double length_scale, radiance_scale; /* powers of two that keep squares and sums within the range of a float */
    double energy;
    double floor;                        /* of the best filter's weights */
    double radius_limit_px;
};

struct filter_level {
    const struct filter_shared *shared;
    struct filter_taps taps; /* shift 0 */
    float *own[4];           /* a, in the units of the taps; the exponent, below 0: not glossy; as wide as the taps */
    struct image radius;     /* 1 channel: equation (5), pixels */
    struct image glossy;     /* 3 channels: the blurred radiance */
    struct image confidence; /* 1 channel */
};

/* Empty planes of the size of the passes. The caller frees them, after a failure, too. */
MUST_CHECK enum result filter_level_alloc(struct filter_level *level, const struct filter_shared *shared,
                                          struct error *err);
void filter_level_free(struct filter_level *level);

MUST_CHECK enum result filter_taps_alloc(struct filter_taps *taps, int width, int height, int shift,
                                         struct error *err);
void filter_taps_free(struct filter_taps *taps);

/* The length and radiance scales for the passes. */
void filter_level_scales(struct filter_shared *shared);

/* Bands of rows (context: the level). Of the picture itself, from the passes: taps, then areas, which need their
 * neighbours. Of every level: the radii at every radius_step-th pixel (row counts those rows), then those between. */
void filter_level_taps(void *level, int first, int end);
void filter_level_areas(void *level, int first, int end);
void filter_level_radius_coarse(void *level, int first, int end);
void filter_level_radius_fine(void *level, int first, int end);

/* Kinds and boxes of the blocks in the rows. */
void filter_taps_blocks(struct filter_taps *taps, int first, int end);

enum { FILTER_CELLS_MAX = 8 };

/* What 16 pixels in one row, 2^shift columns apart, sum over: around their own the pixels themselves, then rings of
 * cells of 2 x 2, 4 x 4 ... pixels. */
struct filter_view {
    int shift;
    int cells;  /* number of cell sizes: 1, 2, 4 ... */
    struct filter_taps taps[FILTER_CELLS_MAX];
};

/* Results of 16 pixels of row y from column x on. The ring of one cell size ends `inner` cells of the next from the
 * pixel's own; 0: there is one ring, of pixels. scratch: filter_level_scratch() floats, aligned to 64 bytes. */
void filter_level_blur(struct filter_level *level, const struct filter_view *view, int inner, int x, int y,
                       float *scratch);
size_t filter_level_scratch(const struct filter_view *view);

/* Edges take the mean of results at most so far away. */
enum { FILTER_EDGE_REACH_PX = 3 };

/* Whether the picture needs a result in columns first to last of row y: a margin is only looked at. */
bool filter_level_needs(const struct filter_level *level, int first, int last, int y);

const float *filter_level_tap(const struct filter_level *level, enum filter_plane plane, int x, int y);
bool filter_level_is_tap(const struct filter_level *level, int x, int y);
double filter_level_phong(const struct filter_level *level, int x, int y);
void filter_level_position(const struct filter_level *level, int x, int y, float a[3]);

/* Unit direction from a to the tap's b, and its distance (1 for W = 0); a distance of 0 leaves the direction 0. */
double filter_level_direction(const struct filter_level *level, const float a[3], int x, int y, double direction[3]);

/* From this exponent on the lobe is narrower than any pixel. */
#define FILTER_MIRROR_PHONG 1e20

#endif
