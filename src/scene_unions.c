/* By tokens and names: POV-Ray takes flags of an object in a union only where every union around is one without
 * bounds. */
#include "scene_unions.h"

#include "scene_tokens.h"

static const char *const surface_words[] = {"texture", "pigment", "finish", "normal", "material", "interior_texture", NULL};

/* Those that concern a union as a whole. */
static const char *const whole_words[] = {"bounded_by", "inverse", "split_union", NULL};

/* Whether the tokens, blocks left out, are neither a call of a macro nor one of those words, and the blocks no
 * surfaces. */
static bool is_plain(const struct scene_file *file, int first, int last)
{
    static const char *const unknown[] = {"include", "macro", "default", NULL};
    for (int i = first; i < last;) {
        if (file->list.tokens[i].kind == TOKEN_DIRECTIVE) {
            for (int word = 0; unknown[word]; word++)
                if (is_directive(file, i, unknown[word]))
                    return false;
            i = directive_end(file, i, last);
        } else if (in_list(file, i, whole_words) || (is_mark(file, i + 1, "(") && has_fact(file, i, NAME_DECLARED))) {
            return false;
        } else if (opens_block(file, i)) {
            int end = file->list.tokens[i + 1].match;
            if (in_list(file, i, surface_words) || file->list.tokens[end].match != i + 1)
                return false;
            i = end + 1;
        } else {
            i++;
        }
    }
    return true;
}

static bool is_object_union(const struct scene *scene, const struct scene_file *file, int brace)
{
    int last = file->list.tokens[brace].match;
    return is_mark(file, brace, "{") && is_word(file, brace - 1, "union") && last > 0 &&
           file->list.tokens[last].match == brace && (scene->clear_default || may_be_clear(file, brace + 1, last)) &&
           is_plain(file, brace + 1, last);
}

/* The name that is declared as the union at this brace, or the macro that consists of it; -1: neither. */
static int union_name(const struct scene_file *file, int brace)
{
    const struct token *tokens = file->list.tokens;
    if (is_mark(file, brace - 2, "="))
        return brace - 3;
    int open = brace > 2 && is_mark(file, brace - 2, ")") ? tokens[brace - 2].match : -1;
    bool whole = open > 1 && is_directive(file, open - 2, "macro") && is_directive(file, tokens[brace].match + 1, "end");
    return whole ? open - 1 : -1;
}

static bool splits_everywhere(const struct scene_file *file, int name)
{
    return has_fact(file, name, NAME_UNION) && !has_fact(file, name, NAME_WHOLE);
}

bool union_splits(const struct scene_file *file, int brace, bool in_macro)
{
    if (brace <= 0 || !file->object_unions[brace])
        return false;
    int name = union_name(file, brace), parent = file->list.tokens[brace].parent;
    if (name >= 0)
        return splits_everywhere(file, name);
    if (is_mark(file, brace - 2, "(") || is_mark(file, brace - 2, ","))
        return false;
    return parent < 0 ? !in_macro : union_splits(file, parent, in_macro);
}

bool is_split_object(const struct scene_file *file, int token)
{
    return is_word(file, token, "object") && opens_block(file, token) && splits_everywhere(file, token + 2);
}

/* Whether the name is that of an object that is placed as it is, where its parts may be placed one by one. */
static bool is_split_use(const struct scene_file *file, int name, bool in_macro)
{
    const struct token *tokens = file->list.tokens;
    int brace = name - 1, last = is_mark(file, brace, "{") ? tokens[brace].match : -1, parent;
    if (last < 0 || tokens[last].match != brace || !is_word(file, brace - 1, "object") || is_mark(file, brace - 2, "=") ||
        is_mark(file, brace - 2, "(") || is_mark(file, brace - 2, ","))
        return false;
    parent = tokens[brace].parent;
    return is_plain(file, is_call(file, name) ? tokens[name + 1].match + 1 : name + 1, last) &&
           (parent < 0 ? !in_macro : union_splits(file, parent, in_macro));
}

static void note_name(struct scene *scene, const struct scene_file *file, int token)
{
    int name = declared_name(file, token), brace = name + 3;
    if (name < 0)
        return;
    if (is_directive(file, token, "macro") && is_mark(file, name + 1, "(")) {
        brace = file->list.tokens[name + 1].match + 2;
        for (int i = name + 2; i < brace - 2; i++)
            note_fact(scene, file, i, NAME_WHOLE);
    }
    bool is_union = brace > 1 && brace < file->list.count && file->object_unions[brace] && union_name(file, brace) == name;
    note_fact(scene, file, name, is_union ? NAME_UNION : NAME_WHOLE);
}

/* A name stands for a whole object where it is used in any other way. */
static void note_uses(struct scene *scene, const struct scene_file *file)
{
    struct nesting nesting = {0};
    int declared = -1;
    for (int token = 0; token < file->list.count - 1; token++) {
        nest(&nesting, file, token);
        if (file->list.tokens[token].kind == TOKEN_DIRECTIVE)
            declared = declared_name(file, token);
        if (token != declared && splits_everywhere(file, token) && !is_split_use(file, token, nesting.macro > 0))
            note_fact(scene, file, token, NAME_WHOLE);
    }
}

enum result scene_note_unions(struct scene *scene, struct error *err)
{
    for (int i = 0; i < scene->file_count; i++) {
        struct scene_file *file = &scene->files[i];
        file->object_unions = calloc((size_t)file->list.count, sizeof *file->object_unions);
        if (!file->object_unions)
            return error_memory(err, (double)file->list.count);
        for (int token = 1; token < file->list.count; token++)
            file->object_unions[token] = is_object_union(scene, file, token);
        for (int token = 0; token < file->list.count; token++)
            note_name(scene, file, token);
    }
    scene_note_facts(scene, note_uses);
    return RESULT_OK;
}
