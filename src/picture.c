/* Of a reduced gbuffer the filter's time falls with the fourth power of the step: fewer pixels, and smaller windows. */
#include "picture.h"

#include "compose.h"

enum result picture_draw(struct filter *filter, const struct filter_options *options, struct image *picture,
                         struct error *err)
{
    const struct gbuffer *gbuffer = filter_gbuffer(filter);
    struct image glossy = {0};
    *picture = (struct image){0};
    enum result result = filter_apply(filter, options, &glossy, NULL, err);
    if (!result)
        result = compose(gbuffer, &glossy, picture, err);
    if (!result && gbuffer->window.width > 0)
        result = image_crop(picture, &gbuffer->window, err);
    image_free(&glossy);
    if (result)
        image_free(picture);
    return result;
}

static int at_least_one(int side)
{
    return side > 1 ? side : 1;
}

/* Of each step x step pixels the one in the middle. */
static enum result reduce(const struct image *image, int step, struct image *reduced, struct error *err)
{
    if (!image->pixels)
        return RESULT_OK;
    enum result result = image_alloc(reduced, at_least_one(image->width / step), at_least_one(image->height / step),
                                     image->channels, err);
    for (int channel = 0; !result && channel < image->channels; channel++)
        for (int y = 0; y < reduced->height; y++) {
            int from_y = y * step + step / 2 < image->height ? y * step + step / 2 : y;
            for (int x = 0; x < reduced->width; x++) {
                int from_x = x * step + step / 2 < image->width ? x * step + step / 2 : x;
                image_row(reduced, channel, y)[x] = image_row(image, channel, from_y)[from_x];
            }
        }
    return result;
}

enum result picture_reduce(const struct gbuffer *gbuffer, int step, struct gbuffer *reduced, struct error *err)
{
    *reduced = (struct gbuffer){.has_eye = gbuffer->has_eye,
                                .eye = {gbuffer->eye[0], gbuffer->eye[1], gbuffer->eye[2]},
                                .view_angle = gbuffer->view_angle,
                                .working_gamma = gbuffer->working_gamma};
    if (gbuffer->window.width > 0)
        reduced->window = (struct image_window){.left = gbuffer->window.left / step,
                                                .top = gbuffer->window.top / step,
                                                .width = at_least_one(gbuffer->window.width / step),
                                                .height = at_least_one(gbuffer->window.height / step)};
    enum result result = reduce(&gbuffer->base, step, &reduced->base, err);
    if (!result)
        result = reduce(&gbuffer->specular, step, &reduced->specular, err);
    if (!result)
        result = reduce(&gbuffer->reflectance, step, &reduced->reflectance, err);
    if (!result)
        result = reduce(&gbuffer->position, step, &reduced->position, err);
    if (!result)
        result = reduce(&gbuffer->endpoint, step, &reduced->endpoint, err);
    if (!result)
        result = reduce(&gbuffer->phong, step, &reduced->phong, err);
    if (!result)
        result = reduce(&gbuffer->rays, step, &reduced->rays, err);
    if (result)
        gbuffer_free(reduced);
    return result;
}
