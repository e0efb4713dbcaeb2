/* The innermost loops of the filter: sum f L0 and sum f for 16 neighbouring pixels, over the window of equation (1) or
 * over what each pixel's a sees.
 *
 * Lanes are output pixels, taps are in the outer loops, so that the inner loops have a constant length and no branch,
 * and the compiler turns them into vectors. With v the direction from a lane's a to a tap's b', d the lane's own
 * direction, c = v.d and q = v - c d, cos^p(theta) of equation (3) is (1 + tan^2(theta))^(-p/2) with tan^2(theta) =
 * q.q / c^2: never 1 minus a rounded cosine. v is taken relative to the lane's b, so that near neighbours differ
 * exactly; a tap much nearer to a than b is, relative to a.
 */
#include "filter_kernel.h"

#include "filter_weight.h"
#include "weights.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A tap this many times nearer than the lane's own endpoint is not taken relative to it: digits would be lost. */
#define NEAR_RATIO 4.0f

/* How tan^2(theta) becomes a weight. */
enum path {
    PATH_NARROW, /* the power for slopes of FILTER_NARROW_SLOPE and more */
    PATH_POWER,
    PATH_TABLE,
    PATH_GAUSS
};

/* e = v - own d: relative to the lane's b, or v itself. */
struct offset {
    float x, y, z, own;
};

/* Of lane l's tap; `tap` is the index of lane 0's in the planes. `mixed`: the lane looks for itself whether the tap is
 * of its own kind and not near. */
ALWAYS_INLINE struct offset tap_offset(const struct filter_taps *taps, const struct filter_lanes *lanes, size_t tap,
                                       int l, bool mixed)
{
    const float *bx = taps->planes[FILTER_PLANE_X] + tap;
    const float *by = taps->planes[FILTER_PLANE_Y] + tap;
    const float *bz = taps->planes[FILTER_PLANE_Z] + tap;
    const float *bw = taps->planes[FILTER_PLANE_W] + tap;
    float ex, ey, ez, own = lanes->distance[l];
    if (mixed) {
        float w = bw[l], ax = w * lanes->a[0][l], ay = w * lanes->a[1][l], az = w * lanes->a[2][l];
        float vx = bx[l] - ax, vy = by[l] - ay, vz = bz[l] - az, vv = vx * vx + vy * vy + vz * vz;
        float relative = own * own <= NEAR_RATIO * NEAR_RATIO * vv ? 1.0f : 0.0f;
        relative *= 1.0f - fabsf(w - lanes->b[3][l]); /* 0 or 1: the products below are exact */
        own *= relative;
        ex = (bx[l] - relative * lanes->b[0][l]) - (1.0f - relative) * ax;
        ey = (by[l] - relative * lanes->b[1][l]) - (1.0f - relative) * ay;
        ez = (bz[l] - relative * lanes->b[2][l]) - (1.0f - relative) * az;
    } else {
        ex = bx[l] - lanes->b[0][l];
        ey = by[l] - lanes->b[1][l];
        ez = bz[l] - lanes->b[2][l];
    }
    return (struct offset){ex, ey, ez, own};
}

/* e.d */
ALWAYS_INLINE float offset_along(struct offset e, const struct filter_lanes *lanes, int l)
{
    return e.x * lanes->direction[0][l] + e.y * lanes->direction[1][l] + e.z * lanes->direction[2][l];
}

/* e along one of the axes at right angles to d. */
ALWAYS_INLINE float offset_across(struct offset e, const struct filter_lanes *lanes, int axis, int l)
{
    return e.x * lanes->across[axis][0][l] + e.y * lanes->across[axis][1][l] + e.z * lanes->across[axis][2][l];
}

/* -log2 cos^2(theta) for y = t / (2 + t), t = tan^2(theta): log2(1 + t) = 2 atanh(y) / log(2), within 2e-7 up to t = 1,
 * and rising beyond. */
ALWAYS_INLINE float narrow_log2(float y)
{
    float yy = y * y;
    float p = 0.493777514f;
    p = p * yy + 0.57115519f;
    p = p * yy + 0.961931407f;
    p = p * yy + 2.88538957f;
    return p * y;
}

/* Solid angle of a tap's pixel as seen from a lane's a: its area over the distance squared, which counts as no less
 * than `nearest`; 2 pi at most. */
ALWAYS_INLINE float solid_angle(float area, float nearest, float c, float qq)
{
    const float per_hemisphere = 0.159154943f;
    float square = c * c + qq;
    square = square > nearest ? square : nearest;
    return area / (square + (area * per_hemisphere + FLT_MIN));
}

/* The weights of one tap for all lanes; `separation` is what the window limits. For the table its position instead, at
 * its end where the weight is 0. `solid`: times the solid angle. */
ALWAYS_INLINE void tap_weights(const struct filter_taps *taps, const struct filter_lanes *lanes, size_t tap,
                               float separation, enum path path, bool mixed, bool solid, float *restrict weights)
{
    const float *area = taps->planes[FILTER_PLANE_AREA] + tap;
    const float *nearest = taps->planes[FILTER_PLANE_NEAREST] + tap;
    const float none = path == PATH_TABLE ? (float)WEIGHTS_TABLE_LAST : 0.0f;
    for (int l = 0; l < FILTER_LANES; l++) {
        const struct offset e = tap_offset(taps, lanes, tap, l, mixed);
        float along = offset_along(e, lanes, l), qx = e.x - along * lanes->direction[0][l];
        float qy = e.y - along * lanes->direction[1][l], qz = e.z - along * lanes->direction[2][l];
        float c = along + e.own, qq = qx * qx + qy * qy + qz * qz, f;
        if (path == PATH_NARROW) {
            f = power_to_weight(-lanes->slope[l] * narrow_log2(qq / (2.0f * (c * c) + qq)));
        } else {
            float t = qq / (c * c);
            t = t < 0x1p100f ? t : 0x1p100f; /* also where c is 0, and NaN */
            float position = lanes->slope[l] * (path == PATH_GAUSS ? t : log2_of_1_plus(t));
            f = path != PATH_TABLE ? power_to_weight(-position) : position < none ? position : none;
        }
        if (solid)
            f *= solid_angle(area[l], nearest[l], c, qq);
        f = c > 0.0f ? f : none;
        weights[l] = separation <= lanes->limit[l] ? f : none;
    }
}

/* weights_table_lookup for all lanes, in place. */
ALWAYS_INLINE void look_up(const float *table, float *weights)
{
    for (int l = 0; l < FILTER_LANES; l++) {
        int32_t i = (int32_t)weights[l];
        float fraction = weights[l] - (float)i;
        weights[l] = table[i] + fraction * (table[i + 1] - table[i]);
    }
}

/* One tap for all lanes. */
ALWAYS_INLINE void add_tap(const struct filter_taps *taps, const struct filter_lanes *lanes, size_t tap,
                           float separation, enum path path, bool mixed, bool solid,
                           float (*sums)[FILTER_LANES])
{
    _Alignas(64) float weights[FILTER_LANES];
    tap_weights(taps, lanes, tap, separation, path, mixed, solid, weights);
    if (path == PATH_TABLE)
        look_up(taps->table, weights);
    for (int l = 0; l < FILTER_LANES; l++) {
        float f = weights[l] * taps->planes[FILTER_PLANE_GAIN][tap + (size_t)l];
        sums[0][l] += f * taps->planes[FILTER_PLANE_R][tap + (size_t)l];
        sums[1][l] += f * taps->planes[FILTER_PLANE_G][tap + (size_t)l];
        sums[2][l] += f * taps->planes[FILTER_PLANE_B][tap + (size_t)l];
        sums[3][l] += f;
    }
}

/* Up to 16 columns of one row of taps. Floats hold the sum of these few; more would lose digits. */
ALWAYS_INLINE void add_columns(const struct filter_taps *taps, const struct filter_lanes *lanes, int dy, int first,
                               int last, enum path path, bool mixed, bool solid, struct filter_sums *restrict sums)
{
    _Alignas(64) float partial[4][FILTER_LANES] = {{0}};
    size_t row = (size_t)(lanes->y + dy) * taps->stride;
    for (int dx = first; dx <= last; dx++) {
        float separation = (float)dx * (float)dx + (float)dy * (float)dy;
        if (taps->square) {
            int side = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
            separation = (float)side * (float)side;
        }
        add_tap(taps, lanes, row + (size_t)(lanes->x + dx + FILTER_BORDER), separation, path, mixed, solid, partial);
    }
    for (int i = 0; i < 4; i++)
        for (int l = 0; l < FILTER_LANES; l++)
            sums->value[i][l] += (double)partial[i][l];
}

/* One function per path, so that the compiler lays out the registers of each by itself. */
typedef void add_columns_function(const struct filter_taps *taps, const struct filter_lanes *lanes, int dy, int first,
                                  int last, struct filter_sums *sums);
#define DEFINE_PATH(name, path, mixed, solid)                                                                          \
    __attribute__((noinline)) static void name(const struct filter_taps *taps, const struct filter_lanes *lanes,       \
                                               int dy, int first, int last, struct filter_sums *sums)                  \
    {                                                                                                                  \
        add_columns(taps, lanes, dy, first, last, path, mixed, solid, sums);                                           \
    }
DEFINE_PATH(add_narrow, PATH_NARROW, false, false)
DEFINE_PATH(add_narrow_mixed, PATH_NARROW, true, false)
DEFINE_PATH(add_power, PATH_POWER, false, false)
DEFINE_PATH(add_power_mixed, PATH_POWER, true, false)
DEFINE_PATH(add_table, PATH_TABLE, false, false)
DEFINE_PATH(add_table_mixed, PATH_TABLE, true, false)
DEFINE_PATH(add_gauss, PATH_GAUSS, false, false)
DEFINE_PATH(add_gauss_mixed, PATH_GAUSS, true, false)
DEFINE_PATH(add_narrow_solid, PATH_NARROW, false, true)
DEFINE_PATH(add_narrow_solid_mixed, PATH_NARROW, true, true)
DEFINE_PATH(add_power_solid, PATH_POWER, false, true)
DEFINE_PATH(add_power_solid_mixed, PATH_POWER, true, true)

static add_columns_function *choose(enum filter_shape shape, bool narrow, bool mixed)
{
    switch (shape) {
    case FILTER_SHAPE_TABLE:
        return mixed ? add_table_mixed : add_table;
    case FILTER_SHAPE_GAUSS:
        return mixed ? add_gauss_mixed : add_gauss;
    case FILTER_SHAPE_SOLID:
        if (narrow)
            return mixed ? add_narrow_solid_mixed : add_narrow_solid;
        return mixed ? add_power_solid_mixed : add_power_solid;
    case FILTER_SHAPE_POWER:
        break;
    }
    if (narrow)
        return mixed ? add_narrow_mixed : add_narrow;
    return mixed ? add_power_mixed : add_power;
}

/* Whether all positions in a box may be taken relative to the endpoint of any lane. */
static bool is_far(const struct filter_lanes *lanes, const struct filter_box *box)
{
    float square = 0;
    for (int i = 0; i < 3; i++) {
        float gap = fmaxf(fmaxf(box->low[i] - lanes->box.high[i], lanes->box.low[i] - box->high[i]), 0);
        square += gap * gap;
    }
    return lanes->farthest * lanes->farthest <= NEAR_RATIO * NEAR_RATIO * square;
}

/* Whether some lanes may find taps of another kind, or near ones, in two neighbouring blocks. */
static bool is_mixed(const struct filter_taps *taps, const struct filter_lanes *lanes, size_t block)
{
    unsigned kinds = (unsigned)(taps->kinds[block] | taps->kinds[block + 1] | lanes->kinds);
    if (kinds == FILTER_KIND_DIRECTION)
        return false;
    if (kinds != FILTER_KIND_POSITION)
        return true;
    return (taps->kinds[block] && !is_far(lanes, taps->boxes + block)) ||
           (taps->kinds[block + 1] && !is_far(lanes, taps->boxes + block + 1));
}

void CONCATENATE(filter_kernel_, FILTER_KERNEL_ISA)(const struct filter_taps *taps, const struct filter_lanes *lanes,
                                                    struct filter_sums *sums)
{
    memset(sums, 0, sizeof *sums);
    double limit = -1;
    for (int l = 0; l < FILTER_LANES; l++)
        limit = fmax(limit, (double)lanes->limit[l]);
    if (limit < 0)
        return;
    add_columns_function *uniform = choose(taps->shape, lanes->narrow, false);
    add_columns_function *mixed = choose(taps->shape, lanes->narrow, true);
    size_t blocks_per_row = taps->stride / FILTER_LANES;
    double reach = floor(sqrt(limit));
    int above = (int)fmin(reach, lanes->y), below = (int)fmin(reach, taps->height - 1 - lanes->y);
    for (int dy = -above; dy <= below; dy++) {
        double half = taps->square ? reach : floor(sqrt(limit - (double)dy * dy));
        int first = -(int)fmin(half, lanes->x + FILTER_LANES - 1), last = (int)fmin(half, taps->width - 1 - lanes->x);
        size_t row = (size_t)(lanes->y + dy) * blocks_per_row;
        /* Lanes and columns of a multiple of 16 meet two blocks of the planes. */
        int start = -((FILTER_LANES - 1 - first) / FILTER_LANES) * FILTER_LANES;
        for (int dx = start; dx <= last; dx += FILTER_LANES) {
            size_t block = row + (size_t)(lanes->x + dx + FILTER_BORDER) / FILTER_LANES;
            if (!taps->kinds[block] && !taps->kinds[block + 1])
                continue;
            int from = dx > first ? dx : first, to = dx + FILTER_LANES - 1 < last ? dx + FILTER_LANES - 1 : last;
            (is_mixed(taps, lanes, block) ? mixed : uniform)(taps, lanes, dy, from, to, sums);
        }
    }
}

/* --- what a sees --- */

/* The share that is hidden of what lies beyond one tap, for all lanes. Rows of these are indexed by dx. */
typedef float state[FILTER_LANES];

/* Both neighbours between which the straight line from the lanes' own pixels comes in, twice the same where it comes
 * through one, and how near to the second, 0 to 1. */
struct way {
    const float *first, *second;
    float share;
};

ALWAYS_INLINE struct way way_to(state *here, state *above, int dx, int dy)
{
    const int inward = dx > 0 ? -1 : 1, column = dx < 0 ? -dx : dx;
    if (dx == 0)
        return (struct way){above[dx], above[dx], 0};
    if (dy == 0)
        return (struct way){here[dx + inward], here[dx + inward], 0};
    if (column == dy)
        return (struct way){above[dx + inward], above[dx + inward], 0};
    if (column < dy)
        return (struct way){above[dx], above[dx + inward], (float)((double)column / dy)};
    return (struct way){here[dx + inward], above[dx + inward], (float)((double)dy / column)};
}

/* The share that is hidden of what lies beyond a tap at tan^2(theta) = t, if `before` is of the tap itself. */
ALWAYS_INLINE float hidden_share(const struct filter_lanes *lanes, int l, float t, float before)
{
    float hidden = 1.0f - (lanes->blind[l] - t) * lanes->fade[l];
    hidden = hidden > before ? hidden : before;
    return hidden < 1.0f ? hidden : 1.0f;
}

/* log2(1 + t) for t up to FILTER_NARROW_REACH, within 3e-7; anything beyond. */
ALWAYS_INLINE float narrow_log2_of_1_plus(float t)
{
    float p = -0.240449173f;
    p = p * t + 0.288539008f;
    p = p * t - 0.36067376f;
    p = p * t + 0.480898347f;
    p = p * t - 0.72134752f;
    p = p * t + 1.44269504f;
    return p * t;
}

/* One tap for all lanes, `separation` pixels^2 away; `least` is lowered to its state. Where no endpoint is known the
 * angle is what a surface that goes on unchanged would give for the farthest things. */
ALWAYS_INLINE void see_tap(const struct filter_taps *taps, const struct filter_lanes *lanes, size_t tap,
                           float separation, bool narrow, bool mixed, const float *restrict before,
                           float *restrict own, float *restrict least, float (*sums)[FILTER_LANES],
                           struct filter_moments *restrict range)
{
    const float *area = taps->planes[FILTER_PLANE_AREA] + tap;
    const float *nearest = taps->planes[FILTER_PLANE_NEAREST] + tap;
    const float *red = taps->planes[FILTER_PLANE_R] + tap;
    const float *green = taps->planes[FILTER_PLANE_G] + tap;
    const float *blue = taps->planes[FILTER_PLANE_B] + tap;
    _Alignas(64) float largest[FILTER_LANES]; /* nothing else can lie here: no check stands before the vectors */
    for (int l = 0; l < FILTER_LANES; l++) {
        const struct offset e = tap_offset(taps, lanes, tap, l, mixed);
        float x = offset_across(e, lanes, 0, l), y = offset_across(e, lanes, 1, l);
        float c = offset_along(e, lanes, l) + e.own, qq = x * x + y * y, reach = lanes->reach[l];
        float far = lanes->step[l] * separation;
        float t = qq / (c * c);
        t = t < 0x1p100f ? t : 0x1p100f; /* also NaN */
        t = c > 0.0f ? t : 0x1p100f;
        float f = power_to_weight(-lanes->slope[l] * (narrow ? narrow_log2_of_1_plus(t) : log2_of_1_plus(t)));
        f -= lanes->floor;
        f = f > 0.0f ? f : 0.0f;
        float hidden = hidden_share(lanes, l, area[l] > 0.0f ? t : far, before[l]);
        f *= 1.0f - hidden;
        f = t <= reach ? f : 0.0f;
        f *= solid_angle(area[l], nearest[l], c, qq);
        largest[l] = hidden;
        least[l] = hidden < least[l] ? hidden : least[l];
        float place = c / (c * c + qq + FLT_MIN);
        float u = place * x, v = place * y, fu = f * u, fv = f * v;
        float sum = red[l] + green[l] + blue[l];
        sums[FILTER_MOMENT_R][l] += f * red[l];
        sums[FILTER_MOMENT_G][l] += f * green[l];
        sums[FILTER_MOMENT_B][l] += f * blue[l];
        sums[FILTER_MOMENT_1][l] += f;
        sums[FILTER_MOMENT_U][l] += fu;
        sums[FILTER_MOMENT_V][l] += fv;
        sums[FILTER_MOMENT_UU][l] += fu * u;
        sums[FILTER_MOMENT_UV][l] += fu * v;
        sums[FILTER_MOMENT_VV][l] += fv * v;
        sums[FILTER_MOMENT_RU][l] += fu * red[l];
        sums[FILTER_MOMENT_GU][l] += fu * green[l];
        sums[FILTER_MOMENT_BU][l] += fu * blue[l];
        sums[FILTER_MOMENT_RV][l] += fv * red[l];
        sums[FILTER_MOMENT_GV][l] += fv * green[l];
        sums[FILTER_MOMENT_BV][l] += fv * blue[l];
        sums[FILTER_MOMENT_SQUARE][l] += f * (sum * sum);
        float radiance[3] = {red[l], green[l], blue[l]};
        for (int i = 0; i < 3; i++) {
            float least_seen = f > 0.0f ? radiance[i] : INFINITY, most_seen = f > 0.0f ? radiance[i] : -INFINITY;
            range->low[i][l] = least_seen < range->low[i][l] ? least_seen : range->low[i][l];
            range->high[i][l] = most_seen > range->high[i][l] ? most_seen : range->high[i][l];
        }
    }
    memcpy(own, largest, sizeof largest);
}

/* The same where no lane finds an endpoint. */
ALWAYS_INLINE void see_nothing(const struct filter_lanes *lanes, float separation, const float *restrict before,
                               float *restrict own, float *restrict least)
{
    for (int l = 0; l < FILTER_LANES; l++) {
        float hidden = hidden_share(lanes, l, lanes->step[l] * separation, before[l]);
        own[l] = hidden;
        least[l] = hidden < least[l] ? hidden : least[l];
    }
}

/* Up to CHUNK taps of one row, dx from first to last in steps of +-1. Whether any lane sees on. */
ALWAYS_INLINE bool see_columns(const struct filter_taps *taps, const struct filter_lanes *lanes, int first, int last,
                               int dy, bool narrow, bool mixed, bool nothing, state *here, state *above,
                               struct filter_moments *restrict sums)
{
    _Alignas(64) float partial[FILTER_MOMENTS][FILTER_LANES] = {{0}};
    _Alignas(64) float least[FILTER_LANES], before[FILTER_LANES];
    size_t row = (size_t)(lanes->y + dy) * taps->stride;
    int away = abs(dy), step = last < first ? -1 : 1, count = abs(last - first) + 1;
    for (int l = 0; l < FILTER_LANES; l++)
        least[l] = 1.0f;
    for (int i = 0, dx = first; i < count; i++, dx += step) {
        float separation = (float)dx * (float)dx + (float)dy * (float)dy;
        struct way way = way_to(here, above, dx, away);
        for (int l = 0; l < FILTER_LANES; l++)
            before[l] = way.first[l] + way.share * (way.second[l] - way.first[l]);
        if (nothing)
            see_nothing(lanes, separation, before, here[dx], least);
        else
            see_tap(taps, lanes, row + (size_t)(lanes->x + dx + FILTER_BORDER), separation, narrow, mixed, before,
                    here[dx], least, partial, sums);
    }
    for (int i = 0; i < FILTER_MOMENTS && !nothing; i++)
        for (int l = 0; l < FILTER_LANES; l++)
            sums->value[i][l] += (double)partial[i][l];
    float smallest = 1.0f;
    for (int l = 0; l < FILTER_LANES; l++)
        smallest = least[l] < smallest ? least[l] : smallest;
    return smallest < 1.0f;
}

typedef bool see_columns_function(const struct filter_taps *taps, const struct filter_lanes *lanes, int first, int last,
                                  int dy, state *here, state *above, struct filter_moments *sums);
#define DEFINE_SEE(name, narrow, mixed, nothing)                                                                       \
    __attribute__((noinline)) static bool name(const struct filter_taps *taps, const struct filter_lanes *lanes,       \
                                               int first, int last, int dy, state *here, state *above,                 \
                                               struct filter_moments *sums)                                            \
    {                                                                                                                  \
        return see_columns(taps, lanes, first, last, dy, narrow, mixed, nothing, here, above, sums);                   \
    }
DEFINE_SEE(see_narrow, true, false, false)
DEFINE_SEE(see_narrow_mixed, true, true, false)
DEFINE_SEE(see_wide, false, false, false)
DEFINE_SEE(see_wide_mixed, false, true, false)
DEFINE_SEE(see_nowhere, false, false, true)

/* For a chunk whose leftmost column is `left`: it meets two blocks of the planes. */
static see_columns_function *choose_see(const struct filter_taps *taps, const struct filter_lanes *lanes, int left,
                                        int dy)
{
    size_t block = ((size_t)(lanes->y + dy) * taps->stride + (size_t)(lanes->x + left + FILTER_BORDER)) / FILTER_LANES;
    if (!taps->kinds[block] && !taps->kinds[block + 1])
        return see_nowhere;
    bool mixed = is_mixed(taps, lanes, block);
    if (lanes->narrow)
        return mixed ? see_narrow_mixed : see_narrow;
    return mixed ? see_wide_mixed : see_wide;
}

/* Live chunks of CHUNK columns to one side of the lanes' own: chunk 0 begins beside column 0 (right: with it). */
struct side {
    int step;        /* 1: right, -1: left */
    int first, last; /* live chunks; first > last: none */
    int limit;       /* |dx| at most; below 0: no column */
};

enum { CHUNK = 8 };

static int chunk_column(const struct side *side, int chunk)
{
    return side->step > 0 ? chunk * CHUNK : -1 - chunk * CHUNK;
}

static bool any_live(const float *hidden)
{
    bool live = false;
    for (int l = 0; l < FILTER_LANES; l++)
        live = live || hidden[l] < 1.0f;
    return live;
}

static void close_column(state *row, int dx)
{
    for (int l = 0; l < FILTER_LANES; l++)
        row[dx][l] = 1.0f;
}

static void close_chunk(const struct side *side, int chunk, state *row)
{
    for (int i = 0; i < CHUNK; i++)
        close_column(row, chunk_column(side, chunk) + side->step * i);
}

/* One side of a row, outward from its live chunks of the row before. Columns that are
 * looked at though nothing reached them are closed. */
static void see_side(const struct filter_taps *taps, const struct filter_lanes *lanes, struct side *side, int dy,
                     state *here, state *above, struct filter_moments *sums)
{
    const int first = side->first, last = side->last;
    /* Column 0 belongs to the right; from it the left begins anew. */
    bool anew = side->step < 0 && dy != 0 && any_live(above[0]), live = false;
    int chunk = anew ? 0 : first, end = anew && last < 0 ? 0 : last;
    side->first = 0;
    side->last = -1;
    if (side->step > 0 && (chunk > 0 || chunk > end))
        close_column(here, 0);
    if (chunk > end)
        return;
    if (chunk > 0)
        close_column(here, chunk_column(side, chunk) - side->step);
    if (dy != 0 && last >= 0)
        end += any_live(above[chunk_column(side, last + 1) - side->step]);
    for (; chunk <= end || live; chunk++) {
        int from = chunk_column(side, chunk), to = from + side->step * (CHUNK - 1);
        if (abs(from) > side->limit)
            break;
        see_columns_function *see = choose_see(taps, lanes, from < to ? from : to, dy);
        if (dy != 0 && (chunk < first || chunk > last))
            close_chunk(side, chunk, above);
        for (; abs(to) > side->limit; to -= side->step)
            close_column(here, to);
        live = see(taps, lanes, from, to, dy, here, above, sums);
        if (live && side->last < 0)
            side->first = chunk;
        if (live)
            side->last = chunk;
    }
    if (chunk <= side->last + 1)
        close_chunk(side, chunk, here);
}

/* One row, right and left. Whether there is more beyond. */
static bool see_row(const struct filter_taps *taps, const struct filter_lanes *lanes, struct side sides[2], int dy,
                    state *here, state *above, struct filter_moments *sums)
{
    double width = sqrt(fmax((double)lanes->limit_px * lanes->limit_px - (double)dy * dy, 0));
    sides[0].limit = (int)fmin(width, taps->width - 1 - lanes->x);
    sides[1].limit = (int)fmin(width, lanes->x + FILTER_LANES - 1);
    see_side(taps, lanes, &sides[0], dy, here, above, sums);
    see_side(taps, lanes, &sides[1], dy, here, above, sums);
    return sides[0].first <= sides[0].last || sides[1].first <= sides[1].last;
}

void CONCATENATE(filter_see_, FILTER_KERNEL_ISA)(const struct filter_taps *taps, const struct filter_lanes *lanes,
                                                 float *scratch, struct filter_moments *sums)
{
    size_t columns = FILTER_SEE_COLUMNS(taps->width);
    state *rows = (state *)scratch + lanes->x + FILTER_LANES + 2 * CHUNK;
    state *centre = rows, *others[2] = {rows + columns, rows + 2 * columns};
    struct side start[2] = {{.step = 1, .first = 0, .last = 0}, {.step = -1, .first = 0, .last = 0}};
    memset(sums, 0, sizeof *sums);
    for (int i = 0; i < 3; i++)
        for (int l = 0; l < FILTER_LANES; l++) {
            sums->low[i][l] = INFINITY;
            sums->high[i][l] = -INFINITY;
        }
    memset(others[0][0], 0, sizeof(state)); /* on the way to the lanes' own pixels there is nothing */
    if (!see_row(taps, lanes, start, 0, centre, others[0], sums))
        return;
    for (int direction = -1; direction <= 1; direction += 2) {
        struct side sides[2] = {start[0], start[1]};
        state *above = centre;
        int end = (int)fmin(lanes->limit_px, direction < 0 ? lanes->y : taps->height - 1 - lanes->y);
        for (int away = 1; away <= end; away++) {
            state *here = others[away & 1];
            if (!see_row(taps, lanes, sides, direction * away, here, above, sums))
                break;
            above = here;
        }
    }
}
