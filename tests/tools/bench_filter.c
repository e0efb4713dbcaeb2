/* Times of the filter and their errors: bench_filter PASSES.exr P THREADS RUNS NAME=TOLERANCE[:LIMIT] ...
 *
 * The first variant is the reference. Variants take turns, so that all meet the same load; a line has the median of the
 * RUNS times in seconds, the reference's over it, and RMSE, 99.9 % quantile and largest difference from it in linear
 * light. Status 1 where an RMSE is above its limit.
 */
#include "filter.h"
#include "passes_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { VARIANTS = 8, RUNS = 99 };

struct variant {
    const char *name;
    double tolerance, limit, times[RUNS];
    struct image glossy;
};

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double median(double *times, int runs)
{
    qsort(times, (size_t)runs, sizeof *times, ascending);
    return times[runs / 2];
}

/* Prints the errors, of the largest channel at pixels whose reference isn't black. Whether the RMSE is within the
 * limit. */
static bool compare(const struct variant *variant, const struct image *reference)
{
    size_t count = 0;
    double sum = 0, *worst = malloc((size_t)reference->width * (size_t)reference->height * sizeof *worst);
    for (int y = 0; worst && y < reference->height; y++)
        for (int x = 0; x < reference->width; x++) {
            double largest = 0, value = 0;
            for (int i = 0; i < 3; i++) {
                double expected = (double)image_row(reference, i, y)[x];
                double difference = fabs((double)image_row(&variant->glossy, i, y)[x] - expected);
                largest = fmax(largest, difference);
                value += fabs(expected);
                sum += difference * difference;
            }
            if (value > 0)
                worst[count++] = largest;
        }
    if (!worst || count == 0)
        return false;
    qsort(worst, count, sizeof *worst, ascending);
    double rmse = sqrt(sum / (3 * (double)count));
    printf(" %.5f | %.4f | %.4f |\n", rmse, worst[(size_t)(0.999 * (double)(count - 1))], worst[count - 1]);
    free(worst);
    return rmse <= variant->limit;
}

static bool read_variants(int count, char **texts, struct variant *variants)
{
    for (int i = 0; i < count; i++) {
        char *equals = strchr(texts[i], '='), *end = NULL;
        if (!equals)
            return false;
        *equals = '\0';
        variants[i].name = texts[i];
        variants[i].tolerance = strtod(equals + 1, &end);
        variants[i].limit = *end == ':' ? strtod(end + 1, &end) : INFINITY;
        if (*end)
            return false;
    }
    return true;
}

int main(int argc, char **argv)
{
    struct variant variants[VARIANTS] = {{NULL}};
    struct gbuffer gbuffer = {0};
    struct error err;
    const int count = argc - 5, runs = argc > 5 ? atoi(argv[4]) : 0;
    if (count < 1 || count > VARIANTS || runs < 1 || runs > RUNS || !read_variants(count, argv + 5, variants)) {
        fprintf(stderr, "usage: bench_filter PASSES.exr P THREADS RUNS NAME=TOLERANCE[:LIMIT] ...\n");
        return 2;
    }
    if (passes_file_read(argv[1], &gbuffer, &err)) {
        fprintf(stderr, "bench_filter: %s\n", err.text);
        return 3;
    }
    struct filter_options options = filter_options_default();
    options.phong = strtof(argv[2], NULL);
    options.phong_override = true;
    options.threads = atoi(argv[3]);
    for (int run = 0; run < runs; run++)
        for (int i = 0; i < count; i++) {
            image_free(&variants[i].glossy);
            options.tolerance = variants[i].tolerance;
            double start = seconds();
            if (filter_glossy(&gbuffer, &options, &variants[i].glossy, NULL, &err)) {
                fprintf(stderr, "bench_filter: %s\n", err.text);
                return 3;
            }
            variants[i].times[run] = seconds() - start;
        }
    bool right = true;
    double reference = median(variants[0].times, runs);
    for (int i = 0; i < count; i++) {
        double time = median(variants[i].times, runs);
        printf("| %s | %.3f | %.2f |", variants[i].name, time, reference / time);
        right = compare(&variants[i], &variants[0].glossy) && right;
    }
    for (int i = 0; i < count; i++)
        image_free(&variants[i].glossy);
    gbuffer_free(&gbuffer);
    return right ? 0 : 1;
}
