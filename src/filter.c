/* Both filters: the stages, each shared out by rows; antialiased edges. */
#include "filter.h"

#include "bands.h"
#include "control_variate.h"
#include "filter_cells.h"
#include "filter_level.h"
#include "filter_sparse.h"
#include "interrupt.h"
#include "weights.h"

#include <assert.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

struct filter_options filter_options_default(void)
{
    return (struct filter_options){
        .weights = FILTER_WEIGHTS_EXACT,
        .formula = FILTER_FORMULA_PHONG,
        .window = FILTER_WINDOW_ROUND,
        .phong = NAN,
        .max_angle_rad = 1.57079632679489662,
        .radius_step = 1,
    };
}

struct filter {
    struct filter_level *level;
    struct filter_view view;
    atomic_bool out_of_memory;
};

static void blur(void *context, int first, int end)
{
    struct filter *filter = context;
    float *scratch = aligned_alloc(64, filter_level_scratch(&filter->view) * sizeof *scratch);
    if (!scratch) {
        atomic_store(&filter->out_of_memory, true);
        return;
    }
    for (int y = first; y < end; y++)
        for (int x = 0; x < filter->level->taps.width && !interrupt_signal(); x += FILTER_LANES)
            if (filter_level_needs(filter->level, x, x + FILTER_LANES - 1, y))
                filter_level_blur(filter->level, &filter->view, 0, x, y, scratch);
    free(scratch);
}

/* Every pixel by itself. */
static enum result filter_exact(struct filter_level *level, struct error *err)
{
    struct filter filter = {.level = level, };
    enum result result = filter_cells_view(level, 0, 1, &filter.view, err);
    if (result == RESULT_OK)
        result = bands_run(level->taps.height, 1, level->shared->options->threads, blur, &filter, err);
    if (result == RESULT_OK && atomic_load(&filter.out_of_memory))
        result = error_memory(err, (double)(filter_level_scratch(&filter.view) * sizeof(float)));
    return result;
}

/* Mean of the results of the nearest ring of pixels that has glossy ones. */
static void edge_fill(const struct filter_level *level, int x, int y)
{
    for (int reach = 1; reach <= FILTER_EDGE_REACH_PX; reach++) {
        double sum[3] = {0};
        int count = 0;
        for (int v = y - reach; v <= y + reach; v++)
            for (int u = x - reach; u <= x + reach; u++) {
                if (u < 0 || v < 0 || u >= level->taps.width || v >= level->taps.height ||
                    !filter_level_is_tap(level, u, v))
                    continue;
                for (int i = 0; i < 3; i++)
                    sum[i] += (double)image_row(&level->glossy, i, v)[u];
                count++;
            }
        for (int i = 0; i < 3 && count > 0; i++)
            image_row(&level->glossy, i, y)[x] = (float)(sum[i] / count);
        if (count > 0)
            return;
    }
}

static void edges(void *context, int first, int end)
{
    const struct filter_level *level = context;
    const struct image *reflectance = &level->shared->gbuffer->reflectance;
    for (int y = first; y < end; y++)
        for (int x = 0; x < level->taps.width; x++) {
            bool reflects = false;
            for (int i = 0; i < 3; i++)
                reflects = reflects || image_row(reflectance, i, y)[x] > 0;
            if (reflects && !filter_level_is_tap(level, x, y))
                edge_fill(level, x, y);
        }
}

static enum result check_plane(const struct image *image, const char *name, int channels, const struct image *size,
                               struct error *err)
{
    if (!image->pixels)
        return error_set(err, RESULT_DATA, "there is no %s pass", name);
    if (image->width != size->width || image->height != size->height || image->channels < channels)
        return error_set(err, RESULT_DATA, "the %s pass is %d x %d pixels of %d channels, not %d x %d of %d", name,
                         image->width, image->height, image->channels, size->width, size->height, channels);
    return RESULT_OK;
}

static enum result check(const struct gbuffer *gbuffer, const struct filter_options *options, struct error *err)
{
    assert(options->energy >= 0 && options->energy < 1 && options->max_angle_rad > 0 && options->max_radius_px >= 0);
    assert(options->radius_step > 0 && options->threads >= 0 && !(options->phong < 0));
    const struct image *size = &gbuffer->specular;
    enum result result = check_plane(size, "specular", 3, size, err);
    if (result == RESULT_OK)
        result = check_plane(&gbuffer->position, "position", 3, size, err);
    if (result == RESULT_OK)
        result = check_plane(&gbuffer->endpoint, "endpoint", 4, size, err);
    if (result == RESULT_OK && gbuffer->phong.pixels)
        result = check_plane(&gbuffer->phong, "phong", 1, size, err);
    if (result == RESULT_OK && gbuffer->rays.pixels)
        result = check_plane(&gbuffer->rays, "rays", 4, size, err);
    if (result == RESULT_OK && gbuffer->reflectance.pixels)
        result = check_plane(&gbuffer->reflectance, "reflectance", 3, size, err);
    if (result != RESULT_OK)
        return result;
    if (isnan(options->phong) && (!gbuffer->phong.pixels || options->phong_override))
        return error_set(err, RESULT_USAGE, "no Phong exponent: the passes have no phong.V channel; give one with "
                                            "--phong or --roughness");
    if (!cpu_isa_supported(options->isa))
        return error_set(err, RESULT_USAGE, "this processor lacks the instruction set asked for; use --isa auto");
    return RESULT_OK;
}

static void shared_choose(struct filter_shared *shared)
{
    static filter_kernel *const kernels[CPU_ISA_COUNT] = {[CPU_ISA_SSE2] = filter_kernel_sse2,
                                                          [CPU_ISA_AVX2] = filter_kernel_avx2,
                                                          [CPU_ISA_AVX512] = filter_kernel_avx512};
    static filter_see *const sees[CPU_ISA_COUNT] = {
        [CPU_ISA_SSE2] = filter_see_sse2, [CPU_ISA_AVX2] = filter_see_avx2, [CPU_ISA_AVX512] = filter_see_avx512};
    const struct filter_options *options = shared->options;
    const enum cpu_isa isa = options->isa == CPU_ISA_AUTO ? cpu_isa_best() : options->isa;
    shared->kernel = kernels[isa];
    shared->see = sees[isa];
    shared->energy = options->energy > 0 ? options->energy : 0.99;
    shared->floor = options->energy > 0 ? 1 - options->energy : 0.001;
    shared->radius_limit_px = hypot(shared->gbuffer->specular.width, shared->gbuffer->specular.height);
    if (options->max_radius_px > 0)
        shared->radius_limit_px = fmin(shared->radius_limit_px, options->max_radius_px);
    filter_level_scales(shared);
}

enum result filter_glossy(const struct gbuffer *gbuffer, const struct filter_options *options, struct image *glossy,
                          struct image *measure, struct error *err)
{
    struct filter_shared shared = {.gbuffer = gbuffer, .options = options};
    struct filter_level level = {0};
    const int threads = options->threads, step = options->radius_step;
    const int height = gbuffer->specular.height;
    const bool paper = options->mode == FILTER_MODE_PAPER;
    *glossy = (struct image){0};
    if (measure)
        *measure = (struct image){0};
    enum result result = check(gbuffer, options, err);
    if (result != RESULT_OK)
        return result;
    shared.table = malloc(WEIGHTS_TABLE_SIZE * sizeof *shared.table);
    if (!shared.table)
        return error_memory(err, (double)(WEIGHTS_TABLE_SIZE * sizeof *shared.table));
    weights_table_build(shared.table);
    shared_choose(&shared);
    result = filter_level_alloc(&level, &shared, err);
    if (result == RESULT_OK)
        result = bands_run(height, 16, threads, filter_level_taps, &level, err);
    if (result == RESULT_OK && !paper)
        result = bands_run(height, 16, threads, filter_level_areas, &level, err);
    if (result == RESULT_OK)
        result = bands_run((height + step - 1) / step, 16, threads, filter_level_radius_coarse, &level, err);
    if (result == RESULT_OK)
        result = bands_run(height, 16, threads, filter_level_radius_fine, &level, err);
    if (result == RESULT_OK)
        result = options->tolerance > 0 ? filter_sparse(&level, options->tolerance, err) : filter_exact(&level, err);
    if (result == RESULT_OK && gbuffer->rays.pixels)
        result = control_variate(gbuffer, options->phong_override ? options->phong : NAN, threads, &level.glossy, err);
    if (result == RESULT_OK && gbuffer->reflectance.pixels)
        result = bands_run(height, 16, threads, edges, &level, err);
    if (result == RESULT_OK) {
        *glossy = level.glossy;
        level.glossy = (struct image){0};
    }
    if (result == RESULT_OK && measure) {
        struct image *found = paper ? &level.radius : &level.confidence;
        *measure = *found;
        *found = (struct image){0};
    }
    filter_level_free(&level);
    free(shared.table);
    return result;
}
