/* SIGINT, SIGTERM and SIGHUP as a flag that long work looks at.
 *
 * The work returns RESULT_INTERRUPTED, everything is cleaned up on the ordinary way out, and the program then ends by
 * interrupt_reraise(), so that its parent sees a death by that signal (a shell: 128 + signal).
 */
#ifndef POVGLOSS_INTERRUPT_H
#define POVGLOSS_INTERRUPT_H

#include <stdbool.h>

/* Catches the three signals (without SA_RESTART: a blocking poll or read returns EINTR). Call once, before threads. */
void interrupt_install(void);

/* The signal that came, or 0. */
int interrupt_signal(void);

/* From `true` to `false` interrupt_signal() is SIGTERM where no signal came: a thread's work ends without one. */
void interrupt_stop(bool stop);

/* Ends the process by the signal that came; returns only if none did. */
void interrupt_reraise(void);

#endif
