/* The shared object that is loaded into POV-Ray: it shortens POV-Ray's waits (preload_waits.c) and notes what POV-Ray
 * reads (preload_reads.c). */
#ifndef POVGLOSS_PRELOAD_H
#define POVGLOSS_PRELOAD_H

#include "work_folder.h"

#define PRELOAD_LINK "preload.so"

/* Makes a link PRELOAD_LINK in the work folder to the shared object, lib/povgloss/preload.so (own_files.h).
 * RESULT_DATA where that isn't there. */
MUST_CHECK enum result preload_begin(const struct work_folder *folder, struct error *err);

/* The variable LD_PRELOAD=... for the environment of POV-Ray in a folder of the work folder, with what it holds now.
 * The caller frees it. */
MUST_CHECK enum result preload_variable(char **variable, struct error *err);

#endif
