/* The fast filter: sums at some pixels, from some taps, and interpolation where it is good enough.
 *
 * First every 16th pixel of every 16th row is summed. Then the pixels halfway between two are looked at, row by row and
 * column by column in turn, until none is left. A pixel is interpolated where its own direction and position are what
 * interpolation gives, and where beside it a pixel was summed that interpolation had met within the tolerance. The
 * first pixels are summed both by all taps and by rings of ever larger cells of them, and the quickest rings that come
 * within the tolerance serve for the pixels between.
 */
#include "filter_sparse.h"

#include "bands.h"
#include "filter_cells.h"
#include "interrupt.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum {
    FIRST_SHIFT = 4, /* log2 of the first rows' and columns' distance */
    CELL_SIZES = 7,
    REACHES = 5
};

/* Where rings of one cell size end, see filter_level_blur(), from the quickest to all pixels by themselves. */
static const int reaches[REACHES] = {8, 16, 32, 64, 0};

/* UNSURE: summed, and nothing to compare it with. SURE: interpolation was within the tolerance of it. ROUGH: it
 * wasn't. */
enum state { NONE, UNSURE, SURE, ROUGH };

/* What is known of a pixel. */
struct known {
    unsigned char state, reach; /* an index of reaches[] that is good enough here */
};

struct sparse {
    struct filter_level *level;
    struct filter_view view;
    struct known *known;
    bool measures;           /* in this pass the reaches are chosen, else they are the neighbours' */
    int column, column_step; /* first of the columns that are looked at, and from one to the next */
    int row, row_step;
    int dx, dy;              /* to the neighbours halfway between which these pixels are */
    double tolerance;
    double guide;            /* how far an interpolated direction or position may be off, */
    double near;             /* a neighbour's, whose result is taken as it is, */
    double spacing;          /* and two neighbours from each other: in widths of the lobe, 1 / sqrt(p) */
    atomic_bool out_of_memory;
};

/* A pixel's result, and what the result depends on. */
struct point {
    double glossy[3], confidence;
    double direction[3], a[3], nearness; /* 1 / distance of b, 0 for a direction */
    double radius;
};

/* NULL outside the picture. */
static struct known *known_at(const struct sparse *sparse, int x, int y)
{
    const struct filter_taps *taps = &sparse->level->taps;
    if (x < 0 || y < 0 || x >= taps->width || y >= taps->height)
        return NULL;
    return &sparse->known[(size_t)y * (size_t)taps->width + (size_t)x];
}

static void point_place(const struct filter_level *level, int x, int y, struct point *point)
{
    float a[3];
    filter_level_position(level, x, y, a);
    double distance = filter_level_direction(level, a, x, y, point->direction);
    for (int i = 0; i < 3; i++)
        point->a[i] = (double)a[i];
    point->radius = (double)image_row(&level->radius, 0, y)[x];
    point->nearness = *filter_level_tap(level, FILTER_PLANE_W, x, y) > 0 ? 1 / distance : 0;
}

/* Whether two pixels' windows count and differ: the paper's always count, the best filter's where the lobe isn't
 * all seen. */
static bool windows_differ(const struct sparse *sparse, const struct point *own, const struct point *point)
{
    const double difference = 0.05, unseen = 0.03;
    const bool paper = sparse->level->shared->options->mode == FILTER_MODE_PAPER;
    return (paper || point->confidence < 1 - unseen) &&
           fabs(point->radius - own->radius) > difference * fmax(own->radius, point->radius);
}

/* A pixel whose result is known and may stand for one of the exponent `phong`. */
static bool point_read(const struct sparse *sparse, int x, int y, double phong, struct point *point)
{
    const struct filter_level *level = sparse->level;
    const struct known *known = known_at(sparse, x, y);
    if (!known || known->state == NONE || filter_level_phong(level, x, y) != phong)
        return false;
    point_place(level, x, y, point);
    for (int i = 0; i < 3; i++)
        point->glossy[i] = (double)image_row(&level->glossy, i, y)[x];
    point->confidence = (double)image_row(&level->confidence, 0, y)[x];
    return true;
}

static void point_add(struct point *sum, double weight, const struct point *point)
{
    for (int i = 0; i < 3; i++) {
        sum->glossy[i] += weight * point->glossy[i];
        sum->direction[i] += weight * point->direction[i];
        sum->a[i] += weight * point->a[i];
    }
    sum->confidence += weight * point->confidence;
    sum->nearness = fmax(sum->nearness, point->nearness);
}

/* Square of how far apart two points' lobes are, in widths of the lobe; infinite for a mirror. */
static double apart(const struct point *p, const struct point *q, double phong)
{
    double turn = 0, move = 0, nearness = fmax(p->nearness, q->nearness);
    for (int i = 0; i < 3; i++) {
        turn += (p->direction[i] - q->direction[i]) * (p->direction[i] - q->direction[i]);
        move += (p->a[i] - q->a[i]) * (p->a[i] - q->a[i]);
    }
    double square = (turn + (move > 0 ? move * nearness * nearness : 0)) * phong;
    return phong < FILTER_MIRROR_PHONG && square >= 0 ? square : INFINITY;
}

/* Cubic through four pixels on the axis, or a straight line through two. */
static bool interpolate(const struct sparse *sparse, int x, int y, double phong, const struct point *own,
                        struct point *found)
{
    const int dx = sparse->dx, dy = sparse->dy;
    struct point near[2], far[2];
    if (!point_read(sparse, x - dx, y - dy, phong, &near[0]) || !point_read(sparse, x + dx, y + dy, phong, &near[1]) ||
        apart(&near[0], &near[1], phong) > sparse->spacing * sparse->spacing ||
        windows_differ(sparse, own, &near[0]) || windows_differ(sparse, own, &near[1]))
        return false;
    if (point_read(sparse, x - 3 * dx, y - 3 * dy, phong, &far[0]) &&
        point_read(sparse, x + 3 * dx, y + 3 * dy, phong, &far[1]) && !windows_differ(sparse, own, &far[0]) &&
        !windows_differ(sparse, own, &far[1])) {
        *found = (struct point){.nearness = 0};
        for (int i = 0; i < 2; i++) {
            point_add(found, 9.0 / 16, &near[i]);
            point_add(found, -1.0 / 16, &far[i]);
        }
        if (apart(found, own, phong) <= sparse->guide * sparse->guide)
            return true;
    }
    *found = (struct point){.nearness = 0};
    for (int i = 0; i < 2; i++)
        point_add(found, 0.5, &near[i]);
    return apart(found, own, phong) <= sparse->guide * sparse->guide;
}

/* Mean of the known neighbours whose lobes are next to the pixel's own. */
static bool copy(const struct sparse *sparse, int x, int y, double phong, const struct point *own, struct point *found)
{
    const int across[2] = {sparse->dy ? sparse->column_step : 0, sparse->dx ? sparse->row_step : 0};
    struct point sum = {.nearness = 0};
    double weights = 0;
    for (int i = 0; i < 6; i++) {
        int side = i < 3 ? -1 : 1, j = i % 3 - 1;
        struct point point;
        if (!point_read(sparse, x + side * sparse->dx + j * across[0], y + side * sparse->dy + j * across[1], phong,
                        &point))
            continue;
        double square = apart(&point, own, phong);
        if (square > sparse->near * sparse->near || windows_differ(sparse, own, &point))
            continue;
        double weight = 1 / (square + 1e-6);
        point_add(&sum, weight, &point);
        weights += weight;
    }
    *found = (struct point){.nearness = 0};
    if (weights > 0)
        point_add(found, 1 / weights, &sum);
    return weights > 0;
}

/* One pixel of a run. */
struct look {
    bool wanted, needed; /* glossy; to be summed */
    bool guessed;        /* `guess` is what its neighbours give */
    struct point guess;
    int reach;
};

static void look_at(const struct sparse *sparse, int x, int y, struct look *look)
{
    const struct filter_level *level = sparse->level;
    look->wanted = x < level->taps.width && filter_level_phong(level, x, y) >= 0 &&
                   filter_level_needs(level, x, x, y);
    look->guessed = look->needed = false;
    look->reach = -1;
    if (!look->wanted)
        return;
    double phong = filter_level_phong(level, x, y);
    const struct known *sides[2] = {known_at(sparse, x - sparse->dx, y - sparse->dy),
                                    known_at(sparse, x + sparse->dx, y + sparse->dy)};
    for (int i = 0; i < 2; i++)
        if (sides[i] && sides[i]->state != NONE && sides[i]->reach > look->reach)
            look->reach = sides[i]->reach;
    if (look->reach < 0)
        look->reach = REACHES - 1;
    struct point own;
    point_place(level, x, y, &own);
    if (interpolate(sparse, x, y, phong, &own, &look->guess)) {
        look->guessed = true;
        look->needed = sides[0]->state == ROUGH || sides[1]->state == ROUGH ||
                       (sides[0]->state == UNSURE && sides[1]->state == UNSURE);
    } else {
        look->guessed = copy(sparse, x, y, phong, &own, &look->guess);
        look->needed = !look->guessed;
    }
}

/* Of the largest channel, above 1 relative. */
static double difference(const struct filter_level *level, int x, int y, const double other[3])
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        double value = (double)image_row(&level->glossy, i, y)[x];
        most = fmax(most, fabs(other[i] - value) / fmax(1, fabs(value)));
    }
    return most;
}

/* Sums a run with every reach, the last of which is right, and chooses for each pixel the quickest that is good
 * enough. */
static void run_measure(struct sparse *sparse, int x, int y, struct look *looks, float *scratch)
{
    struct filter_level *level = sparse->level;
    double found[REACHES][FILTER_LANES][3];
    for (int r = 0; r < REACHES; r++) {
        filter_level_blur(level, &sparse->view, reaches[r], x, y, scratch);
        for (int l = 0; l < FILTER_LANES; l++)
            for (int i = 0; i < 3 && looks[l].wanted; i++)
                found[r][l][i] = (double)image_row(&level->glossy, i, y)[x + l * sparse->column_step];
    }
    for (int l = 0; l < FILTER_LANES; l++) {
        int u = x + l * sparse->column_step, r = REACHES - 1;
        while (looks[l].wanted && r > 0 && difference(level, u, y, found[r - 1][l]) <= sparse->tolerance)
            r--;
        looks[l].reach = r;
    }
}

static void run_sum(struct sparse *sparse, int x, int y, struct look *looks, float *scratch)
{
    int reach = 0;
    for (int l = 0; l < FILTER_LANES; l++)
        if (looks[l].needed && looks[l].reach > reach)
            reach = looks[l].reach;
    if (sparse->measures)
        run_measure(sparse, x, y, looks, scratch);
    else
        filter_level_blur(sparse->level, &sparse->view, reaches[reach], x, y, scratch);
}

/* 16 pixels of a row: where one must be summed all are. */
static void run(struct sparse *sparse, int x, int y, float *scratch)
{
    struct filter_level *level = sparse->level;
    struct look looks[FILTER_LANES];
    bool needed = false;
    for (int l = 0; l < FILTER_LANES; l++) {
        look_at(sparse, x + l * sparse->column_step, y, &looks[l]);
        needed = needed || looks[l].needed;
    }
    if (needed)
        run_sum(sparse, x, y, looks, scratch);
    for (int l = 0; l < FILTER_LANES; l++) {
        const struct look *look = &looks[l];
        const int u = x + l * sparse->column_step;
        if (!look->wanted)
            continue;
        enum state state = SURE;
        if (needed && !look->guessed)
            state = UNSURE;
        else if (needed && difference(level, u, y, look->guess.glossy) > sparse->tolerance)
            state = ROUGH;
        for (int i = 0; i < 3 && !needed; i++)
            image_row(&level->glossy, i, y)[u] = (float)look->guess.glossy[i];
        if (!needed)
            image_row(&level->confidence, 0, y)[u] = (float)look->guess.confidence;
        *known_at(sparse, u, y) = (struct known){(unsigned char)state, (unsigned char)look->reach};
    }
}

static void run_rows(void *context, int first, int end)
{
    struct sparse *sparse = context;
    float *scratch = aligned_alloc(64, filter_level_scratch(&sparse->view) * sizeof *scratch);
    if (!scratch) {
        atomic_store(&sparse->out_of_memory, true);
        return;
    }
    const int width = sparse->level->taps.width, step = FILTER_LANES * sparse->column_step;
    for (int row = first; row < end; row++)
        for (int x = sparse->column; x < width && !interrupt_signal(); x += step)
            run(sparse, x, sparse->row + row * sparse->row_step, scratch);
    free(scratch);
}

static enum result pass(struct sparse *sparse, struct error *err)
{
    const int left = sparse->level->taps.height - sparse->row;
    if (left <= 0)
        return RESULT_OK;
    enum result result = bands_run((left + sparse->row_step - 1) / sparse->row_step, 1,
                                   sparse->level->shared->options->threads, run_rows, sparse, err);
    if (result == RESULT_OK && atomic_load(&sparse->out_of_memory))
        result = error_memory(err, (double)(filter_level_scratch(&sparse->view) * sizeof(float)));
    return result;
}

/* The rows between those looked at, or, for the first time, these; then the columns between. */
static enum result passes(struct sparse *sparse, int shift, struct error *err)
{
    const int step = 1 << shift;
    const bool begins = shift == FIRST_SHIFT;
    sparse->measures = begins;
    sparse->column = 0;
    sparse->column_step = step;
    sparse->row = begins ? 0 : step;
    sparse->row_step = begins ? step : 2 * step;
    sparse->dx = 0;
    sparse->dy = step;
    enum result result = pass(sparse, err);
    if (result != RESULT_OK || shift == 0)
        return result;
    sparse->measures = begins;
    sparse->column = step / 2;
    sparse->row = 0;
    sparse->row_step = step;
    sparse->dx = step / 2;
    sparse->dy = 0;
    return pass(sparse, err);
}

enum result filter_sparse(struct filter_level *level, double tolerance, struct error *err)
{
    const size_t pixels = (size_t)level->taps.width * (size_t)level->taps.height;
    struct sparse sparse = {.level = level,
                            .tolerance = tolerance,
                            .guide = fmin(30 * tolerance, 0.1),
                            .near = fmin(10 * tolerance, 0.05),
                            .spacing = 2,
                            .known = calloc(pixels, sizeof *sparse.known)};
    if (!sparse.known)
        return error_memory(err, (double)(pixels * sizeof *sparse.known));
    enum result result = RESULT_OK;
    for (int shift = FIRST_SHIFT; shift >= 0 && result == RESULT_OK; shift--) {
        result = filter_cells_view(level, shift, CELL_SIZES, &sparse.view, err);
        if (result == RESULT_OK)
            result = passes(&sparse, shift, err);
        filter_cells_view_free(&sparse.view);
    }
    free(sparse.known);
    return result;
}
