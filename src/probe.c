/* The directions of the lobe, the camera that sees along them, and what is made of its image. */
#include "probe.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Rays start this far in front of their mirror, world units: POV-Ray passes over what is nearer than 1e-4. Farther than
 * FAR_AWAY from the origin both grow with that distance: POV-Ray's bounding boxes are of floats. */
#define START 1e-3
#define MIRROR_RADIUS 2e-5
#define FAR_AWAY 100.0
/* Mirrors stand this far above the surface, as a share of the distance from the origin or the eye: positions are known
 * to about a tenth of it. */
#define LIFT 1e-6
/* Two-sided 95 % of Student's t with PROBE_SETS - 1 degrees of freedom. */
#define STUDENT_T 2.131
#define LARGEST_HALF 65504.0

static const double pi = 3.14159265358979323846;

/* ---- directions ---- */

static uint32_t reverse_bits(uint32_t v)
{
    v = (v >> 1 & 0x55555555u) | (v & 0x55555555u) << 1;
    v = (v >> 2 & 0x33333333u) | (v & 0x33333333u) << 2;
    v = (v >> 4 & 0x0f0f0f0fu) | (v & 0x0f0f0f0fu) << 4;
    v = (v >> 8 & 0x00ff00ffu) | (v & 0x00ff00ffu) << 8;
    return v >> 16 | v << 16;
}

/* Avalanche of all bits (the finaliser of MurmurHash3). */
static uint32_t hash(uint32_t v)
{
    v = (v ^ v >> 16) * 0x85ebca6bu;
    v = (v ^ v >> 13) * 0xc2b2ae35u;
    return v ^ v >> 16;
}

/* Owen's scrambling: every bit is flipped at random, by a hash of the seed and all bits above it (Laine and
 * Karras, Stratified sampling for stochastic transparency, 2011; this one is Vegdahl's, 2021). */
static uint32_t scramble(uint32_t v, uint32_t seed)
{
    v = reverse_bits(v);
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return reverse_bits(v);
}

/* Second coordinate of Sobol's sequence; the first is the index with its bits reversed. */
static uint32_t sobol_second(uint32_t index)
{
    uint32_t v = 0;
    for (uint32_t direction = 1u << 31; index; index >>= 1, direction ^= direction >> 1)
        if (index & 1)
            v ^= direction;
    return v;
}

void probe_ray(double phong, unsigned seed, long index, double ray[3])
{
    uint32_t set = hash(seed * 2654435761u + (uint32_t)(index % PROBE_SETS)), point = (uint32_t)(index / PROBE_SETS);
    double u = (scramble(reverse_bits(point), hash(set + 1)) + 0.5) / 4294967296.0;
    double v = (scramble(sobol_second(point), hash(set + 2)) + 0.5) / 4294967296.0;
    /* cos = u^(1/(p+1)) has the density of cos^p over solid angle */
    double log_cosine = log(u) / (phong + 1), sine = sqrt(-expm1(2 * log_cosine));
    ray[0] = sine * cos(2 * pi * v);
    ray[1] = sine * sin(2 * pi * v);
    ray[2] = exp(log_cosine);
}

/* ---- vectors ---- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* False for a vector without direction. */
static bool normalise(double v[3])
{
    double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return length > 0 && isfinite(length);
}

/* Unit vectors `across` and `up` at right angles to the unit vector `axis` and to each other. They change with it
 * without leaps, but about -y (Frisvad, Building an orthonormal basis from a 3D unit vector without normalization,
 * 2012). */
static void make_frame(const double axis[3], double turn, double across[3], double up[3])
{
    double share = 1 / fmax(1 + axis[1], 1e-12), both = -axis[0] * axis[2] * share;
    double first[3] = {both, -axis[2], 1 - axis[2] * axis[2] * share};
    double second[3] = {1 - axis[0] * axis[0] * share, -axis[0], both};
    if (axis[1] < -1 + 1e-9) {
        memcpy(first, (double[3]){1, 0, 0}, sizeof first);
        memcpy(second, (double[3]){0, 0, 1}, sizeof second);
    }
    for (int i = 0; i < 3; i++) {
        across[i] = cos(turn) * first[i] + sin(turn) * second[i];
        up[i] = cos(turn) * second[i] - sin(turn) * first[i];
    }
}

static void read_vector(const struct image *image, int x, int y, double v[3])
{
    for (int i = 0; i < 3; i++)
        v[i] = image_row(image, i, y)[x];
}

/* ---- choosing the pixels ---- */

/* The mirror and the rays of a pixel; false where the passes don't tell them. */
static bool place(struct probe *probe, const struct gbuffer *gbuffer, const struct probe_options *options)
{
    double view[3], mirrored[3];
    read_vector(&gbuffer->position, probe->x, probe->y, probe->position);
    read_vector(&gbuffer->direction, probe->x, probe->y, view);
    read_vector(&gbuffer->mirrored, probe->x, probe->y, mirrored);
    if (!normalise(view) || !normalise(mirrored))
        return false;
    for (int i = 0; i < 3; i++)
        probe->normal[i] = mirrored[i] - view[i];
    if (!normalise(probe->normal))
        return false;
    double off = 2 * dot(mirrored, probe->normal), from_eye = 0, from_origin = dot(probe->position, probe->position);
    for (int i = 0; i < 3; i++) {
        double difference = gbuffer->has_eye ? probe->position[i] - (double)gbuffer->eye[i] : 0;
        probe->axis[i] = mirrored[i] - off * probe->normal[i];
        from_eye += difference * difference;
    }
    probe->scale = fmax(1, sqrt(from_origin) / FAR_AWAY);
    for (int i = 0; i < 3; i++)
        probe->position[i] += LIFT * sqrt(fmax(from_eye, from_origin)) * probe->normal[i];
    uint32_t random = hash((unsigned)options->seed + 0x9e3779b9u);
    random = hash(hash(random + (uint32_t)probe->x) + (uint32_t)probe->y);
    make_frame(probe->axis, options->rays ? 0 : 2 * pi * random / 4294967296.0, probe->across, probe->up);
    return true;
}

static enum result add_probe(struct buffer *list, const struct probe *probe, double phong, struct error *err)
{
    struct probe added = *probe;
    added.phong = phong;
    return buffer_add(list, &added, sizeof added, err);
}

static enum result add_pixel(struct buffer *list, const struct gbuffer *gbuffer, int x, int y,
                             const struct probe_options *options, struct error *err)
{
    struct probe probe = {.x = x, .y = y};
    double phong = (double)image_row(&gbuffer->phong, 0, y)[x];
    if (!(phong > 0) || !place(&probe, gbuffer, options))
        return RESULT_OK;
    for (int channel = 0; channel < 3; channel++)
        probe.specular[channel] = image_row(&gbuffer->specular, channel, y)[x];
    if (!options->exponents)
        return add_probe(list, &probe, phong, err);
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < options->exponent_count; i++)
        result = add_probe(list, &probe, options->exponents[i], err);
    return result;
}

static int by_exponent_and_pixel(const void *first, const void *second)
{
    const struct probe *a = first, *b = second;
    if (a->phong != b->phong)
        return a->phong < b->phong ? -1 : 1;
    return a->y != b->y ? a->y - b->y : a->x - b->x;
}

enum result probes_begin(struct probes *probes, const struct gbuffer *gbuffer, const struct probe_options *options,
                         struct error *err)
{
    const struct image *phong = &gbuffer->phong;
    double cell = fmax(1, (double)phong->width / options->grid);
    struct buffer list = {0};
    enum result result = RESULT_OK;
    *probes = (struct probes){.error = options->error,
                              .seed = (unsigned)options->seed,
                              .lobes = options->rays ? PROBE_LOBES : 1,
                              .most = options->rays ? options->rays : PROBE_MOST_RAYS,
                              .rays = options->rays ? options->rays : PROBE_FIRST_RAYS};
    int end = options->end_row > 0 ? options->end_row : phong->height;
    for (double y = options->first_row + cell / 2; !result && y < end; y += cell)
        for (double x = cell / 2; !result && x < phong->width; x += cell)
            result = add_pixel(&list, gbuffer, (int)x, (int)y, options, err);
    probes->list = (struct probe *)(void *)list.data;
    probes->count = (int)(list.size / sizeof *probes->list);
    if (!result && !probes->count && !options->end_row)
        result = error_set(err, RESULT_DATA, "no pixel of the grid is glossy: a --grid above %d has more",
                           options->grid);
    if (!result && probes->count)
        qsort(probes->list, (size_t)probes->count, sizeof *probes->list, by_exponent_and_pixel);
    if (!result && probes->count && !(probes->viewed = malloc((size_t)probes->count * sizeof *probes->viewed)))
        result = error_memory(err, (double)probes->count * sizeof *probes->viewed);
    return result;
}

void probes_free(struct probes *probes)
{
    free(probes->list);
    free(probes->viewed);
    *probes = (struct probes){0};
}

/* ---- the camera ---- */

/* A triangle whose centre is where the ray starts, and whose normal, in POV-Ray's left-handed space, is its
 * direction. */
static enum result add_face(struct buffer *text, const double ray[3], struct error *err)
{
    double across[3], up[3];
    make_frame(ray, 0, across, up);
    enum result result = RESULT_OK;
    for (int corner = 0; !result && corner < 3; corner++) {
        double angle = -2 * pi * corner / 3, v[3];
        for (int i = 0; i < 3; i++)
            v[i] = START * (-ray[i] + cos(angle) * across[i] + sin(angle) * up[i]);
        result = buffer_printf(text, err, "<%.9g,%.9g,%.9g>", v[0], v[1], v[2]);
    }
    return result ? result : buffer_add_text(text, "\n", err);
}

/* With few rays the pixels of a tile of 8 x 8 have lobes of their own, in Morton order: those of an aligned square of 2
 * x 2 or 4 x 4 pixels follow each other. */
static int lobe_of(const struct probes *probes, const struct probe *probe)
{
    int lobe = 0;
    for (int bit = 0; bit < 3; bit++)
        lobe |= (probe->x >> bit & 1) << 2 * bit | (probe->y >> bit & 1) << (2 * bit + 1);
    return probes->lobes > 1 ? lobe : 0;
}

/* Several lobes are parts of one sequence. */
static void lobe_ray(const struct probes *probes, int lobe, double phong, long ray, double direction[3])
{
    long index = probes->rays_before + ray;
    if (probes->lobes > 1)
        index = PROBE_SETS * (lobe * probes->rays + index);
    probe_ray(phong, hash(probes->seed), index, direction);
}

void probes_ray(const struct probes *probes, const struct probe *probe, long ray, double direction[3])
{
    lobe_ray(probes, lobe_of(probes, probe), probe->phong, ray, direction);
}

/* The round's new rays of a lobe, as a mesh of one face each. */
static enum result add_lobe(const struct probes *probes, int lobe, double phong, struct buffer *text, struct error *err)
{
    long count = probes->rays - probes->rays_before;
    enum result result = buffer_printf(text, err, "mesh2 { vertex_vectors { %ld,\n", 3 * count);
    for (long i = 0; !result && i < count; i++) {
        double ray[3];
        lobe_ray(probes, lobe, phong, i, ray);
        result = add_face(text, ray, err);
    }
    if (!result)
        result = buffer_printf(text, err, "} face_indices { %ld,\n", count);
    for (long i = 0; !result && i < count; i++)
        result = buffer_printf(text, err, "<%ld,%ld,%ld>\n", 3 * i, 3 * i + 1, 3 * i + 2);
    return result ? result : buffer_add_text(text, "} }\n", err);
}

/* Those of an exponent, in an array. */
static enum result add_lobes(const struct probes *probes, int exponent, double phong, struct buffer *text,
                             struct error *err)
{
    enum result result = buffer_printf(text, err, "#declare povgloss_lobes%d = array[%d]\n", exponent, probes->lobes);
    for (int lobe = 0; !result && lobe < probes->lobes; lobe++) {
        result = buffer_printf(text, err, "#declare povgloss_lobes%d[%d] = ", exponent, lobe);
        if (!result)
            result = add_lobe(probes, lobe, phong, text, err);
    }
    return result;
}

static enum result add_vector(struct buffer *text, const char *before, double scale, const double v[3],
                              struct error *err)
{
    return buffer_printf(text, err, "%s%.17g,%.17g,%.17g", before, scale * v[0], scale * v[1], scale * v[2]);
}

/* The lobe, turned to where the probe looks. */
static enum result add_mesh(struct buffer *text, const struct probes *probes, const struct probe *probe, int exponent,
                            struct error *err)
{
    enum result result = buffer_printf(text, err, "mesh { povgloss_lobes%d[%d] ", exponent, lobe_of(probes, probe));
    if (!result)
        result = add_vector(text, "matrix <", probe->scale, probe->across, err);
    if (!result)
        result = add_vector(text, ",", probe->scale, probe->up, err);
    if (!result)
        result = add_vector(text, ",", probe->scale, probe->axis, err);
    if (!result)
        result = add_vector(text, ",", 1, probe->position, err);
    return result ? result : buffer_add_text(text, "> }\n", err);
}

static enum result add_mirror(struct buffer *text, const struct probe *probe, struct error *err)
{
    enum result result = add_vector(text, "disc { <", 1, probe->position, err);
    if (!result)
        result = add_vector(text, ">, <", 1, probe->normal, err);
    return result ? result : buffer_printf(text, err, ">, %g }\n", probe->scale * MIRROR_RADIUS);
}

/* As many probes as a view may hold, at least one: together their rays and their lobes' faces. POV-Ray looks through
 * the meshes one by one for each ray, 0.5 ns each: with this many that takes as long as starting another process, 0.7
 * s. */
static void choose_viewed(struct probes *probes)
{
    long rays = probes->rays - probes->rays_before, room = PROBE_VIEW_RAYS;
    int most = 1 + (int)(50000 / sqrt((double)rays));
    const struct probe *last = NULL;
    probes->viewed_count = 0;
    for (; probes->next < probes->count; probes->next++) {
        const struct probe *probe = &probes->list[probes->next];
        if (probe->done)
            continue;
        long needed = rays * (last && last->phong == probe->phong ? 1 : 1 + probes->lobes);
        if (last && (needed > room || probes->viewed_count == most))
            break;
        probes->viewed[probes->viewed_count++] = probes->next;
        room -= needed;
        last = probe;
    }
}

/* Whether the view's probe has another exponent than the one before. */
static bool begins_exponent(const struct probes *probes, int index)
{
    const int *viewed = probes->viewed + index;
    return index == 0 || probes->list[viewed[0]].phong != probes->list[viewed[-1]].phong;
}

enum result probes_view(struct probes *probes, struct buffer *text, int *width, int *height, struct error *err)
{
    struct buffer meshes = {0}, mirrors = {0};
    enum result result = RESULT_OK;
    choose_viewed(probes);
    for (int i = 0, exponent = 0; !result && i < probes->viewed_count; i++) {
        const struct probe *probe = &probes->list[probes->viewed[i]];
        if (begins_exponent(probes, i))
            result = add_lobes(probes, ++exponent, probe->phong, text, err);
        if (!result)
            result = add_mesh(&meshes, probes, probe, exponent, err);
        if (!result)
            result = add_mirror(&mirrors, probe, err);
    }
    if (!result)
        result = buffer_printf(text, err,
                               "camera { mesh_camera { 1 1 %s} }\n"
                               "union { sphere { 0, 1e-6 }\n%s"
                               "texture { pigment { rgb 0 } finish { ambient 0 emission 0 diffuse 0 specular 0 phong 0 "
                               "reflection { 1 } } }\nno_reflection no_shadow no_radiosity }\n",
                               meshes.data, mirrors.data);
    *width = PROBE_VIEW_WIDTH;
    long rays = (probes->rays - probes->rays_before) * probes->viewed_count;
    *height = 1 + (int)((rays + PROBE_VIEW_WIDTH - 1) / PROBE_VIEW_WIDTH);
    buffer_free(&meshes);
    buffer_free(&mirrors);
    return result;
}

/* ---- the estimate ---- */

/* POV-Ray finds a pixel's face by y - 1/2, cut to a whole number: every row of faces comes one row late, after a first
 * row that shows the same. */
static double seen(const struct image *image, int channel, long face)
{
    double value = (double)image_row(image, channel, 1 + (int)(face / image->width))[face % image->width];
    return value < LARGEST_HALF ? value : LARGEST_HALF;
}

/* The mean of all rays, and the spread of the sets' own means. A set without rays above the horizon says nothing. The
 * spread of the first round may have missed what is rare: it is believed only if it is ten times smaller than asked
 * for. */
static void estimate(struct probe *probe, long rays, double enough)
{
    double believed = rays > PROBE_FIRST_RAYS ? enough : enough / 10;
    int sets = 0;
    probe->samples = 0;
    for (int set = 0; set < PROBE_SETS; set++) {
        probe->samples += probe->count[set];
        sets += probe->count[set] > 0;
    }
    probe->above = (double)probe->samples / (double)rays;
    probe->error = 0;
    probe->done = true;
    for (int channel = 0; channel < 3; channel++) {
        double sum = 0, squares = 0;
        for (int set = 0; set < PROBE_SETS; set++)
            sum += probe->sum[set][channel];
        double mean = probe->value[channel] = sum / fmax(1, (double)probe->samples);
        for (int set = 0; set < PROBE_SETS; set++)
            if (probe->count[set] > 0)
                squares += pow(probe->sum[set][channel] / (double)probe->count[set] - mean, 2);
        double error = sets > 1 ? STUDENT_T * sqrt(squares / ((double)sets * (sets - 1))) : INFINITY;
        probe->error = fmax(probe->error, error);
        probe->done &= error <= believed * fmax(1, mean);
    }
}

enum result probes_take(struct probes *probes, const struct image *image, struct error *err)
{
    long count = probes->rays - probes->rays_before;
    double (*rays)[3] = malloc((size_t)(count * probes->lobes) * sizeof *rays);
    if (!rays)
        return error_memory(err, (double)count * probes->lobes * sizeof *rays);
    for (int i = 0; i < probes->viewed_count; i++) {
        struct probe *probe = &probes->list[probes->viewed[i]];
        double normal[3] = {dot(probe->across, probe->normal), dot(probe->up, probe->normal),
                            dot(probe->axis, probe->normal)};
        for (long ray = 0; begins_exponent(probes, i) && ray < count * probes->lobes; ray++)
            lobe_ray(probes, (int)(ray / count), probe->phong, ray % count, rays[ray]);
        for (long face = 0; face < count; face++) {
            if (dot(rays[lobe_of(probes, probe) * count + face], normal) >= 0)
                continue;
            int set = (int)(face % PROBE_SETS);
            probe->count[set]++;
            for (int channel = 0; channel < 3; channel++)
                probe->sum[set][channel] += seen(image, channel, i * count + face);
        }
        estimate(probe, probes->rays, probes->error);
    }
    free(rays);
    return RESULT_OK;
}

enum result probes_image(const struct probes *probes, const struct gbuffer *gbuffer, struct image *image,
                         struct error *err)
{
    int width = gbuffer->phong.width, height = gbuffer->phong.height;
    struct image counts = {0};
    enum result result = image_alloc(image, width, height, 3, err);
    if (!result)
        result = image_alloc(&counts, width, height, 1, err);
    for (int i = 0; !result && i < probes->count; i++) {
        const struct probe *probe = &probes->list[i];
        for (int y = probe->y - 1; y <= probe->y + 1; y++)
            for (int x = probe->x - 1; x <= probe->x + 1; x++) {
                bool own = x == probe->x && y == probe->y;
                if (x < 0 || x >= width || y < 0 || y >= height || (!own && image_row(&gbuffer->phong, 0, y)[x] > 0))
                    continue;
                float count = image_row(&counts, 0, y)[x] += 1;
                for (int channel = 0; channel < 3; channel++) {
                    float *mean = &image_row(image, channel, y)[x];
                    *mean += ((float)probe->value[channel] - *mean) / count;
                }
            }
    }
    image_free(&counts);
    return result;
}

void probes_means(const struct probes *probes, struct image *means)
{
    for (int i = 0; i < probes->count; i++) {
        const struct probe *probe = &probes->list[i];
        for (int channel = 0; channel < 3; channel++)
            image_row(means, channel, probe->y)[probe->x] = (float)probe->value[channel];
        image_row(means, 3, probe->y)[probe->x] = (float)probe->samples;
    }
}

int probes_open(const struct probes *probes)
{
    int open = 0;
    for (int i = 0; i < probes->count; i++)
        open += !probes->list[i].done;
    return open;
}

bool probes_left(struct probes *probes)
{
    if (probes->next < probes->count)
        for (int i = probes->next; i < probes->count; i++)
            if (!probes->list[i].done)
                return true;
    if (!probes_open(probes) || probes->rays >= probes->most)
        return false;
    if (probes->next > 0) {
        probes->rays_before = probes->rays;
        probes->rays *= 4;
        probes->next = 0;
    }
    return true;
}
