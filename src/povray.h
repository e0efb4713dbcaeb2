/* Several POV-Ray processes at the same time: start, progress, messages, failure. */
#ifndef POVGLOSS_POVRAY_H
#define POVGLOSS_POVRAY_H

#include "child.h"
#include "mem.h"

enum { POVRAY_VERSION_SIZE = 32 };

/* Is called when a job has done its work. */
typedef enum result povray_ended(void *context, struct error *err);

/* One process. The caller fills the first group and frees the arguments; povray_run does the rest. */
struct povray_job {
    const char *name;       /* of the pass, for messages */
    const char *folder;     /* where the process runs and writes its image */
    char *const *arguments; /* argv, argv[0] being the program; NULL-terminated */
    const char *image;      /* the file in the folder that is all its work: it is done once that is closed; NULL: none */
    int timeout_s;          /* it is ended when it runs longer; 0: never */
    bool held;              /* doesn't start until the `ended` of another one clears this */
    bool dropped;           /* doesn't start at all: the `ended` of another one found that it isn't needed */
    povray_ended *ended;    /* may change the jobs that haven't started; NULL: none */
    void *context;

    struct child child;
    struct buffer messages; /* standard error */
    double done;            /* 0 to 1 */
    double start_s, end_s;  /* of timings_clock_s; the end is that of the timeout, infinite: none */
    double wall_s;          /* how long its work took, once that is done */
    int watch;              /* the folder's, of inotify; -1: none */
    bool started, delivered, finished; /* delivered: its work is done, and the process may still have to end */
};

/* Is told from time to time how much of all the work is done, 0 to 1; NULL: nobody is. */
typedef void povray_progress(void *context, double done);

/* Runs all jobs, `at_once` of them at a time, in their order as far as none waits, with the environment given. When one
 * fails the others are ended, *failed is its index (else -1), its messages are there for povray_error_text, and the
 * result is RESULT_POVRAY with its exit status; RESULT_POVRAY and -1 when one isn't there or runs into its timeout;
 * RESULT_INTERRUPTED after a signal; then no process is left. After a success those whose images are there may not have
 * ended: povray_end waits for them. */
MUST_CHECK enum result povray_run(struct povray_job *jobs, int count, int at_once, char *const *environment,
                                  povray_progress *progress, void *context, int *failed, struct error *err);

/* Waits for the ends of what povray_run has left, and takes their processor time. Fails as that does, where one whose image
 * is there fails after all, too. No process is left in any case. */
MUST_CHECK enum result povray_end(struct povray_job *jobs, int count, int *failed, struct error *err);

void povray_jobs_free(struct povray_job *jobs, int count);

/* RESULT_POVRAY, and a message that the program isn't there. */
enum result povray_missing(const char *program, struct error *err);

/* Whether the banner among the messages names a version but 3.7, and which. */
bool povray_is_other_version(const struct buffer *messages, char version[POVRAY_VERSION_SIZE]);

/* The lines of POV-Ray's messages that say what is wrong, in *text (the caller frees it): the wrapped lines joined,
 * banner, options and progress left out. Where none does, the last line but progress. */
MUST_CHECK enum result povray_error_text(const struct buffer *messages, struct buffer *text, struct error *err);

#endif
