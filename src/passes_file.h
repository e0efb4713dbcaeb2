/* The passes file: a gbuffer as a single-part scanline EXR of 32-bit floats, ZIP.
 *
 *   R G B                  base: the image without the glossy reflection, linear
 *   specular.R/.G/.B       L0, radiance along the ideal mirror direction
 *   reflectance.R/.G/.B    reflectivity x coverage; missing: 1 where glossy
 *   P.X/.Y/.Z              a, world units
 *   endpoint.X/.Y/.Z/.W    b, homogeneous: W = 1 a position, W = 0 a unit direction
 *   phong.V                Phong exponent; 0 not glossy, infinity a mirror; missing: the filter's own exponent
 * Attributes povgloss:eye (v3f), povgloss:viewAngle (float, radians), povgloss:workingGamma (float),
 * povgloss:version (string).
 */
#ifndef POVGLOSS_PASSES_FILE_H
#define POVGLOSS_PASSES_FILE_H

#include "channels.h"
#include "gbuffer.h"

/* Reads `path` ("-": standard input) into *gbuffer, which the caller frees: all parts, by our names or other renderers'
 * (channels.h). The planes hold the data window, gbuffer->window is the display window in it; povgloss:viewAngle, that
 * of the display window, is widened to the planes.
 *
 * specular, P and endpoint are required: a file without one of them is refused by name (RESULT_DATA). On failure
 * *gbuffer is empty. */
MUST_CHECK enum result passes_file_read(const char *path, struct gbuffer *gbuffer, struct error *err);

/* What was found in a file. */
struct passes_names {
    char names[CHANNELS_MAX][EXR_NAME_SIZE]; /* of each channel of a group, in the file; "": it is missing */
};
struct passes_found {
    struct passes_names groups[CHANNEL_GROUPS];
    struct text_list channels; /* all that the file has */
};

/* The same with the names of `map` (channels.h) before all others. With `found` not NULL nothing is refused for what is
 * missing: *found tells it, and the caller frees found->channels. */
MUST_CHECK enum result passes_file_read_mapped(const char *path, const struct text_list *map, struct gbuffer *gbuffer,
                                               struct passes_found *found, struct error *err);

/* Writes `path` ("-": standard output) through a temporary file in the same folder. Empty images are left out. */
MUST_CHECK enum result passes_file_write(const char *path, const struct gbuffer *gbuffer, struct error *err);

#endif
