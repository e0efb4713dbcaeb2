/* The scene of every pass: one table says which copies of the user's scene it holds and how it is rendered.
 *
 * A pass is one or two copies (scene_rewrite.h), each in a union whose flags say which rays see it; what each pass is
 * for stands in passes.h.
 */
#ifndef POVGLOSS_PASS_SCENE_H
#define POVGLOSS_PASS_SCENE_H

#include "position_code.h"
#include "scene_rewrite.h"

enum pass_id {
    PASS_PHOTONS, /* no image: leaves PASS_PHOTONS_FILE in its folder, for those that are run after it */
    PASS_BASE,
    PASS_SPECULAR,
    PASS_HAZE,
    PASS_REFLECTANCE,
    PASS_REFLECTIVITY, /* the same by one ray a pixel: what L0 was multiplied by in the specular pass */
    PASS_POSITION,
    PASS_POSITION_LOW,
    PASS_ENDPOINT,
    PASS_ENDPOINT_LOW,
    PASS_VIEW, /* directions, few, by which a camera may be known */
    PASS_DIRECTION,
    PASS_PLACE, /* positions, few, that tell the eye's before the passes with a margin are rendered */
    PASS_PLACE_LOW,
    PASS_EXPONENT,
    PASS_EXPONENT_MEAN,
    PASS_OWN, /* POV-Ray's own picture of the scene as it is, small and without antialiasing */
    PASS_MIRROR, /* the mirrored rays' directions, for probes: an endpoint may lie behind glass that bends the ray */
    PASS_MIRROR_LOW,
    PASS_PROBE, /* what mirrored rays see in PASS_PROBE_VIEW, the mirrors and the camera of the caller */
    PASS_COUNT,
};

#define PASS_PHOTONS_FILE "photons.ph"
/* Left by the base pass in its folder: index of the file and line of the first object that holds something transparent
 * and something glossy, and of the first that holds a transparent mirror without gloss. */
#define PASS_MIXED_FILE "povgloss_mixed.txt"
#define PASS_GLASS_FILE "povgloss_glass.txt"
#define PASS_PROBE_VIEW "view.inc"
/* Beside the copies: nothing, or the camera of the picture with its margin. */
#define PASS_MARGIN_CAMERA "povgloss-margin.inc"

/* A copy of the scene in a union. */
struct scene_part {
    int copy; /* enum scene_copy, or -1 */
    const char *modifiers;
    bool coded;             /* the position-coding texture on the union */
    const char *finish_end; /* what povgloss_finish puts last into every finish of a marked copy */
    const char *placed;     /* what povgloss_place makes of povgloss_object, where it is transparent without gloss */
    bool placed_once;       /* that is the only copy of it: it is outside of the union */
};

struct pass {
    const char *name;
    bool codes;     /* a 16-bit PPM of codes; else EXR of radiance */
    bool full_size; /* rendered as the user asks, antialiasing and size; else one ray a pixel, subsampled */
    bool margin;    /* rendered with the margin, by the camera of PASS_MARGIN_CAMERA */
    bool smooth;    /* antialiased, whatever the user asks */
    bool glossy_part; /* of use where something glossy is, as pass_of_glossy knows; else for the whole picture */
    bool technical; /* colours are numbers: linear, without media or radiosity */
    bool marked;    /* the camera sees pass_marker() in all that isn't glossy */
    enum position_digits digits;
    const char *mirror_colour; /* reflectivity of its glossy finishes */
    struct scene_part first, second;
    double clear_from;         /* a coded object of at least this transparency is looked through */
    bool coded_sky;      /* rays that miss find their direction's code */
    const char *trailer; /* statements after the copies */
};

extern const struct pass pass_table[PASS_COUNT];

/* The pass as this scene takes it. */
struct pass pass_of(const struct scene *scene, enum pass_id id);

/* Whether the specular pass holds L0 times the reflectivity: a pixel of focal blur or of a mixed texture is the sum of
 * what several glossy surfaces reflect. */
bool pass_weights_specular(const struct scene *scene);

/* The radiance, in the working space, of what isn't glossy in a marked pass: negative where its image keeps negative
 * values, as it does in linear light; else so bright that what mirrors show seldom is. */
double pass_marker(const struct scene *scene);

/* Whether the scene requires the pass: where nothing is glossy the base alone; photons where the scene shoots some; the
 * haze where it has one, or media, or a weighted specular pass, which then has a reflectivity, too, and none of which is
 * marked; exponents where they differ, antialiased where one is painted. */
bool pass_needed(const struct scene *scene, enum pass_id id);

/* Whether there are several exponents, a texture may mix a glossy surface with another one, or a total reflection, in
 * something transparent, may be taken for one. */
bool pass_exponents_differ(const struct scene *scene);
/* The pass whose image is black where nothing is glossy: the exponents', or the endpoints' where those don't differ. */
enum pass_id pass_of_glossy(const struct scene *scene);

/* Whether the pass's scene is the user's own text, which no copy has: POV-Ray's own picture, but for photons, which are
 * loaded as in the other passes. */
bool pass_is_verbatim(const struct scene *scene, enum pass_id id);
/* Whether the pass is one of those that find the eye for a margin. */
bool pass_is_place(enum pass_id id);
/* Whether the pass is one of the mirrored rays' directions, which are rendered for those who ask. */
bool pass_is_mirror(enum pass_id id);

/* Marks the kinds of copies that the pass includes. */
void pass_copies(const struct scene *scene, enum pass_id id, bool needed[SCENE_COPY_COUNT]);

/* Appends the scene that includes the discovery copy, writes "end" to its log, and stops by an error: nothing is
 * rendered. */
MUST_CHECK enum result pass_discovery_text(const struct scene *scene, struct buffer *text, struct error *err);

/* Appends the pass's scene, which includes the copies' main files by their names or is the user's own text. */
MUST_CHECK enum result pass_scene_text(const struct scene *scene, enum pass_id id, struct buffer *text,
                                       struct error *err);

#endif
