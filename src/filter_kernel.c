/* The innermost loops of the filter: sum f L0 and sum f of equation (1) for 16 neighbouring pixels.
 *
 * Lanes are output pixels, taps are in the outer loops, so that the inner loops have a constant length and no branch,
 * and the compiler turns them into vectors. With v the direction from a lane's a to a tap's b', d the lane's own
 * direction, c = v.d and q = v - c d, cos^p(theta) of equation (3) is (1 + tan^2(theta))^(-p/2) with tan^2(theta) =
 * q.q / c^2: never 1 minus a rounded cosine. v is taken relative to the lane's b, so that near neighbours differ
 * exactly; a tap much nearer to a than b is, relative to a.
 */
#include "filter_kernel.h"

#include "weights.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define ALWAYS_INLINE static inline __attribute__((always_inline))
#define CONCATENATE_(a, b) a##b
#define CONCATENATE(a, b) CONCATENATE_(a, b)

/* Below this power of two a weight is 0: sums with it would run into denormals. */
#define LOWEST_POWER (-120.0f)

/* A tap this many times nearer than the lane's own endpoint is not taken relative to it: digits would be lost. */
#define NEAR_RATIO 4.0f

/* How tan^2(theta) becomes a weight. */
enum path {
    PATH_NARROW, /* the power for slopes of FILTER_NARROW_SLOPE and more */
    PATH_POWER,
    PATH_TABLE,
    PATH_GAUSS
};

ALWAYS_INLINE uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

ALWAYS_INLINE float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* log2(1 + t), t from 0 to 2^100, relative error 3e-7. 1 + t = 2^e m with m about 1; z = m - 1 is found without
 * rounding 1 + t, so that it stays accurate for the smallest t. */
ALWAYS_INLINE float log2_of_1_plus(float t)
{
    const uint32_t sqrt_half = 0x3f3504f3;
    int32_t e = (int32_t)(bits_of(1.0f + t) - sqrt_half) >> 23;
    float scale = float_of(0x3f800000u - ((uint32_t)e << 23));
    float z = t * scale + (scale - 1.0f);
    float p = -0.145811617f;
    p = p * z + 0.234042332f;
    p = p * z - 0.24887687f;
    p = p * z + 0.287098706f;
    p = p * z - 0.360239625f;
    p = p * z + 0.480923235f;
    p = p * z - 0.721352816f;
    p = p * z + 1.4426949f;
    return p * z + (float)e;
}

/* 2^power, power at most 0, relative error 2e-7; exactly 1 at 0; 0 at LOWEST_POWER and below, and for NaN. */
ALWAYS_INLINE float power_to_weight(float power)
{
    const float round = 12582912.0f; /* 1.5 * 2^23: adding it rounds to an integer, which its low bits then hold */
    float y = power > LOWEST_POWER ? power : LOWEST_POWER;
    float shifted = y + round;
    float r = y - (shifted - round);
    float p = 0.00132647273f;
    p = p * r + 0.00967151299f;
    p = p * r + 0.0555073358f;
    p = p * r + 0.240222424f;
    p = p * r + 0.693147004f;
    p = p * r + 1.0f;
    p = float_of(bits_of(p) + (bits_of(shifted) << 23));
    return power > LOWEST_POWER ? p : 0.0f;
}

/* The weights of one tap for all lanes: `tap` is the index of lane 0's tap in the planes, `separation` what the window
 * limits. For the table its position instead, at its end where the weight is 0. `mixed`: each lane looks for itself
 * whether the tap is of its own kind and not near. */
ALWAYS_INLINE void tap_weights(const struct filter_taps *taps, const struct filter_lanes *lanes, size_t tap,
                               float separation, enum path path, bool mixed, float *restrict weights)
{
    const float *bx = taps->planes[FILTER_PLANE_X] + tap;
    const float *by = taps->planes[FILTER_PLANE_Y] + tap;
    const float *bz = taps->planes[FILTER_PLANE_Z] + tap;
    const float *bw = taps->planes[FILTER_PLANE_W] + tap;
    const float none = path == PATH_TABLE ? (float)WEIGHTS_TABLE_LAST : 0.0f;
    for (int l = 0; l < FILTER_LANES; l++) {
        /* e = v - (the lane's own v), which is parallel to d; or v itself. */
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
        float dx = lanes->direction[0][l], dy = lanes->direction[1][l], dz = lanes->direction[2][l];
        float along = ex * dx + ey * dy + ez * dz;
        float qx = ex - along * dx, qy = ey - along * dy, qz = ez - along * dz;
        float qq = qx * qx + qy * qy + qz * qz;
        float c = along + own, cc = c * c;
        float f;
        if (path == PATH_NARROW) {
            /* log2(1 + t) = 2 atanh(y) / log(2), y = t/(2 + t): within 2e-7 up to t = 1, and rising beyond. */
            float y = qq / (2.0f * cc + qq), yy = y * y;
            float p = 0.493777514f;
            p = p * yy + 0.57115519f;
            p = p * yy + 0.961931407f;
            p = p * yy + 2.88538957f;
            f = power_to_weight(-lanes->slope[l] * (p * y));
        } else {
            float t = qq / cc;
            t = t < 0x1p100f ? t : 0x1p100f; /* also where c is 0, and NaN */
            float position = lanes->slope[l] * (path == PATH_GAUSS ? t : log2_of_1_plus(t));
            f = path != PATH_TABLE ? power_to_weight(-position) : position < none ? position : none;
        }
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
                           float separation, enum path path, bool mixed, float (*sums)[FILTER_LANES])
{
    _Alignas(64) float weights[FILTER_LANES];
    tap_weights(taps, lanes, tap, separation, path, mixed, weights);
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
                               int last, enum path path, bool mixed, struct filter_sums *restrict sums)
{
    _Alignas(64) float partial[4][FILTER_LANES] = {{0}};
    size_t row = (size_t)(lanes->y + dy) * taps->stride;
    for (int dx = first; dx <= last; dx++) {
        float separation = (float)dx * (float)dx + (float)dy * (float)dy;
        if (taps->square) {
            int side = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
            separation = (float)side * (float)side;
        }
        add_tap(taps, lanes, row + (size_t)(lanes->x + dx + FILTER_BORDER), separation, path, mixed, partial);
    }
    for (int i = 0; i < 4; i++)
        for (int l = 0; l < FILTER_LANES; l++)
            sums->value[i][l] += (double)partial[i][l];
}

/* One function per path, so that the compiler lays out the registers of each by itself. */
typedef void add_columns_function(const struct filter_taps *taps, const struct filter_lanes *lanes, int dy, int first,
                                  int last, struct filter_sums *sums);
#define DEFINE_PATH(name, path, mixed)                                                                                 \
    __attribute__((noinline)) static void name(const struct filter_taps *taps, const struct filter_lanes *lanes,       \
                                               int dy, int first, int last, struct filter_sums *sums)                  \
    {                                                                                                                  \
        add_columns(taps, lanes, dy, first, last, path, mixed, sums);                                                  \
    }
DEFINE_PATH(add_narrow, PATH_NARROW, false)
DEFINE_PATH(add_narrow_mixed, PATH_NARROW, true)
DEFINE_PATH(add_power, PATH_POWER, false)
DEFINE_PATH(add_power_mixed, PATH_POWER, true)
DEFINE_PATH(add_table, PATH_TABLE, false)
DEFINE_PATH(add_table_mixed, PATH_TABLE, true)
DEFINE_PATH(add_gauss, PATH_GAUSS, false)
DEFINE_PATH(add_gauss_mixed, PATH_GAUSS, true)

static add_columns_function *choose(enum filter_shape shape, bool narrow, bool mixed)
{
    switch (shape) {
    case FILTER_SHAPE_TABLE:
        return mixed ? add_table_mixed : add_table;
    case FILTER_SHAPE_GAUSS:
        return mixed ? add_gauss_mixed : add_gauss;
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
