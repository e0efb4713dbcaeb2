/* Questions about the tokens of a scene's file, for those who read and rewrite it. Token numbers beyond either end are
 * no word, mark or directive. */
#ifndef POVGLOSS_SCENE_TOKENS_H
#define POVGLOSS_SCENE_TOKENS_H

#include "scene.h"

#include <stdlib.h>
#include <string.h>

/* What may follow the = of a name that can be made glossy. */
static const char *const glossy_words[] = {"finish", "texture", "material", NULL};

/* The macros that make a finish glossy. */
static const char *const gloss_macros[] = {"Gloss", "Gloss_Roughness", "Gloss_Map", NULL};

/* The items of a finish whose values are the lobe of a highlight. */
static const char *const highlight_words[] = {"phong_size", "roughness", NULL};

static inline bool is_word(const struct scene_file *file, int token, const char *word)
{
    return token >= 0 && token < file->list.count &&
           token_is(&file->source, &file->list.tokens[token], TOKEN_WORD, word);
}

static inline bool is_mark(const struct scene_file *file, int token, const char *mark)
{
    return token >= 0 && token < file->list.count &&
           token_is(&file->source, &file->list.tokens[token], TOKEN_MARK, mark);
}

static inline bool is_directive(const struct scene_file *file, int token, const char *word)
{
    return token >= 0 && token_is(&file->source, &file->list.tokens[token], TOKEN_DIRECTIVE, word);
}

static inline bool in_list(const struct scene_file *file, int token, const char *const *words)
{
    for (; *words; words++)
        if (token_is(&file->source, &file->list.tokens[token], TOKEN_WORD, *words))
            return true;
    return false;
}

static inline double number_value(const struct scene_file *file, int token)
{
    return strtod(file->source.data + file->list.tokens[token].begin, NULL);
}

static inline bool opens_block(const struct scene_file *file, int token)
{
    return is_mark(file, token + 1, "{") && file->list.tokens[token + 1].match > 0;
}

/* The token after this one, or after the block that it opens. */
static inline int next_item(const struct scene_file *file, int token)
{
    bool opens = is_mark(file, token, "{") && file->list.tokens[token].match > token;
    return (opens ? file->list.tokens[token].match : token) + 1;
}

static inline bool mentions(const struct scene_file *file, int first, int end, const char *const *words)
{
    for (int token = first; token < end; token++)
        if (in_list(file, token, words))
            return true;
    return false;
}

/* Whether the token is the photons of global_settings, which are shot anew in every run of POV-Ray. */
static inline bool shoots_photons(const struct scene_file *file, int token)
{
    static const char *const files[] = {"load_file", "save_file", NULL};
    int parent = is_word(file, token, "photons") ? file->list.tokens[token].parent : -1;
    return parent > 0 && is_word(file, parent - 1, "global_settings") && opens_block(file, token) &&
           !mentions(file, token + 2, file->list.tokens[token + 1].match, files);
}

/* Whether the directive is closed by an #end. */
static inline bool opens_nesting(const struct scene_file *file, int token)
{
    static const char *const openers[] = {"if", "ifdef", "ifndef", "while", "for", "switch", "macro", NULL};
    for (int i = 0; openers[i]; i++)
        if (is_directive(file, token, openers[i]))
            return true;
    return false;
}

/* The innermost conditions and macros, as one walks over a file's directives. */
struct nesting {
    int depth;
    int macro, macro_depth; /* the name of the outermost macro around; 0: none */
};

static inline void nest(struct nesting *nesting, const struct scene_file *file, int token)
{
    if (opens_nesting(file, token)) {
        nesting->depth++;
        if (!nesting->macro && is_directive(file, token, "macro")) {
            nesting->macro = token + 1;
            nesting->macro_depth = nesting->depth;
        }
    } else if (is_directive(file, token, "end") && nesting->depth > 0) {
        if (nesting->macro && nesting->depth == nesting->macro_depth)
            nesting->macro = 0;
        nesting->depth--;
    }
}

/* The token after the subscripts `[...][...]` that begin at `token`. */
static inline int after_subscripts(const struct scene_file *file, int token)
{
    for (int depth = 0; token < file->list.count - 1; token++) {
        depth += is_mark(file, token, "[");
        if (depth == 0)
            break;
        depth -= is_mark(file, token, "]");
    }
    return token;
}

/* The ] of the subscript that begins at `token`. */
static inline int subscript_end(const struct scene_file *file, int token)
{
    for (int depth = 0; token < file->list.count - 1; token++) {
        depth += is_mark(file, token, "[");
        depth -= is_mark(file, token, "]");
        if (depth == 0)
            break;
    }
    return token;
}

/* The name before the subscripts that end at `token`, or `token` itself where there are none. */
static inline int before_subscripts(const struct scene_file *file, int token)
{
    for (int depth = 0; token > 0 && (depth > 0 || is_mark(file, token, "]")); token--) {
        depth += is_mark(file, token, "]");
        depth -= is_mark(file, token, "[");
    }
    return token;
}

/* The token that says what kind of block an opening brace begins: `union {`, `function (x, y) {`, `function 9, 9 {`,
 * `function W, H {`. */
static inline int block_keyword(const struct scene_file *file, int brace)
{
    int token = brace - 1;
    if (is_mark(file, token, ")") && file->list.tokens[token].match > 0)
        token = file->list.tokens[token].match - 1;
    int first = token;
    while (first > 0 && !is_word(file, first, "function") &&
           (file->list.tokens[first].kind == TOKEN_NUMBER || is_mark(file, first, ",") || is_mark(file, first + 1, ",")))
        first--;
    return is_word(file, first, "function") || is_word(file, --first, "function") ? first : token;
}

static inline bool inside(const struct scene_file *file, int token, enum scene_block block)
{
    return file->list.tokens[token].around & block;
}

static inline bool is_zero(const struct scene_file *file, int token)
{
    static const char *const operators[] = {"+", "-", "*", "/", NULL};
    bool zero = file->list.tokens[token].kind == TOKEN_NUMBER && number_value(file, token) == 0;
    for (int i = 0; zero && operators[i]; i++)
        zero = !is_mark(file, token + 1, operators[i]);
    return zero;
}

/* The token after the value that begins at `token`; of the operators in it, the four of arithmetic are followed. */
static inline int value_end(const struct scene_file *file, int token)
{
    for (;;) {
        while (is_mark(file, token, "+") || is_mark(file, token, "-"))
            token++;
        if (is_mark(file, token, "<"))
            while (token < file->list.count - 1 && !is_mark(file, token, ">"))
                token = is_mark(file, token, "(") && file->list.tokens[token].match > 0 ? file->list.tokens[token].match
                                                                                         : token + 1;
        else if (is_mark(file, token, "(") && file->list.tokens[token].match > 0)
            token = file->list.tokens[token].match;
        else if (file->list.tokens[token].kind != TOKEN_NUMBER && file->list.tokens[token].kind != TOKEN_WORD)
            return token;
        token++;
        for (;;) {
            if (is_mark(file, token, "(") && file->list.tokens[token].match > 0)
                token = file->list.tokens[token].match + 1;
            else if (is_mark(file, token, "["))
                while (token < file->list.count - 1 && !is_mark(file, token++, "]"))
                    ;
            else if (is_mark(file, token, "."))
                token += 2;
            else
                break;
        }
        if (!is_mark(file, token, "+") && !is_mark(file, token, "-") && !is_mark(file, token, "*") &&
            !is_mark(file, token, "/"))
            return token;
        token++;
    }
}

/* The same, at most `end`. */
static inline int value_before(const struct scene_file *file, int token, int end)
{
    int after = token < end ? value_end(file, token) : end;
    return after < end ? after : end;
}

/* The token after the string expression that begins at `token`. */
static inline int string_end(const struct scene_file *file, int token)
{
    if (file->list.tokens[token].kind == TOKEN_STRING)
        return token + 1;
    return file->list.tokens[token].kind == TOKEN_WORD ? value_end(file, token) : token;
}

static inline const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The name that the directive at `token` declares, or -1: `#declare deprecated once "message" X`, `#macro X`. */
static inline int declared_name(const struct scene_file *file, int token)
{
    if (is_directive(file, token, "macro"))
        return token + 1;
    if (!is_directive(file, token, "declare") && !is_directive(file, token, "local"))
        return -1;
    token++;
    if (is_word(file, token, "deprecated")) {
        token += 1 + is_word(file, token + 1, "once");
        token += file->list.tokens[token].kind == TOKEN_STRING;
    }
    return token;
}

/* The last token of the value that is declared from `token` on, roughly: never too early. */
static inline int last_of_value(const struct scene_file *file, int token)
{
    while (token < file->list.count - 1 && file->list.tokens[token].kind != TOKEN_DIRECTIVE && !is_mark(file, token, ";")) {
        int match = is_mark(file, token, "{") ? file->list.tokens[token].match : -1;
        if (match > 0 && !is_word(file, match + 1, "texture"))
            return match;
        token = match > 0 ? match + 1 : token + 1;
    }
    return token;
}

/* The #end of the #macro at `token`. */
static inline int end_of_macro(const struct scene_file *file, int token)
{
    int depth = 0;
    for (; token < file->list.count - 1; token++) {
        if (file->list.tokens[token].kind != TOKEN_DIRECTIVE)
            continue;
        depth += opens_nesting(file, token);
        depth -= is_directive(file, token, "end");
        if (depth <= 0)
            break;
    }
    return token;
}

/* The token after the directive at `token` and what it takes, but for what stands between it and its #end; at most
 * `end`. */
static inline int directive_end(const struct scene_file *file, int token, int end)
{
    static const char *const alone[] = {"else", "end", "break", NULL};
    for (int i = 0; alone[i]; i++)
        if (is_directive(file, token, alone[i]))
            return token + 1;
    int name = declared_name(file, token), first = name < 0 ? token + 1 : name + 2, after = first;
    while (name >= 0 && after < end && file->list.tokens[after].kind != TOKEN_DIRECTIVE && !is_mark(file, after, ";"))
        after = file->list.tokens[after].match > after ? file->list.tokens[after].match : after + 1;
    if (is_directive(file, token, "macro"))
        after = end_of_macro(file, token) + 1;
    else if (is_mark(file, after, ";") || (after < end && file->list.tokens[after].kind == TOKEN_STRING))
        after++;
    else
        after = value_before(file, first, end);
    return after < end ? after : end;
}

/* Whether parentheses follow the name at `token`, and are closed. */
static inline bool has_parentheses(const struct scene_file *file, int token)
{
    return is_mark(file, token + 1, "(") && file->list.tokens[token + 1].match > 0;
}

/* Whether the name at `token` is called as a macro is. */
static inline bool is_call(const struct scene_file *file, int token)
{
    return has_parentheses(file, token) && !is_directive(file, token - 1, "macro");
}

/* The comma after the argument of a macro that begins at `token`, or `last`, the parenthesis at their end. */
static inline int argument_end(const struct scene_file *file, int token, int last)
{
    for (int depth = 0; token < last && (depth > 0 || !is_mark(file, token, ",")); token++) {
        bool compares = token > 0 && (file->list.tokens[token - 1].kind == TOKEN_NUMBER || is_mark(file, token - 1, ")"));
        depth += is_mark(file, token, "<") && !compares;
        depth -= is_mark(file, token, ">") && depth > 0;
        if (file->list.tokens[token].match > token)
            token = file->list.tokens[token].match;
    }
    return token;
}

/* Whether one of the tokens may be transparent. */
static inline bool may_be_clear(const struct scene_file *file, int first, int last)
{
    return last >= first && file->clear[last + 1] > file->clear[first];
}

/* The name at `token`; NULL where there is no word. */
static inline struct scene_name *name_at(const struct scene_file *file, int token)
{
    return token >= 0 && token < file->list.count ? file->list.tokens[token].name : NULL;
}

static inline bool has_fact(const struct scene_file *file, int token, enum name_fact fact)
{
    const struct scene_name *name = name_at(file, token);
    return name && name->facts & fact;
}

/* The index of the declared name at `token`, or -1. */
static inline int name_index(const struct scene_file *file, int token)
{
    const struct scene_name *name = name_at(file, token);
    return name ? name->index : -1;
}

/* Whether leaving the tokens out would change what follows: they declare something, draw random numbers or call a
 * macro. */
static inline bool has_effects(const struct scene_file *file, int first, int last)
{
    for (int i = first; i <= last; i++)
        if (file->list.tokens[i].kind == TOKEN_DIRECTIVE || is_word(file, i, "rand") ||
            (is_mark(file, i + 1, "(") && has_fact(file, i, NAME_DECLARED)))
            return true;
    return false;
}

/* Of a token that is no word nothing is noted. */
static inline void note_fact(struct scene *scene, const struct scene_file *file, int token, enum name_fact fact)
{
    struct scene_name *name = name_at(file, token);
    if (name)
        scene_names_note(&scene->names, name, fact);
}

#endif
