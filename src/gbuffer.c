/* A gbuffer is a bundle of images: how they are joined, what says that a pixel is glossy, and their end. */
#include "gbuffer.h"

#include <string.h>

enum { PLANES = 7 };

static void list_planes(struct gbuffer *gbuffer, struct image *planes[PLANES])
{
    struct image *const all[PLANES] = {&gbuffer->base,     &gbuffer->specular, &gbuffer->reflectance,
                                       &gbuffer->position, &gbuffer->endpoint, &gbuffer->phong,
                                       &gbuffer->rays};
    memcpy(planes, all, sizeof all);
}

static bool is_empty(struct image *const planes[PLANES], int x, int y)
{
    for (int i = 0; i < PLANES; i++)
        for (int channel = 0; channel < planes[i]->channels; channel++)
            if (image_row(planes[i], channel, y)[x] != 0)
                return false;
    return true;
}

static enum result check_planes(struct image *const to[PLANES], struct image *const from[PLANES], struct error *err)
{
    for (int i = 0; i < PLANES; i++) {
        if (to[i]->channels != from[i]->channels)
            return error_set(err, RESULT_DATA, "bands of one picture have the same channels, and these have not");
        if (to[i]->width != from[i]->width || to[i]->height != from[i]->height)
            return error_set(err, RESULT_DATA,
                             "bands of one picture have its whole size, and these are %d x %d and %d x %d pixels",
                             to[i]->width, to[i]->height, from[i]->width, from[i]->height);
    }
    return RESULT_OK;
}

enum result gbuffer_join(struct gbuffer *whole, struct gbuffer *part, struct error *err)
{
    struct image *to[PLANES], *from[PLANES];
    list_planes(whole, to);
    list_planes(part, from);
    enum result result = check_planes(to, from, err);
    for (int y = 0; !result && y < whole->specular.height; y++)
        for (int x = 0; x < whole->specular.width; x++)
            for (int i = is_empty(to, x, y) ? 0 : PLANES; i < PLANES; i++)
                for (int channel = 0; channel < to[i]->channels; channel++)
                    image_row(to[i], channel, y)[x] = image_row(from[i], channel, y)[x];
    if (!whole->has_eye && part->has_eye) {
        whole->has_eye = true;
        memcpy(whole->eye, part->eye, sizeof whole->eye);
    }
    whole->view_angle = whole->view_angle > 0 ? whole->view_angle : part->view_angle;
    gbuffer_free(part);
    return result;
}

bool gbuffer_is_glossy(const struct gbuffer *gbuffer, int x, int y)
{
    if (gbuffer->phong.pixels && !(image_row(&gbuffer->phong, 0, y)[x] > 0))
        return false;
    for (int i = 0; i < 4; i++)
        if (image_row(&gbuffer->endpoint, i, y)[x] != 0)
            return true;
    return false;
}

void gbuffer_free(struct gbuffer *gbuffer)
{
    image_free(&gbuffer->base);
    image_free(&gbuffer->specular);
    image_free(&gbuffer->reflectance);
    image_free(&gbuffer->position);
    image_free(&gbuffer->endpoint);
    image_free(&gbuffer->phong);
    image_free(&gbuffer->direction);
    image_free(&gbuffer->mirrored);
    image_free(&gbuffer->rays);
    *gbuffer = (struct gbuffer){0};
}
