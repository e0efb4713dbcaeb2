/* The homography between the picture and a plane across the middle ray, from normal equations of 8 unknowns. */
#include "camera.h"

#include <math.h>
#include <string.h>

enum { UNKNOWNS = 8, SAMPLES_A_SIDE = 256 };

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double normalize(double v[3])
{
    double length = sqrt(dot(v, v));
    for (int i = 0; i < 3 && length > 0; i++)
        v[i] /= length;
    return length;
}

static void read_vector(const struct image *image, int x, int y, double v[3])
{
    for (int i = 0; i < 3; i++)
        v[i] = (double)image_row(image, i, y)[x];
}

static double place(int pixel, int count)
{
    return (pixel + 0.5) / count - 0.5;
}

/* Solves m x = right, m being positive definite, by elimination without pivots; false where it is as good as
 * singular. */
static bool solve(double m[UNKNOWNS][UNKNOWNS], double right[UNKNOWNS], double x[UNKNOWNS])
{
    for (int i = 0; i < UNKNOWNS; i++) {
        if (!(m[i][i] > 0))
            return false;
        for (int j = i + 1; j < UNKNOWNS; j++) {
            double factor = m[j][i] / m[i][i];
            for (int k = i; k < UNKNOWNS; k++)
                m[j][k] -= factor * m[i][k];
            right[j] -= factor * right[i];
        }
    }
    for (int i = UNKNOWNS - 1; i >= 0; i--) {
        x[i] = right[i];
        for (int k = i + 1; k < UNKNOWNS; k++)
            x[i] -= m[i][k] * x[k];
        x[i] /= m[i][i];
    }
    return true;
}

static void add_equation(double m[UNKNOWNS][UNKNOWNS], double right[UNKNOWNS], const double row[UNKNOWNS], double value)
{
    for (int i = 0; i < UNKNOWNS; i++) {
        for (int j = 0; j < UNKNOWNS; j++)
            m[i][j] += row[i] * row[j];
        right[i] += row[i] * value;
    }
}

static void ray_at(const struct camera *camera, double u, double v, double ray[3])
{
    for (int i = 0; i < 3; i++)
        ray[i] = camera->direction[i] + u * camera->right[i] - v * camera->up[i];
    normalize(ray);
}

/* Whether the camera's rays are those of the image, whose code is exact to 3e-5 in each component. */
static bool is_like(const struct camera *camera, const struct image *directions)
{
    const double tolerance = 5e-5;
    for (int y = 0; y < directions->height; y++)
        for (int x = 0; x < directions->width; x++) {
            double ray[3], own[3];
            ray_at(camera, place(x, directions->width), place(y, directions->height), ray);
            read_vector(directions, x, y, own);
            for (int i = 0; i < 3; i++)
                if (!(fabs(ray[i] - own[i]) <= tolerance))
                    return false;
        }
    return true;
}

bool camera_fit(const struct image *directions, struct camera *camera)
{
    int width = directions->width, height = directions->height;
    int step_x = (width + SAMPLES_A_SIDE - 1) / SAMPLES_A_SIDE, step_y = (height + SAMPLES_A_SIDE - 1) / SAMPLES_A_SIDE;
    double frame[3][3], first[3], second[3]; /* the axes: across, down, the middle ray */
    read_vector(directions, width / 2, height / 2, frame[2]);
    read_vector(directions, 0, height / 2, first);
    read_vector(directions, width - 1, height / 2, second);
    for (int i = 0; i < 3; i++)
        frame[0][i] = second[i] - first[i];
    cross(frame[2], frame[0], frame[1]);
    if (!(normalize(frame[2]) > 0) || !(normalize(frame[1]) > 0))
        return false;
    cross(frame[1], frame[2], frame[0]);
    /* p (1 + x[0] u + x[1] v) = x[2] + x[3] u + x[4] v across, the same with x[5] to x[7] down */
    double m[UNKNOWNS][UNKNOWNS] = {{0}}, right[UNKNOWNS] = {0}, x[UNKNOWNS];
    for (int row = 0; row < height; row += step_y)
        for (int column = 0; column < width; column += step_x) {
            double ray[3], u = place(column, width), v = place(row, height);
            read_vector(directions, column, row, ray);
            double along = dot(ray, frame[2]);
            if (!(along > 1e-3))
                return false;
            for (int axis = 0; axis < 2; axis++) {
                double p = dot(ray, frame[axis]) / along, equation[UNKNOWNS] = {-p * u, -p * v};
                double *terms = equation + 2 + 3 * axis;
                terms[0] = 1;
                terms[1] = u;
                terms[2] = v;
                add_equation(m, right, equation, p);
            }
        }
    if (!solve(m, right, x))
        return false;
    for (int i = 0; i < 3; i++) {
        camera->direction[i] = frame[2][i] + x[2] * frame[0][i] + x[5] * frame[1][i];
        camera->right[i] = x[0] * frame[2][i] + x[3] * frame[0][i] + x[6] * frame[1][i];
        camera->up[i] = -(x[1] * frame[2][i] + x[4] * frame[0][i] + x[7] * frame[1][i]);
    }
    return is_like(camera, directions);
}

enum result camera_directions(const struct camera *camera, int width, int height, struct image *directions,
                              struct error *err)
{
    enum result result = image_alloc(directions, width, height, 3, err);
    for (int y = 0; !result && y < height; y++)
        for (int x = 0; x < width; x++) {
            double ray[3];
            ray_at(camera, place(x, width), place(y, height), ray);
            for (int i = 0; i < 3; i++)
                image_row(directions, i, y)[x] = (float)ray[i];
        }
    return result;
}

enum result camera_text(const struct camera *camera, double wider, double higher, struct buffer *text, struct error *err)
{
    const double *l = camera->location, *d = camera->direction, *r = camera->right, *u = camera->up;
    return buffer_printf(text, err,
                         "camera { perspective location <%.17g, %.17g, %.17g> direction <%.17g, %.17g, %.17g>\n"
                         "  right <%.17g, %.17g, %.17g> up <%.17g, %.17g, %.17g> }\n",
                         l[0], l[1], l[2], d[0], d[1], d[2], wider * r[0], wider * r[1], wider * r[2], higher * u[0],
                         higher * u[1], higher * u[2]);
}

double camera_view_angle(const struct camera *camera)
{
    double left[3], right[3];
    ray_at(camera, -0.5, 0, left);
    ray_at(camera, 0.5, 0, right);
    return acos(fmax(-1, fmin(1, dot(left, right))));
}
