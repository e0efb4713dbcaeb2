/* Where the files are that are installed with the program: in lib/ and share/ beside the folder that it is in. */
#ifndef POVGLOSS_OWN_FILES_H
#define POVGLOSS_OWN_FILES_H

#include "error.h"

/* The real path of a file or folder in a new string, which the caller frees: `name` is relative to the folder above the
 * program's ("lib/povgloss/preload.so"). RESULT_DATA if it isn't there. */
MUST_CHECK enum result own_file(const char *name, char **path, struct error *err);

#endif
