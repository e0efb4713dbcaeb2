/* The copies of a POV-Ray scene that the passes render.
 *
 * A copy is the user's text with some blocks replaced, line by line where it was, so that a message of POV-Ray about a
 * copy names the line of the user's own file. What replaces them refers to names that the pass's wrapper declares
 * (pass_scene.c): the variables of states below, the macro povgloss_finish at the end of every finish, povgloss_pigment,
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

/* How a copy keeps the states of its textures and finishes (pass_scene.c tells what a state is): where a texture begins, and
 * one that is a further layer; after the name that it may begin with; where a finish begins, in the state `of`; where it
 * reflects, or not. Statements in place of macros: at each call from another file POV-Ray opens a macro's file anew. */
#define STATE_LAYER "#declare povgloss_lower = 1; #declare povgloss_texture = povgloss_default_state;"
#define STATE_UPPER_LAYER \
    "#declare povgloss_lower = povgloss_last.t; #declare povgloss_texture = povgloss_default_state;"
#define STATE_LAYERED \
    "#declare povgloss_texture = <povgloss_texture.x, povgloss_texture.y, povgloss_texture.z, " \
    "min(povgloss_lower, povgloss_texture.t)>; #declare povgloss_last = povgloss_texture;"
#define STATE_FINISH(of) \
    "#declare povgloss_state = " of "; #declare povgloss_reflects = 0; #declare povgloss_phong = -1; " \
    "#declare povgloss_begun = povgloss_state.x;"
#define STATE_REFLECTION(reflects) \
    "#declare povgloss_reflects = 1; " \
    "#declare povgloss_state = <povgloss_state.x, " reflects ", povgloss_state.z, povgloss_state.t>;"

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
