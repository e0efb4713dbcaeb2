/* Children by posix_spawn, which reports what exec failed with; their standard error is a pipe that doesn't block. */
#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum result child_start(struct child *child, char *const *argv, const char *directory, char *const *environment,
                        bool *missing, struct error *err)
{
    int ends[2];
    *child = (struct child){.output_fd = -1};
    *missing = false;
    if (pipe2(ends, O_CLOEXEC))
        return error_set(err, RESULT_DATA, "no pipe to %s: %s", argv[0], strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    int failure = posix_spawn_file_actions_addchdir_np(&actions, directory);
    if (!failure)
        failure = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!failure)
        failure = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (!failure)
        failure = posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    if (!failure)
        failure = posix_spawnp(&child->pid, argv[0], &actions, NULL, argv, environment);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (failure) {
        close(ends[0]);
        child->pid = 0;
        *missing = failure == ENOENT;
        return error_set(err, RESULT_POVRAY, "%s can't be started: %s", argv[0], strerror(failure));
    }
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    child->output_fd = ends[0];
    return RESULT_OK;
}

void child_close_output(struct child *child)
{
    if (child->output_fd >= 0)
        close(child->output_fd);
    child->output_fd = -1;
}

static int exit_status(int status)
{
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

int child_wait(struct child *child)
{
    int status = 0;
    while (waitpid(child->pid, &status, 0) < 0 && errno == EINTR)
        ;
    child->pid = 0;
    child_close_output(child);
    return exit_status(status);
}

bool child_has_ended(struct child *child, int *status)
{
    int ended = 0;
    struct rusage used = {0};
    if (wait4(child->pid, &ended, WNOHANG, &used) == 0)
        return false;
    child->pid = 0;
    child->cpu_s = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                   1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    child_close_output(child);
    *status = exit_status(ended);
    return true;
}

void child_kill(struct child *const *children, int count)
{
    int left = 0;
    for (int i = 0; i < count; i++)
        if (children[i]->pid > 0) {
            kill(children[i]->pid, SIGTERM);
            child_close_output(children[i]);
            left++;
        }
    for (int tenths = 0; left > 0 && tenths < 20; tenths++) {
        for (int i = 0; i < count; i++)
            if (children[i]->pid > 0 && waitpid(children[i]->pid, NULL, WNOHANG) != 0) {
                children[i]->pid = 0;
                left--;
            }
        if (left > 0)
            nanosleep(&(struct timespec){.tv_nsec = 100000000}, NULL);
    }
    for (int i = 0; i < count; i++)
        if (children[i]->pid > 0) {
            kill(children[i]->pid, SIGKILL);
            child_wait(children[i]);
        }
}
