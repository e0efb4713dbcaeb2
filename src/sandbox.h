/* A sandbox for POV-Ray, made by bubblewrap (bwrap) without root: what a scene reads and writes is limited to
 * folders. */
#ifndef POVGLOSS_SANDBOX_H
#define POVGLOSS_SANDBOX_H

#include "mem.h"

/* The arguments that go before a program's own, in *arguments (the caller frees them), after a trial: in the sandbox
 * there are the system's folders of programs and the real paths of `folders` and of the folders of `files` (NULL ones
 * are passed over), all read-only; work_folder, to be written; a /dev, and an empty /tmp that goes; no network, and no
 * process outside. A program runs in the folder where bwrap is started, which is below work_folder.
 *
 * RESULT_POVRAY if bwrap isn't in PATH or can't make the sandbox, with what it says. */
MUST_CHECK enum result sandbox_begin(const char *work_folder, const struct text_list *folders, const char *const *files,
                                     int file_count, struct text_list *arguments, struct error *err);

/* After the last program: waits, 5 s at most, for what a killed bwrap leaves, which ends by itself a moment later and
 * may still write. */
void sandbox_end(void);

/* The real path of a program that is looked up in PATH unless it has a slash, in *path, which the caller frees; NULL:
 * it isn't there. */
MUST_CHECK enum result program_find(const char *name, char **path, struct error *err);

#endif
