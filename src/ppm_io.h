/* PPM files, as POV-Ray writes them, as planes of floats. */
#ifndef POVGLOSS_PPM_IO_H
#define POVGLOSS_PPM_IO_H

#include "image.h"

/* Reads a binary PPM (P6) of 16 bits a sample into a 3-channel image of its codes divided by 65535, from which they come
 * back exactly. RESULT_DATA: another kind of file, or one that ends early. The caller frees *image; on failure it is
 * empty. */
MUST_CHECK enum result ppm_read(const char *path, struct image *image, struct error *err);

#endif
