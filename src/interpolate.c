/* Bilinear interpolation among glossy samples only, so that nothing of what isn't glossy bleeds in. */
#include "interpolate.h"

#include <math.h>

struct sample {
    int x, y;
    float weight;
};

/* The glossy samples with positive weight among the 2x2 around (u, v), in samples; else the nearest of the 4x4. */
static int find_samples(const struct gbuffer *from, double u, double v, struct sample samples[4])
{
    int left = (int)floor(u), top = (int)floor(v), count = 0;
    struct sample nearest = {0};
    double nearest_distance = INFINITY;
    for (int y = top - 1; y <= top + 2; y++)
        for (int x = left - 1; x <= left + 2; x++) {
            if (x < 0 || y < 0 || x >= from->phong.width || y >= from->phong.height ||
                !(image_row(&from->phong, 0, y)[x] > 0))
                continue;
            double weight = fmax(0, 1 - fabs(u - x)) * fmax(0, 1 - fabs(v - y)), distance = hypot(u - x, v - y);
            if (weight > 1e-3)
                samples[count++] = (struct sample){x, y, (float)weight};
            if (distance < nearest_distance) {
                nearest_distance = distance;
                nearest = (struct sample){x, y, 1};
            }
        }
    if (count == 0 && nearest_distance < INFINITY)
        samples[count++] = nearest;
    return count;
}

static void mean(const struct image *from, int channels, const struct sample *samples, int count, struct image *to, int x,
                 int y)
{
    for (int channel = 0; channel < channels; channel++) {
        float sum = 0, weight = 0;
        for (int i = 0; i < count; i++) {
            sum += samples[i].weight * image_row(from, channel, samples[i].y)[samples[i].x];
            weight += samples[i].weight;
        }
        image_row(to, channel, y)[x] = sum / weight;
    }
}

/* Positions are averaged as they are. With a miss among the samples all are averaged as unit directions seen from their
 * own a, and the result is a direction. */
static void mean_endpoint(const struct gbuffer *from, const struct sample *samples, int count, struct gbuffer *to, int x,
                          int y)
{
    bool all_positions = true;
    for (int i = 0; i < count; i++)
        all_positions &= image_row(&from->endpoint, 3, samples[i].y)[samples[i].x] > 0;
    mean(&from->endpoint, 4, samples, count, &to->endpoint, x, y);
    if (all_positions)
        return;
    double sum[3] = {0}, length = 0;
    for (int i = 0; i < count; i++) {
        double direction[3], r = 0;
        for (int axis = 0; axis < 3; axis++) {
            direction[axis] = image_row(&from->endpoint, axis, samples[i].y)[samples[i].x] -
                              (double)image_row(&from->endpoint, 3, samples[i].y)[samples[i].x] *
                                  image_row(&from->position, axis, samples[i].y)[samples[i].x];
            r += direction[axis] * direction[axis];
        }
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += samples[i].weight * direction[axis] / sqrt(r > 0 ? r : 1);
    }
    for (int axis = 0; axis < 3; axis++)
        length += sum[axis] * sum[axis];
    for (int axis = 0; axis < 3; axis++)
        image_row(&to->endpoint, axis, y)[x] = (float)(sum[axis] / sqrt(length > 0 ? length : 1));
    image_row(&to->endpoint, 3, y)[x] = 0;
}

static float nearest_exponent(const struct image *phong, const struct sample *samples, int count)
{
    int best = 0;
    for (int i = 1; i < count; i++)
        if (samples[i].weight > samples[best].weight)
            best = i;
    return image_row(phong, 0, samples[best].y)[samples[best].x];
}

enum result interpolate_gbuffer(struct gbuffer *gbuffer, struct error *err)
{
    int width = gbuffer->reflectance.width, height = gbuffer->reflectance.height;
    struct gbuffer to = {0};
    enum result result = image_alloc(&to.specular, width, height, 3, err);
    if (!result)
        result = image_alloc(&to.position, width, height, 3, err);
    if (!result)
        result = image_alloc(&to.endpoint, width, height, 4, err);
    if (!result)
        result = image_alloc(&to.phong, width, height, 1, err);
    if (result) {
        gbuffer_free(&to);
        return result;
    }
    double scale_x = (double)gbuffer->phong.width / width, scale_y = (double)gbuffer->phong.height / height;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            struct sample samples[4];
            bool reflects = image_row(&gbuffer->reflectance, 0, y)[x] > 0 || image_row(&gbuffer->reflectance, 1, y)[x] > 0 ||
                            image_row(&gbuffer->reflectance, 2, y)[x] > 0;
            int count = reflects ? find_samples(gbuffer, (x + 0.5) * scale_x - 0.5, (y + 0.5) * scale_y - 0.5, samples) : 0;
            if (count == 0)
                continue;
            mean(&gbuffer->specular, 3, samples, count, &to.specular, x, y);
            mean(&gbuffer->position, 3, samples, count, &to.position, x, y);
            mean_endpoint(gbuffer, samples, count, &to, x, y);
            image_row(&to.phong, 0, y)[x] = nearest_exponent(&gbuffer->phong, samples, count);
        }
    image_free(&gbuffer->specular);
    image_free(&gbuffer->position);
    image_free(&gbuffer->endpoint);
    image_free(&gbuffer->phong);
    gbuffer->specular = to.specular;
    gbuffer->position = to.position;
    gbuffer->endpoint = to.endpoint;
    gbuffer->phong = to.phong;
    return RESULT_OK;
}
