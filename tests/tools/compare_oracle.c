/* compare_oracle PASSES.exr exact|table TOLERANCE
 *
 * Filters a passes file at its own exponents and compares every glossy pixel with equation (1) in double, all pixels by all
 * pixels; prints the largest relative error and ends with 1 when it is beyond the tolerance.
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
    options.weights = strcmp(argv[2], "table") ? FILTER_WEIGHTS_EXACT : FILTER_WEIGHTS_TABLE;
    double error = oracle_error(&gbuffer, &options, lobe_weight, 1), tolerance = atof(argv[3]);
    printf("%s weights: largest relative error %.2g, %g is allowed\n", argv[2], error, tolerance);
    gbuffer_free(&gbuffer);
    return !(error <= tolerance);
}
