/* The kernel's link to the running program leads to the files beside it, wherever the tree was put. */
#include "own_files.h"

#include "mem.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum result own_file(const char *name, char **path, struct error *err)
{
    char program[4096], *found = NULL;
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    char *slash = strrchr(program, '/');
    enum result result = text_printf(&found, err, "%.*s/../%s", slash ? (int)(slash - program) : 0, program, name);
    *path = result ? NULL : realpath(found, NULL);
    if (!result && !*path)
        result = error_set(err, RESULT_DATA, "%s: %s; build or install povgloss anew", found, strerror(errno));
    free(found);
    return result;
}
