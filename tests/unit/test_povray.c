/* Several POV-Rays at a time, played by shell scripts, and real messages of POV-Ray 3.7.0.10. */
#include "povray.h"

#include "interrupt.h"
#include "io_support.h"

#include <errno.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>

enum { MAX_JOBS = 40 };

/* Jobs that run shell scripts. */
struct jobs {
    struct povray_job jobs[MAX_JOBS];
    char *arguments[MAX_JOBS][5];
    char numbers[MAX_JOBS][12];
    int count;
};

static void add_job(struct jobs *jobs, const char *script)
{
    int n = jobs->count++;
    snprintf(jobs->numbers[n], sizeof jobs->numbers[n], "%d", n);
    jobs->arguments[n][0] = "sh";
    jobs->arguments[n][1] = "-c";
    jobs->arguments[n][2] = (char *)(uintptr_t)script;
    jobs->arguments[n][3] = "povray";
    jobs->arguments[n][4] = NULL;
    jobs->jobs[n] = (struct povray_job){.name = jobs->numbers[n], .folder = scratch, .arguments = jobs->arguments[n]};
}

struct progress {
    double values[10000];
    int count;
};

static void note_progress(void *context, double done)
{
    struct progress *progress = context;
    if (progress->count < 10000)
        progress->values[progress->count++] = done;
}

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Processes whose image is there may be left. */
static enum result deliver(struct jobs *jobs, int at_once, struct progress *progress, int *failed, struct error *err)
{
    char path[512];
    snprintf(path, sizeof path, "PATH=%s", getenv("PATH"));
    char *environment[] = {path, NULL};
    progress->count = 0;
    return povray_run(jobs->jobs, jobs->count, at_once, environment, note_progress, progress, failed, err);
}

static enum result run_jobs(struct jobs *jobs, int at_once, struct progress *progress, int *failed, struct error *err)
{
    enum result result = deliver(jobs, at_once, progress, failed, err);
    /* No process is left in any case. */
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
    return result;
}

static void run__all_succeed__finished_with_their_messages(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed = 5;
    for (int i = 0; i < 20; i++)
        add_job(&jobs, i % 2 ? "echo odd >&2" : "printf even >&2; echo unseen");
    assert_ok(run_jobs(&jobs, 20, &progress, &failed, &err), err);
    assert_int_equal(failed, -1);
    for (int i = 0; i < 20; i++) {
        assert_true(jobs.jobs[i].finished);
        assert_string_equal(jobs.jobs[i].messages.data, i % 2 ? "odd\n" : "even");
    }
    assert_near(progress.values[progress.count - 1], 1, 1e-12);
    povray_jobs_free(jobs.jobs, 20);
    assert_null(jobs.jobs[0].messages.data);
}

static enum result count_ended(void *context, struct error *err)
{
    (void)err;
    ++*(int *)context;
    return RESULT_OK;
}

/* The first process ends when the second one has run, which may start only when the first has done its work. */
static void run__image_closed__done_before_the_process_ends(void **state)
{
    (void)state;
    struct jobs jobs = {.count = 0};
    static struct progress progress;
    struct error err;
    int failed, ended = 0;
    add_job(&jobs, "touch other.ppm; echo > image.ppm; while [ ! -e go ]; do sleep 0.02; done");
    add_job(&jobs, "echo > image2.ppm; while [ ! -e go ]; do sleep 0.02; done");
    jobs.jobs[0].image = "image.ppm";
    jobs.jobs[1].image = "image2.ppm";
    for (int i = 0; i < 2; i++) {
        jobs.jobs[i].ended = count_ended;
        jobs.jobs[i].context = &ended;
    }
    assert_ok(deliver(&jobs, 1, &progress, &failed, &err), err);
    assert_int_equal(failed, -1);
    assert_int_equal(ended, 2);
    for (int i = 0; i < 2; i++)
        assert_true(jobs.jobs[i].delivered && !jobs.jobs[i].finished);
    write_bytes(in_scratch("go"), "", 0);
    assert_ok(povray_end(jobs.jobs, 2, &failed, &err), err);
    assert_int_equal(failed, -1);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(ended, 2);
    assert_true(jobs.jobs[0].finished && jobs.jobs[1].finished);
    povray_jobs_free(jobs.jobs, 2);
    unlink(in_scratch("go"));
}

static void end__failed_after_its_image__told(void **state)
{
    (void)state;
    struct jobs jobs = {.count = 0};
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "echo > image.ppm; exec sleep 300");
    add_job(&jobs, "echo > image2.ppm; while [ ! -e go ]; do sleep 0.02; done; echo why >&2; exit 3");
    jobs.jobs[0].image = "image.ppm";
    jobs.jobs[1].image = "image2.ppm";
    assert_ok(deliver(&jobs, 2, &progress, &failed, &err), err);
    write_bytes(in_scratch("go"), "", 0);
    assert_int_equal(povray_end(jobs.jobs, 2, &failed, &err), RESULT_POVRAY);
    assert_non_null(strstr(err.text, "exit status 3"));
    assert_int_equal(failed, 1);
    assert_string_equal(jobs.jobs[1].messages.data, "why\n");
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    povray_jobs_free(jobs.jobs, 2);
    unlink(in_scratch("go"));
}

static void run__another_or_an_empty_file_closed__the_exit_status_counts(void **state)
{
    (void)state;
    struct jobs jobs = {.count = 0};
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "echo > image.pov-state; rm -f image.ppm; : > image.ppm; sleep 0.2; exit 3");
    jobs.jobs[0].image = "image.ppm";
    assert_int_equal(run_jobs(&jobs, 1, &progress, &failed, &err), RESULT_POVRAY);
    assert_non_null(strstr(err.text, "exit status 3"));
    assert_int_equal(failed, 0);
    povray_jobs_free(jobs.jobs, 1);
}

static void run__at_once__never_more(void **state)
{
    (void)state;
    /* Each job waits until as many run as may, or 5 s. */
    static const char script[] = "mkdir running.$$; i=0\n"
                                 "while [ ! -e reached ] && [ $i -lt 250 ]; do\n"
                                 "  if [ $(ls -d running.* | wc -l) -ge $(cat limit) ]; then touch reached; fi\n"
                                 "  sleep 0.02; i=$((i + 1))\n"
                                 "done\n"
                                 "ls -d running.* | wc -l >> counts; rmdir running.$$";
    static const int limits[] = {1, 3};
    for (int i = 0; i < 2; i++) {
        struct jobs *jobs = calloc(1, sizeof *jobs);
        static struct progress progress;
        struct error err;
        int failed, most = 0, count, lines = 0;
        assert_non_null(jobs);
        write_bytes(in_scratch("limit"), limits[i] == 1 ? "1" : "3", 1);
        for (int n = 0; n < 7; n++)
            add_job(jobs, script);
        assert_ok(run_jobs(jobs, limits[i], &progress, &failed, &err), err);
        FILE *file = fopen(in_scratch("counts"), "r");
        assert_non_null(file);
        for (; fscanf(file, "%d", &count) == 1; lines++)
            most = count > most ? count : most;
        fclose(file);
        assert_int_equal(lines, 7);
        assert_true(most >= 1 && most <= limits[i]);
        unlink(in_scratch("counts"));
        assert_int_equal(unlink(in_scratch("reached")), 0);
        povray_jobs_free(jobs->jobs, jobs->count);
        free(jobs);
    }
}

static void run__one_at_a_time__in_their_order(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    static const char *const scripts[] = {"echo a >> order", "echo b >> order", "echo c >> order", "echo d >> order"};
    for (int i = 0; i < 4; i++)
        add_job(&jobs, scripts[i]);
    assert_ok(run_jobs(&jobs, 1, &progress, &failed, &err), err);
    assert_string_equal(run("cat order"), "a\nb\nc\nd\n");
    unlink(in_scratch("order"));
    povray_jobs_free(jobs.jobs, jobs.count);
}

struct chain {
    struct jobs jobs;
    int calls;
};

static enum result replace_script(void *context, struct error *err)
{
    static char script[] = "echo replaced >> order";
    struct chain *chain = context;
    (void)err;
    chain->calls++;
    assert_true(chain->jobs.jobs[2].finished && !chain->jobs.jobs[0].started);
    chain->jobs.arguments[0][2] = script;
    chain->jobs.jobs[0].held = false;
    return RESULT_OK;
}

static void run__a_held_job__starts_when_it_is_let_go(void **state)
{
    (void)state;
    static struct chain chain;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&chain.jobs, "echo first >> order");
    add_job(&chain.jobs, "exit 0");
    add_job(&chain.jobs, "sleep 0.2; echo third >> order");
    chain.jobs.jobs[0].held = true;
    chain.jobs.jobs[2].ended = replace_script;
    chain.jobs.jobs[2].context = &chain;
    assert_ok(run_jobs(&chain.jobs, 3, &progress, &failed, &err), err);
    assert_int_equal(chain.calls, 1);
    assert_string_equal(run("cat order"), "third\nreplaced\n");
    unlink(in_scratch("order"));
    povray_jobs_free(chain.jobs.jobs, chain.jobs.count);
}

static enum result drop_first(void *context, struct error *err)
{
    struct chain *chain = context;
    (void)err;
    chain->jobs.jobs[0].dropped = true;
    return RESULT_OK;
}

static void run__a_held_job_that_is_dropped__ends_without_it(void **state)
{
    (void)state;
    static struct chain chain;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&chain.jobs, "echo first >> order");
    add_job(&chain.jobs, "echo second >> order");
    chain.jobs.jobs[0].held = true;
    chain.jobs.jobs[1].ended = drop_first;
    chain.jobs.jobs[1].context = &chain;
    assert_ok(run_jobs(&chain.jobs, 2, &progress, &failed, &err), err);
    assert_false(chain.jobs.jobs[0].started);
    assert_string_equal(run("cat order"), "second\n");
    unlink(in_scratch("order"));
    povray_jobs_free(chain.jobs.jobs, chain.jobs.count);
}

static enum result refuse(void *context, struct error *err)
{
    (void)context;
    return error_set(err, RESULT_DATA, "refused");
}

static void run__refused_after_a_job__the_others_are_ended(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "exec sleep 30");
    add_job(&jobs, "exit 0");
    jobs.jobs[1].ended = refuse;
    assert_int_equal(run_jobs(&jobs, 2, &progress, &failed, &err), RESULT_DATA);
    assert_string_equal(err.text, "refused");
    assert_int_equal(failed, -1);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    povray_jobs_free(jobs.jobs, jobs.count);
}

static bool was_reported(const struct progress *progress, double done)
{
    for (int i = 0; i < progress->count; i++)
        if (fabs(progress->values[i] - done) < 1e-9)
            return true;
    return false;
}

static void run__progress_lines__fractions_of_all_jobs(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "printf 'Rendered 250 of 1000 pixels (25%%)\\r' >&2; sleep 0.3;"
                   "printf 'Rendered 500 of 1000 pixels (50%%)\\rRendered 750 of 1000 pixels (75%%)\\r' >&2; sleep 0.3");
    add_job(&jobs, "printf '==== [Rendering...]\\nRendered 0 of 10 pixels (0%%)\\r' >&2; sleep 0.8");
    assert_ok(run_jobs(&jobs, 2, &progress, &failed, &err), err);
    assert_true(was_reported(&progress, 0.99 * 0.25 / 2));
    assert_true(was_reported(&progress, 0.99 * 0.75 / 2));
    assert_true(was_reported(&progress, 0.5));
    for (int i = 1; i < progress.count; i++)
        assert_true(progress.values[i] >= progress.values[i - 1]);
    assert_near(progress.values[progress.count - 1], 1, 1e-12);
    povray_jobs_free(jobs.jobs, jobs.count);
}

static void run__progress_line_in_two_pieces__not_misread(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "printf 'Rendered 50 of 100 pixels (50%%)\\rRendered 60 of 1' >&2; sleep 0.3;"
                   "printf '00 pixels (60%%)\\r' >&2; sleep 0.3");
    assert_ok(run_jobs(&jobs, 1, &progress, &failed, &err), err);
    assert_true(was_reported(&progress, 0.99 * 0.6));
    for (int i = 0; i < progress.count; i++)
        assert_true(progress.values[i] <= 1);
    povray_jobs_free(jobs.jobs, jobs.count);
}

static void run__one_fails__others_ended_and_its_messages_kept(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "exec sleep 30");
    add_job(&jobs, "echo fine >&2");
    add_job(&jobs, "sleep 0.2; echo broken >&2; exit 3");
    add_job(&jobs, "exec sleep 30");
    add_job(&jobs, "touch started-too-late");
    jobs.jobs[2].name = "endpoint";
    double begin = now_s();
    assert_int_equal(run_jobs(&jobs, 3, &progress, &failed, &err), RESULT_POVRAY);
    assert_true(now_s() - begin < 5);
    assert_int_equal(failed, 2);
    assert_contains(err.text, "exit status 3");
    assert_contains(err.text, "endpoint pass");
    assert_string_equal(jobs.jobs[2].messages.data, "broken\n");
    assert_int_not_equal(access(in_scratch("started-too-late"), F_OK), 0);
    povray_jobs_free(jobs.jobs, jobs.count);
}

static void run__killed_by_a_signal__status_as_a_shell_says(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "kill -KILL $$");
    assert_int_equal(run_jobs(&jobs, 1, &progress, &failed, &err), RESULT_POVRAY);
    assert_int_equal(failed, 0);
    assert_contains(err.text, "137");
    povray_jobs_free(jobs.jobs, jobs.count);
}

static void run__no_such_program__cure_named(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "exec sleep 30");
    add_job(&jobs, "");
    jobs.arguments[1][0] = "povgloss-no-such-povray";
    double begin = now_s();
    assert_int_equal(run_jobs(&jobs, 2, &progress, &failed, &err), RESULT_POVRAY);
    assert_true(now_s() - begin < 5);
    assert_int_equal(failed, -1);
    assert_contains(err.text, "povgloss-no-such-povray");
    assert_contains(err.text, "apt-get install povray");
    povray_jobs_free(jobs.jobs, jobs.count);
}

static void run__one_fails_another_ignores_sigterm__killed(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "trap '' TERM; touch ready; exec sleep 30");
    add_job(&jobs, "while [ ! -e ready ]; do sleep 0.02; done; exit 1");
    double begin = now_s();
    assert_int_equal(run_jobs(&jobs, 2, &progress, &failed, &err), RESULT_POVRAY);
    assert_true(now_s() - begin < 10);
    assert_int_equal(failed, 1);
    unlink(in_scratch("ready"));
    povray_jobs_free(jobs.jobs, jobs.count);
}

static void run__endless_messages__bounded(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    struct error err;
    int failed;
    add_job(&jobs, "head -c 6000000 /dev/zero >&2");
    assert_ok(run_jobs(&jobs, 1, &progress, &failed, &err), err);
    assert_true(jobs.jobs[0].messages.size >= 1 << 20 && jobs.jobs[0].messages.size < 6000000);
    assert_int_equal(strlen(jobs.jobs[0].messages.data), jobs.jobs[0].messages.size); /* NUL bytes became spaces */
    povray_jobs_free(jobs.jobs, jobs.count);
}

static void run__signal__interrupted_and_all_ended(void **state)
{
    (void)state;
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        static struct jobs jobs;
        static struct progress progress;
        struct error err;
        int failed;
        interrupt_install();
        add_job(&jobs, "exec sleep 30");
        add_job(&jobs, "kill -TERM $PPID; exec sleep 30");
        enum result result = run_jobs(&jobs, 2, &progress, &failed, &err);
        povray_jobs_free(jobs.jobs, jobs.count);
        _exit(failed == -1 ? (int)result : 99);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), RESULT_INTERRUPTED);
}

/* ---- messages ---- */

/* What precedes every message, abridged. */
#define BANNER                                                                                                         \
    "povray: cannot open the user configuration file /root/.povray/3.7/povray.conf: No such file or directory\n"        \
    "POV-Ray 3.7.0.10.unofficial\n\n"                                                                                  \
    "This is an unofficial version compiled by:\n Peter Mueller <pm@debian.org> for Debian <www.debian.org>\n\n"        \
    "Parser Options\n  Input file: pass.pov\n  Remove bounds........On \n  Library paths:\n    ../copies\n"            \
    "    /home/user/mirrors\n    /usr/share/povray-3.7/include\n"                                                      \
    "Information Output Options\n  All Streams to console..........On \n  Fatal Stream to console.........On \n"       \
    "  Warning Stream to console.......On \n"                                                                          \
    "==== [Parsing...] ==========================================================\n"
#define ENDING "Fatal error in parser: Cannot parse input.\nRender failed\n\n"

static void assert_error_text(const char *messages, const char *expected)
{
    struct buffer from = {0}, text = {0};
    struct error err;
    assert_ok(buffer_add_text(&from, messages, &err), err);
    assert_ok(povray_error_text(&from, &text, &err), err);
    assert_string_equal(text.data ? text.data : "", expected);
    buffer_free(&from);
    buffer_free(&text);
}

static void error_text__parse_error__wrapped_lines_joined(void **state)
{
    (void)state;
    assert_error_text(BANNER "File 'a.pov' line 3: Parse Error: No matching } in 'sphere', undeclared\n"
                             " identifier 'pigmnt' found instead\n" ENDING,
                      "File 'a.pov' line 3: Parse Error: No matching } in 'sphere', undeclared identifier 'pigmnt' found "
                      "instead");
}

static void error_text__missing_include__both_messages(void **state)
{
    (void)state;
    assert_error_text(BANNER "File 'b.pov' line 3: Possible Parse Error: Cannot find file 'nothere.inc', even\n"
                             " after trying to append file type extension.\n"
                             "File 'b.pov' line 3: Parse Error: Cannot open include file nothere.inc.\n" ENDING,
                      "File 'b.pov' line 3: Possible Parse Error: Cannot find file 'nothere.inc', even after trying to "
                      "append file type extension.\n"
                      "File 'b.pov' line 3: Parse Error: Cannot open include file nothere.inc.");
}

static void error_text__error_directive__the_users_text(void **state)
{
    (void)state;
    assert_error_text(BANNER "File 'c.pov' line 3: Parse Error: Parse halted by #error directive:\n"
                             " Gloss(-1.000000): a Phong exponent is 0 or more \n" ENDING,
                      "File 'c.pov' line 3: Parse Error: Parse halted by #error directive: Gloss(-1.000000): a Phong "
                      "exponent is 0 or more ");
}

static void error_text__warnings__left_out(void **state)
{
    (void)state;
    assert_error_text(BANNER "File 'e.pov' line 3: Parse Warning: Should have at least 2 objects in csg.\n"
                             "File 'e.pov' line 3: Parse Error: No matching } in 'union', End of File found\n"
                             " instead\n" ENDING,
                      "File 'e.pov' line 3: Parse Error: No matching } in 'union', End of File found instead");
}

/* "mirror" ends like "error". */
static void error_text__warning_in_a_mirror_copy__left_out(void **state)
{
    (void)state;
    assert_error_text(BANNER "File 'mirror2-000-a.pov' line 2: Parse Warning: careful\n"
                             "File 'mirror2-000-a.pov' line 3: Parse Error: Illegal radius.\n" ENDING,
                      "File 'mirror2-000-a.pov' line 3: Parse Error: Illegal radius.");
}

static void error_text__bad_switch__what_povray_says(void **state)
{
    (void)state;
    assert_error_text("povray: cannot open the user configuration file /x/povray.conf: No such file or directory\n\n"
                      "Problem with option setting\npovray +Iok.pov +W8 +H8 -D +Zfoo\nFailed to parse command-line option\n",
                      "Problem with option setting\nFailed to parse command-line option");
}

static void error_text__progress_ended_by_carriage_returns__left_out(void **state)
{
    (void)state;
    assert_error_text(BANNER "Rendered 1024 of 4096 pixels (25%)\rRendered 2048 of 4096 pixels (50%)\r"
                             "Fatal error in renderer: Out of memory.\r\n further\rRender failed\n",
                      "Fatal error in renderer: Out of memory. further");
}

static void error_text__no_error_among_them__last_line(void **state)
{
    (void)state;
    struct buffer none = {0}, text = {0};
    struct error err;
    assert_ok(povray_error_text(&none, &text, &err), err);
    assert_int_equal(text.size, 0);
    assert_error_text("", "");
    assert_error_text("\n\n\r\n", "");
    assert_error_text("Rendered 4096 of 4096 pixels (100%)\rPOV-Ray finished\n", "");
    assert_error_text(BANNER "==== [Rendering...] ====\nRendered 4096 of 4096 pixels (100%)\rPOV-Ray finished\n",
                      "==== [Rendering...] ====");
}

/* A broken scene through the real program: the switches are those of the passes. */
static void error_text__real_povray__file_line_and_word(void **state)
{
    (void)state;
    static struct jobs jobs;
    static struct progress progress;
    static const char scene[] = "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#warning \"careful\"\n"
                                "sphere { 0, 1\n  pigmnt { rgb 1 } }\n";
    struct error err;
    struct buffer text = {0};
    int failed;
    write_bytes(in_scratch("pass.pov"), scene, strlen(scene));
    add_job(&jobs, "exec povray +Ipass.pov +Oimage.png +W8 +H8 -D +GA +V");
    assert_int_equal(run_jobs(&jobs, 1, &progress, &failed, &err), RESULT_POVRAY);
    assert_int_equal(failed, 0);
    assert_contains(err.text, "exit status 1");
    assert_ok(povray_error_text(&jobs.jobs[0].messages, &text, &err), err);
    assert_string_equal(text.data, "File 'pass.pov' line 5: Parse Error: No matching } in 'sphere', undeclared identifier "
                                   "'pigmnt' found instead");
    buffer_free(&text);
    povray_jobs_free(jobs.jobs, jobs.count);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(run__all_succeed__finished_with_their_messages),
        cmocka_unit_test(run__image_closed__done_before_the_process_ends),
        cmocka_unit_test(end__failed_after_its_image__told),
        cmocka_unit_test(run__another_or_an_empty_file_closed__the_exit_status_counts),
        cmocka_unit_test(run__at_once__never_more),
        cmocka_unit_test(run__one_at_a_time__in_their_order),
        cmocka_unit_test(run__a_held_job__starts_when_it_is_let_go),
        cmocka_unit_test(run__a_held_job_that_is_dropped__ends_without_it),
        cmocka_unit_test(run__refused_after_a_job__the_others_are_ended),
        cmocka_unit_test(run__progress_lines__fractions_of_all_jobs),
        cmocka_unit_test(run__progress_line_in_two_pieces__not_misread),
        cmocka_unit_test(run__one_fails__others_ended_and_its_messages_kept),
        cmocka_unit_test(run__killed_by_a_signal__status_as_a_shell_says),
        cmocka_unit_test(run__no_such_program__cure_named),
        cmocka_unit_test(run__one_fails_another_ignores_sigterm__killed),
        cmocka_unit_test(run__endless_messages__bounded),
        cmocka_unit_test(run__signal__interrupted_and_all_ended),
        cmocka_unit_test(error_text__parse_error__wrapped_lines_joined),
        cmocka_unit_test(error_text__missing_include__both_messages),
        cmocka_unit_test(error_text__error_directive__the_users_text),
        cmocka_unit_test(error_text__warnings__left_out),
        cmocka_unit_test(error_text__warning_in_a_mirror_copy__left_out),
        cmocka_unit_test(error_text__bad_switch__what_povray_says),
        cmocka_unit_test(error_text__progress_ended_by_carriage_returns__left_out),
        cmocka_unit_test(error_text__no_error_among_them__last_line),
        cmocka_unit_test(error_text__real_povray__file_line_and_word),
    };
    return cmocka_run_group_tests_name("povray", tests, scratch_setup, scratch_teardown);
}
