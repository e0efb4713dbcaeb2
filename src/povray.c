/* One poll loop over the standard errors of all running processes: after its end of file a process is watched until it
 * has ended.
 *
 * POV-Ray writes everything there: banner, options, warnings, errors, and its progress.
 */
#include "povray.h"

#include "interrupt.h"
#include "timings.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_JOBS = 16, POLL_MS = 200, POLL_ENDING_MS = 5, MAX_MESSAGES = 1 << 22 };

/* POV-Ray writes `Rendered N of M pixels (P%)`, ended by a carriage return. */
static void read_progress(struct povray_job *job)
{
    const char *text = job->messages.data, *last = NULL;
    size_t tail = job->messages.size < 300 ? 0 : job->messages.size - 300;
    for (const char *at = text + tail; (at = strstr(at, "Rendered ")); at++)
        last = at;
    double pixels, all;
    int whole = 0;
    if (last && sscanf(last, "Rendered %lf of %lf pixels%n", &pixels, &all, &whole) == 2 && whole > 0 && all > 0)
        job->done = pixels / all;
}

/* Takes what there is to read, and closes the pipe at its end. */
static enum result read_messages(struct povray_job *job, struct error *err)
{
    char block[4096];
    ssize_t count;
    enum result result = RESULT_OK;
    while (!result && (count = read(job->child.output_fd, block, sizeof block)) > 0) {
        for (ssize_t i = 0; i < count; i++)
            if (!block[i])
                block[i] = ' ';
        if (job->messages.size < MAX_MESSAGES)
            result = buffer_add(&job->messages, block, (size_t)count, err);
    }
    if (!result && (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)))
        child_close_output(&job->child);
    if (!result && job->messages.size)
        read_progress(job);
    return result;
}

enum result povray_missing(const char *program, struct error *err)
{
    return error_set(err, RESULT_POVRAY,
                     "%s isn't in PATH: install POV-Ray 3.7 (on Debian: apt-get install povray povray-includes)", program);
}

static enum result start_job(struct povray_job *job, char *const *environment, struct error *err)
{
    bool missing;
    job->start_s = timings_clock_s();
    enum result result = child_start(&job->child, job->arguments, job->folder, environment, &missing, err);
    if (result && missing)
        return povray_missing(job->arguments[0], err);
    job->started = !result;
    job->end_s = job->timeout_s > 0 ? job->start_s + job->timeout_s : INFINITY;
    return result;
}

/* The first job that may be started, or NULL. */
static struct povray_job *next_job(struct povray_job *jobs, int count)
{
    for (int i = 0; i < count; i++)
        if (!jobs[i].started && !jobs[i].held && !jobs[i].dropped)
            return &jobs[i];
    return NULL;
}

static bool is_done(const struct povray_job *job)
{
    return job->finished || job->dropped;
}

static bool are_done(const struct povray_job *jobs, int count)
{
    for (int i = 0; i < count; i++)
        if (!is_done(&jobs[i]))
            return false;
    return true;
}

static void report(const struct povray_job *jobs, int count, povray_progress *progress, void *context)
{
    if (!progress)
        return;
    double done = 0;
    for (int i = 0; i < count; i++)
        done += is_done(&jobs[i]) ? 1 : 0.99 * jobs[i].done;
    progress(context, done / count);
}

enum result povray_run(struct povray_job *jobs, int count, int at_once, char *const *environment,
                       povray_progress *progress, void *context, int *failed, struct error *err)
{
    enum result result = RESULT_OK;
    int running = 0;
    *failed = -1;
    while (!result && !are_done(jobs, count)) {
        struct povray_job *next;
        while (!result && running < at_once && running < MAX_JOBS && (next = next_job(jobs, count))) {
            result = start_job(next, environment, err);
            running += !result;
        }
        struct pollfd polls[MAX_JOBS];
        int owners[MAX_JOBS], poll_count = 0, wait_ms = POLL_MS;
        for (int i = 0; i < count; i++)
            if (jobs[i].started && !jobs[i].finished) {
                owners[poll_count] = i;
                /* poll() passes over a descriptor of -1. */
                polls[poll_count++] = (struct pollfd){.fd = jobs[i].child.output_fd, .events = POLLIN};
                if (jobs[i].child.output_fd < 0)
                    wait_ms = POLL_ENDING_MS;
            }
        if (!result && poll(polls, (nfds_t)poll_count, wait_ms) < 0 && errno != EINTR)
            result = error_set(err, RESULT_DATA, "waiting for POV-Ray failed: %s", strerror(errno));
        if (interrupt_signal())
            result = RESULT_INTERRUPTED;
        for (int i = 0; !result && i < poll_count; i++) {
            struct povray_job *job = &jobs[owners[i]];
            int status;
            if (polls[i].revents)
                result = read_messages(job, err);
            if (!result && timings_clock_s() > job->end_s)
                result = error_set(err, RESULT_POVRAY, "POV-Ray took longer than %d s in the %s pass, and was ended: give it "
                                   "more time (--timeout)", job->timeout_s, job->name);
            if (result || job->child.output_fd >= 0 || !child_has_ended(&job->child, &status))
                continue;
            job->finished = true;
            job->wall_s = timings_clock_s() - job->start_s;
            running--;
            if (status && !interrupt_signal()) {
                *failed = owners[i];
                result = error_set(err, RESULT_POVRAY, "povray failed with exit status %d in the %s pass", status,
                                   job->name);
            } else if (job->ended && !interrupt_signal()) {
                result = job->ended(job->context, err);
            }
        }
        report(jobs, count, progress, context);
    }
    struct child *left[MAX_JOBS];
    int left_count = 0;
    for (int i = 0; i < count; i++)
        if (jobs[i].child.pid > 0)
            left[left_count++] = &jobs[i].child;
    child_kill(left, left_count);
    return result;
}

void povray_jobs_free(struct povray_job *jobs, int count)
{
    for (int i = 0; i < count; i++)
        buffer_free(&jobs[i].messages);
}

bool povray_is_other_version(const struct buffer *messages, char version[POVRAY_VERSION_SIZE])
{
    static const char banner[] = "Ray Tracer Version ";
    const char *at = messages->data ? strstr(messages->data, banner) : NULL;
    if (!at)
        return false;
    at += strlen(banner);
    snprintf(version, POVRAY_VERSION_SIZE, "%.*s", (int)strcspn(at, " \r\n"), at);
    return strncmp(version, "3.7", 3) || (version[3] >= '0' && version[3] <= '9');
}

/* A message is wrapped at 80 columns, and its further lines begin with a space. */
enum result povray_error_text(const struct buffer *messages, struct buffer *text, struct error *err)
{
    enum result result = RESULT_OK;
    bool wanted = false;
    const char *line = messages->data ? messages->data : "", *last = NULL;
    while (!result && *line) {
        size_t length = strcspn(line, "\r\n");
        const char *end = line + length;
        char *copy = strndup(line, length);
        if (!copy)
            return error_memory(err, (double)length);
        bool further = wanted && copy[0] == ' ';
        wanted = further || strstr(copy, "Error") || strstr(copy, "error") || !strncmp(copy, "Problem with option", 19) ||
                 !strncmp(copy, "Failed to parse", 15);
        bool noise = !strncmp(copy, "Fatal error in parser: Cannot parse input", 41);
        if (wanted && !noise && length)
            result = buffer_printf(text, err, "%s%s", further || !text->size ? "" : "\n", copy);
        if (length && strncmp(copy, "Rendered ", 9) && strcmp(copy, "POV-Ray finished"))
            last = line;
        free(copy);
        line = end + strspn(end, "\r\n");
    }
    if (!result && !text->size && last)
        result = buffer_printf(text, err, "%.*s", (int)strcspn(last, "\r\n"), last);
    return result;
}
