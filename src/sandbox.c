/* bwrap's options, and a run of `true` under them: where user namespaces are forbidden it fails before any work. */
#include "sandbox.h"

#include "povray.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum result program_find(const char *name, char **path, struct error *err)
{
    const bool is_path = strchr(name, '/');
    const char *at = is_path ? "" : getenv("PATH");
    enum result result = RESULT_OK;
    *path = NULL;
    while (!result && !*path && at) {
        size_t length = strcspn(at, ":");
        char *candidate;
        result = text_printf(&candidate, err, "%.*s%s%s", (int)length, at, length ? "/" : "", name);
        errno = 0;
        if (!result && (is_path || !access(candidate, X_OK)))
            *path = realpath(candidate, NULL);
        if (!result && errno == ENOMEM)
            result = error_memory(err, 0);
        free(candidate);
        at = at[length] ? at + length + 1 : NULL;
    }
    return result;
}

static enum result add(struct text_list *arguments, const char *option, const char *path, struct error *err)
{
    enum result result = text_list_add(arguments, err, "%s", option);
    for (int i = 0; !result && i < 2; i++)
        result = text_list_add(arguments, err, "%s", path);
    return result;
}

/* The real path of a folder, or of the folder that a file is in. */
static enum result add_real(struct text_list *arguments, const char *option, const char *path, bool is_file,
                            struct error *err)
{
    char *real = realpath(path, NULL), *slash = real ? strrchr(real, '/') : NULL;
    if (!real)
        return error_set(err, RESULT_DATA, "%s: %s", path, strerror(errno));
    if (is_file)
        slash[slash == real] = 0;
    enum result result = add(arguments, option, real, err);
    free(real);
    return result;
}

static enum result try_it(const char *work_folder, struct text_list *arguments, struct error *err)
{
    struct text_list trial = {0};
    int failed;
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < arguments->count; i++)
        result = text_list_add(&trial, err, "%s", arguments->texts[i]);
    if (!result)
        result = text_list_add(&trial, err, "true");
    struct povray_job job = {.name = "sandbox", .folder = work_folder, .arguments = trial.texts, .timeout_s = 20};
    if (!result)
        result = povray_run(&job, 1, 1, environ, NULL, NULL, &failed, err);
    if (result == RESULT_POVRAY && failed >= 0) {
        const char *said = job.messages.data ? job.messages.data : "";
        result = error_set(err, RESULT_POVRAY,
                           "bwrap can't make a sandbox here, as user namespaces may be forbidden: allow them, or render "
                           "without --sandbox what you trust; it says: %.*s", (int)strcspn(said, "\n"), said);
    }
    povray_jobs_free(&job, 1);
    text_list_free(&trial);
    return result;
}

enum result sandbox_begin(const char *work_folder, const struct text_list *folders, const char *const *files,
                          int file_count, struct text_list *arguments, struct error *err)
{
    static const char *const first[] = {"--unshare-all", "--die-with-parent", "--new-session"};
    static const char *const system[] = {"/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/opt", "/nix", "/gnu",
                                         "/etc/povray", "/etc/alternatives", "/etc/ld.so.cache"};
    char *bwrap;
    enum result result = program_find("bwrap", &bwrap, err);
    if (!result && !bwrap)
        return error_set(err, RESULT_POVRAY, "bwrap isn't in PATH: --sandbox needs bubblewrap (on Debian: apt-get "
                                             "install bubblewrap)");
    if (!result)
        result = text_list_add(arguments, err, "%s", bwrap);
    for (size_t i = 0; !result && i < sizeof first / sizeof *first; i++)
        result = text_list_add(arguments, err, "%s", first[i]);
    for (int i = 0; !result && i < folders->count; i++)
        result = add_real(arguments, "--ro-bind", folders->texts[i], false, err);
    for (int i = 0; !result && i < file_count; i++)
        if (files[i])
            result = add_real(arguments, "--ro-bind", files[i], true, err);
    for (size_t i = 0; !result && i < sizeof system / sizeof *system; i++)
        result = add(arguments, "--ro-bind-try", system[i], err);
    static const char *const devices[] = {"--dev", "/dev", "--dir", "/tmp"};
    for (size_t i = 0; !result && i < sizeof devices / sizeof *devices; i++)
        result = text_list_add(arguments, err, "%s", devices[i]);
    if (!result)
        result = add_real(arguments, "--bind", work_folder, false, err);
    free(bwrap);
    /* What an ended bwrap leaves becomes a child of this process. */
    if (!result)
        prctl(PR_SET_CHILD_SUBREAPER, 1);
    return result ? result : try_it(work_folder, arguments, err);
}

/* A bwrap that is killed before it has set up its inner process leaves that waiting for ever. */
static void kill_orphans(void)
{
    DIR *folder = opendir("/proc");
    for (const struct dirent *entry; folder && (entry = readdir(folder));) {
        char path[300], name[32];
        int pid, parent;
        snprintf(path, sizeof path, "/proc/%s/stat", entry->d_name);
        FILE *stream = entry->d_name[0] >= '1' && entry->d_name[0] <= '9' ? fopen(path, "r") : NULL;
        if (!stream)
            continue;
        if (fscanf(stream, "%d (%31[^)]) %*c %d", &pid, name, &parent) == 3 && parent == getpid() && !strcmp(name, "bwrap"))
            kill(pid, SIGKILL);
        fclose(stream);
    }
    if (folder)
        closedir(folder);
}

void sandbox_end(void)
{
    for (int tenths = 0; tenths < 50; tenths++) {
        pid_t ended;
        do
            ended = waitpid(-1, NULL, WNOHANG);
        while (ended > 0);
        if (ended < 0)
            return;
        kill_orphans();
        nanosleep(&(struct timespec){.tv_nsec = 100000000}, NULL);
    }
}
