/* The handler only remembers the signal; long work looks at it, and the program ends by it. */
#include "interrupt.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>

/* Other threads than the one that the handler interrupts read it. Where ints are lock-free a handler may write it. */
static atomic_int caught;
_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "a handler may not write an atomic int");

static void remember(int signal_number)
{
    atomic_store(&caught, signal_number);
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
    int signal = atomic_load_explicit(&caught, memory_order_relaxed);
    return signal ? signal : stopped ? SIGTERM : 0;
}

void interrupt_reraise(void)
{
    int signal_number = interrupt_signal();
    if (!signal_number)
        return;
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}
