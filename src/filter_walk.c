/* The walk over the cells, from the coarsest to those that are used whole. */
#include "filter_walk.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cell's hidden share may always be off by so much. */
static const float range_least = 0.05f;

/* A cell that isn't larger than this share of how far is seen is in or out as its middle is. */
static const double limit_share = 1 / 16.;

struct walker {
    const struct filter *filter;
    const struct filter_cells *cells;
    const struct filter_walk *walk;
    struct filter_nodes *list;
    /* For each sight, of the cell where the walk is: */
    float hidden[SIGHTS_OF_GROUP];
    const uint8_t *tiles[SIGHTS_OF_GROUP]; /* the levels of the tile that it lies in */
};

/* How a cell is seen. */
struct look {
    bool seen;                           /* by a sight that isn't open */
    float range;                         /* how far least and largest hidden share of a sight are apart */
    unsigned char open[SIGHTS_OF_GROUP]; /* sights that don't see all of it alike */
    int open_count;
};

/* How cell (x, y) of level k is seen, which is part of a cell that is seen as in `whole`. */
static struct look look_at(struct walker *walker, int k, int x, int y, const struct look *whole)
{
    struct look look = {.seen = whole->seen};
    int range = 0;
    for (int i = 0; i < whole->open_count; i++) {
        const unsigned char s = whole->open[i];
        const struct sight *sight = walker->walk->sights[s];
        int share[3];
        if (k >= SIGHT_TILE_LEVEL)
            sight_share(sight, k, x, y, share);
        else
            sight_share_within(walker->tiles[s], k, x, y, share);
        if (k == SIGHT_TILE_LEVEL)
            walker->tiles[s] = sight_levels(sight, x, y);
        walker->hidden[s] = (float)share[0] / SIGHT_HIDDEN;
        if (share[2] > share[1])
            look.open[look.open_count++] = s;
        else
            look.seen = look.seen || share[1] < SIGHT_HIDDEN;
        range = share[2] - share[1] > range ? share[2] - share[1] : range;
    }
    look.range = (float)range / SIGHT_HIDDEN;
    return look;
}

/* A layer of a cell from the middle lane. */
struct view {
    bool in_lobe; /* or about */
    float spread; /* standard deviation of its directions, radians */
    float t;      /* tan^2(theta) of what of it is nearest to the direction */
    float square; /* of the distance of what of it is nearest */
};

static struct view view_of(const struct filter_walk *walk, const struct filter_cell *cell, int i)
{
    const struct filter_lanes *lanes = walk->lanes;
    const struct filter_node *layer = &cell->layer[i];
    const int l = walk->middle;
    const float margin = 1.3f, a[3] = {lanes->a[0][l], lanes->a[1][l], lanes->a[2][l]};
    const float v[3] = {layer->x - layer->w * a[0], layer->y - layer->w * a[1], layer->z - layer->w * a[2]};
    float c = 0, square = 0;
    if (layer->solid == 0)
        return (struct view){0};
    for (int k = 0; k < 3; k++) {
        c += v[k] * lanes->direction[k][l];
        square += v[k] * v[k];
    }
    const float spread = filter_node_spread(layer, cell->a, a), off = 2 * spread, distance = sqrtf(square);
    const float nearest = distance > off ? distance - off : 0, aside_square = square - c * c;
    const float beside = off + walk->turn * distance;
    const float aside = aside_square > beside * beside ? sqrtf(aside_square) - beside : 0;
    const float t = aside / (c + off) * aside / (c + off);
    return (struct view){.in_lobe = c + off > 0 && t <= lanes->reach[l] * margin,
                         .spread = spread / (distance + FLT_MIN),
                         .t = t,
                         .square = nearest * nearest};
}

static bool is_spread(const struct filter_walk *walk, struct view view)
{
    return view.in_lobe && view.spread > walk->spread;
}

/* A layer's weight in the lobe, about, or somewhat more. */
static float view_weight(const struct filter_walk *walk, const struct filter_node *layer, struct view view)
{
    return view.in_lobe ? exp2f(-walk->lanes->slope[walk->middle] * log2f(1 + view.t)) * layer->solid /
                              fmaxf(view.square, (float)(1 / FILTER_MOST_ENLARGED))
                        : 0;
}

/* How a cell that is small enough for its distance is taken. */
enum use { USE_NONE, USE_WHOLE, USE_PARTS };

/* None where it is out of the lobe; its parts where its directions differ too much, or part of it is hidden, and that
 * counts. */
static enum use use_of(const struct filter_walk *walk, const struct filter_cell *cell, float hidden_range)
{
    const struct view near = view_of(walk, cell, 0), far = view_of(walk, cell, 1);
    if (is_spread(walk, near) || is_spread(walk, far))
        return USE_PARTS;
    if (hidden_range > range_least) {
        const float weight = view_weight(walk, &cell->layer[0], near) + view_weight(walk, &cell->layer[1], far);
        if (weight * hidden_range > walk->hidden * walk->lobe)
            return USE_PARTS;
    }
    return near.in_lobe || far.in_lobe ? USE_WHOLE : USE_NONE;
}

static bool nodes_reserve(struct filter_nodes *list)
{
    if (list->count < list->capacity)
        return true;
    const int capacity = list->capacity ? 2 * list->capacity : 4096;
    struct filter_node *nodes = realloc(list->nodes, (size_t)capacity * sizeof *nodes);
    list->nodes = nodes ? nodes : list->nodes;
    list->capacity = nodes ? capacity : list->capacity;
    list->out_of_memory = !nodes;
    return nodes != NULL;
}

static bool hidden_reserve(struct filter_nodes *list)
{
    if (list->capacity == list->hidden_capacity)
        return true;
    float *hidden = realloc(list->hidden, (size_t)list->capacity * SIGHTS_OF_GROUP * sizeof *hidden);
    list->hidden = hidden ? hidden : list->hidden;
    list->hidden_capacity = hidden ? list->capacity : list->hidden_capacity;
    list->out_of_memory = !hidden;
    return hidden != NULL;
}

/* A node of cell (x, y) of level k; NULL: no memory. */
static struct filter_node *node_add(struct filter_nodes *list, const struct filter_node *node, int k, int x, int y)
{
    if (!nodes_reserve(list))
        return NULL;
    struct filter_node *added = &list->nodes[list->count++];
    *added = *node;
    added->column = (float)(x << k) + (float)((1 << k) - 1) / 2;
    added->row = (float)(y << k) + (float)((1 << k) - 1) / 2;
    return added;
}

/* The same, seen as the walk found it. */
static void seen_add(struct walker *walker, const struct filter_node *node, int k, int x, int y)
{
    struct filter_nodes *list = walker->list;
    struct filter_node *added = node_add(list, node, k, x, y);
    if (!added || !hidden_reserve(list))
        return;
    float *hidden = list->hidden + (size_t)(list->count - 1) * SIGHTS_OF_GROUP, low = 1, high = 0;
    hidden[0] = 0;
    for (int s = 0; s < walker->walk->sight_count; s++) {
        const float share = walker->hidden[s];
        hidden[s] = share;
        low = share < low ? share : low;
        high = share > high ? share : high;
    }
    added->unlike = high > low ? high - low : 0;
}

/* How far cell (x, y) of level k is from the block, pixels. */
static int away_of(const struct filter_walk *walk, int k, int x, int y)
{
    const int size = 1 << k, left = x << k, top = y << k, right = left + size - 1, bottom = top + size - 1;
    const int off_x = left > walk->right ? left - walk->right : walk->left > right ? walk->left - right : 0;
    const int off_y = top > walk->bottom ? top - walk->bottom : walk->top > bottom ? walk->top - bottom : 0;
    return off_x > off_y ? off_x : off_y;
}

static const struct filter_cell *cell_at(const struct filter_cells *cells, int k, int x, int y)
{
    return &cells->level[k][(size_t)y * (size_t)cells->width[k] + (size_t)x];
}

/* Whether some of cell (x, y) of level k is as far from some of the block as is seen, or farther, and the cell isn't
 * small for that. */
static bool is_at_limit(const struct filter_walk *walk, int k, int x, int y)
{
    const int size = 1 << k, left = x << k, top = y << k;
    const double off_x = fmax(left + size - 1 - walk->left, walk->right - left);
    const double off_y = fmax(top + size - 1 - walk->top, walk->bottom - top);
    return size > limit_share * (double)walk->limit_px && hypot(off_x, off_y) > walk->limit_px;
}

/* Adds the nodes of a cell of level k, or of its parts, that are seen and in the lobe. */
static void cell_walk(struct walker *walker, int k, int x, int y, const struct look *whole)
{
    const struct filter_walk *walk = walker->walk;
    const struct filter_cells *cells = walker->cells;
    struct filter_nodes *list = walker->list;
    if (list->out_of_memory)
        return;
    const struct look look = look_at(walker, k, x, y, whole);
    if (!look.seen && look.open_count == 0)
        return;
    if (k == 0) {
        struct filter_node node;
        if (filter_cell_of_pixel(walker->filter, x, y, &node))
            seen_add(walker, &node, k, x, y);
        return;
    }
    const struct filter_cell *cell = cell_at(cells, k, x, y);
    const int away = away_of(walk, k, x, y);
    if (cell->pixels == 0 || away > walk->limit_px)
        return;
    const bool large = 1 << k > walk->finest &&
                       ((float)(1 << k) > (float)away * walk->size || is_at_limit(walk, k, x, y));
    const enum use use = large ? USE_PARTS : use_of(walk, cell, look.range);
    if (use == USE_PARTS) {
        for (int v = 2 * y; v < 2 * y + 2 && v < cells->height[k - 1]; v++)
            for (int u = 2 * x; u < 2 * x + 2 && u < cells->width[k - 1]; u++)
                cell_walk(walker, k - 1, u, v, &look);
        return;
    }
    for (int i = 0; i < 2 && use == USE_WHOLE; i++)
        if (cell->layer[i].solid > 0)
            seen_add(walker, &cell->layer[i], k, x, y);
}

void filter_walk(const struct filter *filter, const struct filter_cells *cells, const struct filter_walk *walk,
                 struct filter_nodes *nodes)
{
    const int top = CELL_LEVELS - 1;
    struct walker walker = {.filter = filter, .cells = cells, .walk = walk, .list = nodes};
    struct look whole = {.seen = walk->sight_count == 0, .open_count = walk->sight_count};
    for (int s = 0; s < walk->sight_count; s++)
        whole.open[s] = (unsigned char)s;
    nodes->count = 0;
    for (int y = 0; y < cells->height[top]; y++)
        for (int x = 0; x < cells->width[top]; x++)
            cell_walk(&walker, top, x, y, &whole);
}

/* Adds the nodes of a cell of level k, or of its parts, to the pool. */
static void pool_walk(const struct walker *walker, int k, int x, int y)
{
    const struct filter_walk *walk = walker->walk;
    const struct filter_cells *cells = walker->cells;
    const int away = away_of(walk, k, x, y);
    if (away > walk->reach_px || walker->list->out_of_memory)
        return;
    if (k == 0) {
        struct filter_node node;
        if (filter_cell_of_pixel(walker->filter, x, y, &node))
            (void)node_add(walker->list, &node, k, x, y);
        return;
    }
    const struct filter_cell *cell = cell_at(cells, k, x, y);
    if (cell->pixels == 0)
        return;
    const bool large = 1 << k > walk->finest && (float)(1 << k) > (float)away * walk->size;
    if (large || is_spread(walk, view_of(walk, cell, 0)) || is_spread(walk, view_of(walk, cell, 1))) {
        for (int v = 2 * y; v < 2 * y + 2 && v < cells->height[k - 1]; v++)
            for (int u = 2 * x; u < 2 * x + 2 && u < cells->width[k - 1]; u++)
                pool_walk(walker, k - 1, u, v);
        return;
    }
    for (int i = 0; i < 2; i++)
        if (cell->layer[i].solid > 0)
            (void)node_add(walker->list, &cell->layer[i], k, x, y);
}

void filter_walk_pool(const struct filter *filter, const struct filter_cells *cells, const struct filter_walk *walk,
                      struct filter_nodes *nodes)
{
    const int top = CELL_LEVELS - 1;
    const struct walker walker = {.filter = filter, .cells = cells, .walk = walk, .list = nodes};
    nodes->count = 0;
    for (int y = 0; y < cells->height[top]; y++)
        for (int x = 0; x < cells->width[top]; x++)
            pool_walk(&walker, top, x, y);
}

void filter_nodes_free(struct filter_nodes *nodes)
{
    free(nodes->nodes);
    free(nodes->hidden);
}
