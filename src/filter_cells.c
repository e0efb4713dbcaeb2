/* Builds the clusters of taps from the finest to the coarsest: each of its four children's.
 *
 * Clusters of samples with an error bound in place of the samples, as in "Lightcuts: a scalable approach to
 * illumination", Walter et al., 2005.
 */
#include "filter_cells.h"

#include <math.h>
#include <stdlib.h>

/* Children whose W/r' lie within this share of the largest are one layer. */
static const float one_layer = 0.1f;

/* Where taps of a cell lie on the mirror: the sum of their a's. */
struct places {
    float a[3], count;
};

/* What a cell is made of. */
struct children {
    struct filter_node nodes[8];
    int count;
    float nearest, farthest; /* of W/r' */
    struct places places;    /* sums */
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

static void children_add(struct children *children, const struct filter_node *node)
{
    children->nodes[children->count++] = *node;
    children->nearest = fmaxf(children->nearest, node->w);
    children->farthest = fminf(children->farthest, node->w);
}

static void places_add(struct children *children, const struct places *places)
{
    for (int i = 0; i < 3; i++)
        children->places.a[i] += places->a[i];
    children->places.count += places->count;
}

static void pixel_add(const struct filter *filter, int x, int y, struct children *children)
{
    struct filter_node node;
    struct places places = {.count = 1};
    if (!filter_cell_of_pixel(filter, x, y, &node))
        return;
    filter_position_at(filter, x, y, places.a);
    children_add(children, &node);
    places_add(children, &places);
}

static void cell_add(const struct filter_cell *cell, const struct places *places, struct children *children)
{
    for (int i = 0; i < 2; i++)
        if (cell->layer[i].solid > 0)
            children_add(children, &cell->layer[i]);
    places_add(children, places);
}

/* The layer of the children that are nearer than `threshold`, or the others. */
static void layer_of(const struct children *children, float threshold, bool near, struct filter_node *layer)
{
    double sum[4] = {0}, solid = 0, cap = 0, radiance[3] = {0}, square = 0, variance = 0, mean[3];
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
        variance += (double)node->solid * (double)node->spread;
        square += (double)node->solid * (double)node->square;
    }
    if (solid == 0)
        return;
    *layer = (struct filter_node){.x = (float)(sum[0] / solid),
                                  .y = (float)(sum[1] / solid),
                                  .z = (float)(sum[2] / solid),
                                  .w = (float)(sum[3] / solid),
                                  .solid = (float)solid,
                                  .cap = (float)(cap / solid),
                                  .square = (float)(square / solid)};
    const struct places *places = &children->places;
    for (int k = 0; k < 3; k++)
        layer->radiance[k] = (float)(radiance[k] / solid);
    for (int k = 0; k < 3; k++)
        mean[k] = (sum[k] - sum[3] * (double)(places->a[k] / places->count)) / solid;
    for (int i = 0; i < children->count; i++) {
        const struct filter_node *node = &children->nodes[i];
        if ((node->w > threshold) != near)
            continue;
        const float at[3] = {node->x, node->y, node->z};
        for (int k = 0; k < 3; k++) {
            double off = (double)(at[k] - node->w * (places->a[k] / places->count)) - mean[k];
            variance += (double)node->solid * off * off;
        }
    }
    layer->spread = (float)(variance / solid);
}

static struct filter_cell cell_of(const struct children *children)
{
    struct filter_cell cell = {0};
    if (children->count == 0)
        return cell;
    const float nearest = children->nearest, farthest = children->farthest;
    const float threshold = nearest - farthest > one_layer * nearest ? (nearest + farthest) / 2 : -1;
    layer_of(children, threshold, true, &cell.layer[0]);
    layer_of(children, threshold, false, &cell.layer[1]);
    return cell;
}

enum result filter_cells_build(const struct filter *filter, struct filter_cells *cells, struct error *err)
{
    struct places *places = NULL, *before = NULL;
    enum result result = RESULT_OK;
    *cells = (struct filter_cells){.width = {filter->taps.width}, .height = {filter->taps.height}};
    for (int k = 1; k < CELL_LEVELS && result == RESULT_OK; k++) {
        const int below_width = cells->width[k - 1], below_height = cells->height[k - 1];
        const int width = (below_width + 1) / 2, height = (below_height + 1) / 2;
        const size_t count = (size_t)width * (size_t)height;
        cells->width[k] = width;
        cells->height[k] = height;
        cells->level[k] = calloc(count, sizeof *cells->level[k]);
        free(before);
        before = places;
        places = calloc(count, sizeof *places);
        if (!cells->level[k] || !places) {
            result = error_memory(err, (double)count * (double)(sizeof *cells->level[k] + sizeof *places));
            break;
        }
        for (size_t i = 0; i < count; i++) {
            struct children children = {.farthest = INFINITY};
            const int x = 2 * (int)(i % (size_t)width), y = 2 * (int)(i / (size_t)width);
            for (int v = y; v < y + 2 && v < below_height; v++)
                for (int u = x; u < x + 2 && u < below_width; u++) {
                    const size_t child = (size_t)v * (size_t)below_width + (size_t)u;
                    if (k == 1)
                        pixel_add(filter, u, v, &children);
                    else
                        cell_add(&cells->level[k - 1][child], &before[child], &children);
                }
            cells->level[k][i] = cell_of(&children);
            places[i] = children.places;
        }
    }
    free(places);
    free(before);
    return result;
}

void filter_cells_free(struct filter_cells *cells)
{
    for (int k = 1; k < CELL_LEVELS; k++)
        free(cells->level[k]);
}
