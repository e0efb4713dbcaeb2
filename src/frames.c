/* POV-Ray's arithmetic of frames, with its odd cases: one frame from 1 to 1 is no animation, a cyclic animation has the
 * digits of one frame more, and a share of the frames is counted from 0, whatever the initial frame. */
#include "frames.h"

#include "mem.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct frames_options frames_options_default(void)
{
    return (struct frames_options){.initial = FRAMES_UNSAID,
                                   .final = FRAMES_UNSAID,
                                   .step = 1,
                                   .subset_start = FRAMES_UNSAID,
                                   .subset_end = FRAMES_UNSAID};
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int subset_frame(double subset, int count)
{
    double frame = fmin(fmax(subset, 0), -(double)FRAMES_UNSAID);
    return (int)(frame < 1 ? frame * count : frame);
}

struct frames frames_plan(const struct frames_options *options)
{
    bool has_initial = options->initial != FRAMES_UNSAID, has_final = options->final != FRAMES_UNSAID;
    int initial = has_initial ? options->initial : 0, final = has_final ? options->final : 0;
    if (initial == final && (initial == 0 || initial == 1))
        return (struct frames){.step = 1};
    initial = has_initial ? larger(initial, 0) : 1;
    final = larger(has_final ? final : 1, initial) + options->cyclic;
    int count = final - initial + 1;
    struct frames frames = {.first = initial, .last = final - options->cyclic, .step = larger(options->step, 1)};
    if (options->subset_start != FRAMES_UNSAID)
        frames.first = larger(subset_frame(options->subset_start, count), initial);
    if (options->subset_end != FRAMES_UNSAID)
        frames.last = subset_frame(options->subset_end, count);
    frames.last = larger(frames.last, frames.first);
    for (int i = final; i > 0 || frames.digits == 0; i /= 10)
        frames.digits++;
    return frames;
}

int frames_count(const struct frames *frames)
{
    return (frames->last - frames->first) / frames->step + 1;
}

void frames_number(const struct frames *frames, int frame, char number[FRAMES_NUMBER_SIZE])
{
    number[0] = 0;
    if (frames->digits > 0)
        snprintf(number, FRAMES_NUMBER_SIZE, "%0*d", frames->digits, frame);
}

enum result frames_path(const struct frames *frames, const char *path, int frame, char **numbered, struct error *err)
{
    char number[FRAMES_NUMBER_SIZE];
    frames_number(frames, frame, number);
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.'), *name = slash ? slash + 1 : path;
    int stem = (int)(dot > name ? (size_t)(dot - path) : strlen(path));
    return text_printf(numbered, err, "%.*s%s%s", stem, path, number, path + stem);
}
