/* Other programs as child processes.
 *
 * A child is started by child_start, its output read from output_fd until end of file, and then reaped by child_wait or
 * child_has_ended; child_kill ends those that should not go on. Every started child is reaped exactly once.
 */
#ifndef POVGLOSS_CHILD_H
#define POVGLOSS_CHILD_H

#include "error.h"

#include <stdbool.h>
#include <sys/types.h>

struct child {
    pid_t pid;     /* 0: not running */
    int output_fd; /* reads what the child writes to its standard error, without blocking; -1: closed */
    double cpu_s;  /* processor time, once it has ended */
};

/* Starts argv[0], looked up in PATH, in `directory`, with no standard input and its standard output thrown away.
 * RESULT_POVRAY when it can't be executed; `*missing` is true when there is no such program. */
MUST_CHECK enum result child_start(struct child *child, char *const *argv, const char *directory, char *const *environment,
                                   bool *missing, struct error *err);

/* Waits for the end and closes output_fd: the exit status, or 128 + the signal that ended it. */
int child_wait(struct child *child);

/* The same without waiting: false while it runs. */
bool child_has_ended(struct child *child, int *status);

void child_close_output(struct child *child);

/* Asks all the children to end, and makes those end that haven't after two seconds; reaps them. Those that aren't
 * running are passed over. */
void child_kill(struct child *const *children, int count);

#endif
