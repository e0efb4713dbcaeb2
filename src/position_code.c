/* The coding formula twice: as scene text for POV-Ray, and its inverse in C. Both read the same constants. */
#include "position_code.h"

#include <assert.h>
#include <math.h>

/* Of v = MARGIN + SPAN X, how many steps of v have low digits, and the third digits: see the header. */
#define MARGIN 0.001
#define SPAN 0.998
#define LOW_STEPS 16384.0
#define LENGTH_START 0.05
#define LENGTH_SPAN 0.9
#define DECADES 24.0
#define FIRST_DECADE (-12.0)
#define DIRECTION 0.975
/* Between that of the largest position, 0.95, and that of a direction. */
#define LEAST_DIRECTION 0.9625
/* Half the span of a direction's digits. */
#define DIRECTION_SPAN 0.499

/* The fraction of start + slope*variable in a colour; of a pattern's value POV-Ray takes the fraction itself, in less
 * time than by mod(). */
static enum result add_digit(struct buffer *text, double start, double slope, const char *variable, const char *colour,
                             struct error *err)
{
    return buffer_printf(text, err, "[1 function { %.17g + %.17g*%s } color_map { [0 rgb 0] [1 %s 3] }]\n", start,
                         slope, variable, colour);
}

/* The warp, which is computed once for the three functions, can't take the origin. */
enum result position_code_pigment(struct buffer *text, bool direction, enum position_digits digits, struct error *err)
{
    static const char *const axes[] = {"x", "y", "z"}, *const colours[] = {"red", "green", "blue"};
    const double steps = digits == POSITION_DIGITS_LOW ? LOW_STEPS : 1;
    const bool all = digits == POSITION_DIGITS_ALL;
    assert(direction || !all);
    enum result result = buffer_add_text(text, "pigment { average pigment_map {\n", err);
    for (int axis = 0; !result && axis < (all ? 3 : 2); axis++)
        result = add_digit(text, all ? 0.5 : steps * MARGIN, all ? DIRECTION_SPAN : steps * SPAN, axes[axis],
                           colours[axis], err);
    if (!result && !all && direction)
        result = buffer_printf(text, err, "[1 rgb <0, 0, %.17g>]\n", 3 * DIRECTION);
    else if (!result && !all)
        result = add_digit(text, steps * (LENGTH_START - LENGTH_SPAN * FIRST_DECADE / DECADES),
                           steps * LENGTH_SPAN / DECADES, "log(z)", colours[2], err);
    return result ? result : buffer_add_text(text, all ? "} }\n" : "} warp { cubic } translate 1e-13 }\n", err);
}

/* v in [0, 1] from its 16-bit code and the fraction of LOW_STEPS v. */
static double combine(double high, double fraction)
{
    return (round(LOW_STEPS * high - fraction) + fraction) / LOW_STEPS;
}

/* The low digits that go with v. */
static double low_digits(double v)
{
    return LOW_STEPS * v - floor(LOW_STEPS * v);
}

void position_code_unmix(struct image *high, struct image *low, const struct image *share, int channel)
{
    const float least = 0.02f, enough = 0.3f, whole = 0.9999f;
    for (int y = 0; y < high->height; y++)
        for (int x = 0; x < high->width; x++) {
            float part = image_row(share, channel, y)[x];
            for (int axis = 0; part > least && part < whole && axis < 3; axis++) {
                float *digits = &image_row(high, axis, y)[x], *rest = &image_row(low, axis, y)[x];
                *digits /= part;
                *rest = part < enough ? (float)low_digits((double)*digits) : *rest / part;
            }
        }
}

/* The point of the cube [-1, 1]^3 at this place of its net; one beside the net, where the last digit or an unmixing may
 * leave it, is taken to the nearest face. */
static void fold(double x, double y, double p[3])
{
    const double beside_caps = fabs(x - 3 / 8.0) - 1 / 8.0, beyond_sides = fabs(y - 0.5) - 1 / 6.0;
    const bool cap = beyond_sides > fmax(0, beside_caps);
    const int face = cap ? 1 : x < 0.25 ? 0 : x < 0.5 ? 1 : x < 0.75 ? 2 : 3;
    const double u = fmax(-1, fmin(1, 8 * (x - face / 4.0) - 1));
    if (cap) {
        p[0] = u;
        p[1] = y > 0.5 ? 1 : -1;
        p[2] = 6 * (y > 0.5 ? 1 - y : y) - 1;
        return;
    }
    /* Along the four sides u is z, x, -z and -x. */
    p[0] = face == 0 ? -1 : face == 1 ? u : face == 2 ? 1 : -u;
    p[1] = fmax(-1, fmin(1, 6 * (y - 1 / 3.0) - 1));
    p[2] = face == 0 ? u : face == 1 ? 1 : face == 2 ? -u : -1;
}

static void decode_pixel(const double v[3], float decoded[4])
{
    double p[3], length;
    fold((v[0] - MARGIN) / SPAN, (v[1] - MARGIN) / SPAN, p);
    decoded[3] = v[2] < LEAST_DIRECTION;
    if (decoded[3])
        length = pow(10, (v[2] - LENGTH_START) / LENGTH_SPAN * DECADES + FIRST_DECADE);
    else
        length = 1 / sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (int axis = 0; axis < 3; axis++)
        decoded[axis] = (float)(length * p[axis]);
}

/* One that has all digits. */
static void decode_direction(const double v[3], float decoded[4])
{
    double d[3], square = 0;
    for (int axis = 0; axis < 3; axis++) {
        d[axis] = v[axis] - 0.5;
        square += d[axis] * d[axis];
    }
    for (int axis = 0; axis < 3; axis++)
        decoded[axis] = (float)(square > 0 ? d[axis] / sqrt(square) : 0);
}

enum result position_code_decode(const struct image *high, const struct image *low, struct image *decoded,
                                 struct error *err)
{
    if (low && (low->width != high->width || low->height != high->height))
        return error_set(err, RESULT_DATA, "two images of digits differ in size: %dx%d and %dx%d", high->width,
                         high->height, low->width, low->height);
    enum result result = image_alloc(decoded, high->width, high->height, 4, err);
    for (int y = 0; !result && y < high->height; y++)
        for (int x = 0; x < high->width; x++) {
            double v[3], sum = 0;
            for (int axis = 0; axis < 3; axis++) {
                v[axis] = image_row(high, axis, y)[x];
                sum += v[axis];
                if (low)
                    v[axis] = combine(v[axis], image_row(low, axis, y)[x]);
            }
            float pixel[4] = {0};
            if (sum > 0 && low)
                decode_pixel(v, pixel);
            else if (sum > 0)
                decode_direction(v, pixel);
            for (int axis = 0; axis < 4; axis++)
                image_row(decoded, axis, y)[x] = pixel[axis];
        }
    return result;
}
