/* By names alone: a name that is a surface somewhere is one everywhere. Each round follows the names one step
 * further. */
#include "scene_surfaces.h"

#include "scene_tokens.h"

/* Notes that the name at `token` is, or has as its elements, what surfaces begin with. */
static void note_surface(struct scene *scene, const struct scene_file *file, int token, bool array)
{
    note_fact(scene, file, token, NAME_SURFACE);
    if (array || is_mark(file, token + 1, "["))
        note_fact(scene, file, token, NAME_SURFACE_ARRAY);
}

/* What the calls of this macro give to its parameter number `position`. */
static void note_arguments(struct scene *scene, const struct scene_name *macro, int position, bool array)
{
    for (int i = 0; i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        for (int token = 0; token < file->list.count - 1; token++) {
            if (name_at(file, token) != macro || !is_call(file, token))
                continue;
            int last = file->list.tokens[token + 1].match, argument = token + 2;
            for (int skip = position; skip > 0 && argument < last; skip--)
                argument = argument_end(file, argument, last) + 1;
            if (argument < last)
                note_surface(scene, file, argument, array);
        }
    }
}

static void note_macro(struct scene *scene, const struct scene_file *file, int macro)
{
    int last = is_mark(file, macro + 1, "(") ? file->list.tokens[macro + 1].match : -1, position = 0;
    const bool keeps_parameters = scene_includes_as_it_is(scene); /* of the macros that such a file calls */
    for (int token = macro + 2; token < last; token = argument_end(file, token, last) + 1, position++) {
        if (!has_fact(file, token, NAME_SURFACE))
            continue;
        note_fact(scene, file, token, NAME_DECLARED);
        if (!keeps_parameters)
            note_fact(scene, file, macro, NAME_SURFACE_MACRO);
        note_arguments(scene, name_at(file, macro), position, has_fact(file, token, NAME_SURFACE_ARRAY));
    }
}

static void note_token(struct scene *scene, const struct scene_file *file, int token)
{
    if (in_list(file, token, glossy_words) && opens_block(file, token))
        note_surface(scene, file, token + 2, false);
    else if (is_directive(file, token, "macro"))
        note_macro(scene, file, token + 1);
    else if (file->list.tokens[token].kind == TOKEN_DIRECTIVE) {
        int name = declared_name(file, token), value = name < 0 ? -1 : after_subscripts(file, name + 1) + 1;
        if (has_fact(file, name, NAME_SURFACE) && is_mark(file, value - 1, "="))
            note_surface(scene, file, value, false);
    }
}

static void note_file(struct scene *scene, const struct scene_file *file)
{
    for (int token = 0; token < file->list.count - 1; token++)
        note_token(scene, file, token);
}

void scene_note_surfaces(struct scene *scene)
{
    scene_note_facts(scene, note_file);
}
