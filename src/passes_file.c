/* The passes file: which channels of an EXR make which plane of a gbuffer, in one table for both directions. */
#include "passes_file.h"

#include "exr_io.h"
#include "input_file.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

enum { MAX_GROUP = 4, GROUP_COUNT = 6 };

static const struct group {
    const char *names[MAX_GROUP];
    int count;
    size_t image; /* offset in struct gbuffer */
    bool required;
    const char *meaning;
} groups[GROUP_COUNT] = {
    {{"R", "G", "B"}, 3, offsetof(struct gbuffer, base), false, "the image without the glossy reflection, linear"},
    {{"specular.R", "specular.G", "specular.B"},
     3,
     offsetof(struct gbuffer, specular),
     true,
     "the radiance along the ideal mirror direction, linear"},
    {{"reflectance.R", "reflectance.G", "reflectance.B"},
     3,
     offsetof(struct gbuffer, reflectance),
     false,
     "reflectivity times coverage"},
    {{"P.X", "P.Y", "P.Z"}, 3, offsetof(struct gbuffer, position), true, "the position of the visible point"},
    {{"endpoint.X", "endpoint.Y", "endpoint.Z", "endpoint.W"},
     4,
     offsetof(struct gbuffer, endpoint),
     true,
     "the end of the mirrored ray; W is 1 for a position and 0 for a direction"},
    {{"phong.V"}, 1, offsetof(struct gbuffer, phong), false, "the Phong exponent"},
};

/* Copies the planes of a group; a group that is not there leaves an empty image. */
static enum result read_group(const char *path, const struct exr_contents *contents, const struct group *group,
                              struct image *image, struct error *err)
{
    int planes[MAX_GROUP], present = 0;
    const char *missing = NULL;
    for (int i = 0; i < group->count; i++) {
        planes[i] = exr_find(contents, group->names[i]);
        if (planes[i] >= 0)
            present++;
        else if (!missing)
            missing = group->names[i];
    }
    if (!present && !group->required)
        return RESULT_OK;
    if (missing)
        return error_set(err, RESULT_DATA, "%s: has no channel %s (%s: %s to %s); %s",
                         input_file_name(path), missing, group->meaning, group->names[0],
                         group->names[group->count - 1],
                         present ? "all channels of a group are needed" : "a passes file needs it");

    const struct image *from = &contents->image;
    enum result result = image_alloc(image, from->width, from->height, group->count, err);
    if (result)
        return result;
    for (int i = 0; i < group->count; i++)
        memcpy(image_row(image, i, 0), image_row(from, planes[i], 0),
               from->stride * (size_t)from->height * sizeof(float));
    return RESULT_OK;
}

static enum result check_attributes(const char *path, const struct exr_attributes *attributes, struct error *err)
{
    const char *name = input_file_name(path);
    for (int i = 0; i < 3; i++)
        if (attributes->has_eye && !isfinite(attributes->eye[i]))
            return error_set(err, RESULT_DATA, "%s: attribute povgloss:eye must be finite", name);
    double full_turn = 2 * acos(-1);
    if (!(attributes->view_angle >= 0 && attributes->view_angle <= full_turn))
        return error_set(err, RESULT_DATA, "%s: attribute povgloss:viewAngle is %g, and must be from 0 to 2 pi radians",
                         name, (double)attributes->view_angle);
    float gamma = attributes->working_gamma;
    if (!(gamma >= 0 && isfinite(gamma)) && gamma != GBUFFER_GAMMA_SRGB)
        return error_set(err, RESULT_DATA,
                         "%s: attribute povgloss:workingGamma is %g, and must be an exponent above 0 or %g for sRGB",
                         name, (double)gamma, (double)GBUFFER_GAMMA_SRGB);
    return RESULT_OK;
}

enum result passes_file_read(const char *path, struct gbuffer *gbuffer, struct error *err)
{
    *gbuffer = (struct gbuffer){0};
    struct exr_contents contents;
    enum result result = exr_read(path, &contents, err);
    if (result)
        return result;
    const struct exr_attributes *attributes = &contents.attributes;
    result = check_attributes(path, attributes, err);
    for (int i = 0; i < GROUP_COUNT && !result; i++)
        result = read_group(path, &contents, &groups[i], (struct image *)((char *)gbuffer + groups[i].image), err);
    if (result)
        goto out;
    gbuffer->has_eye = attributes->has_eye;
    memcpy(gbuffer->eye, attributes->eye, sizeof gbuffer->eye);
    gbuffer->view_angle = attributes->view_angle;
    gbuffer->working_gamma = attributes->working_gamma;
out:
    exr_contents_free(&contents);
    if (result)
        gbuffer_free(gbuffer);
    return result;
}

enum result passes_file_write(const char *path, const struct gbuffer *gbuffer, struct error *err)
{
    struct exr_channel channels[GROUP_COUNT * MAX_GROUP];
    int count = 0;
    for (int i = 0; i < GROUP_COUNT; i++) {
        const struct image *image = (const struct image *)((const char *)gbuffer + groups[i].image);
        if (!image->pixels)
            continue;
        assert(image->channels == groups[i].count);
        for (int channel = 0; channel < groups[i].count; channel++) {
            channels[count] = (struct exr_channel){.image = image, .channel = channel};
            strcpy(channels[count].name, groups[i].names[channel]);
            count++;
        }
    }
    struct exr_attributes attributes = {.has_eye = gbuffer->has_eye,
                                        .view_angle = gbuffer->view_angle,
                                        .working_gamma = gbuffer->working_gamma};
    memcpy(attributes.eye, gbuffer->eye, sizeof attributes.eye);
    return exr_write(path, channels, count, &attributes, err);
}
