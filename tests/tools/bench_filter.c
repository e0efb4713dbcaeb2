/* Times of the filter and their errors: bench_filter PASSES.exr RUNS "LIMIT OPTIONS" ...
 *
 * Each variant is glossfilter's options; the first is the reference. Variants take turns, so that all meet the same load;
 * a line has the median of the RUNS times in seconds, the reference's over it, and RMSE, 99.9 % quantile and largest
 * difference from it in linear light. Status 1 where an RMSE is above its limit.
 */
#include "cli.h"
#include "cpu.h"
#include "filter.h"
#include "passes_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { VARIANTS = 8, RUNS = 99, ARGUMENTS = 32 };

struct variant {
    const char *name; /* its options */
    struct filter_options options;
    double limit, times[RUNS];
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

/* Takes `text` to pieces. */
static enum result read_variant(char *text, char *passes, struct variant *variant, struct error *err)
{
    char *arguments[ARGUMENTS] = {"glossfilter", passes, "-o", "none.exr"}, *options;
    struct cli_glossfilter command;
    int count = 4;
    variant->limit = strtod(text, &options);
    options += strspn(options, " ");
    char *words = strdup(options);
    if (!words)
        return error_memory(err, (double)strlen(options));
    variant->name = options;
    for (char *word = strtok(words, " "); word && count < ARGUMENTS; word = strtok(NULL, " "))
        arguments[count++] = word;
    enum result result = cli_glossfilter(count, arguments, &command, err);
    variant->options = command.options.filter;
    text_list_free(&command.map);
    free(words);
    return result;
}

/* Times of all variants, in turn; those that need another processor are left out. */
static enum result run(const struct gbuffer *gbuffer, struct variant *variants, int count, int runs, struct error *err)
{
    enum result result = RESULT_OK;
    for (int r = 0; r < runs; r++)
        for (int i = 0; i < count && !result; i++) {
            if (!cpu_isa_supported(variants[i].options.isa))
                continue;
            image_free(&variants[i].glossy);
            double start = seconds();
            result = filter_glossy(gbuffer, &variants[i].options, &variants[i].glossy, NULL, err);
            variants[i].times[r] = seconds() - start;
        }
    return result;
}

int main(int argc, char **argv)
{
    struct variant variants[VARIANTS] = {{NULL}};
    struct gbuffer gbuffer = {0};
    struct error err;
    const int count = argc - 3, runs = argc > 3 ? atoi(argv[2]) : 0;
    bool right = true;
    if (count < 1 || count > VARIANTS || runs < 1 || runs > RUNS) {
        fprintf(stderr, "usage: bench_filter PASSES.exr RUNS \"LIMIT OPTIONS\" ...\n");
        return RESULT_USAGE;
    }
    enum result result = passes_file_read(argv[1], &gbuffer, &err);
    for (int i = 0; i < count && !result; i++)
        result = read_variant(argv[3 + i], argv[1], &variants[i], &err);
    if (!result)
        result = run(&gbuffer, variants, count, runs, &err);
    if (result)
        cli_complain("bench_filter", &err);
    double reference = median(variants[0].times, runs);
    for (int i = 0; i < count && !result; i++) {
        double time = median(variants[i].times, runs);
        if (!variants[i].glossy.pixels)
            continue;
        printf("| %s | %.3f | %.2f |", variants[i].name, time, reference / time);
        right = compare(&variants[i], &variants[0].glossy) && right;
    }
    for (int i = 0; i < count; i++)
        image_free(&variants[i].glossy);
    gbuffer_free(&gbuffer);
    return result ? (int)result : !right;
}
