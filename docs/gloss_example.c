/* cc gloss_example.c $(pkg-config --cflags --libs libgloss): a mirror under a sky that is black on the left and white on
 * the right, at exponent 200. */
#include <gloss.h>
#include <stdio.h>

enum { WIDTH = 64, HEIGHT = 16, SIZE = WIDTH * HEIGHT };
static float sky[SIZE], x[SIZE], z[SIZE], zero[SIZE], up[SIZE], direction_x[SIZE], red[SIZE], green[SIZE], blue[SIZE];

int main(void)
{
    for (int i = 0; i < SIZE; i++) {
        x[i] = (float)(i % WIDTH - WIDTH / 2) * 0.02f;
        z[i] = (float)(i / WIDTH) * 0.02f;
        direction_x[i] = x[i]; /* seen from 1 above, mirrored upwards */
        up[i] = 1;
        sky[i] = x[i] < 0 ? 0 : 1;
    }
    const struct gloss_planes planes = {.width = WIDTH, .height = HEIGHT, .specular = {sky, sky, sky},
                                        .position = {x, zero, z}, .endpoint = {direction_x, up, z, zero}};
    char message[256];
    float *const glossy[3] = {red, green, blue};
    if (gloss_filter(&planes, &(struct gloss_options){.phong = 200}, glossy, message, sizeof message))
        return fprintf(stderr, "%s\n", message), 1;
    for (int i = 0; i < WIDTH; i += 4)
        printf("%.3f ", (double)red[SIZE / 2 + i]);
    return 0;
}
