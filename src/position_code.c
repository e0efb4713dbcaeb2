/* The coding formula twice: as scene text for POV-Ray, and its inverse in C. Both read the same constants. */
#include "position_code.h"

#include <math.h>

/* Half the span of v, how many steps of it have low digits, and the code's radii: see the header. */
#define SPAN 0.499
#define LOW_STEPS 16384.0
#define RADIUS_START 0.05
#define RADIUS_SPAN 0.9
#define DECADES 24.0
#define FIRST_DECADE (-12.0)
/* Between the largest radius of a position, 0.95, and that of a direction, 1. */
#define DIRECTION_RADIUS 0.975
/* |p|^2, and never 0; POV-Ray sees nothing beyond 1e7. */
#define SQUARE "x*x + y*y + z*z + 1e-24"

enum result position_code_pigment(struct buffer *text, bool direction, enum position_digits digits, struct error *err)
{
    static const char *const axes[] = {"x", "y", "z"}, *const colours[] = {"red", "green", "blue"};
    /* Of a pattern's value POV-Ray takes the fraction itself, in less time than by mod(). */
    const double steps = digits == POSITION_DIGITS_HIGH ? 1 : LOW_STEPS;
    const double start = RADIUS_START - RADIUS_SPAN * FIRST_DECADE / DECADES, slope = RADIUS_SPAN / DECADES / 2;
    enum result result = buffer_add_text(text, "pigment { average pigment_map {\n", err);
    for (int axis = 0; !result && axis < 3; axis++) {
        result = buffer_printf(text, err, "[1 function { %.17g + %s*", steps / 2, axes[axis]);
        if (!result && direction)
            result = buffer_printf(text, err, "%.17g", steps * SPAN);
        else if (!result)
            result = buffer_printf(text, err, "(%.17g + %.17g*log(" SQUARE "))", steps * SPAN * start, steps * SPAN * slope);
        if (!result)
            result = buffer_printf(text, err, "/sqrt(" SQUARE ") } color_map { [0 rgb 0] [1 %s 3] }]\n", colours[axis]);
    }
    return result ? result : buffer_add_text(text, "} }\n", err);
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

static void decode_pixel(const double v[3], float decoded[4])
{
    double q[3], radius = 0;
    for (int axis = 0; axis < 3; axis++) {
        q[axis] = (v[axis] - 0.5) / SPAN;
        radius += q[axis] * q[axis];
    }
    radius = sqrt(radius);
    double length = 1;
    decoded[3] = radius < DIRECTION_RADIUS;
    if (decoded[3])
        length = pow(10, (radius - RADIUS_START) / RADIUS_SPAN * DECADES + FIRST_DECADE);
    for (int axis = 0; axis < 3; axis++)
        decoded[axis] = (float)(radius > 0 ? q[axis] / radius * length : 0);
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
            if (sum > 0)
                decode_pixel(v, pixel);
            for (int axis = 0; axis < 4; axis++)
                image_row(decoded, axis, y)[x] = pixel[axis];
        }
    return result;
}
