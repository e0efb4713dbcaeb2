/* Temporary folders by mkdtemp, removed by a walk that doesn't follow links and needs no memory: it is also the way out
 * when there is none. */
#include "work_folder.h"

#include "mem.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

static bool is_empty_folder(const char *path)
{
    DIR *folder = opendir(path);
    int entries = 0;
    while (folder && readdir(folder))
        entries++;
    if (folder)
        closedir(folder);
    return entries == 2; /* . and .. */
}

static enum result make_kept(struct work_folder *folder, const char *keep, struct error *err)
{
    if (mkdir(keep, 0777) && !(errno == EEXIST && is_empty_folder(keep)))
        return error_set(err, RESULT_DATA, "%s: can't be the folder to keep: %s; name a new or an empty one", keep,
                         strerror(errno == EEXIST ? ENOTEMPTY : errno));
    folder->path = realpath(keep, NULL);
    folder->keep = true;
    return folder->path ? RESULT_OK : error_set(err, RESULT_DATA, "%s: %s", keep, strerror(errno));
}

enum result work_folder_make(struct work_folder *folder, const char *keep, struct error *err)
{
    *folder = (struct work_folder){0};
    if (keep)
        return make_kept(folder, keep, err);
    const char *parent = getenv("TMPDIR");
    if (!parent || !*parent)
        parent = "/tmp";
    char *pattern;
    enum result result = text_printf(&pattern, err, "%s/povgloss-XXXXXX", parent);
    if (result)
        return result;
    if (mkdtemp(pattern)) {
        folder->path = realpath(pattern, NULL);
        if (!folder->path)
            rmdir(pattern);
    }
    if (!folder->path)
        result = error_set(err, RESULT_DATA, "%s: no temporary folder can be made there: %s; set TMPDIR to one that can be "
                           "written", parent, strerror(errno));
    free(pattern);
    return result;
}

static void remove_folder(int parent, const char *name);

/* Removes one entry after another. Reading a folder that changes may pass over some: then it begins again. */
static void remove_entries(int folder)
{
    _Alignas(struct dirent64) char block[4096];
    bool removed;
    do {
        ssize_t size;
        removed = false;
        while ((size = getdents64(folder, block, sizeof block)) > 0)
            for (ssize_t at = 0; at < size;) {
                const struct dirent64 *entry = (const void *)(block + at);
                at += entry->d_reclen;
                if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, ".."))
                    continue;
                if (unlinkat(folder, entry->d_name, 0) == 0)
                    removed = true;
                else if (errno == EISDIR)
                    remove_folder(folder, entry->d_name);
            }
    } while (removed && lseek(folder, 0, SEEK_SET) == 0);
}

static void remove_folder(int parent, const char *name)
{
    int folder = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder >= 0) {
        remove_entries(folder);
        close(folder);
    }
    unlinkat(parent, name, AT_REMOVEDIR);
}

enum result work_folder_remove(struct work_folder *folder, struct error *err)
{
    enum result result = RESULT_OK;
    if (folder->path && !folder->keep) {
        remove_folder(AT_FDCWD, folder->path);
        if (access(folder->path, F_OK) == 0)
            result = error_set(err, RESULT_DATA, "%s: the temporary folder can't be removed; remove it yourself",
                               folder->path);
    }
    free(folder->path);
    *folder = (struct work_folder){0};
    return result;
}

bool folder_is_full(const char *path)
{
    struct statvfs disk;
    return statvfs(path, &disk) == 0 && (double)disk.f_bavail * (double)disk.f_frsize < 1e6;
}

enum result work_folder_add(const struct work_folder *folder, const char *name, struct error *err)
{
    char *path;
    enum result result = text_printf(&path, err, "%s/%s", folder->path, name);
    if (result)
        return result;
    if (mkdir(path, 0777))
        result = error_set(err, RESULT_DATA, "%s: the folder can't be made: %s", path, strerror(errno));
    free(path);
    return result;
}

enum result work_folder_link(const struct work_folder *folder, const char *name, const char *target, struct error *err)
{
    char *path;
    enum result result = text_printf(&path, err, "%s/%s", folder->path, name);
    if (result)
        return result;
    if (symlink(target, path))
        result = error_set(err, RESULT_DATA, "%s: the link can't be made: %s", path, strerror(errno));
    free(path);
    return result;
}
