/* A part of the shared object that is loaded into POV-Ray by LD_PRELOAD: shortens its waits for messages.
 *
 * POV-Ray's threads look for messages, and at each look take one step towards the picture or from it to the end; between
 * two looks POV-Ray 3.7 waits for up to 50 ms, which is half a second for each picture. Here such a wait ends after
 * 2 ms, as if it had been woken: POSIX allows a condition wait to return so at any time (pthread_cond_timedwait,
 * "spurious wakeups"). Longer waits aren't touched, for POV-Ray takes their end for what it waits for.
 */
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <string.h>
#include <time.h>

#define NS_PER_S 1000000000L

typedef int wait_function(pthread_cond_t *condition, pthread_mutex_t *mutex, const struct timespec *until);

static struct timespec later(struct timespec time, long ns)
{
    time.tv_nsec += ns;
    time.tv_sec += time.tv_nsec / NS_PER_S;
    time.tv_nsec %= NS_PER_S;
    return time;
}

static int is_before(struct timespec a, struct timespec b)
{
    return a.tv_sec < b.tv_sec || (a.tv_sec == b.tv_sec && a.tv_nsec < b.tv_nsec);
}

int pthread_cond_timedwait(pthread_cond_t *restrict condition, pthread_mutex_t *restrict mutex,
                           const struct timespec *restrict until)
{
    /* The condition's clock isn't known, but only one of them is that near to its end. */
    static const clockid_t clocks[] = {CLOCK_MONOTONIC, CLOCK_REALTIME};
    const long longest_ns = 60 * 1000000L, look_ns = 2 * 1000000L;
    void *found = dlsym(RTLD_NEXT, "pthread_cond_timedwait");
    wait_function *next;
    memcpy(&next, &found, sizeof next);
    for (size_t i = 0; i < sizeof clocks / sizeof *clocks; i++) {
        struct timespec now, look;
        clock_gettime(clocks[i], &now);
        look = later(now, look_ns);
        if (is_before(look, *until) && is_before(*until, later(now, longest_ns))) {
            int status = next(condition, mutex, &look);
            return status == ETIMEDOUT ? 0 : status;
        }
    }
    return next(condition, mutex, until);
}
