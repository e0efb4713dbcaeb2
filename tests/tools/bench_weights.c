/* What one weight costs in the exact sums: bench_weights [RUNS]
 *
 * The kernels of filter_kernel.h alone, on one core, for 16 pixels in the middle of a picture all of which they see:
 * every tap within RADIUS counts for every lane, so that the number of weights is known. Beside the nanoseconds,
 * medians of RUNS (9), stand the share of the processor's peak and that of its divider: of the time that the same
 * number of float operations, or of divisions, takes in a loop that does nothing else. No fused multiply-add: all
 * builds give the same bits. Status 1 where a sum is wrong, or differs between the instruction sets.
 */
#include "cpu.h"
#include "filter_kernel.h"
#include "weights.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SIDE = 256, X = 112, Y = 128, RADIUS = 100, RUNS = 99 };
static const double pixel = 1e-3; /* size; all endpoints are 1 away */
static const double lobe_floor = 0.01; /* of the best filter */
static const double pi = 3.14159265358979324;

/* --- the processor's peak --- */

/* Independent chains: enough to hide the latency, few enough for 16 registers. */
enum { CHAINS = 12, ROUNDS = 200000 };

#define DEFINE_PEAK(isa, bytes, ...)                                                                                   \
    typedef float vector_##isa __attribute__((vector_size(bytes)));                                                    \
    __attribute__((noinline __VA_ARGS__)) static float multiply_add_##isa(float start)                                 \
    {                                                                                                                  \
        vector_##isa x[CHAINS], factor = {0}, term = {0}, sum = {0};                                                   \
        factor += 0.5f * start;                                                                                        \
        term += start;                                                                                                 \
        for (int i = 0; i < CHAINS; i++)                                                                               \
            x[i] = term + (float)i;                                                                                    \
        for (int n = 0; n < ROUNDS; n++)                                                                               \
            for (int i = 0; i < CHAINS; i++)                                                                           \
                x[i] = x[i] * factor + term;                                                                           \
        for (int i = 0; i < CHAINS; i++)                                                                               \
            sum += x[i];                                                                                               \
        return sum[0];                                                                                                 \
    }                                                                                                                  \
    __attribute__((noinline __VA_ARGS__)) static float divide_##isa(float start)                                       \
    {                                                                                                                  \
        vector_##isa x[CHAINS], term = {0}, sum = {0};                                                                 \
        term += start;                                                                                                 \
        for (int i = 0; i < CHAINS; i++)                                                                               \
            x[i] = term + (float)i;                                                                                    \
        for (int n = 0; n < ROUNDS; n++)                                                                               \
            for (int i = 0; i < CHAINS; i++)                                                                           \
                x[i] = term / x[i];                                                                                    \
        for (int i = 0; i < CHAINS; i++)                                                                               \
            sum += x[i];                                                                                               \
        return sum[0];                                                                                                 \
    }
DEFINE_PEAK(sse2, 16, )
DEFINE_PEAK(avx2, 32, , target("avx2"))
DEFINE_PEAK(avx512, 64, , target("avx512f"))

static const struct {
    const char *name;
    int lanes; /* of a vector */
    float (*multiply_add)(float start), (*divide)(float start);
    filter_kernel *kernel;
    filter_see *see;
} isas[CPU_ISA_COUNT] = {
    [CPU_ISA_SSE2] = {"SSE2", 4, multiply_add_sse2, divide_sse2, filter_kernel_sse2, filter_see_sse2},
    [CPU_ISA_AVX2] = {"AVX2", 8, multiply_add_avx2, divide_avx2, filter_kernel_avx2, filter_see_avx2},
    [CPU_ISA_AVX512] = {"AVX-512", 16, multiply_add_avx512, divide_avx512, filter_kernel_avx512, filter_see_avx512},
};

/* --- the sums --- */

/* Float operations and divisions of one weight, counted in the source: additions, multiplications, minima, maxima,
 * comparisons with their choice, and divisions are one each; what is done in integers is left out. */
static const struct variant {
    const char *name;
    bool see;
    enum filter_shape shape;
    double phong;
    int operations, divisions;
} variants[] = {
    {"best, seen, p = 100", true, FILTER_SHAPE_SOLID, 100, 135, 3},
    {"best, seen, p = 300", true, FILTER_SHAPE_SOLID, 300, 126, 3},
    {"best, the rest, p = 100", false, FILTER_SHAPE_SOLID, 100, 76, 2},
    {"best, the rest, p = 300", false, FILTER_SHAPE_SOLID, 300, 65, 2},
    {"paper, p = 100", false, FILTER_SHAPE_POWER, 100, 69, 1},
    {"paper, p = 300", false, FILTER_SHAPE_POWER, 300, 58, 1},
    {"paper, table", false, FILTER_SHAPE_TABLE, 100, 59, 1},
    {"paper, Gaussian", false, FILTER_SHAPE_GAUSS, 100, 49, 1},
};
enum { VARIANTS = sizeof variants / sizeof variants[0] };

static float table[WEIGHTS_TABLE_SIZE];

/* A mirror z = 0 that reflects a wall z = 1, seen from so far away that all directions are one. */
static bool taps_make(struct filter_taps *taps)
{
    const size_t stride = SIDE + 2 * FILTER_BORDER, plane = stride * SIDE, blocks = plane / FILTER_LANES;
    float *planes = aligned_alloc(64, FILTER_PLANES * plane * sizeof *planes);
    unsigned char *kinds = malloc(blocks);
    struct filter_box *boxes = malloc(blocks * sizeof *boxes);
    *taps = (struct filter_taps){
        .width = SIDE, .height = SIDE, .stride = stride, .kinds = kinds, .boxes = boxes, .table = table};
    for (int i = 0; i < FILTER_PLANES; i++)
        taps->planes[i] = planes + (size_t)i * plane;
    if (!planes || !kinds || !boxes)
        return false;
    weights_table_build(table);
    for (size_t i = 0; i < blocks; i++) {
        kinds[i] = FILTER_KIND_POSITION;
        boxes[i] = (struct filter_box){{-1, -1, 1}, {1, 1, 1}};
    }
    for (size_t i = 0; i < plane; i++) {
        const float values[FILTER_PLANES] = {
            [FILTER_PLANE_X] = (float)((double)(i % stride) * pixel),
            [FILTER_PLANE_Y] = (float)((double)(i / stride) * pixel),
            [FILTER_PLANE_Z] = 1,
            [FILTER_PLANE_W] = 1,
            [FILTER_PLANE_GAIN] = 1,
            [FILTER_PLANE_R] = 1,
            [FILTER_PLANE_G] = 0.5f,
            [FILTER_PLANE_B] = 0.25f,
            [FILTER_PLANE_AREA] = (float)(pixel * pixel),
            [FILTER_PLANE_NEAREST] = 0.1f};
        for (int k = 0; k < FILTER_PLANES; k++)
            planes[(size_t)k * plane + i] = values[k];
    }
    return true;
}

static double reach_of(double phong)
{
    return pow(lobe_floor, -2 / phong) - 1;
}

static struct filter_lanes lanes_make(const struct variant *variant)
{
    struct filter_lanes lanes = {.x = X, .y = Y, .kinds = FILTER_KIND_POSITION, .farthest = 1, .limit_px = RADIUS,
                                 .box = {{0, 0, 0}, {1, 1, 0}}, .floor = (float)lobe_floor};
    const double reach = reach_of(variant->phong), blind = 1.21 * reach;
    double slope = variant->phong / 2;
    lanes.narrow = variant->see ? reach <= (double)FILTER_NARROW_REACH : slope >= (double)FILTER_NARROW_SLOPE;
    if (variant->shape == FILTER_SHAPE_TABLE)
        slope *= log(2) * WEIGHTS_TABLE_STEPS;
    if (variant->shape == FILTER_SHAPE_GAUSS)
        slope /= log(2);
    for (int l = 0; l < FILTER_LANES; l++) {
        lanes.a[0][l] = lanes.b[0][l] = (float)((X + FILTER_BORDER + l) * pixel);
        lanes.a[1][l] = lanes.b[1][l] = (float)(Y * pixel);
        lanes.b[2][l] = lanes.b[3][l] = lanes.direction[2][l] = lanes.distance[l] = 1;
        lanes.across[0][0][l] = lanes.across[1][1][l] = 1;
        lanes.slope[l] = (float)slope;
        lanes.limit[l] = RADIUS * RADIUS;
        lanes.reach[l] = (float)reach;
        lanes.blind[l] = (float)blind;
        lanes.fade[l] = (float)(1 / (0.7 * blind));
    }
    return lanes;
}

/* Sum of the weights of one lane, in double, and how many they are. */
static double oracle(const struct variant *variant, long *count)
{
    double sum = 0;
    *count = 0;
    for (int dy = -RADIUS; dy <= RADIUS; dy++)
        for (int dx = -RADIUS; dx <= RADIUS; dx++) {
            if (dx * dx + dy * dy > RADIUS * RADIUS)
                continue;
            const double t = (dx * dx + dy * dy) * pixel * pixel, blind = 1.21 * reach_of(variant->phong);
            double f = exp(-variant->phong / 2 * (variant->shape == FILTER_SHAPE_GAUSS ? t : log1p(t)));
            if (variant->see)
                f = fmax(f - lobe_floor, 0) * fmin((blind - t) / (0.7 * blind), 1);
            if (variant->shape == FILTER_SHAPE_SOLID)
                f *= pixel * pixel / (1 + t + pixel * pixel / (2 * pi));
            sum += f;
            ++*count;
        }
    return sum;
}

static void sum_up(const struct variant *variant, enum cpu_isa isa, const struct filter_taps *taps, float *scratch,
                   double sums[FILTER_LANES])
{
    const struct filter_lanes lanes = lanes_make(variant);
    struct filter_moments moments;
    struct filter_sums of_kernel;
    if (variant->see)
        isas[isa].see(taps, &lanes, scratch, &moments);
    else
        isas[isa].kernel(taps, &lanes, &of_kernel);
    memcpy(sums, variant->see ? moments.value[FILTER_MOMENT_1] : of_kernel.value[3], FILTER_LANES * sizeof *sums);
}

/* --- times --- */

static double seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *times, int runs)
{
    qsort(times, (size_t)runs, sizeof *times, ascending);
    return times[runs / 2];
}

/* Nanoseconds of one lane's operation in the loop. */
static double peak(float (*loop)(float start), int operations, int lanes, int runs)
{
    double times[RUNS];
    volatile float result;
    for (int r = 0; r < runs; r++) {
        const double start = seconds();
        result = loop(1);
        times[r] = seconds() - start;
    }
    (void)result;
    return 1e9 * median(times, runs) / ((double)ROUNDS * CHAINS * operations * lanes);
}

/* Prints one variant's line. Whether its sums are right. */
static bool measure(const struct variant *variant, const struct filter_taps *taps, float *scratch, int runs,
                    const double peaks[CPU_ISA_COUNT][2])
{
    enum { REPEATS = 10 };
    long count;
    double sums[CPU_ISA_COUNT][FILTER_LANES], times[RUNS];
    const double expected = oracle(variant, &count);
    printf("| %s |", variant->name);
    for (int isa = CPU_ISA_SSE2; isa < CPU_ISA_COUNT; isa++) {
        if (!cpu_isa_supported((enum cpu_isa)isa)) {
            printf(" |");
            continue;
        }
        for (int r = 0; r < runs; r++) {
            const double start = seconds();
            for (int i = 0; i < REPEATS; i++)
                sum_up(variant, (enum cpu_isa)isa, taps, scratch, sums[isa]);
            times[r] = (seconds() - start) / REPEATS;
        }
        const double ns = 1e9 * median(times, runs) / ((double)count * FILTER_LANES);
        printf(" %.2f, %.0f %%, %.0f %% |", ns, 100 * variant->operations * peaks[isa][0] / ns,
               100 * variant->divisions * peaks[isa][1] / ns);
        if (memcmp(sums[isa], sums[CPU_ISA_SSE2], sizeof sums[isa]) != 0 ||
            !(fabs(sums[isa][0] - expected) <= 1e-3 * expected)) {
            fprintf(stderr, "bench_weights: %s, %s: the sum of the weights is %g, not %g\n", variant->name,
                    isas[isa].name, sums[isa][0], expected);
            return false;
        }
    }
    printf("\n");
    return true;
}

int main(int argc, char **argv)
{
    const int runs = argc > 1 ? atoi(argv[1]) : 9;
    struct filter_taps taps;
    double peaks[CPU_ISA_COUNT][2];
    float *scratch = aligned_alloc(64, FILTER_SEE_SCRATCH(SIDE));
    bool right = true;
    if (argc > 2 || runs < 1 || runs > RUNS) {
        fprintf(stderr, "usage: bench_weights [RUNS]\n");
        return 2;
    }
    if (!taps_make(&taps) || !scratch) {
        fprintf(stderr, "bench_weights: no memory\n");
        return 3;
    }
    printf("| ns a weight and core, share of the peak, of the divider |");
    for (int isa = CPU_ISA_SSE2; isa < CPU_ISA_COUNT; isa++) {
        if (!cpu_isa_supported((enum cpu_isa)isa)) {
            printf(" %s |", isas[isa].name);
            continue;
        }
        peaks[isa][0] = peak(isas[isa].multiply_add, 2, isas[isa].lanes, runs);
        peaks[isa][1] = peak(isas[isa].divide, 1, isas[isa].lanes, runs);
        printf(" %s (%.0f G/s, %.1f G/s divided) |", isas[isa].name, 1 / peaks[isa][0], 1 / peaks[isa][1]);
    }
    printf("\n|---|---|---|---|\n");
    for (int i = 0; i < VARIANTS && right; i++) {
        taps.shape = variants[i].shape;
        right = measure(&variants[i], &taps, scratch, runs, (const double(*)[2])peaks);
    }
    free(scratch);
    free((void *)taps.boxes);
    free((void *)taps.kinds);
    free((void *)taps.planes[0]);
    return !right;
}
