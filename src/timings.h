/* Where the time goes: a row for each step of the work, and their table. */
#ifndef POVGLOSS_TIMINGS_H
#define POVGLOSS_TIMINGS_H

#include <stdbool.h>
#include <stdio.h>

enum { TIMINGS_MAX_ROWS = 40 };

/* A moment: of the monotonic clock, and the processor time of this process, all threads, until then; seconds. */
struct timings_moment {
    double clock_s, cpu_s;
};

/* A step that comes again, in another frame, adds to its row. */
struct timing {
    const char *step; /* one word; the string must stay */
    bool povray;      /* a process of its own */
    double start_s;   /* of the first time, after the beginning */
    double wall_s, cpu_s;
};

struct timings {
    struct timings_moment begin;
    struct timing rows[TIMINGS_MAX_ROWS];
    int count;
};

double timings_clock_s(void);
struct timings_moment timings_now(void);

/* An empty table that begins now. */
struct timings timings_begin(void);

/* Adds a step of this process from `start` until now. Without timings (NULL) nothing happens, here and below. */
void timings_add(struct timings *timings, const char *step, struct timings_moment start);

/* Adds a POV-Ray process that began at `start_s` of timings_clock_s. */
void timings_add_povray(struct timings *timings, const char *pass, double start_s, double wall_s, double cpu_s);

/* Prints a heading, a line for each step in the order of their ends, and the total: step, start, wall and CPU seconds.
 * POV-Ray's processes are named povray:PASS; the total has the processor time of all of them, too. */
void timings_print(const struct timings *timings, FILE *stream);

#endif
