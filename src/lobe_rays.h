/* Rays of the lobe from points of the glossy surfaces, rendered by POV-Ray: for probes, and for --rays. */
#ifndef POVGLOSS_LOBE_RAYS_H
#define POVGLOSS_LOBE_RAYS_H

#include "command.h"

/* Measures the probes by rounds of rays in the frame that the passes drew last. */
MUST_CHECK enum result lobe_rays_measure(const struct command *command, struct passes *passes, int frame,
                                         struct probes *probes, struct error *err);

/* Fills gbuffer->rays by command->rays rays at every glossy pixel of that frame. An exponent of the filter's own takes
 * the place of those in the gbuffer. */
MUST_CHECK enum result lobe_rays_trace(const struct command *command, struct passes *passes, int frame,
                                       struct gbuffer *gbuffer, struct error *err);

#endif
