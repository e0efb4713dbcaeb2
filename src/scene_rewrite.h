/* The copies of a POV-Ray scene that the passes render.
 *
 * A copy is the user's text with some blocks replaced, line by line where it was, so that a message of POV-Ray about a
 * copy names the line of the user's own file. What replaces them refers to names that the pass's wrapper declares
 * (pass_scene.c): the macros povgloss_begin and povgloss_end around the items of every finish, povgloss_pigment,
 * povgloss_modifiers (those of the union around), povgloss_nothing (an object, for unions that would be empty) and,
 * where a camera has an aperture, povgloss_camera at its end, and povgloss_photons at the end of the photons of
 * global_settings.
 */
#ifndef POVGLOSS_SCENE_REWRITE_H
#define POVGLOSS_SCENE_REWRITE_H

#include "scene.h"

enum scene_copy {
    SCENE_COPY_PLAIN,       /* the scene itself, inside a union */
    SCENE_COPY_BASE,        /* the scene itself with finishes marked, not inside a union */
    SCENE_COPY_BASE_FIRST,  /* the same inside a union, but for transparent objects without gloss, which stand outside */
    SCENE_COPY_BASE_SECOND, /* the same without lights, statements of the top level and those transparent objects */
    SCENE_COPY_MIRROR,      /* opaque pigments of the pass, finishes marked, inside a union, with the camera */
    SCENE_COPY_MIRROR_SECOND, /* the same without camera and global settings */
    SCENE_COPY_REFLECTANCE, /* colours made opaque, finishes marked, inside a union, with the camera */
    SCENE_COPY_REFLECTION,  /* the same without camera and global settings */
    SCENE_COPY_CODED,       /* no textures at all: everything inherits that of the union around; with the camera */
    SCENE_COPY_DISCOVERY,   /* the scene itself; writes what it includes and its assumed_gamma to SCENE_DISCOVERY_LOG */
    SCENE_COPY_COUNT,
};

/* Writes one copy of all files into the folder. RESULT_DATA, with file and line, for a construct that can't be
 * taken. */
MUST_CHECK enum result scene_write_copy(const struct scene *scene, enum scene_copy copy, const char *folder,
                                        struct error *err);

/* Name of a file of a copy; the wrapper includes that of file 0. The caller frees it. */
MUST_CHECK enum result scene_copy_name(const struct scene *scene, enum scene_copy copy, int file, char **name,
                                       struct error *err);

/* The index of the user's file behind a name of scene_copy_name, or -1. */
int scene_file_of_copy(const struct scene *scene, const char *name);

/* Declares the states that the copies give to macros, as povgloss_none. */
MUST_CHECK enum result scene_declare_states(const struct scene *scene, struct buffer *text, struct error *err);

/* Statements that go before the first and between the two copies of a scene in one wrapper: names that the first one
 * declared are undefined, names that came from the command line keep their values. */
MUST_CHECK enum result scene_save_names(const struct scene *scene, struct buffer *text, struct error *err);
MUST_CHECK enum result scene_restore_names(const struct scene *scene, struct buffer *text, struct error *err);

#endif
