/* A whole input in memory, from a file or from standard input: what can't seek is read like what can. */
#ifndef POVGLOSS_INPUT_FILE_H
#define POVGLOSS_INPUT_FILE_H

#include "error.h"

#include <stddef.h>

struct input_file {
    unsigned char *data;
    size_t size; /* bytes */
};

/* Reads all of `path` ("-": standard input, which must not be a terminal: RESULT_USAGE). Refused are what cannot be
 * read and what is larger than input_memory_limit(). The caller frees *file; on failure it is empty.
 * RESULT_INTERRUPTED if a caught signal came while the input was blocked. */
MUST_CHECK enum result input_file_read(const char *path, struct input_file *file, struct error *err);
void input_file_free(struct input_file *file);

/* `path`, or "standard input" for "-": for messages. */
const char *input_file_name(const char *path);

/* Bytes that one input may take in memory, as it is or decoded: half of the machine's memory. */
double input_memory_limit(void);

#endif
