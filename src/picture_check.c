/* The comparison with the renderer's own picture: what differs in the mean of blocks, and which neighbours do so
 * together. */
#include "picture_check.h"

#include <math.h>
#include <stdlib.h>

/* The largest odd whole ratio that leaves enough pixels; 1 where there is none. */
static int odd_ratio(int width, int height)
{
    enum { LEAST_PIXELS = 2000 };
    int best = 1;
    for (int ratio = 3; (long)(width / ratio) * (height / ratio) >= LEAST_PIXELS; ratio += 2)
        if (width % ratio == 0 && height % ratio == 0)
            best = ratio;
    return best;
}

/* Of the widths about a fifth, the one to which a whole height belongs best. */
static void similar_size(int width, int height, int *small_width, int *small_height)
{
    double least = INFINITY;
    for (int w = width / 6 + 1; w <= width / 4 + 1; w++) {
        double h = (double)w * height / width, whole = fmax(round(h), 1);
        double error = fabs(h - whole) / whole + 1e-6 * abs(5 * w - width);
        if (error >= least)
            continue;
        least = error;
        *small_width = w;
        *small_height = (int)whole;
    }
}

void picture_check_size(int width, int height, int *small_width, int *small_height)
{
    enum { SMALL = 160 * 160 };
    int ratio = odd_ratio(width, height);
    *small_width = width / ratio;
    *small_height = height / ratio;
    if (ratio == 1 && (long)width * height > SMALL)
        similar_size(width, height, small_width, small_height);
}

/* ---- both pictures in one size ---- */

static bool centres_coincide(int small_size, int size)
{
    return size % small_size == 0 && size / small_size % 2 == 1;
}

/* The place of a small picture's pixel along one axis of the full one: between first and first + 1. */
static double find_place(int at, int small_size, int size, int *first, int *second)
{
    double place = fmin(fmax((at + 0.5) / small_size * size - 0.5, 0), size - 1);
    *first = (int)place;
    *second = *first + 1 < size ? *first + 1 : *first;
    return place - *first;
}

/* What isn't to be seen is left out: infinity times 0. */
static double mix(double a, double b, double t)
{
    return t == 0 ? a : (1 - t) * a + t * b;
}

/* `sum` at the centres of the pixels of an image of the size of `small`. */
static void sample(const struct image *sum, const struct image *small)
{
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < small->height; y++) {
            int above, below;
            double down = find_place(y, small->height, sum->height, &above, &below);
            const float *upper = image_row(sum, i, above), *lower = image_row(sum, i, below);
            for (int x = 0; x < small->width; x++) {
                int left, right;
                double along = find_place(x, small->width, sum->width, &left, &right);
                image_row(small, i, y)[x] = (float)mix(mix((double)upper[left], (double)upper[right], along),
                                                       mix((double)lower[left], (double)lower[right], along), down);
            }
        }
}

/* ---- differences ---- */

struct pictures {
    const struct image *sum, *own; /* of one size */
    double tolerance;
};

/* own - sum and what of it is allowed, in one channel; 0 where there is no number. */
static double difference_at(const struct pictures *pictures, int channel, int x, int y, double *allowed)
{
    double own = (double)image_row(pictures->own, channel, y)[x], sum = (double)image_row(pictures->sum, channel, y)[x];
    double largest = fmax(fabs(own), fabs(sum));
    *allowed = pictures->tolerance * (1 + 2 * (isfinite(largest) ? largest : 0));
    return own == sum || isnan(own) || isnan(sum) ? 0 : own - sum;
}

struct block {
    int left, top, right, bottom;
};

/* Blocks of at least 4 x 4 pixels, where there are so many. */
static struct block find_block(const struct image *image, int column, int row, int columns, int rows)
{
    return (struct block){.left = (int)((long)image->width * column / columns),
                          .top = (int)((long)image->height * row / rows),
                          .right = (int)((long)image->width * (column + 1) / columns),
                          .bottom = (int)((long)image->height * (row + 1) / rows)};
}

/* Whether the mean difference is none of chance; *most is the largest of the channels. */
static bool block_differs(const struct pictures *pictures, const struct block *block, double *most)
{
    const double errors = 5;
    bool differs = false;
    *most = 0;
    for (int i = 0; i < 3; i++) {
        double count = 0, sum = 0, squares = 0, sum_allowed = 0;
        for (int y = block->top; y < block->bottom; y++)
            for (int x = block->left; x < block->right; x++) {
                double allowed, d = difference_at(pictures, i, x, y, &allowed);
                count++;
                sum += d;
                squares += d * d;
                sum_allowed += allowed;
            }
        double mean = fabs(sum) / count, variance = fmax(squares / count - mean * mean, 0);
        differs |= count > 1 && mean > sum_allowed / count + errors * sqrt(variance / (count - 1));
        *most = fmax(*most, mean);
    }
    return differs;
}

/* The pixel of a block that differs most. */
static void find_most(const struct pictures *pictures, const struct block *block, int *most_x, int *most_y)
{
    double most = -1;
    for (int y = block->top; y < block->bottom; y++)
        for (int x = block->left; x < block->right; x++)
            for (int i = 0; i < 3; i++) {
                double allowed, d = fabs(difference_at(pictures, i, x, y, &allowed));
                if (d <= most)
                    continue;
                most = d;
                *most_x = x;
                *most_y = y;
            }
}

/* The share of blocks that differ, and the pixel that does so most in the block that does so most. */
static double blocks_that_differ(const struct pictures *pictures, int *most_x, int *most_y)
{
    enum { SIDE = 4 };
    const struct image *own = pictures->own;
    int columns = own->width < SIDE ? 1 : own->width / SIDE, rows = own->height < SIDE ? 1 : own->height / SIDE;
    double count = 0, most = -1;
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            struct block block = find_block(own, column, row, columns, rows);
            double mean;
            count += block_differs(pictures, &block, &mean);
            if (mean <= most)
                continue;
            most = mean;
            find_most(pictures, &block, most_x, most_y);
        }
    return count / ((double)columns * rows);
}

/* 1 upwards, -1 downwards, 0 where a pixel doesn't differ: that channel decides which differs most. */
static int direction(const struct pictures *pictures, int x, int y)
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        double allowed, d = difference_at(pictures, i, x, y, &allowed), outside = fabs(d) - allowed;
        if (outside > fabs(most))
            most = copysign(outside, d);
    }
    return (most > 0) - (most < 0);
}

/* The share of pixels that differ as their neighbours do; 0 where that may be chance. */
static double pixels_that_agree(const struct pictures *pictures, signed char *directions)
{
    static const int neighbours[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
    const double deviations = 6;
    int width = pictures->own->width, height = pictures->own->height;
    double count = 0, same = 0, opposite = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            directions[y * width + x] = (signed char)direction(pictures, x, y);
            count += directions[y * width + x] != 0;
        }
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int i = 0; i < 4; i++) {
                int u = x + neighbours[i][0], v = y + neighbours[i][1];
                if (u < 0 || u >= width || v >= height)
                    continue;
                int join = directions[y * width + x] * directions[v * width + u];
                same += join > 0;
                opposite += join < 0;
            }
    return same - opposite > deviations * sqrt(same + opposite)
               ? count / ((double)width * height) * (same - opposite) / (same + opposite)
               : 0;
}

static void describe(const struct pictures *pictures, const struct image *full, int x, int y,
                     struct picture_difference *difference)
{
    difference->x = (int)((x + 0.5) / pictures->own->width * full->width);
    difference->y = (int)((y + 0.5) / pictures->own->height * full->height);
    for (int i = 0; i < 3; i++) {
        difference->sum[i] = image_row(pictures->sum, i, y)[x];
        difference->own[i] = image_row(pictures->own, i, y)[x];
    }
}

enum result picture_check(const struct image *sum, const struct image *own, bool single_rays, double tolerance,
                          struct picture_difference *difference, struct error *err)
{
    const double least_blocks = 0.005, least_blocks_elsewhere = 0.05, least_pixels = 0.0025;
    bool coincide = centres_coincide(own->width, sum->width) && centres_coincide(own->height, sum->height);
    struct image sampled = {0};
    double pixels = (double)own->width * own->height;
    signed char *directions = calloc((size_t)own->width, (size_t)own->height);
    *difference = (struct picture_difference){0};
    enum result result = directions ? image_alloc(&sampled, own->width, own->height, 3, err) : error_memory(err, pixels);
    if (!result) {
        const struct pictures pictures = {.sum = &sampled, .own = own, .tolerance = tolerance};
        int x = 0, y = 0;
        sample(sum, &sampled);
        double blocks = blocks_that_differ(&pictures, &x, &y);
        double agreeing = single_rays && coincide ? pixels_that_agree(&pictures, directions) : 0;
        difference->found = blocks > (coincide ? least_blocks : least_blocks_elsewhere) || agreeing > least_pixels;
        difference->share = fmax(blocks, agreeing);
        describe(&pictures, sum, x, y, difference);
    }
    image_free(&sampled);
    free(directions);
    return result;
}
