/* The passes file: the channel groups as the images of a gbuffer, in one table for both directions. */
#include "passes_file.h"

#include "input_file.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

/* The image of each channel group in struct gbuffer. */
static const size_t image_offsets[CHANNEL_GROUPS] = {
    offsetof(struct gbuffer, base),     offsetof(struct gbuffer, specular), offsetof(struct gbuffer, reflectance),
    offsetof(struct gbuffer, position), offsetof(struct gbuffer, endpoint), offsetof(struct gbuffer, phong),
    offsetof(struct gbuffer, rays)};

static enum result refuse_missing(const char *path, const struct channel_group *group, const char *missing,
                                  bool others, struct error *err)
{
    return error_set(err, RESULT_DATA,
                     "%s: has no channel %s (%s: %s to %s); %s; if it goes by another name: --map %s=NAME",
                     input_file_name(path), missing, group->meaning, group->names[0], group->names[group->count - 1],
                     others ? "all channels of a group are needed" : "a passes file needs it", missing);
}

/* Copies the planes of a group; a group that is not there leaves an empty image. */
static enum result read_group(const char *path, const struct exr_contents *contents, const struct channel_group *group,
                              const struct text_list *map, struct image *image, struct passes_names *names,
                              struct error *err)
{
    int planes[CHANNELS_MAX];
    const char *missing;
    enum result result = channels_find(path, contents, group, map, planes, &missing, err);
    if (result)
        return result;
    bool some = false;
    for (int i = 0; i < group->count; i++) {
        some |= planes[i] >= 0;
        if (names && planes[i] >= 0)
            strcpy(names->names[i], contents->names[planes[i]]);
    }
    if (missing && (names || (!some && !group->required)))
        return RESULT_OK;
    if (missing)
        return refuse_missing(path, group, missing, some, err);

    const struct image *from = &contents->image;
    result = image_alloc(image, from->width, from->height, group->count, err);
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

/* The names of the file's channels, for those who look for one. */
static enum result list_channels(const struct exr_contents *contents, struct text_list *channels, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; i < contents->image.channels && !result; i++)
        result = text_list_add(channels, err, "%s", contents->names[i]);
    return result;
}

enum result passes_file_read(const char *path, struct gbuffer *gbuffer, struct error *err)
{
    return passes_file_read_mapped(path, &(struct text_list){0}, gbuffer, NULL, err);
}

enum result passes_file_read_mapped(const char *path, const struct text_list *map, struct gbuffer *gbuffer,
                                    struct passes_found *found, struct error *err)
{
    *gbuffer = (struct gbuffer){0};
    if (found)
        *found = (struct passes_found){0};
    struct exr_contents contents;
    enum result result = exr_read(path, &contents, err);
    if (result)
        return result;
    const struct exr_attributes *attributes = &contents.attributes;
    result = check_attributes(path, attributes, err);
    for (int i = 0; i < CHANNEL_GROUPS && !result; i++) {
        struct image *image = (struct image *)((char *)gbuffer + image_offsets[i]);
        result = read_group(path, &contents, &channel_groups[i], map, image, found ? &found->groups[i] : NULL, err);
    }
    if (!result && found)
        result = list_channels(&contents, &found->channels, err);
    if (result)
        goto out;
    gbuffer->has_eye = attributes->has_eye;
    memcpy(gbuffer->eye, attributes->eye, sizeof gbuffer->eye);
    gbuffer->window = contents.window;
    gbuffer->view_angle =
        (float)((double)attributes->view_angle * contents.image.width / contents.window.width);
    gbuffer->working_gamma = attributes->working_gamma;
out:
    exr_contents_free(&contents);
    if (result) {
        gbuffer_free(gbuffer);
        if (found)
            text_list_free(&found->channels);
    }
    return result;
}

enum result passes_file_write(const char *path, const struct gbuffer *gbuffer, struct error *err)
{
    struct exr_channel channels[CHANNEL_GROUPS * CHANNELS_MAX];
    int count = 0;
    for (int i = 0; i < CHANNEL_GROUPS; i++) {
        const struct image *image = (const struct image *)((const char *)gbuffer + image_offsets[i]);
        if (!image->pixels)
            continue;
        assert(image->channels == channel_groups[i].count);
        for (int channel = 0; channel < channel_groups[i].count; channel++) {
            channels[count] = (struct exr_channel){.image = image, .channel = channel};
            strcpy(channels[count].name, channel_groups[i].names[channel]);
            count++;
        }
    }
    struct exr_attributes attributes = {.has_eye = gbuffer->has_eye,
                                        .view_angle = gbuffer->view_angle,
                                        .working_gamma = gbuffer->working_gamma,
                                        .window = gbuffer->window};
    if (gbuffer->window.width > 0)
        attributes.view_angle = (float)((double)gbuffer->view_angle * gbuffer->window.width / gbuffer->position.width);
    memcpy(attributes.eye, gbuffer->eye, sizeof attributes.eye);
    return exr_write(path, channels, count, &attributes, err);
}
