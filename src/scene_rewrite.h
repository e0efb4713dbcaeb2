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
    int token; /* the string of the #include */
    int file;  /* index of the file it names */
};

struct scene_file {
    char *path; /* as the user knows it */
    struct buffer source;
    struct token_list list;
    int *clear; /* for each token, how many before it name something that may be transparent */
    struct scene_include *includes;
    int include_count;
};

struct scene {
    const struct gloss_choice *choice;
    struct scene_file *files; /* the first one is the scene */
    int file_count;
    struct buffer names;   /* every name that is declared anywhere, each ended by NUL, without repeats */
    struct buffer lights;  /* in the same form: names that were declared as a light_source, */
    struct buffer arrays;  /* as an array filled in its declaration, */
    struct buffer layered; /* as a texture of several layers, */
    struct buffer glossable; /* as a finish, texture or material, */
    struct buffer clear;     /* as something that may be transparent, */
    struct buffer parameters; /* as a parameter of a macro, which may be anything, or with one */
    bool glossy;           /* some finish may be glossy, by Gloss or Gloss_Roughness or by the user's choice */
    double exponent;       /* the one exponent of all of them; negative: they differ, or aren't plain numbers */
    bool plain_mirrors;    /* some finish may reflect without a call of Gloss */
    bool mixes;            /* some texture may mix others: a map, an average, a blob, a mesh with a texture at each corner */
    bool highlights;       /* some finish names the size of a highlight */
    double version;        /* of a #version that opens the scene; 0: none */
    double working_gamma;  /* assumed_gamma, or GBUFFER_GAMMA_SRGB */
    bool focal_blur;        /* some camera has an aperture */
    const char *atmosphere; /* "fog", "rainbow" or "media" where the scene has one at top level, else NULL */
};

enum scene_copy {
    SCENE_COPY_PLAIN,       /* the scene itself, inside a union */
    SCENE_COPY_BASE,        /* the scene itself with finishes marked, not inside a union */
    SCENE_COPY_BASE_FIRST,  /* the same inside a union, but for transparent objects without gloss, which stand outside */
    SCENE_COPY_BASE_SECOND, /* the same without lights, statements of the top level and those transparent objects */
    SCENE_COPY_MIRROR,      /* opaque pigments of the pass, finishes marked, inside a union, with the camera */
    SCENE_COPY_MIRROR_SECOND, /* the same without camera and global settings */
    SCENE_COPY_REFLECTANCE, /* colours made opaque, finishes marked, inside a union, with the camera */
    SCENE_COPY_CODED,       /* no textures at all: everything inherits that of the union around; with the camera */
    SCENE_COPY_COUNT,
};

/* Reads the scene and every file it includes by a literal name; `choice` is kept. An include file is looked for in `directories`, in their
 * order; one that isn't found stays as it is, for POV-Ray to look for. The caller frees the scene, also after a failure.
 * RESULT_DATA, with file and line, for what can't be taken: an #include or an assumed_gamma that is not a literal; also
 * for a chosen name that nothing glossy could have. */
MUST_CHECK enum result scene_load(struct scene *scene, const char *path, const struct gloss_choice *choice,
                                  const char *const *directories, int directory_count, struct error *err);
void scene_free(struct scene *scene);

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
