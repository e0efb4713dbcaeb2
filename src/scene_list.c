/* Three steps: which token stands in which declaration, which declared names the scene uses, and what each finish
 * says. */
#include "scene_list.h"

#include "lobe.h"
#include "scene_tokens.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

enum { MAX_INHERITANCE = 50 };

/* A file's tokens as declarations see them: indices of declared names, or -1. */
struct words {
    int *name;      /* of the word itself */
    int *declared;  /* of the innermost #declare or #local whose value the token is part of */
    int *around;    /* the same, with macros */
};

/* What a finish says, as tokens of the file where it is said; 0: not said. */
struct finish {
    const struct scene_file *reflection_file, *exponent_file;
    int reflection, exponent; /* the keyword or the macro's name */
};

static void words_free(struct words *words, int count)
{
    for (int i = 0; words && i < count; i++) {
        free(words[i].name);
        free(words[i].declared);
        free(words[i].around);
    }
    free(words);
}

static enum result words_make(const struct scene *scene, struct words **all, struct error *err)
{
    *all = calloc((size_t)scene->file_count, sizeof **all);
    for (int i = 0; *all && i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        struct words *words = &(*all)[i];
        size_t size = (size_t)file->list.count * sizeof(int);
        words->name = malloc(size);
        words->declared = malloc(size);
        words->around = malloc(size);
        if (!words->name || !words->declared || !words->around)
            return error_memory(err, 3.0 * (double)size);
        memset(words->declared, -1, size);
        memset(words->around, -1, size);
        for (int token = 0; token < file->list.count; token++)
            words->name[token] = name_index(file, token);
        /* Outer declarations come first, and inner ones go over them. */
        for (int token = 0; token < file->list.count - 1; token++) {
            bool macro = is_directive(file, token, "macro");
            int name = declared_name(file, token);
            if (name < 0 || words->name[name] < 0)
                continue;
            int last = macro ? end_of_macro(file, token) : last_of_value(file, name + 1);
            for (int inner = token + 1; inner <= last; inner++) {
                words->around[inner] = words->name[name];
                if (!macro)
                    words->declared[inner] = words->name[name];
            }
            words->name[name] = -1; /* it isn't a use */
        }
    }
    return *all ? RESULT_OK : error_memory(err, (double)scene->file_count * sizeof **all);
}

/* Marks the names that the scene's own file and what stands outside declarations use, and those that these use in
 * turn. */
static void mark_used(const struct scene *scene, const struct words *words, bool *used)
{
    bool more = true;
    while (more) {
        more = false;
        for (int i = 0; i < scene->file_count; i++)
            for (int token = 0; token < scene->files[i].list.count; token++) {
                int name = words[i].name[token], around = words[i].around[token];
                if (name >= 0 && !used[name] && (i == 0 || around < 0 || used[around]))
                    used[name] = more = true;
            }
    }
}

/* The opening brace of the finish that is declared by the name at a token; NULL: none. */
static const struct scene_file *find_finish(const struct scene *scene, const struct scene_file *from, int name,
                                            int *brace)
{
    const struct scene_name *word = has_fact(from, name, NAME_GLOSSABLE) ? name_at(from, name) : NULL;
    for (int i = 0; word && i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        for (int token = 0; token < file->list.count - 4; token++) {
            if (name_at(file, token) == word && is_mark(file, token + 1, "=") &&
                is_word(file, token + 2, "finish") && opens_block(file, token + 2)) {
                *brace = token + 3;
                return file;
            }
        }
    }
    return NULL;
}

/* Later items of a finish go over earlier ones, and the first may be a declared finish. */
static void read_finish(const struct scene *scene, const struct scene_file *file, int brace, int depth,
                        struct finish *finish)
{
    int inner;
    const struct scene_file *declared = find_finish(scene, file, brace + 1, &inner);
    if (declared && depth < MAX_INHERITANCE)
        read_finish(scene, declared, inner, depth + 1, finish);
    bool glossy = finish->exponent && in_list(finish->exponent_file, finish->exponent, gloss_macros);
    for (int token = brace + 1; token < file->list.tokens[brace].match; token = next_item(file, token)) {
        bool call = in_list(file, token, gloss_macros) && is_mark(file, token + 1, "(") &&
                    file->list.tokens[token + 1].match > 0;
        if (is_word(file, token, "reflection")) {
            finish->reflection = token;
            finish->reflection_file = file;
        } else if (call || (!glossy && in_list(file, token, highlight_words))) {
            finish->exponent = token;
            finish->exponent_file = file;
            glossy |= call;
        }
    }
}

/* The source from one token to before another, its white space squeezed to single spaces, or left out. */
static enum result add_source(struct buffer *text, const struct scene_file *file, int first, int end, const char *space,
                              struct error *err)
{
    const struct token *tokens = file->list.tokens;
    enum result result = RESULT_OK;
    for (int token = first; !result && token < end; token++) {
        if (token > first && tokens[token].begin > tokens[token - 1].end)
            result = buffer_add_text(text, space, err);
        if (!result)
            result = buffer_add(text, file->source.data + tokens[token].begin, tokens[token].end - tokens[token].begin,
                                err);
    }
    return result;
}

static enum result add_reflection(struct buffer *text, const struct finish *finish, struct error *err)
{
    static const char *const colours[] = {"color", "colour", "rgb", "srgb", NULL};
    const struct scene_file *file = finish->reflection_file;
    int first = finish->reflection + 1, value = first;
    while (in_list(file, value, colours))
        value++;
    int end = opens_block(file, finish->reflection) ? file->list.tokens[first].match + 1 : value_end(file, value);
    return add_source(text, file, first, end, " ", err);
}

static enum result add_exponent(struct buffer *text, const struct finish *finish, struct error *err)
{
    const struct scene_file *file = finish->exponent_file;
    int keyword = finish->exponent;
    if (!keyword)
        return buffer_add_text(text, "-", err);
    bool parentheses = is_mark(file, keyword + 1, "("), roughness = is_word(file, keyword, "roughness"),
         gloss_roughness = is_word(file, keyword, "Gloss_Roughness");
    bool call = in_list(file, keyword, gloss_macros);
    int first = keyword + 1 + call;
    int end = call && parentheses ? file->list.tokens[keyword + 1].match : value_end(file, first);
    if (is_word(file, keyword, "Gloss_Map")) {
        int low = argument_end(file, first, end) + 1, high = argument_end(file, low, end) + 1;
        enum result result = add_source(text, file, low, high - 1, "", err);
        if (!result)
            result = buffer_add_text(text, "..", err);
        return result ? result : add_source(text, file, high, end, "", err);
    }
    if (file->list.tokens[first].kind == TOKEN_NUMBER && end == first + 1) {
        double value = number_value(file, first);
        double exponent = roughness ? 1 / (4 * value) : gloss_roughness ? lobe_phong_from_roughness(value) : value;
        return buffer_printf(text, err, "%.6g", exponent);
    }
    enum result result = buffer_add_text(text, roughness ? "1/(4*(" : gloss_roughness ? "Gloss_Roughness(" : "", err);
    if (!result)
        result = add_source(text, file, first, end, "", err);
    return result ? result : buffer_add_text(text, roughness ? "))" : gloss_roughness ? ")" : "", err);
}

/* The file's path from the current folder, where it lies below it. */
static const char *short_path(const char *path)
{
    char *here = getcwd(NULL, 0);
    size_t length = here ? strlen(here) : 0;
    bool below = length && !strncmp(path, here, length) && path[length] == '/';
    free(here);
    return below ? path + length + 1 : path;
}

enum { COLUMNS = 4 };

/* Appends a row's cells, each ended by NUL, if the finish whose keyword is at `token` reflects. */
static enum result add_row(const struct scene *scene, const struct scene_file *file, int token, const char *name,
                           struct buffer *cells, int *count, struct error *err)
{
    struct finish finish = {0};
    read_finish(scene, file, token + 1, 0, &finish);
    if (!finish.reflection || is_zero(finish.reflection_file, finish.reflection + 1))
        return RESULT_OK;
    ++*count;
    enum result result = buffer_add(cells, name, strlen(name) + 1, err);
    if (!result)
        result = buffer_printf(cells, err, "%s:%d", short_path(file->path), file->list.tokens[token].line);
    if (!result)
        result = buffer_add(cells, "", 1, err);
    if (!result)
        result = add_exponent(cells, &finish, err);
    if (!result)
        result = buffer_add(cells, "", 1, err);
    if (!result)
        result = add_reflection(cells, &finish, err);
    return result ? result : buffer_add(cells, "", 1, err);
}

static enum result align(const struct buffer *cells, struct buffer *text, struct error *err)
{
    int widths[COLUMNS] = {0}, column = 0;
    const char *end = cells->data + cells->size;
    for (const char *cell = cells->data; cell < end; cell += strlen(cell) + 1, column++)
        widths[column % COLUMNS] = (int)fmax(widths[column % COLUMNS], (double)strlen(cell));
    enum result result = RESULT_OK;
    column = 0;
    for (const char *cell = cells->data; !result && cell < end; cell += strlen(cell) + 1, column++)
        result = column % COLUMNS == COLUMNS - 1 ? buffer_printf(text, err, "%s\n", cell)
                                                 : buffer_printf(text, err, "%-*s  ", widths[column % COLUMNS], cell);
    return result;
}

enum result scene_list(const struct scene *scene, struct buffer *text, int *count, struct error *err)
{
    static const char header[] = "NAME\0PLACE\0EXPONENT\0REFLECTION";
    struct buffer cells = {0};
    struct words *words;
    const size_t name_count = (size_t)scene->names.declared_count;
    const char **names = calloc(name_count + 1, sizeof *names);
    bool *used = calloc(name_count + 1, sizeof *used);
    *count = 0;
    enum result result = words_make(scene, &words, err);
    if (!result && (!names || !used))
        result = error_memory(err, (double)(name_count * sizeof *names));
    if (!result) {
        for (const struct scene_name *name = scene->names.declared; name; name = name->next)
            names[name->index] = name->text;
        mark_used(scene, words, used);
        result = buffer_add(&cells, header, sizeof header, err);
    }
    for (int i = 0; !result && i < scene->file_count; i++)
        for (int token = 0; !result && token < scene->files[i].list.count; token++) {
            int around = words[i].around[token], declared = words[i].declared[token];
            if (is_word(&scene->files[i], token, "finish") && opens_block(&scene->files[i], token) &&
                (i == 0 || around < 0 || used[around]))
                result = add_row(scene, &scene->files[i], token, declared < 0 ? "-" : names[declared], &cells, count,
                                 err);
        }
    if (!result && *count > 0)
        result = align(&cells, text, err);
    words_free(words, scene->file_count);
    free(names);
    free(used);
    buffer_free(&cells);
    return result;
}
