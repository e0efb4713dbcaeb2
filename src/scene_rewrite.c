/* Reading: the files of a scene, and the facts that decide which passes it needs.
 * Rewriting: a table of rules for each kind of copy, and one walk over the tokens that copies the source and replaces
 * blocks.
 *
 * The places of finishes, textures and lights are found by tokens; whether a finish is glossy is left to POV-Ray, through
 * the marks, since macros and conditions decide it.
 */
#include "scene_rewrite.h"

#include "gbuffer.h"
#include "input_file.h"
#include "lobe.h"
#include "scene_tokens.h"

#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { MAX_FILES = 1000, MAX_CONDITIONS = 256 };

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
    bool marks;           /* povgloss_begin and povgloss_end in finishes */
    bool pigments;        /* pigments become povgloss_pigment */
    bool opaque;          /* filter and transmit become 0 */
    bool coded;           /* textures are taken off */
    bool technical;       /* linear working space, no photons, no radiosity */
    bool discovery;       /* includes and assumed_gamma are written to the log */
};

static const struct rules copy_rules[SCENE_COPY_COUNT] = {
    [SCENE_COPY_PLAIN] = {"plain", STATEMENTS_BREAK, .lights = true},
    [SCENE_COPY_BASE] = {"base", STATEMENTS_STAY, .lights = true, .marks = true},
    [SCENE_COPY_BASE_SECOND] = {"base2", STATEMENTS_DROP, .marks = true},
    [SCENE_COPY_MIRROR] = {"mirror", STATEMENTS_CAMERA, .marks = true, .pigments = true, .technical = true},
    [SCENE_COPY_MIRROR_SECOND] = {"mirror2", STATEMENTS_DROP, .marks = true, .pigments = true, .technical = true},
    [SCENE_COPY_REFLECTANCE] = {"reflectance", STATEMENTS_CAMERA, .marks = true, .opaque = true},
    [SCENE_COPY_CODED] = {"coded", STATEMENTS_CAMERA, .coded = true, .technical = true},
    [SCENE_COPY_DISCOVERY] = {"discovery", STATEMENTS_STAY, .lights = true, .discovery = true},
};

/* The token that says what kind of block an opening brace begins: `union {`, `function (x, y) {`, `function 9, 9 {`. */
static int block_keyword(const struct scene_file *file, int brace)
{
    int token = brace - 1;
    if (is_mark(file, token, ")") && file->list.tokens[token].match > 0)
        token = file->list.tokens[token].match - 1;
    while (token > 0 && (file->list.tokens[token].kind == TOKEN_NUMBER || is_mark(file, token, ",")))
        token--;
    return token;
}

static bool mentions(const struct scene_file *file, int first, int end, const char *const *words)
{
    for (int token = first; token < end; token++)
        if (in_list(file, token, words))
            return true;
    return false;
}

/* Whether the token lies in the braces that fill an array, where POV-Ray takes no directive and no macro. */
static bool fills_array(const struct scene_file *file, int token)
{
    for (int brace = file->list.tokens[token].parent; brace >= 0; brace = file->list.tokens[brace].parent)
        if (is_mark(file, brace - 1, "]"))
            return true;
    return false;
}

static bool inside(const struct scene_file *file, int token, const char *keyword)
{
    for (int brace = file->list.tokens[token].parent; brace >= 0; brace = file->list.tokens[brace].parent)
        if (brace > 0 && is_word(file, block_keyword(file, brace), keyword))
            return true;
    return false;
}

/* ---- reading ---- */

/* Notes that something is glossy with this exponent; negative: it is known to POV-Ray only. */
static void note_exponent(struct scene *scene, double exponent)
{
    if (!scene->glossy)
        scene->exponent = exponent;
    else if (scene->exponent != exponent)
        scene->exponent = -1;
    scene->glossy = true;
}

/* Notes one call Gloss(p) or Gloss_Roughness(r) whose name is at `token`. */
static void note_gloss(struct scene *scene, const struct scene_file *file, int token)
{
    double exponent = -1;
    if (file->list.tokens[token + 2].kind == TOKEN_NUMBER && is_mark(file, token + 3, ")")) {
        exponent = number_value(file, token + 2);
        if (is_word(file, token, "Gloss_Roughness"))
            exponent = lobe_phong_from_roughness(exponent);
    }
    note_exponent(scene, exponent);
}

/* A `reflection` makes a plain mirror unless its finish is glossy or it is the number 0. */
static bool is_plain_mirror(const struct scene_file *file, int token)
{
    int brace = file->list.tokens[token].parent;
    if (brace > 0 && is_word(file, block_keyword(file, brace), "photons"))
        return false;
    bool zero = is_zero(file, token + 1);
    if (brace <= 0 || !is_word(file, brace - 1, "finish") || file->list.tokens[brace].match < 0)
        return !zero;
    bool gloss = false, conditional = false;
    for (int i = brace; i < file->list.tokens[brace].match; i++) {
        gloss |= is_word(file, i, "Gloss") || is_word(file, i, "Gloss_Roughness");
        conditional |= file->list.tokens[i].kind == TOKEN_DIRECTIVE;
    }
    return !zero && (!gloss || conditional);
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

/* The path of an include file, which the caller frees; *path is NULL when it isn't in any of the directories. */
static enum result find_include(const char *name, const char *const *directories, int directory_count, char **path,
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

/* The token after the string expression that begins at `token`. */
static int string_end(const struct scene_file *file, int token)
{
    if (file->list.tokens[token].kind == TOKEN_STRING)
        return token + 1;
    return file->list.tokens[token].kind == TOKEN_WORD ? value_end(file, token) : token;
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

/* Takes `path` over, and gives the index of the file, which is read if it is new. */
static enum result find_or_load(struct scene *scene, char *path, const char *const *directories, int directory_count,
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
            result = find_include(literal, directories, directory_count, &path, err);
        free(literal);
    }
    if (!result && path)
        result = find_or_load(scene, path, directories, directory_count, &target, err);
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

/* `X = array[2] { finish {...}, ... }`, at X. */
static bool is_filled_array(const struct scene_file *file, int name)
{
    if (!is_mark(file, name + 1, "=") || !is_word(file, name + 2, "array"))
        return false;
    int token = name + 3;
    while (is_mark(file, token, "[") || is_mark(file, token, "]") || file->list.tokens[token].kind == TOKEN_NUMBER)
        token++;
    return is_mark(file, token, "{");
}

/* `X = texture {...} texture {...}`, at X. */
static bool is_layered(const struct scene_file *file, int name)
{
    return is_mark(file, name + 1, "=") && is_word(file, name + 2, "texture") && opens_block(file, name + 2) &&
           is_word(file, file->list.tokens[name + 3].match + 1, "texture");
}

/* What may follow the = of a name that can be made glossy. */
static const char *const glossy_words[] = {"finish", "texture", "material", NULL};

/* The items of a finish whose values are the lobe of a highlight. */
static const char *const highlight_words[] = {"phong_size", "roughness", NULL};

static enum result note_token(struct scene *scene, int index, int token, struct error *err)
{
    const struct scene_file *file = &scene->files[index];
    const struct token *tokens = file->list.tokens;
    bool declares = is_directive(file, token, "declare") || is_directive(file, token, "local") ||
                    is_directive(file, token, "macro") || is_directive(file, token, "fopen");
    if (declares && tokens[token + 1].kind == TOKEN_WORD) {
        enum result result = add_name(&scene->names, file, token + 1, err);
        if (!result && is_mark(file, token + 2, "=") && is_word(file, token + 3, "light_source"))
            result = add_name(&scene->lights, file, token + 1, err);
        if (!result && is_filled_array(file, token + 1))
            result = add_name(&scene->arrays, file, token + 1, err);
        if (!result && is_layered(file, token + 1))
            result = add_name(&scene->layered, file, token + 1, err);
        if (!result && is_mark(file, token + 2, "=") && in_list(file, token + 3, glossy_words))
            result = add_name(&scene->glossable, file, token + 1, err);
        return result;
    }
    if (is_word(file, token, "reflection") && is_plain_mirror(file, token))
        scene->plain_mirrors = true;
    if (in_list(file, token, highlight_words))
        scene->highlights = true;
    if (is_word(file, token, "aperture"))
        scene->focal_blur = true;
    if (is_word(file, token, "assumed_gamma"))
        return note_gamma(scene, file, token, err);
    bool own = !strcmp(base_name(file->path), "povgloss.inc");
    if (!own && (is_word(file, token, "Gloss") || is_word(file, token, "Gloss_Roughness")) &&
        is_mark(file, token + 1, "(") && !is_directive(file, token - 1, "macro"))
        note_gloss(scene, file, token);
    static const char *const atmospheres[] = {"fog", "rainbow", "media"};
    for (size_t i = 0; i < sizeof atmospheres / sizeof *atmospheres; i++)
        if (is_word(file, token, atmospheres[i]) && tokens[token].parent < 0 && opens_block(file, token) &&
            !is_mark(file, token - 1, "="))
            scene->atmosphere = atmospheres[i];
    return RESULT_OK;
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
    for (int token = 0; !result && token < scene->files[index].list.count; token++) {
        result = note_token(scene, index, token, err);
        if (!result && is_directive(&scene->files[index], token, "include"))
            result = follow_include(scene, index, token + 1, directories, directory_count, err);
    }
    return result;
}

static bool has_name(const struct buffer *names, const char *name)
{
    for (size_t at = 0; at < names->size; at += strlen(names->data + at) + 1)
        if (!strcmp(names->data + at, name))
            return true;
    return false;
}

/* Notes what the user chose to be glossy. */
static enum result note_choice(struct scene *scene, const struct gloss_choice *choice, struct error *err)
{
    for (int i = 0; i < choice->name_count; i++) {
        if (!has_name(&scene->glossable, choice->names[i].name))
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

static bool has_unknown_include(const struct scene_file *file)
{
    for (int i = 0; i < file->include_count; i++)
        if (file->includes[i].file < 0)
            return true;
    return false;
}

/* Adds to `called`, which names macros that the scene may call, those that one of them may call in turn. */
static enum result add_called(const struct scene *scene, struct buffer *called, struct error *err)
{
    enum result result = RESULT_OK;
    size_t before;
    do {
        before = called->size;
        for (int i = 0; !result && i < scene->file_count; i++) {
            const struct scene_file *file = &scene->files[i];
            struct nesting nesting = {0};
            for (int token = 0; !result && token < file->list.count; token++) {
                nest(&nesting, file, token);
                if (is_mark(file, token + 1, "(") && find_name(&scene->names, file, token) >= 0 &&
                    token != nesting.macro &&
                    (!nesting.macro || find_name(called, file, nesting.macro) >= 0))
                    result = add_name(called, file, token, err);
            }
        }
    } while (!result && called->size > before);
    return result;
}

/* An include whose file isn't known matters unless it stands in a macro that is never called. */
static enum result note_unknown_includes(struct scene *scene, struct error *err)
{
    bool unknown = false;
    for (int i = 0; i < scene->file_count; i++)
        unknown |= has_unknown_include(&scene->files[i]);
    if (!unknown)
        return RESULT_OK;
    struct buffer called = {0};
    enum result result = add_called(scene, &called, err);
    for (int i = 0; !result && i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        struct nesting nesting = {0};
        for (int token = 0, include = 0; include < file->include_count; token++) {
            nest(&nesting, file, token);
            if (token != file->includes[include].token)
                continue;
            if (file->includes[include++].file < 0 && (!nesting.macro || find_name(&called, file, nesting.macro) >= 0))
                scene->needs_discovery = true;
        }
    }
    buffer_free(&called);
    return result;
}

/* What holds in a scene that says nothing. */
static double default_gamma(const struct scene *scene)
{
    return scene->version >= 3.7 ? 1 : GBUFFER_GAMMA_SRGB;
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
    if (is_directive(main_file, 0, "version") && main_file->list.tokens[1].kind == TOKEN_NUMBER)
        scene->version = number_value(main_file, 1);
    if (scene->gammas == 0)
        scene->working_gamma = default_gamma(scene);
    result = note_unknown_includes(scene, err);
    return result || scene->needs_discovery ? result : note_choice(scene, choice, err);
}

static const struct scene_found *find_found(const struct scene *scene, const char *name)
{
    for (int i = 0; i < scene->found_count; i++)
        if (!strcmp(scene->found[i].name, name))
            return &scene->found[i];
    return NULL;
}

/* An entry of the log: `include F T NAME`, `write F T NAME` or `gamma F T VALUE`; F is a file and T a token of it. */
struct log_entry {
    char kind; /* its first letter */
    int file, line;
    char *value;
};

/* Reads what was included; `changes` says that it may not always have been the same. */
static enum result add_found(struct scene *scene, const struct log_entry *entry, bool changes, const char *folder,
                             const char *const *directories, int directory_count, struct error *err)
{
    const char *name = entry->value;
    struct scene_found *found = realloc(scene->found, ((size_t)scene->found_count + 1) * sizeof *found);
    if (!found)
        return error_memory(err, sizeof *found);
    scene->found = found;
    found += scene->found_count;
    *found = (struct scene_found){.name = strdup(name), .file = scene->file_count};
    if (!found->name)
        return error_memory(err, (double)strlen(name));
    scene->found_count++;
    char *path;
    enum result result = find_include(name, &folder, 1, &path, err);
    bool written = !result && path && name[0] != '/';
    if (!result && !path)
        result = find_include(name, directories, directory_count, &path, err);
    if (result)
        return result;
    if (!path)
        return error_set(err, RESULT_DATA,
                         "%s:%d: %s, which this #include names, isn't found: write the whole name of a file in the "
                         "scene's folder or in one of +L",
                         scene->files[entry->file].path, entry->line, name);
    if (!written)
        return find_or_load(scene, path, directories, directory_count, &found->file, err);
    result = load_file(scene, path, directories, directory_count, err);
    if (result)
        return result;
    struct scene_file *file = &scene->files[found->file];
    file->written = true;
    strcpy(file->path, name);
    /* What was in it before is gone. */
    if (changes && memchr(file->source.data, '{', file->source.size))
        return error_set(err, RESULT_DATA,
                         "%s:%d: %s is written by the scene itself more than once, and may hold something else each "
                         "time that it is included: write several files",
                         scene->files[entry->file].path, entry->line, name);
    if (changes)
        scene->found[scene->found_count - 1].file = -1;
    return RESULT_OK;
}

/* Cuts the next entry off at *text, which it changes; false where there is none, or another line. */
static bool next_entry(const struct scene *scene, char **text, struct log_entry *entry)
{
    int token, length = 0;
    char *at = *text, *end = strchr(at, '\n');
    entry->kind = *at;
    if (!strchr("giw", *at) || sscanf(at, "%*s %d %d %n", &entry->file, &token, &length) != 2)
        return false;
    if (!end || !length || entry->file < 0 || entry->file >= scene->file_count || token < 0 ||
        token >= scene->files[entry->file].list.count)
        return false;
    *end = 0;
    *text = end + 1;
    entry->line = scene->files[entry->file].list.tokens[token].line;
    entry->value = at + length;
    return true;
}

/* The number of entries of a kind with this value. */
static int count_entries(const struct scene *scene, const struct input_file *log, char kind, const char *value)
{
    int count = 0;
    char *copy = strndup((const char *)log->data, log->size), *at = copy;
    struct log_entry entry;
    while (copy && next_entry(scene, &at, &entry))
        count += entry.kind == kind && !strcmp(entry.value, value);
    free(copy);
    return count;
}

static enum result take_entries(struct scene *scene, const struct input_file *log, const char *folder,
                                const char *const *directories, int directory_count, struct error *err)
{
    char *text = strndup((const char *)log->data, log->size), *at = text;
    if (!text)
        return error_memory(err, (double)log->size);
    enum result result = RESULT_OK;
    struct log_entry entry;
    bool settled = false;
    scene->working_gamma = default_gamma(scene);
    while (!result && next_entry(scene, &at, &entry)) {
        if (entry.kind == 'g' && !settled) {
            settled = true;
            scene->working_gamma = strcmp(entry.value, "srgb") ? strtod(entry.value, NULL) : GBUFFER_GAMMA_SRGB;
        } else if (entry.kind == 'i' && !find_found(scene, entry.value)) {
            bool changes = count_entries(scene, log, 'i', entry.value) > 1 &&
                           count_entries(scene, log, 'w', entry.value) > 1;
            result = add_found(scene, &entry, changes, folder, directories, directory_count, err);
        }
    }
    free(text);
    return result;
}

enum result scene_discover(struct scene *scene, const char *folder, const char *const *directories,
                           int directory_count, bool *again, struct error *err)
{
    int files = scene->file_count, gammas = scene->gammas;
    char *path;
    struct input_file log = {0};
    enum result result = text_printf(&path, err, "%s/" SCENE_DISCOVERY_LOG, folder);
    if (!result)
        result = input_file_read(path, &log, err);
    if (!result)
        result = take_entries(scene, &log, folder, directories, directory_count, err);
    *again = scene->gammas > gammas;
    for (int i = files; i < scene->file_count; i++)
        *again |= has_unknown_include(&scene->files[i]);
    if (!result && !*again)
        result = note_choice(scene, scene->choice, err);
    input_file_free(&log);
    free(path);
    return result;
}

void scene_free(struct scene *scene)
{
    for (int i = 0; i < scene->file_count; i++) {
        free(scene->files[i].path);
        free(scene->files[i].includes);
        buffer_free(&scene->files[i].source);
        token_list_free(&scene->files[i].list);
    }
    free(scene->files);
    for (int i = 0; i < scene->found_count; i++)
        free(scene->found[i].name);
    free(scene->found);
    buffer_free(&scene->names);
    buffer_free(&scene->lights);
    buffer_free(&scene->arrays);
    buffer_free(&scene->layered);
    buffer_free(&scene->glossable);
    *scene = (struct scene){0};
}

/* ---- rewriting ---- */

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
    bool given;      /* in the declaration of a name that the user chose to be glossy */
    bool in_macro;
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

/* Whether leaving the tokens out would change what follows: they declare something, draw random numbers or call a macro. */
static bool has_effects(const struct writer *writer, int first, int last)
{
    for (int i = first; i <= last; i++)
        if (writer->file->list.tokens[i].kind == TOKEN_DIRECTIVE || is_word(writer->file, i, "rand") ||
            (is_mark(writer->file, i + 1, "(") && find_name(&writer->scene->names, writer->file, i) >= 0))
            return true;
    return false;
}

/* Puts `text` in place of the block `keyword { ... }` from `token` to `last`. One with effects is declared in front of it
 * (an interior_texture as a texture), so that every copy of the scene draws the same random numbers. */
static enum result replace_block(struct writer *writer, int token, int last, const char *text, struct error *err)
{
    if (!has_effects(writer, token + 1, last))
        return replace(writer, token, last, text, err);
    enum result result = insert_before(writer, token, "#declare povgloss_dropped = ", err);
    if (!result)
        result = is_word(writer->file, token, "interior_texture") ? replace(writer, token, token, "texture", err)
                                                                  : RESULT_OK;
    if (!result)
        result = insert_after(writer, last, "; ", err);
    return result ? result : buffer_add_text(&writer->out, text, err);
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
    if (!result && settings && writer->rules->technical)
        result = write_technical_settings(writer, token + 2, last, err);
    if (!result && settings && writer->rules->discovery)
        result = write_gamma_log(writer, token + 2, last, err);
    if (!result && camera && writer->scene->focal_blur)
        result = insert_before(writer, last, " povgloss_camera() ", err);
    if (!result && statements != STATEMENTS_STAY)
        return insert_after(writer, last, " union { povgloss_nothing()", err);
    return result ? result : copy_to(writer, writer->file->list.tokens[last].end, err);
}

/* A finish or texture that begins with a declared name takes over that one's state (pass_scene.c), which is kept in a
 * variable povgloss_of_N beside each name (N being its index, as names may be as long as POV-Ray allows). */
static enum result inherit_gloss(struct writer *writer, int token, const char *variable, struct error *err)
{
    int name = find_name(&writer->scene->names, writer->file, token);
    if (name < 0 || is_mark(writer->file, token + 1, "["))
        return RESULT_OK;
    enum result result = copy_to(writer, writer->file->list.tokens[token].end, err);
    return result ? result
                  : buffer_printf(&writer->out, err, " #ifdef (povgloss_of_%d) #declare %s = povgloss_of_%d; #end", name,
                                  variable, name);
}

static enum result write_finish(struct writer *writer, int token, int last, struct error *err)
{
    int brace = writer->file->list.tokens[token].parent;
    bool in_texture = brace > 0 && is_word(writer->file, brace - 1, "texture");
    enum result result = insert_after(
        writer, token + 1, in_texture ? " povgloss_begin(povgloss_texture) " : " povgloss_begin(povgloss_none) ", err);
    if (!result)
        result = inherit_gloss(writer, token + 2, "povgloss_state", err);
    /* An element of a filled array comes unmarked. */
    if (!result && find_name(&writer->scene->arrays, writer->file, token + 2) >= 0)
        result = buffer_add_text(&writer->out, " #declare povgloss_reflects = 1; ", err);
    if (!result)
        result = write_tokens(writer, token + 2, last, err);
    if (!result)
        result = insert_before(writer, last, " povgloss_end() ", err);
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

static enum result write_texture(struct writer *writer, int token, int last, bool upper, struct error *err)
{
    enum result result = insert_after(writer, token + 1, " #declare povgloss_texture = povgloss_none;", err);
    if (!result)
        result = inherit_gloss(writer, token + 2, "povgloss_texture", err);
    if (!result)
        result = buffer_add_text(&writer->out, " #declare povgloss_last = povgloss_texture; ", err);
    if (!result)
        result = write_tokens(writer, token + 2, last, err);
    if (!result && find_name(&writer->scene->arrays, writer->file, token + 2) >= 0)
        result = insert_before(writer, last,
                               " finish { povgloss_begin(povgloss_none) #declare povgloss_reflects = 1; povgloss_end() } ", err);
    if (!result && writer->given && !mentions(writer->file, token + 2, last, finish_carriers))
        result = insert_before(writer, last, " finish { povgloss_begin(povgloss_texture) povgloss_end() } ", err);
    /* Nothing shows through an opaque layer, but a layer that isn't glossy must not hide a glossy one below. */
    if (!result && upper && writer->rules->pigments && find_name(&writer->scene->layered, writer->file, token + 2) < 0)
        result = insert_before(writer, last, " #if (povgloss_exponent(povgloss_last) < 0) pigment { rgbt 1 } #end ", err);
    return result;
}

/* After `#declare X = finish {...}` or the last layer of `#declare X = texture {...}`: remembers whether X is glossy. */
static enum result remember_gloss(struct writer *writer, int name_token, int last, struct error *err)
{
    int name = find_name(&writer->scene->names, writer->file, name_token), end = last + is_mark(writer->file, last + 1, ";");
    if (name < 0 || is_word(writer->file, last + 1, "texture"))
        return RESULT_OK;
    enum result result = copy_to(writer, writer->file->list.tokens[end].end, err);
    return result ? result : buffer_printf(&writer->out, err, " #declare povgloss_of_%d = povgloss_last; ", name);
}

static const char *const statement_words[] = {"camera",     "global_settings", "background", "fog",
                                              "sky_sphere", "rainbow",         NULL};
static const char *const texture_words[] = {"texture",  "pigment", "finish", "normal", "material", "interior_texture",
                                            "interior", NULL};

/* A light that the copy must not have twice goes, unless it brings an object along (looks_like): then it stays, and fades to
 * nothing within any distance; a declared light takes no such item and stays in a group in which it lights nothing else. */
static enum result write_light(struct writer *writer, int token, int last, struct error *err)
{
    const struct scene_file *file = writer->file;
    if (find_name(&writer->scene->lights, file, token + 2) >= 0) {
        enum result result = insert_before(writer, token, "light_group { ", err);
        return result ? result : insert_after(writer, last, " global_lights on }", err);
    }
    bool stays = has_effects(writer, token + 1, last);
    for (int i = token + 2; i < last; i++)
        stays |= is_word(file, i, "looks_like");
    if (!stays)
        return replace(writer, token, last, "", err);
    enum result result = write_tokens(writer, token + 2, last, err);
    return result ? result : insert_before(writer, last, " fade_distance 1e-9 fade_power 20 ", err);
}

static bool is_declared_light(const struct writer *writer, int token)
{
    return is_word(writer->file, token, "object") && find_name(&writer->scene->lights, writer->file, token + 2) >= 0;
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
        result = finish ? write_finish(writer, token, last, err)
                 : material ? write_tokens(writer, token + 2, last, err)
                            : write_texture(writer, token, last, is_layer(file, token), err);
    if (!result && choice) {
        writer->given = false;
        result = insert_before(writer, last, " #declare povgloss_given = -1; ", err);
    }
    if (!result && name >= 0 && !material)
        result = remember_gloss(writer, name, last, err);
    return result ? result : copy_to(writer, file->list.tokens[last].end, err);
}

/* Writes the block `keyword { ... }` whose keyword is at `token` if it is changed by the rules; *next is then the token
 * after it, else 0. */
static enum result write_block(struct writer *writer, int token, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    const struct rules *rules = writer->rules;
    int brace = token + 1, last = file->list.tokens[brace].match;
    bool value = is_mark(file, token - 1, "=") || (token == writer->value_end && is_word(file, token, "texture"));
    if (is_mark(file, token - 1, "="))
        writer->value_name = token - 2;
    if (value)
        writer->value_end = last + 1;
    *next = last + 1;
    bool top = file->list.tokens[token].parent < 0 && !value;
    if (top && (in_list(file, token, statement_words) || (is_word(file, token, "media") && !writer->in_macro)))
        return write_statement(writer, token, last, err);
    if (is_word(file, token, "camera") || is_word(file, token, "function"))
        return copy_to(writer, file->list.tokens[last].end, err);
    bool unlit = !rules->lights && !value && !inside(file, token, "light_group");
    if (unlit && is_word(file, token, "light_source"))
        return write_light(writer, token, last, err);
    if (unlit && is_declared_light(writer, token))
        return replace(writer, token, last, "", err);
    if (rules->marks && in_list(file, token, glossy_words) && !fills_array(file, token))
        return write_marked(writer, token, last, value ? writer->value_name : -1, err);
    if (rules->pigments && !value && is_word(file, token, "pigment") && !inside(file, token, "function"))
        return replace_block(writer, token, last, "pigment { povgloss_pigment }", err);
    if (rules->coded && is_word(file, token, "texture_list"))
        return error_set(err, RESULT_DATA,
                         "%s:%d: a mesh2 with a texture_list can't be taken yet: split it into one mesh for each texture",
                         file->path, file->list.tokens[token].line);
    if (rules->coded && in_list(file, token, texture_words)) {
        if (value || fills_array(file, token))
            return copy_to(writer, file->list.tokens[last].end, err);
        int parent = file->list.tokens[token].parent;
        bool triangle =
            parent > 0 && (is_word(file, parent - 1, "triangle") || is_word(file, parent - 1, "smooth_triangle"));
        return replace_block(writer, token, last, triangle ? "" : "transform {}", err);
    }
    *next = 0;
    return RESULT_OK;
}

static bool in_layer(const struct scene_file *file, int token)
{
    for (int brace = file->list.tokens[token].parent; brace > 0; brace = file->list.tokens[brace].parent)
        if (is_word(file, brace - 1, "texture") && is_layer(file, brace - 1))
            return true;
    return false;
}

/* filter and transmit of a colour become 0, but for the upper layers of a texture, which let the lower ones through:
 * `transmit T` is `transmit 0*(T)`, `rgbt V` is `rgbt <1,1,1,0>*(V)`. In an image_map they may name a palette entry
 * first. */
static enum result write_opaque(struct writer *writer, int token, int *next, struct error *err)
{
    static const struct {
        const char *word, *factor;
    } colours[] = {
        {"rgbt", " <1,1,1,0>*("},   {"rgbf", " <1,1,1,0>*("},   {"rgbft", " <1,1,1,0,0>*("},
        {"srgbt", " <1,1,1,0>*("},  {"srgbf", " <1,1,1,0>*("},  {"srgbft", " <1,1,1,0,0>*("},
        {"transmit", " 0*("},       {"filter", " 0*("},
    };
    const struct scene_file *file = writer->file;
    const char *factor = NULL;
    for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
        if (is_word(file, token, colours[i].word))
            factor = colours[i].factor;
    if (!factor || is_mark(file, token - 1, ".") || in_layer(file, token))
        return RESULT_OK;
    int first = token + 1 + is_word(file, token + 1, "all"), end = value_end(file, first);
    if (is_mark(file, end, ",") && inside(file, token, "image_map")) {
        first = end + 1;
        end = value_end(file, first);
    }
    if (end == first)
        return RESULT_OK;
    enum result result = insert_after(writer, first - 1, factor, err);
    if (!result)
        result = insert_after(writer, end - 1, ") ", err);
    *next = end;
    return result;
}

/* What says how a finish reflects: noted for povgloss_end; with automatic gloss the lobe of the highlight, too. */
static enum result write_finish_item(struct writer *writer, int token, int *next, struct error *err)
{
    const struct scene_file *file = writer->file;
    if (is_word(file, token, "reflection"))
        return insert_before(writer, token,
                             is_zero(file, token + 1) ? "povgloss_reflection(0) " : "povgloss_reflection(1) ", err);
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

static enum result write_tokens(struct writer *writer, int first, int end, struct error *err)
{
    const struct scene_file *file = writer->file;
    enum result result = RESULT_OK;
    for (int i = first, next; !result && i < end; i = next ? next : i + 1) {
        next = 0;
        if (file->list.tokens[i].kind == TOKEN_DIRECTIVE) {
            track_directive(writer, i);
            if (is_directive(file, i, "include"))
                result = write_include(writer, i + 1, err);
            else if (is_directive(file, i, "fopen") && writer->rules->discovery)
                result = write_opening_log(writer, i, err);
            else if (is_directive(file, i, "default") && writer->rules->coded && opens_block(file, i))
                next = file->list.tokens[i + 1].match + 1;
        } else if (file->list.tokens[i].kind == TOKEN_WORD) {
            if (opens_block(file, i))
                result = write_block(writer, i, &next, err);
            if (!result && !next && writer->rules->marks && !fills_array(file, i))
                result = write_finish_item(writer, i, &next, err);
            if (!result && !next && writer->rules->opaque)
                result = write_opaque(writer, i, &next, err);
        }
    }
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
            .scene = scene, .file = file, .rules = &copy_rules[copy], .copy = copy, .value_end = -1};
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

enum result scene_save_names(const struct scene *scene, struct buffer *text, struct error *err)
{
    enum result result = RESULT_OK;
    const char *name = scene->names.data, *end = name + scene->names.size;
    for (int i = 0; !result && name < end; name += strlen(name) + 1, i++)
        result = buffer_printf(text, err, "#ifdef (%s) #declare povgloss_saved_%d = %s; #end\n", name, i, name);
    return result;
}

enum result scene_restore_names(const struct scene *scene, struct buffer *text, struct error *err)
{
    enum result result = RESULT_OK;
    const char *name = scene->names.data, *end = name + scene->names.size;
    for (int i = 0; !result && name < end; name += strlen(name) + 1, i++)
        result = buffer_printf(text, err,
                               "#ifdef (%s) #undef %s #end\n"
                               "#ifdef (povgloss_saved_%d) #declare %s = povgloss_saved_%d; #end\n",
                               name, name, i, name, i);
    return result;
}
