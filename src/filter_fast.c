/* The best filter, fast: what the exact sums do for each pixel alone, shared.
 *
 * - Blocks of 4 x 4 pixels are computed together, 16 to 1 pixels apart: as far as the things that they see shift by
 *   little of the lobe from one to the next. What lies between is interpolated, and computed where it can't be: at
 *   the borders of mirrors.
 * - Taps are clustered (filter_cells.h, filter_walk.h): a cell is used whole where it is small for its distance, its
 *   directions differ by little of the lobe, and it is seen whole or not at all.
 * - What is seen is found (filter_visibility.h) for the corners of blocks, and interpolated for the pixels between by
 *   the share of each cell that is hidden; where the corners differ by too much, or near things come out uneven, blocks
 *   are halved, down to single pixels. What hides may be narrower than any cell: a sight looks at every pixel.
 * - The pool, all that is about a pixel, seen or not, is clustered for squares of 16 x 16 pixels.
 *
 * Each row of the largest blocks is done by itself, so that the result doesn't depend on the threads.
 */
#include "filter_fast.h"

#include "bands.h"
#include "filter_cells.h"
#include "filter_visibility.h"
#include "filter_walk.h"
#include "interrupt.h"
#include "lobe.h"

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    LANES = FILTER_LANES,
    SIDE = 4,         /* computed pixels across a block */
    BLOCK_LEVELS = 5, /* of blocks whose pixels are 1, 2, 4, 8 and 16 apart */
    LARGEST = SIDE << (BLOCK_LEVELS - 1),
    POOL_LEVEL = 2,                  /* blocks below this level share a pool */
    REACH = 3 << (BLOCK_LEVELS - 1), /* pixels: interpolation comes from no farther, 3 (8 + 4 + 2 + 1) */
    SIGHTS = 100,                    /* that are kept, while their memory allows: */
    /* Of a picture, and of the radius: the exact sums of smaller ones are as fast. */
    LEAST_PIXELS = 1 << 14,
    LEAST_RADIUS = 32
};

static const double sights_bytes = 0x1p27;

/* Lobes above this exponent are narrower than what floats in units of r' tell apart. */
static const float phong_most = 1e5f;

/* Of 16 x 16 pixels that are summed exactly: how many they may look at, over pi: of the lobe and, in part, of the pool.
 * Where the mirror turns too much for blocks; where most need sights of their own; and elsewhere. */
static const float curved_pixels = 600, rough_pixels = 12000, few_pixels = 300, pool_part = 0.43f;

/* Lobes wider than this, tan^2(theta), hold more pixels than those of far things. */
static const float narrow_reach = 0.01f;

/* Units: of the lobe's width, 1/sqrt(p) radians, at most 1. */
struct settings {
    float smooth;   /* things shift by no more over a block, */
    float unsteady; /* but for this share of what is seen (no unit) */
    float bend;     /* and more, where the second differences of the results are at most this share of the largest */
    float unlike;   /* the share of what is there by which a block's sights may differ (no unit) */
    float spread;   /* of the directions of a cell that is used whole */
    float size;     /* of such a cell, of its distance in pixels (no unit) */
    float hidden;   /* what the hidden share of such a cell may be off, of the whole lobe's weight (no unit) */
};

/* Measured: povscenes/contact.pov, interior.pov and spheres.pov, 640x360, p = 30, 300 and 3000. */
static struct settings settings_of(double tolerance)
{
    const double e = tolerance / FILTER_TOLERANCE_NORMAL;
    return (struct settings){.smooth = (float)(4 * pow(e, 1.6)),
                             .unsteady = (float)(0.01 * pow(e, 2)),
                             .bend = (float)(0.1 * pow(e, 2.3)),
                             .unlike = (float)fmin(0.3 * pow(e, 2.6), 1),
                             .spread = (float)pow(e, 1.4),
                             .size = (float)(pow(e, 1.3) / 3),
                             .hidden = (float)(0.03 * pow(e, 4))};
}

/* A sight isn't lent to a pixel from which what it sees is shifted by more, nor is a pixel at the border of a mirror
 * interpolated from such: what is there is something else. */
static const double lent_most = 8, between_most = 0.25;

/* By how much of its weights in the block the corners must be alike to a pixel that has no sight of its own. */
static const float corners_least = 0.5f;

/* How far the direction may turn over a block, of how far things may shift: a turn shifts them all. */
static const float turn_most = 0.75f;

/* The largest of what changes from a pixel to the next, within a block. */
struct rate {
    float turn;                   /* of the direction, radians */
    float move;                   /* of a */
    float phong_low, phong_high;  /* of the passes, 1 where those have none; high is -1 where nothing is glossy */
    bool border;                  /* not all is */
};

struct fast {
    struct filter *filter;
    struct filter_cells cells;
    struct filter_visibility visibility;
    struct rate *rates[BLOCK_LEVELS];
    int across[BLOCK_LEVELS], down[BLOCK_LEVELS]; /* blocks */
    /* Of one call: */
    struct settings settings;
    pthread_mutex_t lock;
    struct worker *idle; /* those of threads that have just done their blocks */
    unsigned char *known, *apart; /* of each pixel: its result is there; log2 of how far apart its block's pixels are */
};

/* What the pixels of a square all have about them. */
struct pool {
    int left, top, size; /* of the square, pixels; 0: there is nothing */
    struct filter_nodes nodes;
};

/* What one thread works with, and leaves to the next one. */
struct worker {
    struct fast *fast;
    struct worker *next;
    struct sight sights[SIGHTS];
    int sight_count; /* that may be kept */
    long clock;
    struct sight_scratch scratch;
    float *exact;     /* of filter_best_lanes */
    struct filter_nodes nodes;
    struct pool pool;
    bool out_of_memory;
};

/* Pixels that are computed together. */
struct pixels {
    struct filter_pixels at;
    struct filter_group group;
};

/* A block's pixels, how they see, and what they may use whole. */
struct block {
    struct pixels lattice, between; /* where it can't be interpolated */
    int between_count;
    struct filter_walk walk;
};

bool filter_fast_applies(const struct filter *filter)
{
    const struct filter_options *options = filter->options;
    const long pixels = (long)filter->taps.width * filter->taps.height;
    return options->mode == FILTER_MODE_BEST && options->tolerance > 0 && filter->radius_limit_px >= LEAST_RADIUS &&
           (pixels >= LEAST_PIXELS || options->tolerance >= FILTER_TOLERANCE_DRAFT);
}

static size_t pixel_of(const struct fast *fast, int x, int y)
{
    return (size_t)y * (size_t)fast->filter->taps.width + (size_t)x;
}

/* --- what is built once --- */

/* What changes from one glossy pixel to another: the direction, radians, and a; and the larger 1/r of the two. */
struct shift {
    double turn, move, near;
};

static struct shift shift_between(const struct filter *filter, int x, int y, int u, int v)
{
    float a[2][3];
    double direction[2][3], turn = 0, move = 0;
    filter_position_at(filter, x, y, a[0]);
    filter_position_at(filter, u, v, a[1]);
    const double here = filter_direction_to(filter, a[0], x, y, direction[0]);
    const double there = filter_direction_to(filter, a[1], u, v, direction[1]);
    for (int i = 0; i < 3; i++) {
        turn += (direction[1][i] - direction[0][i]) * (direction[1][i] - direction[0][i]);
        move += (double)(a[1][i] - a[0][i]) * (double)(a[1][i] - a[0][i]);
    }
    return (struct shift){.turn = sqrt(turn),
                          .move = sqrt(move),
                          .near = fmax((double)*filter_tap_at(filter, FILTER_PLANE_W, x, y) / here,
                                       (double)*filter_tap_at(filter, FILTER_PLANE_W, u, v) / there)};
}

static struct rate rate_of_pixel(const struct filter *filter, int x, int y)
{
    const struct image *phong = &filter->gbuffer->phong;
    struct rate rate = {.phong_low = INFINITY, .phong_high = -1, .border = true};
    if (!filter_is_glossy(filter, x, y))
        return rate;
    rate.border = false;
    rate.phong_low = rate.phong_high = phong->pixels ? image_row(phong, 0, y)[x] : 1;
    for (int n = 0; n < 2; n++) {
        const int u = x + (n == 0), v = y + (n == 1);
        if (!filter_is_inside(filter, u, v) || !filter_is_glossy(filter, u, v)) {
            rate.border = true;
            continue;
        }
        const struct shift shift = shift_between(filter, x, y, u, v);
        rate.turn = fmaxf(rate.turn, (float)shift.turn);
        rate.move = fmaxf(rate.move, (float)shift.move);
    }
    return rate;
}

static void rate_add(struct rate *sum, struct rate rate)
{
    sum->turn = fmaxf(sum->turn, rate.turn);
    sum->move = fmaxf(sum->move, rate.move);
    sum->phong_low = fminf(sum->phong_low, rate.phong_low);
    sum->phong_high = fmaxf(sum->phong_high, rate.phong_high);
    sum->border = sum->border || rate.border;
}

/* A level that is being filled. */
struct level {
    struct fast *fast;
    int k, pass; /* of rows_fill */
};

/* Rates of rows of a level's blocks, of pixels or of the blocks of the level below. */
static void rates_fill(void *context, int first, int end)
{
    const struct level *level = context;
    const struct fast *fast = level->fast;
    const int k = level->k, factor = k == 0 ? SIDE : 2;
    const int width = k == 0 ? fast->filter->taps.width : fast->across[k - 1];
    const int height = k == 0 ? fast->filter->taps.height : fast->down[k - 1];
    for (int y = first; y < end; y++)
        for (int x = 0; x < fast->across[k]; x++) {
            struct rate rate = {.phong_low = INFINITY, .phong_high = -1};
            for (int v = y * factor; v < (y + 1) * factor; v++)
                for (int u = x * factor; u < (x + 1) * factor; u++) {
                    if (u >= width || v >= height)
                        rate.border = true;
                    else if (k == 0)
                        rate_add(&rate, rate_of_pixel(fast->filter, u, v));
                    else
                        rate_add(&rate, fast->rates[k - 1][(size_t)v * (size_t)width + (size_t)u]);
                }
            fast->rates[k][(size_t)y * (size_t)fast->across[k] + (size_t)x] = rate;
        }
}

static enum result rates_build(struct fast *fast, struct error *err)
{
    enum result result = RESULT_OK;
    for (int k = 0; !result && k < BLOCK_LEVELS; k++) {
        struct level level = {.fast = fast, .k = k};
        const int size = SIDE << k;
        fast->across[k] = (fast->filter->taps.width + size - 1) / size;
        fast->down[k] = (fast->filter->taps.height + size - 1) / size;
        const size_t count = (size_t)fast->across[k] * (size_t)fast->down[k];
        fast->rates[k] = malloc(count * sizeof *fast->rates[k]);
        if (!fast->rates[k])
            return error_memory(err, (double)count * (double)sizeof *fast->rates[k]);
        result = bands_run(fast->down[k], 4, fast->filter->options->threads, rates_fill, &level, err);
    }
    return result;
}

/* The rate of a block of level k, with the exponents of the call. */
static struct rate rate_of_block(const struct fast *fast, int x, int y, int k)
{
    const struct filter_options *options = fast->filter->options;
    struct rate rate = fast->rates[k][(size_t)y * (size_t)fast->across[k] + (size_t)x];
    if (rate.phong_high >= 0 && (options->phong_override || !fast->filter->gbuffer->phong.pixels))
        rate.phong_low = rate.phong_high = options->phong;
    return rate;
}

/* --- sights --- */

/* Whether the things that both pixels see shift by less than `limit` of the lobe's width from one to the other. */
static bool is_alike(const struct filter *filter, int x, int y, int u, int v, double limit)
{
    if (!filter_is_inside(filter, u, v) || !filter_is_glossy(filter, x, y) || !filter_is_glossy(filter, u, v) ||
        filter_exponent_at(filter, x, y) != filter_exponent_at(filter, u, v))
        return false;
    const struct shift shift = shift_between(filter, x, y, u, v);
    return shift.turn + shift.move * shift.near < limit / sqrt(filter_exponent_at(filter, x, y) + 1);
}

/* The sight of pixel (x, y), made or kept; NULL: no memory. */
static const struct sight *sight_of(struct worker *worker, int x, int y)
{
    struct sight *oldest = &worker->sights[0];
    worker->clock++;
    for (int i = 0; i < worker->sight_count; i++) {
        struct sight *sight = &worker->sights[i];
        if (sight->used && sight->x == x && sight->y == y) {
            sight->used = worker->clock;
            return sight;
        }
        if (sight->used < oldest->used)
            oldest = sight;
    }
    const bool made = sight_make(&worker->fast->visibility, x, y, &worker->scratch, oldest);
    oldest->used = made ? worker->clock : 0;
    worker->out_of_memory = worker->out_of_memory || !oldest->used;
    return oldest->used ? oldest : NULL;
}

static bool sight_add(struct worker *worker, struct block *block, int x, int y)
{
    const struct sight *sight = sight_of(worker, x, y);
    block->walk.sights[block->walk.sight_count++] = sight;
    return sight != NULL;
}

/* The share of the sight of corner (x, y), c, that will be the block's next one, for the pixels that are alike to it,
 * but for those with one of their own. Added to what they have found; whether there are any. */
static bool corner_share(const struct filter *filter, const struct block *block, int size, int c, int x, int y,
                         const bool own[LANES], struct pixels *pixels, float found[LANES])
{
    bool any = false;
    for (int l = 0; l < LANES; l++) {
        const double right = (double)(pixels->at.xs[l] - block->walk.left) / size;
        const double down = (double)(pixels->at.ys[l] - block->walk.top) / size;
        const double weight = (c & 1 ? right : 1 - right) * (c >> 1 ? down : 1 - down);
        if (!pixels->at.used[l] || own[l] || !(weight > 0) ||
            !is_alike(filter, x, y, pixels->at.xs[l], pixels->at.ys[l], lent_most))
            continue;
        pixels->group.share[block->walk.sight_count][l] = (float)weight;
        found[l] += (float)weight;
        any = true;
    }
    return any;
}

/* The shares of each lane's sights come to 1. */
static void shares_complete(struct pixels *pixels, int sight_count)
{
    pixels->group.sights = sight_count;
    for (int l = 0; l < LANES; l++) {
        float total = 0;
        for (int s = 0; s < sight_count; s++)
            total += pixels->group.share[s][l];
        for (int s = 0; s < sight_count && total > 0; s++)
            pixels->group.share[s][l] /= total;
    }
}

/* How the block's pixels see: by its corners, or those of the lattice by one of their own: where no corner is alike to
 * them, and where `own` says so. False: to a pixel between no corner is alike. */
static bool sights_choose(struct worker *worker, struct block *block, int size, const bool own[LANES])
{
    static const bool none[LANES] = {false};
    const struct filter *filter = worker->fast->filter;
    const int left = block->walk.left, top = block->walk.top;
    const int xs[2] = {left, left + size < filter->taps.width ? left + size : filter->taps.width - 1};
    const int ys[2] = {top, top + size < filter->taps.height ? top + size : filter->taps.height - 1};
    float found[LANES] = {0}, found_between[LANES] = {0};
    block->walk.sight_count = 0;
    memset(block->lattice.group.share, 0, sizeof block->lattice.group.share);
    for (int c = 0; c < 4; c++) {
        const int x = xs[c & 1], y = ys[c >> 1];
        bool any = corner_share(filter, block, size, c, x, y, own, &block->lattice, found);
        if (block->between_count > 0)
            any |= corner_share(filter, block, size, c, x, y, none, &block->between, found_between);
        if (any && !sight_add(worker, block, x, y))
            return true;
    }
    for (int l = 0; l < block->between_count; l++)
        if (!(found_between[l] > 0))
            return false;
    for (int l = 0; l < LANES; l++)
        if (block->lattice.at.used[l] && found[l] < corners_least) {
            for (int s = 0; s < block->walk.sight_count; s++)
                block->lattice.group.share[s][l] = 0;
            block->lattice.group.share[block->walk.sight_count][l] = 1;
            if (!sight_add(worker, block, block->lattice.at.xs[l], block->lattice.at.ys[l]))
                return true;
        }
    shares_complete(&block->lattice, block->walk.sight_count);
    shares_complete(&block->between, block->walk.sight_count);
    return true;
}

/* --- blocks --- */

/* A pixel that is to be computed. */
static bool pixel_add(struct fast *fast, struct pixels *pixels, int l, int x, int y)
{
    struct filter *filter = fast->filter;
    if (!filter_is_inside(filter, x, y) || !filter_is_glossy(filter, x, y))
        return false;
    pixels->at.used[l] = filter_lane_fill(filter, x, y, l, &pixels->group.lanes);
    if (!pixels->at.used[l]) {
        filter_write_mirror(filter, x, y);
        fast->known[pixel_of(fast, x, y)] = 1;
        return false;
    }
    pixels->at.xs[l] = x;
    pixels->at.ys[l] = y;
    pixels->group.column[l] = (float)x;
    pixels->group.row[l] = (float)y;
    return true;
}

/* What the directions of a cell may spread, radians, to lobes of up to an exponent. */
static float spread_for(const struct fast *fast, double phong)
{
    return fast->settings.spread / (float)sqrt(fmax(phong, 1));
}

/* The block's lattice, `apart` pixels from each other. False: there is nothing to sum. */
static bool block_fill(struct fast *fast, int x, int y, int apart, struct block *block)
{
    struct filter *filter = fast->filter;
    double phong_most_used = 0;
    bool any = false;
    *block = (struct block){.walk = {.left = x,
                                     .top = y,
                                     .right = x + (SIDE - 1) * apart,
                                     .bottom = y + (SIDE - 1) * apart,
                                     .finest = apart > 2 ? apart / 2 : 1,
                                     .limit_px = (int)filter->radius_limit_px,
                                     .lanes = &block->lattice.group.lanes,
                                     .size = fast->settings.size,
                                     .hidden = fast->settings.hidden}};
    block->lattice.group.lanes = block->between.group.lanes = filter_lanes_empty(x, y);
    block->lattice.group.limit = block->between.group.limit = (float)block->walk.limit_px * (float)block->walk.limit_px;
    for (int l = 0; l < LANES; l++) {
        const int u = x + l % SIDE * apart, v = y + l / SIDE * apart;
        if (!pixel_add(fast, &block->lattice, l, u, v))
            continue;
        if (!any || l == LANES / 2)
            block->walk.middle = l;
        any = true;
        phong_most_used = fmax(phong_most_used, filter_exponent_at(filter, u, v));
    }
    block->walk.lobe = (float)lobe_integral(phong_most_used, filter->floor);
    block->walk.spread = spread_for(fast, phong_most_used);
    return any;
}

/* How far the two pixels between which (x, y), but (0, 0), is interpolated are from it. */
static void neighbours_of(int x, int y, int *dx, int *dy)
{
    const int both = x | y, apart = both & -both; /* the largest power of two that divides both */
    *dx = y % (2 * apart) == 0 ? apart : 0;
    *dy = *dx > 0 ? 0 : apart;
}

/* What lies between the lattice's pixels and can't be interpolated. False: that is too much. */
static bool between_fill(struct fast *fast, int apart, struct block *block)
{
    const struct filter *filter = fast->filter;
    const int size = SIDE * apart;
    for (int y = block->walk.top; y < block->walk.top + size; y++)
        for (int x = block->walk.left; x < block->walk.left + size; x++) {
            int dx, dy;
            if ((x % apart == 0 && y % apart == 0) || !filter_is_inside(filter, x, y) ||
                !filter_is_glossy(filter, x, y))
                continue;
            neighbours_of(x, y, &dx, &dy);
            if (is_alike(filter, x, y, x - dx, y - dy, between_most) &&
                is_alike(filter, x, y, x + dx, y + dy, between_most))
                continue;
            if (block->between_count == LANES)
                return false;
            block->between_count += pixel_add(fast, &block->between, block->between_count, x, y);
        }
    block->walk.right = block->walk.left + size - 1;
    block->walk.bottom = block->walk.top + size - 1;
    return true;
}

/* What brings a shift from a pixel to the next to that over a block of level k, of how far things may. */
static float shift_scale(const struct fast *fast, const struct rate *rate, int k)
{
    return (float)(SIDE << k) * sqrtf(fmaxf(rate->phong_high, 1)) / fast->settings.smooth;
}

/* Whether a part of what lane l sees is more than `limit` of it. */
static bool is_more(const struct pixels *pixels, const struct filter_moments *seen, const float part[LANES], int l,
                    float limit)
{
    return pixels->at.used[l] && part[l] > limit * (float)seen->value[FILTER_MOMENT_1][l];
}

static void pixels_see(struct worker *worker, struct pixels *pixels, struct filter_moments *seen)
{
    const struct filter_nodes *nodes = &worker->nodes;
    if (!worker->out_of_memory)
        worker->fast->filter->sight->see(nodes->nodes, nodes->hidden, nodes->count, &pixels->group, seen);
}

/* What the pixels of the lattice see, from the block's corners or by their own sight, and of which nodes. False: to a
 * pixel between no corner is alike. */
static bool block_see(struct worker *worker, struct block *block, int k, const bool own[LANES],
                      struct filter_moments *seen)
{
    struct fast *fast = worker->fast;
    const bool everything = fast->filter->options->without & FILTER_WITHOUT_VISIBILITY;
    if (!everything && !sights_choose(worker, block, SIDE << k, own))
        return false;
    if (!worker->out_of_memory)
        filter_walk(fast->filter, &fast->cells, &block->walk, &worker->nodes);
    worker->out_of_memory = worker->out_of_memory || worker->nodes.out_of_memory;
    pixels_see(worker, &block->lattice, seen);
    return true;
}

/* Whether pixel (x, y) may need the pool. */
static bool pool_serves(const struct filter *filter, int x, int y)
{
    return filter_is_inside(filter, x, y) && filter_is_glossy(filter, x, y) &&
           image_row(&filter->radius, 0, y)[x] >= 1;
}

/* What a walk for a square's pixels has to know of them: the one next to its middle, how far the others' directions
 * are from that one's, and how far away they look. */
static void square_look(const struct filter *filter, struct filter_walk *walk, struct filter_lanes *lanes)
{
    const int size = walk->right + 1 - walk->left, area = size * size;
    int middle = -1, least = area;
    for (int i = 0; i < area; i++) {
        const int right = i % size - size / 2, down = i / size - size / 2;
        if (right * right + down * down < least && pool_serves(filter, walk->left + i % size, walk->top + i / size)) {
            least = right * right + down * down;
            middle = i;
        }
    }
    if (middle < 0 ||
        !filter_lane_fill(filter, walk->left + middle % size, walk->top + middle / size, walk->middle, lanes))
        return;
    for (int i = 0; i < area; i++) {
        const int x = walk->left + i % size, y = walk->top + i / size;
        float a[3], square = 0;
        double direction[3];
        if (!pool_serves(filter, x, y))
            continue;
        filter_position_at(filter, x, y, a);
        filter_direction_to(filter, a, x, y, direction);
        for (int k = 0; k < 3; k++) {
            const float off = (float)direction[k] - lanes->direction[k][walk->middle];
            square += off * off;
        }
        walk->turn = fmaxf(walk->turn, sqrtf(square));
        walk->reach_px = (int)fmax(walk->reach_px, ceil((double)image_row(&filter->radius, 0, y)[x]));
    }
}

/* What pixels of a block of level k have about them: of a square of POOL_LEVEL or more, whose blocks share it. */
static const struct filter_nodes *pool_of(struct worker *worker, const struct pixels *pixels, int k)
{
    const struct fast *fast = worker->fast;
    const int level = k > POOL_LEVEL ? k : POOL_LEVEL, size = SIDE << level;
    const int left = pixels->group.lanes.x / size * size, top = pixels->group.lanes.y / size * size;
    struct pool *pool = &worker->pool;
    if (pool->size == size && pool->left == left && pool->top == top)
        return &pool->nodes;
    const struct rate rate = rate_of_block(fast, left / size, top / size, level);
    struct filter_lanes lanes = filter_lanes_empty(left, top);
    struct filter_walk walk = {.left = left,
                               .top = top,
                               .right = left + size - 1,
                               .bottom = top + size - 1,
                               .finest = size / LANES,
                               .lanes = &lanes,
                               .size = fast->settings.size,
                               .spread = spread_for(fast, (double)rate.phong_high)};
    square_look(fast->filter, &walk, &lanes);
    filter_walk_pool(fast->filter, &fast->cells, &walk, &pool->nodes);
    worker->out_of_memory = worker->out_of_memory || pool->nodes.out_of_memory;
    pool->left = left;
    pool->top = top;
    pool->size = size;
    return &pool->nodes;
}

/* Writes what pixels of a block of level k see. */
static void pixels_write(struct worker *worker, int k, struct pixels *pixels, const struct filter_moments *seen)
{
    struct fast *fast = worker->fast;
    struct filter *filter = fast->filter;
    struct filter_sums sums = {0};
    struct filter_help help[LANES] = {{0}};
    if (filter_help_needed(filter, &pixels->at, seen, &pixels->group.lanes, help)) {
        const struct filter_nodes *pool = pool_of(worker, pixels, k);
        if (!worker->out_of_memory)
            filter->sight->pool(pool->nodes, pool->count, &pixels->group, &sums);
    }
    filter_write_best(filter, &pixels->at, seen, &sums, help);
    for (int l = 0; l < LANES; l++)
        if (pixels->at.used[l])
            fast->known[pixel_of(fast, pixels->at.xs[l], pixels->at.ys[l])] = 1;
}

/* Whether the results of the lattice are about on a line, from each pixel to the next ones in its row and column. */
static bool is_even(const struct fast *fast, const struct pixels *lattice)
{
    for (int i = 0; i < 3; i++) {
        float bend = 0, most = 0, value[LANES];
        for (int l = 0; l < LANES; l++) {
            value[l] = lattice->at.used[l]
                           ? image_row(fast->filter->glossy, i, lattice->at.ys[l])[lattice->at.xs[l]] : NAN;
            most = fmaxf(most, fabsf(value[l]));
        }
        for (int l = 0; l < LANES; l++) {
            const bool row = l % SIDE > 0 && l % SIDE < SIDE - 1, column = l / SIDE > 0 && l / SIDE < SIDE - 1;
            if (row)
                bend = fmaxf(bend, fabsf(value[l - 1] - 2 * value[l] + value[l + 1]));
            if (column)
                bend = fmaxf(bend, fabsf(value[l - SIDE] - 2 * value[l] + value[l + SIDE]));
        }
        if (bend > fast->settings.bend * most)
            return false;
    }
    return true;
}

/* Computes the pixels of a block of level k. False: what it sees is too near for so large a block, or is seen too
 * differently from its corners, or too much of it can't be interpolated. */
static bool block_compute(struct worker *worker, const struct rate *rate, int x, int y, int k)
{
    struct fast *fast = worker->fast;
    const struct settings *settings = &fast->settings;
    struct block block;
    struct pixels *lattice = &block.lattice, *between = &block.between;
    struct filter_moments seen = {0}, seen_between = {0};
    bool own[LANES] = {false}, any_own = false, steady = true;
    if (!block_fill(fast, x, y, 1 << k, &block))
        return k == 0;
    if (k > 0 && rate->border && !between_fill(fast, 1 << k, &block))
        return false;
    block.walk.turn = rate->turn * (float)(SIDE << k) / 2;
    lattice->group.turn = rate->turn * shift_scale(fast, rate, k);
    lattice->group.move = rate->move * shift_scale(fast, rate, k);
    if (!block_see(worker, &block, k, own, &seen))
        return false;
    for (int l = 0; l < LANES; l++) {
        own[l] = is_more(lattice, &seen, lattice->group.unlike, l, settings->unlike);
        any_own = any_own || own[l];
        steady = steady && !is_more(lattice, &seen, lattice->group.unsteady, l, settings->unsteady);
    }
    if (k > 0 && any_own)
        return false;
    if (any_own)
        block_see(worker, &block, k, own, &seen);
    if (!worker->out_of_memory)
        pixels_write(worker, k, lattice, &seen);
    if (k > 0 && !steady && !is_even(fast, lattice))
        return false;
    if (block.between_count > 0)
        pixels_see(worker, between, &seen_between);
    for (int l = 0; l < block.between_count; l++)
        if (is_more(between, &seen_between, between->group.unlike, l, settings->unlike))
            return false;
    if (block.between_count > 0 && !worker->out_of_memory)
        pixels_write(worker, k, between, &seen_between);
    return true;
}

/* Whether summing over all pixels is faster for 16 x 16 of them, so few lie in their lobes, even of far things; or the
 * lobes are so narrow that clusters would lose them. */
static bool is_exact(const struct fast *fast, const struct rate *rate, int x, int y)
{
    const struct filter *filter = fast->filter;
    struct filter_lanes lanes = filter_lanes_empty(x, y);
    const float limit = (float)filter->radius_limit_px;
    float most = 0;
    int used = 0, lent = 0;
    for (int l = 0; l < LANES; l++) {
        const int u = x + l % SIDE * SIDE, v = y + l / SIDE * SIDE;
        if (!filter_is_inside(filter, u, v) || !filter_is_glossy(filter, u, v) ||
            !filter_lane_fill(filter, u, v, l, &lanes))
            continue;
        const float rho = image_row(&filter->radius, 0, v)[u];
        const float lobe = lanes.reach[l] / lanes.step[l] * fmaxf(lanes.reach[l] / narrow_reach, 1);
        most = fmaxf(most, fminf(lobe, limit * limit) + pool_part * rho * rho);
        used++;
        lent += is_alike(filter, u, v, u + 1, v, lent_most) && is_alike(filter, u, v, u, v + 1, lent_most);
    }
    const bool rough = 4 * lent < 3 * used, curved = rate->turn * shift_scale(fast, rate, 1) > turn_most;
    return rate->phong_high > phong_most ||
           (used > 0 && most < (rough ? rough_pixels : curved ? curved_pixels : few_pixels));
}

/* Every tap of 16 x 16 pixels' lobes. */
static void block_exact(struct worker *worker, int x, int y)
{
    struct fast *fast = worker->fast;
    for (int v = y; v < y + LANES && v < fast->filter->taps.height; v++) {
        filter_best_lanes(fast->filter, x, v, worker->exact);
        for (int u = x; u < x + LANES && u < fast->filter->taps.width; u++)
            fast->known[pixel_of(fast, u, v)] = filter_is_glossy(fast->filter, u, v);
    }
}

static void block_do(struct worker *worker, int x, int y, int k)
{
    struct fast *fast = worker->fast;
    const struct filter_taps *taps = &fast->filter->taps;
    const int size = SIDE << k;
    if (x >= taps->width || y >= taps->height || worker->out_of_memory || interrupt_signal() ||
        !filter_is_needed(fast->filter, x - REACH, y - REACH, size + 2 * REACH, size + 2 * REACH))
        return;
    const struct rate rate = rate_of_block(fast, x / size, y / size, k);
    if (rate.phong_high < 0)
        return;
    if (size == LANES && is_exact(fast, &rate, x, y)) {
        block_exact(worker, x, y);
        return;
    }
    const bool steady = rate.phong_low == rate.phong_high && rate.turn * shift_scale(fast, &rate, k) <= turn_most;
    const bool fine = rate.phong_high <= phong_most && (k == 0 || steady);
    if ((fine && block_compute(worker, &rate, x, y, k)) || k == 0) {
        for (int v = y; v < y + size && v < taps->height; v++)
            memset(fast->apart + pixel_of(fast, x, v), k, (size_t)(x + size < taps->width ? size : taps->width - x));
        return;
    }
    for (int v = y; v < y + size; v += size / 2)
        for (int u = x; u < x + size; u += size / 2)
            block_do(worker, u, v, k - 1);
}

/* NULL: no memory. */
static struct worker *worker_make(struct fast *fast)
{
    const int width = fast->filter->taps.width;
    const int kept = (int)(sights_bytes / (2 * (double)width * (double)fast->filter->taps.height));
    struct worker *worker = calloc(1, sizeof *worker);
    if (!worker)
        return NULL;
    worker->fast = fast;
    worker->sight_count = kept > SIGHTS ? SIGHTS : kept < SIGHTS_OF_GROUP ? SIGHTS_OF_GROUP : kept;
    worker->exact = aligned_alloc(64, FILTER_SEE_SCRATCH(width));
    worker->out_of_memory = !sight_scratch_make(&fast->visibility, &worker->scratch) || !worker->exact;
    return worker;
}

static void worker_free(struct worker *worker)
{
    for (int i = 0; i < SIGHTS; i++)
        sight_free(&worker->sights[i]);
    filter_nodes_free(&worker->nodes);
    filter_nodes_free(&worker->pool.nodes);
    free(worker->exact);
    sight_scratch_free(&worker->scratch);
    free(worker);
}

static struct worker *worker_take(struct fast *fast)
{
    pthread_mutex_lock(&fast->lock);
    struct worker *worker = fast->idle;
    fast->idle = worker ? worker->next : NULL;
    pthread_mutex_unlock(&fast->lock);
    return worker ? worker : worker_make(fast);
}

static void worker_leave(struct worker *worker)
{
    struct fast *fast = worker->fast;
    pthread_mutex_lock(&fast->lock);
    worker->next = fast->idle;
    fast->idle = worker;
    pthread_mutex_unlock(&fast->lock);
}

/* Blocks of the largest size, row by row. */
static void blocks_do(void *context, int first, int end)
{
    struct fast *fast = context;
    const int across = fast->across[BLOCK_LEVELS - 1];
    struct worker *worker = worker_take(fast);
    for (int i = first; worker && i < end; i++)
        block_do(worker, i % across * LARGEST, i / across * LARGEST, BLOCK_LEVELS - 1);
    if (!worker || worker->out_of_memory)
        atomic_store(&fast->filter->out_of_memory, true);
    if (worker)
        worker_leave(worker);
}

/* --- between the computed pixels --- */

static bool is_known(const struct fast *fast, int x, int y)
{
    return filter_is_inside(fast->filter, x, y) && fast->known[pixel_of(fast, x, y)];
}

/* From its neighbours_of(): by a cubic of four where they are alike, else by the mean of two. */
static void interpolate(struct fast *fast, int x, int y)
{
    static const double cubic[4] = {-1 / 16., 9 / 16., 9 / 16., -1 / 16.}, line[4] = {0, 0.5, 0.5, 0};
    const struct filter *filter = fast->filter;
    int dx, dy;
    neighbours_of(x, y, &dx, &dy);
    const bool far = is_known(fast, x - 3 * dx, y - 3 * dy) && is_known(fast, x + 3 * dx, y + 3 * dy) &&
                     is_alike(filter, x, y, x - 3 * dx, y - 3 * dy, 1) &&
                     is_alike(filter, x, y, x + 3 * dx, y + 3 * dy, 1);
    const double *weights = far ? cubic : line;
    for (int i = 0; i < 4; i++) {
        const struct image *image = i < 3 ? filter->glossy : &filter->confidence;
        double value = 0; /* a cubic of the largest floats is beyond them */
        for (int n = far ? 0 : 1; n < (far ? 4 : 3); n++)
            value += weights[n] * (double)image_row(image, i % 3, y + (2 * n - 3) * dy)[x + (2 * n - 3) * dx];
        image_row(image, i % 3, y)[x] = (float)fmax(-(double)FLT_MAX, fmin(value, (double)FLT_MAX));
    }
    fast->known[pixel_of(fast, x, y)] = 1;
}

/* All pixels of some rows whose block's are 2^k apart or more get results `2^k / 2` apart: those between others of a
 * row (pass 0), or between rows (1). */
static void rows_fill(void *context, int first, int end)
{
    const struct level *level = context;
    struct fast *fast = level->fast;
    const int apart = 1 << level->k, half = apart / 2, pass = level->pass;
    for (int row = first; row < end; row++)
        for (int x = pass == 0 ? half : 0; x < fast->filter->taps.width; x += pass == 0 ? apart : half) {
            const int y = row * apart + pass * half;
            if (y < fast->filter->taps.height && fast->apart[pixel_of(fast, x, y)] >= level->k &&
                !fast->known[pixel_of(fast, x, y)] && filter_is_glossy(fast->filter, x, y))
                interpolate(fast, x, y);
        }
}

static enum result levels_fill(struct fast *fast, struct error *err)
{
    enum result result = RESULT_OK;
    for (int k = BLOCK_LEVELS - 1; k > 0; k--)
        for (int pass = 0; pass < 2 && !result; pass++) {
            struct level level = {fast, k, pass};
            const int rows = (fast->filter->taps.height + (1 << k) - 1) >> k;
            result = bands_run(rows, 16, fast->filter->options->threads, rows_fill, &level, err);
        }
    return result;
}

void filter_fast_free(struct fast *fast)
{
    if (!fast)
        return;
    for (int k = 0; k < BLOCK_LEVELS; k++)
        free(fast->rates[k]);
    filter_cells_free(&fast->cells);
    filter_visibility_free(&fast->visibility);
    pthread_mutex_destroy(&fast->lock);
    free(fast);
}

/* filter->fast, unless it is there. */
static enum result fast_build(struct filter *filter, struct error *err)
{
    if (filter->fast)
        return RESULT_OK;
    struct fast *fast = calloc(1, sizeof *fast);
    if (!fast)
        return error_memory(err, sizeof *fast);
    fast->filter = filter;
    pthread_mutex_init(&fast->lock, NULL);
    enum result result = filter_cells_build(filter, &fast->cells, err);
    if (result == RESULT_OK)
        result = filter_visibility_build(filter, &fast->visibility, err);
    if (result == RESULT_OK)
        result = rates_build(fast, err);
    if (result == RESULT_OK)
        filter->fast = fast;
    else
        filter_fast_free(fast);
    return result;
}

enum result filter_fast(struct filter *filter, struct error *err)
{
    const size_t pixels = (size_t)filter->taps.width * (size_t)filter->taps.height;
    enum result result = fast_build(filter, err);
    if (result != RESULT_OK)
        return result;
    struct fast *fast = filter->fast;
    fast->settings = settings_of(filter->options->tolerance);
    fast->known = calloc(pixels, 1);
    fast->apart = calloc(pixels, 1);
    if (!fast->known || !fast->apart)
        result = error_memory(err, 2 * (double)pixels);
    if (result == RESULT_OK)
        result = bands_run(fast->across[BLOCK_LEVELS - 1] * fast->down[BLOCK_LEVELS - 1], 1, filter->options->threads,
                           blocks_do, fast, err);
    while (fast->idle) {
        struct worker *worker = fast->idle;
        fast->idle = worker->next;
        worker_free(worker);
    }
    if (result == RESULT_OK && atomic_load(&filter->out_of_memory))
        result = error_memory(err, sights_bytes);
    if (result == RESULT_OK)
        result = levels_fill(fast, err);
    free(fast->apart);
    free(fast->known);
    return result;
}
