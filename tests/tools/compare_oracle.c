/* compare_oracle PASSES.exr exact|table|best TOLERANCE
 *
 * Filters a passes file at its own exponents and compares every glossy pixel with the sum in double, all pixels by all
 * pixels: equation (1) by exact or tabulated weights, or the best filter's. Prints the largest relative error and ends
 * with 1 when it is beyond the tolerance.
 */
#include "../unit/gloss_support.h"

#include "lobe.h"
#include "passes_file.h"

int main(int argc, char **argv)
{
    struct gbuffer gbuffer;
    struct error err;
    if (argc != 4)
        return 2;
    if (passes_file_read(argv[1], &gbuffer, &err)) {
        fprintf(stderr, "%s\n", err.text);
        return 3;
    }
    struct filter_options options = filter_options_default();
    const bool best = !strcmp(argv[2], "best");
    options.mode = best ? FILTER_MODE_BEST : FILTER_MODE_PAPER;
    options.weights = strcmp(argv[2], "table") ? FILTER_WEIGHTS_EXACT : FILTER_WEIGHTS_TABLE;
    double tolerance = atof(argv[3]);
    double error = best ? oracle_best_error(&gbuffer, &options, 1) : oracle_error(&gbuffer, &options, lobe_weight, 1);
    printf("%s: largest relative error %.2g, %g is allowed\n", argv[2], error, tolerance);
    gbuffer_free(&gbuffer);
    return !(error <= tolerance);
}
