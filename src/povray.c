/* One poll loop over the standard errors of all running processes, and over what is closed in their folders: after its end
 * of file a process is watched until it has ended.
 *
 * POV-Ray writes everything there: banner, options, warnings, errors, and its progress. It closes its image when that is
 * whole, some tenths of a second before it ends.
 */
#include "povray.h"

#include "interrupt.h"
#include "timings.h"
#include "work_folder.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
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

/* `notify_fd` tells what is closed in the folders of jobs that have an image; -1, or a folder that can't be watched: their
 * ends tell. */
static enum result start_job(struct povray_job *job, int notify_fd, char *const *environment, struct error *err)
{
    bool missing;
    job->watch = job->image ? inotify_add_watch(notify_fd, job->folder, IN_CLOSE_WRITE) : -1;
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

static bool is_alive(const struct povray_job *job)
{
    return job->started && !job->finished;
}

static bool is_done(const struct povray_job *job)
{
    return job->delivered || job->dropped;
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

static enum result tell_done(struct povray_job *job, struct error *err)
{
    job->delivered = true;
    job->wall_s = timings_clock_s() - job->start_s;
    return job->ended && !interrupt_signal() ? job->ended(job->context, err) : RESULT_OK;
}

/* Whether the image that was closed may be whole: a file that was only tried is empty, and on a full disk none is whole. */
static bool is_written(const struct povray_job *job)
{
    char path[PATH_MAX];
    struct stat image;
    int length = snprintf(path, sizeof path, "%s/%s", job->folder, job->image);
    return length < (int)sizeof path && stat(path, &image) == 0 && image.st_size > 0 && !folder_is_full(job->folder);
}

/* Jobs whose image has been closed have done their work. */
static enum result take_images(struct povray_job *jobs, int count, int notify_fd, struct error *err)
{
    _Alignas(struct inotify_event) char events[4096];
    const ssize_t size = read(notify_fd, events, sizeof events);
    enum result result = RESULT_OK;
    for (ssize_t at = 0; at < size;) {
        const struct inotify_event *event = (const struct inotify_event *)(const void *)(events + at);
        at += (ssize_t)(sizeof *event + event->len);
        for (int i = 0; !result && i < count; i++) {
            struct povray_job *job = &jobs[i];
            if (!is_alive(job) || job->delivered || job->watch != event->wd || !event->len ||
                strcmp(event->name, job->image) || !is_written(job))
                continue;
            result = tell_done(job, err);
        }
    }
    return result;
}

/* Waits until something happens to one of the jobs, or for a while. */
static enum result watch_jobs(struct povray_job *jobs, int count, int notify_fd, int *failed, struct error *err)
{
    struct pollfd polls[1 + MAX_JOBS] = {{.fd = notify_fd, .events = POLLIN}};
    int owners[1 + MAX_JOBS], poll_count = 1, wait_ms = POLL_MS;
    enum result result = RESULT_OK;
    for (int i = 0; i < count; i++)
        if (is_alive(&jobs[i])) {
            owners[poll_count] = i;
            /* poll() passes over a descriptor of -1. */
            polls[poll_count++] = (struct pollfd){.fd = jobs[i].child.output_fd, .events = POLLIN};
            if (jobs[i].child.output_fd < 0)
                wait_ms = POLL_ENDING_MS;
        }
    if (poll(polls, (nfds_t)poll_count, wait_ms) < 0 && errno != EINTR)
        return error_set(err, RESULT_DATA, "waiting for POV-Ray failed: %s", strerror(errno));
    if (interrupt_signal())
        return RESULT_INTERRUPTED;
    if (polls[0].revents)
        result = take_images(jobs, count, notify_fd, err);
    for (int i = 1; !result && i < poll_count; i++) {
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
        if (status && !interrupt_signal()) {
            *failed = owners[i];
            result = error_set(err, RESULT_POVRAY, "povray failed with exit status %d in the %s pass", status, job->name);
        } else if (!job->delivered) {
            result = tell_done(job, err);
        }
    }
    return result;
}

static void kill_jobs(struct povray_job *jobs, int count)
{
    struct child *left[MAX_JOBS];
    int left_count = 0;
    for (int i = 0; i < count; i++)
        if (is_alive(&jobs[i])) {
            left[left_count++] = &jobs[i].child;
            jobs[i].finished = true;
        }
    child_kill(left, left_count);
}

/* How many processes there are, and of them those that haven't done their work. */
static void count_jobs(const struct povray_job *jobs, int count, int *alive, int *running)
{
    *alive = *running = 0;
    for (int i = 0; i < count; i++) {
        *alive += is_alive(&jobs[i]);
        *running += is_alive(&jobs[i]) && !jobs[i].delivered;
    }
}

enum result povray_run(struct povray_job *jobs, int count, int at_once, char *const *environment,
                       povray_progress *progress, void *context, int *failed, struct error *err)
{
    enum result result = RESULT_OK;
    const int notify_fd = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    *failed = -1;
    while (!result && !are_done(jobs, count)) {
        struct povray_job *next;
        int alive, running;
        count_jobs(jobs, count, &alive, &running);
        for (; !result && running < at_once && alive < MAX_JOBS && (next = next_job(jobs, count)); alive++, running++)
            result = start_job(next, notify_fd, environment, err);
        if (!result)
            result = watch_jobs(jobs, count, notify_fd, failed, err);
        report(jobs, count, progress, context);
    }
    if (notify_fd >= 0)
        close(notify_fd);
    if (result)
        kill_jobs(jobs, count);
    return result;
}

enum result povray_end(struct povray_job *jobs, int count, int *failed, struct error *err)
{
    int alive, running;
    enum result result = RESULT_OK;
    *failed = -1;
    while (count_jobs(jobs, count, &alive, &running), !result && alive > 0)
        result = watch_jobs(jobs, count, -1, failed, err);
    kill_jobs(jobs, count);
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
