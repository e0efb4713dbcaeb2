/* Coded positions: the header's formula in double, through 16-bit digits and back, and a sphere drawn by POV-Ray. */
#include "position_code.h"

#include "io_support.h"
#include "ppm_io.h"

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double sixteen_bits(double code)
{
    assert_true(code >= 0 && code < 1);
    return (float)(round(code * 65535) / 65535);
}

static void store(double v, struct image *high, struct image *low, int channel, int x, int y)
{
    image_row(high, channel, y)[x] = (float)sixteen_bits(v);
    image_row(low, channel, y)[x] = (float)sixteen_bits(16384 * v - floor(16384 * v));
}

/* The header's formula; both digits of one point (or direction) in 16 bits. Each row: the axis across the face and its
 * sign, that of the face, that down it, and the middle of the face in the net. */
static void encode(const double p[3], bool direction, struct image *high, struct image *low, int x, int y)
{
    static const struct {
        int across, across_sign, axis, sign, up, up_sign;
        double middle_x, middle_y;
    } faces[] = {
        {2, 1, 0, -1, 1, 1, 1 / 8.0, 1 / 2.0},  {0, 1, 2, 1, 1, 1, 3 / 8.0, 1 / 2.0},
        {2, -1, 0, 1, 1, 1, 5 / 8.0, 1 / 2.0},  {0, -1, 2, -1, 1, 1, 7 / 8.0, 1 / 2.0},
        {0, 1, 1, 1, 2, -1, 3 / 8.0, 5 / 6.0},  {0, 1, 1, -1, 2, 1, 3 / 8.0, 1 / 6.0},
    };
    double largest = fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2])));
    for (size_t i = 0; i < sizeof faces / sizeof *faces; i++) {
        if (p[faces[i].axis] * faces[i].sign < largest)
            continue;
        double across = faces[i].across_sign * p[faces[i].across] / largest;
        double up = faces[i].up_sign * p[faces[i].up] / largest;
        store(0.001 + 0.998 * (faces[i].middle_x + across / 8), high, low, 0, x, y);
        store(0.001 + 0.998 * (faces[i].middle_y + up / 6), high, low, 1, x, y);
    }
    store(1 / 20.0 + 9 / 10.0 * (log10(largest) + 12) / 24, high, low, 2, x, y);
    if (direction)
        image_row(high, 2, y)[x] = image_row(low, 2, y)[x] = (float)sixteen_bits(0.975);
}

static double random_number(void)
{
    static uint64_t seed = 88172645463325252u;
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (double)(seed >> 11) * 0x1p-53;
}

/* A random direction; every tenth lies on an axis or in a plane of two. */
static void random_direction(int n, double d[3])
{
    double length;
    do {
        for (int axis = 0; axis < 3; axis++)
            d[axis] = n % 10 == axis ? 0 : 2 * random_number() - 1;
        if (n % 30 == 0)
            d[1] = 0;
        length = length_of(d);
    } while (length > 1 || length < 0.01);
    for (int axis = 0; axis < 3; axis++)
        d[axis] /= length;
}

enum { SIDE = 300 };

static void make_images(int width, int height, struct image *high, struct image *low)
{
    struct error err;
    assert_ok(image_alloc(high, width, height, 3, &err), err);
    assert_ok(image_alloc(low, width, height, 3, &err), err);
}

static void free_images(struct image *high, struct image *low, struct image *decoded)
{
    image_free(high);
    image_free(low);
    image_free(decoded);
}

static void decode__positions_of_any_size__relative_error_1e7(void **state)
{
    (void)state;
    struct image high, low, decoded;
    struct error err;
    static double p[SIDE * SIDE][3];
    make_images(SIDE, SIDE, &high, &low);
    for (int n = 0; n < SIDE * SIDE; n++) {
        double length = pow(10, -10 + 20 * random_number());
        random_direction(n, p[n]);
        for (int axis = 0; axis < 3; axis++)
            p[n][axis] *= length;
        encode(p[n], false, &high, &low, n % SIDE, n / SIDE);
    }
    assert_ok(position_code_decode(&high, &low, &decoded, &err), err);
    for (int n = 0; n < SIDE * SIDE; n++) {
        double q[3], off[3];
        for (int axis = 0; axis < 3; axis++) {
            q[axis] = image_row(&decoded, axis, n / SIDE)[n % SIDE];
            off[axis] = q[axis] - p[n][axis];
        }
        assert_true(image_row(&decoded, 3, n / SIDE)[n % SIDE] == 1);
        /* 1e-7 by the digits, and half a unit in the last place of a float. */
        assert_near(length_of(q) / length_of(p[n]), 1, 1e-7 + 0x1p-24);
        assert_near(length_of(off) / length_of(p[n]), 0, 1e-7 + 0x1p-24);
    }
    free_images(&high, &low, &decoded);
}

/* Where the low digits go from nearly 1 to 0 the high ones may be rounded to either side. */
static void decode__carry_between_the_digits__no_jump(void **state)
{
    (void)state;
    struct image high, low, decoded;
    struct error err;
    enum { COUNT = 60000 };
    make_images(COUNT, 1, &high, &low);
    for (int n = 0; n < COUNT; n++) {
        double p[3] = {pow(10, 1e-7 * n), 1e-3, -2};
        encode(p, false, &high, &low, n, 0);
    }
    assert_ok(position_code_decode(&high, &low, &decoded, &err), err);
    for (int n = 0; n < COUNT; n++)
        assert_near(image_row(&decoded, 0, 0)[n] / pow(10, 1e-7 * n), 1, 4e-7);
    free_images(&high, &low, &decoded);
}

static void decode__directions__within_1e6_and_w_0(void **state)
{
    (void)state;
    struct image high, low, decoded, all, alone;
    struct error err;
    static double d[SIDE * SIDE][3];
    make_images(SIDE, SIDE, &high, &low);
    assert_ok(image_alloc(&all, SIDE, SIDE, 3, &err), err);
    for (int n = 0; n < SIDE * SIDE; n++) {
        random_direction(n, d[n]);
        encode(d[n], true, &high, &low, n % SIDE, n / SIDE);
        for (int axis = 0; axis < 3; axis++)
            image_row(&all, axis, n / SIDE)[n % SIDE] = (float)sixteen_bits(0.5 + 0.499 * d[n][axis]);
    }
    assert_ok(position_code_decode(&high, &low, &decoded, &err), err);
    assert_ok(position_code_decode(&all, NULL, &alone, &err), err);
    for (int n = 0; n < SIDE * SIDE; n++) {
        double q[3];
        for (int axis = 0; axis < 3; axis++) {
            q[axis] = image_row(&decoded, axis, n / SIDE)[n % SIDE];
            assert_near(q[axis], d[n][axis], 1e-6);
            /* Half a step of 16 bits: 0.5/65535/0.499, on each of the axes. */
            assert_near(image_row(&alone, axis, n / SIDE)[n % SIDE], d[n][axis], 2.7e-5);
        }
        assert_near(length_of(q), 1, 1e-6);
        assert_true(image_row(&decoded, 3, n / SIDE)[n % SIDE] == 0);
        assert_true(image_row(&alone, 3, n / SIDE)[n % SIDE] == 0);
    }
    free_images(&high, &low, &decoded);
    image_free(&all);
    image_free(&alone);
}

/* An unmixing leaves an error in the digits: next to an edge of the cube none takes the point to another place. */
static void decode__next_to_the_net__the_nearest_face(void **state)
{
    (void)state;
    static const double edges[][3] = {{2, 2, 0.6}, {-2, -2, 0.6}, {0.6, 2, 2}, {0.6, -2, -2}, {2, 0.6, -2}, {-2, 0.6, -2}};
    enum { EDGES = sizeof edges / sizeof *edges, STEPS = 9 };
    struct image high, low, decoded;
    struct error err;
    make_images(EDGES, STEPS, &high, &low);
    for (int y = 0; y < STEPS; y++)
        for (int x = 0; x < EDGES; x++) {
            encode(edges[x], false, &high, &low, x, y);
            for (int axis = 0; axis < 2; axis++) {
                double v = (double)image_row(&high, axis, y)[x] + 3e-5 * (axis ? y / 3 - 1 : y % 3 - 1);
                image_row(&high, axis, y)[x] = (float)v;
                image_row(&low, axis, y)[x] = (float)(16384 * v - floor(16384 * v));
            }
        }
    assert_ok(position_code_decode(&high, &low, &decoded, &err), err);
    for (int y = 0; y < STEPS; y++)
        for (int x = 0; x < EDGES; x++)
            for (int axis = 0; axis < 3; axis++)
                assert_near(image_row(&decoded, axis, y)[x], edges[x][axis], 2e-3);
    free_images(&high, &low, &decoded);
}

static void decode__black__all_zero(void **state)
{
    (void)state;
    struct image high, low, decoded;
    struct error err;
    make_images(2, 1, &high, &low);
    encode((double[3]){1, 2, 3}, false, &high, &low, 1, 0);
    for (int axis = 0; axis < 3; axis++)
        image_row(&low, axis, 0)[0] = 0.5f; /* black decides, whatever the low digits hold */
    assert_ok(position_code_decode(&high, &low, &decoded, &err), err);
    for (int channel = 0; channel < 4; channel++)
        assert_true(image_row(&decoded, channel, 0)[0] == 0);
    assert_near(image_row(&decoded, 2, 0)[1], 3, 1e-6);
    free_images(&high, &low, &decoded);
}

static void decode__middle_grey__no_nan(void **state)
{
    (void)state;
    struct image high, low, decoded;
    struct error err;
    make_images(1, 1, &high, &low);
    for (int axis = 0; axis < 3; axis++)
        image_row(&high, axis, 0)[0] = 0.5f;
    assert_ok(position_code_decode(&high, NULL, &decoded, &err), err);
    for (int axis = 0; axis < 3; axis++)
        assert_near(image_row(&decoded, axis, 0)[0], 0, 1e-12);
    free_images(&high, &low, &decoded);
}

static void decode__two_sizes__refused_with_both(void **state)
{
    (void)state;
    struct image high, low, other, decoded = {0};
    struct error err;
    make_images(4, 3, &high, &low);
    assert_ok(image_alloc(&other, 4, 2, 3, &err), err);
    assert_int_equal(position_code_decode(&high, &other, &decoded, &err), RESULT_DATA);
    assert_contains(err.text, "4x3");
    assert_contains(err.text, "4x2");
    assert_null(decoded.pixels);
    free_images(&high, &low, &other);
}

/* ---- drawn by POV-Ray ---- */

struct ball {
    double centre[3], radius, eye[3];
};

static const struct ball balls[] = {
    {{0.4, -0.3, 0.2}, 1.5, {0.4, -0.3, -4.8}},
    {{-7e4, 5e4, 2e4}, 1.5e4, {-7e4, 5e4, -3e4}},
};
enum { WIDTH = 24, HEIGHT = 18 };

static void write_scene(const struct ball *ball, enum position_digits digits, const char *name)
{
    struct buffer text = {0};
    struct error err;
    char path[64];
    assert_ok(buffer_printf(&text, &err,
                            "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n"
                            "camera { location <%.17g, %.17g, %.17g> direction z up y right x*4/3 }\n"
                            "sphere { <%.17g, %.17g, %.17g>, %.17g texture { ",
                            ball->eye[0], ball->eye[1], ball->eye[2], ball->centre[0], ball->centre[1], ball->centre[2],
                            ball->radius),
              err);
    assert_ok(position_code_pigment(&text, false, digits, &err), err);
    assert_ok(buffer_add_text(&text, "finish { emission 1 ambient 0 diffuse 0 } } }\nsky_sphere { ", &err), err);
    assert_ok(position_code_pigment(&text, true, digits, &err), err);
    assert_ok(buffer_add_text(&text, "}\n", &err), err);
    snprintf(path, sizeof path, "%s.pov", name);
    assert_ok(file_write(in_scratch(path), &text, &err), err);
    buffer_free(&text);
}

/* Where the ray through a pixel's centre meets the ball, or its direction (false). */
static bool hit(const struct ball *ball, int x, int y, double p[3])
{
    double d[3] = {((x + 0.5) / WIDTH - 0.5) * 4 / 3, 0.5 - (y + 0.5) / HEIGHT, 1}, length = length_of(d);
    double b = 0, c = -ball->radius * ball->radius;
    for (int axis = 0; axis < 3; axis++) {
        double offset = ball->eye[axis] - ball->centre[axis];
        d[axis] /= length;
        b += offset * d[axis];
        c += offset * offset;
    }
    bool found = b * b > c;
    for (int axis = 0; axis < 3; axis++)
        p[axis] = found ? ball->eye[axis] + (-b - sqrt(b * b - c)) * d[axis] : d[axis];
    return found;
}

static void pigment__sphere_and_sky_by_povray__positions_and_directions(void **state)
{
    (void)state;
    char command[1024] = "", name[32];
    for (int i = 0; i < 4; i++) {
        snprintf(name, sizeof name, "scene%d", i);
        write_scene(&balls[i / 2], i % 2 ? POSITION_DIGITS_LOW : POSITION_DIGITS_HIGH, name);
        snprintf(command + strlen(command), sizeof command - strlen(command),
                 "povray +Iscene%d.pov +Oscene%d.ppm +W%d +H%d +FP16 File_Gamma=1.0 -A -D -GA </dev/null & ", i, i, WIDTH,
                 HEIGHT);
    }
    run("%s wait", command);
    for (int i = 0; i < 2; i++) {
        struct image high, low, decoded;
        struct error err;
        snprintf(name, sizeof name, "scene%d.ppm", 2 * i);
        assert_ok(ppm_read(in_scratch(name), &high, &err), err);
        snprintf(name, sizeof name, "scene%d.ppm", 2 * i + 1);
        assert_ok(ppm_read(in_scratch(name), &low, &err), err);
        assert_ok(position_code_decode(&high, &low, &decoded, &err), err);
        int hits = 0;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                double p[3];
                bool position = hit(&balls[i], x, y, p);
                hits += position;
                assert_int_equal(image_row(&decoded, 3, y)[x], position);
                for (int axis = 0; axis < 3; axis++)
                    assert_near(image_row(&decoded, axis, y)[x], p[axis], 2e-7 * length_of(p));
            }
        assert_true(hits > 40 && hits < WIDTH * HEIGHT - 40);
        free_images(&high, &low, &decoded);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decode__positions_of_any_size__relative_error_1e7),
        cmocka_unit_test(decode__carry_between_the_digits__no_jump),
        cmocka_unit_test(decode__directions__within_1e6_and_w_0),
        cmocka_unit_test(decode__next_to_the_net__the_nearest_face),
        cmocka_unit_test(decode__black__all_zero),
        cmocka_unit_test(decode__middle_grey__no_nan),
        cmocka_unit_test(decode__two_sizes__refused_with_both),
        cmocka_unit_test(pigment__sphere_and_sky_by_povray__positions_and_directions),
    };
    return cmocka_run_group_tests_name("position_code", tests, scratch_setup, scratch_teardown);
}
