/* A table of rules for each kind of copy, and one walk over the tokens that copies the source and replaces blocks.
 *
 * The places of finishes, textures and lights are found by tokens; whether a finish is glossy is left to POV-Ray,
 * through the marks, since macros and conditions decide it.
 */
#include "scene_rewrite.h"

#include "scene_discover.h"
#include "scene_tokens.h"
#include "scene_unions.h"
#include "scene_uses.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CONDITIONS = 256 };

/* What happens to statements that are allowed at the top level only. */
enum statements {
    STATEMENTS_STAY,   /* the copy isn't inside a union */
    STATEMENTS_BREAK,  /* the union is closed before them and opened again after them */
    STATEMENTS_CAMERA, /* the same for camera and global_settings; the rest is dropped */
    STATEMENTS_DROP,
};

struct rules {
    const char *name;
    enum statements statements;
    bool lights;
    bool marks;           /* states of finishes, and povgloss_finish at their ends */
    bool pigments;        /* pigments become povgloss_pigment, or the parts of it that hide what is behind them */
    bool places;          /* transparent objects of the top level are placed by povgloss_place */
    bool coded;           /* textures are taken off */
    bool covers;          /* it matters whether a pigment is transparent */
    bool technical;       /* linear working space, no photons, no radiosity */
    bool discovery;       /* includes and assumed_gamma are written to the log */
};

static const struct rules copy_rules[SCENE_COPY_COUNT] = {
    [SCENE_COPY_PLAIN] = {"plain", STATEMENTS_BREAK, .lights = true},
    [SCENE_COPY_BASE] = {"base", STATEMENTS_STAY, .lights = true, .marks = true},
    [SCENE_COPY_BASE_FIRST] = {"base1", STATEMENTS_BREAK, .lights = true, .marks = true, .places = true},
    [SCENE_COPY_BASE_SECOND] = {"base2", STATEMENTS_DROP, .marks = true, .places = true},
    [SCENE_COPY_MIRROR] = {"mirror", STATEMENTS_CAMERA, .marks = true, .pigments = true, .covers = true,
                           .technical = true},
    [SCENE_COPY_MIRROR_SECOND] = {"mirror2", STATEMENTS_DROP, .marks = true, .pigments = true, .covers = true,
                                  .technical = true},
    [SCENE_COPY_REFLECTANCE] = {"reflectance", STATEMENTS_CAMERA, .marks = true, .covers = true},
    [SCENE_COPY_REFLECTION] = {"reflection", STATEMENTS_DROP, .marks = true, .covers = true},
    [SCENE_COPY_CODED] = {"coded", STATEMENTS_CAMERA, .coded = true, .covers = true, .technical = true},
    [SCENE_COPY_DISCOVERY] = {"discovery", STATEMENTS_STAY, .lights = true, .discovery = true},
};

struct writer {
    const struct scene *scene;
    const struct scene_file *file;
    const struct rules *rules;
    enum scene_copy copy;
    size_t at;       /* the source up to here is written */
    int local;       /* the next #local to be written as #declare, and what is around it */
    struct nesting nesting;
    int value_name;  /* the name in the last #declare of a block */
    int value_end;   /* the token after that block: a texture there is a further layer */
    int end;         /* the token where the block ends that is being written; branches of a conditional may open it, too */
    int object_end;  /* the same of the last block that write_object wrote */
    int moved_pigment; /* the last that was written before its turn */
    bool given;      /* in the declaration of a name that the user chose to be glossy */
    bool in_macro;
    bool in_default; /* in the braces of a #default */
    int conditions;  /* depth of #if, #while, #for, #switch, #macro; which of them are macros */
    bool is_macro[MAX_CONDITIONS];
    struct buffer out;
};

/* A #local of the scene outside macros is one of the top level, and global; in a copy, which is included, it would not
 * be. */
static bool is_global_local(const struct writer *writer)
{
    return writer->file == writer->scene->files && is_directive(writer->file, writer->local, "local") &&
           !writer->nesting.macro;
}

static enum result copy_to(struct writer *writer, size_t end, struct error *err)
{
    const struct token *tokens = writer->file->list.tokens;
    const char *source = writer->file->source.data;
    enum result result = RESULT_OK;
    for (; !result && writer->local < writer->file->list.count && tokens[writer->local].begin < end; writer->local++) {
        nest(&writer->nesting, writer->file, writer->local);
        const struct token *local = &tokens[writer->local];
        if (local->begin < writer->at || !is_global_local(writer))
            continue;
        result = buffer_add(&writer->out, source + writer->at, local->begin - writer->at, err);
        if (!result)
            result = buffer_add_text(&writer->out, "#declare", err);
        writer->at = local->end;
    }
    if (result || end <= writer->at)
        return result;
    result = buffer_add(&writer->out, source + writer->at, end - writer->at, err);
    writer->at = end;
    return result;
}

/* Leaves the source out up to `end` and writes `text` and the line ends of what is left out in its place. */
static enum result replace_to(struct writer *writer, size_t end, const char *text, struct error *err)
{
    enum result result = buffer_add_text(&writer->out, text, err);
    for (; writer->at < end; writer->at++) {
        const char *c = writer->file->source.data + writer->at;
        if (!result && (*c == '\n' || *c == '\r'))
            result = buffer_add(&writer->out, c, 1, err);
    }
    return result;
}

static enum result insert_before(struct writer *writer, int token, const char *text, struct error *err)
{
    enum result result = copy_to(writer, writer->file->list.tokens[token].begin, err);
    return result ? result : buffer_add_text(&writer->out, text, err);
}

static enum result insert_after(struct writer *writer, int token, const char *text, struct error *err)
{
    enum result result = copy_to(writer, writer->file->list.tokens[token].end, err);
    return result ? result : buffer_add_text(&writer->out, text, err);
}

/* Replaces the tokens from `first` to `last`. */
static enum result replace(struct writer *writer, int first, int last, const char *text, struct error *err)
{
    enum result result = copy_to(writer, writer->file->list.tokens[first].begin, err);
    return result ? result : replace_to(writer, writer->file->list.tokens[last].end, text, err);
}

static enum result write_tokens(struct writer *writer, int first, int end, struct error *err);

/* In global_settings of a technical pass colours are numbers and light doesn't matter. POV-Ray keeps the first
 * assumed_gamma of a scene, so the wrapper's own comes first and this one becomes a setting that the wrapper resets. */
static enum result write_technical_settings(struct writer *writer, int first, int end, struct error *err)
{
    static const char *const lighting[] = {"photons", "radiosity", "subsurface", NULL};
    enum result result = RESULT_OK;
    for (int i = first; !result && i < end; i++) {
        if (is_word(writer->file, i, "assumed_gamma")) {
            bool srgb = is_word(writer->file, i + 1, "srgb");
            result = replace(writer, i, i + srgb, srgb ? "" : "adc_bailout", err);
        } else if (in_list(writer->file, i, lighting) && opens_block(writer->file, i)) {
            int last = writer->file->list.tokens[i + 1].match;
            result = replace(writer, i, last, "", err);
            i = last;
        }
    }
    return result;
}

/* In global_settings of a copy that is drawn: photons end in povgloss_photons(). */
static enum result write_photons(struct writer *writer, int first, int end, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = first; !result && i < end; i++)
        if (shoots_photons(writer->file, i))
            result = insert_before(writer, writer->file->list.tokens[i + 1].match, " povgloss_photons() ", err);
    return result;
}

/* Puts `text` in place of the block `keyword { ... }` from `token` to `last`. One with effects is declared in front of
 * it (an interior_texture as a texture), so that every copy of the scene draws the same random numbers. */
static enum result replace_block(struct writer *writer, int token, int last, const char *text, struct error *err)
{
    if (!has_effects(writer->file, token + 1, last))
        return replace(writer, token, last, text, err);
    enum result result = insert_before(writer, token, "#declare povgloss_dropped = ", err);
    if (!result)
        result = is_word(writer->file, token, "interior_texture") ? replace(writer, token, token, "texture", err)
                                                                  : RESULT_OK;
    for (int i = token + 2; !result && i < last; i++)
        /* Another branch of a conditional opens the block, too. */
        if (opens_block(writer->file, i) && writer->file->list.tokens[i + 1].match == last)
            result = insert_before(writer, i, "#declare povgloss_dropped = ", err);
    if (!result)
        result = insert_after(writer, last, "; ", err);
    return result ? result : buffer_add_text(&writer->out, text, err);
}

/* Of a finish that is black no light gets under the surface: `subsurface { translucency X }` leaves X. */
static enum result write_subsurface(struct writer *writer, int token, int last, struct error *err)
{
    enum result result = replace(writer, token, token + 2, "#declare povgloss_dropped =", err);
    if (!result)
        result = write_tokens(writer, token + 3, last, err);
    return result ? result : replace(writer, last, last, "; ", err);
}

/* In global_settings of a discovery copy: every assumed_gamma goes to the log. */
static enum result write_gamma_log(struct writer *writer, int first, int end, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = first; !result && i < end; i++) {
        if (!is_word(writer->file, i, "assumed_gamma"))
            continue;
        int file = (int)(writer->file - writer->scene->files);
        if (is_word(writer->file, i + 1, "srgb")) {
            result = insert_before(writer, i, "", err);
            if (!result)
                result = buffer_printf(&writer->out, err, SCENE_DISCOVERY_WRITE("\"gamma %d %d srgb\""), file, i);
            continue;
        }
        result = replace(writer, i, i, "#declare povgloss_gamma =", err);
        if (!result)
            result = insert_after(writer, value_end(writer->file, i + 1) - 1, "; ", err);
        if (!result)
            result = buffer_printf(&writer->out, err,
                                   SCENE_DISCOVERY_WRITE("\"gamma %d %d \", str(povgloss_gamma, 0, 9)")
                                   "assumed_gamma povgloss_gamma ", file, i);
    }
    return result;
}

/* camera, global_settings, background ... : statements that no union may contain. */
static enum result write_statement(struct writer *writer, int token, int last, struct error *err)
{
    bool camera = is_word(writer->file, token, "camera"), settings = is_word(writer->file, token, "global_settings");
    enum statements statements = writer->rules->statements;
    if (statements == STATEMENTS_DROP || (statements == STATEMENTS_CAMERA && !camera && !settings))
        return replace(writer, token, last, "", err);
    enum result result = RESULT_OK;
    if (statements != STATEMENTS_STAY)
        result = insert_before(writer, token, "povgloss_modifiers() } ", err);
    if (!result && settings)
        result = writer->rules->technical   ? write_technical_settings(writer, token + 2, last, err)
                 : writer->rules->discovery ? write_gamma_log(writer, token + 2, last, err)
                                            : write_photons(writer, token + 2, last, err);
    if (!result && camera && writer->scene->focal_blur)
        result = insert_before(writer, last, " povgloss_camera() ", err);
    if (!result && statements != STATEMENTS_STAY)
        return insert_after(writer, last, " union { povgloss_nothing()", err);
    return result ? result : copy_to(writer, writer->file->list.tokens[last].end, err);
}

/* Appends the subscripts after the name at `name`. Those that may differ when they are computed again, as by rand(),
 * are the variables VARIABLE_0, VARIABLE_1 ... that hoist_subscripts declares. */
static enum result add_subscripts(const struct writer *writer, int name, const char *variable, struct buffer *text,
                                  struct error *err)
{
    const struct token *tokens = writer->file->list.tokens;
    int end = after_subscripts(writer->file, name + 1);
    enum result result = RESULT_OK;
    if (!has_effects(writer->file, name + 1, end - 1))
        return buffer_add(text, writer->file->source.data + tokens[name].end, tokens[end - 1].end - tokens[name].end, err);
    for (int i = name + 1, index = 0; !result && i < end; i = subscript_end(writer->file, i) + 1)
        result = buffer_printf(text, err, "[%s_%d]", variable, index++);
    return result;
}

/* Declares those variables in front of the token `before` and puts them in the place of the subscripts. */
static enum result hoist_subscripts(struct writer *writer, int before, int name, const char *variable, struct error *err)
{
    const struct scene_file *file = writer->file;
    const struct token *tokens = file->list.tokens;
    int end = after_subscripts(file, name + 1);
    if (!has_effects(writer->file, name + 1, end - 1))
        return RESULT_OK;
    struct buffer text = {0};
    enum result result = insert_before(writer, before, "", err);
    for (int i = name + 1, index = 0, last; !result && i < end; i = last + 1) {
        last = subscript_end(file, i);
        result = buffer_printf(&writer->out, err, "#declare %s_%d = %.*s; ", variable, index++,
                               (int)(tokens[last].begin - tokens[i].end), file->source.data + tokens[i].end);
    }
    if (!result)
        result = add_subscripts(writer, name, variable, &text, err);
    if (!result)
        result = buffer_add(&text, "", 1, err);
    if (!result)
        result = replace(writer, name + 1, end - 1, text.data, err);
    buffer_free(&text);
    return result;
}

/* A finish or texture that begins with a declared name takes over that one's state (pass_scene.c), which is kept in a
 * variable povgloss_of_N beside each name (N being its index, as names may be as long as POV-Ray allows); for an element
 * of an array it is in an array of the same size. The state goes into `variable`, and `then` is said after it. */
static enum result inherit_state(struct writer *writer, int token, const char *variable, const char *then,
                                 struct error *err)
{
    static const char index[] = "povgloss_index";
    const struct scene_file *file = writer->file;
    int name = name_index(file, token), end = after_subscripts(file, token + 1);
    if (name < 0 || is_call(file, token) ||
        (end > token + 1 && !has_fact(file, token, NAME_SURFACE_ARRAY)))
        return RESULT_OK;
    struct buffer element = {0};
    enum result result = hoist_subscripts(writer, token, token, index, err);
    if (!result)
        result = copy_to(writer, file->list.tokens[end - 1].end, err);
    if (!result)
        result = buffer_printf(&element, err, "povgloss_of_%d", name);
    if (!result)
        result = add_subscripts(writer, token, index, &element, err);
    if (!result)
        result = buffer_printf(&writer->out, err, " #ifdef (%1$.*2$s) #declare %3$s = %1$.*2$s; %4$s#end", element.data,
                               (int)element.size, variable, then);
    buffer_free(&element);
    return result;
}

/* Whether the copy may have painted exponents, which are in the pigments of one of its passes. */
static bool paints(const struct writer *writer)
{
    return writer->scene->painted && writer->rules->pigments;
}

static bool is_argument(const struct scene_file *file, int token)
{
    return is_mark(file, token - 1, "(") || is_mark(file, token - 1, ",");
}

/* Appends the source of some tokens without its comments and lines. */
static enum result add_tokens(struct writer *writer, int first, int last, struct error *err)
{
    const struct token *tokens = writer->file->list.tokens;
    enum result result = RESULT_OK;
    for (int i = first; !result && i <= last; i++)
        result = buffer_printf(&writer->out, err, " %.*s", (int)(tokens[i].end - tokens[i].begin),
                               writer->file->source.data + tokens[i].begin);
    return result;
}

static const char *const object_words[] = {
    "bicubic_patch", "blob",          "box",          "cone",            "cubic",         "cylinder", "difference",
    "disc",          "height_field",  "intersection", "isosurface",      "julia_fractal", "lathe",    "merge",
    "mesh",          "mesh2",         "object",       "parametric",      "plane",         "poly",     "polygon",
    "prism",         "quadric",       "quartic",      "smooth_triangle", "sor",           "sphere",   "sphere_sweep",
    "superellipsoid", "text",         "torus",        "triangle",        "union",         NULL};

/* Whether it matters where this block is transparent. */
static bool tracks(const struct writer *writer, int first, int last)
{
    const struct gloss_choice *choice = writer->scene->choice;
    bool asked = writer->rules->covers || writer->rules->places ||
                 (writer->rules->marks && (choice->automatic || choice->all));
    return asked && may_be_clear(writer->file, first, last);
}

/* The last block `keyword { ... }` before `token` in the same braces and macro that isn't declared, or -1. */
static int sibling_before(const struct scene_file *file, int token, const char *keyword)
{
    int parent = file->list.tokens[token].parent;
    if (is_mark(file, token - 1, "="))
        return -1;
    for (int i = token - 1; i > parent && i > 0 && !is_directive(file, i, "macro"); i--) {
        if (is_mark(file, i, "}") && file->list.tokens[i].match > 0)
            i = file->list.tokens[i].match - 1;
        if (is_word(file, i, keyword) && opens_block(file, i) && !is_mark(file, i - 1, "="))
            return i;
    }
    return -1;
}

/* What a finish gets its transparency from: the last pigment, texture or material before it in the same braces, or
 * -1. */
static int surface_before(const struct writer *writer, int token)
{
    static const char *const words[] = {"pigment", "texture", "material"};
    const struct scene_file *file = writer->file;
    int last = -1;
    if (writer->moved_pigment > token && file->list.tokens[writer->moved_pigment].parent == file->list.tokens[token].parent)
        return writer->moved_pigment;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        int block = sibling_before(file, token, words[i]);
        last = block > last ? block : last;
    }
    return last;
}

/* The same if its transparency is tracked, else -1. */
static int covered_sibling(const struct writer *writer, int token)
{
    int block = surface_before(writer, token);
    return block >= 0 && tracks(writer, block + 2, writer->file->list.tokens[block + 1].match) ? block : -1;
}

/* Whether a finish follows the block that ends at `last` in the same braces and macro. */
static bool has_finish_after(const struct scene_file *file, int last)
{
    const struct token *tokens = file->list.tokens;
    int parent = tokens[last].parent, end = parent >= 0 ? tokens[parent].match : file->list.count;
    for (int i = last + 1; i < end && !is_directive(file, i, "macro"); i++) {
        if (is_word(file, i, "finish") && is_mark(file, i + 1, "{"))
            return true;
        if (is_mark(file, i, "{") && tokens[i].match > i)
            i = tokens[i].match;
    }
    return false;
}

static bool in_triangle(const struct scene_file *file, int token)
{
    int parent = file->list.tokens[token].parent;
    return parent > 0 && (is_word(file, parent - 1, "triangle") || is_word(file, parent - 1, "smooth_triangle"));
}

/* What may stand between a finish and its pigment without touching either. */
static const char *const moved_over_words[] = {"normal", "interior", "finish", NULL};

static bool in_texture(const struct scene_file *file, int token)
{
    int parent = file->list.tokens[token].parent;
    return parent > 0 && (is_word(file, parent - 1, "texture") || is_word(file, parent - 1, "interior_texture"));
}

static enum result add_cover(struct writer *writer, int token, int last, struct error *err)
{
    static const char *const uv[] = {"uv_mapping", NULL};
    return buffer_printf(&writer->out, err, "; povgloss_cover_of_%s(%d) ",
                         in_texture(writer->file, token) ? "texture" : "object", mentions(writer->file, token + 2, last, uv));
}

/* A pigment that may be transparent is declared first, so that POV-Ray can say where it is. */
static enum result write_cover(struct writer *writer, int token, int last, struct error *err)
{
    if (token == writer->moved_pigment)
        return replace(writer, token, last, "", err);
    enum result result = insert_before(writer, token, "#declare povgloss_cover = ", err);
    if (!result)
        result = insert_after(writer, last, "", err);
    if (!result)
        result = add_cover(writer, token, last, err);
    if (result || in_texture(writer->file, token) || !writer->rules->marks || has_finish_after(writer->file, last))
        return result;
    return buffer_add_text(&writer->out,
                           writer->rules->covers   ? "povgloss_hide(povgloss_own) "
                           : writer->rules->places ? "povgloss_count(povgloss_own) "
                                                   : "",
                           err);
}

/* Such a pigment after the finish `finish {...} pigment {...}` at `token` is written before it. */
static enum result move_cover(struct writer *writer, int token, int last, struct error *err)
{
    const struct scene_file *file = writer->file;
    int pigment = last + 1;
    while (in_list(file, pigment, moved_over_words) && opens_block(file, pigment))
        pigment = file->list.tokens[pigment + 1].match + 1;
    if (!is_word(file, pigment, "pigment") || !opens_block(file, pigment) || covered_sibling(writer, token) >= 0)
        return RESULT_OK;
    int end = file->list.tokens[pigment + 1].match;
    if (!tracks(writer, pigment + 2, end) || has_effects(writer->file, pigment, end) || in_triangle(file, pigment))
        return RESULT_OK;
    writer->moved_pigment = pigment;
    enum result result = insert_before(writer, token, "#declare povgloss_cover =", err);
    if (!result)
        result = add_tokens(writer, pigment, end, err);
    return result ? result : add_cover(writer, pigment, end, err);
}

static enum result begin_finish(struct writer *writer, int token, struct error *err)
{
    const struct scene_file *file = writer->file;
    int brace = file->list.tokens[token].parent, surface = surface_before(writer, token);
    bool of_texture = brace > 0 && is_word(file, brace - 1, "texture");
    bool own = surface >= 0 && is_word(file, surface, "pigment") && covered_sibling(writer, token) >= 0;
    const char *state = of_texture                                            ? "povgloss_texture"
                        : own                                                 ? "povgloss_own"
                        : surface >= 0 && !is_word(file, surface, "pigment") ? "povgloss_last"
                                                                              : "povgloss_default_state";
    enum result result = insert_after(writer, token + 1, "", err);
    if (!result)
        result = buffer_printf(&writer->out, err, " " STATE_FINISH("%s") " ", state);
    bool value = is_mark(file, token - 1, "=");
    if (!result && value && !has_fact(file, token + 2, NAME_DECLARED) &&
        !has_fact(file, token + 2, NAME_PARAMETER))
        result = buffer_add_text(&writer->out, "povgloss_of_default() ", err);
    char *pigment = NULL;
    if (!result)
        result = text_printf(&pigment, err,
                             "#declare povgloss_state = <povgloss_state.x, povgloss_state.y, povgloss_state.z, %s.t>; ", state);
    if (!result)
        result = inherit_state(writer, token + 2, "povgloss_state", pigment, err);
    free(pigment);
    /* An element of a filled array comes unmarked. */
    if (!result && has_fact(writer->file, token + 2, NAME_FILLED_ARRAY))
        result = buffer_add_text(&writer->out, " #declare povgloss_reflects = 1; ", err);
    return result;
}

/* A finish that is declared by a name leaves automatic gloss to the textures and objects that use it. */
static enum result write_finish(struct writer *writer, int token, int last, bool named, struct error *err)
{
    enum result result = move_cover(writer, token, last, err);
    int cover = covered_sibling(writer, token);
    if (!result)
        result = begin_finish(writer, token, err);
    if (!result)
        result = write_tokens(writer, token + 2, last, err);
    if (!result)
        result = insert_before(writer, last, named ? " povgloss_finish(1) " : " povgloss_finish(0) ", err);
    if (!result && cover >= 0 && writer->rules->covers)
        result = insert_after(writer, last, " povgloss_hide(povgloss_last) ", err);
    return result;
}

/* Whether the texture block at `token` is a further layer: another one ends before it. */
static bool is_layer(const struct scene_file *file, int token)
{
    int first = is_mark(file, token - 1, "}") ? file->list.tokens[token - 1].match : -1;
    return first > 0 && is_word(file, first - 1, "texture");
}

/* A texture with one of these takes no finish at its end, or needs none. */
static const char *const finish_carriers[] = {"finish", "texture", "texture_map", "tiles", "material_map", NULL};

static enum result begin_texture(struct writer *writer, int token, bool upper, struct error *err)
{
    enum result result = insert_after(writer, token + 1, upper ? " " STATE_UPPER_LAYER " " : " " STATE_LAYER " ", err);
    if (!result)
        result = inherit_state(writer, token + 2, "povgloss_texture",
                               writer->rules->places ? STATE_LAYERED " povgloss_count(povgloss_texture) " : "", err);
    return result ? result : buffer_add_text(&writer->out, " " STATE_LAYERED " ", err);
}

static enum result write_texture(struct writer *writer, int token, int last, bool upper, struct error *err)
{
    const struct rules *rules = writer->rules;
    bool cover = tracks(writer, token + 2, last), plain = !mentions(writer->file, token + 2, last, finish_carriers + 1);
    enum result result = begin_texture(writer, token, upper, err);
    if (!result)
        result = write_tokens(writer, token + 2, last, err);
    if (!result && rules->marks && has_fact(writer->file, token + 2, NAME_FILLED_ARRAY))
        result = insert_before(
            writer, last, " finish { " STATE_FINISH("povgloss_none") " #declare povgloss_reflects = 1; povgloss_finish(0) } ",
            err);
    if (!result && rules->marks && writer->given && plain && !mentions(writer->file, token + 2, last, finish_carriers))
        result = insert_before(writer, last, " finish { " STATE_FINISH("povgloss_texture") " povgloss_finish(0) } ", err);
    if (!result && rules->marks && rules->covers && cover && plain)
        result = insert_before(writer, last, " povgloss_hide(povgloss_last) ", err);
    /* Nothing shows through an opaque layer, but a layer that isn't glossy must not hide a glossy one below. */
    if (!result && upper && rules->pigments && !has_fact(writer->file, token + 2, NAME_LAYERED))
        result = insert_before(writer, last, " #if (povgloss_exponent(povgloss_last) < 0) pigment { rgbt 1 } #end ", err);
    return result;
}

static const char declared_element[] = "povgloss_element";

/* After `#declare X = finish {...}` or the last layer of `#declare X = texture {...}`: remembers the state of X. */
static enum result remember(struct writer *writer, int name_token, int last, struct error *err)
{
    const struct scene_file *file = writer->file;
    int name = name_index(file, name_token), end = last + is_mark(file, last + 1, ";");
    int subscripts = after_subscripts(file, name_token + 1);
    bool element = subscripts > name_token + 1;
    if (name < 0 || is_word(file, last + 1, "texture") ||
        (element && !has_fact(file, name_token, NAME_SURFACE_ARRAY)))
        return RESULT_OK;
    const char *declare = is_directive(file, name_token - 1, "local") ? "#local" : "#declare";
    enum result result = copy_to(writer, file->list.tokens[end].end, err);
    if (!result)
        result = buffer_printf(&writer->out, err, " %s povgloss_of_%d", declare, name);
    if (!result)
        result = add_subscripts(writer, name_token, declared_element, &writer->out, err);
    if (!result)
        result = buffer_add_text(&writer->out, " = povgloss_last; ", err);
    if (!result && writer->rules->coded && !element)
        result = buffer_printf(&writer->out, err,
                               " #ifdef (povgloss_interior) %s povgloss_interior_of_%d = interior { povgloss_interior } "
                               "#end ",
                               declare, name);
    return result;
}

/* `#declare A = array[9] { T, texture { U } }`: A gets an array of states, with those of the elements that are or begin
 * with a name. */
static enum result declare_states(struct writer *writer, int directive, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    int name = declared_name(file, directive), index = 0;
    if (name < 0 || !is_mark(file, name + 1, "=") || !is_word(file, name + 2, "array") ||
        !has_fact(file, name, NAME_SURFACE_ARRAY))
        return RESULT_OK;
    int brace = after_subscripts(file, name + 3), array = name_index(file, name);
    const struct token *tokens = file->list.tokens;
    const char *declare = is_directive(file, directive, "local") ? "#local" : "#declare";
    enum result result = insert_before(writer, directive, "", err);
    if (!result)
        result = buffer_printf(&writer->out, err, "%s povgloss_of_%d = array%.*s ", declare, array,
                               (int)(tokens[brace - 1].end - tokens[name + 2].end), file->source.data + tokens[name + 2].end);
    if (result || !is_mark(file, brace, "{") || tokens[brace].match < 0)
        return result;
    result = write_tokens(writer, brace + 1, tokens[brace].match, err);
    *next = tokens[brace].match + 1 + is_mark(file, tokens[brace].match + 1, ";");
    if (!result)
        result = insert_after(writer, *next - 1, "", err);
    for (int i = brace + 1; !result && i < tokens[brace].match; index++) {
        int first = in_list(file, i, glossy_words) && opens_block(file, i) ? i + 2 : i;
        int element = is_mark(file, first + 1, "[") ? -1 : name_index(file, first);
        if (element >= 0)
            result = buffer_printf(&writer->out, err, " #ifdef (povgloss_of_%d) %s povgloss_of_%d[%d] = povgloss_of_%d; #end ",
                                   element, declare, array, index, element);
        while (i < tokens[brace].match && !is_mark(file, i, ","))
            i = tokens[i].match > i ? tokens[i].match : i + 1;
        i++;
    }
    return result;
}

/* After `#declare X = Y;`: X takes over the state of Y. */
static enum result copy_state(struct writer *writer, int directive, struct error *err)
{
    const struct scene_file *file = writer->file;
    int name = declared_name(file, directive), semicolon = name + 3;
    if (name < 0 || !is_mark(file, name + 1, "=") || !is_mark(file, semicolon, ";"))
        return RESULT_OK;
    int to = name_index(file, name), from = name_index(file, name + 2);
    if (to < 0 || from < 0)
        return RESULT_OK;
    enum result result = insert_after(writer, semicolon, "", err);
    return result ? result
                  : buffer_printf(&writer->out, err, " #ifdef (povgloss_of_%d) %s povgloss_of_%d = povgloss_of_%d; #end ", from,
                                  is_directive(file, directive, "local") ? "#local" : "#declare", to, from);
}

/* `#macro M(F, X)`: a macro with such a parameter among the surfaces takes the state of each besides, as `#macro M(F,
 * X, povgloss_of_N, povgloss_unused_1)`. */
static enum result take_states(struct writer *writer, int directive, struct error *err)
{
    const struct scene_file *file = writer->file;
    int macro = directive + 1, position = 0;
    if (!is_directive(file, directive, "macro") || !has_fact(file, macro, NAME_SURFACE_MACRO) ||
        !has_parentheses(file, macro))
        return RESULT_OK;
    int last = file->list.tokens[macro + 1].match;
    enum result result = insert_before(writer, last, "", err);
    for (int i = macro + 2; !result && i < last; i = argument_end(file, i, last) + 1, position++) {
        int name = !has_fact(file, i, NAME_SURFACE) ? -1 : name_index(file, i);
        result = buffer_printf(&writer->out, err, name >= 0 ? ", povgloss_of_%d" : ", povgloss_unused_%d",
                               name >= 0 ? name : position);
    }
    return result;
}

/* `M(F, 9)`, at M: gives the states. Of the arguments that are written out it is that of the last one. */
static enum result give_states(struct writer *writer, int token, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    if (!has_fact(file, token, NAME_SURFACE_MACRO) || !is_call(file, token))
        return RESULT_OK;
    int last = file->list.tokens[token + 1].match;
    struct buffer states = {0};
    enum result result = write_tokens(writer, token + 2, last, err);
    for (int i = token + 2, end; !result && i < last; i = end + 1) {
        end = argument_end(file, i, last);
        int name = !has_fact(file, i, NAME_SURFACE) ? -1 : name_index(file, i);
        bool element = end > i + 1;
        if (in_list(file, i, glossy_words) && opens_block(file, i) && argument_end(file, end + 1, last) >= last)
            result = buffer_add_text(&states, ", povgloss_last*1", err);
        else if (name < 0 || after_subscripts(file, i + 1) != end || has_effects(writer->file, i, end - 1) ||
                 (element && !has_fact(file, i, NAME_SURFACE_ARRAY)))
            result = buffer_add_text(&states, ", povgloss_none", err);
        else
            result = buffer_printf(&states, err, ", povgloss_of_%d%.*s", name,
                                   (int)(file->list.tokens[end - 1].end - file->list.tokens[i].end),
                                   file->source.data + file->list.tokens[i].end);
    }
    if (!result)
        result = insert_before(writer, last, "", err);
    if (!result)
        result = buffer_add(&writer->out, states.data, states.size, err);
    buffer_free(&states);
    *next = last;
    return result;
}

/* Whether a macro of this name writes an object itself. */
static bool makes_object(const struct scene *scene, const struct scene_name *name)
{
    for (int i = 0; i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        for (int macro = 1; macro < file->list.count; macro++)
            if (is_directive(file, macro - 1, "macro") && name_at(file, macro) == name &&
                mentions(file, macro, end_of_macro(file, macro - 1), object_words))
                return true;
    }
    return false;
}

/* `#declare T = Made()`, where textures, finishes or materials begin with T, or where T may be a map of exponents. */
static enum result declare_made(struct writer *writer, int directive, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    int name = declared_name(file, directive), value = name < 0 ? -1 : after_subscripts(file, name + 1) + 1;
    bool surface = name >= 0 && has_fact(file, name, NAME_SURFACE);
    if (name < 0 || !is_mark(file, value - 1, "=") || !has_fact(file, value, NAME_DECLARED) || !is_call(file, value))
        return RESULT_OK;
    int last = file->list.tokens[value + 1].match;
    bool map = paints(writer) && is_mark(file, last + 1, ";");
    if ((!surface && !map) || makes_object(writer->scene, name_at(file, value)))
        return RESULT_OK;
    enum result result = insert_before(writer, directive, surface ? "#declare povgloss_last = povgloss_none; " : "", err);
    if (!result)
        result = buffer_add_text(&writer->out, "#declare povgloss_value = povgloss_value + 1; ", err);
    if (!result)
        result = write_tokens(writer, value, last + 1, err);
    if (!result)
        result = insert_after(writer, last + is_mark(file, last + 1, ";"), " #declare povgloss_value = povgloss_value - 1; ",
                              err);
    *next = last + 1 + is_mark(file, last + 1, ";");
    return result || !surface ? result : remember(writer, name, last, err);
}

/* A material in a copy without textures: its interior is kept for the object, which may be clear. */
static enum result write_coded_material(struct writer *writer, int token, int last, struct error *err)
{
    int name = name_index(writer->file, token + 2);
    enum result result =
        insert_after(writer, token + 1, " povgloss_no_interior() #declare povgloss_last = povgloss_none; ", err);
    if (!result)
        result = inherit_state(writer, token + 2, "povgloss_last", "", err);
    if (!result && name >= 0)
        result = buffer_printf(&writer->out, err,
                               " #ifdef (povgloss_interior_of_%d) #declare povgloss_interior = interior { "
                               "povgloss_interior_of_%d } #end ",
                               name, name);
    if (!result)
        result = write_tokens(writer, token + 2, last, err);
    return result ? result : copy_to(writer, writer->file->list.tokens[last].end, err);
}

/* Between the eye and a glossy surface nothing may fade, glow or split the ray; the reflectance fades. */
static enum result write_interior(struct writer *writer, int token, int last, struct error *err)
{
    const struct scene_file *file = writer->file;
    enum result result = RESULT_OK;
    bool keep = writer->rules->coded && inside(file, token, SCENE_BLOCK_MATERIAL);
    if (keep)
        result = insert_before(writer, token, "#declare povgloss_interior = ", err);
    for (int i = token + 2; !result && i < last; i++) {
        if (!is_word(file, i, "media") || !opens_block(file, i))
            continue;
        int end = file->list.tokens[i + 1].match;
        result = replace_block(writer, i, end, "", err);
        i = end;
    }
    if (!result && writer->rules->technical)
        result = insert_before(writer, last, " fade_distance 0 fade_power 0 dispersion 1 ", err);
    if (!result && keep)
        result = insert_after(writer, last, "; interior { povgloss_interior } ", err);
    return result ? result : copy_to(writer, file->list.tokens[last].end, err);
}

static const char *const statement_words[] = {"camera",     "global_settings", "background", "fog",
                                              "sky_sphere", "rainbow",         NULL};
static const char *const texture_words[] = {"texture",  "pigment", "finish", "normal", "material", "interior_texture",
                                            NULL};

/* A light that the copy must not have twice goes, or if it may be part of something else (it is declared, or fills an
 * array, or brings an object along by looks_like) it fades to nothing within any distance. */
static enum result write_light(struct writer *writer, int token, int last, bool value, struct error *err)
{
    static const char *const looks_like[] = {"looks_like", NULL};
    const struct scene_file *file = writer->file;
    bool element = is_mark(file, token + 3, "[") && !is_mark(file, after_subscripts(file, token + 3), ",");
    if (has_fact(file, token + 2, NAME_LIGHT) || element)
        return copy_to(writer, file->list.tokens[last].end, err);
    if (!value && !has_effects(writer->file, token + 1, last) && !mentions(writer->file, token + 2, last, looks_like))
        return replace(writer, token, last, "", err);
    enum result result = write_tokens(writer, token + 2, last, err);
    return result ? result : insert_before(writer, last, " fade_distance 1e-9 fade_power 20 ", err);
}

/* A material begins in the state of the declared one that it names; its textures then give theirs. */
static enum result write_material(struct writer *writer, int token, int last, struct error *err)
{
    enum result result = insert_after(writer, token + 1, " #declare povgloss_last = povgloss_none; ", err);
    if (!result)
        result = inherit_state(writer, token + 2, "povgloss_last", writer->rules->places ? "povgloss_count(povgloss_last) " : "", err);
    return result ? result : write_tokens(writer, token + 2, last, err);
}

/* `object { X` at its keyword counts the textures of X, or notes that they aren't known. */
static enum result add_part_counts(struct writer *writer, int token, struct error *err)
{
    const struct scene_file *file = writer->file;
    int name = token + 2, part = name_index(file, name);
    if (!is_word(file, token, "object") || opens_block(file, name) || is_mark(file, name + 1, "(") ||
        file->list.tokens[name].kind != TOKEN_WORD)
        return RESULT_OK;
    bool known = part >= 0 && !is_mark(file, name + 1, "[");
    enum result result = known ? insert_after(writer, name, "", err) : insert_before(writer, name, "", err);
    if (!result && known)
        result = buffer_printf(&writer->out, err, " #ifdef (povgloss_holds_%d) povgloss_add(povgloss_holds_%d) #else ", part,
                               part);
    if (!result)
        result = buffer_add_text(&writer->out, "povgloss_add(<0, 0, 1, 0>) ", err);
    return result || !known ? result : buffer_add_text(&writer->out, "#end ", err);
}

/* Whether the object between these tokens may be transparent. */
static bool may_be_placed(const struct writer *writer, int first, int last)
{
    return writer->scene->clear_default || tracks(writer, first, last);
}

/* Whether the objects in these braces are placed one by one. */
static bool splits(const struct writer *writer, int brace)
{
    return writer->rules->places && union_splits(writer->file, brace, writer->in_macro);
}

/* Whether the block at `token` stands in no other and is no value. */
static bool is_at_top(const struct writer *writer, int token)
{
    return writer->file->list.tokens[token].parent < 0 && !writer->in_macro && !is_mark(writer->file, token - 1, "=");
}

/* A union whose objects are placed one by one is itself in both copies, and so is what has its name. */
static enum result write_split(struct writer *writer, int token, int last, struct error *err)
{
    bool top = is_at_top(writer, token);
    enum result result = insert_before(writer, token, top ? "povgloss_leave_copy() " : "", err);
    if (!result)
        result = insert_after(writer, token + 1, is_word(writer->file, token, "union") ? " povgloss_nothing() " : "", err);
    if (!result)
        result = write_tokens(writer, token + 2, last, err);
    return result ? result : insert_after(writer, last, top ? " povgloss_enter_copy() " : "", err);
}

/* An object with its textures counted: one of the top level, which may be transparent, is declared and then placed, as
 * is one of a union that is split; a declared one, which may be glossy, keeps its counts beside its name (`name`, else
 * -1). */
static enum result write_object(struct writer *writer, int token, int last, int name, struct error *err)
{
    const struct scene_file *file = writer->file;
    static const char *const unions[] = {"union", NULL};
    bool part = splits(writer, file->list.tokens[token].parent);
    int index = name_index(file, name);
    enum result result = name >= 0 ? RESULT_OK : insert_before(writer, token, "#declare povgloss_object = ", err);
    if (!result)
        result = insert_after(writer, token + 1, " povgloss_enter() ", err);
    if (last == writer->object_end)
        return result;
    writer->object_end = last;
    if (!result && name >= 0)
        result = buffer_printf(&writer->out, err, "#declare povgloss_before_%d = povgloss_counts; ", index);
    if (!result)
        result = add_part_counts(writer, token, err);
    /* Parts without a texture show the default. */
    if (!result && mentions(file, token, last, unions))
        result = buffer_add_text(&writer->out, " povgloss_count(povgloss_default_state) ", err);
    if (!result)
        result = write_tokens(writer, token + 2, last, err);
    if (!result)
        result = insert_after(writer, last, " ", err);
    if (result || name < 0)
        return result ? result
                      : buffer_printf(&writer->out, err, "povgloss_place%s(%d, %d) ", part ? "_part" : "",
                                      (int)(file - writer->scene->files), file->list.tokens[token].line);
    return buffer_printf(&writer->out, err,
                         "povgloss_leave() #declare povgloss_holds_%d = povgloss_counts - povgloss_before_%d; ", index,
                         index);
}

/* What the user chose for the name at a token, or NULL. */
static const struct gloss_name *find_choice(const struct writer *writer, int name)
{
    const struct gloss_choice *choice = writer->scene->choice;
    for (int i = 0; name >= 0 && i < choice->name_count; i++)
        if (is_word(writer->file, name, choice->names[i].name))
            return &choice->names[i];
    return NULL;
}

/* Whether what uses the name finds its state beside it. */
static bool keeps_state(const struct writer *writer, int name)
{
    bool element = name >= 0 && is_mark(writer->file, name + 1, "[");
    return has_fact(writer->file, name, element ? NAME_SURFACE_ARRAY : NAME_DECLARED);
}

/* A pigment that isn't declared by a name, in a copy where nothing opaque has colours. Where exponents may be painted,
 * one that may become a map stays, as the argument or, by povgloss_value, as the value of a macro, and over a map
 * others don't count. */
static enum result write_pigment(struct writer *writer, int token, int last, struct error *err)
{
    const struct scene_file *file = writer->file;
    bool of_macro = paints(writer) && writer->in_macro && file->list.tokens[token].parent < 0;
    bool over = paints(writer) && (of_macro || in_texture(file, token) || surface_before(writer, token) >= 0 ||
                                   sibling_before(file, token, "finish") >= 0);
    if (paints(writer) && (is_argument(file, token) || inside(file, token, SCENE_BLOCK_ARRAY)))
        return copy_to(writer, file->list.tokens[last].end, err);
    enum result result = of_macro ? insert_before(writer, token, "#if (povgloss_value > 0)", err) : RESULT_OK;
    if (!result && of_macro)
        result = add_tokens(writer, token, last, err);
    if (!result && of_macro)
        result = buffer_add_text(&writer->out, " #else ", err);
    if (!result && tracks(writer, token + 2, last) && !inside(file, token, SCENE_BLOCK_ARRAY) &&
        !in_triangle(file, token))
        result = write_cover(writer, token, last, err);
    else if (!result)
        result = replace_block(writer, token, last, over ? "povgloss_repaint() " : "pigment { povgloss_pigment }", err);
    return result || !of_macro ? result : insert_after(writer, last, " #end ", err);
}

/* `M(N(3))`, at N, where exponents may be painted: what N makes is a value. */
static enum result write_argument(struct writer *writer, int token, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    if (!is_argument(file, token) || !is_call(file, token) || !has_fact(file, token, NAME_DECLARED))
        return RESULT_OK;
    int last = file->list.tokens[token + 1].match;
    if (!is_mark(file, last + 1, ",") && !is_mark(file, last + 1, ")"))
        return RESULT_OK;
    enum result result = insert_before(writer, token, "#declare povgloss_value = povgloss_value + 1; ", err);
    if (!result)
        result = write_tokens(writer, token + 1, last + 1, err);
    *next = last + 1;
    return result ? result : insert_after(writer, last, " #declare povgloss_value = povgloss_value - 1; ", err);
}

/* A finish, texture or material; `name` is that of its declaration, or -1. */
static enum result write_marked(struct writer *writer, int token, int last, int name, struct error *err)
{
    const struct scene_file *file = writer->file;
    const struct gloss_name *choice = find_choice(writer, name);
    enum result result = RESULT_OK;
    if (choice) {
        writer->given = true;
        result = insert_after(writer, token + 1, "", err);
        if (!result)
            result = buffer_printf(&writer->out, err, " #declare povgloss_given = %.9g;", fmin(choice->exponent, 1e30));
    }
    bool finish = is_word(file, token, "finish"), material = is_word(file, token, "material");
    if (!result)
        result = finish     ? write_finish(writer, token, last, writer->in_default || keeps_state(writer, name), err)
                 : material ? write_material(writer, token, last, err)
                            : write_texture(writer, token, last, is_layer(file, token), err);
    if (!result && finish && name < 0 && !writer->in_default && !is_argument(file, token) && paints(writer))
        result = insert_after(writer, last, " povgloss_paint() ", err);
    if (!result && choice) {
        writer->given = false;
        result = insert_before(writer, last, " #declare povgloss_given = -1; ", err);
    }
    return result ? result : copy_to(writer, file->list.tokens[last].end, err);
}

/* `#declare X = texture {...} texture {...}`: POV-Ray takes no directive and no macro in any layer but the first, so
 * each layer is declared by itself. */
static enum result write_declared_layers(struct writer *writer, int token, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    int directive = token, count = 0, last = token;
    while (directive > 0 && file->list.tokens[directive].kind != TOKEN_DIRECTIVE)
        directive--;
    enum result result = insert_before(writer, directive, "", err);
    if (!result)
        result = replace_to(writer, file->list.tokens[token].begin, "", err);
    for (int layer = token; !result && is_word(file, layer, "texture") && opens_block(file, layer); layer = last + 1) {
        last = file->list.tokens[layer + 1].match;
        result = insert_before(writer, layer, "", err);
        if (!result)
            result = buffer_printf(&writer->out, err, "#declare povgloss_layer_%d = ", count++);
        if (!result)
            result = write_marked(writer, layer, last, writer->value_name, err);
        if (!result)
            result = insert_after(writer, last, "; ", err);
    }
    for (int i = directive; !result && i < token; i++) {
        result = buffer_add(&writer->out, file->source.data + file->list.tokens[i].begin,
                            file->list.tokens[i].end - file->list.tokens[i].begin, err);
        if (!result)
            result = buffer_add_text(&writer->out, " ", err);
    }
    for (int i = 0; !result && i < count; i++)
        result = buffer_printf(&writer->out, err, "texture { povgloss_layer_%d } ", i);
    *next = last + 1;
    return result ? result : remember(writer, writer->value_name, last, err);
}

/* Whether all layers of the texture whose first layer is at `token` may be transparent. */
static bool layers_may_be_clear(const struct writer *writer, int token)
{
    const struct scene_file *file = writer->file;
    bool clear = !is_layer(file, token);
    for (int last; clear && is_word(file, token, "texture") && opens_block(file, token); token = last + 1) {
        last = file->list.tokens[token + 1].match;
        clear = tracks(writer, token + 2, last);
    }
    return clear;
}

/* In a copy without textures those that are declared stay. Of those that may be clear it is remembered whether they
 * are. */
static enum result write_coded_value(struct writer *writer, int token, int last, int name, struct error *err)
{
    const struct scene_file *file = writer->file;
    bool texture = is_word(file, token, "texture"), material = is_word(file, token, "material");
    bool clear = name >= 0 ? has_fact(file, name, NAME_CLEAR) : tracks(writer, token + 2, last);
    if (!clear || inside(file, token, SCENE_BLOCK_ARRAY) || (!texture && !material))
        return copy_to(writer, file->list.tokens[last].end, err);
    enum result result = texture ? write_texture(writer, token, last, is_layer(file, token), err)
                                 : write_coded_material(writer, token, last, err);
    return result || name < 0 ? result : remember(writer, name, last, err);
}

/* Whether every condition and macro that begins or ends between two tokens does both. */
static bool nests_evenly(const struct scene_file *file, int first, int last)
{
    int depth = 0;
    for (int i = first; i <= last && depth >= 0; i++)
        depth += opens_nesting(file, i) - is_directive(file, i, "end");
    return depth == 0;
}

/* Appends the tokens of a source without its comments and lines. */
static enum result add_in_one_line(struct buffer *text, const struct buffer *source, struct error *err)
{
    struct token_list list = {0};
    enum result result = scene_lex("", source, &list, err);
    for (int i = 0; !result && i < list.count - 1; i++) {
        result = buffer_add(text, source->data + list.tokens[i].begin, list.tokens[i].end - list.tokens[i].begin, err);
        if (!result)
            result = buffer_add_text(text, " ", err);
    }
    token_list_free(&list);
    return result;
}

static enum result write_coded(struct writer *writer, int token, int last, int *next, struct error *err);

/* Outside braces a macro may give its caller a value, or an object its textures: povgloss_value tells. */
static enum result write_coded_result(struct writer *writer, int token, int last, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    struct writer value = *writer;
    value.out = (struct buffer){0};
    value.at = file->list.tokens[token].begin;
    enum result result = write_coded_value(&value, token, last, -1, err);
    if (!result)
        result = copy_to(&value, file->list.tokens[last].end, err);
    if (!result)
        result = insert_before(writer, token, "#if (povgloss_value > 0) ", err);
    if (!result)
        result = add_in_one_line(&writer->out, &value.out, err);
    buffer_free(&value.out);
    if (!result)
        result = buffer_add_text(&writer->out, "#else ", err);
    *next = last + 1;
    if (!result)
        result = write_coded(writer, token, last, next, err);
    return result ? result : insert_after(writer, *next - 1, " #end ", err);
}

/* In an object they go. One that may be clear is declared in front of it, so that POV-Ray decides. */
static enum result write_coded(struct writer *writer, int token, int last, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    bool triangle = in_triangle(file, token), texture = is_word(file, token, "texture");
    bool clear = texture ? layers_may_be_clear(writer, token)
                         : is_word(file, token, "material") && tracks(writer, token + 2, last);
    if (triangle || !clear)
        return replace_block(writer, token, last, triangle ? "" : "transform {}", err);
    enum result result = RESULT_OK;
    for (int block = token, more = true; !result && more; block = last + 1) {
        last = file->list.tokens[block + 1].match;
        result = insert_before(writer, block, "#declare povgloss_dropped = ", err);
        if (!result)
            result = texture ? write_texture(writer, block, last, block > token, err)
                             : write_coded_material(writer, block, last, err);
        if (!result)
            result = insert_after(writer, last, "; ", err);
        more = texture && is_word(file, last + 1, "texture") && opens_block(file, last + 1);
    }
    *next = last + 1;
    result = result ? result : buffer_add_text(&writer->out, "povgloss_coded(povgloss_last.t) ", err);
    return result || texture ? result : buffer_add_text(&writer->out, "povgloss_coded_interior() ", err);
}

/* Leaves out the values, textures and commas of a mesh from `first` up to the next vector, which is *next, or to `end`.
 * Values with effects are declared; `after` ends that: POV-Ray wants a semicolon after a number and takes none after
 * what a macro leaves of a texture. */
static enum result drop_items(struct writer *writer, int first, int end, const char *after, int *next,
                              struct error *err)
{
    const struct scene_file *file = writer->file;
    enum result result = RESULT_OK;
    int item = first, item_end;
    for (; !result && item < end && !is_mark(file, item, "<"); item = item_end) {
        if (is_directive(file, item, "include"))
            return error_set(err, RESULT_DATA,
                             "%s:%d: the textures of a mesh come from a file of their own, which can't be taken: "
                             "include the whole mesh instead",
                             file->path, file->list.tokens[item].line);
        if (file->list.tokens[item].kind == TOKEN_DIRECTIVE) {
            item_end = directive_end(file, item, end);
            result = write_tokens(writer, item, item_end, err);
        } else if (opens_block(file, item)) {
            item_end = file->list.tokens[item + 1].match + 1;
            result = replace_block(writer, item, item_end - 1, "", err);
        } else {
            item_end = value_before(file, item, end);
            bool value = item_end > item, effects = value && has_effects(writer->file, item, item_end - 1);
            item_end += !value;
            result = effects ? insert_before(writer, item, "#declare povgloss_dropped = ", err)
                             : replace(writer, item, item_end - 1, "", err);
            if (!result && effects)
                result = insert_after(writer, item_end - 1, after, err);
        }
    }
    *next = item;
    return result;
}

static int skip_directives(const struct scene_file *file, int token, int end)
{
    while (token < end && file->list.tokens[token].kind == TOKEN_DIRECTIVE && !is_directive(file, token, "include"))
        token = directive_end(file, token, end);
    return token;
}

/* Without its texture_list a mesh takes no texture numbers after its faces: `face_indices { N, <a, b, c>, 0, ... }`. */
static enum result write_faces(struct writer *writer, int token, int last, struct error *err)
{
    const struct scene_file *file = writer->file;
    int parent = file->list.tokens[token].parent;
    int face = value_before(file, skip_directives(file, token + 2, last), last);
    bool textured = sibling_before(file, token, "texture_list") >= 0, unknown = !inside(file, token, SCENE_BLOCK_MESH2);
    for (int i = token; !unknown && i > parent; i--)
        unknown = is_directive(file, i, "include");
    face = skip_directives(file, face + is_mark(file, face, ","), last);
    bool plain = face >= last || is_mark(file, face, "<");
    if (textured && !plain)
        return error_set(err, RESULT_DATA,
                         "%s:%d: the faces of this mesh2 can't be told from the numbers of their textures: write each "
                         "as <a, b, c>, in these braces",
                         file->path, file->list.tokens[face].line);
    bool strips = plain && (textured || unknown);
    enum result result = write_tokens(writer, token + 2, strips ? face : last, err);
    while (!result && strips && face < last) {
        int face_end = value_before(file, face, last);
        result = drop_items(writer, face_end + is_mark(file, face_end, ","), last, "; ", &face, err);
    }
    return result ? result : copy_to(writer, file->list.tokens[last].end, err);
}

/* The list of a mesh2 holds a number and textures, that of a triangle the names of three. */
static enum result write_texture_list(struct writer *writer, int token, int last, struct error *err)
{
    const struct scene_file *file = writer->file;
    int first = token + 2, count_end = first;
    if (!in_triangle(file, token))
        count_end = value_before(file, skip_directives(file, first, last), last);
    enum result result = replace(writer, token, token + 1, "", err);
    if (!result)
        result = drop_items(writer, first, count_end, "; ", &first, err);
    if (!result)
        result = drop_items(writer, first, last, " ", &first, err);
    return result ? result : replace(writer, last, last, "", err);
}

/* Writes the block `keyword { ... }` whose keyword is at `token` if it is changed by the rules; *next is then the token
 * after it, else 0. */
static enum result write_block(struct writer *writer, int token, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    const struct rules *rules = writer->rules;
    int brace = token + 1, last = file->list.tokens[brace].match;
    bool argument = is_argument(file, token);
    bool value = is_mark(file, token - 1, "=") || (token == writer->value_end && is_word(file, token, "texture"));
    if (is_mark(file, token - 1, "="))
        writer->value_name = before_subscripts(file, token - 2);
    if (value)
        writer->value_end = last + 1;
    *next = last + 1;
    bool top = file->list.tokens[token].parent < 0 && !value;
    if (top && (in_list(file, token, statement_words) || (is_word(file, token, "media") && !writer->in_macro)))
        return write_statement(writer, token, last, err);
    if (is_word(file, token, "camera") || is_word(file, token, "function"))
        return copy_to(writer, file->list.tokens[last].end, err);
    if (!rules->lights && is_word(file, token, "light_source") && !inside(file, token, SCENE_BLOCK_LIGHT_GROUP))
        return write_light(writer, token, last, value || inside(file, token, SCENE_BLOCK_ARRAY), err);
    if (rules->places && last >= writer->end && last == writer->object_end && in_list(file, token, object_words)) {
        *next = 0;
        return write_object(writer, token, last, -1, err);
    }
    bool named = value && has_fact(file, writer->value_name, NAME_DECLARED) &&
                 !is_mark(file, writer->value_name + 1, "[");
    bool placed = !value && file->list.tokens[token].parent < 0 && !argument && may_be_placed(writer, token + 2, last);
    if (splits(writer, brace) || (rules->places && is_split_object(file, token)))
        return write_split(writer, token, last, err);
    placed |= !value && splits(writer, file->list.tokens[token].parent);
    if (rules->places && (named || placed) && in_list(file, token, object_words))
        return write_object(writer, token, last, named ? writer->value_name : -1, err);
    bool filling = inside(file, token, SCENE_BLOCK_ARRAY), pattern = inside(file, token, SCENE_BLOCK_PATTERN);
    bool pigment = is_word(file, token, "pigment") && !pattern;
    if (rules->covers && is_word(file, token, "interior"))
        return write_interior(writer, token, last, err);
    if (rules->covers && rules->marks && is_word(file, token, "subsurface") && is_word(file, token + 2, "translucency"))
        return write_subsurface(writer, token, last, err);
    if (rules->marks && last >= writer->end) {
        *next = 0;
        return is_word(file, token, "finish")    ? begin_finish(writer, token, err)
               : is_word(file, token, "texture") ? begin_texture(writer, token, is_layer(file, token), err)
                                                 : RESULT_OK;
    }
    bool clear_name = value && has_fact(file, writer->value_name, NAME_CLEAR);
    if (value && is_word(file, token, "texture") && is_word(file, last + 1, "texture") && !filling &&
        (rules->marks || (rules->coded && clear_name)))
        return write_declared_layers(writer, token, next, err);
    if (rules->marks && in_list(file, token, glossy_words) && !filling) {
        enum result result = write_marked(writer, token, last, value ? writer->value_name : -1, err);
        return result || !value ? result : remember(writer, writer->value_name, last, err);
    }
    if (rules->pigments && pigment && !value)
        return write_pigment(writer, token, last, err);
    if (pigment && !value && !filling && tracks(writer, token + 2, last) && !in_triangle(file, token))
        return write_cover(writer, token, last, err);
    if (rules->coded && is_word(file, token, "texture_list"))
        return write_texture_list(writer, token, last, err);
    if (rules->coded && is_word(file, token, "face_indices"))
        return write_faces(writer, token, last, err);
    if (rules->coded && in_list(file, token, texture_words) && writer->in_macro && file->list.tokens[token].parent < 0 &&
        !value && !argument && nests_evenly(file, token, last))
        return write_coded_result(writer, token, last, next, err);
    if (rules->coded && in_list(file, token, texture_words))
        return value || argument || filling || pattern || inside(file, token, SCENE_BLOCK_SURFACE)
                   ? write_coded_value(writer, token, last, value ? writer->value_name : -1, err)
                   : write_coded(writer, token, last, next, err);
    *next = 0;
    return rules->places && !filling ? add_part_counts(writer, token, err) : RESULT_OK;
}

/* What says how a finish reflects: noted for povgloss_finish; with automatic gloss the lobe of the highlight, too. */
static enum result write_finish_item(struct writer *writer, int token, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    if (is_word(file, token, "reflection"))
        return insert_before(writer, token,
                             is_zero(file, token + 1) ? STATE_REFLECTION("0") " " : STATE_REFLECTION("1") " ", err);
    if (!writer->scene->choice->automatic || !in_list(file, token, highlight_words))
        return RESULT_OK;
    int end = value_end(file, token + 1);
    if (end == token + 1)
        return RESULT_OK;
    *next = end;
    enum result result = replace(writer, token, token, "#declare povgloss_size =", err);
    if (!result)
        result = insert_after(writer, end - 1, "; ", err);
    bool roughness = is_word(file, token, "roughness");
    return result ? result : buffer_add_text(&writer->out, roughness ? "povgloss_roughness()" : "povgloss_phong_size()", err);
}

static void track_directive(struct writer *writer, int token)
{
    if (opens_nesting(writer->file, token) && writer->conditions < MAX_CONDITIONS)
        writer->is_macro[writer->conditions++] = is_directive(writer->file, token, "macro");
    if (is_directive(writer->file, token, "end") && writer->conditions > 0)
        writer->conditions--;
    writer->in_macro = false;
    for (int i = 0; i < writer->conditions; i++)
        writer->in_macro |= writer->is_macro[i];
}

/* `#include EXPRESSION` becomes `#declare povgloss_name = EXPRESSION; ... #include povgloss_name`, and in between the
 * names of the files that were found become those of their copies. */
static enum result write_unknown_include(struct writer *writer, const struct scene_include *include, struct error *err)
{
    const struct scene *scene = writer->scene;
    enum result result = replace(writer, include->token - 1, include->token - 1, "#declare povgloss_name =", err);
    if (!result)
        result = insert_after(writer, include->end - 1, "; ", err);
    if (!result && writer->rules->discovery)
        result = buffer_printf(&writer->out, err, SCENE_DISCOVERY_WRITE("\"include %d %d \", povgloss_name"),
                               (int)(writer->file - scene->files), include->token);
    for (int i = 0; !result && i < scene->found_count; i++) {
        char *copy = NULL;
        if (scene->found[i].file < 0)
            continue;
        result = scene_copy_name(scene, writer->copy, scene->found[i].file, &copy, err);
        if (!result)
            result = buffer_add_text(&writer->out, "#if (strcmp(povgloss_name, \"", err);
        for (const char *c = scene->found[i].name; !result && *c; c++)
            result = buffer_printf(&writer->out, err, "%s%c", *c == '"' || *c == '\\' ? "\\" : "", *c);
        if (!result)
            result = buffer_printf(&writer->out, err, "\") = 0) #declare povgloss_name = \"%s\"; #end ", copy);
        free(copy);
    }
    return result ? result : buffer_add_text(&writer->out, "#include povgloss_name", err);
}

static enum result write_include(struct writer *writer, int token, struct error *err)
{
    for (int i = 0; i < writer->file->include_count; i++) {
        const struct scene_include *include = &writer->file->includes[i];
        if (include->token != token)
            continue;
        if (include->file < 0)
            return writer->rules->discovery || writer->scene->found_count ? write_unknown_include(writer, include, err)
                                                                          : RESULT_OK;
        char *name = NULL, *quoted = NULL;
        enum result result = scene_copy_name(writer->scene, writer->copy, include->file, &name, err);
        if (!result)
            result = text_printf(&quoted, err, "\"%s\"", name);
        if (!result)
            result = replace(writer, token, token, quoted, err);
        free(name);
        free(quoted);
        return result;
    }
    return RESULT_OK;
}

/* Objects without a texture take the default when they are finished, at the end of the union: it ends before the
 * default changes. In a copy without textures it would be seen in the codes, and is taken back. */
static enum result write_default(struct writer *writer, int token, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    int last = file->list.tokens[token + 1].match;
    *next = last + 1;
    bool breaks = writer->rules->statements != STATEMENTS_STAY && file->list.tokens[token].parent < 0 && !writer->in_macro;
    enum result result = insert_before(writer, token, breaks ? "povgloss_modifiers() } " : "", err);
    if (!result && writer->rules->marks)
        result = buffer_add_text(&writer->out, "povgloss_enter_default() ", err);
    if (!result && writer->rules->places)
        result = buffer_add_text(&writer->out, "#declare povgloss_before_default = povgloss_counts; ", err);
    if (!result && file->list.tokens[token].kind == TOKEN_WORD) /* the old form, which is a statement */
        result = buffer_add_text(&writer->out, "#", err);
    writer->in_default = true;
    if (!result)
        result = writer->rules->coded ? insert_after(writer, last, " #default { texture { povgloss_default } }", err)
                                      : write_tokens(writer, token + 1, last, err);
    writer->in_default = false;
    if (!result && writer->rules->places)
        result = insert_after(writer, last, " povgloss_counted_default() ", err);
    if (!result && writer->rules->marks)
        result = insert_after(writer, last, " povgloss_leave_default() ", err);
    return result || !breaks ? result : insert_after(writer, last, " union { povgloss_nothing()", err);
}

/* Of a discovery copy: the name in `#fopen X NAME write` goes to the log. */
static enum result write_opening_log(struct writer *writer, int token, struct error *err)
{
    const struct scene_file *file = writer->file;
    int name = token + 2, end = name < file->list.count ? string_end(file, name) : name;
    if (end == name || is_word(file, end, "read"))
        return RESULT_OK;
    size_t begin = file->list.tokens[name].begin;
    enum result result = insert_before(writer, token, "", err);
    return result ? result
                  : buffer_printf(&writer->out, err, SCENE_DISCOVERY_WRITE("\"write %d %d \", %.*s"),
                                  (int)(file - writer->scene->files), name,
                                  (int)(file->list.tokens[end - 1].end - begin), file->source.data + begin);
}

/* The last token of what the directive at `token` declares if the scene doesn't use it, else -1: POV-Ray needn't parse
 * it. */
static int last_unused(const struct writer *writer, int token)
{
    const struct scene_file *file = writer->file;
    bool used = writer->rules->discovery || file == writer->scene->files ||
                has_fact(file, declared_name(file, token), NAME_USED);
    return used ? -1 : end_of_block(file, token);
}

static enum result write_tokens(struct writer *writer, int first, int end, struct error *err)
{
    const struct scene_file *file = writer->file;
    enum result result = RESULT_OK;
    int outer = writer->end;
    writer->end = end;
    for (int i = first, next; !result && i < end; i = next ? next : i + 1) {
        next = 0;
        int unused = last_unused(writer, i);
        if (unused >= 0) {
            result = replace(writer, i, unused, "", err);
            next = unused + 1;
        } else if (file->list.tokens[i].kind == TOKEN_DIRECTIVE) {
            track_directive(writer, i);
            if (writer->rules->marks || writer->rules->coded)
                result = copy_state(writer, i, err);
            if (!result && (writer->rules->marks || writer->rules->coded))
                result = declare_states(writer, i, &next, err);
            if (!result && writer->rules->marks)
                result = take_states(writer, i, err);
            if (!result && (writer->rules->marks || writer->rules->coded) && declared_name(file, i) > 0 &&
                has_fact(file, declared_name(file, i), NAME_SURFACE_ARRAY))
                result = hoist_subscripts(writer, i, declared_name(file, i), declared_element, err);
            if (!result && (writer->rules->marks || writer->rules->coded))
                result = declare_made(writer, i, &next, err);
            if (!result && is_directive(file, i, "include"))
                result = write_include(writer, i + 1, err);
            else if (!result && is_directive(file, i, "fopen") && writer->rules->discovery)
                result = write_opening_log(writer, i, err);
            else if (!result && is_directive(file, i, "default") && opens_block(file, i))
                result = write_default(writer, i, &next, err);
        } else if (file->list.tokens[i].kind == TOKEN_WORD) {
            if (is_word(file, i, "default") && opens_block(file, i))
                result = write_default(writer, i, &next, err);
            else if (opens_block(file, i))
                result = write_block(writer, i, &next, err);
            else if (writer->rules->marks && is_mark(file, i + 1, "{") && in_list(file, i, glossy_words))
                result = insert_after(writer, i + 1,
                                      " #error \"povgloss: this block isn't closed in the same file: close its brace "
                                      "there\\n\" ",
                                      err);
            if (!result && !next && paints(writer))
                result = write_argument(writer, i, &next, err);
            if (!result && !next && writer->rules->marks)
                result = give_states(writer, i, &next, err);
            if (!result && !next && writer->rules->marks && !inside(file, i, SCENE_BLOCK_ARRAY))
                result = write_finish_item(writer, i, &next, err);
        }
    }
    writer->end = outer;
    return result;
}

enum result scene_copy_name(const struct scene *scene, enum scene_copy copy, int file, char **name, struct error *err)
{
    enum result result =
        text_printf(name, err, "%s-%03d-%s", copy_rules[copy].name, file, base_name(scene->files[file].path));
    for (char *c = result ? NULL : *name; c && *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("._-", *c))
            *c = '_';
    return result;
}

int scene_file_of_copy(const struct scene *scene, const char *name)
{
    for (int copy = 0; copy < SCENE_COPY_COUNT; copy++) {
        size_t length = strlen(copy_rules[copy].name);
        if (strncmp(name, copy_rules[copy].name, length) || name[length] != '-' ||
            strspn(name + length + 1, "0123456789") != 3)
            continue;
        int file = atoi(name + length + 1);
        return file < scene->file_count ? file : -1;
    }
    return -1;
}

enum result scene_write_copy(const struct scene *scene, enum scene_copy copy, const char *folder, struct error *err)
{
    enum result result = RESULT_OK;
    for (int i = 0; !result && i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        struct writer writer = {
            .scene = scene, .file = file, .rules = &copy_rules[copy], .copy = copy,
            .value_end = -1, .end = file->list.count, .object_end = -1, .moved_pigment = -1};
        /* POV-Ray takes a byte order mark in a scene but not in an include file, which every copy is. */
        if (file->source.size >= 3 && !memcmp(file->source.data, "\xEF\xBB\xBF", 3))
            writer.at = 3;
        char *name = NULL, *path = NULL;
        result = write_tokens(&writer, 0, file->list.count, err);
        if (!result)
            result = copy_to(&writer, file->source.size, err);
        if (!result)
            result = scene_copy_name(scene, copy, i, &name, err);
        if (!result)
            result = text_printf(&path, err, "%s/%s", folder, name);
        if (!result)
            result = file_write(path, &writer.out, err);
        free(name);
        free(path);
        buffer_free(&writer.out);
    }
    return result;
}

enum result scene_declare_states(const struct scene *scene, struct buffer *text, struct error *err)
{
    enum result result = RESULT_OK;
    for (const struct scene_name *name = scene->names.declared; !result && name; name = name->next)
        if (name->facts & NAME_SURFACE && !(name->facts & NAME_SURFACE_ARRAY))
            result = buffer_printf(text, err, "#declare povgloss_of_%d = povgloss_none;\n", name->index);
    return result;
}

enum result scene_save_names(const struct scene *scene, struct buffer *text, struct error *err)
{
    enum result result = RESULT_OK;
    for (const struct scene_name *name = scene->names.declared; !result && name; name = name->next)
        result = buffer_printf(text, err, "#ifdef (%s) #declare povgloss_saved_%d = %s; #end\n", name->text, name->index,
                               name->text);
    return result;
}

enum result scene_restore_names(const struct scene *scene, struct buffer *text, struct error *err)
{
    enum result result = RESULT_OK;
    for (const struct scene_name *name = scene->names.declared; !result && name; name = name->next)
        result = buffer_printf(text, err,
                               "#ifdef (%s) #undef %s #end\n"
                               "#ifdef (povgloss_saved_%d) #declare %s = povgloss_saved_%d; #end\n",
                               name->text, name->text, name->index, name->text, name->index);
    return result;
}
