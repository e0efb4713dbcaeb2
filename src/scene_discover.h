/* What only POV-Ray knows of a scene: the names of includes that it computes, and its working space. A discovery copy
 * (scene_rewrite.h) writes them to a log as POV-Ray parses it; this takes them from there. */
#ifndef POVGLOSS_SCENE_DISCOVER_H
#define POVGLOSS_SCENE_DISCOVER_H

#include "scene.h"

/* The file to which a discovery copy appends in the folder where POV-Ray runs. */
#define SCENE_DISCOVERY_LOG "povgloss.log"

/* The statement that appends the string expression `values` as a line of that file. */
#define SCENE_DISCOVERY_WRITE(values)                                                      \
    "#fopen povgloss_log \"" SCENE_DISCOVERY_LOG "\" append "                              \
    "#write (povgloss_log, " values ", \"\\n\") #fclose povgloss_log "

/* Takes the log of a discovery copy that POV-Ray has parsed in `folder`: reads the files that were included by names
 * which scene_load couldn't follow, and finds working_gamma. *again is true where the new files need another run; when
 * it is false, scene_settle comes next. RESULT_DATA, with file and line, for a file that the scene writes itself more
 * than once, with other objects or textures in it. */
MUST_CHECK enum result scene_discover(struct scene *scene, const char *folder, const char *const *directories,
                                      int directory_count, bool *again, struct error *err);

#endif
