/* The input is a digit for the user's --gloss, a scene, its include "part.inc" and what POV-Ray would write to the
 * discovery's log, each ended by NUL. The scene is listed, and all copies and passes are written. */
#include "fuzz_support.h"

#include "pass_scene.h"
#include "scene_discover.h"
#include "scene_list.h"

#include <sys/stat.h>

static void write_part(const char *name, struct fuzz_part part)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", fuzz_folder(), name);
    FILE *file = fopen(path, "wb");
    FUZZ_REQUIRE(file && fwrite(part.text, 1, part.size, file) == part.size && !fclose(file));
}

static void check(enum result result, const struct error *err)
{
    FUZZ_REQUIRE(result == RESULT_OK || (result == RESULT_DATA && *err->text));
}

static void write_all(const struct scene *scene, const char *copies)
{
    struct error err = {0};
    struct buffer text = {0};
    for (int copy = 0; copy < SCENE_COPY_COUNT; copy++)
        check(scene_write_copy(scene, (enum scene_copy)copy, copies, &err), &err);
    for (int id = 0; id < PASS_COUNT; id++)
        if (pass_needed(scene, (enum pass_id)id))
            check(pass_scene_text(scene, (enum pass_id)id, &text, &err), &err);
    buffer_free(&text);
}

static enum result find_out(struct scene *scene, const char *const *directories, struct error *err)
{
    struct buffer text = {0};
    bool again = false;
    enum result result = scene->needs_discovery ? pass_discovery_text(scene, &text, err) : RESULT_OK;
    if (!result && scene->needs_discovery) {
        result = scene_discover(scene, fuzz_folder(), directories, 1, &again, err);
        if (!result && !again)
            result = scene_settle(scene, err);
    }
    buffer_free(&text);
    return result ? result : again ? RESULT_DATA : RESULT_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const choices[] = {NULL, "auto", "all=50", "F=20"};
    char path[96], copies[96];
    const char *const directories[] = {fuzz_folder()};
    struct gloss_choice choice = {0};
    struct scene scene;
    struct error err = {0};
    if (!size)
        return 0;
    const char *chosen = choices[*data % 4];
    data++, size--;
    write_part("scene.pov", fuzz_part(&data, &size));
    write_part("part.inc", fuzz_part(&data, &size));
    write_part(SCENE_DISCOVERY_LOG, fuzz_part(&data, &size));
    snprintf(path, sizeof path, "%s/scene.pov", fuzz_folder());
    snprintf(copies, sizeof copies, "%s/copies", fuzz_folder());
    mkdir(copies, 0777);
    if (chosen)
        FUZZ_REQUIRE(!gloss_choice_take(&choice, chosen, &err));
    enum result result = scene_load(&scene, path, &choice, directories, 1, &err);
    check(result, &err);
    if (!result) {
        struct buffer text = {0};
        int count;
        check(scene_list(&scene, &text, &count, &err), &err);
        buffer_free(&text);
        result = find_out(&scene, directories, &err);
    }
    if (!result)
        write_all(&scene, copies);
    scene_free(&scene);
    gloss_choice_free(&choice);
    return 0;
}
