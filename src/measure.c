/* The passes once, then rounds of rays from the points that they found. */
#include "measure.h"

#include "draw.h"
#include "lobe_rays.h"
#include "probe_file.h"

#include <stdio.h>

static enum result draw_probes(const struct command *command, const struct probes *probes,
                               const struct gbuffer *gbuffer, struct error *err)
{
    struct image glossy = {0};
    enum result result = probes_image(probes, gbuffer, &glossy, err);
    if (!result)
        result = cli_write(command->output, &command->filter, gbuffer, &glossy, NULL, err);
    image_free(&glossy);
    return result;
}

enum result measure_probes(struct command *command, struct error *err)
{
    struct passes *passes = NULL;
    struct gbuffer gbuffer = {0};
    struct probes probes = {0};
    enum result result = draw_check_place(command->output, err);
    command->passes.rays = true;
    if (command->kind == KIND_BRUTE) {
        command->probe.grid = IMAGE_MAX_SIDE;
        command->probe.rays = command->probe.rays ? command->probe.rays : 64;
    }
    command->probe.exponents = (const double *)(const void *)command->exponents.data;
    command->probe.exponent_count = (int)(command->exponents.size / sizeof(double));
    if (!result)
        result = draw_passes(command, &passes, command->passes.frames.first, "", &gbuffer, err);
    if (!result)
        result = probes_begin(&probes, &gbuffer, &command->probe, err);
    if (!result)
        result = lobe_rays_measure(command, passes, command->passes.frames.first, &probes, err);
    if (!result)
        result = passes_settle(passes, err);
    draw_close_passes(&passes);
    int left = result || command->kind == KIND_BRUTE ? 0 : probes_open(&probes);
    struct error note = {0};
    if (left > 0)
        error_set(&note, RESULT_OK,
                  "%s: %d of %d probes have a larger error than %g after %d rays: see their column error",
                  command->path, left, probes.count, command->probe.error, PROBE_MOST_RAYS);
    draw_warn(command, "", &note);
    if (!result)
        result = command->kind == KIND_BRUTE ? draw_probes(command, &probes, &gbuffer, err)
                                             : probe_file_write(command->output, &probes, err);
    probes_free(&probes);
    gbuffer_free(&gbuffer);
    return result;
}

enum result measure_compare(const struct command *command, struct error *err)
{
    struct probe_comparison found;
    const double *phong = (const double *)(const void *)command->exponents.data;
    enum result result = probe_file_compare(command->scene, command->image, phong ? *phong : -1, &found, err);
    if (!result)
        printf("probes %d\nrmse %.6g\nbias %.6g\nmedian %.6g\np95 %.6g\nworst %.6g\nworst_at %d,%d\nnoise %.6g\n",
               found.count, found.rmse, found.bias, found.median, found.percentile_95, found.worst, found.worst_x,
               found.worst_y, found.noise);
    if (!result && (fflush(stdout) || ferror(stdout)))
        result = error_set(err, RESULT_DATA, "standard output: cannot be written");
    return result;
}
