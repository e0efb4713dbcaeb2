/* The folder in which the passes are rendered: a temporary one that goes with everything in it, or one the user
 * keeps. */
#ifndef POVGLOSS_WORK_FOLDER_H
#define POVGLOSS_WORK_FOLDER_H

#include "error.h"

#include <stdbool.h>

struct work_folder {
    char *path; /* absolute; NULL: none */
    bool keep;
};

/* Makes the folder: `keep` (it may exist if it is empty), or with NULL a new one in $TMPDIR or /tmp. */
MUST_CHECK enum result work_folder_make(struct work_folder *folder, const char *keep, struct error *err);

/* Removes the folder unless it is kept; frees the path. Nothing happens without a folder. RESULT_DATA where something
 * of it is left. */
MUST_CHECK enum result work_folder_remove(struct work_folder *folder, struct error *err);

/* Whether less than 1 MB is left on the disk of a folder. */
bool folder_is_full(const char *path);

/* A folder inside it. */
MUST_CHECK enum result work_folder_add(const struct work_folder *folder, const char *name, struct error *err);

/* A symbolic link `name` inside it to the absolute path `target`: POV-Ray's command line can't take every name. */
MUST_CHECK enum result work_folder_link(const struct work_folder *folder, const char *name, const char *target,
                                        struct error *err);

#endif
