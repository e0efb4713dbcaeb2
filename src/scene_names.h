/* The words of a scene's files: each is kept once, with what is known of it. */
#ifndef POVGLOSS_SCENE_NAMES_H
#define POVGLOSS_SCENE_NAMES_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>

/* A name has them everywhere, wherever the scene gives it one. */
enum name_fact {
    NAME_DECLARED = 1 << 0,      /* it is declared anywhere, */
    NAME_LIGHT = 1 << 1,         /* as a light_source, */
    NAME_FILLED_ARRAY = 1 << 2,  /* as an array with a finish written out in its declaration, */
    NAME_SURFACE = 1 << 3,       /* as what textures, finishes or materials begin with, */
    NAME_SURFACE_ARRAY = 1 << 4, /* as an array of such, */
    NAME_SURFACE_MACRO = 1 << 5, /* as a macro with a parameter of either kind, */
    NAME_LAYERED = 1 << 6,       /* as a texture of several layers, */
    NAME_GLOSSABLE = 1 << 7,     /* as a finish, texture or material, */
    NAME_CLEAR = 1 << 8,         /* as something that may be transparent, */
    NAME_PARAMETER = 1 << 9,     /* as a parameter of a macro, */
    NAME_CALLED = 1 << 10,       /* as a macro that the scene may call, */
    NAME_UNION = 1 << 11,        /* as a union that may be taken apart, */
    NAME_WHOLE = 1 << 12,        /* as something that may not, or used so */
    NAME_USED = 1 << 13,         /* the picture may have something of it (scene_uses.h) */
    NAME_GLOSSY = 1 << 14,       /* it is declared as a finish with a call of Gloss, */
    NAME_DULL = 1 << 15,         /* as anything else */
};

struct scene_name {
    const char *text;
    size_t length;
    unsigned facts;          /* of enum name_fact */
    int index;               /* of a declared name: how many were declared before it */
    struct scene_name *next; /* the declared name after it */
};

struct scene_names {
    void *tree;                        /* of tsearch */
    struct scene_name *declared, *last; /* the first and the last one */
    int declared_count;
    int facts; /* how many are known of all names together */
};

/* The name of that text, which is added if it is new and lives as long as the names. */
MUST_CHECK enum result scene_names_add(struct scene_names *names, const char *text, size_t length,
                                       struct scene_name **name, struct error *err);
/* NULL: no file has the word. */
const struct scene_name *scene_names_find(const struct scene_names *names, const char *text);
void scene_names_note(struct scene_names *names, struct scene_name *name, enum name_fact fact);
void scene_names_free(struct scene_names *names);

#endif
