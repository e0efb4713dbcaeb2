/* Output files: whole or not at all, permissions, links, devices and pipes. */
#include "output_file.h"

#include "io_support.h"

#include <errno.h>
#include <fcntl.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

static enum result write_text(const char *path, const char *text, struct error *err)
{
    struct output_file file;
    enum result result = output_file_open(&file, path, err);
    if (!result)
        result = output_file_write(&file, text, strlen(text), err);
    if (!result)
        result = output_file_commit(&file, err);
    output_file_abort(&file);
    return result;
}

static void assert_content(const char *path, const char *text)
{
    size_t size;
    unsigned char *data = read_bytes(path, &size);
    data[size] = '\0';
    assert_string_equal((char *)data, text);
    free(data);
}

static unsigned mode_of(const char *path)
{
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    return status.st_mode & 0777;
}

static void open__new_file__appears_at_commit(void **state)
{
    (void)state;
    struct output_file file;
    struct error err;
    const char *path = in_scratch("new");
    assert_ok(output_file_open(&file, path, &err), err);
    assert_ok(output_file_write(&file, "abc", 3, &err), err);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(scratch_entries(), 1);
    assert_ok(output_file_commit(&file, &err), err);
    assert_content(path, "abc");
    assert_int_equal(scratch_entries(), 1);
    unlink(path);
}

static void open__existing_file__old_content_until_commit(void **state)
{
    (void)state;
    struct output_file file;
    struct error err;
    const char *path = in_scratch("old");
    write_bytes(path, "old", 3);
    assert_ok(output_file_open(&file, path, &err), err);
    assert_ok(output_file_write(&file, "new", 3, &err), err);
    assert_content(path, "old");
    assert_ok(output_file_commit(&file, &err), err);
    assert_content(path, "new");
    unlink(path);
}

static void abort__after_write__target_untouched_and_nothing_left(void **state)
{
    (void)state;
    struct output_file file;
    struct error err;
    const char *path = in_scratch("kept");
    write_bytes(path, "old", 3);
    assert_ok(output_file_open(&file, path, &err), err);
    assert_ok(output_file_write(&file, "new", 3, &err), err);
    assert_int_equal(scratch_entries(), 2);
    output_file_abort(&file);
    output_file_abort(&file);
    assert_int_equal(scratch_entries(), 1);
    assert_content(path, "old");
    unlink(path);
}

static void open__temporary_file__is_hidden_and_in_the_same_folder(void **state)
{
    (void)state;
    struct output_file file;
    struct error err;
    assert_ok(output_file_open(&file, in_scratch("x"), &err), err);
    assert_int_equal(strncmp(file.temporary, scratch, strlen(scratch)), 0);
    assert_int_equal(file.temporary[strlen(scratch) + 1], '.');
    assert_int_equal(fcntl(file.fd, F_GETFD) & FD_CLOEXEC, FD_CLOEXEC);
    output_file_abort(&file);
    assert_int_equal(scratch_entries(), 0);
}

static void open__new_file__permissions_by_umask(void **state)
{
    (void)state;
    static const mode_t masks[] = {0022, 0077, 0002, 0};
    struct error err;
    const char *path = in_scratch("mode");
    for (size_t i = 0; i < sizeof masks / sizeof masks[0]; i++) {
        mode_t before = umask(masks[i]);
        enum result result = write_text(path, "x", &err);
        umask(before);
        assert_ok(result, err);
        assert_int_equal(mode_of(path), 0666 & ~masks[i]);
        unlink(path);
    }
}

static void open__existing_file__keeps_its_permissions(void **state)
{
    (void)state;
    struct error err;
    const char *path = in_scratch("mode");
    write_bytes(path, "old", 3);
    assert_int_equal(chmod(path, 0640), 0);
    assert_ok(write_text(path, "new", &err), err);
    assert_int_equal(mode_of(path), 0640);
    unlink(path);
}

static void open__symbolic_link__link_stays_and_its_target_is_written(void **state)
{
    (void)state;
    struct error err;
    struct stat status;
    char target[256], link[256];
    strcpy(target, in_scratch("folder/target"));
    strcpy(link, in_scratch("link"));
    assert_int_equal(mkdir(in_scratch("folder"), 0777), 0);
    static const bool exists[] = {true, false};
    static const char *const contents[] = {"folder/target", NULL};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            if (exists[i])
                write_bytes(target, "old", 3);
            assert_int_equal(symlink(contents[j] ? contents[j] : target, in_scratch("second")), 0);
            assert_int_equal(symlink("second", link), 0);
            assert_ok(write_text(link, "new", &err), err);
            assert_int_equal(lstat(link, &status), 0);
            assert_true(S_ISLNK(status.st_mode));
            assert_int_equal(lstat(target, &status), 0);
            assert_true(S_ISREG(status.st_mode));
            assert_content(target, "new");
            unlink(target);
            unlink(link);
            unlink(in_scratch("second"));
        }
    rmdir(in_scratch("folder"));
    assert_int_equal(scratch_entries(), 0);
}

static void open__link_to_itself__refused(void **state)
{
    (void)state;
    struct error err;
    const char *path = in_scratch("loop");
    assert_int_equal(symlink("loop", path), 0);
    assert_int_equal(write_text(path, "x", &err), RESULT_DATA);
    assert_contains(err.text, strerror(ELOOP));
    unlink(path);
}

static void open__missing_folder__names_folder_and_cure(void **state)
{
    (void)state;
    struct error err;
    const char *path = in_scratch("missing/out.exr");
    assert_int_equal(write_text(path, "x", &err), RESULT_DATA);
    assert_contains(err.text, path);
    assert_contains(err.text, "/missing: No such file or directory");
    assert_contains(err.text, "mkdir -p");
}

static void open__folder_without_write_permission__refused(void **state)
{
    (void)state;
    struct error err;
    const char *folder = geteuid() == 0 ? "/proc" : "/";
    char path[64];
    snprintf(path, sizeof path, "%s/povgloss-test", folder);
    assert_int_equal(write_text(path, "x", &err), RESULT_DATA);
    assert_contains(err.text, path);
}

static void open__folder_or_overlong_name__refused(void **state)
{
    (void)state;
    struct error err;
    assert_int_equal(write_text(scratch, "x", &err), RESULT_DATA);
    assert_contains(err.text, "is a folder");
    char longest[2 * PATH_MAX];
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    assert_int_equal(write_text(longest, "x", &err), RESULT_DATA);
    longest[300] = '\0'; /* longer than a file's name may be, shorter than a path */
    int here = open(".", O_RDONLY | O_DIRECTORY);
    assert_int_equal(chdir(scratch), 0);
    enum result result = write_text(longest, "x", &err);
    assert_int_equal(fchdir(here), 0);
    close(here);
    assert_int_equal(result, RESULT_DATA);
    assert_int_equal(scratch_entries(), 0);
}

static void open__longest_name__written(void **state)
{
    (void)state;
    struct error err;
    char name[NAME_MAX + 1];
    memset(name, 'n', NAME_MAX);
    name[NAME_MAX] = '\0';
    char path[512];
    snprintf(path, sizeof path, "%s/%s", scratch, name);
    assert_ok(write_text(path, "x", &err), err);
    assert_content(path, "x");
    unlink(path);
}

static void write__full_device__fails_and_device_stays(void **state)
{
    (void)state;
    struct error err;
    struct stat status;
    const char *device = full_device();
    assert_int_equal(write_text(device, "x", &err), RESULT_DATA);
    assert_contains(err.text, device);
    assert_contains(err.text, ": cannot be written: No space left on device");
    assert_int_equal(stat(device, &status), 0);
    assert_true(S_ISCHR(status.st_mode));
    if (geteuid() == 0)
        unlink(device);
}

static void write__beyond_file_size_limit__target_untouched_and_nothing_left(void **state)
{
    (void)state;
    const char *path = in_scratch("limited");
    write_bytes(path, "old", 3);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        struct error err;
        struct rlimit limit = {4, 4};
        signal(SIGXFSZ, SIG_IGN);
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0)
            _exit(99);
        enum result result = write_text(path, "longer than that", &err);
        _exit(strstr(err.text, "File too large") ? (int)result : 98);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), RESULT_DATA);
    assert_content(path, "old");
    assert_int_equal(scratch_entries(), 1);
    unlink(path);
}

static void write__fifo__reader_gets_all_and_fifo_stays(void **state)
{
    (void)state;
    struct error err;
    struct stat status;
    const char *path = in_scratch("fifo");
    assert_int_equal(mkfifo(path, 0600), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        FILE *reader = fopen(path, "rb");
        size_t count = 0;
        while (fgetc(reader) != EOF)
            count++;
        _exit(count == 300000 ? 0 : 1);
    }
    char *data = malloc(300000);
    assert_non_null(data);
    memset(data, 'f', 300000);
    struct output_file file;
    assert_ok(output_file_open(&file, path, &err), err);
    assert_ok(output_file_write(&file, data, 300000, &err), err);
    assert_ok(output_file_commit(&file, &err), err);
    free(data);
    int exit_status;
    assert_int_equal(waitpid(child, &exit_status, 0), child);
    assert_int_equal(exit_status, 0);
    assert_int_equal(lstat(path, &status), 0);
    assert_true(S_ISFIFO(status.st_mode));
    unlink(path);
}

/* Runs write_text(name) with standard output on the file `path`, or on a terminal if that is NULL. */
static int write_with_standard_output(const char *name, const char *path)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        struct error err;
        int controller, terminal;
        if (path)
            terminal = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
        else if (openpty(&controller, &terminal, NULL, NULL, NULL) != 0)
            _exit(99);
        if (dup2(terminal, STDOUT_FILENO) < 0)
            _exit(99);
        _exit((int)write_text(name, "to standard output", &err));
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void open__standard_output__written_in_place(void **state)
{
    (void)state;
    static const char *const names[] = {"-", "/dev/stdout", "/dev/fd/1"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const char *path = in_scratch("redirected");
        write_bytes(path, "old", 3);
        struct stat before, after;
        assert_int_equal(stat(path, &before), 0);
        assert_int_equal(write_with_standard_output(names[i], path), RESULT_OK);
        assert_int_equal(stat(path, &after), 0);
        assert_true(before.st_ino == after.st_ino);
        assert_content(path, "to standard output");
        unlink(path);
    }
    const char *device = full_device();
    assert_int_equal(write_with_standard_output("-", device), RESULT_DATA);
    if (geteuid() == 0)
        unlink(device);
}

static void open__terminal__refused(void **state)
{
    (void)state;
    assert_int_equal(write_with_standard_output("-", NULL), RESULT_USAGE);
    assert_int_equal(write_with_standard_output("/dev/stdout", NULL), RESULT_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(open__new_file__appears_at_commit),
        cmocka_unit_test(open__existing_file__old_content_until_commit),
        cmocka_unit_test(abort__after_write__target_untouched_and_nothing_left),
        cmocka_unit_test(open__temporary_file__is_hidden_and_in_the_same_folder),
        cmocka_unit_test(open__new_file__permissions_by_umask),
        cmocka_unit_test(open__existing_file__keeps_its_permissions),
        cmocka_unit_test(open__symbolic_link__link_stays_and_its_target_is_written),
        cmocka_unit_test(open__link_to_itself__refused),
        cmocka_unit_test(open__missing_folder__names_folder_and_cure),
        cmocka_unit_test(open__folder_without_write_permission__refused),
        cmocka_unit_test(open__folder_or_overlong_name__refused),
        cmocka_unit_test(open__longest_name__written),
        cmocka_unit_test(write__full_device__fails_and_device_stays),
        cmocka_unit_test(write__beyond_file_size_limit__target_untouched_and_nothing_left),
        cmocka_unit_test(write__fifo__reader_gets_all_and_fifo_stays),
        cmocka_unit_test(open__standard_output__written_in_place),
        cmocka_unit_test(open__terminal__refused),
    };
    return cmocka_run_group_tests_name("output_file", tests, scratch_setup, scratch_teardown);
}
