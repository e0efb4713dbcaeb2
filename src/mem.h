/* The containers of the library: a growing array of bytes, for text that is built up and lists of anything, and a list
 * of texts. */
#ifndef POVGLOSS_MEM_H
#define POVGLOSS_MEM_H

#include "error.h"

#include <stddef.h>

struct buffer {
    char *data; /* always followed by a NUL once anything was added */
    size_t size, capacity;
};

/* Appends bytes; RESULT_DATA when memory runs out (the buffer is as before). */
MUST_CHECK enum result buffer_add(struct buffer *buffer, const void *bytes, size_t size, struct error *err);
MUST_CHECK enum result buffer_add_text(struct buffer *buffer, const char *text, struct error *err);
__attribute__((format(printf, 3, 4))) MUST_CHECK enum result buffer_printf(struct buffer *buffer, struct error *err,
                                                                           const char *format, ...);
void buffer_free(struct buffer *buffer);

/* A new string by a printf format in *text, which the caller frees. */
__attribute__((format(printf, 3, 4))) MUST_CHECK enum result text_printf(char **text, struct error *err,
                                                                         const char *format, ...);

/* Texts in their order, followed by NULL once any was added: the argv of a process, too. */
struct text_list {
    char **texts;
    int count;
};

/* Appends a new text by a printf format. */
__attribute__((format(printf, 3, 4))) MUST_CHECK enum result text_list_add(struct text_list *list, struct error *err,
                                                                           const char *format, ...);
void text_list_free(struct text_list *list);

/* RESULT_DATA, with both figures, for more bytes than the system says are free, swap included (/proc/meminfo): it would
 * hand them out, and end a process when they are used. */
MUST_CHECK enum result memory_check(double bytes, struct error *err);

/* Writes a whole new file or replaces its content; for files in a folder of our own. */
MUST_CHECK enum result file_write(const char *path, const struct buffer *buffer, struct error *err);

#endif
