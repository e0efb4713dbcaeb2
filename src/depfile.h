/* A make rule that says from which files an output was made, as gcc -MMD -MP writes it. */
#ifndef POVGLOSS_DEPFILE_H
#define POVGLOSS_DEPFILE_H

#include "mem.h"

/* RESULT_DATA for a name that make can't take in a rule, however it is escaped: with % ; = | or a control character in
 * it, a ~ at its beginning, or a space, & or backslash at its end. */
MUST_CHECK enum result depfile_check_name(const char *name, struct error *err);

/* Writes `targets...: files...`, and a rule without recipe for each of the files but the first (the source), so that
 * make goes on when it was removed. *files holds names that end with NUL. "-" is standard output. */
MUST_CHECK enum result depfile_write(const char *path, const struct text_list *targets,
                                     const struct buffer *files, struct error *err);

#endif
