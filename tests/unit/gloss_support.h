/* What the tests of the filter share: a synthetic scene, the oracle of equation (1), and strict assertions. */
#ifndef POVGLOSS_GLOSS_SUPPORT_H
#define POVGLOSS_GLOSS_SUPPORT_H

#include "filter.h"
#include "lobe.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define UNUSED __attribute__((unused))

/* Fails unless |a - b| <= tolerance: NaN fails. (cmocka's own float assertion lets it pass.) */
#define assert_near(a, b, tolerance) assert_near_at((double)(a), (double)(b), (double)(tolerance), __FILE__, __LINE__)

UNUSED static void assert_near_at(double a, double b, double tolerance, const char *file, int line)
{
    if (fabs(a - b) <= tolerance)
        return;
    print_error("%.17g and %.17g differ by more than %g\n", a, b, tolerance);
    _fail(file, line);
}

#define assert_ok(result, err)                                                                                         \
    do {                                                                                                               \
        if ((result) != RESULT_OK)                                                                                     \
            fail_msg("%s", (err).text);                                                                                \
    } while (0)

UNUSED static void filter_run(const struct gbuffer *gbuffer, const struct filter_options *options, struct image *glossy,
                              struct image *measure)
{
    struct error err;
    assert_ok(filter_glossy(gbuffer, options, glossy, measure, &err), err);
}

UNUSED static bool image_same(const struct image *a, const struct image *b)
{
    size_t count = a->stride * (size_t)a->height * (size_t)a->channels;
    return a->width == b->width && a->height == b->height && a->channels == b->channels &&
           memcmp(a->pixels, b->pixels, count * sizeof *a->pixels) == 0;
}

/* A glossy floor y = 0 (and, optionally, a glossy ball on it) seen by a pinhole camera under a sky, with two spheres
 * and a checkered wall. Lengths times `scale`; `bounded` closes the scene, so that no mirrored ray misses; a view
 * angle other than 0 replaces 1.1 radians: a small one looks at the edge of a sphere's reflection. */
struct scene {
    double scale, view_angle;
    bool ball, bounded;
};

struct ball {
    double centre[3], radius;
};

static const struct ball scene_balls[] = {
    {{-0.9, 0.8, 1.0}, 0.8}, {{1.1, 0.5, 0.2}, 0.5}, {{0.1, 0.35, -0.7}, 0.35} /* glossy where asked */
};

UNUSED static double ball_hit(const struct ball *ball, const double from[3], const double to[3])
{
    double b = 0, c = -ball->radius * ball->radius;
    for (int i = 0; i < 3; i++) {
        double offset = from[i] - ball->centre[i];
        b += offset * to[i];
        c += offset * offset;
    }
    double d = b * b - c;
    if (d < 0 || -b - sqrt(d) < 1e-9)
        return INFINITY;
    return -b - sqrt(d);
}

/* Distance to the first thing along a unit direction: 0, 1, 2 the balls, 3 the floor, 4 the wall, -1 none. */
UNUSED static double scene_hit(const struct scene *scene, const double from[3], const double to[3], int *thing)
{
    double nearest = INFINITY;
    *thing = -1;
    for (int i = 0; i < 3; i++) {
        double distance = ball_hit(&scene_balls[i], from, to);
        if (distance < nearest) {
            nearest = distance;
            *thing = i;
        }
    }
    double floor_distance = to[1] < 0 ? -from[1] / to[1] : INFINITY;
    if (floor_distance > 1e-9 && floor_distance < nearest) {
        nearest = floor_distance;
        *thing = 3;
    }
    double wall = to[2] > 0 ? (4 - from[2]) / to[2] : INFINITY, height = from[1] + wall * to[1];
    if (wall < nearest && (scene->bounded || (height < 2.5 && fabs(from[0] + wall * to[0]) < 2.5))) {
        nearest = wall;
        *thing = 4;
    }
    return nearest;
}

UNUSED static void scene_colour(int thing, const double point[3], const double direction[3], float colour[3])
{
    static const float of_thing[5][3] = {
        {0.9f, 0.2f, 0.1f}, {0.2f, 0.8f, 0.3f}, {0.5f, 0.5f, 0.6f}, {0.3f, 0.3f, 0.3f}, {1, 1, 1}};
    bool dark = thing == 4 && ((int)floor(point[0] * 2) + (int)floor(point[1] * 2)) & 1;
    for (int i = 0; i < 3; i++)
        colour[i] = thing < 0 ? (float)(0.3 + 0.2 * i + 0.2 * direction[1]) : dark ? 0.05f : of_thing[thing][i];
}

UNUSED static void gbuffer_alloc(struct gbuffer *gbuffer, int width, int height)
{
    struct error err;
    *gbuffer = (struct gbuffer){0};
    assert_ok(image_alloc(&gbuffer->specular, width, height, 3, &err), err);
    assert_ok(image_alloc(&gbuffer->position, width, height, 3, &err), err);
    assert_ok(image_alloc(&gbuffer->endpoint, width, height, 4, &err), err);
    assert_ok(image_alloc(&gbuffer->phong, width, height, 1, &err), err);
}

/* A view angle for scene_draw at which a lobe is some tens of pixels wide, however narrow it is. */
UNUSED static double scene_view_angle(double phong)
{
    return fmin(1.1, 6 * lobe_half_angle(phong, 0.99, 1.5));
}

/* Pixels of a floor that all see the same direction: every weight is 1. */
UNUSED static void flat_gbuffer(struct gbuffer *gbuffer, int width, int height, float phong)
{
    gbuffer_alloc(gbuffer, width, height);
    gbuffer->has_eye = true;
    gbuffer->view_angle = 1;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            image_row(&gbuffer->position, 0, y)[x] = (float)x;
            image_row(&gbuffer->position, 2, y)[x] = (float)y;
            image_row(&gbuffer->endpoint, 1, y)[x] = 1;
            image_row(&gbuffer->phong, 0, y)[x] = phong;
        }
}

UNUSED static void scene_draw(const struct scene *scene, int width, int height, float phong, struct gbuffer *gbuffer)
{
    const double eye[3] = {0.2, 1.2, -3}, view_angle = scene->view_angle > 0 ? scene->view_angle : 1.1;
    gbuffer_alloc(gbuffer, width, height);
    gbuffer->has_eye = true;
    gbuffer->view_angle = (float)view_angle;
    for (int i = 0; i < 3; i++)
        gbuffer->eye[i] = (float)(eye[i] * scene->scale);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double side = 2 * tan(view_angle / 2) / width, length, hit;
            double ray[3] = {(x + 0.5 - width / 2.0) * side, -0.25 - (y + 0.5 - height / 2.0) * side, 1};
            double a[3], normal[3] = {0, 1, 0}, mirror[3], b[3], dot = 0;
            int thing;
            length = sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
            for (int i = 0; i < 3; i++)
                ray[i] /= length;
            hit = scene_hit(scene, eye, ray, &thing);
            if (thing != 3 && !(thing == 2 && scene->ball))
                continue;
            for (int i = 0; i < 3; i++) {
                a[i] = eye[i] + hit * ray[i];
                if (thing == 2)
                    normal[i] = (a[i] - scene_balls[2].centre[i]) / scene_balls[2].radius;
                dot += ray[i] * normal[i];
            }
            for (int i = 0; i < 3; i++)
                mirror[i] = ray[i] - 2 * dot * normal[i];
            hit = scene_hit(scene, a, mirror, &thing);
            float colour[3];
            for (int i = 0; i < 3; i++)
                b[i] = thing < 0 ? mirror[i] : a[i] + hit * mirror[i];
            scene_colour(thing, b, mirror, colour);
            for (int i = 0; i < 3; i++) {
                image_row(&gbuffer->specular, i, y)[x] = colour[i];
                image_row(&gbuffer->position, i, y)[x] = (float)(a[i] * scene->scale);
                image_row(&gbuffer->endpoint, i, y)[x] = (float)(thing < 0 ? b[i] : b[i] * scene->scale);
            }
            image_row(&gbuffer->endpoint, 3, y)[x] = thing >= 0;
            image_row(&gbuffer->phong, 0, y)[x] = phong;
        }
}

UNUSED static bool scene_glossy(const struct gbuffer *gbuffer, int x, int y)
{
    return image_row(&gbuffer->phong, 0, y)[x] > 0;
}

/* Cosine of the angle at a(x, y) between the endpoints of (x, y) and (u, v), in double. */
UNUSED static double oracle_cosine(const struct gbuffer *gbuffer, int x, int y, int u, int v)
{
    double w1 = (double)image_row(&gbuffer->endpoint, 3, y)[x], w2 = (double)image_row(&gbuffer->endpoint, 3, v)[u];
    double dot = 0, square1 = 0, square2 = 0;
    for (int i = 0; i < 3; i++) {
        double a = (double)image_row(&gbuffer->position, i, y)[x];
        double d1 = (double)image_row(&gbuffer->endpoint, i, y)[x] - w1 * a;
        double d2 = (double)image_row(&gbuffer->endpoint, i, v)[u] - w2 * a;
        dot += d1 * d2;
        square1 += d1 * d1;
        square2 += d2 * d2;
    }
    return dot / sqrt(square1 * square2);
}

typedef double oracle_weight(double phong, double cosine);

/* Equation (1) at a glossy pixel, all pixels by all pixels; returns the sum of the weights. */
UNUSED static double oracle_pixel(const struct gbuffer *gbuffer, double radius, bool square, oracle_weight *weight,
                                  int x, int y, double colour[3])
{
    double sum = 0, phong = (double)image_row(&gbuffer->phong, 0, y)[x];
    colour[0] = colour[1] = colour[2] = 0;
    for (int v = 0; v < gbuffer->phong.height; v++)
        for (int u = 0; u < gbuffer->phong.width; u++) {
            double dx = u - x, dy = v - y;
            double separation = square ? fmax(dx * dx, dy * dy) : dx * dx + dy * dy;
            if (separation > radius * radius || !scene_glossy(gbuffer, u, v))
                continue;
            double f = u == x && v == y ? 1 : weight(phong, oracle_cosine(gbuffer, x, y, u, v));
            sum += f;
            for (int i = 0; i < 3; i++)
                colour[i] += f * (double)image_row(&gbuffer->specular, i, v)[u];
        }
    for (int i = 0; i < 3; i++)
        colour[i] /= sum;
    return sum;
}

/* Unit direction at a(x, y) to the endpoint of (u, v); returns the distance, 1 for a direction. */
UNUSED static double oracle_direction(const struct gbuffer *gbuffer, int x, int y, int u, int v, double direction[3])
{
    double w = (double)image_row(&gbuffer->endpoint, 3, v)[u], square = 0;
    for (int i = 0; i < 3; i++) {
        direction[i] = (double)image_row(&gbuffer->endpoint, i, v)[u] / (w > 0 ? w : 1) -
                       (w > 0 ? (double)image_row(&gbuffer->position, i, y)[x] : 0);
        square += direction[i] * direction[i];
    }
    for (int i = 0; i < 3; i++)
        direction[i] /= sqrt(square);
    return w > 0 ? sqrt(square) : 1;
}

UNUSED static bool oracle_inside(const struct gbuffer *gbuffer, int x, int y)
{
    return x >= 0 && y >= 0 && x < gbuffer->phong.width && y < gbuffer->phong.height && scene_glossy(gbuffer, x, y);
}

/* The best filter's area of a pixel: the cross product of its ray's shifts to the neighbours that shift it less. */
UNUSED static double oracle_area(const struct gbuffer *gbuffer, int x, int y)
{
    double own[3], step[2][3] = {{0}}, length[2] = {INFINITY, INFINITY};
    double distance = oracle_direction(gbuffer, x, y, x, y, own), area;
    for (int axis = 0; axis < 2; axis++)
        for (int sign = -1; sign <= 1; sign += 2) {
            int u = x + (axis ? 0 : sign), v = y + (axis ? sign : 0);
            double moved[3], along = 0, size = 0;
            if (!oracle_inside(gbuffer, u, v))
                continue;
            oracle_direction(gbuffer, u, v, u, v, moved);
            for (int i = 0; i < 3; i++) {
                const struct image *position = &gbuffer->position;
                double from = (double)image_row(position, i, v)[u] - (double)image_row(position, i, y)[x];
                bool is_position = image_row(&gbuffer->endpoint, 3, y)[x] > 0;
                moved[i] = sign * ((is_position ? from : 0) + distance * (moved[i] - own[i]));
                along += moved[i] * own[i];
            }
            for (int i = 0; i < 3; i++) {
                moved[i] -= along * own[i];
                size += moved[i] * moved[i];
            }
            if (sqrt(size) >= length[axis])
                continue;
            length[axis] = sqrt(size);
            memcpy(step[axis], moved, sizeof moved);
        }
    if (isinf(length[0]) || isinf(length[1])) {
        double side = fmin(length[0], length[1]);
        area = isinf(side) ? 0 : side * side;
    } else {
        const double *s = step[0], *t = step[1];
        area = sqrt(pow(s[1] * t[2] - s[2] * t[1], 2) + pow(s[2] * t[0] - s[0] * t[2], 2) +
                    pow(s[0] * t[1] - s[1] * t[0], 2));
    }
    return fmax(area, 1e-12 * distance * distance);
}

/* tan^2 of the angle at a(x, y) between two endpoints; infinite from 90 degrees on. */
UNUSED static double oracle_tangent(const struct gbuffer *gbuffer, int x, int y, int u, int v)
{
    double one[3], other[3], cosine = 0, sine = 0;
    oracle_direction(gbuffer, x, y, x, y, one);
    oracle_direction(gbuffer, x, y, u, v, other);
    for (int i = 0; i < 3; i++)
        cosine += one[i] * other[i];
    for (int i = 0; i < 3; i++)
        sine += (other[i] - cosine * one[i]) * (other[i] - cosine * one[i]);
    return cosine > 0 ? sine / (cosine * cosine) : INFINITY;
}

/* Square of the least angle between the mirror directions of neighbours, with the margin of 1.5. */
UNUSED static double oracle_gradient(const struct gbuffer *gbuffer, int x, int y)
{
    double own[3], least = INFINITY;
    oracle_direction(gbuffer, x, y, x, y, own);
    for (int n = 0; n < 4; n++) {
        int u = x + (n == 0) - (n == 1), v = y + (n == 2) - (n == 3);
        double other[3], square = 0;
        if (!oracle_inside(gbuffer, u, v))
            continue;
        oracle_direction(gbuffer, u, v, u, v, other);
        for (int i = 0; i < 3; i++)
            square += (other[i] - own[i]) * (other[i] - own[i]);
        least = fmin(least, square);
    }
    return isinf(least) ? 0 : least / 2.25;
}

/* The best filter at a glossy pixel, ring by ring over the whole picture; radius is that of equation (5).
 * `ways`: width * height doubles, `areas` oracle_area of every pixel. Returns the confidence. */
UNUSED static double oracle_best_pixel(const struct gbuffer *gbuffer, const struct filter_options *options,
                                       double radius, const double *areas, double *ways, int x, int y,
                                       double colour[3])
{
    const int width = gbuffer->phong.width, height = gbuffer->phong.height;
    const double pi = 3.14159265358979324, floor_weight = 1 - options->energy;
    const double phong = (double)image_row(&gbuffer->phong, 0, y)[x], own_area = areas[y * width + x];
    double own[3];
    const double own_distance = oracle_direction(gbuffer, x, y, x, y, own);
    const double own_solid = own_area / (own_distance * own_distance + own_area / (2 * pi));
    const double pixels = 2 * pi / (phong + 1) / own_solid, p = phong / (1 + 1 / (pixels + 0.125));
    const double reach = pow(floor_weight, -2 / p) - 1, blind = 1.21 * fmin(pow(floor_weight, -2 / phong) - 1, 0x1p99);
    const double gradient = oracle_gradient(gbuffer, x, y), pooled = fmin(radius, 32 + sqrt(pixels));
    double seen[4] = {0}, pool[4] = {0}, low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY}, square = 0, place[3] = {0}, second[3][3] = {{0}};
    double radiance_place[3][3] = {{0}};
    for (int m = 0; m < (width > height ? width : height); m++)
        for (int v = y - m; v <= y + m; v++)
            for (int u = x - m; u <= x + m; u++) {
                int dx = u - x, dy = v - y, away = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
                if (away != m || u < 0 || v < 0 || u >= width || v >= height)
                    continue;
                /* Between the two pixels of the ring within that the line passes between, or the one that it meets. */
                double before = 0;
                if (m > 0) {
                    double along = (double)(m - 1) / m;
                    int u0 = (int)floor(dx * along), u1 = (int)ceil(dx * along);
                    int v0 = (int)floor(dy * along), v1 = (int)ceil(dy * along);
                    double near = fmax(fabs(dx * along - u0), fabs(dy * along - v0));
                    before = (1 - near) * ways[(y + v0) * width + x + u0] + near * ways[(y + v1) * width + x + u1];
                }
                if (!scene_glossy(gbuffer, u, v)) {
                    double way = (gradient * (dx * dx + dy * dy) / blind - 0.3) / 0.7;
                    ways[v * width + u] = fmin(fmax(before, way), 1);
                    continue;
                }
                double t = oracle_tangent(gbuffer, x, y, u, v), area = areas[v * width + u], direction[3];
                double from_own = oracle_direction(gbuffer, u, v, u, v, direction);
                double distance = oracle_direction(gbuffer, x, y, u, v, direction);
                double nearest = fmax(distance * distance, from_own * from_own / 10);
                double solid = area / (nearest + area / (2 * pi)), weight = pow(1 + t, -p / 2);
                ways[v * width + u] = fmin(fmax(before, (t / blind - 0.3) / 0.7), 1);
                double f = t <= reach ? (1 - ways[v * width + u]) * fmax(weight - floor_weight, 0) * solid : 0;
                double cosine_at = 0, sum = 0, at[3];
                for (int i = 0; i < 3; i++) {
                    cosine_at += direction[i] * own[i];
                    sum += (double)image_row(&gbuffer->specular, i, v)[u];
                }
                square += f * sum * sum;
                for (int i = 0; i < 3; i++)
                    at[i] = cosine_at * (direction[i] - cosine_at * own[i]);
                for (int i = 0; i < 3; i++) {
                    place[i] += f * at[i];
                    for (int j = 0; j < 3; j++)
                        second[i][j] += f * at[i] * at[j];
                }
                for (int i = 0; i < 4; i++) {
                    double value = i < 3 ? (double)image_row(&gbuffer->specular, i, v)[u] : 1;
                    seen[i] += f * value;
                    if (i < 3 && f > 0) {
                        low[i] = fmin(low[i], value);
                        high[i] = fmax(high[i], value);
                    }
                    for (int j = 0; j < 3 && i < 3; j++)
                        radiance_place[i][j] += f * value * cosine_at * (direction[j] - cosine_at * own[j]);
                    pool[i] += dx * dx + dy * dy <= pooled * pooled ? weight * solid * value : 0;
                }
            }
    double cosine = pow(floor_weight, 1 / p);
    double cut = 2 * pi * ((1 - cosine * floor_weight) / (p + 1) - floor_weight * (1 - cosine));
    double narrow = 0, faded = 0; /* a narrow lobe's integral, and with what it hides of itself */
    for (int i = 0; i < 2000; i++) {
        double end = -log(floor_weight), at = end * (i + 0.5) / 2000, f = exp(-at) - floor_weight;
        narrow += f;
        faded += f * fmin((1 - at / end / 1.21) / 0.7, 1);
    }
    cut *= faded / narrow;
    double share = fmax(pow(4 / (pixels + 4), 2) - 1.0 / 64, 0) + 0.5 * fmax(0.93 * cut - seen[3], 0) / pool[3];
    if (pooled < 1)
        share = 0;
    /* Normal equations of the plane, in space: the slope has no part along the direction, where second is 0. */
    double matrix[3][4], slope[3] = {0}, confidence = fmin(seen[3] / cut, 1);
    double contrast = square * seen[3] / pow(seen[0] + seen[1] + seen[2], 2), dimmed = contrast > 3 ? 3 / contrast : 1;
    for (int channel = 0; channel < 3; channel++) {
        double mean = seen[channel] / seen[3], value = mean;
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++)
                matrix[i][j] = second[i][j] / seen[3] - place[i] * place[j] / seen[3] / seen[3] +
                               (i == j ? 0.3 / (p + 3) : 0);
            matrix[i][3] = (radiance_place[channel][i] - mean * place[i]) / seen[3];
        }
        for (int i = 0; i < 3; i++) /* Gauss and Jordan: the matrix is positive definite */
            for (int k = 0; k < 3; k++)
                for (int j = 3; k != i && j >= i; j--)
                    matrix[k][j] -= matrix[k][i] / matrix[i][i] * matrix[i][j];
        for (int i = 0; i < 3; i++) {
            slope[i] = matrix[i][3] / matrix[i][i];
            value -= dimmed * slope[i] * place[i] / seen[3];
        }
        if (!(options->without & FILTER_WITHOUT_FIT))
            value = fmax(low[channel], fmin(value, high[channel]));
        else
            value = mean;
        value = (value * seen[3] + share * pool[channel]) / (seen[3] + share * pool[3]);
        if (dimmed < 1 && !(options->without & FILTER_WITHOUT_FIT))
            value = confidence * value + (1 - confidence) * fmax(low[channel], fmin(dimmed * value, high[channel]));
        colour[channel] = value;
    }
    return confidence;
}

/* Largest relative error of a result's channels; infinite for NaN. Black may be exactly black. */
UNUSED static double oracle_colour_error(const struct image *glossy, int x, int y, const double expected[3])
{
    double worst = 0;
    for (int i = 0; i < 3; i++) {
        double difference = fabs((double)image_row(glossy, i, y)[x] - expected[i]);
        worst = fmax(worst, isnan(difference) ? INFINITY : difference == 0 ? 0 : difference / fabs(expected[i]));
    }
    return worst;
}

/* Errors of the best filter at every `stride`-th glossy pixel, width * height of them at most: the largest of the
 * channels', relative to their values, and the confidence's. Returns how many. */
UNUSED static int oracle_best_errors(const struct gbuffer *gbuffer, const struct filter_options *options, int stride,
                                     double *errors)
{
    struct image glossy, confidence, radius;
    struct filter_options paper = *options;
    const int width = gbuffer->phong.width, height = gbuffer->phong.height;
    double *areas = malloc(2 * (size_t)width * (size_t)height * sizeof *areas), *ways = areas + width * height;
    int glossy_count = 0, count = 0;
    paper.mode = FILTER_MODE_PAPER;
    filter_run(gbuffer, &paper, &glossy, &radius);
    image_free(&glossy);
    filter_run(gbuffer, options, &glossy, &confidence);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            areas[y * width + x] = scene_glossy(gbuffer, x, y) ? oracle_area(gbuffer, x, y) : 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            if (!scene_glossy(gbuffer, x, y) || glossy_count++ % stride != 0)
                continue;
            double expected[3], r = (double)image_row(&radius, 0, y)[x];
            double error = fabs(oracle_best_pixel(gbuffer, options, r, areas, ways, x, y, expected) -
                                (double)image_row(&confidence, 0, y)[x]);
            errors[count++] = fmax(error, oracle_colour_error(&glossy, x, y, expected));
        }
    image_free(&glossy);
    image_free(&confidence);
    image_free(&radius);
    free(areas);
    return count;
}

/* The same of equation (1). */
UNUSED static int oracle_errors(const struct gbuffer *gbuffer, const struct filter_options *options,
                                oracle_weight *weight, int stride, double *errors)
{
    struct image glossy, radius;
    int glossy_count = 0, count = 0;
    filter_run(gbuffer, options, &glossy, &radius);
    for (int y = 0; y < glossy.height; y++)
        for (int x = 0; x < glossy.width; x++) {
            if (!scene_glossy(gbuffer, x, y) || glossy_count++ % stride != 0)
                continue;
            double expected[3], r = (double)image_row(&radius, 0, y)[x];
            oracle_pixel(gbuffer, r, options->window == FILTER_WINDOW_SQUARE, weight, x, y, expected);
            errors[count++] = oracle_colour_error(&glossy, x, y, expected);
        }
    image_free(&glossy);
    image_free(&radius);
    return count;
}

UNUSED static double *errors_alloc(const struct gbuffer *gbuffer)
{
    double *errors = malloc((size_t)gbuffer->phong.width * (size_t)gbuffer->phong.height * sizeof *errors);
    assert_non_null(errors);
    return errors;
}

/* The largest; frees them. */
UNUSED static double errors_worst(double *errors, int count)
{
    double worst = 0;
    assert_true(count > 0);
    for (int i = 0; i < count; i++)
        worst = fmax(worst, errors[i]);
    free(errors);
    return worst;
}

UNUSED static double oracle_best_error(const struct gbuffer *gbuffer, const struct filter_options *options, int stride)
{
    double *errors = errors_alloc(gbuffer);
    return errors_worst(errors, oracle_best_errors(gbuffer, options, stride, errors));
}

UNUSED static double oracle_error(const struct gbuffer *gbuffer, const struct filter_options *options,
                                  oracle_weight *weight, int stride)
{
    double *errors = errors_alloc(gbuffer);
    return errors_worst(errors, oracle_errors(gbuffer, options, weight, stride, errors));
}

#endif
