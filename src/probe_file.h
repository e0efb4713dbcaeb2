/* Probes as a table of comma-separated values, one line a probe, and a filtered image against them.
 *
 *   x,y                 the pixel, from the top left corner
 *   phong               exponent of the lobe
 *   R,G,B               the true blurred reflection, linear, not multiplied by reflectance
 *   error               half of its 95 % confidence interval, of the channel where it is widest
 *   samples             rays that it is the mean of
 *   above               share of the lobe above the surface's horizon
 *   L0.R,L0.G,L0.B      the radiance along the mirror direction itself
 */
#ifndef POVGLOSS_PROBE_FILE_H
#define POVGLOSS_PROBE_FILE_H

#include "probe.h"

/* Writes `path` ("-": standard output); a file appears whole or not at all. */
MUST_CHECK enum result probe_file_write(const char *path, const struct probes *probes, struct error *err);

/* Reads a table into a new list, which the caller frees; of a probe's members those above. RESULT_DATA with the line
 * for a file that is no such table. */
MUST_CHECK enum result probe_file_read(const char *path, struct probe **list, int *count, struct error *err);

/* How far an image is from the truth, linear. */
struct probe_comparison {
    int count;     /* of probes */
    double rmse;   /* over probes and channels */
    double bias;   /* mean of image - truth */
    double median, percentile_95, worst; /* of the probes' largest differences in a channel */
    int worst_x, worst_y;
    double noise;  /* root mean square of the probes' own errors */
};

/* Compares the layers glossy.R/.G/.B of the EXR with the probes of the exponent given (below 0: all of them, and then
 * RESULT_DATA if there are several of one pixel). */
MUST_CHECK enum result probe_file_compare(const char *probes_path, const char *image_path, double phong,
                                          struct probe_comparison *comparison, struct error *err);

#endif
