/* Properties of the filters over random passes: mirrors of planes and spheres, reflected analytically, with holes in
 * them and of several exponents, and plain noise. SEED=N is the first of SEEDS=M; a failure names its own;
 * TESTS='*threads*' runs those of that name. */
#include "gloss_support.h"

#include "interrupt.h"

#include <float.h>

enum { WIDTH = 64, HEIGHT = 40 };

/* --- random numbers --- */

static uint64_t random_state;

static double random_unit(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (double)(random_state >> 11) * 0x1p-53;
}

static double random_between(double low, double high)
{
    return low + (high - low) * random_unit();
}

static void random_direction(double direction[3])
{
    double square;
    do {
        square = 0;
        for (int i = 0; i < 3; i++) {
            direction[i] = random_between(-1, 1);
            square += direction[i] * direction[i];
        }
    } while (square > 1 || square < 0.01);
    for (int i = 0; i < 3; i++)
        direction[i] /= sqrt(square);
}

/* --- random passes --- */

enum { BALLS = 6, GLOSSY_BALLS = 2, FLOOR = BALLS, NOTHING = -1 };

struct world {
    struct ball balls[BALLS]; /* the first two are mirrors, and so is the floor y = 0 */
    double stripes[BALLS + 1];
};

static int world_hit(const struct world *world, const double from[3], const double to[3], double *distance)
{
    int thing = NOTHING;
    *distance = INFINITY;
    for (int i = 0; i < BALLS; i++) {
        double hit = ball_hit(&world->balls[i], from, to);
        if (hit < *distance) {
            *distance = hit;
            thing = i;
        }
    }
    double hit = to[1] < 0 ? -from[1] / to[1] : INFINITY;
    if (hit > 1e-9 && hit < *distance) {
        *distance = hit;
        thing = FLOOR;
    }
    return thing;
}

/* Stripes on things, some of them very bright; a gradient in the sky. */
static float world_radiance(const struct world *world, int thing, const double point[3], int channel)
{
    if (thing == NOTHING)
        return (float)(0.4 + 0.3 * point[channel]);
    double stripe = sin(world->stripes[thing] * (point[0] + 0.7 * point[1] - 0.4 * point[2]));
    return (float)((stripe > 0.9 ? 20 : 0.5 + 0.4 * stripe) * (0.5 + 0.5 * ((thing + channel) % 3)));
}

static void normalise(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* A pixel's mirrored ray, where it sees a mirror. */
static void world_pixel(const struct world *world, const double eye[3], double ray[3], int x, int y,
                        struct gbuffer *gbuffer)
{
    double distance, a[3], normal[3] = {0, 1, 0}, mirrored[3], b[3], dot = 0;
    normalise(ray);
    int thing = world_hit(world, eye, ray, &distance);
    if (thing != FLOOR && (thing == NOTHING || thing >= GLOSSY_BALLS))
        return;
    for (int i = 0; i < 3; i++) {
        a[i] = eye[i] + distance * ray[i];
        if (thing != FLOOR)
            normal[i] = (a[i] - world->balls[thing].centre[i]) / world->balls[thing].radius;
        dot += ray[i] * normal[i];
    }
    for (int i = 0; i < 3; i++)
        mirrored[i] = ray[i] - 2 * dot * normal[i];
    thing = world_hit(world, a, mirrored, &distance);
    for (int i = 0; i < 3; i++)
        b[i] = thing == NOTHING ? mirrored[i] : a[i] + distance * mirrored[i];
    for (int i = 0; i < 3; i++) {
        image_row(&gbuffer->specular, i, y)[x] = world_radiance(world, thing, b, i);
        image_row(&gbuffer->position, i, y)[x] = (float)a[i];
        image_row(&gbuffer->endpoint, i, y)[x] = (float)b[i];
    }
    image_row(&gbuffer->endpoint, 3, y)[x] = thing != NOTHING;
    image_row(&gbuffer->phong, 0, y)[x] = 1;
}

static void noise_pixel(int x, int y, struct gbuffer *gbuffer)
{
    double direction[3];
    bool miss = random_unit() < 0.3;
    random_direction(direction);
    for (int i = 0; i < 3; i++) {
        image_row(&gbuffer->specular, i, y)[x] = (float)random_between(-0.2, 1);
        image_row(&gbuffer->position, i, y)[x] = (float)random_between(-1, 1);
        image_row(&gbuffer->endpoint, i, y)[x] = (float)(miss ? direction[i] : random_between(-9, 9));
    }
    image_row(&gbuffer->endpoint, 3, y)[x] = !miss;
    image_row(&gbuffer->phong, 0, y)[x] = 1;
}

/* Every third one is noise, and every second one has holes and several exponents. */
static void passes_draw(uint64_t seed, int width, int height, struct gbuffer *gbuffer)
{
    struct world world;
    double eye[3] = {0, 0, -4}, phong;
    random_state = seed * 0x9e3779b97f4a7c15u + 1;
    for (int i = 0; i < 8; i++)
        random_unit();
    gbuffer_alloc(gbuffer, width, height);
    for (int i = 0; i < BALLS; i++) {
        struct ball *ball = &world.balls[i];
        ball->radius = random_between(0.2, i < GLOSSY_BALLS ? 1 : 0.7);
        ball->centre[0] = random_between(-2, 2);
        ball->centre[1] = ball->radius * random_between(0.8, 2.5);
        ball->centre[2] = random_between(-1, 3);
    }
    for (int i = 0; i <= BALLS; i++)
        world.stripes[i] = random_between(3, 20);
    eye[0] = random_between(-1, 1);
    eye[1] = random_between(0.7, 2);
    gbuffer->has_eye = seed % 5 > 0;
    gbuffer->view_angle = 0.9f;
    for (int i = 0; i < 3; i++)
        gbuffer->eye[i] = (float)eye[i];
    phong = pow(10, random_between(0, 4));
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double side = 2 * tan(0.45) / width;
            double ray[3] = {(x + 0.5 - width / 2.0) * side, -0.3 - (y + 0.5 - height / 2.0) * side, 1};
            if (seed % 3 == 2)
                noise_pixel(x, y, gbuffer);
            else
                world_pixel(&world, eye, ray, x, y, gbuffer);
            float *exponent = image_row(&gbuffer->phong, 0, y) + x;
            *exponent *= (float)phong;
            if (seed % 2 && (x / 7 + y / 5) % 3 == 0)
                *exponent *= 30;
            if (seed % 2 && random_unit() < 0.05)
                *exponent = 0;
        }
}

/* --- all filters over all seeds --- */

/* DRAFT: clusters and interpolation at any size. */
static const struct {
    const char *name;
    enum filter_mode mode;
    double tolerance;
} filters[] = {{"the paper's", FILTER_MODE_PAPER, FILTER_TOLERANCE_NORMAL},
               {"the best", FILTER_MODE_BEST, 0},
               {"the fast best", FILTER_MODE_BEST, FILTER_TOLERANCE_DRAFT}};

static unsigned long from_environment(const char *name, unsigned long otherwise)
{
    const char *value = getenv(name);
    return value ? strtoul(value, NULL, 10) : otherwise;
}

struct trial {
    unsigned long seed;
    const char *name;
    struct gbuffer gbuffer;
    struct filter_options options;
    struct image glossy; /* its result */
};

/* Whether the trial's filter takes pixels together, and interpolates others. */
static bool is_fast(const struct trial *trial)
{
    return trial->options.mode == FILTER_MODE_BEST && trial->options.tolerance > 0;
}

#define fail_trial(trial, ...)                                                                                         \
    do {                                                                                                               \
        print_error("SEED=%lu, %s filter: ", (trial)->seed, (trial)->name);                                            \
        fail_msg(__VA_ARGS__);                                                                                         \
    } while (0)

static void for_all(void (*test)(struct trial *trial))
{
    unsigned long first = from_environment("SEED", 1), count = from_environment("SEEDS", 6);
    for (unsigned long seed = first; seed < first + count; seed++)
        for (size_t m = 0; m < sizeof filters / sizeof filters[0]; m++) {
            struct trial trial = {.seed = seed, .name = filters[m].name, .options = filter_options_default()};
            trial.options.mode = filters[m].mode;
            trial.options.tolerance = filters[m].tolerance;
            trial.options.threads = 1;
            passes_draw(seed, WIDTH, HEIGHT, &trial.gbuffer);
            filter_run(&trial.gbuffer, &trial.options, &trial.glossy, NULL);
            test(&trial);
            image_free(&trial.glossy);
            gbuffer_free(&trial.gbuffer);
        }
}

static struct image image_copy(const struct image *image)
{
    struct image copy;
    struct error err;
    assert_ok(image_alloc(&copy, image->width, image->height, image->channels, &err), err);
    memcpy(copy.pixels, image->pixels, image->stride * (size_t)image->height * (size_t)image->channels * sizeof(float));
    return copy;
}

static struct gbuffer gbuffer_copy(const struct gbuffer *gbuffer)
{
    struct gbuffer copy = *gbuffer;
    copy.specular = image_copy(&gbuffer->specular);
    copy.position = image_copy(&gbuffer->position);
    copy.endpoint = image_copy(&gbuffer->endpoint);
    copy.phong = image_copy(&gbuffer->phong);
    return copy;
}

static double largest_value(const struct image *image)
{
    double largest = 0;
    for (int i = 0; i < image->channels; i++)
        for (int y = 0; y < image->height; y++)
            for (int x = 0; x < image->width; x++)
                largest = fmax(largest, fabs((double)image_row(image, i, y)[x]));
    return largest;
}

/* Fails where more than `share` of the values differ by more than the tolerance, relative to the largest radiance. What a
 * rounded angle decides (whether a tap is hidden, or within the radius) may turn at single pixels. */
static void compare(const struct trial *trial, const struct image *image, double tolerance, double share,
                    const char *what)
{
    const struct image *expected = &trial->glossy;
    double limit = tolerance * largest_value(&trial->gbuffer.specular), worst = 0;
    int beyond = 0, all = 0;
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < expected->height; y++)
            for (int x = 0; x < expected->width; x++) {
                double error = fabs((double)image_row(image, i, y)[x] - (double)image_row(expected, i, y)[x]);
                worst = fmax(worst, error);
                beyond += !(error <= limit);
                all += scene_glossy(&trial->gbuffer, x, y);
            }
    if (beyond > share * all)
        fail_trial(trial, "%s: %d of %d values differ by more than %g, the worst by %g", what, beyond, all, limit, worst);
}

/* --- similar scenes --- */

struct similarity {
    double scale, rotation[3][3], translation[3];
};

static const struct similarity identity = {.scale = 1, .rotation = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/* A point with weight w = 1, or a direction with w = 0, in place. */
static void move(const struct similarity *similarity, double w, float *const point[3])
{
    double from[3] = {(double)*point[0], (double)*point[1], (double)*point[2]};
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int j = 0; j < 3; j++)
            sum += similarity->rotation[i][j] * from[j];
        *point[i] = (float)(w > 0 ? similarity->scale * sum + similarity->translation[i] : sum);
    }
}

static void expect_the_same(struct trial *trial, const struct similarity *similarity, double tolerance, double share,
                            const char *what)
{
    struct gbuffer moved = gbuffer_copy(&trial->gbuffer);
    struct image glossy;
    move(similarity, 1, (float *const[]){&moved.eye[0], &moved.eye[1], &moved.eye[2]});
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            struct image *const images[] = {&moved.position, &moved.endpoint};
            for (int n = 0; n < 2 && scene_glossy(&moved, x, y); n++) {
                float *point[3];
                for (int i = 0; i < 3; i++)
                    point[i] = image_row(images[n], i, y) + x;
                move(similarity, n ? (double)image_row(&moved.endpoint, 3, y)[x] : 1, point);
            }
        }
    filter_run(&moved, &trial->options, &glossy, NULL);
    compare(trial, &glossy, tolerance, share, what);
    image_free(&glossy);
    gbuffer_free(&moved);
}

static void try_scales(struct trial *trial)
{
    struct similarity similarity = identity;
    similarity.scale = 0x1p-70;
    expect_the_same(trial, &similarity, 0, 0, "lengths times 2^-70");
    similarity.scale = 0x1p70;
    expect_the_same(trial, &similarity, 0, 0, "lengths times 2^70");
    similarity.scale = 1e-6;
    expect_the_same(trial, &similarity, 1e-4, 0.005, "lengths times 1e-6");
    similarity.scale = 1e6;
    expect_the_same(trial, &similarity, 1e-4, 0.005, "lengths times 1e6");
}

static void properties__lengths_times_a_factor__give_the_same_picture(void **state)
{
    (void)state;
    for_all(try_scales);
}

static void try_translation(struct trial *trial)
{
    struct similarity similarity = identity;
    for (int i = 0; i < 3; i++)
        similarity.translation[i] = random_between(-3, 3);
    expect_the_same(trial, &similarity, 1e-4, 0.01, "translation");
}

static void properties__translation__gives_the_same_picture(void **state)
{
    (void)state;
    for_all(try_translation);
}

/* About a random axis by a random angle. */
static void try_rotation(struct trial *trial)
{
    struct similarity similarity = identity;
    double axis[3], angle = random_between(0, 6);
    random_direction(axis);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double across = j == (i + 1) % 3 ? -axis[(i + 2) % 3] : j == (i + 2) % 3 ? axis[(i + 1) % 3] : 0;
            similarity.rotation[i][j] = (i == j ? cos(angle) : 0) + (1 - cos(angle)) * axis[i] * axis[j] +
                                        sin(angle) * across;
        }
    expect_the_same(trial, &similarity, 1e-4, 0.01, "rotation");
}

static void properties__rotation__gives_the_same_picture(void **state)
{
    (void)state;
    for_all(try_rotation);
}

/* --- radiance --- */

/* Which pixels the fast filter interpolates depends on the results. */
static void try_linearity(struct trial *trial)
{
    const float factor = (float)random_between(-3, 3);
    struct gbuffer other = gbuffer_copy(&trial->gbuffer), both = gbuffer_copy(&trial->gbuffer);
    struct image glossy, sum;
    trial->options.without |= FILTER_WITHOUT_FIT;
    image_free(&trial->glossy);
    filter_run(&trial->gbuffer, &trial->options, &trial->glossy, NULL);
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                float value = (float)random_between(-1, 1);
                image_row(&other.specular, i, y)[x] = value;
                image_row(&both.specular, i, y)[x] += factor * value;
            }
    filter_run(&other, &trial->options, &glossy, NULL);
    filter_run(&both, &trial->options, &sum, NULL);
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                image_row(&sum, i, y)[x] -= factor * image_row(&glossy, i, y)[x];
    compare(trial, &sum, is_fast(trial) ? trial->options.tolerance : 1e-5, is_fast(trial) ? 0.005 : 0, "linearity");
    image_free(&glossy);
    image_free(&sum);
    gbuffer_free(&other);
    gbuffer_free(&both);
}

static void properties__sum_of_radiances__gives_the_sum_of_the_pictures(void **state)
{
    (void)state;
    for_all(try_linearity);
}

static void try_constant(struct trial *trial)
{
    struct gbuffer constant = gbuffer_copy(&trial->gbuffer);
    struct image glossy;
    const float values[3] = {0.1f, (float)random_between(-5, 5), 1000};
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                image_row(&constant.specular, i, y)[x] = values[i];
    filter_run(&constant, &trial->options, &glossy, NULL);
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                double expected = scene_glossy(&constant, x, y) ? (double)values[i] : 0;
                double result = (double)image_row(&glossy, i, y)[x];
                if (!(fabs(result - expected) <= 1e-6 * fabs(expected)))
                    fail_trial(trial, "constant radiance %.9g gives %.9g at %d, %d", expected, result, x, y);
            }
    image_free(&glossy);
    gbuffer_free(&constant);
}

static void properties__constant_radiance__stays(void **state)
{
    (void)state;
    for_all(try_constant);
}

/* Within a window that is given: the neighbours are those up to its radius away. */
static void try_bounds(struct trial *trial)
{
    enum { RADIUS = 5 };
    const struct gbuffer *gbuffer = &trial->gbuffer;
    struct image glossy;
    trial->options.max_radius_px = RADIUS;
    filter_run(gbuffer, &trial->options, &glossy, NULL);
    for (int i = 0; i < 3; i++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                double low = INFINITY, high = -INFINITY, result = (double)image_row(&glossy, i, y)[x];
                for (int v = y - RADIUS; v <= y + RADIUS; v++)
                    for (int u = x - RADIUS; u <= x + RADIUS; u++) {
                        if (!oracle_inside(gbuffer, u, v) ||
                            (u - x) * (u - x) + (v - y) * (v - y) > RADIUS * RADIUS)
                            continue;
                        low = fmin(low, (double)image_row(&gbuffer->specular, i, v)[u]);
                        high = fmax(high, (double)image_row(&gbuffer->specular, i, v)[u]);
                    }
                double margin = 1e-6 * fmax(fabs(low), fabs(high));
                if (scene_glossy(gbuffer, x, y) && !(result >= low - margin && result <= high + margin))
                    fail_trial(trial, "%.9g at %d, %d is not from %.9g to %.9g", result, x, y, low, high);
            }
    image_free(&glossy);
}

static void properties__result__lies_between_the_neighbours_radiances(void **state)
{
    (void)state;
    for_all(try_bounds);
}

/* --- the picture's axes --- */

static void image_flip(struct image *image, bool across, bool down)
{
    struct image copy = image_copy(image);
    for (int i = 0; i < image->channels; i++)
        for (int y = 0; y < image->height; y++)
            for (int x = 0; x < image->width; x++)
                image_row(image, i, down ? image->height - 1 - y : y)[across ? image->width - 1 - x : x] =
                    image_row(&copy, i, y)[x];
    image_free(&copy);
}

static void try_flips(struct trial *trial)
{
    if (is_fast(trial))
        return; /* its blocks begin at the left and the top */
    for (int flip = 1; flip <= 3; flip++) {
        struct gbuffer flipped = gbuffer_copy(&trial->gbuffer);
        struct image *const images[] = {&flipped.specular, &flipped.position, &flipped.endpoint, &flipped.phong};
        struct image glossy;
        for (int i = 0; i < 4; i++)
            image_flip(images[i], flip & 1, flip & 2);
        filter_run(&flipped, &trial->options, &glossy, NULL);
        image_flip(&glossy, flip & 1, flip & 2);
        compare(trial, &glossy, 1e-5, 0, flip == 1 ? "columns flipped" : flip == 2 ? "rows flipped" : "both flipped");
        image_free(&glossy);
        gbuffer_free(&flipped);
    }
}

static void properties__flipped_passes__give_the_flipped_picture(void **state)
{
    (void)state;
    for_all(try_flips);
}

/* --- the lobe's width --- */

/* Where radiance is 1 - cos(theta) about a pixel's own direction, its result is the spread of the lobe over the taps: the
 * smaller the exponent, the larger. The window is the same for all; the pool of the best filter is another set of taps. */
static void try_spread(struct trial *trial)
{
    struct gbuffer spread = gbuffer_copy(&trial->gbuffer);
    int count = 0;
    trial->options.max_radius_px = 6;
    trial->options.without = FILTER_WITHOUT_POOL | FILTER_WITHOUT_FIT;
    trial->options.phong_override = true;
    spread.has_eye = true;
    spread.view_angle = 1e-9f;
    for (int y = 3; y < HEIGHT; y += 9)
        for (int x = 5; x < WIDTH; x += 11) {
            if (!scene_glossy(&spread, x, y))
                continue;
            for (int v = 0; v < HEIGHT; v++)
                for (int u = 0; u < WIDTH; u++)
                    image_row(&spread.specular, 0, v)[u] =
                        scene_glossy(&spread, u, v) ? (float)(1 - oracle_cosine(&spread, x, y, u, v)) : 0;
            double before = INFINITY;
            for (double phong = 0.5; phong < 1e6; phong *= 4) {
                struct image glossy;
                trial->options.phong = (float)phong;
                filter_run(&spread, &trial->options, &glossy, NULL);
                double now = (double)image_row(&glossy, 0, y)[x];
                image_free(&glossy);
                if (!(now <= before + 1e-6))
                    fail_trial(trial, "p = %g: spread %.9g, and %.9g at a quarter of it, at %d, %d", phong, now, before,
                               x, y);
                before = now;
            }
            count++;
        }
    if (count == 0)
        fail_trial(trial, "no pixel was looked at");
    gbuffer_free(&spread);
}

static void properties__smaller_exponent__spreads_more(void **state)
{
    (void)state;
    for_all(try_spread);
}

static void try_uniform_lobe(struct trial *trial)
{
    struct image glossy;
    trial->options.phong_override = true;
    trial->options.phong = 1e-6f;
    image_free(&trial->glossy);
    filter_run(&trial->gbuffer, &trial->options, &trial->glossy, NULL);
    trial->options.phong = 0;
    filter_run(&trial->gbuffer, &trial->options, &glossy, NULL);
    compare(trial, &glossy, 1e-4, 0.001, "p = 0");
    image_free(&glossy);
}

static void properties__exponent_0__is_the_limit_of_small_ones(void **state)
{
    (void)state;
    for_all(try_uniform_lobe);
}

/* --- parts and processors --- */

static struct image image_part(const struct image *image, int x, int y, int width, int height)
{
    struct image part = image_copy(image);
    struct error err;
    assert_ok(image_crop(&part, &(struct image_window){.left = x, .top = y, .width = width, .height = height}, &err), err);
    return part;
}

/* The tile begins at a multiple of the kernel's 16 columns, as all sums are grouped so; half of the width has half of the
 * view angle. */
static void try_tiles(struct trial *trial)
{
    enum { LEFT = 16, TOP = 9, TILE_WIDTH = WIDTH / 2, TILE_HEIGHT = 27, BORDER = 7 };
    const struct gbuffer *gbuffer = &trial->gbuffer;
    struct gbuffer whole = gbuffer_copy(gbuffer), tile;
    struct image of_whole, of_tile;
    whole.has_eye = true;
    tile = whole;
    tile.view_angle = whole.view_angle / 2;
    tile.specular = image_part(&whole.specular, LEFT, TOP, TILE_WIDTH, TILE_HEIGHT);
    tile.position = image_part(&whole.position, LEFT, TOP, TILE_WIDTH, TILE_HEIGHT);
    tile.endpoint = image_part(&whole.endpoint, LEFT, TOP, TILE_WIDTH, TILE_HEIGHT);
    tile.phong = image_part(&whole.phong, LEFT, TOP, TILE_WIDTH, TILE_HEIGHT);
    trial->options.max_radius_px = BORDER - 1; /* areas need one pixel more */
    filter_run(&whole, &trial->options, &of_whole, NULL);
    filter_run(&tile, &trial->options, &of_tile, NULL);
    for (int i = 0; i < 3; i++)
        for (int y = BORDER; y < TILE_HEIGHT - BORDER; y++)
            for (int x = BORDER; x < TILE_WIDTH - BORDER; x++) {
                float expected = image_row(&of_whole, i, y + TOP)[x + LEFT], result = image_row(&of_tile, i, y)[x];
                if (result != expected)
                    fail_trial(trial, "%.9g at %d, %d of the tile, %.9g in the whole picture", (double)result, x, y,
                               (double)expected);
            }
    image_free(&of_whole);
    image_free(&of_tile);
    gbuffer_free(&whole);
    gbuffer_free(&tile);
}

static void properties__tile_with_a_border__is_that_part_of_the_picture(void **state)
{
    (void)state;
    for_all(try_tiles);
}

static void try_processors(struct trial *trial)
{
    for (int isa = CPU_ISA_AUTO; isa < CPU_ISA_COUNT; isa++)
        for (int threads = 1; threads <= 5; threads += 2) {
            struct image glossy;
            trial->options.isa = (enum cpu_isa)isa;
            trial->options.threads = threads;
            if (!cpu_isa_supported(trial->options.isa))
                continue;
            filter_run(&trial->gbuffer, &trial->options, &glossy, NULL);
            if (!image_same(&glossy, &trial->glossy))
                fail_trial(trial, "instruction set %d with %d threads gives another picture", isa, threads);
            image_free(&glossy);
        }
}

static void properties__threads_and_instruction_sets__give_the_same_bits(void **state)
{
    (void)state;
    for_all(try_processors);
}

/* --- calls in a row --- */

/* Seldom what needs other parts built. */
static void change_options(struct filter_options *options)
{
    static const float phongs[] = {0, 3, 40, 500, 2e4f, 1e7f, INFINITY};
    if (random_unit() < 0.3)
        options->mode = options->mode == FILTER_MODE_BEST ? FILTER_MODE_PAPER : FILTER_MODE_BEST;
    if (random_unit() < 0.15)
        options->formula = (enum filter_formula)random_between(0, 2);
    if (random_unit() < 0.15)
        options->without = (unsigned)random_between(0, 16);
    options->tolerance = random_unit() < 0.3 ? 0 : FILTER_TOLERANCE_DRAFT;
    options->weights = (enum filter_weights)random_between(0, 3);
    options->window = (enum filter_window)random_between(0, 2);
    options->phong_override = random_unit() < 0.6;
    options->phong = phongs[(size_t)random_between(0, sizeof phongs / sizeof phongs[0])];
    options->energy = random_unit() < 0.3 ? 0.9 : 0.99;
    options->max_radius_px = random_unit() < 0.2 ? 5 : 0;
    options->radius_step = random_unit() < 0.2 ? 4 : 1;
    options->threads = (int)random_between(1, 4);
    options->isa = random_unit() < 0.2 ? CPU_ISA_SSE2 : CPU_ISA_AUTO;
}

static void properties__filter_on_threads_applied_again__as_one_of_its_own(void **state)
{
    enum { CALLS = 25 };
    const unsigned long first = from_environment("SEED", 1), count = from_environment("SEEDS", 6);
    (void)state;
    for (unsigned long seed = first; seed < first + count; seed++) {
        struct filter_options options = filter_options_default();
        struct gbuffer gbuffer;
        struct filter *filter;
        struct error err;
        passes_draw(seed, WIDTH, HEIGHT, &gbuffer);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = WIDTH / 2 - 3; x < WIDTH; x++)
                image_row(&gbuffer.phong, 0, y)[x] /= 30;
        assert_ok(filter_open(&gbuffer, &filter, &err), err);
        for (int call = 0; call < CALLS; call++) {
            struct image glossy, measure, expected, expected_measure;
            const bool stopped = random_unit() < 0.2;
            change_options(&options);
            interrupt_stop(stopped);
            if (stopped)
                assert_int_equal(filter_apply(filter, &options, &glossy, &measure, &err), RESULT_INTERRUPTED);
            interrupt_stop(false);
            assert_ok(filter_apply(filter, &options, &glossy, &measure, &err), err);
            filter_run(&gbuffer, &options, &expected, &expected_measure);
            if (!image_same(&glossy, &expected) || !image_same(&measure, &expected_measure))
                fail_msg("SEED=%lu: call %d gives another picture", seed, call);
            image_free(&glossy);
            image_free(&measure);
            image_free(&expected);
            image_free(&expected_measure);
        }
        filter_close(filter);
        gbuffer_free(&gbuffer);
    }
}

/* --- clusters and interpolation --- */

static double rmse(const struct image *image, const struct image *expected)
{
    double sum = 0;
    for (int i = 0; i < image->channels; i++)
        for (int y = 0; y < image->height; y++)
            for (int x = 0; x < image->width; x++) {
                double off = (double)image_row(image, i, y)[x] - (double)image_row(expected, i, y)[x];
                sum += off * off;
            }
    return sqrt(sum / ((double)image->channels * image->width * image->height));
}

/* Mirrors that curve and touch, at few pixels: errors of the largest radiance, a third above those measured. */
static void properties__tolerances__come_near_the_exact_sums(void **state)
{
    static const struct {
        double tolerance, limit;
    } cases[] = {{FILTER_TOLERANCE_LEAST, 0.0018}, {FILTER_TOLERANCE_HIGH, 0.0023}, {FILTER_TOLERANCE_NORMAL, 0.0026},
                 {FILTER_TOLERANCE_DRAFT, 0.0055}};
    (void)state;
    for (unsigned long seed = 6; seed <= 12; seed += 6) {
        struct filter_options options = filter_options_default();
        struct gbuffer gbuffer;
        struct image exact;
        options.tolerance = 0;
        passes_draw(seed, 4 * WIDTH, 4 * HEIGHT, &gbuffer);
        filter_run(&gbuffer, &options, &exact, NULL);
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
            struct image fast;
            options.tolerance = cases[i].tolerance;
            filter_run(&gbuffer, &options, &fast, NULL);
            const double off = rmse(&fast, &exact) / largest_value(&exact);
            if (!(off > 0 && off < cases[i].limit))
                fail_msg("SEED=%lu, tolerance %g: RMSE %g of the largest radiance", seed, cases[i].tolerance, off);
            image_free(&fast);
        }
        image_free(&exact);
        gbuffer_free(&gbuffer);
    }
}

/* Of what is shown alone as of the whole picture, although blocks of pixels reach beyond it. */
static void properties__tolerances__part_of_the_picture_as_of_the_whole(void **state)
{
    static const double tolerances[] = {FILTER_TOLERANCE_LEAST, FILTER_TOLERANCE_HIGH, FILTER_TOLERANCE_NORMAL,
                                        FILTER_TOLERANCE_DRAFT};
    (void)state;
    struct filter_options options = filter_options_default();
    struct gbuffer gbuffer;
    passes_draw(6, 4 * WIDTH - 15, 4 * HEIGHT - 15, &gbuffer); /* no whole tiles */
    for (size_t i = 0; i < sizeof tolerances / sizeof tolerances[0]; i++) {
        struct image whole, part;
        options.tolerance = tolerances[i];
        gbuffer.window = (struct image_window){0};
        filter_run(&gbuffer, &options, &whole, NULL);
        for (int left = 40; left < 60; left += 3) {
            const struct image_window window = {.left = left, .top = left - 7, .width = 31, .height = 22};
            gbuffer.window = window;
            filter_run(&gbuffer, &options, &part, NULL);
            for (int y = window.top; y < window.top + window.height; y++)
                if (memcmp(image_row(&part, 0, y) + left, image_row(&whole, 0, y) + left,
                           (size_t)window.width * sizeof(float)) != 0)
                    fail_msg("tolerance %g, window at %d: row %d differs", tolerances[i], left, y);
            image_free(&part);
        }
        image_free(&whole);
    }
    gbuffer_free(&gbuffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(properties__lengths_times_a_factor__give_the_same_picture),
        cmocka_unit_test(properties__translation__gives_the_same_picture),
        cmocka_unit_test(properties__rotation__gives_the_same_picture),
        cmocka_unit_test(properties__sum_of_radiances__gives_the_sum_of_the_pictures),
        cmocka_unit_test(properties__constant_radiance__stays),
        cmocka_unit_test(properties__result__lies_between_the_neighbours_radiances),
        cmocka_unit_test(properties__flipped_passes__give_the_flipped_picture),
        cmocka_unit_test(properties__smaller_exponent__spreads_more),
        cmocka_unit_test(properties__exponent_0__is_the_limit_of_small_ones),
        cmocka_unit_test(properties__tile_with_a_border__is_that_part_of_the_picture),
        cmocka_unit_test(properties__tolerances__come_near_the_exact_sums),
        cmocka_unit_test(properties__tolerances__part_of_the_picture_as_of_the_whole),
        cmocka_unit_test(properties__threads_and_instruction_sets__give_the_same_bits),
        cmocka_unit_test(properties__filter_on_threads_applied_again__as_one_of_its_own),
    };
    cmocka_set_test_filter(getenv("TESTS"));
    return cmocka_run_group_tests_name("filter_properties", tests, NULL, NULL);
}
