/* What one pixel's a sees, by marching outward over the picture, and sums over clusters of taps.
 *
 * In a march the taps of one row are the lanes: a way to them comes from the row before alone, for they are no farther
 * from the eye's column than from its row. In the sums the lanes are output pixels, as in filter_kernel.c.
 */
#include "filter_sight.h"

#include "filter_weight.h"

#include <float.h>
#include <math.h>

enum { LANES = FILTER_LANES };

/* See FILTER_PLANE_NEAREST: in units of r'^2. */
static const float nearest_square = (float)(1 / FILTER_MOST_ENLARGED);

/* Weight and share from which on a thing counts as seen nearby. */
#define NEAR_WEIGHT 0.02f
#define NEAR_SHARE 0.1f

ALWAYS_INLINE float clamp_share(float share)
{
    share = share < 1.0f ? share : 1.0f;
    return share > 0.0f ? share : 0.0f;
}

/* LANES taps of one row from column dx off the eye's on; `state` is the largest tan^2 on the way to each and at it, of
 * the row before and of this one. */
ALWAYS_INLINE void march_lanes(const struct sight_planes *planes, size_t tap, const struct sight_eye *eye, int dx,
                               float away, const float *restrict before, float *restrict state,
                               uint8_t *restrict hidden)
{
    const float *px = planes->x + tap, *py = planes->y + tap, *pz = planes->z + tap, *pw = planes->w + tap;
    const float *area = planes->area + tap;
    const float ax = eye->a[0], ay = eye->a[1], az = eye->a[2];
    const float ex = eye->direction[0], ey = eye->direction[1], ez = eye->direction[2];
    const float blind = eye->blind, fade = eye->fade, step = eye->step;
    _Alignas(64) float share[LANES], largest[LANES];
    for (int l = 0; l < LANES; l++) {
        int column = dx + l;
        float straight = before[l], left = before[l - 1], right = before[l + 1];
        float inward = column < 0 ? right : column > 0 ? left : straight;
        float way = inward < straight ? inward : straight;
        float vx = px[l] - pw[l] * ax, vy = py[l] - pw[l] * ay, vz = pz[l] - pw[l] * az;
        float c = vx * ex + vy * ey + vz * ez, cc = c * c;
        float t = (vx * vx + vy * vy + vz * vz - cc) / cc;
        t = t < 0x1p100f ? t : 0x1p100f; /* also NaN */
        t = c > 0.0f ? t : 0x1p100f;
        float own = clamp_share((blind - t) * fade);
        float far = step * ((float)column * (float)column + away);
        t = area[l] > 0.0f ? t : far;
        own = area[l] > 0.0f && way < INFINITY ? own : 1.0f;
        float lost = own - clamp_share((blind - way) * fade);
        lost = lost > 0.0f ? lost : 0.0f;
        t = t > way ? t : way;
        largest[l] = t <= blind ? t : INFINITY;
        share[l] = lost * SIGHT_HIDDEN + 0.5f;
    }
    memcpy(state, largest, sizeof largest);
    for (int l = 0; l < LANES; l++)
        hidden[l] = (uint8_t)(int)share[l];
}

static void march(const struct sight_planes *planes, int x, int y, int step, int limit, const struct sight_eye *eye,
                  float *scratch, uint8_t *hidden, ptrdiff_t column, ptrdiff_t row, struct sight_extent *extent)
{
    /* Indexed by dx; beyond the columns of a row they are infinite as far as the next row's lanes look. */
    float *before = scratch + SIGHT_MARGIN + x, *state = before + planes->width + 2 * SIGHT_MARGIN;
    int end = step < 0 ? y : planes->height - 1 - y, first = 0, last = 0;
    for (int i = -LANES - 2; i <= LANES + 2; i++)
        before[i] = INFINITY;
    before[0] = 0;
    for (int k = 1; k <= end && k <= limit && first <= last; k++) {
        int live = first - 1 > -k ? first - 1 : -k, live_end = last + 1 < k ? last + 1 : k, v = y + step * k;
        first = live > -x ? live : -x;
        last = live_end < planes->width - 1 - x ? live_end : planes->width - 1 - x;
        for (int dx = first; dx <= last; dx += LANES) {
            _Alignas(64) uint8_t shares[LANES];
            size_t tap = (size_t)v * planes->stride + (size_t)(x + dx + FILTER_BORDER);
            march_lanes(planes, tap, eye, dx, (float)k * (float)k, before + dx, state + dx, shares);
            uint8_t *to = hidden + (x + dx) * column + v * row;
            const int count = last - dx + 1 < LANES ? last - dx + 1 : LANES;
            if (column == 1)
                memcpy(to, shares, (size_t)count);
            for (int l = 0; l < count && column != 1; l++)
                to[l * column] = shares[l];
        }
        state[first - 1] = state[first - 2] = INFINITY;
        for (int i = 1; i <= LANES + 2; i++)
            state[last + i] = INFINITY;
        extent->left = x + first < extent->left ? x + first : extent->left;
        extent->right = x + last > extent->right ? x + last : extent->right;
        extent->top = v < extent->top ? v : extent->top;
        extent->bottom = v > extent->bottom ? v : extent->bottom;
        while (first <= last && !(state[first] < INFINITY))
            first++;
        while (first <= last && !(state[last] < INFINITY))
            last--;
        float *swap = before;
        before = state;
        state = swap;
    }
}

/* Two rows to one of half the width. */
ALWAYS_INLINE void reduce_rows(const uint8_t *mean, const uint8_t *low, const uint8_t *high, int width,
                               uint8_t *restrict means, uint8_t *restrict lows, uint8_t *restrict highs)
{
    for (int x = 0; x < width / 2; x++) {
        int i = 2 * x, j = i + width;
        uint8_t low_above = low[i] < low[i + 1] ? low[i] : low[i + 1];
        uint8_t low_below = low[j] < low[j + 1] ? low[j] : low[j + 1];
        uint8_t high_above = high[i] > high[i + 1] ? high[i] : high[i + 1];
        uint8_t high_below = high[j] > high[j + 1] ? high[j] : high[j + 1];
        means[x] = (uint8_t)((mean[i] + mean[i + 1] + mean[j] + mean[j + 1] + 2) >> 2);
        lows[x] = low_above < low_below ? low_above : low_below;
        highs[x] = high_above > high_below ? high_above : high_below;
    }
}

static void reduce(const uint8_t *const from[3], int width, int height, uint8_t *const to[3])
{
    for (int y = 0; y < height / 2; y++) {
        const size_t above = 2 * (size_t)y * (size_t)width, row = (size_t)y * (size_t)(width / 2);
        reduce_rows(from[0] + above, from[1] + above, from[2] + above, width, to[0] + row, to[1] + row, to[2] + row);
    }
}

/* Where a node lies from lane l, in units of r': along the direction, and off it. */
struct place {
    float c, qq, x, y, z;
};

ALWAYS_INLINE struct place place_of(const struct filter_node *node, const struct filter_lanes *lanes, int l)
{
    float vx = node->x - node->w * lanes->a[0][l], vy = node->y - node->w * lanes->a[1][l];
    float vz = node->z - node->w * lanes->a[2][l];
    float dx = lanes->direction[0][l], dy = lanes->direction[1][l], dz = lanes->direction[2][l];
    float c = vx * dx + vy * dy + vz * dz, qx = vx - c * dx, qy = vy - c * dy, qz = vz - c * dz;
    return (struct place){.c = c, .qq = qx * qx + qy * qy + qz * qz, .x = qx, .y = qy, .z = qz};
}

/* What the node's solid angle from its own a's is to be multiplied with for another a. */
ALWAYS_INLINE float enlarged(const struct filter_node *node, float square)
{
    return 1.0f / ((square > nearest_square ? square : nearest_square) + node->cap);
}

ALWAYS_INLINE void see_node(const struct filter_node *node, const float *hidden, struct filter_group *restrict group,
                            float (*restrict sums)[LANES], struct filter_moments *restrict range)
{
    const struct filter_lanes *lanes = &group->lanes;
    _Alignas(64) float lost[LANES] = {0}, weight[LANES], u[LANES], v[LANES], near[LANES];
    for (int s = 0; s < group->sights; s++)
        for (int l = 0; l < LANES; l++)
            lost[l] += group->share[s][l] * hidden[s];
    for (int l = 0; l < LANES; l++) {
        const struct place place = place_of(node, lanes, l);
        float c = place.c, qq = place.qq, square = c * c + qq, t = qq / (c * c);
        t = t < 0x1p100f ? t : 0x1p100f;
        t = c > 0.0f ? t : 0x1p100f;
        float f = power_to_weight(-lanes->slope[l] * log2_of_1_plus(t)) - lanes->floor;
        f = f > 0.0f ? f : 0.0f;
        f = t <= lanes->reach[l] ? f : 0.0f;
        float share = (lanes->blind[l] - t) * lanes->fade[l];
        share = (share < 1.0f ? share : 1.0f) - lost[l];
        share = share > 0.0f ? share : 0.0f;
        near[l] = f > NEAR_WEIGHT && share > NEAR_SHARE ? node->w : 0.0f;
        weight[l] = f * share * enlarged(node, square);
        float scale = c / (square + FLT_MIN);
        u[l] = scale * (place.x * lanes->across[0][0][l] + place.y * lanes->across[0][1][l] +
                        place.z * lanes->across[0][2][l]);
        v[l] = scale * (place.x * lanes->across[1][0][l] + place.y * lanes->across[1][1][l] +
                        place.z * lanes->across[1][2][l]);
    }
    for (int l = 0; l < LANES; l++)
        group->nearest[l] = near[l] > group->nearest[l] ? near[l] : group->nearest[l];
    const float solid = node->solid, square = node->square;
    for (int l = 0; l < LANES; l++)
        weight[l] *= solid;
    for (int i = 0; i < 3; i++) {
        const float radiance = node->radiance[i];
        for (int l = 0; l < LANES; l++) {
            float f = weight[l] * radiance;
            sums[FILTER_MOMENT_R + i][l] += f;
            sums[FILTER_MOMENT_RU + i][l] += f * u[l];
            sums[FILTER_MOMENT_RV + i][l] += f * v[l];
            float low = weight[l] > 0.0f ? radiance : INFINITY, high = weight[l] > 0.0f ? radiance : -INFINITY;
            range->low[i][l] = low < range->low[i][l] ? low : range->low[i][l];
            range->high[i][l] = high > range->high[i][l] ? high : range->high[i][l];
        }
    }
    for (int l = 0; l < LANES; l++) {
        float f = weight[l], fu = f * u[l], fv = f * v[l];
        sums[FILTER_MOMENT_1][l] += f;
        sums[FILTER_MOMENT_U][l] += fu;
        sums[FILTER_MOMENT_V][l] += fv;
        sums[FILTER_MOMENT_UU][l] += fu * u[l];
        sums[FILTER_MOMENT_UV][l] += fu * v[l];
        sums[FILTER_MOMENT_VV][l] += fv * v[l];
        sums[FILTER_MOMENT_SQUARE][l] += f * square;
    }
}

/* Floats hold the sums of so many nodes; more would lose digits. */
enum { CHUNK = 64 };

static void see(const struct filter_node *nodes, const float *hidden, int count, struct filter_group *group,
                struct filter_moments *sums)
{
    memset(sums, 0, sizeof *sums);
    memset(group->nearest, 0, sizeof group->nearest);
    for (int i = 0; i < 3; i++)
        for (int l = 0; l < LANES; l++) {
            sums->low[i][l] = INFINITY;
            sums->high[i][l] = -INFINITY;
        }
    for (int first = 0; first < count; first += CHUNK) {
        _Alignas(64) float partial[FILTER_MOMENTS][LANES] = {{0}};
        for (int i = first; i < first + CHUNK && i < count; i++)
            if (nodes[i].visible)
                see_node(&nodes[i], hidden + (size_t)i * SIGHTS_OF_GROUP, group, partial, sums);
        for (int i = 0; i < FILTER_MOMENTS; i++)
            for (int l = 0; l < LANES; l++)
                sums->value[i][l] += (double)partial[i][l];
    }
}

ALWAYS_INLINE void pool_node(const struct filter_node *node, const struct filter_group *group,
                             float (*restrict sums)[LANES])
{
    const struct filter_lanes *lanes = &group->lanes;
    for (int l = 0; l < LANES; l++) {
        const struct place place = place_of(node, lanes, l);
        float c = place.c, t = place.qq / (c * c);
        t = t < 0x1p100f ? t : 0x1p100f;
        float f = power_to_weight(-lanes->slope[l] * log2_of_1_plus(t));
        float dx = node->column - group->column[l], dy = node->row - group->row[l];
        f = c > 0.0f ? f : 0.0f;
        f = dx * dx + dy * dy <= lanes->limit[l] ? f : 0.0f;
        f *= node->solid * enlarged(node, c * c + place.qq);
        sums[0][l] += f * node->radiance[0];
        sums[1][l] += f * node->radiance[1];
        sums[2][l] += f * node->radiance[2];
        sums[3][l] += f;
    }
}

static void pool(const struct filter_node *nodes, int count, const struct filter_group *group,
                 struct filter_sums *sums)
{
    memset(sums, 0, sizeof *sums);
    for (int first = 0; first < count; first += CHUNK) {
        _Alignas(64) float partial[4][LANES] = {{0}};
        for (int i = first; i < first + CHUNK && i < count; i++)
            pool_node(&nodes[i], group, partial);
        for (int i = 0; i < 4; i++)
            for (int l = 0; l < LANES; l++)
                sums->value[i][l] += (double)partial[i][l];
    }
}

const struct sight_kernel CONCATENATE(sight_kernel_, FILTER_KERNEL_ISA) = {
    .march = march, .reduce = reduce, .see = see, .pool = pool};
