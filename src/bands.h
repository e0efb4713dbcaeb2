/* Rows of an image, or other pieces of work that are numbered, shared out among threads. */
#ifndef POVGLOSS_BANDS_H
#define POVGLOSS_BANDS_H

#include "error.h"

/* Does the rows from `first` up to, but not including, `end`. Several threads call it at once, each with other rows. */
typedef void (*bands_function)(void *context, int first, int end);

/* Calls `function` for bands of band_rows rows until all of `rows` are done, on `threads` threads (0: one per
 * processor; the caller's thread is one of them, and does the work alone where no thread can be started). Which thread
 * gets which band is left to chance: the function's results must not depend on it. RESULT_INTERRUPTED where
 * interrupt_signal() stopped it between bands; nothing else fails. */
MUST_CHECK enum result bands_run(int rows, int band_rows, int threads, bands_function function, void *context,
                                 struct error *err);

#endif
