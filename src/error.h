/* Results and error messages of the library.
 *
 * A function that can fail returns enum result and takes a struct error last. Its numbers are the programs' exit
 * statuses. A message says which file, what, why and, where there is one, the cure; it ends without a period or
 * newline.
 */
#ifndef POVGLOSS_ERROR_H
#define POVGLOSS_ERROR_H

enum result {
    RESULT_OK = 0,
    RESULT_USAGE = 2,       /* wrong command line */
    RESULT_DATA = 3,        /* file, data or memory */
    RESULT_POVRAY = 4,      /* POV-Ray failed */
    RESULT_INTERRUPTED = 5, /* a signal came: the program cleans up and dies of that signal */
};

struct error {
    char text[2048];
};

#define MUST_CHECK __attribute__((warn_unused_result))

/* Writes the message and returns `result`, so that a failure is one line: return error_set(err, RESULT_DATA, "..."). */
__attribute__((format(printf, 3, 4))) enum result error_set(struct error *err, enum result result, const char *format,
                                                            ...);

/* RESULT_DATA with the message for a failed allocation of `bytes`; 0: it isn't known how many. */
enum result error_memory(struct error *err, double bytes);

#endif
