/* Tiles of taps, and the four marches of sight_march() from a pixel put together. */
#include "filter_visibility.h"

#include "bands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In place of a tile's place among the levels. */
enum { TILE_SEEN = -1, TILE_HIDDEN = -2 };

enum { CELL_ROW = 4 * SIGHT_TILE };

/* The largest distance of a tap of a row of cells from the plane through its cell's mean with the row's slope. */
static float row_off(const struct sight_tile *tile, const struct sight_taps *taps, int row)
{
    double off[CELL_ROW] = {0}, most = 0;
    for (int i = 0; i < 4; i++) {
        const float *plane = taps->planes[i] + row * CELL_ROW;
        double right = 0, down = 0, squares_right = 0, squares_down = 0;
        for (int t = 0; t < CELL_ROW; t++) {
            const double x = t % SIGHT_TILE - (SIGHT_TILE - 1) / 2., y = t / SIGHT_TILE - 1.5;
            right += x * (double)plane[t];
            down += y * (double)plane[t];
            squares_right += x * x;
            squares_down += y * y;
        }
        for (int t = 0; t < CELL_ROW; t++) {
            const double x = t % 4 - 1.5, y = t / SIGHT_TILE - 1.5;
            const double mean = (double)tile->cells[i][row * 4 + t % SIGHT_TILE / 4];
            const double error = (double)plane[t] - mean - x * right / squares_right - y * down / squares_down;
            off[t] += error * error;
            most = fmax(most, off[t]);
        }
    }
    return (float)sqrt(most);
}

static struct sight_box box_empty(void)
{
    struct sight_box box = {.gaps = false};
    for (int i = 0; i < 4; i++) {
        box.low[i] = INFINITY;
        box.high[i] = -INFINITY;
    }
    return box;
}

/* Adds what lies between `low` and `high`, and whether some of it isn't taps. */
static void box_add(struct sight_box *box, const float low[4], const float high[4], bool gaps)
{
    box->gaps = box->gaps || gaps;
    for (int i = 0; i < 4; i++) {
        box->low[i] = fminf(box->low[i], low[i]);
        box->high[i] = fmaxf(box->high[i], high[i]);
    }
}

static void tile_fill(const struct filter *filter, int left, int top, struct sight_tile *tile, struct sight_taps *taps,
                      struct sight_box *box)
{
    static const enum filter_plane from[] = {FILTER_PLANE_X, FILTER_PLANE_Y, FILTER_PLANE_Z, FILTER_PLANE_W,
                                             FILTER_PLANE_AREA};
    int counts[4] = {0};
    *tile = (struct sight_tile){0};
    *taps = (struct sight_taps){0};
    *box = box_empty();
    for (int t = 0; t < SIGHT_TILE_AREA; t++) {
        const int x = left + t % SIGHT_TILE, y = top + t / SIGHT_TILE;
        if (!filter_is_inside(filter, x, y)) {
            box->gaps = true;
            continue;
        }
        for (int i = 0; i < 5; i++)
            taps->planes[i][t] = *filter_tap_at(filter, from[i], x, y);
        for (int i = 0; i < 5; i++)
            tile->cells[i][t / CELL_ROW * 4 + t % SIGHT_TILE / 4] += taps->planes[i][t] / 16;
        if (!(taps->planes[4][t] > 0)) {
            box->gaps = true;
            continue;
        }
        const float at[4] = {taps->planes[0][t], taps->planes[1][t], taps->planes[2][t], taps->planes[3][t]};
        box_add(box, at, at, false);
        counts[t / CELL_ROW]++;
    }
    for (int row = 0; row < 4; row++)
        tile->off[row] = counts[row] == 0 ? 0 : counts[row] == CELL_ROW ? row_off(tile, taps, row) : INFINITY;
}

static void tiles_fill(void *context, int first, int end)
{
    const struct filter_visibility *visibility = context;
    const int across = visibility->across;
    for (int i = first * across; i < end * across; i++)
        tile_fill(visibility->filter, i % across * SIGHT_TILE, i / across * SIGHT_TILE, &visibility->tiles[i],
                  &visibility->taps[i], &visibility->boxes[i]);
}

/* The large squares' boxes, each from its tiles'. */
static void large_boxes_fill(struct filter_visibility *visibility)
{
    const int across = visibility->across, down = visibility->down, large_across = (int)visibility->rows.large_row;
    for (int i = 0; i < large_across * ((down + SIGHT_LARGE - 1) / SIGHT_LARGE); i++) {
        const int left = i % large_across * SIGHT_LARGE, top = i / large_across * SIGHT_LARGE;
        struct sight_box large = box_empty();
        for (int y = top; y < top + SIGHT_LARGE && y < down; y++)
            for (int x = left; x < left + SIGHT_LARGE && x < across; x++) {
                const struct sight_box *box = &visibility->boxes[y * across + x];
                box_add(&large, box->low, box->high, box->gaps);
            }
        visibility->large_boxes[i] = large;
    }
}

enum result filter_visibility_build(const struct filter *filter, struct filter_visibility *visibility,
                                    struct error *err)
{
    const int width = filter->taps.width, height = filter->taps.height;
    const int across = (width + SIGHT_TILE - 1) / SIGHT_TILE, down = (height + SIGHT_TILE - 1) / SIGHT_TILE;
    const size_t count = (size_t)across * (size_t)down;
    struct sight_tile *tiles = malloc(count * sizeof *tiles);
    struct sight_taps *taps = malloc(count * sizeof *taps);
    struct sight_box *boxes = malloc(count * sizeof *boxes);
    const int large_across = (across + SIGHT_LARGE - 1) / SIGHT_LARGE;
    const int large_down = (down + SIGHT_LARGE - 1) / SIGHT_LARGE;
    struct sight_box *large_boxes = malloc((size_t)large_across * (size_t)large_down * sizeof *large_boxes);
    const struct sight_field rows = {.tiles = tiles,
                                     .taps = taps,
                                     .boxes = boxes,
                                     .large_boxes = large_boxes,
                                     .width = width,
                                     .height = height,
                                     .column = 1,
                                     .row = across,
                                     .large_column = 1,
                                     .large_row = large_across};
    struct sight_field columns = rows;
    columns.width = height;
    columns.height = width;
    columns.column = across;
    columns.row = 1;
    columns.large_column = large_across;
    columns.large_row = 1;
    columns.turned = true;
    *visibility = (struct filter_visibility){.filter = filter,
                                             .tiles = tiles,
                                             .taps = taps,
                                             .boxes = boxes,
                                             .large_boxes = large_boxes,
                                             .across = across,
                                             .down = down,
                                             .rows = rows,
                                             .columns = columns};
    if (!tiles || !taps || !boxes || !large_boxes)
        return error_memory(err, (double)count * (double)(sizeof *tiles + sizeof *taps + sizeof *boxes));
    enum result result = bands_run(down, 1, filter->options->threads, tiles_fill, visibility, err);
    if (result == RESULT_OK)
        large_boxes_fill(visibility);
    return result;
}

void filter_visibility_free(struct filter_visibility *visibility)
{
    free(visibility->tiles);
    free(visibility->taps);
    free(visibility->boxes);
    free(visibility->large_boxes);
}

bool sight_scratch_make(const struct filter_visibility *visibility, struct sight_scratch *scratch)
{
    const struct sight_field *rows = &visibility->rows;
    const size_t map = (size_t)visibility->across * (size_t)visibility->down * SIGHT_TILE_AREA;
    scratch->map = malloc(map);
    scratch->march = malloc(SIGHT_SCRATCH(rows->width > rows->height ? rows->width : rows->height));
    if (scratch->map)
        memset(scratch->map, SIGHT_HIDDEN, map);
    return scratch->map && scratch->march;
}

void sight_scratch_free(struct sight_scratch *scratch)
{
    free(scratch->map);
    free(scratch->march);
}

static bool cells_reserve(struct sight *sight, size_t cells)
{
    if (cells > sight->cell_capacity) {
        free(sight->tiles);
        free(sight->shares);
        sight->tiles = malloc(cells * sizeof *sight->tiles);
        sight->shares = malloc(cells * sizeof *sight->shares);
        sight->cell_capacity = sight->tiles && sight->shares ? cells : 0;
    }
    return cells <= sight->cell_capacity;
}

static bool levels_reserve(struct sight *sight, size_t bytes)
{
    if (bytes > sight->capacity) {
        uint8_t *levels = realloc(sight->levels, 2 * bytes);
        sight->levels = levels ? levels : sight->levels;
        sight->capacity = levels ? 2 * bytes : sight->capacity;
    }
    return bytes <= sight->capacity;
}

/* The levels above the tiles, which are at `extent`. How many cells all have. */
static size_t coarse_place(struct sight *sight, struct sight_extent extent)
{
    size_t count = 0;
    for (int i = 0; i < SIGHT_COARSE_LEVELS; i++) {
        const int left = extent.left >> i, top = extent.top >> i;
        const struct sight_coarse coarse = {.left = left,
                                            .top = top,
                                            .across = (extent.right >> i) + 1 - left,
                                            .down = (extent.bottom >> i) + 1 - top,
                                            .first = count};
        sight->coarse[i] = coarse;
        count += (size_t)coarse.across * (size_t)coarse.down;
    }
    return count;
}

/* The shares of all cells larger than a tile, each from its four of the level below. */
static void coarse_fill(struct sight *sight)
{
    for (int i = 1; i < SIGHT_COARSE_LEVELS; i++) {
        const struct sight_coarse *coarse = &sight->coarse[i];
        for (int c = 0; c < coarse->across * coarse->down; c++) {
            const int x = coarse->left + c % coarse->across, y = coarse->top + c / coarse->across;
            int sum = 0, least = SIGHT_HIDDEN, most = 0;
            for (int n = 0; n < 4; n++) {
                int share[3];
                sight_share(sight, SIGHT_TILE_LEVEL + i - 1, 2 * x + n % 2, 2 * y + n / 2, share);
                sum += share[0];
                least = share[1] < least ? share[1] : least;
                most = share[2] > most ? share[2] : most;
            }
            uint8_t *to = sight->shares[coarse->first + (size_t)c];
            to[0] = (uint8_t)((sum + 2) / 4);
            to[1] = (uint8_t)least;
            to[2] = (uint8_t)most;
        }
    }
}

/* Takes the marched map over; it is all hidden again. */
static bool sight_keep(const struct filter_visibility *visibility, uint8_t *map, struct sight_extent extent,
                       struct sight *sight)
{
    const struct sight_coarse *tiles = &sight->coarse[0];
    size_t used = 0;
    if (!cells_reserve(sight, coarse_place(sight, extent)))
        return false;
    for (int i = 0; i < tiles->across * tiles->down; i++) {
        const int column = tiles->left + i % tiles->across, row = tiles->top + i / tiles->across;
        if (!levels_reserve(sight, (used + 1) * SIGHT_PACKED))
            return false;
        uint8_t *levels = sight->levels + used * SIGHT_PACKED;
        const enum sight_kind kind = visibility->filter->sight->pack(
            map + ((size_t)row * (size_t)visibility->across + (size_t)column) * SIGHT_TILE_AREA, levels);
        sight->tiles[i] = kind == SIGHT_MIXED ? (int32_t)used++ : kind == SIGHT_ALL_SEEN ? TILE_SEEN : TILE_HIDDEN;
        if (kind == SIGHT_MIXED)
            memcpy(sight->shares[i], levels + sight_level(SIGHT_TILE_LEVEL), 3);
        else
            memset(sight->shares[i], kind == SIGHT_ALL_SEEN ? 0 : SIGHT_HIDDEN, 3);
    }
    coarse_fill(sight);
    return true;
}

bool sight_make(const struct filter_visibility *visibility, int x, int y, struct sight_scratch *scratch,
                struct sight *sight)
{
    const struct filter *filter = visibility->filter;
    const struct sight_field *both[2] = {&visibility->rows, &visibility->columns};
    const int across = visibility->across, tile_x = x / SIGHT_TILE, tile_y = y / SIGHT_TILE;
    struct filter_lanes lanes = filter_lanes_empty(x, y);
    struct sight_extent found[2] = {{tile_x, tile_y, tile_x, tile_y}, {tile_y, tile_x, tile_y, tile_x}};
    scratch->map[((size_t)tile_y * (size_t)across + (size_t)tile_x) * SIGHT_TILE_AREA +
                (size_t)(y % SIGHT_TILE * SIGHT_TILE + x % SIGHT_TILE)] = 0;
    if (filter_lane_fill(filter, x, y, 0, &lanes)) {
        struct sight_eye eye = {.blind = lanes.blind[0], .fade = lanes.fade[0], .step = lanes.step[0]};
        for (int i = 0; i < 3; i++) {
            eye.a[i] = lanes.a[i][0];
            eye.direction[i] = lanes.direction[i][0];
        }
        eye.steepest = 2 * eye.fade * sqrtf(eye.blind) * (1 + eye.blind);
        const int limit = (int)filter->radius_limit_px;
        for (int i = 0; i < 2; i++)
            for (int step = -1; step <= 1; step += 2)
                filter->sight->march(both[i], i == 0 ? x : y, i == 0 ? y : x, step, limit, &eye, scratch->march,
                                     scratch->map, &found[i]);
    }
    const struct sight_extent *rows = &found[0], *columns = &found[1];
    const struct sight_extent extent = {.left = columns->top < rows->left ? columns->top : rows->left,
                                        .top = columns->left < rows->top ? columns->left : rows->top,
                                        .right = columns->bottom > rows->right ? columns->bottom : rows->right,
                                        .bottom = columns->right > rows->bottom ? columns->right : rows->bottom};
    sight->x = x;
    sight->y = y;
    return sight_keep(visibility, scratch->map, extent, sight);
}

void sight_free(struct sight *sight)
{
    free(sight->shares);
    free(sight->tiles);
    free(sight->levels);
}

/* The place of cell (x, y) among those of a level; -1: it is outside. */
static int place_of(const struct sight_coarse *coarse, int x, int y)
{
    const int column = x - coarse->left, row = y - coarse->top;
    return column < 0 || row < 0 || column >= coarse->across || row >= coarse->down ? -1
                                                                                    : row * coarse->across + column;
}

void sight_share(const struct sight *sight, int k, int x, int y, int share[3])
{
    const struct sight_coarse *coarse = &sight->coarse[k - SIGHT_TILE_LEVEL];
    const int place = place_of(coarse, x, y);
    for (int i = 0; i < 3; i++)
        share[i] = place < 0 ? SIGHT_HIDDEN : sight->shares[coarse->first + (size_t)place][i];
}

const uint8_t *sight_levels(const struct sight *sight, int x, int y)
{
    const int place = place_of(&sight->coarse[0], x, y);
    return place < 0 || sight->tiles[place] < 0 ? NULL : sight->levels + (size_t)sight->tiles[place] * SIGHT_PACKED;
}
