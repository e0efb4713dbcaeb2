/* The public face of the library: planes of the caller's in, the filter, planes of the caller's out. */
#include "gloss.h"

#include "filter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t row_stride(const struct gloss_planes *planes)
{
    return planes->stride ? planes->stride : (size_t)planes->width;
}

/* Copies `count` planes, all of which must be there. */
static enum result take(const struct gloss_planes *planes, const float *const *from, int count, const char *name,
                        struct image *image, struct error *err)
{
    for (int i = 0; i < count; i++)
        if (!from[i])
            return error_set(err, RESULT_USAGE, "plane %d of %s is missing", i, name);
    enum result result = image_alloc(image, planes->width, planes->height, count, err);
    for (int i = 0; i < count && !result; i++)
        for (int y = 0; y < planes->height; y++)
            memcpy(image_row(image, i, y), from[i] + row_stride(planes) * (size_t)y,
                   (size_t)planes->width * sizeof(float));
    return result;
}

static enum result take_all(const struct gloss_planes *planes, struct gbuffer *gbuffer, struct error *err)
{
    if (planes->stride && planes->width > 0 && planes->stride < (size_t)planes->width)
        return error_set(err, RESULT_USAGE, "a stride of %zu floats is less than the width", planes->stride);
    enum result result = take(planes, planes->specular, 3, "specular", &gbuffer->specular, err);
    if (!result)
        result = take(planes, planes->position, 3, "position", &gbuffer->position, err);
    if (!result)
        result = take(planes, planes->endpoint, 4, "endpoint", &gbuffer->endpoint, err);
    if (!result && planes->phong)
        result = take(planes, &planes->phong, 1, "phong", &gbuffer->phong, err);
    if (!result && planes->reflectance[0])
        result = take(planes, planes->reflectance, 3, "reflectance", &gbuffer->reflectance, err);
    bool finite = isfinite(planes->view_angle) && planes->view_angle >= 0;
    for (int i = 0; i < 3 && planes->eye; i++)
        finite = finite && isfinite(planes->eye[i]);
    if (!result && !finite)
        result = error_set(err, RESULT_USAGE, "the eye or the view angle isn't finite, or the angle is below 0");
    if (planes->eye) {
        gbuffer->has_eye = true;
        memcpy(gbuffer->eye, planes->eye, sizeof gbuffer->eye);
    }
    gbuffer->view_angle = planes->view_angle;
    return result;
}

static enum result take_options(const struct gloss_options *from, struct filter_options *options, struct error *err)
{
    if (!(from->phong >= 0) || from->max_radius_px < 0 || from->threads < 0)
        return error_set(err, RESULT_USAGE, "an exponent, limit of the radius or number of threads is below 0 or NaN");
    options->phong = from->phong;
    options->phong_override = from->phong_for_all;
    options->max_radius_px = from->max_radius_px;
    options->threads = from->threads;
    return RESULT_OK;
}

struct gloss {
    struct gbuffer gbuffer;
    struct filter *filter;
    size_t stride;
};

static enum gloss_status status_of(enum result result, const struct error *err, char *message, size_t message_size)
{
    if (message_size > 0)
        snprintf(message, message_size, "%s", err->text);
    return (enum gloss_status)result;
}

enum gloss_status gloss_open(const struct gloss_planes *planes, struct gloss **gloss, char *message,
                             size_t message_size)
{
    struct error err = {""};
    *gloss = calloc(1, sizeof **gloss);
    enum result result = *gloss ? RESULT_OK : error_memory(&err, sizeof **gloss);
    if (!result)
        result = take_all(planes, &(*gloss)->gbuffer, &err);
    if (!result)
        result = filter_open(&(*gloss)->gbuffer, &(*gloss)->filter, &err);
    if (!result)
        (*gloss)->stride = row_stride(planes);
    if (result) {
        gloss_close(*gloss);
        *gloss = NULL;
    }
    return status_of(result, &err, message, message_size);
}

enum gloss_status gloss_apply(struct gloss *gloss, const struct gloss_options *options, float *const glossy[3],
                              char *message, size_t message_size)
{
    struct filter_options filter = filter_options_default();
    struct image blurred = {0};
    struct error err = {""};
    enum result result = take_options(options, &filter, &err);
    if (!result)
        result = filter_apply(gloss->filter, &filter, &blurred, NULL, &err);
    for (int i = 0; i < 3 && !result; i++)
        for (int y = 0; y < blurred.height; y++)
            memcpy(glossy[i] + gloss->stride * (size_t)y, image_row(&blurred, i, y),
                   (size_t)blurred.width * sizeof(float));
    image_free(&blurred);
    return status_of(result, &err, message, message_size);
}

void gloss_close(struct gloss *gloss)
{
    if (!gloss)
        return;
    filter_close(gloss->filter);
    gbuffer_free(&gloss->gbuffer);
    free(gloss);
}

enum gloss_status gloss_filter(const struct gloss_planes *planes, const struct gloss_options *options,
                               float *const glossy[3], char *message, size_t message_size)
{
    struct gloss *gloss;
    enum gloss_status status = gloss_open(planes, &gloss, message, message_size);
    if (!status)
        status = gloss_apply(gloss, options, glossy, message, message_size);
    gloss_close(gloss);
    return status;
}
