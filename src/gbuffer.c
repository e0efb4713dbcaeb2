/* A gbuffer is a bundle of images; here they are freed together. */
#include "gbuffer.h"

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
    *gbuffer = (struct gbuffer){0};
}
