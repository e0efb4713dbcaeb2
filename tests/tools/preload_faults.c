/* Loaded into a program by LD_PRELOAD: makes one of its calls fail.
 *
 *   FAULT=memory:17   the 17th call of this kind (below) fails; "memory:17+": all from the 17th on
 *   FAULT=space:4000  write() and fwrite() take 4000 bytes in all, then the disk is full
 *   FAULT_LOG=FILE    is made when a call was made to fail; its content is the number of calls of the kind so far
 *
 * With FAULT=memory:0 nothing fails, and the log tells the number of calls (or bytes) at the end. The program's own children are
 * left alone. Calls inside of the C library aren't seen, but for its allocations.
 */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum kind { MEMORY, READ, WRITE, CLOSE, RENAME, OPEN, FOLDER, REMOVE, PIPE, SPAWN, THREAD, WAIT, SPACE, KIND_COUNT };

static const struct {
    const char *name;
    int reason;
} kinds[KIND_COUNT] = {
    [MEMORY] = {"memory", ENOMEM}, /* malloc, calloc, realloc, aligned_alloc, posix_memalign */
    [READ] = {"read", EIO},
    [WRITE] = {"write", ENOSPC},   /* also fwrite, fputs, fflush */
    [CLOSE] = {"close", EIO},      /* also fclose; what is closed is closed all the same */
    [RENAME] = {"rename", EACCES},
    [OPEN] = {"open", EMFILE},     /* also openat, fopen, opendir */
    [FOLDER] = {"folder", ENOSPC}, /* mkdir, mkdtemp, symlink, realpath */
    [REMOVE] = {"remove", EACCES}, /* unlink, unlinkat, rmdir, remove */
    [PIPE] = {"pipe", EMFILE},
    [SPAWN] = {"spawn", EAGAIN},
    [THREAD] = {"thread", EAGAIN}, /* pthread_create */
    [WAIT] = {"wait", ENOMEM},     /* poll */
    [SPACE] = {"space", ENOSPC},
};

static enum kind chosen = KIND_COUNT;
static long number;
static bool all_after, failed;
static atomic_long calls;
static char log_path[4096];

/* By system calls: nothing of this may fail by itself. */
static void write_log(void)
{
    char text[24];
    long left = calls;
    size_t begin = sizeof text;
    text[--begin] = '\n';
    do
        text[--begin] = (char)('0' + left % 10);
    while (left /= 10);
    int fd = (int)syscall(SYS_openat, AT_FDCWD, log_path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    syscall(SYS_write, fd, text + begin, sizeof text - begin);
    syscall(SYS_close, fd);
}

__attribute__((constructor)) static void begin(void)
{
    const char *fault = getenv("FAULT"), *log = getenv("FAULT_LOG");
    const char *colon = fault ? strchr(fault, ':') : NULL;
    if (!colon || !log || strlen(log) >= sizeof log_path)
        return;
    strcpy(log_path, log);
    number = atol(colon + 1);
    all_after = strchr(colon, '+');
    unsetenv("LD_PRELOAD");
    for (int i = 0; i < KIND_COUNT; i++)
        if (!strncmp(kinds[i].name, fault, (size_t)(colon - fault)) && !kinds[i].name[colon - fault])
            chosen = (enum kind)i;
}

__attribute__((destructor)) static void end(void)
{
    if (chosen != KIND_COUNT && number == 0)
        write_log();
    chosen = KIND_COUNT;
}

/* Counts a call; true when it shall fail, errno being set. */
static bool fails(enum kind kind)
{
    if (kind != chosen)
        return false;
    long call = ++calls;
    if (number == 0 || call < number || (call > number && !all_after))
        return false;
    if (!failed)
        write_log();
    failed = true;
    errno = kinds[kind].reason;
    return true;
}

/* How many of `size` bytes there is still space for; -1 and errno: of none. */
static ssize_t space_for(size_t size)
{
    if (chosen != SPACE)
        return (ssize_t)size;
    long before = atomic_fetch_add(&calls, (long)size);
    if (number == 0 || before + (long)size <= number)
        return (ssize_t)size;
    if (!failed)
        write_log();
    failed = true;
    errno = ENOSPC;
    return before < number ? number - before : -1;
}

/* The call that this one stands in front of. */
#define NEXT(name)                                                                                                     \
    static __typeof__(name) *next;                                                                                     \
    if (!next)                                                                                                         \
        *(void **)&next = dlsym(RTLD_NEXT, #name)

/* ---- memory: dlsym may ask for some itself, and gets it from here; it is never freed ---- */

static char early[1 << 16];
static size_t early_size;
static _Thread_local bool resolving;

static void *early_alloc(size_t size)
{
    size_t begin = (early_size + 15) / 16 * 16;
    early_size = begin + size;
    return early_size <= sizeof early ? early + begin : NULL;
}

static bool is_early(const void *block)
{
    return (uintptr_t)block >= (uintptr_t)early && (uintptr_t)block < (uintptr_t)early + sizeof early;
}

#define NEXT_ALLOCATOR(name)                                                                                           \
    static __typeof__(name) *next;                                                                                     \
    if (!next) {                                                                                                       \
        resolving = true;                                                                                              \
        *(void **)&next = dlsym(RTLD_NEXT, #name);                                                                     \
        resolving = false;                                                                                             \
    }

void *malloc(size_t size)
{
    if (resolving)
        return early_alloc(size);
    NEXT_ALLOCATOR(malloc)
    return fails(MEMORY) ? NULL : next(size);
}

void *calloc(size_t count, size_t size)
{
    if (resolving)
        return early_alloc(count * size);
    NEXT_ALLOCATOR(calloc)
    return fails(MEMORY) ? NULL : next(count, size);
}

void *realloc(void *block, size_t size)
{
    NEXT_ALLOCATOR(realloc)
    return fails(MEMORY) ? NULL : next(block, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    NEXT_ALLOCATOR(aligned_alloc)
    return fails(MEMORY) ? NULL : next(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size)
{
    NEXT_ALLOCATOR(posix_memalign)
    return fails(MEMORY) ? ENOMEM : next(block, alignment, size);
}

void free(void *block)
{
    NEXT_ALLOCATOR(free)
    if (!is_early(block))
        next(block);
}

/* ---- files ---- */

ssize_t read(int fd, void *buffer, size_t size)
{
    NEXT(read);
    return fails(READ) ? -1 : next(fd, buffer, size);
}

ssize_t write(int fd, const void *buffer, size_t size)
{
    NEXT(write);
    if (fails(WRITE))
        return -1;
    ssize_t space = fd == STDERR_FILENO ? (ssize_t)size : space_for(size);
    return space < 0 ? -1 : next(fd, buffer, (size_t)space);
}

size_t fwrite(const void *buffer, size_t size, size_t count, FILE *file)
{
    NEXT(fwrite);
    if (file == stderr)
        return next(buffer, size, count, file);
    return fails(WRITE) || space_for(size * count) < (ssize_t)(size * count) ? 0 : next(buffer, size, count, file);
}

int fputs(const char *text, FILE *file)
{
    NEXT(fputs);
    return file != stderr && (fails(WRITE) || space_for(strlen(text)) < (ssize_t)strlen(text)) ? EOF : next(text, file);
}

int fflush(FILE *file)
{
    NEXT(fflush);
    return file != stderr && fails(WRITE) ? EOF : next(file);
}

int close(int fd)
{
    NEXT(close);
    bool fail = fails(CLOSE);
    int reason = errno, result = next(fd);
    errno = fail ? reason : errno;
    return fail ? -1 : result;
}

int fclose(FILE *file)
{
    NEXT(fclose);
    bool fail = fails(CLOSE);
    int reason = errno, result = next(file);
    errno = fail ? reason : errno;
    return fail ? EOF : result;
}

int rename(const char *from, const char *to)
{
    NEXT(rename);
    return fails(RENAME) ? -1 : next(from, to);
}

static mode_t mode_of(int flags, va_list args)
{
    return flags & (O_CREAT | O_TMPFILE) ? va_arg(args, mode_t) : 0;
}

int open(const char *path, int flags, ...)
{
    NEXT(open);
    va_list args;
    va_start(args, flags);
    mode_t mode = mode_of(flags, args);
    va_end(args);
    return fails(OPEN) ? -1 : next(path, flags, mode);
}

int openat(int folder, const char *path, int flags, ...)
{
    NEXT(openat);
    va_list args;
    va_start(args, flags);
    mode_t mode = mode_of(flags, args);
    va_end(args);
    return fails(OPEN) ? -1 : next(folder, path, flags, mode);
}

FILE *fopen(const char *path, const char *mode)
{
    NEXT(fopen);
    return fails(OPEN) ? NULL : next(path, mode);
}

struct __dirstream *opendir(const char *path);
struct __dirstream *opendir(const char *path)
{
    NEXT(opendir);
    return fails(OPEN) ? NULL : next(path);
}

int mkdir(const char *path, mode_t mode)
{
    NEXT(mkdir);
    return fails(FOLDER) ? -1 : next(path, mode);
}

char *mkdtemp(char *pattern)
{
    NEXT(mkdtemp);
    return fails(FOLDER) ? NULL : next(pattern);
}

int symlink(const char *target, const char *path)
{
    NEXT(symlink);
    return fails(FOLDER) ? -1 : next(target, path);
}

char *realpath(const char *path, char *resolved)
{
    NEXT(realpath);
    return fails(FOLDER) ? NULL : next(path, resolved);
}

int unlink(const char *path)
{
    NEXT(unlink);
    return fails(REMOVE) ? -1 : next(path);
}

int unlinkat(int folder, const char *path, int flags)
{
    NEXT(unlinkat);
    return fails(REMOVE) ? -1 : next(folder, path, flags);
}

int rmdir(const char *path)
{
    NEXT(rmdir);
    return fails(REMOVE) ? -1 : next(path);
}

int remove(const char *path)
{
    NEXT(remove);
    return fails(REMOVE) ? -1 : next(path);
}

/* ---- processes and threads ---- */

int pipe2(int ends[2], int flags)
{
    NEXT(pipe2);
    return fails(PIPE) ? -1 : next(ends, flags);
}

int posix_spawnp(pid_t *pid, const char *file, const posix_spawn_file_actions_t *actions,
                 const posix_spawnattr_t *attributes, char *const *argv, char *const *environment)
{
    NEXT(posix_spawnp);
    return fails(SPAWN) ? EAGAIN : next(pid, file, actions, attributes, argv, environment);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument)
{
    NEXT(pthread_create);
    return fails(THREAD) ? EAGAIN : next(thread, attributes, start, argument);
}

int poll(struct pollfd *polls, nfds_t count, int timeout)
{
    NEXT(poll);
    return fails(WAIT) ? -1 : next(polls, count, timeout);
}
