/* Output that appears whole or not at all: a temporary file in the target's folder, renamed over the target. */
#ifndef POVGLOSS_OUTPUT_FILE_H
#define POVGLOSS_OUTPUT_FILE_H

#include "error.h"

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>

struct output_file {
    const char *path; /* as the caller gave it, for messages; the caller keeps it alive */
    int fd;           /* -1: not open */
    bool direct;      /* written in place: standard output, a pipe or a device */
    char target[PATH_MAX];
    char temporary[PATH_MAX];
};

/* Opens `path` for writing.
 *
 * "-" and names of the same file as standard output (/dev/stdout) are standard output, which must not be a terminal
 * (RESULT_USAGE). A device or a pipe is written in place. Otherwise a hidden temporary file is made in the same folder,
 * with the permissions of the file that it will replace, or those the umask leaves. Symbolic links are followed and
 * stay. A write-protected file is refused. On failure nothing is open and nothing was made.
 */
MUST_CHECK enum result output_file_open(struct output_file *file, const char *path, struct error *err);

/* Writes all `size` bytes. RESULT_INTERRUPTED if a caught signal came while the output was blocked. */
MUST_CHECK enum result output_file_write(struct output_file *file, const void *data, size_t size, struct error *err);

/* Closes the file and puts it in its place. Whatever the result, the file is not open afterwards, and after a failure
 * no temporary file is left and the target is as it was. */
MUST_CHECK enum result output_file_commit(struct output_file *file, struct error *err);

/* Closes and removes the temporary file; the target is as it was. Does nothing after a commit or a failed open. */
void output_file_abort(struct output_file *file);

/* `path`, or "standard output" for "-": for messages. */
const char *output_file_name(const char *path);

#endif
