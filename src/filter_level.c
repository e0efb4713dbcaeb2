/* The filter at one resolution: the stages around the sums of filter_kernel.c.
 *
 * The passes as planes of taps, and for the best filter the area of each; the radius of every pixel (equations (4) and
 * (5), or the gradient of the direction field); the sums, ring by ring where there are coarser levels.
 */
#include "filter_level.h"

#include "lobe.h"
#include "weights.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const int neighbours[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

static const double pi = 3.14159265358979324;

/* In units of the taps, whose farthest position is at 2^20: 1e-15 of that. */
static const double least_distance = 1e-9;

/* How many times larger tan^2(theta) is of what hides an endpoint: 10 % of the angle are left to the digits of the
 * positions and to bumps. */
static const float hidden_ratio = 1.21f;

/* See help_needed(); so little that it isn't worth its time is taken off. */
static const double pool_pixels = 16, pool_share_least = 1.0 / 64, missing_share = 0.5, missing_least = 0.02;

/* The exponent of a glossy pixel of the passes. */
static double passes_phong(const struct filter_shared *filter, int x, int y)
{
    const struct image *phong = &filter->gbuffer->phong;
    bool own = phong->pixels && !filter->options->phong_override;
    return (double)(own ? image_row(phong, 0, y)[x] : filter->options->phong);
}

/* The pixel as a tap: a, b with W = 1 or a unit direction with W = 0, and L0. False: not glossy. */
struct sample {
    double a[3], b[4], radiance[3];
};

static bool sample_read(const struct gbuffer *gbuffer, int x, int y, struct sample *sample)
{
    if (!gbuffer_is_glossy(gbuffer, x, y))
        return false;
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        sum += sample->a[i] = (double)image_row(&gbuffer->position, i, y)[x];
        sum += sample->b[i] = (double)image_row(&gbuffer->endpoint, i, y)[x];
        sum += sample->radiance[i] = (double)image_row(&gbuffer->specular, i, y)[x];
    }
    double w = (double)image_row(&gbuffer->endpoint, 3, y)[x];
    if (!isfinite(sum + w) || w < 0)
        return false;
    double length = sqrt(sample->b[0] * sample->b[0] + sample->b[1] * sample->b[1] + sample->b[2] * sample->b[2]);
    for (int i = 0; i < 3; i++)
        sample->b[i] /= w > 0 ? w : length;
    sample->b[3] = w > 0;
    return true;
}

long filter_left_out(const struct gbuffer *gbuffer)
{
    long count = 0;
    for (int y = 0; y < gbuffer->specular.height; y++)
        for (int x = 0; x < gbuffer->specular.width; x++) {
            struct sample sample;
            bool meant = false;
            for (int i = 0; i < 4; i++)
                meant = meant || image_row(&gbuffer->endpoint, i, y)[x] != 0; /* also NaN */
            if (gbuffer->phong.pixels)
                meant = meant && image_row(&gbuffer->phong, 0, y)[x] != 0;
            count += meant && !sample_read(gbuffer, x, y, &sample);
        }
    return count;
}

void filter_level_scales(struct filter_shared *filter)
{
    double coordinate = 0, radiance = 0;
    for (int y = 0; y < filter->gbuffer->specular.height; y++)
        for (int x = 0; x < filter->gbuffer->specular.width; x++) {
            struct sample sample;
            if (!sample_read(filter->gbuffer, x, y, &sample))
                continue;
            for (int i = 0; i < 3; i++) {
                coordinate = fmax(coordinate, fabs(sample.a[i]));
                radiance = fmax(radiance, fabs(sample.radiance[i]));
            }
        }
    filter->length_scale = coordinate > 0 ? ldexp(1, 20 - ilogb(coordinate)) : 1;
    const bool extreme = radiance > 0x1p100 || (radiance > 0 && radiance < 0x1p-20);
    filter->radiance_scale = extreme ? ldexp(1, -ilogb(radiance)) : 1;
}

static float *own_at(const struct filter_level *level, int i, int y)
{
    return level->own[i] + (size_t)y * level->taps.stride;
}

static const struct filter_box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void box_add(struct filter_box *box, const float point[3])
{
    for (int i = 0; i < 3; i++) {
        box->low[i] = fminf(box->low[i], point[i]);
        box->high[i] = fmaxf(box->high[i], point[i]);
    }
}

void filter_taps_blocks(struct filter_taps *taps, int first, int end)
{
    const size_t phase = taps->stride >> taps->shift, blocks = phase / FILTER_LANES;
    for (int y = first; y < end; y++)
        for (size_t block = 0; block < blocks; block++) {
            struct filter_box box = empty_box;
            unsigned char kinds = 0;
            for (size_t i = 0; i < (size_t)FILTER_LANES << taps->shift; i++) {
                size_t column = i / FILTER_LANES * phase + block * FILTER_LANES + i % FILTER_LANES;
                size_t tap = (size_t)y * taps->stride + column;
                if (!(taps->planes[FILTER_PLANE_GAIN][tap] > 0))
                    continue;
                bool position = taps->planes[FILTER_PLANE_W][tap] > 0;
                kinds |= position ? FILTER_KIND_POSITION : FILTER_KIND_DIRECTION;
                if (position)
                    box_add(&box, (const float[3]){taps->planes[FILTER_PLANE_X][tap], taps->planes[FILTER_PLANE_Y][tap],
                                                   taps->planes[FILTER_PLANE_Z][tap]});
            }
            taps->boxes[(size_t)y * blocks + block] = box;
            taps->kinds[(size_t)y * blocks + block] = kinds;
        }
}

void filter_level_taps(void *context, int first, int end)
{
    struct filter_level *level = context;
    const struct filter_taps *taps = &level->taps;
    size_t plane = taps->stride * (size_t)taps->height;
    const bool max = level->shared->options->formula == FILTER_FORMULA_MAX;
    const float gain = (float)(max ? lobe_weight_max(1, 1, 1) : lobe_weight(1, 1));
    for (int y = first; y < end; y++)
        for (int x = 0; x < taps->width; x++) {
            struct sample sample;
            if (!sample_read(level->shared->gbuffer, x, y, &sample))
                continue;
            double b[4], largest = 0;
            memcpy(b, sample.b, sizeof b);
            for (int i = 0; i < 3 && b[3] > 0; i++) {
                b[i] *= level->shared->length_scale;
                largest = fmax(largest, fabs(b[i]));
            }
            /* So far away is a direction, the same from everywhere; its square would leave the range of a float. */
            if (largest > 0x1p60) {
                double length = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
                for (int i = 0; i < 3; i++)
                    b[i] /= length;
                b[3] = 0;
            }
            float *tap = level->taps.planes[0] + (size_t)y * taps->stride + (size_t)x + FILTER_BORDER;
            for (int i = 0; i < 4; i++)
                tap[(size_t)(FILTER_PLANE_X + i) * plane] = (float)b[i];
            tap[FILTER_PLANE_GAIN * plane] = gain;
            for (int i = 0; i < 3; i++)
                tap[(size_t)(FILTER_PLANE_R + i) * plane] = (float)(sample.radiance[i] * level->shared->radiance_scale);
            for (int i = 0; i < 3; i++)
                own_at(level, i, y)[x] = (float)(sample.a[i] * level->shared->length_scale);
            own_at(level, 3, y)[x] = (float)passes_phong(level->shared, x, y);
        }
    filter_taps_blocks(&level->taps, first, end);
}

double filter_level_phong(const struct filter_level *level, int x, int y)
{
    return (double)own_at(level, 3, y)[x];
}

const float *filter_level_tap(const struct filter_level *level, enum filter_plane plane, int x, int y)
{
    return level->taps.planes[plane] + (size_t)y * level->taps.stride + (size_t)x + FILTER_BORDER;
}

bool filter_level_is_tap(const struct filter_level *level, int x, int y)
{
    return *filter_level_tap(level, FILTER_PLANE_GAIN, x, y) > 0;
}

void filter_level_position(const struct filter_level *level, int x, int y, float a[3])
{
    for (int i = 0; i < 3; i++)
        a[i] = own_at(level, i, y)[x];
}

/* Unit direction from a to the tap's b, and its distance (1 for W = 0); a distance of 0 leaves the direction 0. */
double filter_level_direction(const struct filter_level *level, const float a[3], int x, int y, double direction[3])
{
    double w = (double)*filter_level_tap(level, FILTER_PLANE_W, x, y), square = 0;
    for (int i = 0; i < 3; i++) {
        direction[i] = (double)*filter_level_tap(level, FILTER_PLANE_X + (unsigned)i, x, y) - w * (double)a[i];
        square += direction[i] * direction[i];
    }
    double distance = sqrt(square);
    for (int i = 0; i < 3 && distance > 0; i++)
        direction[i] /= distance;
    return distance;
}

static bool is_inside(const struct filter_level *level, int x, int y)
{
    return x >= 0 && y >= 0 && x < level->taps.width && y < level->taps.height;
}

/* Change of the direction from (x, y)'s a to the endpoints from that of (x, y) to that of a neighbour, before and after
 * it on one axis: the smaller of the two, for the larger may leap to another thing. Its length; infinite where neither
 * neighbour is glossy. */
static double direction_step(const struct filter_level *level, const float a[3], int x, int y, int right, int down,
                             double step[3])
{
    double own[3], least = INFINITY;
    filter_level_direction(level, a, x, y, own);
    for (int sign = -1; sign <= 1; sign += 2) {
        int u = x + sign * right, v = y + sign * down;
        double other[3], square = 0;
        if (!is_inside(level, u, v) || !filter_level_is_tap(level, u, v) ||
            filter_level_direction(level, a, u, v, other) == 0)
            continue;
        for (int i = 0; i < 3; i++) {
            other[i] = sign * (other[i] - own[i]);
            square += other[i] * other[i];
        }
        if (square >= least)
            continue;
        least = square;
        memcpy(step, other, sizeof other);
    }
    return sqrt(least);
}

/* Area across the ray that a glossy pixel stands for at its endpoint; for a direction its solid angle. Without
 * neighbours on one axis it is a square, without any it is next to nothing. */
static double area_at(const struct filter_level *level, int x, int y)
{
    const double least = 1e-12;
    float a[3];
    double own[3], across[3] = {0}, down[3] = {0}, solid;
    filter_level_position(level, x, y, a);
    double distance = filter_level_direction(level, a, x, y, own);
    double width = direction_step(level, a, x, y, 1, 0, across), height = direction_step(level, a, x, y, 0, 1, down);
    if (level->shared->options->without & FILTER_WITHOUT_DENSITY) {
        solid = 1e-6;
    } else if (isinf(width) || isinf(height)) {
        double side = fmin(width, height);
        solid = isinf(side) ? 0 : side * side;
    } else {
        double normal[3] = {across[1] * down[2] - across[2] * down[1], across[2] * down[0] - across[0] * down[2],
                            across[0] * down[1] - across[1] * down[0]};
        solid = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    }
    return fmax(solid, least) * distance * distance;
}

void filter_level_areas(void *context, int first, int end)
{
    struct filter_level *level = context;
    const struct filter_taps *taps = &level->taps;
    float *areas = level->taps.planes[0] + FILTER_PLANE_AREA * taps->stride * (size_t)taps->height;
    for (int y = first; y < end; y++)
        for (int x = 0; x < taps->width; x++)
            if (filter_level_is_tap(level, x, y))
                areas[(size_t)y * taps->stride + (size_t)x + FILTER_BORDER] = (float)fmax(area_at(level, x, y), 1e-30);
}

/* Pixels in which the direction to the endpoint turns by the half-angle, where the camera is not known. */
static double radius_from_gradient(const struct filter_level *level, int x, int y, double half_angle)
{
    float a[3];
    double own[3], step = INFINITY;
    filter_level_position(level, x, y, a);
    if (filter_level_direction(level, a, x, y, own) == 0)
        return 0;
    for (int n = 0; n < 4; n++) {
        int u = x + neighbours[n][0], v = y + neighbours[n][1];
        if (!is_inside(level, u, v) || !filter_level_is_tap(level, u, v))
            continue;
        double other[3], square = 0;
        if (filter_level_direction(level, a, u, v, other) == 0)
            continue;
        for (int i = 0; i < 3; i++)
            square += (other[i] - own[i]) * (other[i] - own[i]);
        step = fmin(step, 2 * asin(fmin(sqrt(square) / 2, 1)));
    }
    return isinf(step) ? 0 : half_angle / step;
}

/* Equations (4) and (5) with the picture's and the user's limit. */
static double radius_at(const struct filter_level *level, int x, int y)
{
    const struct filter_shared *shared = level->shared;
    const struct gbuffer *gbuffer = shared->gbuffer;
    double phong = filter_level_phong(level, x, y), radius;
    if (phong >= FILTER_MIRROR_PHONG)
        return 0;
    double half_angle = lobe_half_angle(phong, shared->energy, shared->options->max_angle_rad);
    if (gbuffer->has_eye && gbuffer->view_angle > 0) {
        float a[3];
        double direction[3], square = 0, distance;
        filter_level_position(level, x, y, a);
        for (int i = 0; i < 3; i++) {
            double to_eye = (double)a[i] - (double)gbuffer->eye[i] * shared->length_scale;
            square += to_eye * to_eye;
        }
        distance = filter_level_direction(level, a, x, y, direction);
        if (*filter_level_tap(level, FILTER_PLANE_W, x, y) == 0)
            distance = INFINITY;
        double alpha = lobe_alpha(half_angle, sqrt(square), distance);
        radius = lobe_radius_px(alpha, gbuffer->specular.width, (double)gbuffer->view_angle);
    } else {
        radius = radius_from_gradient(level, x, y, half_angle);
    }
    return fmin(radius, shared->radius_limit_px);
}

/* Between the pixels of the coarse grid that are glossy with the same exponent; NaN where none is. */
static double radius_interpolate(const struct filter_level *level, int x, int y)
{
    int step = level->shared->options->radius_step, left = x / step * step, top = y / step * step;
    double sum = 0, weights = 0, phong = filter_level_phong(level, x, y);
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            int u = left + i * step, v = top + j * step;
            double weight = (1 - abs(x - u) / (double)step) * (1 - abs(y - v) / (double)step);
            if (weight == 0 || u >= level->taps.width || v >= level->taps.height || filter_level_phong(level, u, v) < 0)
                continue;
            if (filter_level_phong(level, u, v) != phong)
                continue;
            sum += weight * (double)image_row(&level->radius, 0, v)[u];
            weights += weight;
        }
    return sum / weights;
}

void filter_level_radius_coarse(void *context, int first, int end)
{
    struct filter_level *level = context;
    int step = level->shared->options->radius_step;
    for (int row = first; row < end; row++)
        for (int x = 0; x < level->taps.width; x += step)
            if (filter_level_phong(level, x, row * step) >= 0)
                image_row(&level->radius, 0, row * step)[x] = (float)radius_at(level, x, row * step);
}

void filter_level_radius_fine(void *context, int first, int end)
{
    struct filter_level *level = context;
    int step = level->shared->options->radius_step;
    for (int y = first; y < end; y++)
        for (int x = 0; x < level->taps.width; x++) {
            if ((x % step == 0 && y % step == 0) || filter_level_phong(level, x, y) < 0)
                continue;
            double radius = radius_interpolate(level, x, y);
            image_row(&level->radius, 0, y)[x] = (float)(isnan(radius) ? radius_at(level, x, y) : radius);
        }
}

/* cos^p = (1 + t)^(-p/2), t = tan^2(theta), as the kernel wants it. */
static double slope_of(enum filter_shape shape, double phong)
{
    switch (shape) {
    case FILTER_SHAPE_TABLE:
        return phong / 2 * log(2) * WEIGHTS_TABLE_STEPS;
    case FILTER_SHAPE_GAUSS:
        return phong / 2 / log(2);
    case FILTER_SHAPE_SOLID:
    case FILTER_SHAPE_POWER:
        break;
    }
    return phong / 2;
}

/* Fills lane l with pixel (x, y). False: nothing to sum, the result is L0. */
static bool lane_fill(const struct filter_level *level, int x, int y, int l, struct filter_lanes *lanes)
{
    float a[3];
    double direction[3], phong = filter_level_phong(level, x, y);
    filter_level_position(level, x, y, a);
    double distance = filter_level_direction(level, a, x, y, direction);
    bool one_tap = level->shared->options->mode == FILTER_MODE_PAPER && image_row(&level->radius, 0, y)[x] < 1;
    if (phong >= FILTER_MIRROR_PHONG || distance < least_distance || one_tap)
        return false;
    for (int i = 0; i < 3; i++) {
        lanes->a[i][l] = a[i];
        lanes->direction[i][l] = (float)direction[i];
    }
    for (int i = 0; i < 4; i++)
        lanes->b[i][l] = *filter_level_tap(level, FILTER_PLANE_X + (unsigned)i, x, y);
    lanes->distance[l] = (float)distance;
    lanes->kinds |= lanes->b[3][l] > 0 ? FILTER_KIND_POSITION : FILTER_KIND_DIRECTION;
    if (lanes->b[3][l] > 0)
        lanes->farthest = fmaxf(lanes->farthest, lanes->distance[l]);
    box_add(&lanes->box, a);
    lanes->slope[l] = (float)slope_of(level->taps.shape, phong);
    lanes->narrow = lanes->narrow && lanes->slope[l] >= FILTER_NARROW_SLOPE;
    return true;
}

static const struct filter_ring whole = {.step = 1, .inner = -1, .outer = INT_MAX, .first = -INT_MAX, .last = INT_MAX};

/* The lanes' pixels from column x of row y on; used[l]: there is something to sum for lane l. */
static bool lanes_fill(const struct filter_level *level, int x, int y, int step, struct filter_lanes *lanes,
                       bool used[FILTER_LANES])
{
    bool any = false;
    *lanes = (struct filter_lanes){.x = x, .y = y, .narrow = true, .box = empty_box, .ring = whole};
    for (int l = 0; l < FILTER_LANES; l++) {
        lanes->limit[l] = lanes->blind[l] = -1;
        int u = x + l * step;
        used[l] = u < level->taps.width && filter_level_phong(level, u, y) >= 0 && lane_fill(level, u, y, l, lanes);
        any = any || used[l];
    }
    return any;
}

/* Writes one pixel's sums; without weights L0 itself. */
static void pixel_write(struct filter_level *level, int x, int y, const double colour[3], double weights)
{
    for (int i = 0; i < 3; i++) {
        double value = weights > 0 ? colour[i] / weights / level->shared->radiance_scale
                                   : (double)image_row(&level->shared->gbuffer->specular, i, y)[x];
        image_row(&level->glossy, i, y)[x] = (float)fmax(-FLT_MAX, fmin(value, FLT_MAX));
    }
}

/* Square of the least angle by which the mirror direction turns from a pixel to a neighbour: the farther away things
 * are, the nearer the angle between their endpoints comes to it. With a margin, for it changes over the picture. */
static double gradient_least(const struct filter_level *level, int x, int y)
{
    const double margin = 1.5;
    double own[3], least = INFINITY;
    float a[3];
    filter_level_position(level, x, y, a);
    filter_level_direction(level, a, x, y, own);
    for (int n = 0; n < 4; n++) {
        int u = x + neighbours[n][0], v = y + neighbours[n][1];
        double other[3], square = 0;
        if (!is_inside(level, u, v) || !filter_level_is_tap(level, u, v))
            continue;
        filter_level_position(level, u, v, a);
        filter_level_direction(level, a, u, v, other);
        for (int i = 0; i < 3; i++)
            square += (other[i] - own[i]) * (other[i] - own[i]);
        least = fmin(least, square);
    }
    return isinf(least) ? 0 : least / (margin * margin);
}

/* tan^2(theta) at which nothing is left of the lobe: where cos^p is the floor, or the user's limit. */
static double lobe_reach(const struct filter_level *level, double phong)
{
    const double ninety_degrees = 0x1p99;
    double limit = tan(level->shared->options->max_angle_rad), reach = pow(level->shared->floor, -2 / phong) - 1;
    return fmin(fmin(reach, level->shared->options->max_angle_rad < pi / 2 ? limit * limit : INFINITY), ninety_degrees);
}

/* What the sums over all endpoints about a pixel, seen from its a or not, count beside the sums over what is seen. */
struct help {
    double share;   /* factor of these sums */
    double missing; /* their weights come to this many steradians besides */
};

/* A lobe that is narrow for the mirror's curvature holds few pixels, and chance errs more there than what should be
 * hidden: share = (pool_pixels / pixels in the lobe)^2, less a little. And half of what no seen pixel covers is taken
 * from the others. */
static struct help help_needed(const struct filter_level *level, const struct filter_lanes *lanes, int x, int y, int l,
                               double seen)
{
    double phong = filter_level_phong(level, x, y), distance = (double)lanes->distance[l];
    double area = (double)*filter_level_tap(level, FILTER_PLANE_AREA, x, y);
    double pixels = lobe_integral(phong, 0) / (area / (distance * distance + area / (2 * pi)));
    double lobe = lobe_integral(phong, level->shared->floor);
    double few = pool_pixels / pixels;
    struct help help = {.share = fmax(few * few - pool_share_least, 0),
                        .missing = missing_share * fmax((1 - missing_least) * lobe - seen, 0)};
    if (level->shared->options->without & FILTER_WITHOUT_POOL || image_row(&level->radius, 0, y)[x] < 1)
        return (struct help){0};
    return help;
}


/* The lanes among the n-th cells, of 2^n x 2^n pixels. */
static void ring_choose(const struct filter_view *view, int inner, const struct filter_shared *shared, int x, int y,
                        int n, struct filter_lanes *lanes)
{
    struct filter_ring *ring = &lanes->ring;
    const bool last = n == view->cells - 1 || inner == 0;
    const int odd = (y >> n) & 1;
    lanes->x = x >> (n < view->shift ? n : view->shift);
    lanes->y = y >> n;
    lanes->limit_px = (int)(shared->radius_limit_px / (1 << n));
    ring->step = n > view->shift ? 1 << (n - view->shift) : 1;
    ring->inner = n > 0 ? inner : -1;
    ring->outer = last ? INT_MAX : 2 * inner + 1;
    ring->first = last ? -INT_MAX : -2 * inner - odd;
    ring->last = last ? INT_MAX : 2 * inner + 1 - odd;
    for (int l = 0; l < FILTER_LANES; l++)
        ring->odd[l] = (x + (l << view->shift)) >> n & 1;
}

static void sums_add(struct filter_sums *sums, const struct filter_sums *more)
{
    for (int i = 0; i < 4; i++)
        for (int l = 0; l < FILTER_LANES; l++)
            sums->value[i][l] += more->value[i][l];
}

/* Sums over the windows of the lanes; radii in pixels, below 0 for none. */
static void sum_windows(const struct filter_level *level, const struct filter_view *view, int inner,
                        struct filter_lanes *lanes, int x, int y, const float radii[FILTER_LANES],
                        struct filter_sums *sums)
{
    float largest = -1;
    memset(sums, 0, sizeof *sums);
    for (int l = 0; l < FILTER_LANES; l++)
        largest = fmaxf(largest, radii[l]);
    for (int n = 0; n < view->cells; n++) {
        struct filter_sums part;
        const float size = (float)(1 << n);
        ring_choose(view, inner, level->shared, x, y, n, lanes);
        for (int l = 0; l < FILTER_LANES; l++)
            lanes->limit[l] = radii[l] < 0 ? -1 : radii[l] / size * (radii[l] / size);
        level->shared->kernel(&view->taps[n], lanes, &part);
        sums_add(sums, &part);
        if (largest < (float)(2 * inner) * size || inner == 0)
            break;
    }
}

static void sum_seen(const struct filter_level *level, const struct filter_view *view, int inner,
                     struct filter_lanes *lanes, int x, int y, float *scratch, struct filter_sums *sums)
{
    float step[FILTER_LANES];
    memcpy(step, lanes->step, sizeof step);
    memset(sums, 0, sizeof *sums);
    for (int n = 0; n < view->cells; n++) {
        struct filter_sums part;
        ring_choose(view, inner, level->shared, x, y, n, lanes);
        for (int l = 0; l < FILTER_LANES; l++)
            lanes->step[l] = step[l] * (float)(1 << 2 * n);
        bool more = level->shared->see(&view->taps[n], lanes, scratch, &part);
        sums_add(sums, &part);
        if (!more || inner == 0)
            break;
    }
    memcpy(lanes->step, step, sizeof step);
}

static void blur_paper(struct filter_level *level, const struct filter_view *view, int inner, int x, int y)
{
    const int step = 1 << view->shift;
    struct filter_lanes lanes;
    struct filter_sums sums = {0};
    float radii[FILTER_LANES];
    bool used[FILTER_LANES], any = lanes_fill(level, x, y, step, &lanes, used);
    for (int l = 0; l < FILTER_LANES; l++)
        radii[l] = used[l] ? image_row(&level->radius, 0, y)[x + l * step] : -1;
    if (any)
        sum_windows(level, view, inner, &lanes, x, y, radii, &sums);
    for (int l = 0; l < FILTER_LANES && x + l * step < level->taps.width; l++)
        if (filter_level_phong(level, x + l * step, y) >= 0)
            pixel_write(level, x + l * step, y, (double[]){sums.value[0][l], sums.value[1][l], sums.value[2][l]},
                        sums.value[3][l]);
}

static void blur_best(struct filter_level *level, const struct filter_view *view, int inner, int x, int y,
                      float *scratch)
{
    const int step = 1 << view->shift;
    const struct filter_shared *shared = level->shared;
    struct filter_lanes lanes;
    struct filter_sums seen = {0}, pool = {0};
    struct help help[FILTER_LANES] = {{0}};
    float radii[FILTER_LANES];
    bool used[FILTER_LANES], steep = lanes_fill(level, x, y, step, &lanes, used), any_help = false, few = false;
    const bool any = steep, narrow = lanes.narrow;
    lanes.floor = (float)shared->floor;
    lanes.hidden = shared->options->without & FILTER_WITHOUT_VISIBILITY ? FLT_MAX : hidden_ratio;
    for (int l = 0; l < FILTER_LANES; l++) {
        if (!used[l])
            continue;
        lanes.reach[l] = (float)lobe_reach(level, filter_level_phong(level, x + l * step, y));
        lanes.blind[l] = fminf(lanes.reach[l] * lanes.hidden, FLT_MAX);
        lanes.step[l] = (float)gradient_least(level, x + l * step, y);
        steep = steep && lanes.reach[l] <= FILTER_NARROW_REACH;
    }
    lanes.narrow = steep;
    if (any)
        sum_seen(level, view, inner, &lanes, x, y, scratch, &seen);
    lanes.narrow = narrow;
    for (int l = 0; l < FILTER_LANES; l++) {
        radii[l] = -1;
        if (used[l])
            help[l] = help_needed(level, &lanes, x + l * step, y, l, seen.value[3][l]);
        if (help[l].share == 0 && help[l].missing == 0)
            continue;
        radii[l] = image_row(&level->radius, 0, y)[x + l * step];
        any_help = true;
        few = few || help[l].share > 0;
    }
    /* What nothing hides may be near, and fill much of the lobe: its cells must be smaller. */
    if (any_help)
        sum_windows(level, view, few ? 0 : 4 * inner, &lanes, x, y, radii, &pool);
    for (int l = 0; l < FILTER_LANES && x + l * step < level->taps.width; l++) {
        double phong = filter_level_phong(level, x + l * step, y);
        if (phong < 0)
            continue;
        double sums[4], share = help[l].share;
        if (help[l].missing > 0 && pool.value[3][l] > 0)
            share += help[l].missing / pool.value[3][l];
        for (int i = 0; i < 4; i++)
            sums[i] = seen.value[i][l] + share * pool.value[i][l];
        pixel_write(level, x + l * step, y, sums, sums[3]);
        double lobe = lobe_integral(phong, shared->floor);
        image_row(&level->confidence, 0, y)[x + l * step] = used[l] ? (float)fmin(seen.value[3][l] / lobe, 1) : 1;
    }
}

bool filter_level_needs(const struct filter_level *level, int first, int last, int y)
{
    const struct image_window *window = &level->shared->gbuffer->window;
    return window->width == 0 || (y >= window->top - FILTER_EDGE_REACH_PX &&
                                  y < window->top + window->height + FILTER_EDGE_REACH_PX &&
                                  last >= window->left - FILTER_EDGE_REACH_PX &&
                                  first < window->left + window->width + FILTER_EDGE_REACH_PX);
}

void filter_level_blur(struct filter_level *level, const struct filter_view *view, int inner, int x, int y,
                       float *scratch)
{
    if (level->shared->options->mode == FILTER_MODE_PAPER)
        blur_paper(level, view, inner, x, y);
    else
        blur_best(level, view, inner, x, y, scratch);
}

size_t filter_level_scratch(const struct filter_view *view)
{
    return FILTER_SEE_COLUMNS(view->taps[0].width, view->shift) * 3 * FILTER_LANES;
}

static enum filter_shape shape_of(enum filter_weights weights)
{
    switch (weights) {
    case FILTER_WEIGHTS_TABLE:
        return FILTER_SHAPE_TABLE;
    case FILTER_WEIGHTS_GAUSS:
        return FILTER_SHAPE_GAUSS;
    case FILTER_WEIGHTS_EXACT:
        break;
    }
    return FILTER_SHAPE_POWER;
}

enum result filter_taps_alloc(struct filter_taps *taps, int width, int height, int shift, struct error *err)
{
    size_t columns = ((size_t)width + (1u << shift) - 1) >> shift;
    size_t phase = (columns + FILTER_LANES - 1) / FILTER_LANES * FILTER_LANES + 2 * FILTER_BORDER;
    size_t stride = phase << shift, plane = stride * (size_t)height, blocks = phase / FILTER_LANES * (size_t)height;
    size_t bytes = plane * FILTER_PLANES * sizeof(float);
    float *planes = aligned_alloc(64, bytes);
    taps->width = width;
    taps->height = height;
    taps->shift = shift;
    taps->stride = stride;
    taps->planes[0] = planes;
    taps->kinds = calloc(blocks, 1);
    taps->boxes = malloc(blocks * sizeof *taps->boxes);
    if (!planes || !taps->kinds || !taps->boxes)
        return error_memory(err, (double)bytes);
    memset(planes, 0, bytes);
    for (int i = 0; i < FILTER_PLANES; i++)
        taps->planes[i] = planes + (size_t)i * plane;
    return RESULT_OK;
}

void filter_taps_free(struct filter_taps *taps)
{
    free(taps->planes[0]);
    free(taps->kinds);
    free(taps->boxes);
}

enum result filter_level_alloc(struct filter_level *level, const struct filter_shared *shared, struct error *err)
{
    const struct filter_options *options = shared->options;
    const int width = shared->gbuffer->specular.width, height = shared->gbuffer->specular.height;
    *level = (struct filter_level){.shared = shared};
    level->taps.square = options->window == FILTER_WINDOW_SQUARE;
    level->taps.shape = options->mode == FILTER_MODE_PAPER ? shape_of(options->weights) : FILTER_SHAPE_SOLID;
    level->taps.table = shared->table;
    enum result result = filter_taps_alloc(&level->taps, width, height, 0, err);
    size_t plane = level->taps.stride * (size_t)height;
    if (result == RESULT_OK && !(level->own[0] = malloc(4 * plane * sizeof(float))))
        result = error_memory(err, (double)(4 * plane * sizeof(float)));
    for (int i = 1; i < 4 && result == RESULT_OK; i++)
        level->own[i] = level->own[0] + (size_t)i * plane;
    for (size_t i = 0; i < plane && result == RESULT_OK; i++)
        level->own[3][i] = -1;
    if (result == RESULT_OK)
        result = image_alloc(&level->radius, width, height, 1, err);
    if (result == RESULT_OK)
        result = image_alloc(&level->confidence, width, height, 1, err);
    if (result == RESULT_OK)
        result = image_alloc(&level->glossy, width, height, 3, err);
    return result;
}

void filter_level_free(struct filter_level *level)
{
    filter_taps_free(&level->taps);
    free(level->own[0]);
    image_free(&level->radius);
    image_free(&level->confidence);
    image_free(&level->glossy);
}
