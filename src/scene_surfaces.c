/* By names alone: a name that is a surface somewhere is one everywhere. Each round follows the names one step further. */
#include "scene_surfaces.h"

#include "scene_tokens.h"

/* Notes that the name at `token` is, or has as its elements, what surfaces begin with. */
static enum result note_surface(struct scene *scene, const struct scene_file *file, int token, bool array, struct error *err)
{
    if (file->list.tokens[token].kind != TOKEN_WORD)
        return RESULT_OK;
    enum result result = add_name(&scene->surfaces, file, token, err);
    return result || (!array && !is_mark(file, token + 1, "[")) ? result
                                                              : add_name(&scene->surface_arrays, file, token, err);
}

/* What the calls of the macro whose name is at `macro` give to its parameter number `position`. */
static enum result note_arguments(struct scene *scene, const struct scene_file *of, int macro, int position, bool array,
                                  struct error *err)
{
    enum result result = RESULT_OK;
    const struct token *name = &of->list.tokens[macro];
    for (int i = 0; i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        for (int token = 0; !result && token < file->list.count - 1; token++) {
            if (!is_call(file, token) || !is_same_word(file, token, of, name))
                continue;
            int last = file->list.tokens[token + 1].match, argument = token + 2;
            for (int skip = position; skip > 0 && argument < last; skip--)
                argument = argument_end(file, argument, last) + 1;
            if (argument < last)
                result = note_surface(scene, file, argument, array, err);
        }
    }
    return result;
}

/* Whether the scene includes a file that isn't rewritten: the macros that it calls keep their parameters. */
static bool includes_as_it_is(const struct scene *scene)
{
    for (int i = 0; i < scene->found_count; i++)
        if (scene->found[i].file < 0)
            return true;
    return false;
}

static enum result note_macro(struct scene *scene, const struct scene_file *file, int macro, struct error *err)
{
    enum result result = RESULT_OK;
    int last = is_mark(file, macro + 1, "(") ? file->list.tokens[macro + 1].match : -1, position = 0;
    for (int token = macro + 2; !result && token < last; token = argument_end(file, token, last) + 1, position++) {
        if (find_name(&scene->surfaces, file, token) < 0)
            continue;
        result = add_name(&scene->names, file, token, err);
        if (!result && !includes_as_it_is(scene))
            result = add_name(&scene->surface_macros, file, macro, err);
        if (!result)
            result = note_arguments(scene, file, macro, position, find_name(&scene->surface_arrays, file, token) >= 0, err);
    }
    return result;
}

static enum result note_token(struct scene *scene, const struct scene_file *file, int token, struct error *err)
{
    if (in_list(file, token, glossy_words) && opens_block(file, token))
        return note_surface(scene, file, token + 2, false, err);
    if (file->list.tokens[token].kind != TOKEN_DIRECTIVE)
        return RESULT_OK;
    if (is_directive(file, token, "macro"))
        return note_macro(scene, file, token + 1, err);
    int name = declared_name(file, token), value = name < 0 ? -1 : after_subscripts(file, name + 1) + 1;
    if (name < 0 || !is_mark(file, value - 1, "=") || find_name(&scene->surfaces, file, name) < 0)
        return RESULT_OK;
    return note_surface(scene, file, value, false, err);
}

enum result scene_note_surfaces(struct scene *scene, struct error *err)
{
    enum result result = RESULT_OK;
    size_t before;
    do {
        before = scene->surfaces.size + scene->surface_arrays.size;
        for (int i = 0; i < scene->file_count; i++)
            for (int token = 0; !result && token < scene->files[i].list.count - 1; token++)
                result = note_token(scene, &scene->files[i], token, err);
    } while (!result && scene->surfaces.size + scene->surface_arrays.size != before);
    return result;
}
