/* The temporary folder and the kept one. */
#include "work_folder.h"

#include "io_support.h"

#include <errno.h>
#include <limits.h>

static void use_scratch_for_temporaries(void)
{
    assert_int_equal(setenv("TMPDIR", scratch, 1), 0);
}

static bool is_folder(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static void make__temporary__absolute_private_and_new(void **state)
{
    (void)state;
    struct work_folder one, two;
    struct error err;
    struct stat status;
    use_scratch_for_temporaries();
    assert_ok(work_folder_make(&one, NULL, &err), err);
    assert_ok(work_folder_make(&two, NULL, &err), err);
    assert_string_not_equal(one.path, two.path);
    assert_int_equal(one.path[0], '/');
    assert_memory_equal(one.path, scratch, strlen(scratch));
    assert_int_equal(stat(one.path, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0700);
    assert_int_equal(scratch_entries(), 2);
    assert_ok(work_folder_remove(&one, &err), err);
    assert_ok(work_folder_remove(&two, &err), err);
    assert_null(one.path);
    assert_int_equal(scratch_entries(), 0);
}

static void make__no_or_empty_tmpdir__in_tmp(void **state)
{
    (void)state;
    struct work_folder folder;
    struct error err;
    for (int empty = 0; empty < 2; empty++) {
        if (empty)
            setenv("TMPDIR", "", 1);
        else
            unsetenv("TMPDIR");
        assert_ok(work_folder_make(&folder, NULL, &err), err);
        char *tmp = realpath("/tmp", NULL);
        assert_memory_equal(folder.path, tmp, strlen(tmp));
        free(tmp);
        assert_ok(work_folder_remove(&folder, &err), err);
    }
}

static void make__relative_tmpdir__absolute_path(void **state)
{
    (void)state;
    struct work_folder folder;
    struct error err;
    char *here = getcwd(NULL, 0);
    assert_non_null(here);
    assert_int_equal(chdir(scratch), 0);
    setenv("TMPDIR", ".", 1);
    enum result result = work_folder_make(&folder, NULL, &err);
    assert_int_equal(chdir(here), 0);
    free(here);
    assert_ok(result, err);
    assert_memory_equal(folder.path, scratch, strlen(scratch));
    assert_ok(work_folder_remove(&folder, &err), err);
    assert_int_equal(scratch_entries(), 0);
}

static void make__missing_tmpdir__named_with_the_cure(void **state)
{
    (void)state;
    struct work_folder folder;
    struct error err;
    setenv("TMPDIR", in_scratch("missing"), 1);
    assert_int_equal(work_folder_make(&folder, NULL, &err), RESULT_DATA);
    assert_contains(err.text, in_scratch("missing"));
    assert_contains(err.text, "TMPDIR");
    assert_contains(err.text, strerror(ENOENT));
    assert_null(folder.path);
    assert_ok(work_folder_remove(&folder, &err), err);
}

static void remove__deep_content__all_gone_but_link_targets(void **state)
{
    (void)state;
    struct work_folder folder;
    struct error err;
    char path[PATH_MAX];
    use_scratch_for_temporaries();
    assert_int_equal(mkdir(in_scratch("outside"), 0777), 0);
    write_bytes(in_scratch("outside/file"), "x", 1);
    assert_ok(work_folder_make(&folder, NULL, &err), err);
    assert_ok(work_folder_add(&folder, "a", &err), err);
    assert_ok(work_folder_add(&folder, "a/b", &err), err);
    snprintf(path, sizeof path, "%s/a/b/.hidden", folder.path);
    write_bytes(path, "x", 1);
    assert_ok(work_folder_link(&folder, "lib0", in_scratch("outside"), &err), err);
    assert_ok(work_folder_link(&folder, "a/dangling", "/nonexistent", &err), err);
    assert_ok(work_folder_remove(&folder, &err), err);
    assert_int_equal(scratch_entries(), 1);
    assert_int_equal(access(in_scratch("outside/file"), F_OK), 0);
    assert_int_equal(unlink(in_scratch("outside/file")), 0);
    assert_int_equal(rmdir(in_scratch("outside")), 0);
}

static void remove__no_folder__nothing_happens(void **state)
{
    (void)state;
    struct work_folder folder = {0};
    struct error err;
    assert_ok(work_folder_remove(&folder, &err), err);
    assert_ok(work_folder_remove(&folder, &err), err);
    assert_null(folder.path);
}

static void keep__new_or_empty_folder__stays_after_remove(void **state)
{
    (void)state;
    for (int exists = 0; exists < 2; exists++) {
        struct work_folder folder;
        struct error err;
        if (exists)
            assert_int_equal(mkdir(in_scratch("kept"), 0777), 0);
        assert_ok(work_folder_make(&folder, in_scratch("kept"), &err), err);
        assert_string_equal(folder.path, in_scratch("kept"));
        assert_ok(work_folder_add(&folder, "base", &err), err);
        assert_ok(work_folder_remove(&folder, &err), err);
        assert_null(folder.path);
        assert_true(is_folder(in_scratch("kept/base")));
        assert_int_equal(rmdir(in_scratch("kept/base")), 0);
        assert_int_equal(rmdir(in_scratch("kept")), 0);
    }
}

static void keep__folder_with_a_file__refused_and_untouched(void **state)
{
    (void)state;
    struct work_folder folder;
    struct error err;
    assert_int_equal(mkdir(in_scratch("full-folder"), 0777), 0);
    write_bytes(in_scratch("full-folder/file"), "x", 1);
    assert_int_equal(work_folder_make(&folder, in_scratch("full-folder"), &err), RESULT_DATA);
    assert_contains(err.text, in_scratch("full-folder"));
    assert_contains(err.text, strerror(ENOTEMPTY));
    assert_ok(work_folder_remove(&folder, &err), err);
    assert_int_equal(access(in_scratch("full-folder/file"), F_OK), 0);
    unlink(in_scratch("full-folder/file"));
    rmdir(in_scratch("full-folder"));
}

static void keep__a_file_or_a_missing_parent__refused(void **state)
{
    (void)state;
    struct work_folder folder;
    struct error err;
    write_bytes(in_scratch("file"), "x", 1);
    assert_int_equal(work_folder_make(&folder, in_scratch("file"), &err), RESULT_DATA);
    assert_contains(err.text, strerror(ENOTDIR));
    assert_null(folder.path);
    assert_int_equal(access(in_scratch("file"), F_OK), 0);
    unlink(in_scratch("file"));
    assert_int_equal(work_folder_make(&folder, in_scratch("missing/kept"), &err), RESULT_DATA);
    assert_contains(err.text, in_scratch("missing/kept"));
    assert_null(folder.path);
    assert_int_equal(work_folder_make(&folder, "", &err), RESULT_DATA);
    assert_null(folder.path);
}

static void add_and_link__name_taken__refused_with_the_path(void **state)
{
    (void)state;
    struct work_folder folder;
    struct error err;
    char target[PATH_MAX], path[PATH_MAX];
    use_scratch_for_temporaries();
    assert_ok(work_folder_make(&folder, NULL, &err), err);
    assert_ok(work_folder_add(&folder, "base", &err), err);
    assert_int_equal(work_folder_add(&folder, "base", &err), RESULT_DATA);
    assert_contains(err.text, folder.path);
    assert_contains(err.text, strerror(EEXIST));
    assert_int_equal(work_folder_link(&folder, "base", "/", &err), RESULT_DATA);
    assert_contains(err.text, strerror(EEXIST));
    assert_ok(work_folder_link(&folder, "lib0", "/some/where with = and \"", &err), err);
    snprintf(path, sizeof path, "%s/lib0", folder.path);
    ssize_t length = readlink(path, target, sizeof target - 1);
    assert_true(length > 0);
    target[length] = 0;
    assert_string_equal(target, "/some/where with = and \"");
    assert_ok(work_folder_remove(&folder, &err), err);
    assert_int_equal(scratch_entries(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(make__temporary__absolute_private_and_new),
        cmocka_unit_test(make__no_or_empty_tmpdir__in_tmp),
        cmocka_unit_test(make__relative_tmpdir__absolute_path),
        cmocka_unit_test(make__missing_tmpdir__named_with_the_cure),
        cmocka_unit_test(remove__deep_content__all_gone_but_link_targets),
        cmocka_unit_test(remove__no_folder__nothing_happens),
        cmocka_unit_test(keep__new_or_empty_folder__stays_after_remove),
        cmocka_unit_test(keep__folder_with_a_file__refused_and_untouched),
        cmocka_unit_test(keep__a_file_or_a_missing_parent__refused),
        cmocka_unit_test(add_and_link__name_taken__refused_with_the_path),
    };
    return cmocka_run_group_tests_name("work_folder", tests, scratch_setup, scratch_teardown);
}
