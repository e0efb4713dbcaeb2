/* povgloss probe, brute and compare: what the blurred reflection truly is, by rays alone. */
#ifndef POVGLOSS_MEASURE_H
#define POVGLOSS_MEASURE_H

#include "command.h"

/* Measures at the grid's pixels and writes the table, or, for brute, at every pixel and writes the image. */
MUST_CHECK enum result measure_probes(struct command *command, struct error *err);

/* Compares an image with a table of probes and prints how far they are apart. */
MUST_CHECK enum result measure_compare(const struct command *command, struct error *err);

#endif
