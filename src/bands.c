/* Rows of an image shared out among threads: every thread takes the next band from a common counter until none is left
 * or a signal has come.
 */
#include "bands.h"

#include "cpu.h"
#include "interrupt.h"

#include <assert.h>
#include <pthread.h>
#include <stdatomic.h>

enum { THREADS_MAX = 256 };

struct bands {
    int rows, band_rows;
    bands_function function;
    void *context;
    atomic_int next;
};

static void *work(void *argument)
{
    struct bands *bands = argument;
    int count = (bands->rows + bands->band_rows - 1) / bands->band_rows;
    while (!interrupt_signal()) {
        int band = atomic_fetch_add(&bands->next, 1);
        if (band >= count)
            break;
        int first = band * bands->band_rows, end = first + bands->band_rows;
        bands->function(bands->context, first, end < bands->rows ? end : bands->rows);
    }
    return NULL;
}

enum result bands_run(int rows, int band_rows, int threads, bands_function function, void *context, struct error *err)
{
    assert(rows >= 0 && band_rows > 0 && threads >= 0);
    struct bands bands = {.rows = rows, .band_rows = band_rows, .function = function, .context = context};
    int bands_count = (rows + band_rows - 1) / band_rows;
    if (threads == 0)
        threads = cpu_count();
    if (threads > bands_count)
        threads = bands_count;
    if (threads > THREADS_MAX)
        threads = THREADS_MAX;
    pthread_t helpers[THREADS_MAX];
    int started = 0;
    while (started + 1 < threads && pthread_create(&helpers[started], NULL, work, &bands) == 0)
        started++;
    work(&bands);
    for (int i = 0; i < started; i++)
        pthread_join(helpers[i], NULL);
    if (interrupt_signal())
        return error_set(err, RESULT_INTERRUPTED, "stopped by a signal");
    return RESULT_OK;
}
