/* The life of a child process: start, output, end, and nothing left behind. */
#include "child.h"

#include "io_support.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int open_files(void)
{
    int count = 0;
    for (int fd = 0; fd < 256; fd++)
        count += fcntl(fd, F_GETFD) >= 0;
    return count;
}

static void assert_no_child(void)
{
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

/* Starts a shell command in the scratch folder. */
static void start(struct child *child, const char *command)
{
    char *const argv[] = {"sh", "-c", (char *)(uintptr_t)command, NULL}, *const environment[] = {"COLOUR=blue", NULL};
    struct error err;
    bool missing = true;
    assert_ok(child_start(child, argv, scratch, environment, &missing, &err), err);
    assert_false(missing);
    assert_true(child->pid > 0);
}

/* All the child writes until end of file. */
static const char *output_of(const struct child *child)
{
    static char text[4096];
    size_t size = 0;
    for (ssize_t count = 1; count != 0;) {
        struct pollfd wait = {.fd = child->output_fd, .events = POLLIN};
        assert_int_equal(poll(&wait, 1, 10000), 1);
        count = read(child->output_fd, text + size, sizeof text - 1 - size);
        assert_true(count >= 0);
        size += (size_t)count;
    }
    text[size] = 0;
    return text;
}

static const char *output_of_command(const char *command, int expected_status)
{
    struct child child;
    start(&child, command);
    const char *text = output_of(&child);
    assert_int_equal(child_wait(&child), expected_status);
    assert_int_equal(child.pid, 0);
    assert_int_equal(child.output_fd, -1);
    return text;
}

static void start__shell_command__only_standard_error_comes(void **state)
{
    (void)state;
    int before = open_files();
    assert_string_equal(output_of_command("echo out; echo err >&2", 0), "err\n");
    assert_string_equal(output_of_command("[ /dev/fd/1 -ef /dev/null ] && echo thrown away >&2", 0), "thrown away\n");
    assert_int_equal(open_files(), before);
    assert_no_child();
}

static void start__directory_environment_and_input__as_told(void **state)
{
    (void)state;
    char expected[128];
    snprintf(expected, sizeof expected, "%s\n", scratch);
    assert_string_equal(output_of_command("pwd -P >&2", 0), expected);
    assert_string_equal(output_of_command("echo \"$COLOUR$HOME\" >&2", 0), "blue\n");
    assert_string_equal(output_of_command("cat >&2; echo end >&2", 0), "end\n");
}

static void start__second_child__inherits_no_file_of_the_first(void **state)
{
    (void)state;
    struct child first;
    char alone[4096];
    strcpy(alone, output_of_command("ls /proc/self/fd >&2", 0));
    start(&first, "exec sleep 30");
    assert_string_equal(output_of_command("ls /proc/self/fd >&2", 0), alone);
    child_kill((struct child *[]){&first}, 1);
    assert_no_child();
}

static void start__silent_child__reading_does_not_block(void **state)
{
    (void)state;
    struct child child;
    char byte;
    start(&child, "exec sleep 30");
    double begin = now_s();
    assert_int_equal(read(child.output_fd, &byte, 1), -1);
    assert_int_equal(errno, EAGAIN);
    assert_true(now_s() - begin < 5);
    child_kill((struct child *[]){&child}, 1);
}

static void wait__exit_statuses_and_signals__as_a_shell_says(void **state)
{
    (void)state;
    output_of_command("exit 0", 0);
    output_of_command("exit 1", 1);
    output_of_command("exit 255", 255);
    output_of_command("kill -TERM $$", 128 + SIGTERM);
    output_of_command("kill -KILL $$", 128 + SIGKILL);
}

static void ended__busy_child__its_processor_time(void **state)
{
    (void)state;
    struct child child;
    int status = -1;
    start(&child, "i=0; while [ $i -lt 30000 ]; do i=$((i + 1)); done");
    while (!child_has_ended(&child, &status))
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    assert_int_equal(status, 0);
    assert_true(child.cpu_s > 0.005 && child.cpu_s < 10);
}

static void assert_not_started(char *program, const char *directory, bool expected_missing, const char *reason)
{
    char *const argv[] = {program, NULL}, *const environment[] = {NULL};
    struct child child;
    struct error err;
    bool missing = !expected_missing;
    int before = open_files();
    assert_int_equal(child_start(&child, argv, directory, environment, &missing, &err), RESULT_POVRAY);
    assert_int_equal(missing, expected_missing);
    assert_int_equal(child.pid, 0);
    assert_contains(err.text, program);
    assert_contains(err.text, reason);
    assert_int_equal(open_files(), before);
    child_kill((struct child *[]){&child}, 1);
    assert_no_child();
}

static void start__no_such_program__missing(void **state)
{
    (void)state;
    assert_not_started("povgloss-no-such-program", scratch, true, strerror(ENOENT));
    assert_not_started("/nonexistent/povray", scratch, true, strerror(ENOENT));
}

static void start__not_executable__refused_but_not_missing(void **state)
{
    (void)state;
    write_bytes(in_scratch("plain"), "#!/bin/sh\n", 10);
    char path[256];
    strcpy(path, in_scratch("plain"));
    assert_not_started(path, scratch, false, strerror(EACCES));
    assert_not_started("/", scratch, false, strerror(EACCES));
}

static void kill__obedient_child__ends_at_once_and_is_reaped(void **state)
{
    (void)state;
    struct child child;
    int before = open_files();
    start(&child, "exec sleep 30");
    pid_t pid = child.pid;
    double begin = now_s();
    child_kill((struct child *[]){&child}, 1);
    assert_true(now_s() - begin < 1.9);
    assert_int_equal(child.pid, 0);
    assert_int_equal(child.output_fd, -1);
    assert_int_equal(kill(pid, 0), -1);
    assert_no_child();
    assert_int_equal(open_files(), before);
    child_kill((struct child *[]){&child}, 1);
}

static void kill__child_that_ignores_sigterm__killed_after_two_seconds(void **state)
{
    (void)state;
    struct child child;
    start(&child, "trap '' TERM; echo ready >&2; exec sleep 30");
    struct pollfd wait = {.fd = child.output_fd, .events = POLLIN};
    assert_int_equal(poll(&wait, 1, 10000), 1);
    pid_t pid = child.pid;
    double begin = now_s();
    child_kill((struct child *[]){&child}, 1);
    double duration = now_s() - begin;
    assert_true(duration > 1.5 && duration < 10);
    assert_int_equal(kill(pid, 0), -1);
    assert_no_child();
}

static void kill__child_that_has_ended__reaped(void **state)
{
    (void)state;
    struct child child;
    start(&child, "exit 7");
    output_of(&child);
    child_kill((struct child *[]){&child}, 1);
    assert_no_child();
}

static void kill__never_started__fine(void **state)
{
    (void)state;
    struct child child = {0}; /* output_fd 0 is not the child's */
    int before = open_files();
    child_kill((struct child *[]){&child}, 1);
    assert_int_equal(open_files(), before);
    assert_no_child();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(start__shell_command__only_standard_error_comes),
        cmocka_unit_test(start__directory_environment_and_input__as_told),
        cmocka_unit_test(start__second_child__inherits_no_file_of_the_first),
        cmocka_unit_test(start__silent_child__reading_does_not_block),
        cmocka_unit_test(wait__exit_statuses_and_signals__as_a_shell_says),
        cmocka_unit_test(ended__busy_child__its_processor_time),
        cmocka_unit_test(start__no_such_program__missing),
        cmocka_unit_test(start__not_executable__refused_but_not_missing),
        cmocka_unit_test(kill__obedient_child__ends_at_once_and_is_reaped),
        cmocka_unit_test(kill__child_that_ignores_sigterm__killed_after_two_seconds),
        cmocka_unit_test(kill__child_that_has_ended__reaped),
        cmocka_unit_test(kill__never_started__fine),
    };
    return cmocka_run_group_tests_name("child", tests, scratch_setup, scratch_teardown);
}
