/* Each file is walked once as it is read; what depends on all files follows in scene_settle. Whether a finish is glossy
 * is left to POV-Ray, since macros and conditions decide it: here it counts what may be.
 */
#include "scene.h"

#include "gbuffer.h"
#include "input_file.h"
#include "lobe.h"
#include "scene_surfaces.h"
#include "scene_tokens.h"
#include "scene_unions.h"
#include "scene_uses.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_FILES = 1000 };

/* Notes that something is glossy with this exponent; negative: it is known to POV-Ray only. */
static void note_exponent(struct scene *scene, double exponent)
{
    if (!scene->glossy)
        scene->exponent = exponent;
    else if (scene->exponent != exponent)
        scene->exponent = -1;
    scene->glossy = true;
}

/* Notes one call of gloss_macros whose name is at `token`. */
static void note_gloss(struct scene *scene, const struct scene_file *file, int token)
{
    double exponent = -1;
    scene->painted |= is_word(file, token, "Gloss_Map");
    if (file->list.tokens[token + 2].kind == TOKEN_NUMBER && is_mark(file, token + 3, ")")) {
        exponent = number_value(file, token + 2);
        if (is_word(file, token, "Gloss_Roughness"))
            exponent = lobe_phong_from_roughness(exponent);
    }
    note_exponent(scene, exponent);
}

/* Whether the finish at this brace calls Gloss, whatever is the case. */
static bool has_gloss(const struct scene_file *file, int brace)
{
    bool gloss = false, conditional = false;
    for (int i = brace + 1; i < file->list.tokens[brace].match; i = next_item(file, i)) {
        gloss |= in_list(file, i, gloss_macros);
        conditional |= file->list.tokens[i].kind == TOKEN_DIRECTIVE;
    }
    return gloss && !conditional;
}

/* A `reflection` makes a plain mirror unless its finish is glossy, or begins with one that is, or it is the number 0. */
static bool is_plain_mirror(const struct scene_file *file, int token)
{
    int brace = file->list.tokens[token].parent;
    if (brace > 0 && is_word(file, block_keyword(file, brace), "photons"))
        return false;
    bool zero = is_zero(file, token + 1);
    if (brace <= 0 || !is_word(file, brace - 1, "finish") || file->list.tokens[brace].match < 0)
        return !zero;
    bool of_glossy = has_fact(file, brace + 1, NAME_GLOSSY) && !has_fact(file, brace + 1, NAME_DULL) &&
                     !has_fact(file, brace + 1, NAME_PARAMETER);
    return !zero && !of_glossy && !has_gloss(file, brace);
}

/* The first assumed_gamma of a scene is the one that POV-Ray takes: which of several that is, only POV-Ray knows. */
static enum result note_gamma(struct scene *scene, const struct scene_file *file, int token, struct error *err)
{
    bool srgb = is_word(file, token + 1, "srgb");
    int end = srgb ? token + 2 : value_end(file, token + 1);
    if (end == token + 1)
        return error_set(err, RESULT_DATA, "%s:%d: assumed_gamma must be a number, an expression or srgb", file->path,
                         file->list.tokens[token].line);
    bool literal = srgb || (file->list.tokens[token + 1].kind == TOKEN_NUMBER && end == token + 2);
    double gamma = srgb ? GBUFFER_GAMMA_SRGB : literal ? number_value(file, token + 1) : 0;
    if (scene->gammas++ == 0)
        scene->working_gamma = gamma;
    scene->needs_discovery |= !literal || scene->working_gamma != gamma;
    return RESULT_OK;
}

static enum result load_file(struct scene *scene, char *path, const char *const *directories, int directory_count,
                             struct error *err);

enum result scene_find_file(const char *name, const char *const *directories, int directory_count, char **path,
                            struct error *err)
{
    *path = NULL;
    for (int i = 0; i < directory_count; i++) {
        enum result result = name[0] == '/' ? text_printf(path, err, "%s", name)
                                            : text_printf(path, err, "%s/%s", directories[i], name);
        if (result || access(*path, R_OK) == 0)
            return result;
        free(*path);
        *path = NULL;
    }
    return RESULT_OK;
}

/* Whether the file's own text opens a file by the same literal name to write it. */
static bool writes_file(const struct scene_file *file, int name)
{
    const struct token *tokens = file->list.tokens;
    size_t length = tokens[name].end - tokens[name].begin;
    for (int i = 0; i < file->list.count - 3; i++)
        if (is_directive(file, i, "fopen") && !is_word(file, i + 3, "read") &&
            tokens[i + 2].end - tokens[i + 2].begin == length &&
            !memcmp(file->source.data + tokens[i + 2].begin, file->source.data + tokens[name].begin, length))
            return true;
    return false;
}

enum result scene_add_file(struct scene *scene, char *path, const char *const *directories, int directory_count,
                           int *index, struct error *err)
{
    for (*index = 0; *index < scene->file_count; ++*index)
        if (!strcmp(scene->files[*index].path, path)) {
            free(path);
            return RESULT_OK;
        }
    return load_file(scene, path, directories, directory_count, err);
}

static enum result follow_include(struct scene *scene, int index, int token, const char *const *directories,
                                  int directory_count, struct error *err)
{
    struct scene_file *file = &scene->files[index];
    const struct token *name = &file->list.tokens[token];
    int end = string_end(file, token), target = -1;
    if (end == token)
        return error_set(err, RESULT_DATA, "%s:%d: an #include must be followed by a file's name", file->path,
                         name->line);
    char *literal = NULL, *path = NULL;
    enum result result = RESULT_OK;
    if (name->kind == TOKEN_STRING && !writes_file(file, token)) {
        result = text_printf(&literal, err, "%.*s", (int)(name->end - name->begin - 2),
                             file->source.data + name->begin + 1);
        if (!result)
            result = scene_find_file(literal, directories, directory_count, &path, err);
        free(literal);
    }
    if (!result && path)
        result = scene_add_file(scene, path, directories, directory_count, &target, err);
    if (result)
        return result;
    file = &scene->files[index];
    struct scene_include *includes =
        realloc(file->includes, ((size_t)file->include_count + 1) * sizeof *file->includes);
    if (!includes)
        return error_memory(err, sizeof *file->includes);
    includes[file->include_count++] = (struct scene_include){.token = token, .end = end, .file = target};
    file->includes = includes;
    return RESULT_OK;
}

/* `X = array[2] { finish {...}, ... }`, at X, with a finish written out in it. */
static bool is_filled_array(const struct scene_file *file, int name)
{
    if (!is_mark(file, name + 1, "=") || !is_word(file, name + 2, "array"))
        return false;
    int token = name + 3;
    while (is_mark(file, token, "[") || is_mark(file, token, "]") || file->list.tokens[token].kind == TOKEN_NUMBER)
        token++;
    bool finish = false;
    for (int i = token; is_mark(file, token, "{") && i < file->list.tokens[token].match; i++)
        finish |= is_word(file, i, "finish");
    return finish;
}

/* `X = texture {...} texture {...}`, at X. */
static bool is_layered(const struct scene_file *file, int name)
{
    return is_mark(file, name + 1, "=") && is_word(file, name + 2, "texture") && opens_block(file, name + 2) &&
           is_word(file, file->list.tokens[name + 3].match + 1, "texture");
}

static const char *const mixing_words[] = {"texture_map", "average", "texture_list", "smooth_triangle", NULL};

/* Whether the components of a blob, whose opening brace this is, may have textures of their own. */
static bool mixes_components(const struct scene_file *file, int brace)
{
    static const char *const looks[] = {"texture", "pigment", "normal", "finish", "material", NULL};
    bool mixes = file->list.tokens[brace].match < 0;
    for (int i = brace + 1; !mixes && i < file->list.tokens[brace].match; i++)
        mixes = is_directive(file, i, "include") || (has_fact(file, i, NAME_DECLARED) && is_call(file, i)) ||
                (file->list.tokens[i].parent != brace && in_list(file, i, looks));
    return mixes;
}

/* `#for (X, 1, 9)` and `#read (File, X, Y)` declare, too. */
static void note_variables(struct scene *scene, const struct scene_file *file, int token)
{
    bool loop = is_directive(file, token, "for");
    if ((!loop && !is_directive(file, token, "read")) || !is_mark(file, token + 1, "("))
        return;
    int last = loop ? token + 3 : file->list.tokens[token + 1].match;
    for (int i = token + 2; i < last; i++)
        if (is_mark(file, i + 1, ",") || is_mark(file, i + 1, ")"))
            note_fact(scene, file, i, NAME_DECLARED);
}

/* What the passes can't hold: a word in a block of this name. */
static const struct limit {
    const char *word, *block, *effect;
} limits[SCENE_LIMIT_COUNT] = {
    [SCENE_LIMIT_EXPONENT] = {"exponent", "reflection", "the exponent of a glossy reflection counts as 1"},
    [SCENE_LIMIT_REFLECTION_EXPONENT] = {"reflection_exponent", "finish",
                                         "the reflection_exponent of a glossy finish counts as 1"},
    [SCENE_LIMIT_IRID] = {"irid", "finish", "irid in a glossy finish doesn't tint its reflection"},
    [SCENE_LIMIT_SAVED_PHOTONS] = {"save_file", "photons",
                                   "photons that the scene saves aren't reflected by glossy surfaces"},
    [SCENE_LIMIT_SUBSURFACE] = {"subsurface", "global_settings",
                                "with subsurface light, glossy surfaces that are seen in a mirror reflect nothing there"},
    [SCENE_LIMIT_MEDIA] = {"media", "interior",
                           "media in an object that the camera is outside of neither dim nor tint the reflection of a glossy "
                           "surface in or behind it"},
};

const char *scene_limit_text(enum scene_limit limit)
{
    return limits[limit].effect;
}

/* Whether the finish at this brace reflects, or may since it begins with a name. */
static bool may_reflect(const struct scene_file *file, int brace)
{
    static const char *const words[] = {"reflection", NULL};
    int last = file->list.tokens[brace].match;
    return has_fact(file, brace + 1, NAME_DECLARED) || mentions(file, brace, last, words) ||
           mentions(file, brace, last, gloss_macros);
}

static void note_limits(struct scene *scene, const struct scene_file *file, int token)
{
    int brace = file->list.tokens[token].parent;
    for (int i = 0; brace > 0 && i < SCENE_LIMIT_COUNT; i++) {
        bool one = file->list.tokens[token + 1].kind == TOKEN_NUMBER && number_value(file, token + 1) == 1;
        if (is_word(file, token, limits[i].word) && is_word(file, brace - 1, limits[i].block) && !one &&
            (strcmp(limits[i].block, "finish") || may_reflect(file, brace)) && !scene->limits[i].line)
            scene->limits[i] =
                (struct scene_place){.file = (int)(file - scene->files), .line = file->list.tokens[token].line};
    }
}

/* A camera made of a mesh has a face for each pixel; image_width and image_height but in a proportion are for something
 * drawn by pixels. */
static bool is_size(const struct scene_file *file, int token)
{
    bool width = is_word(file, token, "image_width"), height = is_word(file, token, "image_height");
    bool first = is_mark(file, token + 1, "/") && is_word(file, token + 2, width ? "image_height" : "image_width");
    bool second = is_mark(file, token - 1, "/") && is_word(file, token - 2, width ? "image_height" : "image_width");
    return is_word(file, token, "mesh_camera") || ((width || height) && !first && !second);
}

static enum result note_token(struct scene *scene, int index, int token, struct error *err)
{
    const struct scene_file *file = &scene->files[index];
    const struct token *tokens = file->list.tokens;
    int name = is_directive(file, token, "fopen") ? token + 1 : declared_name(file, token);
    if (name > 0 && tokens[name].kind == TOKEN_WORD) {
        bool value = is_mark(file, name + 1, "=");
        note_fact(scene, file, name, NAME_DECLARED);
        if (value && is_word(file, name + 2, "light_source"))
            note_fact(scene, file, name, NAME_LIGHT);
        if (is_filled_array(file, name))
            note_fact(scene, file, name, NAME_FILLED_ARRAY);
        if (is_layered(file, name))
            note_fact(scene, file, name, NAME_LAYERED);
        if (value && in_list(file, name + 2, glossy_words))
            note_fact(scene, file, name, NAME_GLOSSABLE);
        bool finish = value && is_word(file, name + 2, "finish") && opens_block(file, name + 2);
        note_fact(scene, file, name, finish && has_gloss(file, name + 3) ? NAME_GLOSSY : NAME_DULL);
        return RESULT_OK;
    }
    note_variables(scene, file, token);
    scene->depends_on_size |= is_size(file, token);
    if (in_list(file, token, highlight_words))
        scene->highlights = true;
    if (is_word(file, token, "radiosity") && opens_block(file, token))
        scene->radiosity = true;
    note_limits(scene, file, token);
    if (is_word(file, token, "aperture"))
        scene->focal_blur = true;
    if (shoots_photons(file, token))
        scene->photons = true;
    if (is_word(file, token, "assumed_gamma"))
        return note_gamma(scene, file, token, err);
    bool own = !strcmp(base_name(file->path), "povgloss.inc");
    if (!own && in_list(file, token, gloss_macros) && is_mark(file, token + 1, "(") &&
        !is_directive(file, token - 1, "macro"))
        note_gloss(scene, file, token);
    static const char *const atmospheres[] = {"fog", "rainbow", "media"};
    for (size_t i = 0; i < sizeof atmospheres / sizeof *atmospheres; i++)
        if (is_word(file, token, atmospheres[i]) && tokens[token].parent < 0 && opens_block(file, token) &&
            !is_mark(file, token - 1, "="))
            scene->atmosphere = atmospheres[i];
    return RESULT_OK;
}

static enum result name_words(struct scene *scene, struct scene_file *file, struct error *err)
{
    enum result result = RESULT_OK;
    for (struct token *token = file->list.tokens; !result && token < file->list.tokens + file->list.count; token++)
        if (token->kind == TOKEN_WORD)
            result = scene_names_add(&scene->names, file->source.data + token->word, token->word_length, &token->name, err);
    return result;
}

static const struct {
    const char *keyword;
    unsigned block;
} blocks[] = {
    {"function", SCENE_BLOCK_PATTERN},
    {"pigment", SCENE_BLOCK_PATTERN},
    {"pigment_map", SCENE_BLOCK_PATTERN},
    {"pigment_pattern", SCENE_BLOCK_PATTERN},
    {"normal", SCENE_BLOCK_PATTERN},
    {"normal_map", SCENE_BLOCK_PATTERN},
    {"slope_map", SCENE_BLOCK_PATTERN},
    {"density", SCENE_BLOCK_PATTERN},
    {"density_map", SCENE_BLOCK_PATTERN},
    {"sky_sphere", SCENE_BLOCK_PATTERN | SCENE_BLOCK_SKY},
    {"camera", SCENE_BLOCK_PATTERN},
    {"finish", SCENE_BLOCK_PATTERN},
    {"texture", SCENE_BLOCK_SURFACE},
    {"texture_map", SCENE_BLOCK_SURFACE},
    {"material", SCENE_BLOCK_SURFACE | SCENE_BLOCK_MATERIAL},
    {"light_group", SCENE_BLOCK_LIGHT_GROUP},
    {"mesh2", SCENE_BLOCK_MESH2},
};

/* What the brace opens. */
static unsigned opened_block(const struct scene_file *file, int brace)
{
    unsigned block = is_mark(file, brace - 1, "]") ? SCENE_BLOCK_ARRAY : 0;
    int keyword = brace > 0 ? block_keyword(file, brace) : -1;
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
        if (is_word(file, keyword, blocks[i].keyword))
            block |= blocks[i].block;
    return block;
}

/* A brace comes before what is in it. */
static void note_blocks(struct scene_file *file)
{
    unsigned around = 0;
    for (int token = 0, brace = -1; token < file->list.count; token++) {
        struct token *tokens = file->list.tokens;
        if (tokens[token].parent != brace) {
            brace = tokens[token].parent;
            around = brace < 0 ? 0 : tokens[brace].around | opened_block(file, brace);
        }
        tokens[token].around = around;
    }
}

/* Takes `path` over. */
static enum result load_file(struct scene *scene, char *path, const char *const *directories, int directory_count,
                             struct error *err)
{
    enum result result = RESULT_OK;
    struct scene_file *files = realloc(scene->files, ((size_t)scene->file_count + 1) * sizeof *files);
    if (!files || scene->file_count >= MAX_FILES) {
        result = files ? error_set(err, RESULT_DATA, "%s: the scene has more than %d files", path, MAX_FILES)
                       : error_memory(err, sizeof *files);
        scene->files = files ? files : scene->files;
        free(path);
        return result;
    }
    scene->files = files;
    int index = scene->file_count++;
    files[index] = (struct scene_file){.path = path};
    struct input_file input;
    result = input_file_read(path, &input, err);
    if (!result)
        result = buffer_add(&files[index].source, input.data, input.size, err);
    input_file_free(&input);
    if (!result)
        result = scene_lex(path, &files[index].source, &files[index].list, err);
    if (!result)
        result = name_words(scene, &files[index], err);
    if (!result)
        note_blocks(&files[index]);
    for (int token = 0; !result && token < scene->files[index].list.count; token++) {
        result = note_token(scene, index, token, err);
        if (!result && is_directive(&scene->files[index], token, "include"))
            result = follow_include(scene, index, token + 1, directories, directory_count, err);
    }
    return result;
}

static const char *const clear_words[] = {"rgbt",   "rgbf",     "rgbft",  "srgbt",     "srgbf",
                                          "srgbft", "transmit", "filter", "image_map", NULL};

/* Whether the token names a transparent colour, an image, or something that was declared with one. */
static bool names_clear(const struct scene_file *file, int token)
{
    return in_list(file, token, clear_words) || has_fact(file, token, NAME_CLEAR);
}

static enum result count_clear(struct scene *scene, struct error *err)
{
    for (int i = 0; i < scene->file_count; i++) {
        struct scene_file *file = &scene->files[i];
        size_t size = ((size_t)file->list.count + 1) * sizeof *file->clear;
        file->clear = calloc(1, size);
        if (!file->clear)
            return error_memory(err, (double)size);
        for (int token = 0; token < file->list.count; token++)
            file->clear[token + 1] = file->clear[token] + names_clear(file, token);
        for (int token = 0; token < file->list.count; token++)
            scene->clear_default |= (is_directive(file, token, "default") || is_word(file, token, "default")) &&
                                    opens_block(file, token) &&
                                    may_be_clear(file, token + 2, file->list.tokens[token + 1].match);
    }
    return RESULT_OK;
}

/* Whether one of the tokens is transparent, as far as it is known. */
static bool says_clear(const struct scene_file *file, int first, int end)
{
    bool clear = false;
    for (int token = first; token < end; token++)
        clear |= names_clear(file, token);
    return clear;
}

/* Notes that the parameter number `position` of the macros of that name may be transparent. */
static void note_clear_parameter(struct scene *scene, const struct scene_name *macro, int position)
{
    for (int i = 0; i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        for (int token = 1; token < file->list.count; token++) {
            if (name_at(file, token) != macro || !is_directive(file, token - 1, "macro") ||
                !has_parentheses(file, token))
                continue;
            int last = file->list.tokens[token + 1].match, parameter = token + 2;
            for (int skip = position; skip > 0 && parameter < last; skip--)
                parameter = argument_end(file, parameter, last) + 1;
            if (parameter < last)
                note_fact(scene, file, parameter, NAME_CLEAR);
        }
    }
}

/* The parameters of a macro; a file that isn't rewritten may give them anything. */
static void note_parameters(struct scene *scene, const struct scene_file *file, int name)
{
    const bool anything = scene_includes_as_it_is(scene);
    int last = is_mark(file, name + 1, "(") ? file->list.tokens[name + 1].match : -1;
    for (int token = name + 2; token < last; token++) {
        note_fact(scene, file, token, NAME_PARAMETER);
        if (anything)
            note_fact(scene, file, token, NAME_CLEAR);
    }
}

/* What a call gives to them. */
static void note_arguments(struct scene *scene, const struct scene_file *file, int token)
{
    int last = file->list.tokens[token + 1].match;
    for (int argument = token + 2, end, position = 0; argument < last; argument = end + 1, position++) {
        end = argument_end(file, argument, last);
        if (says_clear(file, argument, end))
            note_clear_parameter(scene, name_at(file, token), position);
    }
}

/* Notes whether the name that the directive at `token` declares may be transparent. */
static void note_clear_name(struct scene *scene, const struct scene_file *file, int token)
{
    bool macro = is_directive(file, token, "macro");
    int name = declared_name(file, token);
    if (has_fact(file, token, NAME_DECLARED) && is_call(file, token))
        note_arguments(scene, file, token);
    if (!name_at(file, name))
        return;
    if (macro)
        note_parameters(scene, file, name);
    int last = macro ? end_of_macro(file, token) : last_of_value(file, name + 1);
    if (says_clear(file, name + 1, last + 1))
        note_fact(scene, file, name, NAME_CLEAR);
}

/* Finds the names through which a pigment may be transparent: those declared with a transparent colour or an image, or
 * with such a name, and the parameters of macros that are called with one. */
static void note_clear_names(struct scene *scene, const struct scene_file *file)
{
    for (int token = 0; token < file->list.count - 1; token++)
        note_clear_name(scene, file, token);
}

/* Notes what matters only in what the scene uses. */
static void note_used_token(struct scene *scene, const struct scene_file *file, int token)
{
    scene->plain_mirrors |= is_word(file, token, "reflection") && is_plain_mirror(file, token);
    scene->refracts |= is_word(file, token, "ior");
    scene->mixes |= in_list(file, token, mixing_words) || (is_word(file, token, "blob") && is_mark(file, token + 1, "{") &&
                                                           mixes_components(file, token + 1));
    /* What is transparent in no braces is a value, to be used by its name. */
    scene->may_be_clear |= may_be_clear(file, token, token) && file->list.tokens[token].parent >= 0 &&
                           !inside(file, token, SCENE_BLOCK_SKY);
}

/* Notes what the user chose to be glossy. */
static enum result note_choice(struct scene *scene, const struct gloss_choice *choice, struct error *err)
{
    for (int i = 0; i < choice->name_count; i++) {
        const struct scene_name *name = scene_names_find(&scene->names, choice->names[i].name);
        if (!name || !(name->facts & NAME_GLOSSABLE))
            return error_set(err, RESULT_DATA,
                             "%s: no finish, texture or material is declared by the name %s: `povgloss list` shows those "
                             "that reflect",
                             scene->files[0].path, choice->names[i].name);
        note_exponent(scene, choice->names[i].exponent);
    }
    if (scene->plain_mirrors && choice->all)
        note_exponent(scene, choice->all_exponent);
    if (scene->plain_mirrors && choice->automatic && scene->highlights)
        note_exponent(scene, -1);
    return RESULT_OK;
}

void scene_note_facts(struct scene *scene, void (*note)(struct scene *scene, const struct scene_file *file))
{
    int before;
    do {
        before = scene->names.facts;
        for (int i = 0; i < scene->file_count; i++)
            note(scene, &scene->files[i]);
    } while (scene->names.facts != before);
}

bool scene_has_unknown_include(const struct scene_file *file)
{
    for (int i = 0; i < file->include_count; i++)
        if (file->includes[i].file < 0)
            return true;
    return false;
}

/* Finds the macros that the scene may call: outside macros, or in one of them. */
static void note_called(struct scene *scene, const struct scene_file *file)
{
    struct nesting nesting = {0};
    for (int token = 0; token < file->list.count; token++) {
        nest(&nesting, file, token);
        if (is_mark(file, token + 1, "(") && has_fact(file, token, NAME_DECLARED) && token != nesting.macro &&
            (!nesting.macro || has_fact(file, nesting.macro, NAME_CALLED)))
            note_fact(scene, file, token, NAME_CALLED);
    }
}

/* An include whose file isn't known matters unless it stands in a macro that is never called. */
static void note_unknown_includes(struct scene *scene)
{
    bool unknown = false;
    for (int i = 0; i < scene->file_count; i++)
        unknown |= scene_has_unknown_include(&scene->files[i]);
    if (!unknown)
        return;
    scene_note_facts(scene, note_called);
    for (int i = 0; i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        struct nesting nesting = {0};
        for (int token = 0, include = 0; include < file->include_count; token++) {
            nest(&nesting, file, token);
            if (token != file->includes[include].token)
                continue;
            if (file->includes[include++].file < 0 && (!nesting.macro || has_fact(file, nesting.macro, NAME_CALLED)))
                scene->needs_discovery = true;
        }
    }
}

bool scene_includes_as_it_is(const struct scene *scene)
{
    for (int i = 0; i < scene->found_count; i++)
        if (scene->found[i].file < 0)
            return true;
    return false;
}

double scene_default_gamma(const struct scene *scene)
{
    return scene->version >= 3.7 ? 1 : GBUFFER_GAMMA_SRGB;
}

enum result scene_settle(struct scene *scene, struct error *err)
{
    scene_note_surfaces(scene);
    scene_note_facts(scene, note_clear_names);
    scene_note_uses(scene);
    scene->may_be_clear = scene_includes_as_it_is(scene);
    enum result result = count_clear(scene, err);
    if (!result)
        scene_walk_used(scene, note_used_token);
    if (!result)
        result = scene_note_unions(scene, err);
    return result ? result : note_choice(scene, scene->choice, err);
}

enum result scene_load(struct scene *scene, const char *path, const struct gloss_choice *choice,
                       const char *const *directories, int directory_count, struct error *err)
{
    *scene = (struct scene){.choice = choice, .exponent = -1};
    char *copy = strdup(path);
    if (!copy)
        return error_memory(err, (double)strlen(path));
    enum result result = load_file(scene, copy, directories, directory_count, err);
    if (result)
        return result;
    const struct scene_file *main_file = &scene->files[0];
    for (int token = 0; scene->version == 0 && token < main_file->list.count - 1; token++)
        if (is_directive(main_file, token, "version") && main_file->list.tokens[token + 1].kind == TOKEN_NUMBER)
            scene->version = number_value(main_file, token + 1);
    if (scene->gammas == 0)
        scene->working_gamma = scene_default_gamma(scene);
    note_unknown_includes(scene);
    return scene->needs_discovery ? RESULT_OK : scene_settle(scene, err);
}

void scene_free(struct scene *scene)
{
    for (int i = 0; i < scene->file_count; i++) {
        free(scene->files[i].path);
        free(scene->files[i].includes);
        buffer_free(&scene->files[i].source);
        token_list_free(&scene->files[i].list);
        free(scene->files[i].clear);
        free(scene->files[i].object_unions);
    }
    free(scene->files);
    for (int i = 0; i < scene->found_count; i++)
        free(scene->found[i].name);
    free(scene->found);
    scene_names_free(&scene->names);
    *scene = (struct scene){0};
}
