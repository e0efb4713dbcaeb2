/* compare_points PASSES.exr POINTS.txt SIZE TOLERANCE
 *
 * Compares the positions and endpoints of a passes file with those that POV-Ray's trace() found (points_trace.pov), as shares
 * of the scene's SIZE, and directions as they are; prints the largest and the median error. Ends with 1 when an error is
 * beyond the tolerance. Pixels whose mirrored ray grazes an edge may hit either side, so up to 2 in 1000 may disagree on
 * what they hit; they are counted and printed, too.
 */
#include "passes_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double distance(const struct image *image, int x, int y, const double to[3])
{
    double sum = 0;
    for (int axis = 0; axis < 3; axis++)
        sum += pow(image_row(image, axis, y)[x] - to[axis], 2);
    return sqrt(sum);
}

int main(int argc, char **argv)
{
    struct gbuffer gbuffer;
    struct error err;
    if (argc != 5)
        return 2;
    double size = atof(argv[3]), tolerance = atof(argv[4]);
    if (passes_file_read(argv[1], &gbuffer, &err)) {
        fprintf(stderr, "%s\n", err.text);
        return 3;
    }
    FILE *points = fopen(argv[2], "r");
    if (!points)
        return 3;
    int capacity = gbuffer.position.width * gbuffer.position.height, count = 0, listed = 0, otherwise = 0, glossy = 0, misses = 0;
    double *errors = calloc((size_t)capacity * 2, sizeof *errors);
    int x, y, w;
    double a[3], b[3];
    while (errors && fscanf(points, "%d %d %lf %lf %lf %lf %lf %lf %d", &x, &y, &a[0], &a[1], &a[2], &b[0], &b[1], &b[2],
                            &w) == 9) {
        listed++;
        double a_error = distance(&gbuffer.position, x, y, a) / size;
        double b_error = distance(&gbuffer.endpoint, x, y, b) / (w ? size : 1);
        bool same_kind = image_row(&gbuffer.phong, 0, y)[x] > 0 && (image_row(&gbuffer.endpoint, 3, y)[x] > 0) == (w > 0);
        misses += !w;
        if (!same_kind || a_error > 1e-3 || b_error > 1e-3) {
            otherwise++;
            continue;
        }
        errors[count++] = a_error;
        errors[count++] = b_error;
    }
    fclose(points);
    for (y = 0; y < gbuffer.phong.height; y++)
        for (x = 0; x < gbuffer.phong.width; x++)
            glossy += image_row(&gbuffer.phong, 0, y)[x] > 0;
    gbuffer_free(&gbuffer);
    if (count == 0) {
        fprintf(stderr, "no point to compare\n");
        return 1;
    }
    qsort(errors, (size_t)count, sizeof *errors, by_value);
    printf("%d glossy pixels by trace(), %d by the passes, %d misses; %d hit something else; error: largest %.2g, median %.2g\n",
           listed, glossy, misses, otherwise, errors[count - 1], errors[count / 2]);
    int failed = errors[count - 1] > tolerance || otherwise * 500 > listed || abs(listed - glossy) * 500 > listed;
    free(errors);
    return failed;
}
