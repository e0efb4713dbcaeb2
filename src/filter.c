/* Both filters: the stages around the sums of filter_kernel.c.
 *
 * The passes as planes of taps, and for the best filter the area of each; the radius of every pixel (equations (4) and
 * (5), or the gradient of the direction field); the sums; antialiased edges. Each stage is shared out by rows.
 */
#include "filter.h"

#include "bands.h"
#include "control_variate.h"
#include "filter_fast.h"
#include "filter_internal.h"
#include "interrupt.h"
#include "lobe.h"
#include "weights.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* From this exponent on the lobe is narrower than any pixel. */
static const double mirror_phong = 1e20;

static const int neighbours[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

static const double pi = 3.14159265358979324;

/* In units of the taps, whose farthest position is at 2^20: 1e-15 of that. */
static const double least_distance = 1e-9;

/* How many times larger than the lobe's largest tan^2(theta) is that beyond which nothing is seen any more, and the
 * share of that over which what is seen fades out. */
static const double blind_ratio = 1.21, fade_share = 0.7;

/* See lobe_exponent(). */
static const double least_pixels = 0.125;

/* See help_of_pixel(); so little that it isn't worth its time is taken off. */
static const double pool_pixels = 4, pool_share_least = 1.0 / 64, missing_share = 0.5, missing_least = 0.07;

/* See radius_at(), pixels. */
static const double pool_radius = 32;

/* Of fit_plane() and evenness(). */
static const double ridge = 0.3, even_contrast = 3;

struct filter_options filter_options_default(void)
{
    return (struct filter_options){
        .weights = FILTER_WEIGHTS_EXACT,
        .formula = FILTER_FORMULA_PHONG,
        .window = FILTER_WINDOW_ROUND,
        .tolerance = FILTER_TOLERANCE_NORMAL,
        .phong = NAN,
        .energy = 0.99,
        .max_angle_rad = 1.57079632679489662,
        .radius_step = 1,
    };
}

double filter_exponent_at(const struct filter *filter, int x, int y)
{
    const struct image *phong = &filter->gbuffer->phong;
    bool own = phong->pixels && !filter->options->phong_override;
    return (double)(own ? image_row(phong, 0, y)[x] : filter->options->phong);
}

/* The pixel as a tap: a, b with W = 1 or a unit direction with W = 0, and L0. False: not glossy. */
struct sample {
    double a[3], b[4], radiance[3];
};

static bool sample_read(const struct filter *filter, int x, int y, struct sample *sample)
{
    const struct gbuffer *gbuffer = filter->gbuffer;
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
    const struct filter_options options = {0};
    const struct filter filter = {.gbuffer = gbuffer, .options = &options};
    long count = 0;
    for (int y = 0; y < gbuffer->specular.height; y++)
        for (int x = 0; x < gbuffer->specular.width; x++) {
            struct sample sample;
            bool meant = false;
            for (int i = 0; i < 4; i++)
                meant = meant || image_row(&gbuffer->endpoint, i, y)[x] != 0; /* also NaN */
            if (gbuffer->phong.pixels)
                meant = meant && image_row(&gbuffer->phong, 0, y)[x] != 0;
            count += meant && !sample_read(&filter, x, y, &sample);
        }
    return count;
}

static void scales_find(struct filter *filter)
{
    double coordinate = 0, radiance = 0;
    for (int y = 0; y < filter->taps.height; y++)
        for (int x = 0; x < filter->taps.width; x++) {
            struct sample sample;
            if (!sample_read(filter, x, y, &sample))
                continue;
            for (int i = 0; i < 3; i++) {
                coordinate = fmax(coordinate, fabs(sample.a[i]));
                radiance = fmax(radiance, fabs(sample.radiance[i]));
            }
        }
    filter->length_scale = coordinate > 0 ? ldexp(1, 20 - ilogb(coordinate)) : 1;
    const bool extreme = radiance > 0x1p50 || (radiance > 0 && radiance < 0x1p-20);
    filter->radiance_scale = extreme ? ldexp(1, -ilogb(radiance)) : 1;
}

static const struct filter_box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void box_add(struct filter_box *box, const float point[3])
{
    for (int i = 0; i < 3; i++) {
        box->low[i] = fminf(box->low[i], point[i]);
        box->high[i] = fmaxf(box->high[i], point[i]);
    }
}

static void taps_fill(void *context, int first, int end)
{
    struct filter *filter = context;
    const struct filter_taps *taps = &filter->taps;
    size_t plane = taps->stride * (size_t)taps->height;
    const bool max = filter->options->formula == FILTER_FORMULA_MAX;
    const float gain = (float)(max ? lobe_weight_max(1, 1, 1) : lobe_weight(1, 1));
    for (int y = first; y < end; y++)
        for (int x = 0; x < taps->width; x++) {
            struct sample sample;
            if (!sample_read(filter, x, y, &sample))
                continue;
            double b[4], largest = 0;
            memcpy(b, sample.b, sizeof b);
            for (int i = 0; i < 3 && b[3] > 0; i++) {
                b[i] *= filter->length_scale;
                largest = fmax(largest, fabs(b[i]));
            }
            /* So far away is a direction, the same from everywhere; its square would leave the range of a float. */
            if (largest > 0x1p60) {
                double length = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
                for (int i = 0; i < 3; i++)
                    b[i] /= length;
                b[3] = 0;
            }
            size_t column = (size_t)x + FILTER_BORDER;
            float *tap = filter->planes + (size_t)y * taps->stride + column;
            for (int i = 0; i < 4; i++)
                tap[(size_t)(FILTER_PLANE_X + i) * plane] = (float)b[i];
            tap[FILTER_PLANE_GAIN * plane] = gain;
            for (int i = 0; i < 3; i++)
                tap[(size_t)(FILTER_PLANE_R + i) * plane] = (float)(sample.radiance[i] * filter->radiance_scale);
            size_t block = (size_t)y * (taps->stride / FILTER_LANES) + column / FILTER_LANES;
            if (b[3] > 0)
                box_add(&filter->boxes[block], (const float[3]){(float)b[0], (float)b[1], (float)b[2]});
            filter->kinds[block] |= b[3] > 0 ? FILTER_KIND_POSITION : FILTER_KIND_DIRECTION;
        }
}

void filter_position_at(const struct filter *filter, int x, int y, float a[3])
{
    for (int i = 0; i < 3; i++)
        a[i] = (float)((double)image_row(&filter->gbuffer->position, i, y)[x] * filter->length_scale);
}

double filter_direction_to(const struct filter *filter, const float a[3], int x, int y, double direction[3])
{
    double w = (double)*filter_tap_at(filter, FILTER_PLANE_W, x, y), square = 0;
    for (int i = 0; i < 3; i++) {
        direction[i] = (double)*filter_tap_at(filter, FILTER_PLANE_X + (unsigned)i, x, y) - w * (double)a[i];
        square += direction[i] * direction[i];
    }
    double distance = sqrt(square);
    for (int i = 0; i < 3 && distance > 0; i++)
        direction[i] /= distance;
    return distance;
}

/* How far the ray of a glossy pixel moves across itself at its endpoint, to the next pixel on one axis: that of a lies
 * on the mirror, that of the direction is times the distance (for a direction it is the direction's alone). Of the two
 * neighbours the one that moves it less, for the other may be on another mirror. Its length; infinite where neither
 * neighbour is glossy. */
static double ray_step(const struct filter *filter, int x, int y, int right, int down, double step[3])
{
    const bool is_position = *filter_tap_at(filter, FILTER_PLANE_W, x, y) > 0;
    float a[3];
    double own[3], least = INFINITY;
    filter_position_at(filter, x, y, a);
    const double distance = filter_direction_to(filter, a, x, y, own);
    for (int sign = -1; sign <= 1; sign += 2) {
        int u = x + sign * right, v = y + sign * down;
        float position[3];
        double other[3], along = 0, square = 0;
        if (!filter_is_inside(filter, u, v) || !filter_is_glossy(filter, u, v))
            continue;
        filter_position_at(filter, u, v, position);
        if (filter_direction_to(filter, position, u, v, other) == 0)
            continue;
        for (int i = 0; i < 3; i++) {
            double moved = is_position ? (double)position[i] - (double)a[i] : 0;
            other[i] = sign * (moved + distance * (other[i] - own[i]));
            along += other[i] * own[i];
        }
        for (int i = 0; i < 3; i++) {
            other[i] -= along * own[i];
            square += other[i] * other[i];
        }
        if (square >= least)
            continue;
        least = square;
        memcpy(step, other, sizeof other);
    }
    return sqrt(least);
}

/* Area across the ray that a glossy pixel stands for at its endpoint (Igehy, "Tracing ray differentials", 1999); for a
 * direction its solid angle. What neighbours' rays meet has no part in it: they may leap to another thing. Without
 * neighbours on one axis it is a square, without any it is next to nothing. */
static double area_at(const struct filter *filter, int x, int y, double distance)
{
    const double least = 1e-12 * distance * distance;
    double across[3] = {0}, down[3] = {0}, area;
    double width = ray_step(filter, x, y, 1, 0, across), height = ray_step(filter, x, y, 0, 1, down);
    if (filter->options->without & FILTER_WITHOUT_DENSITY) {
        area = 1e-6 * distance * distance;
    } else if (isinf(width) || isinf(height)) {
        double side = fmin(width, height);
        area = isinf(side) ? 0 : side * side;
    } else {
        double normal[3] = {across[1] * down[2] - across[2] * down[1], across[2] * down[0] - across[0] * down[2],
                            across[0] * down[1] - across[1] * down[0]};
        area = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    }
    return fmax(area, least);
}

static void areas_fill(void *context, int first, int end)
{
    struct filter *filter = context;
    const struct filter_taps *taps = &filter->taps;
    const size_t plane = taps->stride * (size_t)taps->height;
    for (int y = first; y < end; y++)
        for (int x = 0; x < taps->width; x++) {
            float *tap = filter->planes + (size_t)y * taps->stride + (size_t)x + FILTER_BORDER, a[3];
            double own[3];
            if (!filter_is_glossy(filter, x, y))
                continue;
            filter_position_at(filter, x, y, a);
            double distance = filter_direction_to(filter, a, x, y, own);
            tap[FILTER_PLANE_AREA * plane] = (float)fmax(area_at(filter, x, y, distance), 1e-30);
            tap[FILTER_PLANE_NEAREST * plane] = (float)(distance * distance / FILTER_MOST_ENLARGED);
        }
}

/* Pixels in which the direction to the endpoint turns by the half-angle, where the camera is not known. */
static double radius_from_gradient(const struct filter *filter, int x, int y, double half_angle)
{
    float a[3];
    double own[3], step = INFINITY;
    filter_position_at(filter, x, y, a);
    if (filter_direction_to(filter, a, x, y, own) == 0)
        return 0;
    for (int n = 0; n < 4; n++) {
        int u = x + neighbours[n][0], v = y + neighbours[n][1];
        if (!filter_is_inside(filter, u, v) || !filter_is_glossy(filter, u, v))
            continue;
        double other[3], square = 0;
        if (filter_direction_to(filter, a, u, v, other) == 0)
            continue;
        for (int i = 0; i < 3; i++)
            square += (other[i] - own[i]) * (other[i] - own[i]);
        step = fmin(step, 2 * asin(fmin(sqrt(square) / 2, 1)));
    }
    return isinf(step) ? 0 : half_angle / step;
}

/* How many pixels like (x, y) the lobe cos^p of its own holds. */
static double pixels_in_lobe(const struct filter *filter, int x, int y)
{
    float a[3];
    double direction[3];
    filter_position_at(filter, x, y, a);
    const double distance = filter_direction_to(filter, a, x, y, direction);
    const double area = (double)*filter_tap_at(filter, FILTER_PLANE_AREA, x, y);
    return lobe_integral(filter_exponent_at(filter, x, y), 0) / (area / (distance * distance + area / (2 * pi)));
}

/* Equations (4) and (5) with the picture's and the user's limit, for a glossy pixel; of the best filter, whose pool it
 * is, no more than its few pixels ask for. */
static double radius_at(const struct filter *filter, int x, int y)
{
    const struct gbuffer *gbuffer = filter->gbuffer;
    double phong = filter_exponent_at(filter, x, y), radius;
    if (phong >= mirror_phong)
        return 0;
    double half_angle = lobe_half_angle(phong, filter->options->energy, filter->options->max_angle_rad);
    if (gbuffer->has_eye && gbuffer->view_angle > 0) {
        struct sample sample;
        double s = 0, r = 0;
        sample_read(filter, x, y, &sample);
        for (int i = 0; i < 3; i++) {
            double to_eye = sample.a[i] - (double)gbuffer->eye[i], to_end = sample.b[i] - sample.a[i];
            s += to_eye * to_eye;
            r += to_end * to_end;
        }
        double alpha = lobe_alpha(half_angle, sqrt(s), sample.b[3] > 0 ? sqrt(r) : INFINITY);
        radius = lobe_radius_px(alpha, filter->taps.width, (double)gbuffer->view_angle);
    } else {
        radius = radius_from_gradient(filter, x, y, half_angle);
    }
    if (filter->options->mode == FILTER_MODE_BEST)
        radius = fmin(radius, pool_radius + sqrt(pixels_in_lobe(filter, x, y)));
    return fmin(radius, filter->radius_limit_px);
}

/* Between the pixels of the coarse grid that are glossy with the same exponent; NaN where none is. */
static double radius_interpolate(const struct filter *filter, int x, int y)
{
    int step = filter->options->radius_step, left = x / step * step, top = y / step * step;
    double sum = 0, weights = 0, phong = filter_exponent_at(filter, x, y);
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            int u = left + i * step, v = top + j * step;
            double weight = (1 - abs(x - u) / (double)step) * (1 - abs(y - v) / (double)step);
            if (weight == 0 || u >= filter->taps.width || v >= filter->taps.height || !filter_is_glossy(filter, u, v))
                continue;
            if (filter_exponent_at(filter, u, v) != phong)
                continue;
            sum += weight * (double)image_row(&filter->radius, 0, v)[u];
            weights += weight;
        }
    return sum / weights;
}

static void radius_coarse(void *context, int first, int end)
{
    struct filter *filter = context;
    int step = filter->options->radius_step;
    for (int row = first; row < end; row++)
        for (int x = 0; x < filter->taps.width; x += step)
            if (filter_is_glossy(filter, x, row * step))
                image_row(&filter->radius, 0, row * step)[x] = (float)radius_at(filter, x, row * step);
}

static void radius_fine(void *context, int first, int end)
{
    struct filter *filter = context;
    int step = filter->options->radius_step;
    for (int y = first; y < end; y++)
        for (int x = 0; x < filter->taps.width; x++) {
            if ((x % step == 0 && y % step == 0) || !filter_is_glossy(filter, x, y))
                continue;
            double radius = radius_interpolate(filter, x, y);
            image_row(&filter->radius, 0, y)[x] = (float)(isnan(radius) ? radius_at(filter, x, y) : radius);
        }
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

/* Two axes at right angles to a lane's direction. */
static void across_axes(const double d[3], struct filter_lanes *lanes, int l)
{
    int least = fabs(d[0]) < fabs(d[1]) ? 0 : 1;
    if (fabs(d[2]) < fabs(d[least]))
        least = 2;
    const int i = (least + 1) % 3, j = (least + 2) % 3;
    const double length = hypot(d[i], d[j]);
    double axis[3] = {0};
    axis[i] = -d[j] / length;
    axis[j] = d[i] / length;
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        lanes->across[0][k][l] = (float)axis[k];
        lanes->across[1][k][l] = (float)(d[next] * axis[last] - d[last] * axis[next]);
    }
}

/* The exponent that the pixel's sums are taken with. A pixel's L0 stands for all directions between it and the next
 * pixels, so the lobe grows by the solid angle of one: that of n pixels by 1 + 1/n, and where the pixel is far larger
 * than the lobe, so that L0 in the middle is as good as a mean, by no more than 1 + 1/least_pixels. The paper, and the
 * sums without density, know of no such angle. */
static double lobe_exponent(const struct filter *filter, int x, int y)
{
    const double phong = filter_exponent_at(filter, x, y);
    if (filter->options->mode == FILTER_MODE_PAPER || filter->options->without & FILTER_WITHOUT_DENSITY)
        return phong;
    return phong / (1 + 1 / (pixels_in_lobe(filter, x, y) + least_pixels));
}

/* Fills lane l with pixel (x, y). False: nothing to sum, the result is L0. */
static bool lane_fill(const struct filter *filter, int x, int y, int l, struct filter_lanes *lanes)
{
    float a[3];
    double direction[3], phong = filter_exponent_at(filter, x, y);
    filter_position_at(filter, x, y, a);
    double distance = filter_direction_to(filter, a, x, y, direction);
    bool one_tap = filter->options->mode == FILTER_MODE_PAPER && image_row(&filter->radius, 0, y)[x] < 1;
    if (phong >= mirror_phong || distance < least_distance || one_tap)
        return false;
    for (int i = 0; i < 3; i++) {
        lanes->a[i][l] = a[i];
        lanes->direction[i][l] = (float)direction[i];
    }
    for (int i = 0; i < 4; i++)
        lanes->b[i][l] = *filter_tap_at(filter, FILTER_PLANE_X + (unsigned)i, x, y);
    across_axes(direction, lanes, l);
    lanes->distance[l] = (float)distance;
    lanes->kinds |= lanes->b[3][l] > 0 ? FILTER_KIND_POSITION : FILTER_KIND_DIRECTION;
    if (lanes->b[3][l] > 0)
        lanes->farthest = fmaxf(lanes->farthest, lanes->distance[l]);
    box_add(&lanes->box, a);
    lanes->slope[l] = (float)slope_of(filter->taps.shape, lobe_exponent(filter, x, y));
    lanes->narrow = lanes->narrow && lanes->slope[l] >= FILTER_NARROW_SLOPE;
    return true;
}

struct filter_lanes filter_lanes_empty(int x, int y)
{
    struct filter_lanes lanes = {.x = x, .y = y, .narrow = true, .box = empty_box};
    for (int l = 0; l < FILTER_LANES; l++)
        lanes.limit[l] = lanes.blind[l] = -1;
    return lanes;
}

/* The lanes' pixels from column x of row y on; used[l]: there is something to sum for lane l. */
static bool lanes_fill(const struct filter *filter, int x, int y, struct filter_lanes *lanes, bool used[FILTER_LANES])
{
    bool any = false;
    *lanes = filter_lanes_empty(x, y);
    for (int l = 0; l < FILTER_LANES; l++) {
        used[l] = x + l < filter->taps.width && filter_is_glossy(filter, x + l, y) &&
                  lane_fill(filter, x + l, y, l, lanes);
        any = any || used[l];
    }
    return any;
}

/* Writes one pixel's sums; without weights L0 itself. */
static void pixel_write(const struct filter *filter, int x, int y, const double colour[3], double weights)
{
    for (int i = 0; i < 3; i++) {
        double value = (double)image_row(&filter->gbuffer->specular, i, y)[x];
        if (weights > 0)
            value = colour[i] / weights / filter->radiance_scale;
        image_row(filter->glossy, i, y)[x] = (float)fmax(-FLT_MAX, fmin(value, FLT_MAX));
    }
}

bool filter_is_needed(const struct filter *filter, int x, int y, int width, int height)
{
    const struct image_window *window = &filter->gbuffer->window;
    const int reach = FILTER_EDGE_REACH_PX;
    return window->width == 0 ||
           (y + height > window->top - reach && y < window->top + window->height + reach &&
            x + width > window->left - reach && x < window->left + window->width + reach);
}

static void blur_paper(void *context, int first, int end)
{
    struct filter *filter = context;
    for (int y = first; y < end; y++)
        for (int x = 0; x < filter->taps.width && !interrupt_signal(); x += FILTER_LANES) {
            if (!filter_is_needed(filter, x, y, FILTER_LANES, 1))
                continue;
            struct filter_lanes lanes;
            struct filter_sums sums = {0};
            bool used[FILTER_LANES], any = lanes_fill(filter, x, y, &lanes, used);
            for (int l = 0; l < FILTER_LANES; l++) {
                if (!used[l])
                    continue;
                double radius = (double)image_row(&filter->radius, 0, y)[x + l];
                lanes.limit[l] = (float)(radius * radius);
            }
            if (any)
                filter->kernel(&filter->taps, &lanes, &sums);
            for (int l = 0; l < FILTER_LANES && x + l < filter->taps.width; l++)
                if (filter_is_glossy(filter, x + l, y))
                    pixel_write(filter, x + l, y,
                                (double[]){sums.value[0][l], sums.value[1][l], sums.value[2][l]}, sums.value[3][l]);
        }
}

/* The share of a lobe that is seen where nothing hides any: of the integral of e^-x - floor over x = p tan^2(theta) / 2
 * up to X, where it ends, that with what fades out from (1 - fade_share) blind_ratio X to blind_ratio X. */
static double whole_share(double floor)
{
    const double end = -log(floor), blind = blind_ratio * end, width = fade_share * blind;
    const double start = fmin(blind - width, end);
    const double rise = exp(-start) * (start - blind + 1), last = floor * (end - blind + 1);
    const double bright = 1 - exp(-start) - floor * start;
    const double fading = (last - rise - floor * (blind * (end - start) - (end * end - start * start) / 2)) / width;
    return (bright + fading) / (1 - floor * (1 + end));
}

/* Square of the least angle by which the mirror direction turns from a pixel to a neighbour: the farther away things
 * are, the nearer the angle between their endpoints comes to it. With a margin, for it changes over the picture. */
static double gradient_least(const struct filter *filter, int x, int y)
{
    const double margin = 1.5;
    double own[3], least = INFINITY;
    float a[3];
    filter_position_at(filter, x, y, a);
    filter_direction_to(filter, a, x, y, own);
    for (int n = 0; n < 4; n++) {
        int u = x + neighbours[n][0], v = y + neighbours[n][1];
        double other[3], square = 0;
        if (!filter_is_inside(filter, u, v) || !filter_is_glossy(filter, u, v))
            continue;
        filter_position_at(filter, u, v, a);
        filter_direction_to(filter, a, u, v, other);
        for (int i = 0; i < 3; i++)
            square += (other[i] - own[i]) * (other[i] - own[i]);
        least = fmin(least, square);
    }
    return isinf(least) ? 0 : least / (margin * margin);
}

/* tan^2(theta) at which nothing is left of the lobe: where cos^p is the floor, or the user's limit. */
static double lobe_reach(const struct filter *filter, double phong)
{
    const double ninety_degrees = 0x1p99;
    double limit = tan(filter->options->max_angle_rad), reach = pow(filter->floor, -2 / phong) - 1;
    return fmin(fmin(reach, filter->options->max_angle_rad < pi / 2 ? limit * limit : INFINITY), ninety_degrees);
}

/* The sum of the weights of a lobe of lobe_exponent() where nothing is hidden, steradians. */
static double whole_lobe(const struct filter *filter, double exponent)
{
    return filter->whole * lobe_integral(exponent, filter->floor);
}

/* A lobe that is narrow for the mirror's curvature holds few pixels, n, and chance errs more there than what should be
 * hidden: share = (pool_pixels / (n + pool_pixels))^2, less a little. And half of what no seen pixel covers is taken
 * from the others. */
static struct filter_help help_of_pixel(const struct filter *filter, int x, int y, double seen)
{
    if (filter->options->without & FILTER_WITHOUT_POOL || image_row(&filter->radius, 0, y)[x] < 1)
        return (struct filter_help){0};
    const double few = pool_pixels / (pixels_in_lobe(filter, x, y) + pool_pixels);
    const double least_seen = (1 - missing_least) * whole_lobe(filter, lobe_exponent(filter, x, y));
    return (struct filter_help){.share = fmax(few * few - pool_share_least, 0),
                                .missing = missing_share * fmax(least_seen - seen, 0)};
}

bool filter_help_needed(const struct filter *filter, const struct filter_pixels *pixels,
                        const struct filter_moments *seen, struct filter_lanes *lanes,
                        struct filter_help help[FILTER_LANES])
{
    bool any = false;
    for (int l = 0; l < FILTER_LANES; l++) {
        if (!pixels->used[l])
            continue;
        const int x = pixels->xs[l], y = pixels->ys[l];
        const double radius = (double)image_row(&filter->radius, 0, y)[x];
        help[l] = help_of_pixel(filter, x, y, seen->value[FILTER_MOMENT_1][l]);
        if (help[l].share == 0 && help[l].missing == 0)
            continue;
        lanes->limit[l] = (float)(radius * radius);
        any = true;
    }
    return any;
}

static double clamp(double value, double low, double high)
{
    return fmax(low, fmin(value, high));
}

/* 1 where what lane l sees is about even. Where single things are much brighter, 1 + variance / mean^2 of R + G + B is
 * about one over the share of the lobe that they fill; from even_contrast on evenness is inverse to it. */
static double evenness(const struct filter_moments *seen, int l)
{
    double mean = 0, square = seen->value[FILTER_MOMENT_SQUARE][l] * seen->value[FILTER_MOMENT_1][l];
    for (int i = 0; i < 3; i++)
        mean += seen->value[FILTER_MOMENT_R + i][l];
    return square > 0 ? fmin(even_contrast * mean * mean / square, 1) : 1;
}

/* Mean radiance of lane l's lobe, R, G, B, by what is seen of it: the value at its middle of the plane of weighted
 * least squares in u and v,
 *   minimise sum f (L0 - value - slope . (u, v))^2 + ridge variance sum f |slope|^2,
 * with variance that of u in the whole lobe. Where the lobe is evenly covered that is the mean of L0; where it is
 * covered on one side the mean is that side's (Fan, "Design-adaptive nonparametric regression", 1992). Single bright
 * things make no slope: it counts as far as what is seen is even. Within the range of what is seen. */
static void fit_plane(const struct filter_moments *seen, int l, double phong, double even, double value[3])
{
    double m[FILTER_MOMENTS];
    for (int i = 0; i < FILTER_MOMENTS; i++)
        m[i] = seen->value[i][l] / seen->value[FILTER_MOMENT_1][l];
    const double damping = ridge / (phong + 3), u = m[FILTER_MOMENT_U], v = m[FILTER_MOMENT_V];
    const double uu = m[FILTER_MOMENT_UU] - u * u + damping, vv = m[FILTER_MOMENT_VV] - v * v + damping;
    const double uv = m[FILTER_MOMENT_UV] - u * v, determinant = uu * vv - uv * uv;
    for (int i = 0; i < 3; i++) {
        double mean = m[FILTER_MOMENT_R + i];
        double with_u = m[FILTER_MOMENT_RU + i] - mean * u, with_v = m[FILTER_MOMENT_RV + i] - mean * v;
        double turn = ((vv * u - uv * v) * with_u + (uu * v - uv * u) * with_v) / determinant;
        value[i] = clamp(mean - even * turn, (double)seen->low[i][l], (double)seen->high[i][l]);
    }
}

/* Takes off what can't be expected where nothing is seen: single bright things, being few, are more likely among what
 * is seen than elsewhere. The mean of what isn't seen is less by that, within the range of what is. */
static void dim_unseen(const struct filter_moments *seen, int l, double even, double confidence, double value[3])
{
    for (int i = 0; i < 3; i++) {
        double unseen = clamp(even * value[i], (double)seen->low[i][l], (double)seen->high[i][l]);
        value[i] = confidence * value[i] + (1 - confidence) * (even < 1 ? unseen : value[i]);
    }
}

bool filter_lane_fill(const struct filter *filter, int x, int y, int l, struct filter_lanes *lanes)
{
    const bool everything = filter->options->without & FILTER_WITHOUT_VISIBILITY;
    if (!lane_fill(filter, x, y, l, lanes))
        return false;
    const double blind = lobe_reach(filter, filter_exponent_at(filter, x, y)) * blind_ratio;
    lanes->floor = (float)filter->floor;
    lanes->reach[l] = (float)lobe_reach(filter, lobe_exponent(filter, x, y));
    lanes->blind[l] = everything ? FLT_MAX : (float)blind;
    lanes->fade[l] = everything ? 1 : (float)(1 / (blind * fade_share));
    lanes->step[l] = (float)gradient_least(filter, x, y);
    return true;
}

void filter_write_mirror(struct filter *filter, int x, int y)
{
    pixel_write(filter, x, y, (double[3]){0}, 0);
    image_row(&filter->confidence, 0, y)[x] = 1;
}

static void pixel_write_best(struct filter *filter, int x, int y, int l, const struct filter_moments *seen,
                             const struct filter_sums *pool, struct filter_help help)
{
    double mean[3], share = help.share;
    if (help.missing > 0 && pool->value[3][l] > 0)
        share += help.missing / pool->value[3][l];
    double phong = lobe_exponent(filter, x, y), weight = seen->value[FILTER_MOMENT_1][l];
    double confidence = fmin(weight / whole_lobe(filter, phong), 1);
    const bool fit = weight > 0 && !(filter->options->without & FILTER_WITHOUT_FIT);
    const double even = evenness(seen, l);
    for (int i = 0; i < 3; i++)
        mean[i] = seen->value[FILTER_MOMENT_R + i][l] / weight;
    if (fit)
        fit_plane(seen, l, phong, even, mean);
    for (int i = 0; i < 3; i++)
        mean[i] = (mean[i] * weight + share * pool->value[i][l]) / (weight + share * pool->value[3][l]);
    if (fit)
        dim_unseen(seen, l, even, confidence, mean);
    pixel_write(filter, x, y, mean, weight > 0 ? 1 : 0);
    image_row(&filter->confidence, 0, y)[x] = (float)confidence;
}

void filter_write_best(struct filter *filter, const struct filter_pixels *pixels, const struct filter_moments *seen,
                       const struct filter_sums *pool, const struct filter_help help[FILTER_LANES])
{
    for (int l = 0; l < FILTER_LANES; l++)
        if (pixels->used[l])
            pixel_write_best(filter, pixels->xs[l], pixels->ys[l], l, seen, pool, help[l]);
}

void filter_best_lanes(struct filter *filter, int x, int y, float *scratch)
{
    struct filter_lanes lanes = filter_lanes_empty(x, y);
    struct filter_moments seen = {0};
    struct filter_sums pool = {0};
    struct filter_help help[FILTER_LANES] = {{0}};
    struct filter_pixels pixels = {.used = {false}};
    bool any = false, steep = true;
    for (int l = 0; l < FILTER_LANES && x + l < filter->taps.width; l++) {
        if (!filter_is_glossy(filter, x + l, y))
            continue;
        pixels.xs[l] = x + l;
        pixels.ys[l] = y;
        pixels.used[l] = filter_lane_fill(filter, x + l, y, l, &lanes);
        if (!pixels.used[l])
            filter_write_mirror(filter, x + l, y);
        any = any || pixels.used[l];
        steep = steep && (!pixels.used[l] || lanes.reach[l] <= FILTER_NARROW_REACH);
    }
    if (!any)
        return;
    lanes.limit_px = (int)filter->radius_limit_px;
    const bool narrow = lanes.narrow;
    lanes.narrow = steep;
    filter->see(&filter->taps, &lanes, scratch, &seen);
    lanes.narrow = narrow;
    if (filter_help_needed(filter, &pixels, &seen, &lanes, help))
        filter->kernel(&filter->taps, &lanes, &pool);
    filter_write_best(filter, &pixels, &seen, &pool, help);
}

static void blur_best(void *context, int first, int end)
{
    struct filter *filter = context;
    float *scratch = aligned_alloc(64, FILTER_SEE_SCRATCH(filter->taps.width));
    if (!scratch) {
        atomic_store(&filter->out_of_memory, true);
        return;
    }
    for (int y = first; y < end; y++)
        for (int x = 0; x < filter->taps.width && !interrupt_signal(); x += FILTER_LANES)
            if (filter_is_needed(filter, x, y, FILTER_LANES, 1))
                filter_best_lanes(filter, x, y, scratch);
    free(scratch);
}

/* Mean of the results of the nearest ring of pixels that has glossy ones. */
static void edge_fill(const struct filter *filter, int x, int y)
{
    for (int reach = 1; reach <= FILTER_EDGE_REACH_PX; reach++) {
        double sum[3] = {0};
        int count = 0;
        for (int v = y - reach; v <= y + reach; v++)
            for (int u = x - reach; u <= x + reach; u++) {
                if (!filter_is_inside(filter, u, v) || !filter_is_glossy(filter, u, v))
                    continue;
                for (int i = 0; i < 3; i++)
                    sum[i] += (double)image_row(filter->glossy, i, v)[u];
                count++;
            }
        for (int i = 0; i < 3 && count > 0; i++)
            image_row(filter->glossy, i, y)[x] = (float)(sum[i] / count);
        if (count > 0)
            return;
    }
}

static void edges(void *context, int first, int end)
{
    struct filter *filter = context;
    const struct image *reflectance = &filter->gbuffer->reflectance;
    for (int y = first; y < end; y++)
        for (int x = 0; x < filter->taps.width; x++) {
            bool reflects = false;
            for (int i = 0; i < 3; i++)
                reflects = reflects || image_row(reflectance, i, y)[x] > 0;
            if (reflects && !filter_is_glossy(filter, x, y))
                edge_fill(filter, x, y);
        }
}

static enum result check_plane(const struct image *image, const char *name, int channels, const struct image *size,
                               struct error *err)
{
    if (!image->pixels)
        return error_set(err, RESULT_DATA, "there is no %s pass", name);
    if (image->width != size->width || image->height != size->height || image->channels < channels)
        return error_set(err, RESULT_DATA, "the %s pass is %d x %d pixels of %d channels, not %d x %d of %d", name,
                         image->width, image->height, image->channels, size->width, size->height, channels);
    return RESULT_OK;
}

static enum result check(const struct gbuffer *gbuffer, const struct filter_options *options, struct error *err)
{
    assert(options->energy > 0 && options->energy < 1 && options->max_angle_rad > 0 && options->max_radius_px >= 0);
    assert(options->radius_step > 0 && options->threads >= 0 && !(options->phong < 0));
    const struct image *size = &gbuffer->specular;
    enum result result = check_plane(size, "specular", 3, size, err);
    if (result == RESULT_OK)
        result = check_plane(&gbuffer->position, "position", 3, size, err);
    if (result == RESULT_OK)
        result = check_plane(&gbuffer->endpoint, "endpoint", 4, size, err);
    if (result == RESULT_OK && gbuffer->phong.pixels)
        result = check_plane(&gbuffer->phong, "phong", 1, size, err);
    if (result == RESULT_OK && gbuffer->rays.pixels)
        result = check_plane(&gbuffer->rays, "rays", 4, size, err);
    if (result == RESULT_OK && gbuffer->reflectance.pixels)
        result = check_plane(&gbuffer->reflectance, "reflectance", 3, size, err);
    if (result != RESULT_OK)
        return result;
    if (isnan(options->phong) && (!gbuffer->phong.pixels || options->phong_override))
        return error_set(err, RESULT_USAGE, "no Phong exponent: the passes have no phong.V channel; give one with "
                                            "--phong or --roughness");
    if (!cpu_isa_supported(options->isa))
        return error_set(err, RESULT_USAGE, "this processor lacks the instruction set asked for; use --isa auto");
    return RESULT_OK;
}

/* Frees what is built. */
static void parts_free(struct filter *filter)
{
    filter_fast_free(filter->fast);
    free(filter->table);
    free(filter->boxes);
    free(filter->kinds);
    free(filter->planes);
    filter->fast = NULL;
    filter->table = filter->planes = NULL;
    filter->boxes = NULL;
    filter->kinds = NULL;
}

static enum result parts_alloc(struct filter *filter, struct error *err)
{
    struct filter_taps *taps = &filter->taps;
    taps->width = filter->gbuffer->specular.width;
    taps->height = filter->gbuffer->specular.height;
    taps->stride = ((size_t)taps->width + FILTER_LANES - 1) / FILTER_LANES * FILTER_LANES + 2 * FILTER_BORDER;
    const size_t plane = taps->stride * (size_t)taps->height, blocks = plane / FILTER_LANES;
    const size_t bytes = plane * FILTER_PLANES * sizeof(float);
    filter->planes = aligned_alloc(64, bytes);
    filter->kinds = calloc(blocks, 1);
    filter->boxes = malloc(blocks * sizeof *filter->boxes);
    filter->table = malloc(WEIGHTS_TABLE_SIZE * sizeof *filter->table);
    if (!filter->planes || !filter->kinds || !filter->boxes || !filter->table)
        return error_memory(err, (double)bytes);
    for (size_t i = 0; i < blocks; i++)
        filter->boxes[i] = empty_box;
    memset(filter->planes, 0, bytes);
    weights_table_build(filter->table);
    taps->kinds = filter->kinds;
    taps->boxes = filter->boxes;
    taps->table = filter->table;
    for (int i = 0; i < FILTER_PLANES; i++)
        taps->planes[i] = filter->planes + (size_t)i * plane;
    return RESULT_OK;
}

/* The taps, and for the best filter their areas, unless they are there. */
static enum result parts_build(struct filter *filter, struct error *err)
{
    const struct filter_options *options = filter->options, *before = &filter->built_for;
    const int height = filter->gbuffer->specular.height;
    if (filter->planes && before->mode == options->mode && before->formula == options->formula &&
        before->without == options->without)
        return RESULT_OK;
    parts_free(filter);
    enum result result = parts_alloc(filter, err);
    if (result == RESULT_OK) {
        scales_find(filter);
        result = bands_run(height, 16, options->threads, taps_fill, filter, err);
    }
    if (result == RESULT_OK && options->mode == FILTER_MODE_BEST)
        result = bands_run(height, 16, options->threads, areas_fill, filter, err);
    filter->built_for = *options;
    if (result != RESULT_OK)
        parts_free(filter);
    return result;
}

/* What one call sets. */
static enum result call_begin(struct filter *filter, const struct filter_options *options, struct image *glossy,
                              struct error *err)
{
    static filter_kernel *const kernels[CPU_ISA_COUNT] = {[CPU_ISA_SSE2] = filter_kernel_sse2,
                                                          [CPU_ISA_AVX2] = filter_kernel_avx2,
                                                          [CPU_ISA_AVX512] = filter_kernel_avx512};
    static filter_see *const sees[CPU_ISA_COUNT] = {
        [CPU_ISA_SSE2] = filter_see_sse2, [CPU_ISA_AVX2] = filter_see_avx2, [CPU_ISA_AVX512] = filter_see_avx512};
    static const struct sight_kernel *const sights[CPU_ISA_COUNT] = {[CPU_ISA_SSE2] = &sight_kernel_sse2,
                                                                     [CPU_ISA_AVX2] = &sight_kernel_avx2,
                                                                     [CPU_ISA_AVX512] = &sight_kernel_avx512};
    const int width = filter->gbuffer->specular.width, height = filter->gbuffer->specular.height;
    const enum cpu_isa isa = options->isa == CPU_ISA_AUTO ? cpu_isa_best() : options->isa;
    filter->options = options;
    filter->kernel = kernels[isa];
    filter->see = sees[isa];
    filter->sight = sights[isa];
    filter->floor = 1 - options->energy;
    filter->whole = options->without & FILTER_WITHOUT_VISIBILITY ? 1 : whole_share(filter->floor);
    filter->radius_limit_px = hypot(width, height);
    if (options->max_radius_px > 0)
        filter->radius_limit_px = fmin(filter->radius_limit_px, options->max_radius_px);
    filter->taps.square = options->window == FILTER_WINDOW_SQUARE;
    filter->taps.shape = options->mode == FILTER_MODE_PAPER ? shape_of(options->weights) : FILTER_SHAPE_SOLID;
    filter->glossy = glossy;
    atomic_store(&filter->out_of_memory, false);
    enum result result = image_alloc(&filter->radius, width, height, 1, err);
    if (result == RESULT_OK)
        result = image_alloc(&filter->confidence, width, height, 1, err);
    if (result == RESULT_OK)
        result = image_alloc(glossy, width, height, 3, err);
    return result;
}

enum result filter_open(const struct gbuffer *gbuffer, struct filter **filter, struct error *err)
{
    *filter = calloc(1, sizeof **filter);
    if (!*filter)
        return error_memory(err, sizeof **filter);
    (*filter)->gbuffer = gbuffer;
    return RESULT_OK;
}

void filter_close(struct filter *filter)
{
    if (filter)
        parts_free(filter);
    free(filter);
}

const struct gbuffer *filter_gbuffer(const struct filter *filter)
{
    return filter->gbuffer;
}

enum result filter_apply(struct filter *filter, const struct filter_options *options, struct image *glossy,
                         struct image *measure, struct error *err)
{
    const struct gbuffer *gbuffer = filter->gbuffer;
    const int threads = options->threads, step = options->radius_step, height = gbuffer->specular.height;
    const bool paper = options->mode == FILTER_MODE_PAPER;
    *glossy = (struct image){0};
    if (measure)
        *measure = (struct image){0};
    enum result result = check(gbuffer, options, err);
    if (result != RESULT_OK)
        return result;
    result = call_begin(filter, options, glossy, err);
    if (result == RESULT_OK)
        result = parts_build(filter, err);
    if (result == RESULT_OK)
        result = bands_run((height + step - 1) / step, 16, threads, radius_coarse, filter, err);
    if (result == RESULT_OK)
        result = bands_run(height, 16, threads, radius_fine, filter, err);
    if (result == RESULT_OK && filter_fast_applies(filter))
        result = filter_fast(filter, err);
    else if (result == RESULT_OK)
        result = bands_run(height, 1, threads, paper ? blur_paper : blur_best, filter, err);
    if (result == RESULT_OK && atomic_load(&filter->out_of_memory))
        result = error_memory(err, (double)FILTER_SEE_SCRATCH(filter->taps.width));
    if (result == RESULT_OK && gbuffer->rays.pixels)
        result = control_variate(gbuffer, options->phong_override ? options->phong : NAN, threads, glossy, err);
    if (result == RESULT_OK && gbuffer->reflectance.pixels)
        result = bands_run(height, 16, threads, edges, filter, err);
    if (result == RESULT_OK && measure) {
        struct image *found = paper ? &filter->radius : &filter->confidence;
        *measure = *found;
        *found = (struct image){0};
    }
    if (result != RESULT_OK)
        image_free(glossy);
    image_free(&filter->radius);
    image_free(&filter->confidence);
    return result;
}

enum result filter_glossy(const struct gbuffer *gbuffer, const struct filter_options *options, struct image *glossy,
                          struct image *measure, struct error *err)
{
    struct filter *filter;
    *glossy = (struct image){0};
    if (measure)
        *measure = (struct image){0};
    enum result result = filter_open(gbuffer, &filter, err);
    if (result == RESULT_OK)
        result = filter_apply(filter, options, glossy, measure, err);
    filter_close(filter);
    return result;
}
