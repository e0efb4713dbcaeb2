/* What the fuzz targets share. Each is one function for libFuzzer (`make fuzz`) or for replay.c (`make check`). */
#ifndef POVGLOSS_FUZZ_SUPPORT_H
#define POVGLOSS_FUZZ_SUPPORT_H

#include <ftw.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define FUZZ_REQUIRE(condition)                                                                    \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: not true: %s\n", __FILE__, __LINE__, #condition);              \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

/* Replaces the content of the file behind `fd` and begins at its start. */
__attribute__((unused)) static void fuzz_fill(int fd, const void *data, size_t size)
{
    FUZZ_REQUIRE(!ftruncate(fd, 0) && pwrite(fd, data, size, 0) == (ssize_t)size && !lseek(fd, 0, SEEK_SET));
}

/* The path of a file in memory that holds the input; the same file for every input. */
__attribute__((unused)) static const char *fuzz_file(const uint8_t *data, size_t size)
{
    static int fd = -1;
    static char path[32];
    if (fd < 0) {
        FUZZ_REQUIRE((fd = memfd_create("input", 0)) >= 0);
        snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
    }
    fuzz_fill(fd, data, size);
    return path;
}

static char fuzz_scratch[64];

static int fuzz_remove(const char *path, const struct stat *status, int type, struct FTW *walk)
{
    (void)status, (void)type, (void)walk;
    return remove(path);
}

static void fuzz_remove_scratch(void)
{
    nftw(fuzz_scratch, fuzz_remove, 8, FTW_DEPTH | FTW_PHYS);
}

/* A new folder in memory, which goes with the process. */
__attribute__((unused)) static const char *fuzz_folder(void)
{
    if (!*fuzz_scratch) {
        strcpy(fuzz_scratch, "/dev/shm/povgloss-fuzz-XXXXXX");
        FUZZ_REQUIRE(mkdtemp(fuzz_scratch));
        atexit(fuzz_remove_scratch);
    }
    return fuzz_scratch;
}

/* The input up to its next NUL, as a part of its own; *data moves past it. */
struct fuzz_part {
    const char *text;
    size_t size;
};

__attribute__((unused)) static struct fuzz_part fuzz_part(const uint8_t **data, size_t *size)
{
    const uint8_t *end = *size ? memchr(*data, 0, *size) : NULL;
    struct fuzz_part part = {(const char *)*data, end ? (size_t)(end - *data) : *size};
    size_t taken = part.size + !!end;
    *data += taken;
    *size -= taken;
    return part;
}

#endif
