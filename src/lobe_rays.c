/* Rounds of rays; those at every pixel are traced some rows at a time, for each needs some memory until it is back. */
#include "lobe_rays.h"

#include <stdio.h>

enum { PIXELS_AT_ONCE = 1 << 16 };

enum result lobe_rays_measure(const struct command *command, struct passes *passes, int frame, struct probes *probes,
                              struct error *err)
{
    enum result result = RESULT_OK;
    long round = 0;
    while (!result && probes_left(probes)) {
        struct buffer view = {0};
        struct image image = {0};
        int width, height;
        if (round != probes->rays && !command->filter.quiet)
            fprintf(stderr, "povgloss: %ld rays at each of %d points\n", probes->rays, probes_open(probes));
        round = probes->rays;
        result = probes_view(probes, &view, &width, &height, err);
        if (!result)
            result = passes_view(passes, frame, &view, width, height, &image, err);
        if (!result)
            result = probes_take(probes, &image, err);
        image_free(&image);
        buffer_free(&view);
    }
    return result;
}

static void replace_exponents(struct gbuffer *gbuffer, float phong)
{
    for (int y = 0; y < gbuffer->phong.height; y++)
        for (int x = 0; x < gbuffer->phong.width; x++)
            if (image_row(&gbuffer->phong, 0, y)[x] > 0)
                image_row(&gbuffer->phong, 0, y)[x] = phong;
}

enum result lobe_rays_trace(const struct command *command, struct passes *passes, int frame, struct gbuffer *gbuffer,
                            struct error *err)
{
    const int width = gbuffer->phong.width, height = gbuffer->phong.height;
    const struct filter_options *filter = &command->filter.filter;
    struct timings_moment start = timings_now();
    if (!gbuffer->mirrored.pixels)
        return RESULT_OK;
    if (filter->phong_override)
        replace_exponents(gbuffer, filter->phong);
    enum result result = image_alloc(&gbuffer->rays, width, height, 4, err);
    int rows = width < PIXELS_AT_ONCE ? PIXELS_AT_ONCE / width : 1;
    for (int row = 0; !result && row < height; row += rows) {
        struct probes probes = {0};
        const struct probe_options options = {.grid = width,
                                              .rays = command->rays,
                                              .first_row = row,
                                              .end_row = row + rows < height ? row + rows : height};
        result = probes_begin(&probes, gbuffer, &options, err);
        if (!result)
            result = lobe_rays_measure(command, passes, frame, &probes, err);
        if (!result)
            probes_means(&probes, &gbuffer->rays);
        probes_free(&probes);
    }
    timings_add(command->filter.timings, "rays", start);
    return result;
}
