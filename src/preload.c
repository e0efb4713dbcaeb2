/* POV-Ray runs in folders of the work folder and finds the object by the link above. */
#include "preload.h"

#include "mem.h"
#include "own_files.h"

#include <stdlib.h>

enum result preload_begin(const struct work_folder *folder, struct error *err)
{
    char *object;
    enum result result = own_file("lib/povgloss/preload.so", &object, err);
    if (!result)
        result = work_folder_link(folder, PRELOAD_LINK, object, err);
    free(object);
    return result;
}

enum result preload_variable(char **variable, struct error *err)
{
    const char *old = getenv("LD_PRELOAD");
    return text_printf(variable, err, "LD_PRELOAD=../" PRELOAD_LINK "%s%s", old ? ":" : "", old ? old : "");
}
