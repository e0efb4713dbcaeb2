/* The residual of every pixel, then its mean about each. */
#include "control_variate.h"

#include "bands.h"

#include <math.h>
#include <stdlib.h>

static const float mirror_phong = 1e20f;

/* A glossy pixel; phong 0: none. */
struct tap {
    float a[3], b[4], residual[3], rays, phong;
};

struct field {
    const struct gbuffer *gbuffer;
    struct image *glossy;
    struct tap *taps;
    int width, height;
    double rays; /* N */
    double tent; /* T */
};

static struct tap tap_read(const struct gbuffer *gbuffer, const struct image *glossy, float phong, int x, int y)
{
    struct tap tap = {.phong = image_row(&gbuffer->phong, 0, y)[x], .rays = image_row(&gbuffer->rays, 3, y)[x]};
    float sum = tap.rays;
    for (int i = 0; i < 3; i++) {
        sum += tap.a[i] = image_row(&gbuffer->position, i, y)[x];
        sum += tap.residual[i] = image_row(&gbuffer->rays, i, y)[x] - image_row(glossy, i, y)[x];
    }
    for (int i = 0; i < 4; i++)
        sum += tap.b[i] = image_row(&gbuffer->endpoint, i, y)[x];
    bool in_use = isnan(phong) || tap.phong == phong;
    bool is_count = tap.rays == 0 || tap.rays >= 1;
    if (!isfinite(sum) || !is_count || !in_use || !gbuffer_is_glossy(gbuffer, x, y) || tap.phong >= mirror_phong)
        return (struct tap){0};
    return tap;
}

/* Unit direction from a to the tap's b, and its distance, infinite for a direction; 0: none. */
static double direction_to(const float a[3], const struct tap *tap, double direction[3])
{
    double square = 0;
    for (int i = 0; i < 3; i++) {
        direction[i] = (double)tap->b[i] - (double)tap->b[3] * (double)a[i];
        square += direction[i] * direction[i];
    }
    for (int i = 0; i < 3; i++)
        direction[i] /= sqrt(square);
    return square > 0 ? sqrt(square) / (double)tap->b[3] : 0;
}

/* tan^2(theta) between two unit directions; infinite from 90 degrees on. */
static double tan_square(const double direction[3], const double other[3])
{
    double cosine = 0, square = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double sine = direction[j] * other[k] - direction[k] * other[j];
        cosine += direction[i] * other[i];
        square += sine * sine;
    }
    return cosine > 0 ? square / (cosine * cosine) : INFINITY;
}

/* 1 for the same distance, also for two directions; 0 between a direction and a position. */
static double nearness(double distance, double other)
{
    return distance == other ? 1 : fmin(distance, other) / fmax(distance, other);
}

static const struct tap *tap_at(const struct field *field, int x, int y)
{
    static const struct tap none;
    bool inside = x >= 0 && y >= 0 && x < field->width && y < field->height;
    return inside ? &field->taps[(size_t)y * (size_t)field->width + (size_t)x] : &none;
}

static void correct(const struct field *field, int x, int y)
{
    const struct tap *own = tap_at(field, x, y);
    static const int neighbours[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    double direction[3], other[3], least = INFINITY, sums[4] = {0};
    double distance = own->phong > 0 ? direction_to(own->a, own, direction) : 0;
    if (distance == 0)
        return;
    for (int n = 0; n < 4; n++) {
        const struct tap *tap = tap_at(field, x + neighbours[n][0], y + neighbours[n][1]);
        if (tap->phong > 0 && direction_to(own->a, tap, other) > 0)
            least = fmin(least, tan_square(direction, other));
    }
    double spread = 2 / (double)own->phong + (isinf(least) ? 0 : 9 * least / (field->rays * field->rays));
    const int reach = (int)ceil(field->tent) - 1;
    for (int v = y - reach; v <= y + reach; v++)
        for (int u = x - reach; u <= x + reach; u++) {
            const struct tap *tap = tap_at(field, u, v);
            double other_distance = tap->phong == own->phong ? direction_to(own->a, tap, other) : 0;
            if (tap->rays == 0 || other_distance == 0)
                continue;
            double weight = (double)tap->rays * (1 - abs(u - x) / field->tent) * (1 - abs(v - y) / field->tent);
            weight *= nearness(distance, other_distance) * exp(-0.5 * tan_square(direction, other) / spread);
            for (int i = 0; i < 3; i++)
                sums[i] += weight * (double)tap->residual[i];
            sums[3] += weight;
        }
    for (int i = 0; i < 3 && sums[3] > 0; i++) {
        float *value = &image_row(field->glossy, i, y)[x];
        float corrected = (float)((double)*value + sums[i] / sums[3]);
        if (isfinite(corrected)) /* else it is beyond the floats */
            *value = *value >= 0 ? fmaxf(corrected, 0) : corrected;
    }
}

static void correct_rows(void *context, int first, int end)
{
    const struct field *field = context;
    for (int y = first; y < end; y++)
        for (int x = 0; x < field->width; x++)
            correct(field, x, y);
}

enum result control_variate(const struct gbuffer *gbuffer, float phong, int threads, struct image *glossy,
                            struct error *err)
{
    struct field field = {
        .gbuffer = gbuffer, .glossy = glossy, .width = gbuffer->rays.width, .height = gbuffer->rays.height};
    if (!gbuffer->phong.pixels)
        return RESULT_OK;
    size_t count = (size_t)field.width * (size_t)field.height;
    field.taps = malloc(count * sizeof *field.taps);
    if (!field.taps)
        return error_memory(err, (double)count * sizeof *field.taps);
    for (int y = 0; y < field.height; y++)
        for (int x = 0; x < field.width; x++) {
            struct tap *tap = &field.taps[(size_t)y * (size_t)field.width + (size_t)x];
            *tap = tap_read(gbuffer, glossy, phong, x, y);
            field.rays = fmax(field.rays, (double)tap->rays);
        }
    field.tent = 1 + 9 / sqrt(field.rays);
    enum result result = RESULT_OK;
    if (field.rays > 0)
        result = bands_run(field.height, 4, threads, correct_rows, &field, err);
    free(field.taps);
    return result;
}
