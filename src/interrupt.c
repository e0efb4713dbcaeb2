/* The handler only remembers the signal; long work looks at it, and the program ends by it. */
#include "interrupt.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>

static volatile sig_atomic_t caught;

static void remember(int signal_number)
{
    caught = signal_number;
}

void interrupt_install(void)
{
    struct sigaction action = {.sa_handler = remember};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
}

static atomic_bool stopped;

void interrupt_stop(bool stop)
{
    stopped = stop;
}

int interrupt_signal(void)
{
    int signal = caught;
    return signal ? signal : stopped ? SIGTERM : 0;
}

void interrupt_reraise(void)
{
    if (!caught)
        return;
    signal(caught, SIG_DFL);
    raise(caught);
}
