/* A part of the shared object that is loaded into POV-Ray by LD_PRELOAD: notes the files that are opened by fopen, the
 * one function by which POV-Ray opens files, and goes on as ever.
 *
 * Each entry of ../reads.log (reads.h), if that file is there, is `r` or `w` (for reading or writing), the name as it
 * was given, and NUL.
 */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

typedef FILE *open_function(const char *path, const char *mode);

FILE *fopen64(const char *restrict path, const char *restrict mode);

static int log_fd = -1;

__attribute__((constructor)) static void open_log(void)
{
    log_fd = open("../reads.log", O_WRONLY | O_APPEND | O_CLOEXEC);
}

/* One write for an entry: several processes share the log. */
static void note(FILE *file, const char *path, const char *mode)
{
    struct stat status;
    int saved_errno = errno;
    if (log_fd >= 0 && file && !fstat(fileno(file), &status) && S_ISREG(status.st_mode)) {
        struct iovec entry[] = {{(void *)(mode[0] == 'r' ? "r" : "w"), 1}, {(void *)path, strlen(path) + 1}};
        (void)!writev(log_fd, entry, 2);
    }
    errno = saved_errno;
}

static FILE *open_and_note(const char *function, const char *path, const char *mode)
{
    void *found = dlsym(RTLD_NEXT, function);
    open_function *next;
    memcpy(&next, &found, sizeof next);
    FILE *file = next(path, mode);
    note(file, path, mode);
    return file;
}

FILE *fopen(const char *restrict path, const char *restrict mode)
{
    return open_and_note("fopen", path, mode);
}

FILE *fopen64(const char *restrict path, const char *restrict mode)
{
    return open_and_note("fopen64", path, mode);
}
