/* The finished picture: base + reflectance * glossy, in the space in which the renderer would have added them.
 *
 * POV-Ray adds colours of its assumed_gamma; its linear output is their g-th power.
 */
#include "compose.h"

#include "gamma.h"

static float compose_one(float base, float reflectance, float glossy, double gamma)
{
    if (reflectance == 0 || glossy == 0)
        return base;
    double sum = gamma_encode(gamma, (double)base) + (double)reflectance * gamma_encode(gamma, (double)glossy);
    return (float)gamma_decode(gamma, sum);
}

static enum result check_size(const struct image *image, const char *name, const struct image *size, struct error *err)
{
    if (!image->pixels || (image->width == size->width && image->height == size->height && image->channels >= 3))
        return RESULT_OK;
    return error_set(err, RESULT_DATA, "the %s pass is %d x %d pixels of %d channels, not %d x %d of 3", name,
                     image->width, image->height, image->channels, size->width, size->height);
}

enum result compose(const struct gbuffer *gbuffer, const struct image *glossy, struct image *image, struct error *err)
{
    *image = (struct image){0};
    enum result result = check_size(&gbuffer->base, "base", glossy, err);
    if (result == RESULT_OK)
        result = check_size(&gbuffer->reflectance, "reflectance", glossy, err);
    if (result == RESULT_OK)
        result = image_alloc(image, glossy->width, glossy->height, 3, err);
    if (result != RESULT_OK)
        return result;
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < image->height; y++) {
            const float *base = gbuffer->base.pixels ? image_row(&gbuffer->base, i, y) : NULL;
            const float *reflectance = gbuffer->reflectance.pixels ? image_row(&gbuffer->reflectance, i, y) : NULL;
            const float *reflection = image_row(glossy, i, y);
            float *out = image_row(image, i, y);
            for (int x = 0; x < image->width; x++)
                out[x] = compose_one(base ? base[x] : 0, reflectance ? reflectance[x] : 1, reflection[x],
                                     (double)gbuffer->working_gamma);
        }
    return RESULT_OK;
}
