/* Taps for the fast filter: cells of 2^n x 2^n pixels, in the order in which 16 pixels some columns apart look at
 * them. */
#include "filter_cells.h"

#include "bands.h"

#include <math.h>
#include <string.h>

/* Sums over the pixels of a cell, each with its weight. */
struct cell {
    double weights, solid, gain, a[3], b[4], radiance[3];
    int count;
};

static void cell_add(const struct filter_level *level, int x, int y, struct cell *cell)
{
    const bool paper = level->shared->options->mode == FILTER_MODE_PAPER;
    if (!filter_level_is_tap(level, x, y))
        return;
    float a[3];
    double direction[3];
    filter_level_position(level, x, y, a);
    double distance = filter_level_direction(level, a, x, y, direction);
    double w = (double)*filter_level_tap(level, FILTER_PLANE_W, x, y) / distance;
    double gain = (double)*filter_level_tap(level, FILTER_PLANE_GAIN, x, y);
    double solid = (double)*filter_level_tap(level, FILTER_PLANE_AREA, x, y) / (distance * distance);
    double weight = paper ? gain : solid;
    if (!(distance > 0) || !(w < 1e30) || !(solid < 1e30))
        return;
    for (int i = 0; i < 3; i++) {
        cell->b[i] += weight * (direction[i] + w * (double)a[i]);
        cell->a[i] += weight * (double)a[i];
        cell->radiance[i] += weight * (double)*filter_level_tap(level, FILTER_PLANE_R + (unsigned)i, x, y);
    }
    cell->b[3] += weight * w;
    cell->weights += weight;
    cell->solid += solid;
    cell->gain += gain;
    cell->count++;
}

/* The tap that stands for the cell; false: there is none. */
static bool cell_tap(const struct filter_level *level, const struct cell *cell, float tap[FILTER_PLANES])
{
    if (cell->weights <= 0)
        return false;
    double b[4], largest = 0, square = 0, distance = 0;
    for (int i = 0; i < 3; i++) {
        b[i] = cell->b[3] > 0 ? cell->b[i] / cell->b[3] : cell->b[i];
        largest = fmax(largest, fabs(b[i]));
        square += cell->b[i] * cell->b[i];
    }
    b[3] = cell->b[3] > 0 && largest < 0x1p60;
    if (square == 0)
        return false;
    for (int i = 0; i < 3; i++) {
        if (b[3] == 0)
            b[i] = cell->b[i] / sqrt(square);
        double v = b[i] - b[3] * cell->a[i] / cell->weights;
        distance += v * v;
    }
    for (int i = 0; i < 4; i++)
        tap[FILTER_PLANE_X + i] = (float)b[i];
    for (int i = 0; i < 3; i++)
        tap[FILTER_PLANE_R + i] = (float)(cell->radiance[i] / cell->weights);
    const bool paper = level->shared->options->mode == FILTER_MODE_PAPER;
    tap[FILTER_PLANE_GAIN] = (float)(paper ? cell->gain : cell->gain / cell->count);
    tap[FILTER_PLANE_AREA] = (float)fmax(cell->solid * distance, 1e-30);
    return true;
}

struct filling {
    const struct filter_level *level;
    struct filter_taps *taps;
    int cell, shift;
};

static void fill_rows(void *context, int first, int end)
{
    const struct filling *filling = context;
    const struct filter_level *level = filling->level;
    struct filter_taps *taps = filling->taps;
    const int size = 1 << filling->cell;
    const int repeat = filling->cell > filling->shift ? 1 << (filling->cell - filling->shift) : 1;
    const int cells = (level->taps.width + size - 1) >> filling->cell;
    for (int y = first; y < end; y++)
        for (int x = 0; x < cells; x++) {
            struct cell cell = {0};
            float tap[FILTER_PLANES];
            for (int v = y * size; v < (y + 1) * size && v < level->taps.height; v++)
                for (int u = x * size; u < (x + 1) * size && u < level->taps.width; u++)
                    cell_add(level, u, v, &cell);
            if (!cell_tap(level, &cell, tap))
                continue;
            for (int i = 0; i < FILTER_PLANES; i++)
                for (int r = 0; r < repeat && x * repeat + r < taps->width; r++)
                    taps->planes[i][(size_t)y * taps->stride + filter_taps_column(taps, x * repeat + r)] = tap[i];
        }
    filter_taps_blocks(taps, first, end);
}

static void order_rows(void *context, int first, int end)
{
    const struct filling *filling = context;
    const struct filter_taps *from = &filling->level->taps;
    struct filter_taps *to = filling->taps;
    for (int i = 0; i < FILTER_PLANES; i++)
        for (int y = first; y < end; y++)
            for (int x = 0; x < to->width; x++)
                to->planes[i][(size_t)y * to->stride + filter_taps_column(to, x)] =
                    from->planes[i][(size_t)y * from->stride + FILTER_BORDER + (size_t)x];
    filter_taps_blocks(to, first, end);
}

static enum result view_add(const struct filter_level *level, struct filter_view *view, int cell, struct error *err)
{
    const int shift = view->shift, order = cell < shift ? shift - cell : 0, size = 1 << (cell < shift ? cell : shift);
    const int columns = (level->taps.width + size - 1) / size, rows = (level->taps.height + (1 << cell) - 1) >> cell;
    struct filter_taps *taps = &view->taps[view->cells++];
    *taps = level->taps;
    if (shift == 0 && cell == 0)
        return RESULT_OK;
    enum result result = filter_taps_alloc(taps, columns, rows, order, err);
    if (result == RESULT_OK)
        result = bands_run(rows, 16, level->shared->options->threads, cell == 0 ? order_rows : fill_rows,
                           &(struct filling){level, taps, cell, shift}, err);
    return result;
}

enum result filter_cells_view(const struct filter_level *level, int shift, int cells, struct filter_view *view,
                              struct error *err)
{
    enum result result = RESULT_OK;
    *view = (struct filter_view){.shift = shift};
    for (int cell = 0; cell < cells && result == RESULT_OK; cell++)
        result = view_add(level, view, cell, err);
    return result;
}

void filter_cells_view_free(struct filter_view *view)
{
    for (int i = 0; i < view->cells; i++)
        if (view->shift != 0 || i > 0)
            filter_taps_free(&view->taps[i]);
}
