/* compare_depths WHITE.exr BLACK.exr DISTANCE TOLERANCE
 *
 * Compares the positions and endpoints of a passes file with what POV-Ray's own fog says of their distances. The two passes
 * files are of one scene that ends in `fog { distance DISTANCE rgb 1 }` and rgb 0: along a way d the white fog is brighter
 * by 1 - exp(-d/DISTANCE). In the base d is the way from the eye to a; of the specular pass, which leaves that to the base, the
 * way on to b, seen through the fog before a.
 * Differences are given as shares of the fog's brightness. Ends with 1 when more than 5 in 1000 of them (edges) are beyond
 * the tolerance, or no pixel is glossy.
 */
#include "gamma.h"
#include "passes_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* How much brighter the white fog is; POV-Ray adds it in its working space. */
static double fog(const struct image *white, const struct image *black, double gamma, int x, int y)
{
    return gamma_encode(gamma, image_row(white, 1, y)[x]) - gamma_encode(gamma, image_row(black, 1, y)[x]);
}

int main(int argc, char **argv)
{
    struct gbuffer white, black;
    struct error err;
    if (argc != 5)
        return 2;
    double distance = atof(argv[3]), tolerance = atof(argv[4]), most[2] = {0};
    if (passes_file_read(argv[1], &white, &err) || passes_file_read(argv[2], &black, &err)) {
        fprintf(stderr, "%s\n", err.text);
        return 3;
    }
    if (!white.has_eye) {
        fprintf(stderr, "%s: has no eye\n", argv[1]);
        return 1;
    }
    double gamma = white.working_gamma == 0 ? 1 : white.working_gamma;
    int glossy = 0, misses = 0, beyond[2] = {0};
    for (int y = 0; y < white.phong.height; y++)
        for (int x = 0; x < white.phong.width; x++) {
            if (!(image_row(&white.phong, 0, y)[x] > 0))
                continue;
            double a[3], b[3], w = image_row(&white.endpoint, 3, y)[x];
            for (int axis = 0; axis < 3; axis++) {
                double position = image_row(&white.position, axis, y)[x];
                a[axis] = position - white.eye[axis];
                b[axis] = image_row(&white.endpoint, axis, y)[x] - w * position;
            }
            double to_a = exp(-length(a) / distance), to_b = w > 0 ? to_a * exp(-length(b) / w / distance) : 0;
            double errors[2] = {fabs(1 - to_a - fog(&white.base, &black.base, gamma, x, y)),
                                fabs(to_a - to_b - fog(&white.specular, &black.specular, gamma, x, y))};
            for (int i = 0; i < 2; i++) {
                beyond[i] += !(errors[i] <= tolerance);
                most[i] = fmax(most[i], errors[i]);
            }
            glossy++;
            misses += w == 0;
        }
    gbuffer_free(&white);
    gbuffer_free(&black);
    printf("%d glossy pixels, %d misses; beyond %g: %d positions, %d endpoints; at most %.2g and %.2g\n", glossy, misses,
           tolerance, beyond[0], beyond[1], most[0], most[1]);
    return glossy == 0 || beyond[0] * 200 > glossy || beyond[1] * 200 > glossy;
}
