/* Lines through positions along their rays' directions: the eye is where they meet, by least squares. */
#include "eye.h"

#include <math.h>

enum { SAMPLES_A_SIDE = 128 };

struct line {
    double point[3], direction[3];
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool read_vector(const struct image *image, int x, int y, double v[3])
{
    for (int axis = 0; axis < 3; axis++)
        v[axis] = image_row(image, axis, y)[x];
    return dot(v, v) > 0;
}

/* Distance of a point from a line, and along it from the line's own point. */
static double distance_from(const struct line *line, const double point[3], double *along)
{
    double difference[3];
    for (int axis = 0; axis < 3; axis++)
        difference[axis] = point[axis] - line->point[axis];
    *along = dot(difference, line->direction);
    return sqrt(fmax(0, dot(difference, difference) - *along * *along));
}

/* Solves the symmetric 3x3 system by Cramer's rule; false when it is as good as singular. */
static bool solve(double m[3][3], const double right[3], double x[3])
{
    double scale = m[0][0] + m[1][1] + m[2][2];
    double cofactor[3][3], determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            cofactor[i][j] = m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3] -
                             m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3];
    for (int j = 0; j < 3; j++)
        determinant += m[0][j] * cofactor[0][j];
    if (!(determinant > 1e-8 * scale * scale * scale))
        return false;
    for (int i = 0; i < 3; i++)
        x[i] = (cofactor[0][i] * right[0] + cofactor[1][i] * right[1] + cofactor[2][i] * right[2]) / determinant;
    return true;
}

struct rays {
    const struct image *positions, *directions;
    int step_x, step_y;
};

/* The sum over all lines of w (I - d d^T), w = 1 / |position - eye|^2 (1 in the first round), and of its product with
 * the position; its solution is the eye. */
static bool nearest_point(const struct rays *rays, const double *eye, double nearest[3])
{
    double m[3][3] = {{0}}, right[3] = {0};
    for (int y = 0; y < rays->positions->height; y += rays->step_y)
        for (int x = 0; x < rays->positions->width; x += rays->step_x) {
            struct line line;
            if (!read_vector(rays->directions, x, y, line.direction) ||
                !read_vector(rays->positions, x, y, line.point))
                continue;
            double along = 1, weight = 1;
            if (eye) {
                double off = distance_from(&line, eye, &along);
                weight = 1 / (off * off + along * along + 1e-300);
            }
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    double term = weight * ((i == j) - line.direction[i] * line.direction[j]);
                    m[i][j] += term;
                    right[i] += term * line.point[j];
                }
        }
    return solve(m, right, nearest);
}

/* Whether the rays come from the eye: the median would do, the mean is stricter. */
static bool rays_meet(const struct rays *rays, const double eye[3])
{
    double sum = 0;
    int count = 0;
    for (int y = 0; y < rays->positions->height; y += rays->step_y)
        for (int x = 0; x < rays->positions->width; x += rays->step_x) {
            struct line line;
            double along;
            if (!read_vector(rays->directions, x, y, line.direction) || !read_vector(rays->positions, x, y, line.point))
                continue;
            double off = distance_from(&line, eye, &along);
            sum += along < 0 ? fmin(1, off / -along) : 1;
            count++;
        }
    return count > 0 && sum / count < 0.01;
}

static double view_angle(const struct image *directions)
{
    int last = directions->width - 1, y = directions->height / 2;
    double left[3], right[3];
    if (last < 1 || !read_vector(directions, 0, y, left) || !read_vector(directions, last, y, right))
        return 0;
    double angle = acos(fmax(-1, fmin(1, dot(left, right))));
    double outer = 2 * atan(tan(angle / 2) * directions->width / last);
    return outer;
}

void eye_find(struct gbuffer *gbuffer, const struct image *directions)
{
    struct rays rays = {.positions = &gbuffer->position,
                        .directions = directions,
                        .step_x = (gbuffer->position.width + SAMPLES_A_SIDE - 1) / SAMPLES_A_SIDE,
                        .step_y = (gbuffer->position.height + SAMPLES_A_SIDE - 1) / SAMPLES_A_SIDE};
    double first[3], second[3];
    gbuffer->has_eye = nearest_point(&rays, NULL, first) && nearest_point(&rays, first, second) && rays_meet(&rays, second);
    for (int axis = 0; axis < 3; axis++)
        gbuffer->eye[axis] = gbuffer->has_eye ? (float)second[axis] : 0;
    gbuffer->view_angle = gbuffer->has_eye ? (float)view_angle(directions) : 0;
}
