/* A buffer doubles when it grows and always ends with a NUL, so that it can be read as a string. */
#include "mem.h"

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum result buffer_add(struct buffer *buffer, const void *bytes, size_t size, struct error *err)
{
    if (buffer->size + size + 1 > buffer->capacity) {
        size_t capacity = (buffer->size + size + 1) * 2;
        char *data = realloc(buffer->data, capacity);
        if (!data)
            return error_memory(err, (double)capacity);
        buffer->data = data;
        buffer->capacity = capacity;
    }
    if (size)
        memcpy(buffer->data + buffer->size, bytes, size);
    buffer->size += size;
    buffer->data[buffer->size] = 0;
    return RESULT_OK;
}

enum result buffer_add_text(struct buffer *buffer, const char *text, struct error *err)
{
    return buffer_add(buffer, text, strlen(text), err);
}

enum result buffer_printf(struct buffer *buffer, struct error *err, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = NULL;
    int length = vasprintf(&text, format, args);
    va_end(args);
    if (length < 0)
        return error_memory(err, (double)strlen(format));
    enum result result = buffer_add(buffer, text, (size_t)length, err);
    free(text);
    return result;
}

void buffer_free(struct buffer *buffer)
{
    free(buffer->data);
    *buffer = (struct buffer){0};
}

enum result text_printf(char **text, struct error *err, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vasprintf(text, format, args);
    va_end(args);
    if (length >= 0)
        return RESULT_OK;
    *text = NULL;
    return error_memory(err, (double)strlen(format));
}

enum result text_list_add(struct text_list *list, struct error *err, const char *format, ...)
{
    char **texts = realloc(list->texts, ((size_t)list->count + 2) * sizeof *texts);
    if (!texts)
        return error_memory(err, ((double)list->count + 2) * sizeof *texts);
    list->texts = texts;
    va_list args;
    va_start(args, format);
    int length = vasprintf(&texts[list->count], format, args);
    va_end(args);
    if (length < 0) {
        texts[list->count] = NULL;
        return error_memory(err, (double)strlen(format));
    }
    texts[++list->count] = NULL;
    return RESULT_OK;
}

void text_list_free(struct text_list *list)
{
    for (int i = 0; i < list->count; i++)
        free(list->texts[i]);
    free(list->texts);
    *list = (struct text_list){0};
}

enum result memory_check(double bytes, struct error *err)
{
    char line[128];
    double kb, free_kb = 0;
    bool known = false;
    FILE *stream = fopen("/proc/meminfo", "re");
    while (stream && fgets(line, sizeof line, stream)) {
        if (sscanf(line, "MemAvailable: %lf", &kb) != 1 && sscanf(line, "SwapFree: %lf", &kb) != 1)
            continue;
        known |= line[0] == 'M';
        free_kb += kb;
    }
    if (stream)
        fclose(stream);
    if (!known || bytes <= 1024 * free_kb)
        return RESULT_OK;
    return error_set(err, RESULT_DATA, "out of memory: %.2g GB are needed, and %.2g GB are free; a smaller image needs less",
                     1e-9 * bytes, 1024e-9 * free_kb);
}

enum result file_write(const char *path, const struct buffer *buffer, struct error *err)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return error_set(err, RESULT_DATA, "%s: can't be written: %s", path, strerror(errno));
    int failed = buffer->size > 0 && fwrite(buffer->data, 1, buffer->size, file) != buffer->size;
    if (fclose(file) || failed)
        return error_set(err, RESULT_DATA, "%s: can't be written: %s", path, strerror(errno));
    return RESULT_OK;
}
