/* What one pixel's a sees, by marching outward over the picture, and sums over clusters of taps.
 *
 * In a march the taps of one row are the lanes: a way to them comes from the row before alone, for they are no farther
 * from the eye's column than from its row. How much of each tap's own share is seen is found tile by tile, before. In
 * the sums the lanes are output pixels, as in filter_kernel.c.
 */
#include "filter_sight.h"

#include "filter_weight.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LANES = FILTER_LANES, STRIP = SIGHT_MARGIN };

/* See FILTER_PLANE_NEAREST: in units of r'^2. */
static const float nearest_square = (float)(1 / FILTER_MOST_ENLARGED);

ALWAYS_INLINE float clamp_share(float share)
{
    share = share < 1.0f ? share : 1.0f;
    return share > 0.0f ? share : 0.0f;
}

/* How much of a tap's own share is not seen, of SIGHT_HIDDEN: by where it lies, or where none is by `far`, tan^2. */
ALWAYS_INLINE void own_lanes(const float *px, const float *py, const float *pz, const float *pw, const float *is_tap,
                             const float *far, const struct sight_eye *eye, float *restrict along,
                             uint8_t *restrict own)
{
    const float ax = eye->a[0], ay = eye->a[1], az = eye->a[2];
    const float ex = eye->direction[0], ey = eye->direction[1], ez = eye->direction[2];
    const float blind = eye->blind, fade = eye->fade;
    _Alignas(64) float hidden[LANES];
    _Alignas(16) uint8_t bytes[LANES];
    for (int l = 0; l < LANES; l++) {
        float vx = px[l] - pw[l] * ax, vy = py[l] - pw[l] * ay, vz = pz[l] - pw[l] * az, away = far[l];
        float c = vx * ex + vy * ey + vz * ez, cc = c * c;
        float t = (vx * vx + vy * vy + vz * vz - cc) / cc;
        t = t < 0x1p100f ? t : 0x1p100f; /* also NaN */
        t = c > 0.0f ? t : 0x1p100f;
        t = is_tap[l] > 0.0f ? t : away;
        along[l] = c;
        hidden[l] = SIGHT_HIDDEN + 0.5f - SIGHT_HIDDEN * clamp_share((blind - t) * fade);
    }
    for (int l = 0; l < LANES; l++)
        bytes[l] = (uint8_t)(int32_t)hidden[l];
    memcpy(own, bytes, sizeof bytes);
}

/* The same of a tile whose first pixel is dx, dy off the eye's. By its cells, where no tap's share is off by more than
 * three hundredths for that. */
static void own_tile(const struct sight_tile *tile, const struct sight_taps *taps, int dx, int dy,
                     const struct sight_eye *eye, uint8_t own[SIGHT_TILE_AREA])
{
    _Alignas(64) float far[LANES], along[LANES], unused[LANES];
    _Alignas(16) uint8_t cells[LANES];
    _Alignas(64) uint32_t wide[LANES]; /* the share of a cell four times, for a row of its taps */
    for (int l = 0; l < LANES; l++) {
        const float right = (float)(dx + l % 4 * 4) + 1.5f, down = (float)(dy + l / 4 * 4) + 1.5f;
        far[l] = eye->step * (right * right + down * down);
    }
    own_lanes(tile->cells[0], tile->cells[1], tile->cells[2], tile->cells[3], tile->cells[4], far, eye, along, cells);
    for (int l = 0; l < LANES; l++)
        wide[l] = cells[l] * 0x01010101u;
    for (int row = 0; row < 4; row++) {
        uint8_t *out = own + row * 4 * SIGHT_TILE;
        float least = INFINITY;
        for (int j = 0; j < 4; j++)
            least = fabsf(along[4 * row + j]) < least ? fabsf(along[4 * row + j]) : least;
        if (tile->off[row] * eye->steepest <= 0.03f * least) {
            for (int r = 0; r < 4; r++)
                memcpy(out + r * SIGHT_TILE, wide + 4 * row, SIGHT_TILE);
            continue;
        }
        for (int r = 4 * row; r < 4 * row + 4; r++) {
            const int i = r * SIGHT_TILE;
            for (int l = 0; l < LANES; l++)
                far[l] = eye->step * ((float)(dx + l) * (float)(dx + l) + (float)(dy + r) * (float)(dy + r));
            own_lanes(taps->planes[0] + i, taps->planes[1] + i, taps->planes[2] + i, taps->planes[3] + i,
                      taps->planes[4] + i, far, eye, unused, own + i);
        }
    }
}

/* Whether every own share is seen whole in a square of `size` pixels, the first of which is dx, dy off the eye's: at
 * the corners of its taps' box, between which the taps lie, for what is seen whole is a cone; and at its farthest
 * pixel, where some aren't taps. */
static bool is_open(const struct sight_box *box, int dx, int dy, int size, const struct sight_eye *eye)
{
    const int right = abs(dx) > abs(dx + size - 1) ? dx : dx + size - 1;
    const int down = abs(dy) > abs(dy + size - 1) ? dy : dy + size - 1;
    const float away = eye->step * ((float)right * (float)right + (float)down * (float)down);
    _Alignas(64) float corners[4][LANES], is_tap[LANES], far[LANES] = {0}, along[LANES];
    _Alignas(16) uint8_t own[LANES];
    uint8_t most = 0;
    if (box->gaps && (eye->blind - away) * eye->fade < 1)
        return false;
    if (sight_box_is_empty(box))
        return true;
    const float low[4] = {box->low[0], box->low[1], box->low[2], box->low[3]};
    const float high[4] = {box->high[0], box->high[1], box->high[2], box->high[3]};
    for (int l = 0; l < LANES; l++) {
        corners[0][l] = l & 1 ? high[0] : low[0];
        corners[1][l] = l & 2 ? high[1] : low[1];
        corners[2][l] = l & 4 ? high[2] : low[2];
        corners[3][l] = l & 8 ? high[3] : low[3];
        is_tap[l] = 1;
    }
    own_lanes(corners[0], corners[1], corners[2], corners[3], is_tap, far, eye, along, own);
    for (int l = 0; l < LANES; l++)
        most = own[l] > most ? own[l] : most;
    return most == 0;
}

/* What is hidden beyond a tap, in a march: of BLIND. What hides as good as all hides all. */
enum { STATE = 257, BLIND = STATE * SIGHT_HIDDEN, AS_GOOD_AS_BLIND = BLIND - STATE };

/* STRIP columns of one row, the first `away` columns from the eye's and the others farther by `turn` each: what is
 * hidden beyond each, from the row before's, of which `inward` is one column nearer to the eye's; and of its own share
 * what the way to it hides. The straight line comes in so near to `inward`: slope times the columns away, of 65535. */
ALWAYS_INLINE void march_strip(const uint16_t *before, const uint16_t *inward, const uint8_t *own, int away, int turn,
                               float slope, uint16_t *restrict state, uint8_t *restrict hidden)
{
    _Alignas(64) uint16_t near[STRIP];
    for (int i = 0; i < STRIP; i++) {
        float share = slope * (float)(away + turn * i);
        near[i] = (uint16_t)(int32_t)(share < 65535.0f ? share : 65535.0f);
    }
    for (int i = 0; i < STRIP; i++) {
        uint16_t rest = (uint16_t)(65535 - near[i]), at = (uint16_t)(own[i] * STATE);
        uint16_t first = (uint16_t)((uint32_t)before[i] * rest >> 16);
        uint16_t way = (uint16_t)(first + ((uint32_t)inward[i] * near[i] >> 16));
        uint16_t most = way > at ? way : at;
        uint8_t lost = (uint8_t)((most - at) >> 8);
        state[i] = most < AS_GOOD_AS_BLIND ? most : BLIND;
        hidden[i] = way < AS_GOOD_AS_BLIND ? lost : SIGHT_HIDDEN;
    }
}

/* Transposes 16 x 16 bytes: its index of 8 bits is turned by four, one at a time. */
static void transpose(uint8_t bytes[SIGHT_TILE_AREA])
{
    _Alignas(64) uint8_t turned[SIGHT_TILE_AREA];
    uint8_t *from = bytes, *to = turned;
    for (int pass = 0; pass < 4; pass++) {
        uint8_t *restrict out = to;
        for (int i = 0; i < SIGHT_TILE_AREA / 2; i++) {
            out[2 * i] = from[i];
            out[2 * i + 1] = from[i + SIGHT_TILE_AREA / 2];
        }
        to = from;
        from = out;
    }
}

static void copy_rows(uint8_t *to, size_t to_pitch, const uint8_t *from, size_t from_pitch)
{
    for (int r = 0; r < SIGHT_TILE; r++)
        memcpy(to + (size_t)r * to_pitch, from + (size_t)r * from_pitch, SIGHT_TILE);
}

/* Whether nothing is seen on the way into the tile whose first column is at `before`, nor into those beside it. */
static bool is_dark(const uint16_t *before)
{
    uint16_t least = BLIND;
    for (int i = -SIGHT_TILE; i < 2 * SIGHT_TILE; i++)
        least = before[i] < least ? before[i] : least;
    return least == BLIND;
}

/* Whether all is seen on the way into the tile whose first column is at `before`. */
static bool is_bright(const uint16_t *before)
{
    uint16_t most = 0;
    for (int i = 0; i < SIGHT_TILE; i++)
        most = before[i] > most ? before[i] : most;
    return most == 0;
}

/* What is known of a large square. */
enum { UNKNOWN, CLOSED, OPEN };

/* is_open() of tile `tile` of a band, for the eye at column x, row y; large: what is known of the large squares that
 * the band crosses. */
static bool is_open_tile(const struct sight_field *field, int x, int y, int band, int tile, const struct sight_eye *eye,
                         uint8_t *large)
{
    enum { SIZE = SIGHT_LARGE * SIGHT_TILE };
    const int large_band = band / SIGHT_LARGE, large_tile = tile / SIGHT_LARGE;
    if (large[large_tile] == UNKNOWN) {
        const ptrdiff_t index = large_band * field->large_row + large_tile * field->large_column;
        const bool open =
            is_open(&field->large_boxes[index], large_tile * SIZE - x, large_band * SIZE - y, SIZE, eye);
        large[large_tile] = open ? OPEN : CLOSED;
    }
    return large[large_tile] == OPEN || is_open(&field->boxes[band * field->row + tile * field->column],
                                                tile * SIGHT_TILE - x, band * SIGHT_TILE - y, SIGHT_TILE, eye);
}

static void march(const struct sight_field *field, int x, int y, int step, int limit, const struct sight_eye *eye,
                  uint8_t *scratch, uint8_t *map, struct sight_extent *extent)
{
    /* By columns. All is hidden in `before` and `state` beyond the tiles of a band, as far as a strip reaches. */
    const size_t pitch = (size_t)field->width + 4 * SIGHT_MARGIN;
    uint16_t *before = (uint16_t *)(void *)scratch + SIGHT_MARGIN, *state = before + pitch;
    uint8_t *own = scratch + 2 * sizeof *before * pitch + SIGHT_MARGIN, *hidden = own + SIGHT_TILE * pitch;
    uint8_t *large = hidden + SIGHT_TILE * pitch;
    const int rows = step < 0 ? y : field->height - 1 - y, end = rows < limit ? rows : limit;
    int first = x, last = x; /* columns that are seen of the row before */
    int large_band = -1;
    memset(scratch, 0xff, 2 * sizeof *before * pitch);
    before[x] = 0;
    for (int k = 1; k <= end && first <= last;) {
        const int band = (y + step * k) / SIGHT_TILE, top = band * SIGHT_TILE;
        const int in_band = step > 0 ? top + SIGHT_TILE - (y + k) : y - k - top + 1;
        const int next = k + in_band <= end ? k + in_band : end + 1;
        const int from = first < next - k ? 0 : (first - (next - k)) / SIGHT_TILE;
        const int to = (last + next - k < field->width ? last + next - k : field->width - 1) / SIGHT_TILE;
        const int left = from * SIGHT_TILE, right = (to + 1) * SIGHT_TILE;
        int left_end = x, right_start = x;
        for (int i = 1; i <= SIGHT_MARGIN; i++)
            before[left - i] = state[left - i] = before[right + i - 1] = state[right + i - 1] = BLIND;
        int clear_from = x / SIGHT_TILE, clear_end = clear_from;
        if (band / SIGHT_LARGE != large_band) {
            large_band = band / SIGHT_LARGE;
            memset(large, UNKNOWN, (size_t)field->width / (SIGHT_LARGE * SIGHT_TILE) + 1);
        }
        if (next - k == SIGHT_TILE) {
            while (clear_end <= to && is_bright(before + clear_end * SIGHT_TILE) &&
                   is_open_tile(field, x, y, band, clear_end, eye, large))
                clear_end++;
            while (clear_end > clear_from && clear_from > from && is_bright(before + (clear_from - 1) * SIGHT_TILE) &&
                   is_open_tile(field, x, y, band, clear_from - 1, eye, large))
                clear_from--;
        }
        /* What is seen whole all the way from the eye's tile on hides nothing, and nothing hides it. */
        if (clear_from < clear_end) {
            left_end = clear_from * SIGHT_TILE;
            right_start = clear_end * SIGHT_TILE;
            memset(state + left_end, 0, sizeof *state * (size_t)(right_start - left_end));
        }
        for (int tile = from; tile <= to; tile++) {
            const ptrdiff_t index = band * field->row + tile * field->column;
            const int across = tile * SIGHT_TILE - x, down = top - y;
            if (clear_from <= tile && tile < clear_end)
                continue;
            _Alignas(64) uint8_t shares[SIGHT_TILE_AREA];
            if (is_dark(before + tile * SIGHT_TILE))
                memset(shares, SIGHT_HIDDEN, sizeof shares);
            else if (is_open_tile(field, x, y, band, tile, eye, large))
                memset(shares, 0, sizeof shares);
            else
                own_tile(&field->tiles[index], &field->taps[index], field->turned ? down : across,
                         field->turned ? across : down, eye, shares);
            if (field->turned)
                transpose(shares);
            copy_rows(own + tile * SIGHT_TILE, pitch, shares, SIGHT_TILE);
        }
        for (int r = 0; r < SIGHT_TILE; r++)
            if (step * (top + r - y) < k || step * (top + r - y) >= next)
                memset(hidden + (size_t)r * pitch + left, SIGHT_HIDDEN, (size_t)(right - left));
        for (; k < next; k++) {
            const size_t at = (size_t)(y + step * k - top) * pitch;
            const float slope = (float)(65535.0 / k);
            for (int i = left_end - STRIP; i > left - STRIP; i -= STRIP)
                march_strip(before + i, before + i + 1, own + at + i, x - i, -1, slope, state + i, hidden + at + i);
            for (int i = right_start; i < right; i += STRIP)
                march_strip(before + i, before + i - 1, own + at + i, i - x, 1, slope, state + i, hidden + at + i);
            uint16_t *swap = before;
            before = state;
            state = swap;
        }
        for (int tile = from; tile <= to; tile++) {
            const ptrdiff_t index = band * field->row + tile * field->column;
            uint8_t *shares = map + index * SIGHT_TILE_AREA;
            _Alignas(64) uint8_t found[SIGHT_TILE_AREA];
            if (sight_box_is_empty(&field->boxes[index]))
                continue;
            if (clear_from <= tile && tile < clear_end) {
                memset(shares, 0, SIGHT_TILE_AREA);
                continue;
            }
            copy_rows(found, SIGHT_TILE, hidden + tile * SIGHT_TILE, pitch);
            if (field->turned)
                transpose(found);
            for (int i = 0; i < SIGHT_TILE_AREA; i++)
                shares[i] = found[i] < shares[i] ? found[i] : shares[i];
        }
        for (first = left; first < right && before[first] == BLIND;)
            first++;
        for (last = right - 1; last >= first && before[last] == BLIND;)
            last--;
        extent->left = from < extent->left ? from : extent->left;
        extent->right = to > extent->right ? to : extent->right;
        extent->top = band < extent->top ? band : extent->top;
        extent->bottom = band > extent->bottom ? band : extent->bottom;
    }
}

/* Level k of a tile, of size x size cells, from the level below: means, least and largest of 2 x 2. */
ALWAYS_INLINE void pack_level(uint8_t *levels, int k, int size)
{
    const uint8_t *mean = levels + sight_level(k - 1);
    const uint8_t *low = k > 1 ? mean + 4 * size * size : mean, *high = k > 1 ? low + 4 * size * size : mean;
    uint8_t *restrict means = levels + sight_level(k), *restrict lows = means + size * size;
    uint8_t *restrict highs = lows + size * size;
    _Alignas(64) uint16_t sum[SIGHT_TILE_AREA / 2];
    _Alignas(64) uint8_t least[SIGHT_TILE_AREA / 2], most[SIGHT_TILE_AREA / 2];
    for (int y = 0; y < size; y++)
        for (int x = 0; x < 2 * size; x++) {
            const int i = 4 * y * size + x, j = i + 2 * size, to = 2 * y * size + x;
            sum[to] = (uint16_t)(mean[i] + mean[j]);
            least[to] = low[i] < low[j] ? low[i] : low[j];
            most[to] = high[i] > high[j] ? high[i] : high[j];
        }
    for (int i = 0; i < size * size; i++) {
        means[i] = (uint8_t)((sum[2 * i] + sum[2 * i + 1] + 2) >> 2);
        lows[i] = least[2 * i] < least[2 * i + 1] ? least[2 * i] : least[2 * i + 1];
        highs[i] = most[2 * i] > most[2 * i + 1] ? most[2 * i] : most[2 * i + 1];
    }
}

static enum sight_kind pack(uint8_t map[SIGHT_TILE_AREA], uint8_t levels[SIGHT_PACKED])
{
    uint8_t least = SIGHT_HIDDEN, most = 0;
    for (int i = 0; i < SIGHT_TILE_AREA; i++) {
        least = map[i] < least ? map[i] : least;
        most = map[i] > most ? map[i] : most;
    }
    if (least == SIGHT_HIDDEN)
        return SIGHT_ALL_HIDDEN;
    if (most > 0) {
        memcpy(levels, map, SIGHT_TILE_AREA);
        pack_level(levels, 1, 8);
        pack_level(levels, 2, 4);
        pack_level(levels, 3, 2);
        pack_level(levels, 4, 1);
    }
    memset(map, SIGHT_HIDDEN, SIGHT_TILE_AREA);
    return most > 0 ? SIGHT_MIXED : SIGHT_ALL_SEEN;
}

/* Where a node lies from lane l, in units of r': along the direction, and across it. */
struct place {
    float c, x, y;
};

ALWAYS_INLINE struct place place_of(const struct filter_node *node, const struct filter_lanes *lanes, int l)
{
    float vx = node->x - node->w * lanes->a[0][l], vy = node->y - node->w * lanes->a[1][l];
    float vz = node->z - node->w * lanes->a[2][l];
    float dx = lanes->direction[0][l], dy = lanes->direction[1][l], dz = lanes->direction[2][l];
    return (struct place){
        .c = vx * dx + vy * dy + vz * dz,
        .x = vx * lanes->across[0][0][l] + vy * lanes->across[0][1][l] + vz * lanes->across[0][2][l],
        .y = vx * lanes->across[1][0][l] + vy * lanes->across[1][1][l] + vz * lanes->across[1][2][l]};
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
    _Alignas(64) float lost[LANES], there[LANES], weight[LANES], u[LANES], v[LANES];
    const int sights = node->unlike > 0 ? group->sights : 0;
    const float limit = group->limit;
    for (int l = 0; l < LANES; l++)
        lost[l] = sights > 0 ? 0.0f : hidden[0];
    for (int s = 0; s < sights; s++)
        for (int l = 0; l < LANES; l++)
            lost[l] += group->share[s][l] * hidden[s];
    for (int l = 0; l < LANES; l++) {
        const struct place place = place_of(node, lanes, l);
        float c = place.c, qq = place.x * place.x + place.y * place.y, square = c * c + qq, t = qq / (c * c);
        t = t < 0x1p100f ? t : 0x1p100f;
        t = c > 0.0f ? t : 0x1p100f;
        float f = power_to_weight(-lanes->slope[l] * log2_of_1_plus(t)) - lanes->floor;
        f = f > 0.0f ? f : 0.0f;
        float dx = node->column - group->column[l], dy = node->row - group->row[l];
        f = t <= lanes->reach[l] ? f : 0.0f;
        f = dx * dx + dy * dy <= limit ? f : 0.0f;
        float share = (lanes->blind[l] - t) * lanes->fade[l];
        share = clamp_share(share);
        f *= enlarged(node, square);
        there[l] = f * share;
        share -= lost[l];
        weight[l] = f * (share > 0.0f ? share : 0.0f);
        float scale = c / (square + FLT_MIN);
        u[l] = scale * place.x;
        v[l] = scale * place.y;
    }
    const float solid = node->solid, square = node->square;
    const float unsteady = clamp_share(group->turn + group->move * node->w - 1), unlike = node->unlike * solid;
    for (int l = 0; l < LANES; l++)
        weight[l] *= solid;
    for (int l = 0; l < LANES; l++) {
        group->unsteady[l] += weight[l] * unsteady;
        group->unlike[l] += there[l] * unlike;
    }
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
    memset(group->unsteady, 0, sizeof group->unsteady);
    memset(group->unlike, 0, sizeof group->unlike);
    for (int i = 0; i < 3; i++)
        for (int l = 0; l < LANES; l++) {
            sums->low[i][l] = INFINITY;
            sums->high[i][l] = -INFINITY;
        }
    for (int first = 0; first < count; first += CHUNK) {
        _Alignas(64) float partial[FILTER_MOMENTS][LANES] = {{0}};
        for (int i = first; i < first + CHUNK && i < count; i++)
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
        float c = place.c, qq = place.x * place.x + place.y * place.y, t = qq / (c * c);
        t = t < 0x1p100f ? t : 0x1p100f;
        float f = power_to_weight(-lanes->slope[l] * log2_of_1_plus(t));
        float dx = node->column - group->column[l], dy = node->row - group->row[l];
        f = c > 0.0f ? f : 0.0f;
        f = dx * dx + dy * dy <= lanes->limit[l] ? f : 0.0f;
        f *= node->solid * enlarged(node, c * c + qq);
        sums[0][l] += f * node->radiance[0];
        sums[1][l] += f * node->radiance[1];
        sums[2][l] += f * node->radiance[2];
        sums[3][l] += f;
    }
}

/* The rectangle that holds the windows of all lanes, pixels. */
struct window {
    float left, top, right, bottom;
};

static struct window window_of(const struct filter_group *group)
{
    struct window window = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int l = 0; l < LANES; l++) {
        const float reach = sqrtf(group->lanes.limit[l]);
        if (!(group->lanes.limit[l] >= 0))
            continue;
        window.left = fminf(window.left, group->column[l] - reach);
        window.right = fmaxf(window.right, group->column[l] + reach);
        window.top = fminf(window.top, group->row[l] - reach);
        window.bottom = fmaxf(window.bottom, group->row[l] + reach);
    }
    return window;
}

static void pool(const struct filter_node *nodes, int count, const struct filter_group *group,
                 struct filter_sums *sums)
{
    const struct window window = window_of(group);
    memset(sums, 0, sizeof *sums);
    for (int first = 0; first < count; first += CHUNK) {
        _Alignas(64) float partial[4][LANES] = {{0}};
        for (int i = first; i < first + CHUNK && i < count; i++)
            if (nodes[i].column >= window.left && nodes[i].column <= window.right && nodes[i].row >= window.top &&
                nodes[i].row <= window.bottom)
                pool_node(&nodes[i], group, partial);
        for (int i = 0; i < 4; i++)
            for (int l = 0; l < LANES; l++)
                sums->value[i][l] += (double)partial[i][l];
    }
}

const struct sight_kernel CONCATENATE(sight_kernel_, FILTER_KERNEL_ISA) = {
    .march = march, .pack = pack, .see = see, .pool = pool};
