/* The files that POV-Ray read: the shared object that is loaded into it (preload.h) notes them in the work folder's
 * reads.log, and this turns them into the names that the user knows. */
#ifndef POVGLOSS_READS_H
#define POVGLOSS_READS_H

#include "mem.h"
#include "scene.h"
#include "work_folder.h"

/* How the names in the log, which POV-Ray opened in a folder of the work folder, lead to the user's. */
struct reads_places {
    const struct scene *scene;
    const struct text_list *directories; /* absolute, behind the links ../lib0, ../lib1, ... */
    const struct text_list *names;       /* the same as the user wrote them */
};

/* The user's names, each ended by NUL, without repeats. */
struct reads {
    struct buffer read, written;
};

void reads_free(struct reads *reads);

/* Makes the empty log. */
MUST_CHECK enum result reads_begin(const struct work_folder *folder, struct error *err);

/* Takes the names out of the log, which is empty then. Left out are files below /usr, /etc, /proc and /sys, unless one
 * of the directories led to them. RESULT_DATA if there was nothing in the log. */
MUST_CHECK enum result reads_collect(const struct work_folder *folder, const struct reads_places *places,
                                     struct reads *reads, struct error *err);

/* Adds what was read to *files: names that end with NUL, without repeats, the scene first, the others sorted. The .ini
 * files of the user count, what the scene wrote itself doesn't. */
MUST_CHECK enum result reads_list(const struct reads *reads, const char *scene, const struct text_list *ini_files,
                                  struct buffer *files, struct error *err);

#endif
