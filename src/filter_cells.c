/* Builds the clusters of taps from the finest to the coarsest: each of its four children's.
 *
 * Clusters of samples with an error bound in place of the samples, as in "Lightcuts: a scalable approach to
 * illumination", Walter et al., 2005.
 */
#include "filter_cells.h"

#include "bands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Children whose W/r' lie within this share of the largest are one layer. */
static const float one_layer = 0.1f;

/* What a cell is made of. */
struct children {
    struct filter_node nodes[8];
    float a[8][3];           /* means of their own a's */
    int count;
    float nearest, farthest; /* of W/r' */
    double places[3];        /* sum of the a's of all that is there */
    double place_count;
};

bool filter_cell_of_pixel(const struct filter *filter, int x, int y, struct filter_node *node)
{
    const double pi = 3.14159265358979324;
    float square = *filter_tap_at(filter, FILTER_PLANE_NEAREST, x, y) * (float)FILTER_MOST_ENLARGED;
    float area = *filter_tap_at(filter, FILTER_PLANE_AREA, x, y), bright = 0;
    if (!(area > 0) || !(square > 0))
        return false;
    const float distance = sqrtf(square), solid = area / square;
    *node = (struct filter_node){.x = *filter_tap_at(filter, FILTER_PLANE_X, x, y) / distance,
                                 .y = *filter_tap_at(filter, FILTER_PLANE_Y, x, y) / distance,
                                 .z = *filter_tap_at(filter, FILTER_PLANE_Z, x, y) / distance,
                                 .w = *filter_tap_at(filter, FILTER_PLANE_W, x, y) / distance,
                                 .solid = solid,
                                 .cap = solid / (float)(2 * pi)};
    for (int i = 0; i < 3; i++) {
        float radiance = *filter_tap_at(filter, FILTER_PLANE_R + (unsigned)i, x, y);
        node->radiance[i] = radiance;
        bright += radiance;
    }
    node->square = bright * bright;
    return true;
}

static void children_add(struct children *children, const struct filter_node *node, const float a[3])
{
    memcpy(children->a[children->count], a, sizeof children->a[0]);
    children->nodes[children->count++] = *node;
    children->nearest = fmaxf(children->nearest, node->w);
    children->farthest = fminf(children->farthest, node->w);
}

static void places_add(struct children *children, const float a[3], double count)
{
    for (int i = 0; i < 3; i++)
        children->places[i] += count * (double)a[i];
    children->place_count += count;
}

static void pixel_add(const struct filter *filter, int x, int y, struct children *children)
{
    struct filter_node node;
    float a[3];
    if (!filter_cell_of_pixel(filter, x, y, &node))
        return;
    filter_position_at(filter, x, y, a);
    children_add(children, &node, a);
    places_add(children, a, 1);
}

static void cell_add(const struct filter_cell *cell, struct children *children)
{
    for (int i = 0; i < 2; i++)
        if (cell->layer[i].solid > 0)
            children_add(children, &cell->layer[i], cell->a);
    places_add(children, cell->a, (double)cell->pixels);
}

/* The layer of the children that are nearer than `threshold`, or the others. */
static void layer_of(const struct children *children, const float a[3], float threshold, bool near,
                     struct filter_node *layer)
{
    double sum[4] = {0}, solid = 0, cap = 0, radiance[3] = {0}, square = 0, variance = 0, depth = 0, mean[4];
    for (int i = 0; i < children->count; i++) {
        const struct filter_node *node = &children->nodes[i];
        if ((node->w > threshold) != near)
            continue;
        const float at[4] = {node->x, node->y, node->z, node->w};
        for (int k = 0; k < 4; k++)
            sum[k] += (double)node->solid * (double)at[k];
        for (int k = 0; k < 3; k++)
            radiance[k] += (double)node->solid * (double)node->radiance[k];
        solid += (double)node->solid;
        cap += (double)node->solid * (double)node->cap;
        square += (double)node->solid * (double)node->square;
    }
    if (solid == 0)
        return;
    for (int k = 0; k < 4; k++)
        mean[k] = sum[k] / solid;
    for (int i = 0; i < children->count; i++) {
        const struct filter_node *node = &children->nodes[i];
        if ((node->w > threshold) != near)
            continue;
        const float at[3] = {node->x, node->y, node->z};
        const double own = (double)filter_node_spread(node, children->a[i], a), off_w = (double)node->w - mean[3];
        double off = 0;
        for (int k = 0; k < 3; k++) {
            const double one = (double)at[k] - mean[k] - off_w * (double)a[k];
            off += one * one;
        }
        variance += (double)node->solid * (own * own + off);
        depth += (double)node->solid * ((double)node->depth * (double)node->depth + off_w * off_w);
    }
    *layer = (struct filter_node){.x = (float)mean[0],
                                  .y = (float)mean[1],
                                  .z = (float)mean[2],
                                  .w = (float)mean[3],
                                  .solid = (float)solid,
                                  .cap = (float)(cap / solid),
                                  .square = (float)(square / solid),
                                  .spread = (float)sqrt(variance / solid),
                                  .depth = (float)sqrt(depth / solid)};
    for (int k = 0; k < 3; k++)
        layer->radiance[k] = (float)(radiance[k] / solid);
}

static struct filter_cell cell_of(const struct children *children)
{
    struct filter_cell cell = {.pixels = (float)children->place_count};
    if (children->count == 0)
        return cell;
    const float nearest = children->nearest, farthest = children->farthest;
    const float threshold = nearest - farthest > one_layer * nearest ? sqrtf(nearest * farthest) : -1;
    for (int k = 0; k < 3; k++)
        cell.a[k] = (float)(children->places[k] / children->place_count);
    layer_of(children, cell.a, threshold, true, &cell.layer[0]);
    layer_of(children, cell.a, threshold, false, &cell.layer[1]);
    return cell;
}

/* A level that is being built from the one below. */
struct level {
    const struct filter *filter;
    struct filter_cells *cells;
    int k;
};

static void rows_build(void *context, int first, int end)
{
    const struct level *level = context;
    const struct filter_cells *cells = level->cells;
    const int k = level->k, width = cells->width[k], below_width = cells->width[k - 1];
    for (int y = first; y < end; y++)
        for (int x = 0; x < width; x++) {
            struct children children = {.farthest = INFINITY};
            for (int v = 2 * y; v < 2 * y + 2 && v < cells->height[k - 1]; v++)
                for (int u = 2 * x; u < 2 * x + 2 && u < below_width; u++) {
                    if (k == 1)
                        pixel_add(level->filter, u, v, &children);
                    else
                        cell_add(&cells->level[k - 1][(size_t)v * (size_t)below_width + (size_t)u], &children);
                }
            cells->level[k][(size_t)y * (size_t)width + (size_t)x] = cell_of(&children);
        }
}

enum result filter_cells_build(const struct filter *filter, struct filter_cells *cells, struct error *err)
{
    enum result result = RESULT_OK;
    *cells = (struct filter_cells){.width = {filter->taps.width}, .height = {filter->taps.height}};
    for (int k = 1; k < CELL_LEVELS && result == RESULT_OK; k++) {
        struct level level = {filter, cells, k};
        const int width = (cells->width[k - 1] + 1) / 2, height = (cells->height[k - 1] + 1) / 2;
        const size_t count = (size_t)width * (size_t)height;
        cells->width[k] = width;
        cells->height[k] = height;
        cells->level[k] = calloc(count, sizeof *cells->level[k]);
        if (!cells->level[k])
            result = error_memory(err, (double)count * (double)sizeof *cells->level[k]);
        else
            result = bands_run(height, 8, filter->options->threads, rows_build, &level, err);
    }
    return result;
}

void filter_cells_free(struct filter_cells *cells)
{
    for (int k = 1; k < CELL_LEVELS; k++)
        free(cells->level[k]);
}
