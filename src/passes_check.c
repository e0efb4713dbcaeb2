/* Counts over all pixels, and a sentence for each count that says something. */
#include "passes_check.h"

#include <math.h>
#include <string.h>

/* Shares and lengths from which something is wrong; passes_check.h gives the sentences. */
static const double off_ray_px = 0.1, off_ray_share = 0.01, touching = 1e-5, touching_share = 0.01,
                    between_share = 0.3, mixed_w_share = 0.001;
enum { FEWEST_EDGES = 20 };

struct check {
    const struct gbuffer *gbuffer;
    struct buffer *report;
    int wrong;
    long glossy;
    enum result result;
    struct error *err;
};

#define SAY(check, ...)                                                                                                \
    do {                                                                                                               \
        if (!(check)->result)                                                                                          \
            (check)->result = buffer_printf((check)->report, (check)->err, __VA_ARGS__);                               \
    } while (0)

static void wrong(struct check *check, long count, const char *what)
{
    if (count == 0)
        return;
    check->wrong++;
    SAY(check, "wrong: %ld glossy pixel%s (%.2g %%) %s\n", count, count > 1 ? "s" : "",
        100.0 * (double)count / (double)check->glossy, what);
}

static void note(struct check *check, long count, const char *what)
{
    if (count > 0)
        SAY(check, "note: %ld pixel%s %s\n", count, count > 1 ? "s" : "", what);
}

static void tell_names(struct check *check, const struct passes_found *found, bool *complete)
{
    *complete = true;
    for (int i = 0; i < CHANNEL_GROUPS; i++) {
        const struct channel_group *group = &channel_groups[i];
        const char *missing = NULL;
        SAY(check, "%-12s", group->name);
        for (int j = 0; j < group->count; j++) {
            const char *name = found->groups[i].names[j];
            if (*name)
                SAY(check, " %s", name);
            else if (!missing)
                missing = group->names[j];
        }
        if (missing && (group->required || *found->groups[i].names[0])) {
            check->wrong++;
            *complete = false;
            SAY(check, " MISSING: %s (%s); if it goes by another name: --map %s=NAME", missing, group->meaning,
                missing);
        } else if (missing && group->without) {
            SAY(check, " missing: %s", group->without);
        } else if (missing) {
            SAY(check, " none");
        }
        SAY(check, "\n");
    }
}

static bool is_used(const struct passes_found *found, const char *name)
{
    for (int i = 0; i < CHANNEL_GROUPS; i++)
        for (int j = 0; j < channel_groups[i].count; j++)
            if (!strcmp(found->groups[i].names[j], name))
                return true;
    return false;
}

static void tell_rest(struct check *check, const struct passes_found *found)
{
    const struct gbuffer *gbuffer = check->gbuffer;
    SAY(check, "%-12s", "not used");
    for (int i = 0; i < found->channels.count; i++)
        if (!is_used(found, found->channels.texts[i]))
            SAY(check, " %s", found->channels.texts[i]);
    SAY(check, "\n%-12s", "camera");
    if (gbuffer->has_eye)
        SAY(check, " eye at %g, %g, %g", (double)gbuffer->eye[0], (double)gbuffer->eye[1], (double)gbuffer->eye[2]);
    else
        SAY(check, " no eye (povgloss:eye)");
    SAY(check, gbuffer->view_angle > 0 ? ", view angle known\n" : ", no view angle (povgloss:viewAngle)\n");
}

static bool is_finite_at(const struct image *image, int x, int y)
{
    bool finite = true;
    for (int i = 0; i < image->channels && finite; i++)
        finite = isfinite(image_row(image, i, y)[x]);
    return finite;
}

/* A position, or an endpoint with its W divided out; false: there is none. */
static bool point_at(const struct image *image, int x, int y, double point[3])
{
    double w = image->channels > 3 ? (double)image_row(image, 3, y)[x] : 1, square = 0;
    if (!is_finite_at(image, x, y) || !(w > 0))
        return false;
    for (int i = 0; i < 3; i++) {
        point[i] = (double)image_row(image, i, y)[x] / w;
        square += point[i] * point[i];
    }
    return square > 0;
}

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static void check_finite(struct check *check)
{
    const struct gbuffer *gbuffer = check->gbuffer;
    long position = 0, endpoint = 0, behind = 0, specular = 0, reflectance = 0, zero = 0, exponent = 0, base = 0;
    for (int y = 0; y < gbuffer->endpoint.height; y++)
        for (int x = 0; x < gbuffer->endpoint.width; x++) {
            if (gbuffer->phong.pixels)
                exponent += !(image_row(&gbuffer->phong, 0, y)[x] >= 0);
            if (gbuffer->base.pixels)
                base += !is_finite_at(&gbuffer->base, x, y);
            if (!gbuffer_is_glossy(gbuffer, x, y))
                continue;
            check->glossy++;
            double a[3];
            position += !is_finite_at(&gbuffer->position, x, y);
            zero += is_finite_at(&gbuffer->position, x, y) && !point_at(&gbuffer->position, x, y, a);
            endpoint += !is_finite_at(&gbuffer->endpoint, x, y);
            behind += image_row(&gbuffer->endpoint, 3, y)[x] < 0;
            specular += !is_finite_at(&gbuffer->specular, x, y);
            if (gbuffer->reflectance.pixels)
                reflectance += !is_finite_at(&gbuffer->reflectance, x, y);
        }
    SAY(check, "%-12s %ld of %ld pixels\n", "glossy", check->glossy,
        (long)gbuffer->endpoint.width * gbuffer->endpoint.height);
    if (check->glossy == 0) {
        check->wrong++;
        SAY(check, "wrong: nothing is glossy: the endpoint or the exponent is 0 at every pixel\n");
    }
    wrong(check, position, "have no finite position (P): they lose their reflection");
    wrong(check, zero > 1 ? zero : 0, "have the position 0, 0, 0: P was not written there");
    wrong(check, endpoint, "have no finite endpoint: they lose their reflection; where a mirrored ray hits nothing "
                           "write its direction, and W 0");
    wrong(check, behind, "have an endpoint whose W is below 0: they lose their reflection");
    wrong(check, specular, "have no finite specular radiance: they lose their reflection; half floats end at 65504");
    wrong(check, reflectance, "have no finite reflectance");
    if (exponent > 0) {
        check->wrong++;
        SAY(check, "wrong: %ld pixels have an exponent below 0 or NaN: they count as not glossy\n", exponent);
    }
    note(check, base, "have a base that is not finite: so will the picture be there");
}

/* Directions, and what only an average over the pixel can be. */
static void check_w(struct check *check)
{
    const struct gbuffer *gbuffer = check->gbuffer;
    long plain = 0, mixed = 0, odd_length = 0;
    for (int y = 0; y < gbuffer->endpoint.height; y++)
        for (int x = 0; x < gbuffer->endpoint.width; x++) {
            if (!gbuffer_is_glossy(gbuffer, x, y) || !is_finite_at(&gbuffer->endpoint, x, y))
                continue;
            double w = (double)image_row(&gbuffer->endpoint, 3, y)[x], square = 0;
            for (int i = 0; i < 3; i++)
                square += pow((double)image_row(&gbuffer->endpoint, i, y)[x], 2);
            *(fabs(w) < 1e-3 || fabs(w - 1) < 1e-3 ? &plain : &mixed) += 1;
            odd_length += w == 0 && fabs(sqrt(square) - 1) > 0.01;
        }
    if (plain > mixed && (double)mixed > mixed_w_share * (double)check->glossy)
        wrong(check, mixed,
              "have an endpoint whose W is neither 0 nor 1, unlike the rest: endpoints are averaged; write one sample "
              "at the pixel's centre, with a box filter");
    note(check, odd_length, "have a direction (W 0) whose length is not 1: only where it points to counts");
}

/* Whether the middle one of five points in a row lies between two surfaces: 1, or at the end of one: 0; -1: there is no
 * edge, which is a step ten times as large as those beside it. */
static int lies_between(double p[5][3])
{
    double before = distance(p[0], p[1]), after = distance(p[3], p[4]), jump = distance(p[1], p[3]);
    if (!(jump > 10 * fmax(before, after)) || !(before > 0 && after > 0))
        return -1;
    if (distance(p[1], p[2]) <= 3 * before || distance(p[2], p[3]) <= 3 * after)
        return 0;
    double along = 0, aside = 0;
    for (int i = 0; i < 3; i++)
        along += (p[2][i] - p[1][i]) * (p[3][i] - p[1][i]) / (jump * jump);
    for (int i = 0; i < 3; i++)
        aside += pow(p[2][i] - p[1][i] - along * (p[3][i] - p[1][i]), 2);
    return along > 0.02 && along < 0.98 && sqrt(aside) < 0.1 * jump;
}

static void check_averages(struct check *check, const struct image *image, const char *what)
{
    long edges = 0, between = 0;
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x + 4 < image->width; x++) {
            double p[5][3];
            bool there = true;
            for (int i = 0; i < 5 && there; i++)
                there = point_at(image, x + i, y, p[i]);
            int kind = there ? lies_between(p) : -1;
            edges += kind >= 0;
            between += kind > 0;
        }
    /* A clean silhouette is seen twice, once from each side. */
    double share = (double)between / ((double)between + (double)(edges - between) / 2);
    if (edges < FEWEST_EDGES || share < between_share)
        return;
    check->wrong++;
    SAY(check,
        "wrong: at %.0f %% of the silhouettes the %s lies between near and far, on no surface: it is averaged over "
        "the pixel; write one sample at the pixel's centre, with a box filter\n",
        100 * share, what);
}

/* Positions as directions from the eye are smooth across silhouettes, whatever the camera; in pixels of their step. */
static void check_rays(struct check *check)
{
    const struct image *position = &check->gbuffer->position;
    long seen = 0, off = 0;
    double eye[3];
    for (int i = 0; i < 3; i++)
        eye[i] = (double)check->gbuffer->eye[i];
    for (int y = 0; y < position->height && check->gbuffer->has_eye; y++)
        for (int x = 0; x + 2 < position->width; x++) {
            double rays[3][3];
            bool there = true;
            for (int i = 0; i < 3 && there; i++) {
                there = point_at(position, x + i, y, rays[i]);
                double length = there ? distance(rays[i], eye) : 0;
                there = length > 0;
                for (int j = 0; j < 3; j++)
                    rays[i][j] = (rays[i][j] - eye[j]) / length;
            }
            if (!there)
                continue;
            double middle[3], step = distance(rays[0], rays[2]) / 2;
            for (int j = 0; j < 3; j++)
                middle[j] = (rays[0][j] + rays[2][j]) / 2;
            seen++;
            off += distance(middle, rays[1]) > off_ray_px * step;
        }
    if (seen == 0 || (double)off < off_ray_share * (double)seen)
        return;
    check->wrong++;
    SAY(check,
        "wrong: %.2g %% of the positions lie off the ray through their pixel's centre by more than a tenth of a pixel: "
        "they are averaged, jittered or half floats, or in another space than povgloss:eye\n",
        100.0 * (double)off / (double)seen);
}

static void check_lengths(struct check *check)
{
    const struct gbuffer *gbuffer = check->gbuffer;
    double farthest = 0, a[3], b[3];
    for (int y = 0; y < gbuffer->position.height; y++)
        for (int x = 0; x < gbuffer->position.width; x++)
            if (gbuffer_is_glossy(gbuffer, x, y) && point_at(&gbuffer->position, x, y, a))
                farthest = fmax(farthest, distance(a, (const double[3]){0, 0, 0}));
    long touch = 0;
    for (int y = 0; y < gbuffer->position.height; y++)
        for (int x = 0; x < gbuffer->position.width; x++)
            touch += gbuffer_is_glossy(gbuffer, x, y) && point_at(&gbuffer->position, x, y, a) &&
                     point_at(&gbuffer->endpoint, x, y, b) && distance(a, b) < touching * farthest;
    if ((double)touch >= touching_share * (double)check->glossy)
        wrong(check, touch, "have mirrored rays that end where they begin: begin them off the surface");
}

enum result passes_check(const struct gbuffer *gbuffer, const struct passes_found *found, struct buffer *report,
                         int *wrong_count, struct error *err)
{
    struct check check = {.gbuffer = gbuffer, .report = report, .err = err};
    bool complete;
    tell_names(&check, found, &complete);
    tell_rest(&check, found);
    if (complete) {
        check_finite(&check);
        check_w(&check);
        check_rays(&check);
        check_averages(&check, &gbuffer->position, "position (P)");
        check_averages(&check, &gbuffer->endpoint, "endpoint");
        check_lengths(&check);
    }
    *wrong_count = check.wrong;
    return check.result;
}
