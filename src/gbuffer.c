/* A gbuffer is a bundle of images: what says that a pixel is glossy, and their end. */
#include "gbuffer.h"

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
