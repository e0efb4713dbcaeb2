/* A POV-Ray scene with its include files, and the copies of it that the passes render.
 *
 * A copy is the user's text with some blocks replaced, line by line where it was, so that a message of POV-Ray about a
 * copy names the line of the user's own file. What replaces them refers to names that the pass's wrapper declares
 * (pass_scene.c): the macros povgloss_begin and povgloss_end around the items of every finish, povgloss_pigment,
 * povgloss_modifiers (those of the union around), povgloss_nothing (an object, for unions that would be empty) and, where
 * a camera has an aperture, povgloss_camera at its end.
 */
#ifndef POVGLOSS_SCENE_REWRITE_H
#define POVGLOSS_SCENE_REWRITE_H

#include "gloss_choice.h"
#include "scene_lexer.h"

struct scene_include {
    int token, end; /* the expression after #include: its first token, and the one after it */
    int file;       /* index of the file it names; -1: known to POV-Ray only */
};

/* What POV-Ray included by a name that was computed, or that is in none of the directories. */
struct scene_found {
    char *name; /* as in the #include */
    int file;   /* index; -1: to be included as it is */
};

struct scene_file {
    char *path;   /* as the user knows it */
    bool written; /* by the scene itself, in the folder where POV-Ray runs */
    struct buffer source;
    struct token_list list;
    struct scene_include *includes;
    int include_count;
};

struct scene {
    const struct gloss_choice *choice;
    struct scene_file *files; /* the first one is the scene */
    int file_count;
    struct scene_found *found;
    int found_count;
    bool needs_discovery;  /* its includes or its assumed_gamma are known to POV-Ray only: scene_discover */
    struct buffer names;   /* every name that is declared anywhere, each ended by NUL, without repeats */
    struct buffer lights;  /* in the same form: names that were declared as a light_source, */
    struct buffer arrays;  /* as an array filled in its declaration, */
    struct buffer layered; /* as a texture of several layers, */
    struct buffer glossable; /* as a finish, texture or material */
    bool glossy;           /* some finish may be glossy, by Gloss or Gloss_Roughness or by the user's choice */
    double exponent;       /* the one exponent of all of them; negative: they differ, or aren't plain numbers */
    bool plain_mirrors;    /* some finish may reflect without a call of Gloss */
    bool highlights;       /* some finish names the size of a highlight */
    double version;        /* of a #version that opens the scene; 0: none */
    double working_gamma;  /* assumed_gamma, or GBUFFER_GAMMA_SRGB */
    int gammas;            /* how often an assumed_gamma is written anywhere */
    bool focal_blur;        /* some camera has an aperture */
    const char *atmosphere; /* "fog", "rainbow" or "media" where the scene has one at top level, else NULL */
};

enum scene_copy {
    SCENE_COPY_PLAIN,       /* the scene itself, inside a union */
    SCENE_COPY_BASE,        /* the scene itself with finishes marked, not inside a union */
    SCENE_COPY_BASE_SECOND, /* the same without lights and statements of the top level, inside a union */
    SCENE_COPY_MIRROR,      /* opaque pigments of the pass, finishes marked, inside a union, with the camera */
    SCENE_COPY_MIRROR_SECOND, /* the same without camera and global settings */
    SCENE_COPY_REFLECTANCE, /* colours made opaque, finishes marked, inside a union, with the camera */
    SCENE_COPY_CODED,       /* no textures at all: everything inherits that of the union around; with the camera */
    SCENE_COPY_DISCOVERY,   /* the scene itself; writes what it includes and its assumed_gamma to SCENE_DISCOVERY_LOG */
    SCENE_COPY_COUNT,
};

/* Reads the scene and every file it includes by a literal name; `choice` is kept. An include file is looked for in
 * `directories`, in their order. The caller frees the scene, also after a failure. RESULT_DATA, with file and line,
 * for what can't be taken, and for a chosen name that nothing glossy could have. */
MUST_CHECK enum result scene_load(struct scene *scene, const char *path, const struct gloss_choice *choice,
                                  const char *const *directories, int directory_count, struct error *err);
void scene_free(struct scene *scene);

/* The file to which a discovery copy appends in the folder where POV-Ray runs. */
#define SCENE_DISCOVERY_LOG "povgloss.log"

/* The statement that appends the string expression `values` as a line of that file. */
#define SCENE_DISCOVERY_WRITE(values)                                                      \
    "#fopen povgloss_log \"" SCENE_DISCOVERY_LOG "\" append "                              \
    "#write (povgloss_log, " values ", \"\\n\") #fclose povgloss_log "

/* Takes the log of a discovery copy that POV-Ray has parsed in `folder`: reads the files that were included by names
 * which scene_load couldn't follow, and settles working_gamma. *again is true where the new files need another run.
 * RESULT_DATA, with file and line, for a file that the scene writes itself more than once, with other objects or
 * textures in it. */
MUST_CHECK enum result scene_discover(struct scene *scene, const char *folder, const char *const *directories,
                                      int directory_count, bool *again, struct error *err);

/* Writes one copy of all files into the folder. RESULT_DATA, with file and line, for a construct that can't be taken. */
MUST_CHECK enum result scene_write_copy(const struct scene *scene, enum scene_copy copy, const char *folder,
                                        struct error *err);

/* Name of a file of a copy; the wrapper includes that of file 0. The caller frees it. */
MUST_CHECK enum result scene_copy_name(const struct scene *scene, enum scene_copy copy, int file, char **name,
                                       struct error *err);

/* The index of the user's file behind a name of scene_copy_name, or -1. */
int scene_file_of_copy(const struct scene *scene, const char *name);

/* Statements that go before the first and between the two copies of a scene in one wrapper: names that the first one
 * declared are undefined, names that came from the command line keep their values. */
MUST_CHECK enum result scene_save_names(const struct scene *scene, struct buffer *text, struct error *err);
MUST_CHECK enum result scene_restore_names(const struct scene *scene, struct buffer *text, struct error *err);

#endif
