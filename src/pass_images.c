/* Reads what the passes left: codes from 16-bit PPM, on which POV-Ray spends no time to compress it, radiance from EXR. See
 * pass_scene.c for how each was coded. */
#include "pass_images.h"

#include "bands.h"
#include "exr_io.h"
#include "eye.h"
#include "gamma.h"
#include "interpolate.h"
#include "position_code.h"
#include "ppm_io.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum result pass_image_name(enum pass_id id, const char *number, char **name, struct error *err)
{
    return text_printf(name, err, "image%s.%s", number, pass_table[id].codes ? "ppm" : "exr");
}

enum result pass_image_path(const struct pass_images *images, enum pass_id id, char **path, struct error *err)
{
    char *name;
    enum result result = pass_image_name(id, images->number, &name, err);
    if (!result)
        result = text_printf(path, err, "%s/%s/%s", images->folder, pass_table[id].name, name);
    free(name);
    return result;
}

/* Of a mixed texture: a glossy surface with a smaller share isn't glossy. */
#define LEAST_SHARE 0.02f

static bool same_size(const struct image *a, const struct image *b)
{
    return a->pixels && b->pixels && a->width == b->width && a->height == b->height;
}

static enum result read_codes(const struct pass_images *images, enum pass_id id, struct image *image, struct error *err)
{
    char *path;
    enum result result = pass_image_path(images, id, &path, err);
    if (result)
        return result;
    result = ppm_read(path, image, err);
    free(path);
    return result;
}

static bool any_nonzero(const struct image *image, int x, int y)
{
    bool any = false;
    for (int channel = 0; channel < image->channels; channel++)
        any |= image_row(image, channel, y)[x] != 0;
    return any;
}

enum result pass_images_glossy(const struct pass_images *images, struct image_window *window, struct error *err)
{
    enum { MARGIN = 2 };
    struct image codes = {0};
    enum result result = read_codes(images, pass_of_glossy(images->scene), &codes, err);
    int left = codes.width, top = codes.height, right = 0, bottom = 0;
    for (int y = 0; y < codes.height; y++)
        for (int x = 0; x < codes.width; x++)
            if (any_nonzero(&codes, x, y)) {
                left = x < left ? x : left;
                right = x >= right ? x + 1 : right;
                top = y < top ? y : top;
                bottom = y + 1;
            }
    left = left > MARGIN && right > 0 ? left - MARGIN : 0;
    top = top > MARGIN && right > 0 ? top - MARGIN : 0;
    right = right + MARGIN < codes.width ? right + MARGIN : codes.width;
    bottom = bottom + MARGIN < codes.height ? bottom + MARGIN : codes.height;
    *window = (struct image_window){.left = left, .top = top, .width = right - left, .height = bottom - top};
    image_free(&codes);
    return result;
}

enum result pass_images_radiance(const struct pass_images *images, enum pass_id id, struct image *image,
                                 struct error *err)
{
    struct exr_contents contents = {0};
    char *path;
    enum result result = pass_image_path(images, id, &path, err);
    if (result)
        return result;
    result = exr_read(path, &contents, err);
    if (!result)
        result = image_alloc(image, contents.image.width, contents.image.height, 3, err);
    static const char *const names[] = {"R", "G", "B"};
    for (int channel = 0; !result && channel < 3; channel++) {
        int from = exr_find(&contents, names[channel]);
        if (from < 0)
            result = error_set(err, RESULT_POVRAY, "%s: has no channel %s", path, names[channel]);
        for (int y = 0; !result && y < image->height; y++)
            memcpy(image_row(image, channel, y), image_row(&contents.image, from, y),
                   (size_t)image->width * sizeof(float));
    }
    exr_contents_free(&contents);
    free(path);
    return result;
}

/* `exponents`: the image of that pass, whose third channel is the share that a glossy surface has in a mixed texture;
 * NULL or empty: none is mixed. */
static enum result read_coded(const struct pass_images *images, enum pass_id high_id, enum pass_id low_id,
                              const struct image *exponents, struct image *decoded, struct error *err)
{
    struct image high = {0}, low = {0};
    enum result result = read_codes(images, high_id, &high, err);
    if (!result && low_id != high_id)
        result = read_codes(images, low_id, &low, err);
    if (!result && exponents && same_size(exponents, &high) && same_size(exponents, &low))
        position_code_unmix(&high, &low, exponents, 2);
    if (!result)
        result = position_code_decode(&high, low_id != high_id ? &low : NULL, decoded, err);
    image_free(&high);
    image_free(&low);
    return result;
}

static bool locate(const struct image *positions, const struct image *directions, struct camera *camera)
{
    struct gbuffer gbuffer = {.position = *positions};
    eye_find(&gbuffer, directions);
    for (int axis = 0; axis < 3; axis++)
        camera->location[axis] = (double)gbuffer.eye[axis];
    return gbuffer.has_eye;
}

enum result pass_images_view(const struct pass_images *images, struct camera *camera, bool *found, struct error *err)
{
    struct image directions = {0};
    enum result result = read_coded(images, PASS_VIEW, PASS_VIEW, NULL, &directions, err);
    *found = !result && camera_fit(&directions, camera);
    image_free(&directions);
    return result;
}

enum result pass_images_camera(const struct pass_images *images, struct camera *camera, bool *found, struct error *err)
{
    struct image positions = {0}, directions = {0};
    *found = false;
    if (!images->view)
        return RESULT_OK;
    *camera = *images->view;
    enum result result = read_coded(images, PASS_PLACE, PASS_PLACE_LOW, NULL, &positions, err);
    if (!result)
        result = camera_directions(camera, positions.width, positions.height, &directions, err);
    *found = !result && locate(&positions, &directions, camera);
    image_free(&positions);
    image_free(&directions);
    return result;
}

/* The camera's rays at every pixel, in *directions. */
static enum result read_directions(const struct pass_images *images, int width, int height, struct image *directions,
                                   struct error *err)
{
    return images->view ? camera_directions(images->view, width, height, directions, err)
                        : read_coded(images, PASS_DIRECTION, PASS_DIRECTION, NULL, directions, err);
}

/* What a glossy surface reflects is one half of the working space. */
static void scale_reflectance(struct image *reflectance, double gamma)
{
    for (int channel = 0; channel < 3; channel++)
        for (int y = 0; y < reflectance->height; y++) {
            float *row = image_row(reflectance, channel, y);
            for (int x = 0; x < reflectance->width; x++)
                row[x] = (float)(gamma_encode(gamma, row[x]) / 0.5);
        }
}

/* The radiance of a pass that goes with the specular one, pixel by pixel. */
static enum result read_beside_specular(const struct pass_images *images, enum pass_id id, const struct image *specular,
                                        struct image *image, struct error *err)
{
    enum result result = pass_images_radiance(images, id, image, err);
    if (!result && !same_size(specular, image))
        result = error_set(err, RESULT_DATA, "%s: POV-Ray's images of the specular and the %s pass are of different sizes",
                           images->name, pass_table[id].name);
    return result;
}

/* What is between the eye and the glossy surface is part of the base: of the specular pass only the rest is left, L0 as
 * far as it gets through. */
static enum result clear_haze(const struct pass_images *images, struct image *specular, struct error *err)
{
    const double gamma = images->scene->working_gamma;
    struct image haze = {0};
    enum result result = read_beside_specular(images, PASS_HAZE, specular, &haze, err);
    for (int channel = 0; !result && channel < 3; channel++)
        for (int y = 0; y < specular->height; y++) {
            const float *before = image_row(&haze, channel, y);
            float *row = image_row(specular, channel, y);
            for (int x = 0; x < specular->width; x++) {
                double rest = gamma_encode(gamma, (double)row[x]) - gamma_encode(gamma, (double)before[x]);
                row[x] = (float)gamma_decode(gamma, rest);
            }
        }
    image_free(&haze);
    return result;
}

/* The exponent of a pixel whose code is (high, low, 1), see mirror_exponent. */
static float decode_exponent(double high, double low)
{
    double code = (round(65535 * high) + low) / 65535; /* a float holds the 16 bits, but not their quotient */
    return (float)exp2(128 * code - 20);
}

static enum result alloc_exponents(struct gbuffer *gbuffer, const struct image *codes, struct error *err)
{
    const struct image *like = codes->pixels ? codes : &gbuffer->position;
    return image_alloc(&gbuffer->phong, like->width, like->height, 1, err);
}

/* A total reflection in something transparent isn't of a glossy finish: it shows the exponent pass's white sky
 * undimmed. */
static bool is_total_reflection(const struct image *codes, int x, int y)
{
    return codes->pixels && image_row(codes, 2, y)[x] > LEAST_SHARE &&
           image_row(codes, 0, y)[x] > 0.95f * image_row(codes, 2, y)[x];
}

/* The exponent at a pixel: 0 where nothing is glossy. */
static float exponent_at(const struct image *codes, int x, int y)
{
    double share = (double)image_row(codes, 2, y)[x];
    if (share <= (double)LEAST_SHARE || is_total_reflection(codes, x, y))
        return 0;
    return decode_exponent((double)image_row(codes, 0, y)[x] / share, (double)image_row(codes, 1, y)[x] / share);
}

/* phong: 0 where the camera sees nothing glossy. `means`: the antialiased exponents, or an empty image. */
static void fill_exponents(struct gbuffer *gbuffer, double single, const struct image *codes, const struct image *means)
{
    for (int y = 0; y < gbuffer->phong.height; y++)
        for (int x = 0; x < gbuffer->phong.width; x++) {
            bool glossy = any_nonzero(&gbuffer->position, x, y) && any_nonzero(&gbuffer->endpoint, x, y) &&
                          !is_total_reflection(codes, x, y);
            float exponent = 0;
            if (glossy && single >= 0)
                exponent = (float)fmax(single, 1e-6);
            else if (glossy)
                exponent = exponent_at(codes, x, y);
            float mean = exponent > 0 && means->pixels ? exponent_at(means, x, y) : 0;
            exponent = mean > 0 ? mean : exponent;
            image_row(&gbuffer->phong, 0, y)[x] = exponent >= 1e20f ? INFINITY : exponent;
        }
}

/* Of an antialiased pixel of the specular pass, the mean of 4 rays and one in its middle, some rays met no glossy surface
 * and brought the marker: the fewest or most, for a negative or positive one, whose subtraction leaves nothing negative but
 * what rounding and negative lights do. The others' mean is L0. The ray in the middle is one of them where a pixel is
 * glossy. */
static void separate_marked(double radiance[3], double marker)
{
    enum { RAYS = 5 };
    const double negative = 0.25; /* of the marker */
    double marked = marker < 0 ? 0 : RAYS - 1;
    for (int channel = 0; channel < 3; channel++) {
        double most = RAYS * radiance[channel] / marker;
        marked = marker < 0 ? fmax(marked, ceil(most - negative)) : fmin(marked, floor(most + negative));
    }
    marked = fmin(fmax(marked, 0), RAYS - 1);
    for (int channel = 0; channel < 3 && marked > 0; channel++)
        radiance[channel] = fmax(0, (RAYS * radiance[channel] - marked * marker) / (RAYS - marked));
}

/* An antialiased specular pass becomes L0, the mean over what is glossy of each pixel. */
static void take_means(const struct pass_images *images, struct gbuffer *gbuffer)
{
    const double gamma = images->scene->working_gamma, marker = pass_marker(images->scene);
    for (int y = 0; y < gbuffer->specular.height; y++)
        for (int x = 0; x < gbuffer->specular.width; x++) {
            double radiance[3];
            if (!(image_row(&gbuffer->phong, 0, y)[x] > 0))
                continue;
            for (int channel = 0; channel < 3; channel++)
                radiance[channel] = gamma_encode(gamma, (double)image_row(&gbuffer->specular, channel, y)[x]);
            separate_marked(radiance, marker);
            for (int channel = 0; channel < 3; channel++)
                image_row(&gbuffer->specular, channel, y)[x] = (float)gamma_decode(gamma, radiance[channel]);
        }
}

/* A weighted specular pass holds L0 as the surfaces reflect it: divided by their reflectivity, mixed alike, it is L0
 * again. A pixel that reflects nothing isn't glossy. */
static enum result divide_specular(const struct pass_images *images, struct gbuffer *gbuffer, struct error *err)
{
    const double gamma = images->scene->working_gamma;
    const float least = 1e-4f;
    struct image reflectivity = {0};
    enum result result = read_beside_specular(images, PASS_REFLECTIVITY, &gbuffer->specular, &reflectivity, err);
    if (!result)
        scale_reflectance(&reflectivity, gamma);
    for (int y = 0; !result && y < reflectivity.height; y++)
        for (int x = 0; x < reflectivity.width; x++) {
            bool reflects = false;
            for (int channel = 0; channel < 3; channel++) {
                float *radiance = &image_row(&gbuffer->specular, channel, y)[x];
                float weight = image_row(&reflectivity, channel, y)[x];
                bool here = weight > least;
                *radiance = here ? (float)gamma_decode(gamma, gamma_encode(gamma, (double)*radiance) / (double)weight) : 0;
                reflects |= here;
            }
            if (!reflects)
                image_row(&gbuffer->phong, 0, y)[x] = 0;
        }
    image_free(&reflectivity);
    return result;
}

static void copy_surface(struct gbuffer *gbuffer, size_t from, size_t to)
{
    struct image *const planes[] = {&gbuffer->position, &gbuffer->endpoint, &gbuffer->phong};
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++)
        for (int channel = 0; channel < planes[i]->channels; channel++) {
            int width = planes[i]->width, column = (int)(from % (size_t)width), row = (int)(from / (size_t)width);
            image_row(planes[i], channel, (int)(to / (size_t)width))[to % (size_t)width] =
                image_row(planes[i], channel, row)[column];
        }
}

/* The aperture sees glossy surfaces beyond the silhouettes that its centre sees: there they have a, b and the exponent
 * of the nearest glossy pixel. */
static enum result widen_surfaces(struct gbuffer *gbuffer, struct error *err)
{
    const int width = gbuffer->phong.width, height = gbuffer->phong.height;
    const size_t count = (size_t)width * (size_t)height;
    size_t *queue = malloc(count * sizeof *queue), first = 0, end = 0;
    bool *reached = calloc(count, sizeof *reached);
    enum result result = queue && reached ? RESULT_OK : error_memory(err, (double)count * sizeof *queue);
    for (size_t i = 0; !result && i < count; i++)
        if (image_row(&gbuffer->phong, 0, (int)(i / (size_t)width))[i % (size_t)width] > 0) {
            reached[i] = true;
            queue[end++] = i;
        }
    while (!result && first < end) {
        size_t from = queue[first++];
        int x = (int)(from % (size_t)width), y = (int)(from / (size_t)width);
        for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++)
            for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++) {
                size_t to = (size_t)v * (size_t)width + (size_t)u;
                if (reached[to] || !any_nonzero(&gbuffer->specular, u, v))
                    continue;
                reached[to] = true;
                copy_surface(gbuffer, from, to);
                queue[end++] = to;
            }
    }
    free(queue);
    free(reached);
    return result;
}

/* Where nothing is glossy a is 0 and so is b: the passes file holds what the filter needs. */
static void clear_unused(struct gbuffer *gbuffer)
{
    for (int y = 0; y < gbuffer->phong.height; y++)
        for (int x = 0; x < gbuffer->phong.width; x++) {
            if (image_row(&gbuffer->phong, 0, y)[x] > 0)
                continue;
            for (int channel = 0; channel < 4; channel++) {
                image_row(&gbuffer->endpoint, channel, y)[x] = 0;
                if (channel < 3) {
                    image_row(&gbuffer->position, channel, y)[x] = 0;
                    image_row(&gbuffer->specular, channel, y)[x] = 0;
                }
            }
        }
}

static enum result drop_w(struct image *image, struct error *err)
{
    struct image three;
    enum result result = image_alloc(&three, image->width, image->height, 3, err);
    if (result)
        return result;
    memcpy(three.pixels, image->pixels, three.stride * (size_t)three.height * 3 * sizeof(float));
    image_free(image);
    *image = three;
    return RESULT_OK;
}

/* The passes of full size are as large as the base, the others as its subsampling says; with a margin there are no
 * directions. */
static enum result check_sizes(const struct pass_images *images, const struct gbuffer *gbuffer,
                               const struct image *directions, struct error *err)
{
    const struct {
        const struct image *image;
        const char *pass;
        int step;
    } planes[] = {
        {&gbuffer->reflectance, "reflectance", 1},
        {&gbuffer->specular, "specular", images->subsample},
        {&gbuffer->position, "position", images->subsample},
        {&gbuffer->endpoint, "endpoint", images->subsample},
        {directions, "direction", images->subsample},
        {&gbuffer->phong, "exponent", images->subsample},
    };
    const struct image *base = &gbuffer->base;
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        int width = base->width / planes[i].step, height = base->height / planes[i].step;
        if (planes[i].image->pixels && (planes[i].image->width != width || planes[i].image->height != height))
            return error_set(err, RESULT_DATA,
                             "%s: POV-Ray's image of the %s pass is %dx%d, and %dx%d goes with the base: give +W and +H",
                             images->name, planes[i].pass, planes[i].image->width, planes[i].image->height, width,
                             height);
    }
    return RESULT_OK;
}

static void note_invisible(const struct gbuffer *gbuffer, const char *scene, struct error *note)
{
    for (int y = 0; y < gbuffer->phong.height; y++)
        for (int x = 0; x < gbuffer->phong.width; x++)
            if (image_row(&gbuffer->phong, 0, y)[x] > 0)
                return;
    error_set(note, RESULT_OK,
              "%s: the camera sees no glossy surface: does the finish with Gloss() reflect, and is it used?", scene);
}

static bool glossy_around(const struct image *phong, int x, int y)
{
    enum { REACH = 2 };
    for (int v = y - REACH; v <= y + REACH; v++)
        for (int u = x - REACH; u <= x + REACH; u++)
            if (v >= 0 && v < phong->height && u >= 0 && u < phong->width && image_row(phong, 0, v)[u] > 0)
                return true;
    return false;
}

/* The reflectance pass sees through everything that the eye sees through. Where it finds a glossy reflection and the
 * other passes no glossy surface, not even at a silhouette, that reflection is missing in the picture. */
static void note_lost(const struct gbuffer *gbuffer, const char *scene, struct error *note)
{
    const double least = 0.02, share = 0.001;
    const struct image *reflectance = &gbuffer->reflectance;
    long lost = 0;
    for (int y = 0; y < reflectance->height; y++)
        for (int x = 0; x < reflectance->width; x++) {
            double largest = 0;
            for (int channel = 0; channel < 3; channel++)
                largest = fmax(largest, (double)image_row(reflectance, channel, y)[x]);
            lost += largest > least && !glossy_around(&gbuffer->phong, x, y);
        }
    double part = (double)lost / ((double)reflectance->width * reflectance->height);
    if (part > share)
        error_set(note, RESULT_OK,
                  "%s: at %.2g %% of the pixels a glossy reflection is left out: the surface is seen through something that "
                  "only POV-Ray can look through, such as a total reflection",
                  scene, 100 * part);
}

/* What is rendered of the picture alone gets the size of what has a margin, black there. */
static enum result widen(const struct pass_images *images, struct gbuffer *gbuffer, struct error *err)
{
    int width = gbuffer->base.width, height = gbuffer->base.height;
    const struct image_window all = {.left = -images->margin_x,
                                     .top = -images->margin_y,
                                     .width = width + 2 * images->margin_x,
                                     .height = height + 2 * images->margin_y};
    gbuffer->window = (struct image_window){
        .left = images->margin_x, .top = images->margin_y, .width = width, .height = height};
    enum result result = image_crop(&gbuffer->base, &all, err);
    return result ? result : image_crop(&gbuffer->reflectance, &all, err);
}

static void set_eye(const struct camera *camera, struct gbuffer *gbuffer)
{
    gbuffer->has_eye = true;
    for (int axis = 0; axis < 3; axis++)
        gbuffer->eye[axis] = (float)camera->location[axis];
    gbuffer->view_angle = (float)(camera_view_angle(camera) * gbuffer->position.width / gbuffer->window.width);
}

/* Nothing is glossy: the base is all. */
static enum result make_dull(struct gbuffer *gbuffer, struct error *err)
{
    const struct {
        struct image *image;
        int channels;
    } planes[] = {
        {&gbuffer->specular, 3}, {&gbuffer->reflectance, 3}, {&gbuffer->position, 3},
        {&gbuffer->endpoint, 4}, {&gbuffer->phong, 1},
    };
    enum result result = RESULT_OK;
    for (size_t i = 0; !result && i < sizeof planes / sizeof *planes; i++)
        result = image_alloc(planes[i].image, gbuffer->base.width, gbuffer->base.height, planes[i].channels, err);
    return result;
}

enum part { PART_ENDPOINT, PART_POSITION, PART_SPECULAR, PART_REFLECTANCE, PARTS };

/* What is read by several threads: all but the exponents, by which the endpoints are decoded. */
struct reading {
    const struct pass_images *images;
    struct gbuffer *gbuffer;
    const struct image *exponents;
    enum result results[PARTS];
    struct error errors[PARTS];
};

static enum result read_specular(const struct pass_images *images, struct image *specular, struct error *err)
{
    enum result result = pass_images_radiance(images, PASS_SPECULAR, specular, err);
    return !result && pass_needed(images->scene, PASS_HAZE) ? clear_haze(images, specular, err) : result;
}

static enum result read_reflectance(const struct pass_images *images, struct image *reflectance, struct error *err)
{
    enum result result = pass_images_radiance(images, PASS_REFLECTANCE, reflectance, err);
    if (!result)
        scale_reflectance(reflectance, images->scene->working_gamma);
    return result;
}

static enum result read_position(const struct pass_images *images, struct image *position, struct error *err)
{
    enum result result = read_coded(images, PASS_POSITION, PASS_POSITION_LOW, NULL, position, err);
    return result ? result : drop_w(position, err);
}

static void read_parts(void *context, int first, int end)
{
    struct reading *reading = context;
    const struct pass_images *images = reading->images;
    struct gbuffer *gbuffer = reading->gbuffer;
    for (int part = first; part < end; part++) {
        struct error *err = &reading->errors[part];
        enum result *result = &reading->results[part];
        switch ((enum part)part) {
        case PART_ENDPOINT:
            *result = read_coded(images, PASS_ENDPOINT, PASS_ENDPOINT_LOW, reading->exponents, &gbuffer->endpoint, err);
            break;
        case PART_POSITION:
            *result = read_position(images, &gbuffer->position, err);
            break;
        case PART_SPECULAR:
            *result = read_specular(images, &gbuffer->specular, err);
            break;
        case PART_REFLECTANCE:
            *result = read_reflectance(images, &gbuffer->reflectance, err);
            break;
        case PARTS:
            break;
        }
    }
}

/* Those of what is glossy. */
static enum result read_all(const struct pass_images *images, const struct image *exponents, struct gbuffer *gbuffer,
                            struct error *err)
{
    struct reading reading = {.images = images, .gbuffer = gbuffer, .exponents = exponents};
    enum result result = bands_run(PARTS, 1, 0, read_parts, &reading, err);
    for (int part = 0; !result && part < PARTS; part++) {
        result = reading.results[part];
        *err = result ? reading.errors[part] : *err;
    }
    return result;
}

enum result pass_images_read(const struct pass_images *images, struct gbuffer *gbuffer, struct error *note,
                             struct error *err)
{
    struct image directions = {0}, codes = {0}, means = {0};
    enum result result = pass_images_radiance(images, PASS_BASE, &gbuffer->base, err);
    if (result || !images->scene->glossy)
        return result ? result : make_dull(gbuffer, err);
    if (pass_needed(images->scene, PASS_EXPONENT))
        result = read_codes(images, PASS_EXPONENT, &codes, err);
    if (!result && pass_needed(images->scene, PASS_EXPONENT_MEAN))
        result = read_codes(images, PASS_EXPONENT_MEAN, &means, err);
    if (!result && means.pixels && !same_size(&means, &codes))
        result = error_set(err, RESULT_DATA, "%s: POV-Ray's images of the exponents are of different sizes", images->name);
    if (!result)
        result = read_all(images, &codes, gbuffer, err);
    if (!result)
        result = images->camera ? widen(images, gbuffer, err)
                                : read_directions(images, gbuffer->position.width, gbuffer->position.height, &directions, err);
    if (!result)
        result = alloc_exponents(gbuffer, &codes, err);
    if (!result)
        result = check_sizes(images, gbuffer, &directions, err);
    if (!result) {
        fill_exponents(gbuffer, images->scene->exponent, &codes, &means);
        if (pass_weights_specular(images->scene))
            result = divide_specular(images, gbuffer, err);
        if (!result && images->means)
            take_means(images, gbuffer);
        gbuffer->working_gamma = images->scene->working_gamma == 1 ? 0 : (float)images->scene->working_gamma;
        if (images->camera)
            set_eye(images->camera, gbuffer);
        else
            eye_find(gbuffer, &directions);
    }
    if (!result && images->scene->focal_blur)
        result = widen_surfaces(gbuffer, err);
    if (!result) {
        clear_unused(gbuffer);
        note_invisible(gbuffer, images->name, note);
        if (images->subsample > 1)
            result = interpolate_gbuffer(gbuffer, err);
        else
            note_lost(gbuffer, images->name, note);
    }
    if (!result && images->rays)
        result = read_coded(images, PASS_MIRROR, PASS_MIRROR_LOW, &codes, &gbuffer->mirrored, err);
    if (!result && images->rays)
        gbuffer->direction = directions;
    else
        image_free(&directions);
    image_free(&codes);
    image_free(&means);
    return result;
}
