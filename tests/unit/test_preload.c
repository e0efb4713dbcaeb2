/* The shared object that is loaded into POV-Ray, by dlopen: which waits it shortens. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "own_files.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef int wait_function(pthread_cond_t *condition, pthread_mutex_t *mutex, const struct timespec *until);

static void *object;

static int open_object(void **state)
{
    struct error err;
    char *path;
    (void)state;
    if (own_file("lib/povgloss/preload.so", &path, &err))
        return -1;
    object = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    free(path);
    return object ? 0 : -1;
}

static int close_object(void **state)
{
    (void)state;
    return dlclose(object);
}

static bool is_past(clockid_t clock, struct timespec until)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return now.tv_sec > until.tv_sec || (now.tv_sec == until.tv_sec && now.tv_nsec >= until.tv_nsec);
}

/* The status of a wait for a condition that nobody signals; *early: whether it ended before its time. */
static int wait_for(clockid_t clock, long ms, bool *early)
{
    pthread_condattr_t attributes;
    pthread_cond_t condition;
    pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    struct timespec until;
    wait_function *timed_wait;
    void *found = dlsym(object, "pthread_cond_timedwait");
    memcpy(&timed_wait, &found, sizeof timed_wait);
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, clock);
    pthread_cond_init(&condition, &attributes);
    pthread_mutex_lock(&mutex);
    clock_gettime(clock, &until);
    until.tv_nsec += ms * 1000000L;
    until.tv_sec += until.tv_nsec / 1000000000L;
    until.tv_nsec %= 1000000000L;
    int status = timed_wait(&condition, &mutex, &until);
    *early = !is_past(clock, until);
    pthread_mutex_unlock(&mutex);
    pthread_cond_destroy(&condition);
    pthread_condattr_destroy(&attributes);
    return status;
}

/* On a busy machine some of them may end late. */
static void povrays_wait_for_messages__wakes_before_its_time(void **state)
{
    static const clockid_t clocks[] = {CLOCK_MONOTONIC, CLOCK_REALTIME};
    (void)state;
    for (size_t i = 0; i < sizeof clocks / sizeof *clocks; i++) {
        bool woken = false, early;
        for (int attempt = 0; attempt < 20 && !woken; attempt++)
            woken = !wait_for(clocks[i], 50, &early) && early;
        assert_true(woken);
    }
}

static void longer_wait__until_its_time__times_out(void **state)
{
    bool early;
    (void)state;
    assert_int_equal(wait_for(CLOCK_MONOTONIC, 100, &early), ETIMEDOUT);
    assert_false(early);
    assert_int_equal(wait_for(CLOCK_REALTIME, 100, &early), ETIMEDOUT);
    assert_false(early);
}

static void short_wait__until_its_time__times_out(void **state)
{
    bool early;
    (void)state;
    assert_int_equal(wait_for(CLOCK_MONOTONIC, 1, &early), ETIMEDOUT);
    assert_false(early);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(povrays_wait_for_messages__wakes_before_its_time),
        cmocka_unit_test(longer_wait__until_its_time__times_out),
        cmocka_unit_test(short_wait__until_its_time__times_out),
    };
    return cmocka_run_group_tests(tests, open_object, close_object);
}
