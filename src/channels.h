/* The channels of a passes file: their names, the names that other renderers give them, and the user's own (--map).
 *
 * Channels come in groups. A group whose channels have our names is found by them. Otherwise a layer of the file stands
 * for it whose last component (of "ViewLayer.Position", "Position") is one of the group's aliases, whatever its case,
 * spaces, hyphens and underscores, and whose channels are X Y Z W or R G B A. docs/passes.md has the table and its
 * sources.
 */
#ifndef POVGLOSS_CHANNELS_H
#define POVGLOSS_CHANNELS_H

#include "exr_io.h"
#include "mem.h"

enum { CHANNELS_MAX = 4, CHANNEL_GROUPS = 7 };

struct channel_group {
    const char *name;                /* for --map: all its channels at once */
    const char *names[CHANNELS_MAX]; /* of the channels */
    int count;
    bool required;
    const char *meaning;
    const char *without; /* what follows where it is missing; NULL: it is required, or nothing */
    const char *aliases; /* each followed by a space; lower case, letters and digits only */
};

extern const struct channel_group channel_groups[CHANNEL_GROUPS];

/* Looks for a group among the channels of a file. planes[i] is the plane of channel i, or -1; *missing is the name of
 * the first channel that isn't there, NULL if all are. `map`: texts like "P=World Position" or "P.X=pos.R", which
 * channels_check_map() has passed; the last one wins. RESULT_DATA: a name of the map is not in the file, or several
 * layers could be the group. `path` is for messages. */
MUST_CHECK enum result channels_find(const char *path, const struct exr_contents *contents,
                                     const struct channel_group *group, const struct text_list *map,
                                     int planes[CHANNELS_MAX], const char **missing, struct error *err);

/* Refuses a text that isn't CHANNEL=NAME or GROUP=NAME (RESULT_USAGE). */
MUST_CHECK enum result channels_check_map(const char *text, struct error *err);

#endif
