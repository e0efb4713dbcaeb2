/* Probes: the true blurred reflection at a grid of glossy pixels, by POV-Ray's rays alone.
 *
 *   L(a) = integral of L0(d) cos^p(d, m) over d  /  integral of cos^p(d, m) over d,
 *
 * d over the directions within 90 degrees of the mirror direction m that lie above the surface's horizon; its normal is
 * the bisector of m and the direction to the eye, of a bumped surface the bumped one. L0(d) is the linear radiance that
 * a mirrored ray sees from a along d. With p = infinity L is L0.
 *
 * Directions are drawn with density cos^p, so that all count the same: PROBE_SETS sets of points, each a
 * (0, 2)-sequence with a random scrambling of its own (Owen, 1995), turned about m at random for each probe. The sets'
 * means are independent: their spread gives the error. With a given number of rays at every pixel the 64 pixels of each
 * tile of 8 x 8 share one such sequence, each taking a part of it (interleaved sampling, Keller and Heidrich, 2001),
 * and the lobes are turned alike: the mean over some pixels errs less than that of rays at random. Probes are measured
 * in rounds, each with four times as many rays, until the error is small enough:
 *
 *   while (probes_left(&probes)) { probes_view -> rendered by POV-Ray -> probes_take }
 */
#ifndef POVGLOSS_PROBE_H
#define POVGLOSS_PROBE_H

#include "gbuffer.h"
#include "mem.h"

enum {
    PROBE_SETS = 16,
    PROBE_FIRST_RAYS = 1024,     /* a probe's rays after the first round */
    PROBE_MOST_RAYS = 1 << 18,   /* and after the last */
    PROBE_LOBES = 64,            /* with few rays probes don't all have the same ones */
    PROBE_VIEW_WIDTH = 1024,     /* of the images, pixels */
    PROBE_VIEW_RAYS = 1 << 22,   /* in one image, with the faces of its lobes, unless one probe has more */
};

struct probe {
    int x, y;          /* the pixel */
    double phong;      /* exponent of the lobe */
    float specular[3]; /* L0 of the passes there */
    double value[3];   /* L: R G B */
    double error;      /* half of the 95 % confidence interval, of the channel where it is widest */
    long samples;      /* rays above the horizon */
    double above;      /* their share of all */

    /* the frame of the rays: they come along `axis` (the eye's ray, straightened by the bisector) */
    double position[3], normal[3], axis[3], across[3], up[3];
    double scale; /* of the camera and the mirror */
    double sum[PROBE_SETS][3];
    long count[PROBE_SETS];
    bool done;
};

struct probe_options {
    int grid;                /* probes across the picture's width; rows as far apart */
    double error;            /* enough: for values above 1 relative to them */
    const double *exponents; /* in place of the scene's; none: NULL, 0 */
    int exponent_count;
    int rays;                /* of each probe; 0: as many as the error asks for */
    int first_row, end_row;  /* of the picture: only what lies from the one up to, but not including, the other; 0, 0: all */
    int seed;
};

struct probes {
    struct probe *list; /* by exponent, then rows and columns */
    int count;
    double error;
    unsigned seed;
    int lobes;              /* sets of directions of one exponent, of which each probe has one */
    long most;              /* rays of a probe */
    long rays, rays_before; /* of each probe after this round, and before it */
    int next;               /* first probe of the round's next view */
    int *viewed, viewed_count; /* those of the view that was made last */
};

/* Chooses the pixels: the centre of every grid cell where that is glossy. RESULT_DATA where none is, but for a
 * part of the rows. The gbuffer must
 * have the eye's rays and the mirrored ones. The caller frees *probes. */
MUST_CHECK enum result probes_begin(struct probes *probes, const struct gbuffer *gbuffer,
                                    const struct probe_options *options, struct error *err);
void probes_free(struct probes *probes);

/* Puts the values at their pixels. Next to them, at silhouettes, the mean of the probes around: an image of the
 * gbuffer's size (R G B, allocated here), which is black elsewhere. */
MUST_CHECK enum result probes_image(const struct probes *probes, const struct gbuffer *gbuffer, struct image *image,
                                    struct error *err);

/* Puts the values and the number of rays that count (4 channels) at their pixels, and leaves the others. */
void probes_means(const struct probes *probes, struct image *means);

/* Whether rays are missing; closes a round that is over. */
bool probes_left(struct probes *probes);

/* How many probes the round measures. */
int probes_open(const struct probes *probes);

/* The scene text of the next rays: a mesh_camera, and a tiny mirror at each probe. Nothing but the mirrors may be seen
 * by the camera, all else by what they mirror. The image has *width x *height pixels. */
MUST_CHECK enum result probes_view(struct probes *probes, struct buffer *text, int *width, int *height,
                                   struct error *err);

/* Takes the image (R G B) of the last probes_view. Infinite pixels count as 65504, where POV-Ray's half floats end. */
MUST_CHECK enum result probes_take(struct probes *probes, const struct image *image, struct error *err);

/* Ray `index` of all rays of a lobe of this exponent, in its frame: z along the axis; the set is index % PROBE_SETS. */
void probe_ray(double phong, unsigned seed, long index, double ray[3]);

/* Ray `ray` of those that the round adds to the probe's lobe, in its frame (across, up, axis). */
void probes_ray(const struct probes *probes, const struct probe *probe, long ray, double direction[3]);

#endif
