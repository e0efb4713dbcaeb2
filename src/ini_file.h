/* POV-Ray's .ini files: settings (Width=640), switches (+W640), comments (; or #) and sections ([Final]). */
#ifndef POVGLOSS_INI_FILE_H
#define POVGLOSS_INI_FILE_H

#include "error.h"

#include <stddef.h>

/* Takes one line as an argument of POV-Ray's command line, without quotes and blanks: "Width=640", "+W640", or a file.
 * A setting with several values ("Library_Path=a,b") comes once for each. A result but RESULT_OK ends the reading. */
typedef enum result ini_file_take(void *context, const char *argument, struct error *err);

/* The length of the path in `path` or `path[section]`. */
size_t ini_file_path_length(const char *argument);

/* The length of the path if the argument names an .ini file (`quality.ini`, `quality.ini[Final]`), else 0. */
size_t ini_file_name(const char *argument);

/* Reads a file, named with or without a section: the lines before its first section, and those of the one named.
 * RESULT_DATA where it can't be read or has no such section. */
MUST_CHECK enum result ini_file_read(const char *argument, ini_file_take *take, void *context, struct error *err);

#endif
