/* Whole inputs in memory. A stream of unknown length is read into a buffer that doubles. */
#include "input_file.h"

#include "interrupt.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FIRST_CAPACITY = 1 << 16 };

const char *input_file_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "standard input" : path;
}

double input_memory_limit(void)
{
    return 0.5 * (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

/* The failure that errno tells of. */
static enum result failed(const char *name, const char *what, struct error *err)
{
    if (errno == EINTR && interrupt_signal())
        return error_set(err, RESULT_INTERRUPTED, "%s: interrupted", name);
    return error_set(err, RESULT_DATA, "%s: cannot be %s: %s", name, what, strerror(errno));
}

static enum result read_all(int fd, const char *name, struct input_file *file, struct error *err)
{
    double limit = input_memory_limit();
    struct stat status;
    size_t capacity = FIRST_CAPACITY;
    /* One byte more than a plain file's size: the read that finds its end then needs no larger buffer. */
    if (fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && (double)status.st_size <= limit)
        capacity = (size_t)status.st_size + 1;

    for (;;) {
        if (!file->data || file->size == capacity) {
            if (file->data)
                capacity *= 2;
            unsigned char *larger = realloc(file->data, capacity);
            if (!larger)
                return error_memory(err, (double)capacity);
            file->data = larger;
        }
        ssize_t got = read(fd, file->data + file->size, capacity - file->size);
        if (got == 0)
            return RESULT_OK;
        if (got < 0 && errno == EINTR && !interrupt_signal())
            continue;
        if (got < 0)
            return failed(name, "read", err);
        file->size += (size_t)got;
        if ((double)file->size > limit)
            return error_set(err, RESULT_DATA, "%s: larger than %.1f GB, half of this machine's memory", name,
                             limit / 1e9);
    }
}

enum result input_file_read(const char *path, struct input_file *file, struct error *err)
{
    *file = (struct input_file){0};
    const char *name = input_file_name(path);
    bool is_standard_input = strcmp(path, "-") == 0;
    int fd = is_standard_input ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (fd < 0)
        return failed(name, "opened", err);

    enum result result = isatty(fd)
                             ? error_set(err, RESULT_USAGE, "%s: is a terminal; name a file or pipe one in", name)
                             : read_all(fd, name, file, err);
    if (!is_standard_input)
        close(fd);
    if (result)
        input_file_free(file);
    return result;
}

void input_file_free(struct input_file *file)
{
    free(file->data);
    *file = (struct input_file){0};
}
