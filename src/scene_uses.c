/* By names alone: a name that is used somewhere is used wherever it is declared. */
#include "scene_uses.h"

#include "scene_tokens.h"

enum { MAX_DEPTH = 100 };

int end_of_block(const struct scene_file *file, int token)
{
    int name = is_directive(file, token, "macro") ? -1 : declared_name(file, token), value = name + 2;
    if (name < 0 || !is_mark(file, name + 1, "=") || !opens_block(file, value))
        return -1;
    int last = last_of_value(file, name + 1);
    last += is_mark(file, last + 1, ";");
    bool ends = is_mark(file, last, ";") || last + 2 >= file->list.count ||
                file->list.tokens[last + 1].kind == TOKEN_DIRECTIVE;
    return ends && !has_effects(file, value, last) ? last : -1;
}

/* The declarations and macros around a token, the innermost last. */
struct declarations {
    int depth;
    int name[MAX_DEPTH], last[MAX_DEPTH];
};

/* Goes on to the token. Those that are deeper than MAX_DEPTH count as parts of what is around them. */
static void go_to(struct declarations *around, const struct scene_file *file, int token)
{
    while (around->depth > 0 && token > around->last[around->depth - 1])
        around->depth--;
    int last = is_directive(file, token, "macro") ? end_of_macro(file, token) : end_of_block(file, token);
    if (last < 0 || around->depth == MAX_DEPTH)
        return;
    around->name[around->depth] = declared_name(file, token);
    around->last[around->depth++] = last;
}

static bool is_used(const struct scene *scene, const struct scene_file *file, const struct declarations *around)
{
    return file == scene->files || around->depth == 0 || has_fact(file, around->name[around->depth - 1], NAME_USED);
}

static void note_file(struct scene *scene, const struct scene_file *file)
{
    struct declarations around = {0};
    for (int token = 0; token < file->list.count - 1; token++) {
        go_to(&around, file, token);
        bool itself = around.depth > 0 && token == around.name[around.depth - 1];
        if (!itself && has_fact(file, token, NAME_DECLARED) && is_used(scene, file, &around))
            note_fact(scene, file, token, NAME_USED);
    }
}

void scene_note_uses(struct scene *scene)
{
    const bool unknown = scene_includes_as_it_is(scene);
    for (struct scene_name *name = scene->names.declared; unknown && name; name = name->next)
        scene_names_note(&scene->names, name, NAME_USED);
    scene_note_facts(scene, note_file);
}

void scene_walk_used(struct scene *scene, void (*note)(struct scene *scene, const struct scene_file *file, int token))
{
    for (int i = 0; i < scene->file_count; i++) {
        const struct scene_file *file = &scene->files[i];
        struct declarations around = {0};
        for (int token = 0; token < file->list.count - 1; token++) {
            go_to(&around, file, token);
            if (is_used(scene, file, &around))
                note(scene, file, token);
        }
    }
}
