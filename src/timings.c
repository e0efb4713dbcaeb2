/* Steps are few: a row is found by looking at all of them. */
#include "timings.h"

#include <assert.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

static double read_clock(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double timings_clock_s(void)
{
    return read_clock(CLOCK_MONOTONIC);
}

struct timings_moment timings_now(void)
{
    return (struct timings_moment){.clock_s = timings_clock_s(), .cpu_s = read_clock(CLOCK_PROCESS_CPUTIME_ID)};
}

struct timings timings_begin(void)
{
    return (struct timings){.begin = timings_now()};
}

static void add(struct timings *timings, const struct timing *timing)
{
    int i = 0;
    while (i < timings->count && (timings->rows[i].povray != timing->povray || strcmp(timings->rows[i].step, timing->step)))
        i++;
    assert(i < TIMINGS_MAX_ROWS);
    struct timing *row = &timings->rows[i];
    if (i == timings->count) {
        timings->count++;
        *row = *timing;
        row->start_s -= timings->begin.clock_s;
    } else {
        row->wall_s += timing->wall_s;
        row->cpu_s += timing->cpu_s;
    }
}

void timings_add(struct timings *timings, const char *step, struct timings_moment start)
{
    struct timings_moment end = timings_now();
    if (timings)
        add(timings, &(struct timing){.step = step,
                                      .start_s = start.clock_s,
                                      .wall_s = end.clock_s - start.clock_s,
                                      .cpu_s = end.cpu_s - start.cpu_s});
}

void timings_add_povray(struct timings *timings, const char *pass, double start_s, double wall_s, double cpu_s)
{
    if (timings)
        add(timings, &(struct timing){
                         .step = pass, .povray = true, .start_s = start_s, .wall_s = wall_s, .cpu_s = cpu_s});
}

static double seconds(struct timeval time)
{
    return (double)time.tv_sec + 1e-6 * (double)time.tv_usec;
}

void timings_print(const struct timings *timings, FILE *stream)
{
    struct timings_moment now = timings_now();
    struct rusage children;
    getrusage(RUSAGE_CHILDREN, &children);
    double children_s = seconds(children.ru_utime) + seconds(children.ru_stime);
    fprintf(stream, "%-21s %9s %9s %9s\n", "STEP", "START_S", "WALL_S", "CPU_S");
    for (int i = 0; i < timings->count; i++) {
        const struct timing *row = &timings->rows[i];
        char step[64];
        snprintf(step, sizeof step, "%s%s", row->povray ? "povray:" : "", row->step);
        fprintf(stream, "%-21s %9.3f %9.3f %9.3f\n", step, row->start_s, row->wall_s, row->cpu_s);
    }
    fprintf(stream, "%-21s %9.3f %9.3f %9.3f\n", "total", 0.0, now.clock_s - timings->begin.clock_s,
            now.cpu_s - timings->begin.cpu_s + children_s);
}
