/* A POV-Ray scene with its include files, as tokens, and the facts that decide which passes it needs. */
#ifndef POVGLOSS_SCENE_H
#define POVGLOSS_SCENE_H

#include "gloss_choice.h"
#include "scene_lexer.h"
#include "scene_names.h"

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
    int *clear; /* for each token, how many before it name something that may be transparent */
    bool *object_unions; /* for each token, whether it opens a union of nothing but objects, some perhaps transparent */
    struct scene_include *includes;
    int include_count;
};

/* What blocks around a token mean to it: a set, as struct token's `around`. */
enum scene_block {
    SCENE_BLOCK_PATTERN = 1, /* a pigment in it is a pattern or a value, not what an object looks like */
    SCENE_BLOCK_SURFACE = 2, /* what describes a surface is a part of it */
    SCENE_BLOCK_MATERIAL = 4,
    SCENE_BLOCK_LIGHT_GROUP = 8,
    SCENE_BLOCK_MESH2 = 16,
    SCENE_BLOCK_ARRAY = 32, /* the braces that fill one, where POV-Ray takes no directive and no macro */
    SCENE_BLOCK_SKY = 64,
};

/* What the picture of a glossy scene lacks. */
enum scene_limit {
    SCENE_LIMIT_EXPONENT,
    SCENE_LIMIT_REFLECTION_EXPONENT,
    SCENE_LIMIT_IRID,
    SCENE_LIMIT_SAVED_PHOTONS,
    SCENE_LIMIT_SUBSURFACE,
    SCENE_LIMIT_MEDIA,
    SCENE_LIMIT_COUNT,
};

/* Where in the scene; line 0: nowhere. */
struct scene_place {
    int file, line;
};

struct scene {
    const struct gloss_choice *choice;
    struct scene_file *files; /* the first one is the scene */
    int file_count;
    struct scene_found *found;
    int found_count;
    bool needs_discovery;  /* its includes or its assumed_gamma are known to POV-Ray only: scene_discover */
    struct scene_names names;
    bool glossy;           /* some finish may be glossy, by a macro or by the user's choice */
    double exponent;       /* the one exponent of all of them; negative: they differ, or aren't plain numbers */
    bool painted;          /* some exponent may be painted, by Gloss_Map */
    bool plain_mirrors;    /* some finish that is used may reflect without a call of Gloss */
    bool mixes;            /* some texture that is used may mix others: a map, an average, a blob, a mesh with a texture at each
                              corner */
    bool radiosity;        /* light that a mirror throws onto other things may be computed */
    bool clear_default;    /* an object without a texture may be transparent, by a #default */
    bool may_be_clear;     /* something that is used may be transparent, or is unknown */
    bool refracts;         /* something has an index of refraction */
    bool highlights;       /* some finish names the size of a highlight */
    double version;        /* of the scene's first #version; 0: none */
    double working_gamma;  /* assumed_gamma, or GBUFFER_GAMMA_SRGB */
    int gammas;            /* how often an assumed_gamma is written anywhere */
    bool focal_blur;       /* some camera has an aperture */
    bool depends_on_size;   /* in another size of the picture it may be another scene */
    bool photons;           /* its global_settings may shoot photons */
    struct scene_place limits[SCENE_LIMIT_COUNT]; /* the first place that one is about */
    const char *atmosphere; /* "fog", "rainbow" or "media" where the scene has one at top level, else NULL */
};

/* Reads the scene and every file it includes by a literal name; `choice` is kept. An include file is looked for in
 * `directories`, in their order. Unless it needs a discovery the scene is settled. The caller frees it, also after a
 * failure. RESULT_DATA, with file and line, for what can't be taken, and for a chosen name that nothing glossy could
 * have. */
MUST_CHECK enum result scene_load(struct scene *scene, const char *path, const struct gloss_choice *choice,
                                  const char *const *directories, int directory_count, struct error *err);
void scene_free(struct scene *scene);

/* Finds what follows from all files together: once, when they are known. RESULT_DATA for a chosen name that nothing
 * glossy could have. */
MUST_CHECK enum result scene_settle(struct scene *scene, struct error *err);

/* The path of an include file, which the caller frees; *path is NULL when it isn't in any of the directories. */
MUST_CHECK enum result scene_find_file(const char *name, const char *const *directories, int directory_count,
                                       char **path, struct error *err);

/* Takes `path` over, and gives the index of the file, which is read, with those that it includes, if it is new. */
MUST_CHECK enum result scene_add_file(struct scene *scene, char *path, const char *const *directories,
                                      int directory_count, int *index, struct error *err);

/* What a limit means, in words for the user. */
const char *scene_limit_text(enum scene_limit limit);

/* Calls `note` for each file, round by round, until one adds no fact to any name. */
void scene_note_facts(struct scene *scene, void (*note)(struct scene *scene, const struct scene_file *file));

/* Whether it includes a file that isn't rewritten. */
bool scene_includes_as_it_is(const struct scene *scene);

bool scene_has_unknown_include(const struct scene_file *file);

/* The working_gamma of a scene that says nothing. */
double scene_default_gamma(const struct scene *scene);

#endif
