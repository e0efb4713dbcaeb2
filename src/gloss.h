/* libgloss: glossy reflections from planes of floats, for renderers and compositors.
 *
 *   cc $(pkg-config --cflags libgloss) renderer.c $(pkg-config --libs libgloss)
 *
 * The method is "Fuzzy reflections rendering" (Kulikova and Dmitriev, 2002): a mirror image, blurred by the lobe of
 * each surface over what its mirrored rays hit. povgloss-passes(5) has the planes' meaning at length.
 */
#ifndef GLOSS_H
#define GLOSS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The values are those that the programs exit with. */
enum gloss_status {
    GLOSS_OK = 0,
    GLOSS_USAGE = 2, /* options or planes that can't be */
    GLOSS_DATA = 3,  /* sizes or memory */
};

/* A picture as planes: row y of a plane begins at plane[y * stride]. Nothing is kept after the call. */
struct gloss_planes {
    int width, height;        /* pixels, from 1 to 65535 */
    size_t stride;            /* floats from one row to the next; 0: width */
    const float *specular[3]; /* R G B, linear: radiance along the mirror direction of the surface that a pixel shows */
    const float *position[3]; /* X Y Z, world units: the point of that surface at the pixel's centre */
    const float *endpoint[4]; /* X Y Z W: where the mirrored ray ends; W = 1 its position, W = 0 its direction where it
                                 hits nothing, all 0 where the pixel is not glossy */
    const float *phong;       /* Phong exponent, 0 not glossy, infinity a mirror; NULL: that of the options */
    const float *reflectance[3]; /* reflectivity times coverage, by which the result is to be multiplied; NULL:
                                    unknown. Pixels where it is above 0 beside glossy ones (antialiased edges) get a
                                    result, too */
    const float *eye;         /* 3 finite floats, world units; NULL: unknown, windows follow from neighbouring endpoints */
    float view_angle;         /* of the width, radians; finite, 0: unknown */
};

struct gloss_options {
    float phong;       /* exponent where there is no plane of exponents */
    int phong_for_all; /* not 0: phong takes the place of the plane's exponents above 0, too */
    int max_radius_px; /* limit of the window's radius; 0: none */
    int threads;       /* 0: as many as there are processors */
};

/* Blurs `specular` into the three planes of `glossy` (R G B, the same size and stride); 0 where nothing is glossy. The
 * picture is base + reflectance * glossy. A pixel with an exponent below 0 or NaN, W below 0, or NaN or infinity in its
 * specular, position or endpoint counts as not glossy, and nothing of it spreads; an exponent of 1e20 or more, and an
 * endpoint that touches the surface, give its specular itself; the angle between endpoints alone counts, so that
 * lengths times any factor give the same result. The result doesn't depend on the number of threads. On failure a
 * message is written to `message` (`message_size` bytes with the NUL; may be NULL, 0), and `glossy` is as it was. May
 * be called from several threads at a time. */
enum gloss_status gloss_filter(const struct gloss_planes *planes, const struct gloss_options *options,
                               float *const glossy[3], char *message, size_t message_size);

/* The same in steps, to blur the same planes with one exponent after another: the first gloss_apply() builds what the
 * exponent doesn't change. gloss_open() copies the planes; *gloss, which gloss_close() frees, is NULL on failure.
 * gloss_apply() may be called from one thread at a time for each gloss; what calls came before makes no difference. */
struct gloss;
enum gloss_status gloss_open(const struct gloss_planes *planes, struct gloss **gloss, char *message,
                             size_t message_size);
enum gloss_status gloss_apply(struct gloss *gloss, const struct gloss_options *options, float *const glossy[3],
                              char *message, size_t message_size);
void gloss_close(struct gloss *gloss); /* NULL is allowed */

#ifdef __cplusplus
}
#endif

#endif
