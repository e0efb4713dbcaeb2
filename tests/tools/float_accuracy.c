/* float_accuracy: prints docs/reliability.md's table of the filters' errors against their sums in double, all pixels by
 * all pixels. For each exponent four pictures of the tests' scene: open and closed, the whole of it and as near as the
 * lobe is narrow; the radiance is noise, so that no error of a weight is lost in an even place.
 */
#include "../unit/gloss_support.h"

enum { WIDTH = 97, HEIGHT = 73, STRIDE = 3, PICTURES = 4 };

static int compare_errors(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static void make_noise(struct image *image)
{
    uint32_t bits = 1;
    for (size_t i = 0; i < image->stride * (size_t)image->height * (size_t)image->channels; i++) {
        bits = bits * 1664525u + 1013904223u;
        image->pixels[i] = (float)(bits >> 8) * 0x1p-24f;
    }
}

/* Of one filter, in a cell of the table. */
static void print_errors(float phong, enum filter_mode mode, enum filter_weights weights)
{
    static double errors[PICTURES * WIDTH * HEIGHT];
    int count = 0;
    for (int picture = 0; picture < PICTURES; picture++) {
        struct scene scene = {.scale = 1, .ball = true, .bounded = picture & 1};
        struct filter_options options = filter_options_default();
        struct gbuffer gbuffer;
        if (picture & 2)
            scene.view_angle = scene_view_angle((double)phong);
        options.mode = mode;
        options.weights = weights;
        scene_draw(&scene, WIDTH, HEIGHT, phong, &gbuffer);
        make_noise(&gbuffer.specular);
        count += mode == FILTER_MODE_BEST
                     ? oracle_best_errors(&gbuffer, &options, STRIDE, errors + count)
                     : oracle_errors(&gbuffer, &options, lobe_weight, STRIDE, errors + count);
        gbuffer_free(&gbuffer);
    }
    qsort(errors, (size_t)count, sizeof *errors, compare_errors);
    printf(" %.1e | %.1e |", errors[count - 1], errors[(int)(0.999 * (count - 1))]);
}

int main(void)
{
    printf("| p | best: worst | 99.9 %% | paper: worst | 99.9 %% | paper, tabulated: worst | 99.9 %% |\n"
           "|---|---|---|---|---|---|---|\n");
    for (int power = 0; power <= 8; power++) {
        float phong = (float)pow(10, power);
        printf("| 1e%d |", power);
        print_errors(phong, FILTER_MODE_BEST, FILTER_WEIGHTS_EXACT);
        print_errors(phong, FILTER_MODE_PAPER, FILTER_WEIGHTS_EXACT);
        print_errors(phong, FILTER_MODE_PAPER, FILTER_WEIGHTS_TABLE);
        printf("\n");
    }
    return 0;
}
