/* One frame after another; the passes stay open between them. */
#include "draw.h"

#include "depfile.h"
#include "lobe_rays.h"
#include "output_file.h"
#include "passes_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/* A bar that is drawn again on a terminal, and a line for every quarter elsewhere. */
struct progress {
    bool terminal;
    const char *frame; /* "frame 3: ", or empty */
    int shown;         /* percent; -1: nothing yet */
};

static void show_progress(void *context, double done)
{
    struct progress *progress = context;
    int percent = (int)(100 * done), step = progress->terminal ? 1 : 25;
    if (percent / step == progress->shown / step && progress->shown >= 0)
        return;
    progress->shown = percent;
    if (!progress->terminal) {
        fprintf(stderr, "povgloss: %srendering passes, %d %%\n", progress->frame, percent / 25 * 25);
        return;
    }
    char bar[41];
    for (int i = 0; i < 40; i++)
        bar[i] = i < percent * 40 / 100 ? '#' : '.';
    bar[40] = 0;
    fprintf(stderr, "\rpovgloss: %spasses [%s] %3d %%%s", progress->frame, bar, percent, percent == 100 ? "\n" : "");
    fflush(stderr);
}

enum result draw_check_place(const char *path, struct error *err)
{
    struct output_file file;
    if (command_is_stream(path))
        return RESULT_OK;
    enum result result = output_file_open(&file, path, err);
    if (!result)
        output_file_abort(&file);
    return result;
}

void draw_warn(const struct command *command, const char *frame, const struct error *note)
{
    struct error warning;
    if (!note->text[0] || command->filter.quiet)
        return;
    error_set(&warning, RESULT_OK, "%s%s", frame, note->text);
    cli_complain("povgloss: warning", &warning);
}

void draw_close_passes(struct passes **passes)
{
    struct error warning;
    if (passes_close(*passes, &warning))
        cli_complain("povgloss: warning", &warning);
    *passes = NULL;
}

enum result draw_passes(struct command *command, struct passes **passes, int number, const char *frame,
                        struct gbuffer *gbuffer, struct error *err)
{
    struct progress progress = {.terminal = isatty(STDERR_FILENO), .frame = frame, .shown = -1};
    struct error note;
    enum result result = RESULT_OK;
    command->passes.progress = command->filter.quiet ? NULL : show_progress;
    command->passes.progress_context = &progress;
    if (!*passes) {
        result = passes_open(&command->passes, passes, &note, err);
        if (!result)
            draw_warn(command, "", &note);
    }
    if (!result)
        result = passes_render(*passes, number, gbuffer, &note, err);
    if (result && progress.terminal && !command->filter.quiet && progress.shown >= 0 && progress.shown < 100)
        fputc('\n', stderr);
    if (!result)
        draw_warn(command, frame, &note);
    if (!result)
        result = passes_check_sum(*passes, number, gbuffer, &note, err);
    if (!result)
        draw_warn(command, frame, &note);
    return result;
}

/* One image to `path`. */
static enum result draw_frame(struct command *command, struct passes **passes, int number, const char *frame,
                              const char *path, struct buffer *reads, struct error *err)
{
    const struct frames *frames = &command->passes.frames;
    bool last = number + frames->step > frames->last;
    struct gbuffer gbuffer = {0};
    struct image glossy = {0}, measure = {0};

    /* 1. refuse what can't be written, before the work */
    enum result result = draw_check_place(path, err);

    /* 2. the passes, from POV-Ray; the first frame reads the scene for all */
    if (!result)
        result = draw_passes(command, passes, number, frame, &gbuffer, err);
    if (!result && command->rays)
        result = lobe_rays_trace(command, *passes, number, &gbuffer, err);
    if (!result && last && command->depfile)
        result = passes_reads(*passes, reads, err);

    /* 3. the filter, while POV-Ray's processes end */
    if (!result)
        cli_warn_of_pixels("povgloss", command->path, &command->filter, &gbuffer);
    if (!result && command->kind != KIND_PASSES)
        result = cli_blur(&command->filter, &gbuffer, &glossy, &measure, err);
    if (!result)
        result = passes_settle(*passes, err);
    /* A pipe whose reader went away ends the program as it writes: no folder and no process is there then. */
    if (last)
        draw_close_passes(passes);

    /* 4. the passes file, or the picture */
    if (!result && command->kind == KIND_PASSES) {
        struct timings_moment start = timings_now();
        result = passes_file_write(path, &gbuffer, err);
        timings_add(command->filter.timings, "write", start);
    } else if (!result) {
        result = cli_write(path, &command->filter, &gbuffer, &glossy, &measure, err);
    }
    image_free(&glossy);
    image_free(&measure);
    gbuffer_free(&gbuffer);
    return result;
}

enum result draw_frames(struct command *command, struct error *err)
{
    const struct frames *frames = &command->passes.frames;
    struct passes *passes = NULL;
    struct buffer reads = {0};     /* for the rule: what the outputs were made from, */
    struct text_list outputs = {0}; /* and their names */
    enum result result = RESULT_OK;
    if (command->depfile)
        result = depfile_check_name(command->output, err);
    if (!result && command->depfile)
        result = draw_check_place(command->depfile, err);
    for (int number = frames->first; !result && number <= frames->last; number += frames->step) {
        char frame[32] = "", *path = NULL;
        struct stat there;
        if (frames->digits > 0)
            snprintf(frame, sizeof frame, "frame %d: ", number);
        result = command_is_stream(command->output) ? text_printf(&path, err, "%s", command->output)
                                            : frames_path(frames, command->output, number, &path, err);
        if (!result && !(command->resume && !stat(path, &there) && S_ISREG(there.st_mode))) {
            result = draw_frame(command, &passes, number, frame, path, &reads, err);
            struct error cause = *err;
            if (result)
                error_set(err, result, "%s%s", frame, cause.text);
        }
        if (!result && command->depfile)
            result = text_list_add(&outputs, err, "%s", path);
        free(path);
    }
    draw_close_passes(&passes);
    if (!result && command->depfile)
        result = depfile_write(command->depfile, &outputs, &reads, err);
    buffer_free(&reads);
    text_list_free(&outputs);
    return result;
}
