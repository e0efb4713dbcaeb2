/* Messages are formatted into the caller's struct error; nothing is printed here. */
#include "error.h"

#include <stdarg.h>
#include <stdio.h>

enum result error_set(struct error *err, enum result result, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(err->text, sizeof err->text, format, args);
    va_end(args);
    return result;
}

enum result error_memory(struct error *err, double bytes)
{
    if (bytes > 0)
        return error_set(err, RESULT_DATA, "out of memory: %.0f bytes were asked for; a smaller image needs less", bytes);
    return error_set(err, RESULT_DATA, "out of memory; a smaller image needs less");
}
