/* Channels by our names, by the map, or by the aliases of a layer. */
#include "channels.h"

#include "input_file.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

const struct channel_group channel_groups[CHANNEL_GROUPS] = {
    {"base",
     {"R", "G", "B"},
     3,
     false,
     "the image without the glossy reflection, linear",
     "it counts as black: the picture is the reflection alone",
     "base rgb rgba "},
    {"specular",
     {"specular.R", "specular.G", "specular.B"},
     3,
     true,
     "the radiance along the ideal mirror direction, linear",
     NULL,
     "specular rawreflection vrayrawreflection vrayrerawreflection "},
    {"reflectance",
     {"reflectance.R", "reflectance.G", "reflectance.B"},
     3,
     false,
     "reflectivity times coverage",
     "it counts as 1: specular must hold it, and edges of glossy surfaces are jagged",
     "reflectance reflectionfilter vrayreflectionfilter vrayrereflectionfilter glosscol glossycolor specularalbedo "},
    {"P",
     {"P.X", "P.Y", "P.Z"},
     3,
     true,
     "the position of the visible point",
     NULL,
     "p position pos pworld worldposition "},
    {"endpoint",
     {"endpoint.X", "endpoint.Y", "endpoint.Z", "endpoint.W"},
     4,
     true,
     "the end of the mirrored ray; W is 1 for a position and 0 for a direction",
     NULL,
     "endpoint "},
    {"phong",
     {"phong.V"},
     1,
     false,
     "the Phong exponent",
     "say it with --phong or --roughness; wherever the endpoint is not all zero is glossy",
     "phong "},
    {"rays",
     {"rays.R", "rays.G", "rays.B", "rays.A"},
     4,
     false,
     "the mean radiance of further rays of the lobe, and how many (povgloss passes --rays N)",
     NULL,
     "rays "},
};

/* The layer of a channel's name ("a.b" of "a.b.X"), "" where there is none, and its component ("X"). */
static const char *split(const char *name, size_t *layer_length)
{
    const char *dot = strrchr(name, '.');
    *layer_length = dot ? (size_t)(dot - name) : 0;
    return dot ? dot + 1 : name;
}

/* Whether the first `length` characters of text are the name. */
static bool is_name(const char *text, size_t length, const char *name)
{
    return strlen(name) == length && !memcmp(text, name, length);
}

/* The channel of the group that a component stands for, or -1. */
static int component_index(const struct channel_group *group, const char *component)
{
    static const char *const several[] = {"XYZW", "RGBA"}, *const one[] = {"V", "X", "R", "Y"};
    if (!component[0] || component[1])
        return -1;
    int letter = toupper((unsigned char)component[0]);
    for (int i = 0; i < 4 && group->count == 1; i++)
        if (letter == one[i][0])
            return 0;
    for (int i = 0; i < 2 && group->count > 1; i++) {
        const char *at = strchr(several[i], letter);
        if (at && at - several[i] < group->count)
            return (int)(at - several[i]);
    }
    return -1;
}

/* The channels of a layer; returns how many of the group are there. */
static int find_layer(const struct exr_contents *contents, const struct channel_group *group, const char *layer,
                      size_t length, int planes[CHANNELS_MAX])
{
    int found = 0;
    for (int i = 0; i < CHANNELS_MAX; i++)
        planes[i] = -1;
    for (int plane = 0; plane < contents->image.channels; plane++) {
        size_t layer_length;
        const char *name = contents->names[plane], *component = split(name, &layer_length);
        int index = component_index(group, component);
        if (index < 0 || layer_length != length || strncmp(name, layer, length) || planes[index] >= 0)
            continue;
        planes[index] = plane;
        found++;
    }
    return found;
}

static bool is_alias(const struct channel_group *group, const char *layer, size_t length)
{
    char plain[EXR_NAME_SIZE + 1];
    size_t size = 0;
    for (size_t i = 0; i < length; i++) {
        if (layer[i] == '.')
            size = 0;
        else if (!strchr(" _-", layer[i]))
            plain[size++] = (char)tolower((unsigned char)layer[i]);
    }
    plain[size++] = ' ';
    for (const char *alias = group->aliases; *alias; alias = strchr(alias, ' ') + 1)
        if (!strncmp(alias, plain, size))
            return true;
    return false;
}

/* The one layer with an alias of the group and all its channels. */
static enum result find_alias(const char *path, const struct exr_contents *contents, const struct channel_group *group,
                              int planes[CHANNELS_MAX], bool *found, struct error *err)
{
    *found = false;
    for (int plane = 0; plane < contents->image.channels; plane++) {
        size_t length;
        int candidate[CHANNELS_MAX];
        const char *name = contents->names[plane], *component = split(name, &length);
        if (component_index(group, component) != 0 || !is_alias(group, name, length) ||
            find_layer(contents, group, name, length, candidate) < group->count || candidate[0] != plane)
            continue;
        if (*found)
            return error_set(err, RESULT_DATA, "%s: %s and %s could both be %s; say which: --map '%s=%.*s'",
                             input_file_name(path), contents->names[planes[0]], name, group->name, group->name,
                             (int)length, name);
        *found = true;
        memcpy(planes, candidate, sizeof candidate);
    }
    return RESULT_OK;
}

/* Applies what the map says of the group; *whole is true if it names all of it. */
static enum result apply_map(const char *path, const struct exr_contents *contents, const struct channel_group *group,
                             const struct text_list *map, int planes[CHANNELS_MAX], bool *whole, struct error *err)
{
    *whole = false;
    for (int i = 0; i < map->count; i++) {
        const char *text = map->texts[i], *name = strchr(text, '=') + 1;
        size_t length = (size_t)(name - 1 - text);
        int there = exr_find(contents, name), wanted = -2;
        for (int j = 0; j < group->count; j++)
            if (is_name(text, length, group->names[j]))
                wanted = j;
        if (is_name(text, length, group->name)) {
            int layer[CHANNELS_MAX];
            int found = find_layer(contents, group, name, strlen(name), layer);
            if (group->count == 1 && there >= 0)
                layer[0] = there, found = 1;
            if (found < group->count)
                return error_set(err, RESULT_DATA,
                                 "%s: --map %s: has no layer %s with %d channel%s (--check lists what is there)",
                                 input_file_name(path), text, name, group->count, group->count > 1 ? "s" : "");
            memcpy(planes, layer, sizeof layer);
            *whole = true;
        } else if (wanted >= 0) {
            if (there < 0)
                return error_set(err, RESULT_DATA, "%s: --map %s: has no channel %s (--check lists what is there)",
                                 input_file_name(path), text, name);
            planes[wanted] = there;
        }
    }
    return RESULT_OK;
}

enum result channels_find(const char *path, const struct exr_contents *contents, const struct channel_group *group,
                          const struct text_list *map, int planes[CHANNELS_MAX], const char **missing,
                          struct error *err)
{
    int mapped[CHANNELS_MAX] = {-1, -1, -1, -1}, own = 0;
    bool whole = false, found = false;
    *missing = NULL;
    enum result result = apply_map(path, contents, group, map, mapped, &whole, err);
    for (int i = 0; i < group->count; i++) {
        planes[i] = exr_find(contents, group->names[i]);
        own += planes[i] >= 0;
    }
    if (!result && !own && !whole)
        result = find_alias(path, contents, group, planes, &found, err);
    for (int i = 0; i < group->count && !result; i++) {
        if (mapped[i] >= 0)
            planes[i] = mapped[i];
        if (planes[i] < 0 && !*missing)
            *missing = group->names[i];
    }
    return result;
}

enum result channels_check_map(const char *text, struct error *err)
{
    const char *equals = strchr(text, '=');
    size_t length = equals ? (size_t)(equals - text) : 0;
    for (int i = 0; i < CHANNEL_GROUPS && equals && equals[1]; i++) {
        const struct channel_group *group = &channel_groups[i];
        if (is_name(text, length, group->name))
            return RESULT_OK;
        for (int j = 0; j < group->count; j++)
            if (is_name(text, length, group->names[j]))
                return RESULT_OK;
    }
    return error_set(err, RESULT_USAGE,
                     "--map %s: must be CHANNEL=NAME, the channel one of base, specular, reflectance, P, endpoint, "
                     "phong and rays, or one like P.X",
                     text);
}
