/* OpenEXR files as named planes of floats. OpenEXRCore's header is included in exr_io.c only. */
#ifndef POVGLOSS_EXR_IO_H
#define POVGLOSS_EXR_IO_H

#include "image.h"

#include <stdbool.h>

enum { EXR_NAME_SIZE = 256 };

/* One channel: its full name ("specular.R") and which plane of the image holds it. */
struct exr_channel {
    char name[EXR_NAME_SIZE];
    const struct image *image; /* writing: the source */
    int channel;               /* plane of that image */
};

struct exr_attributes {
    bool has_eye;
    float eye[3];        /* povgloss:eye */
    float view_angle;    /* povgloss:viewAngle; 0: absent */
    float working_gamma; /* povgloss:workingGamma; 0: absent */
    struct image_window window; /* writing: the display window in the image; width 0: all of it */
};

/* What was read: channel i has the name names[i] and is plane i of the image. */
struct exr_contents {
    struct image image;          /* the data window */
    struct image_window window;  /* the display window in it */
    char (*names)[EXR_NAME_SIZE];
    struct exr_attributes attributes;
};

/* Reads every channel of a scanline or tiled file, half, float or uint, as floats. "-": standard input.
 *
 * The parts of a multi-part file are joined: the image holds all their data windows, and is 0 where a part has no
 * pixels. A channel is named "part.channel", unless its own name begins with its part's already; parts that
 * OpenImageIO numbered ("subimage01") count as nameless. An attribute is that of the first part that has it. */
MUST_CHECK enum result exr_read(const char *path, struct exr_contents *contents, struct error *err);
void exr_contents_free(struct exr_contents *contents);

/* Index of the channel of that name, or -1. */
int exr_find(const struct exr_contents *contents, const char *name);

/* Writes 32-bit float, ZIP, scanline, single-part; all images are of one size. "-": standard output. */
MUST_CHECK enum result exr_write(const char *path, const struct exr_channel *channels, int channel_count,
                                 const struct exr_attributes *attributes, struct error *err);

#endif
