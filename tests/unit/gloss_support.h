/* What the tests of the filter share: a synthetic scene, the oracle of equation (1), and strict assertions. */
#ifndef POVGLOSS_GLOSS_SUPPORT_H
#define POVGLOSS_GLOSS_SUPPORT_H

#include "filter.h"

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

/* Largest relative difference of the filter's result from the oracle, over every `stride`-th glossy pixel. */
UNUSED static double oracle_error(const struct gbuffer *gbuffer, const struct filter_options *options,
                                  oracle_weight *weight, int stride)
{
    struct image glossy, radius;
    struct error err;
    double worst = 0;
    int count = 0;
    assert_ok(filter_glossy(gbuffer, options, &glossy, &radius, &err), err);
    for (int y = 0; y < glossy.height; y++)
        for (int x = 0; x < glossy.width; x++) {
            if (!scene_glossy(gbuffer, x, y) || count++ % stride != 0)
                continue;
            double expected[3], r = (double)image_row(&radius, 0, y)[x];
            oracle_pixel(gbuffer, r, options->window == FILTER_WINDOW_SQUARE, weight, x, y, expected);
            for (int i = 0; i < 3; i++) {
                double difference = fabs((double)image_row(&glossy, i, y)[x] - expected[i]);
                double error = difference == 0 ? 0 : difference / fabs(expected[i]); /* black may be exactly black */
                if (!(error <= worst))
                    worst = isnan(error) ? INFINITY : error;
            }
        }
    assert_true(count > 0);
    image_free(&glossy);
    image_free(&radius);
    return worst;
}

#endif
