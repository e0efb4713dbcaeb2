/* Output that appears whole or not at all.
 *
 * The bytes go to a hidden temporary file beside the target, which rename() puts in the target's place: a reader sees
 * the old file or the new one. Renaming over a device or a pipe would replace it by a plain file, so those are opened
 * as they are.
 */
#include "output_file.h"

#include "interrupt.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAX_LINKS = 40, MAX_NAMES_TRIED = 100 };

const char *output_file_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "standard output" : path;
}

/* Replaces a symbolic link by what it points to, which need not exist yet. 0 or an errno. */
static int follow_links(char target[PATH_MAX])
{
    for (int links = 0; links < MAX_LINKS; links++) {
        char link[PATH_MAX];
        ssize_t length = readlink(target, link, sizeof link);
        if (length < 0)
            return 0;
        char *slash = strrchr(target, '/');
        size_t folder = link[0] != '/' && slash ? (size_t)(slash - target) + 1 : 0;
        if (folder + (size_t)length >= PATH_MAX)
            return ENAMETOOLONG;
        memcpy(target + folder, link, (size_t)length);
        target[folder + (size_t)length] = '\0';
    }
    return ELOOP;
}

static enum result folder_error(const struct output_file *file, int reason, struct error *err)
{
    const char *slash = strrchr(file->target, '/');
    int length = slash == file->target ? 1 : (int)(slash - file->target);
    const char *cure = reason == ENOENT   ? "create the folder first (mkdir -p)"
                       : reason == ENOSPC ? "free some space or write elsewhere"
                                          : "write to a folder in which you may create files";
    return error_set(err, RESULT_DATA, "%s: cannot create a file in the folder %.*s: %s; %s",
                     output_file_name(file->path), slash ? length : 1, slash ? file->target : ".", strerror(reason),
                     cure);
}

/* Creates the temporary file: open() and not mkstemp(), so that the umask and the folder's ACLs count. */
static enum result open_temporary(struct output_file *file, struct error *err)
{
    const char *slash = strrchr(file->target, '/');
    int folder = slash ? (int)(slash - file->target) + 1 : 0;
    for (int tried = 0; tried < MAX_NAMES_TRIED; tried++) {
        unsigned long long random = 0;
        if (getrandom(&random, sizeof random, 0) != (ssize_t)sizeof random)
            random = (unsigned long long)getpid() * MAX_NAMES_TRIED + (unsigned)tried;
        int length = snprintf(file->temporary, sizeof file->temporary, "%.*s.povgloss-%016llx", folder, file->target,
                              random);
        if (length >= (int)sizeof file->temporary)
            return folder_error(file, ENAMETOOLONG, err);
        file->fd = open(file->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file->fd >= 0)
            return RESULT_OK;
        if (errno != EEXIST)
            break;
    }
    return folder_error(file, errno, err);
}

/* The failure that errno tells of. */
static enum result failed(const struct output_file *file, const char *what, struct error *err)
{
    int reason = errno;
    const char *name = output_file_name(file->path);
    if (reason == EINTR && interrupt_signal())
        return error_set(err, RESULT_INTERRUPTED, "%s: interrupted", name);
    return error_set(err, RESULT_DATA, "%s: cannot be %s: %s%s", name, what, strerror(reason),
                     reason == ENOSPC && !file->direct ? "; free some space or write elsewhere" : "");
}

enum result output_file_open(struct output_file *file, const char *path, struct error *err)
{
    file->path = path;
    file->fd = -1;
    file->direct = false;
    if (strlen(path) >= sizeof file->target)
        return error_set(err, RESULT_DATA, "%s: %s", path, strerror(ENAMETOOLONG));
    strcpy(file->target, path);

    struct stat there, standard_output;
    bool exists = stat(path, &there) == 0;
    bool is_standard_output = strcmp(path, "-") == 0 ||
                              (exists && fstat(STDOUT_FILENO, &standard_output) == 0 &&
                               there.st_dev == standard_output.st_dev && there.st_ino == standard_output.st_ino);
    if (is_standard_output || (exists && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode))) {
        file->direct = true;
        file->fd = is_standard_output ? fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
                                      : open(path, O_WRONLY | O_CLOEXEC | O_NOCTTY);
        if (file->fd < 0)
            return failed(file, "opened for writing", err);
        if (isatty(file->fd)) {
            output_file_abort(file);
            return error_set(err, RESULT_USAGE,
                             "%s: is a terminal, and an image is binary; redirect it to a file or a pipe",
                             output_file_name(path));
        }
        return RESULT_OK;
    }

    if (exists && S_ISDIR(there.st_mode))
        return error_set(err, RESULT_DATA, "%s: is a folder; add a file name", path);
    if (exists && faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) != 0)
        return failed(file, "opened for writing", err);
    int reason = follow_links(file->target);
    if (reason)
        return error_set(err, RESULT_DATA, "%s: %s", path, strerror(reason));
    enum result result = open_temporary(file, err);
    if (result)
        return result;
    if (exists && fchmod(file->fd, there.st_mode & 0777) != 0) {
        result = failed(file, "given its permissions", err);
        output_file_abort(file);
    }
    return result;
}

enum result output_file_write(struct output_file *file, const void *data, size_t size, struct error *err)
{
    assert(file->fd >= 0);
    const char *next = data;
    while (size > 0) {
        ssize_t written = write(file->fd, next, size);
        if (written < 0 && errno == EINTR && !interrupt_signal())
            continue;
        if (written < 0)
            return failed(file, "written", err);
        next += written;
        size -= (size_t)written;
    }
    return RESULT_OK;
}

enum result output_file_commit(struct output_file *file, struct error *err)
{
    assert(file->fd >= 0);
    int closed = close(file->fd);
    file->fd = -1;
    if (closed == 0 && (file->direct || rename(file->temporary, file->target) == 0))
        return RESULT_OK;
    enum result result = failed(file, "written", err);
    if (!file->direct)
        unlink(file->temporary);
    return result;
}

void output_file_abort(struct output_file *file)
{
    if (file->fd < 0)
        return;
    close(file->fd);
    file->fd = -1;
    if (!file->direct)
        unlink(file->temporary);
}
