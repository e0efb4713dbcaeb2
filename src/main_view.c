/* The window of glossfilter --view: the picture, and a slider for its roughness.
 *
 * A change is shown at once from a reduced gbuffer, as coarse as the filter needs to keep up; a thread then works
 * through the finer ones up to the whole picture, and is stopped when the roughness changes. It is a program of its
 * own, so that glossfilter doesn't load SDL2 for everything else.
 */
#include "cli.h"
#include "gamma.h"
#include "input_file.h"
#include "interrupt.h"
#include "lobe.h"
#include "picture.h"

#include <SDL.h>

#include <math.h>
#include <stdlib.h>

static const char program[] = "glossfilter";

enum { LEVELS = 5, SLIDER_PX = 24, MARGIN_PX = 8, SLOW_MS = 80, QUICK_MS = 15, LOOK_MS = 100 };

/* What is to be seen: the passes' own exponents, or one roughness for all. */
struct wish {
    bool own;
    double roughness;
    unsigned number; /* counts the changes */
};

struct view {
    const struct cli_glossfilter *command;
    struct gbuffer levels[LEVELS]; /* level i has every 2^i-th pixel */
    struct filter *filters[LEVELS];
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture;
    struct wish wish; /* of the main thread */
    int coarse;       /* the level that is drawn at once */
    int shown;        /* the level in the window */
    char note[64];    /* in the title, after what is to be seen */

    SDL_mutex *mutex; /* of all that follows */
    SDL_cond *changed, *idle;
    bool working;
    struct wish asked;
    int asked_coarse;
    bool ending;
    struct image drawn; /* a finished level, until the main thread takes it */
    struct wish drawn_wish;
    int drawn_level;
    enum result failed;
    struct error err;
};

static struct filter_options options_of(const struct view *view, const struct wish *wish)
{
    struct filter_options options = view->command->options.filter;
    if (!wish->own) {
        options.phong = (float)lobe_phong_from_roughness(wish->roughness);
        options.phong_override = true;
    }
    return options;
}

static enum result draw_level(const struct view *view, const struct wish *wish, int level, struct image *picture,
                              struct error *err)
{
    struct filter_options options = options_of(view, wish);
    return picture_draw(view->filters[level], &options, picture, err);
}

/* ---- the thread */

/* Waits for a change after the last wish; false: the program ends. */
static bool next_wish(struct view *view, struct wish *wish, int *level)
{
    SDL_LockMutex(view->mutex);
    view->working = false;
    SDL_CondSignal(view->idle);
    while (!view->ending && view->asked.number == wish->number)
        SDL_CondWait(view->changed, view->mutex);
    view->working = true;
    *wish = view->asked;
    *level = view->asked_coarse;
    bool goes_on = !view->ending;
    SDL_UnlockMutex(view->mutex);
    return goes_on;
}

/* Hands a picture or a failure over; false: another wish has come, for which the filter was stopped. */
static bool hand_over(struct view *view, const struct wish *wish, int level, struct image *picture, enum result result,
                      const struct error *err)
{
    SDL_LockMutex(view->mutex);
    image_free(&view->drawn);
    view->drawn = *picture;
    *picture = (struct image){0};
    view->drawn_wish = *wish;
    view->drawn_level = level;
    if (result && result != RESULT_INTERRUPTED) {
        view->failed = result;
        view->err = *err;
    }
    bool goes_on = !result && !view->ending && view->asked.number == wish->number;
    SDL_UnlockMutex(view->mutex);
    SDL_PushEvent(&(SDL_Event){.type = SDL_USEREVENT});
    return goes_on;
}

static int refine(void *context)
{
    struct view *view = context;
    struct wish wish = {0};
    int level;
    while (next_wish(view, &wish, &level)) {
        bool goes_on = true;
        while (goes_on && level-- > 0) {
            struct image picture = {0};
            struct error err;
            enum result result = draw_level(view, &wish, level, &picture, &err);
            goes_on = hand_over(view, &wish, level, &picture, result, &err);
        }
    }
    return 0;
}

/* ---- the window */

static enum result sdl_error(const char *what, struct error *err)
{
    return error_set(err, RESULT_DATA, "--view: %s: %s", what, SDL_GetError());
}

static void set_title(const struct view *view)
{
    char title[300], level[16] = "", wish[64] = "exponents of the passes";
    if (!view->wish.own)
        snprintf(wish, sizeof wish, "p = %.4g, roughness %.2f", lobe_phong_from_roughness(view->wish.roughness),
                 view->wish.roughness);
    if (view->shown > 0)
        snprintf(level, sizeof level, ", 1/%d", 1 << view->shown);
    snprintf(title, sizeof title, "%.180s: %s%s%s", input_file_name(view->command->input), wish, level, view->note);
    SDL_SetWindowTitle(view->window, title);
}

static Uint8 srgb_code(float linear)
{
    double encoded = linear > 0 ? gamma_encode((double)GBUFFER_GAMMA_SRGB, fmin((double)linear, 1)) : 0;
    return (Uint8)(255 * encoded + 0.5);
}

/* Makes the texture of the picture. */
static enum result show(struct view *view, const struct image *picture, int level, struct error *err)
{
    int width, height;
    if (!view->texture || SDL_QueryTexture(view->texture, NULL, NULL, &width, &height) || width != picture->width ||
        height != picture->height) {
        if (view->texture)
            SDL_DestroyTexture(view->texture);
        view->texture = SDL_CreateTexture(view->renderer, SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STREAMING,
                                          picture->width, picture->height);
    }
    void *pixels;
    int pitch;
    if (!view->texture || SDL_LockTexture(view->texture, NULL, &pixels, &pitch))
        return sdl_error("the picture can't be shown", err);
    for (int channel = 0; channel < 3; channel++)
        for (int y = 0; y < picture->height; y++) {
            Uint8 *row = (Uint8 *)pixels + (size_t)y * (size_t)pitch;
            for (int x = 0; x < picture->width; x++)
                row[3 * x + channel] = srgb_code(image_row(picture, channel, y)[x]);
        }
    SDL_UnlockTexture(view->texture);
    view->shown = level;
    set_title(view);
    return RESULT_OK;
}

static void paint(const struct view *view)
{
    int width, height;
    SDL_GetRendererOutputSize(view->renderer, &width, &height);
    SDL_Rect picture = {0, 0, width, height - SLIDER_PX};
    SDL_Rect track = {MARGIN_PX, height - SLIDER_PX / 2 - 1, width - 2 * MARGIN_PX, 2};
    SDL_Rect knob = {MARGIN_PX + (int)(view->wish.roughness * track.w) - 4, height - SLIDER_PX + 4, 8, SLIDER_PX - 8};
    SDL_SetRenderDrawColor(view->renderer, 40, 40, 40, 255);
    SDL_RenderClear(view->renderer);
    SDL_RenderCopy(view->renderer, view->texture, NULL, &picture);
    SDL_SetRenderDrawColor(view->renderer, 120, 120, 120, 255);
    SDL_RenderFillRect(view->renderer, &track);
    SDL_SetRenderDrawColor(view->renderer, 230, 230, 230, 255);
    SDL_RenderFillRect(view->renderer, &knob);
    SDL_RenderPresent(view->renderer);
}

/* Ends what the thread draws. */
static void stop_thread(struct view *view)
{
    interrupt_stop(true);
    SDL_LockMutex(view->mutex);
    while (view->working)
        SDL_CondWait(view->idle, view->mutex);
    SDL_UnlockMutex(view->mutex);
    interrupt_stop(false);
}

/* Draws the coarse level at once and asks the thread for the finer ones. */
static enum result draw_wish(struct view *view, struct error *err)
{
    struct image picture = {0};
    stop_thread(view);
    Uint32 begin = SDL_GetTicks();
    enum result result = draw_level(view, &view->wish, view->coarse, &picture, err);
    Uint32 time_ms = SDL_GetTicks() - begin;
    if (!result)
        result = show(view, &picture, view->coarse, err);
    image_free(&picture);
    SDL_LockMutex(view->mutex);
    view->asked = view->wish;
    view->asked_coarse = view->coarse;
    SDL_CondSignal(view->changed);
    SDL_UnlockMutex(view->mutex);
    if (time_ms > SLOW_MS && view->coarse < LEVELS - 1)
        view->coarse++;
    else if (time_ms < QUICK_MS && view->coarse > 1)
        view->coarse--;
    return result;
}

static enum result set_roughness(struct view *view, double roughness, struct error *err)
{
    view->wish = (struct wish){.roughness = fmin(fmax(roughness, 0), 1), .number = view->wish.number + 1};
    view->note[0] = '\0';
    return draw_wish(view, err);
}

/* The roughness at a place of the slider. */
static double roughness_at(const struct view *view, int x)
{
    int width;
    SDL_GetWindowSize(view->window, &width, NULL);
    return (double)(x - MARGIN_PX) / fmax(width - 2 * MARGIN_PX, 1);
}

static enum result save(struct view *view, struct error *err)
{
    struct cli_filter options = view->command->options;
    const char *output = view->command->output;
    enum result result = RESULT_OK;
    options.filter = options_of(view, &view->wish);
    if (output)
        result = cli_draw(output, &options, &view->levels[0], err);
    snprintf(view->note, sizeof view->note, output ? ", saved" : ", no -o FILE to save to");
    set_title(view);
    return result;
}

/* What the thread has drawn, unless the wish has changed since. */
static enum result take_drawn(struct view *view, struct error *err)
{
    struct image picture = {0};
    SDL_LockMutex(view->mutex);
    enum result result = view->failed;
    int level = view->drawn_level;
    if (result)
        *err = view->err;
    else if (view->drawn_wish.number == view->wish.number) {
        picture = view->drawn;
        view->drawn = (struct image){0};
    }
    SDL_UnlockMutex(view->mutex);
    if (!result && picture.pixels)
        result = show(view, &picture, level, err);
    image_free(&picture);
    return result;
}

static enum result take_event(struct view *view, const SDL_Event *event, bool *quit, struct error *err)
{
    static const double step = 0.01;
    SDL_Keycode key = event->type == SDL_KEYDOWN ? event->key.keysym.sym : SDLK_UNKNOWN;
    *quit |= event->type == SDL_QUIT || key == SDLK_q || key == SDLK_ESCAPE;
    if (event->type == SDL_USEREVENT)
        return take_drawn(view, err);
    if (key == SDLK_LEFT || key == SDLK_RIGHT)
        return set_roughness(view, view->wish.roughness + (key == SDLK_LEFT ? -step : step), err);
    if (key == SDLK_s)
        return save(view, err);
    if (event->type == SDL_MOUSEBUTTONDOWN && event->button.button == SDL_BUTTON_LEFT)
        return set_roughness(view, roughness_at(view, event->button.x), err);
    if (event->type == SDL_MOUSEMOTION && event->motion.state & SDL_BUTTON_LMASK)
        return set_roughness(view, roughness_at(view, event->motion.x), err);
    return RESULT_OK;
}

/* Of a drag only the last place counts: what lies between would be drawn late. */
static void skip_motions(SDL_Event *event)
{
    while (event->type == SDL_MOUSEMOTION &&
           SDL_PeepEvents(event, 1, SDL_GETEVENT, SDL_MOUSEMOTION, SDL_MOUSEMOTION) > 0)
        ;
}

static enum result loop(struct view *view, struct error *err)
{
    enum result result = draw_wish(view, err);
    for (bool quit = false; !result && !quit;) {
        SDL_Event event;
        paint(view);
        if (SDL_WaitEventTimeout(&event, LOOK_MS)) {
            skip_motions(&event);
            result = take_event(view, &event, &quit, err);
        }
        if (!result && interrupt_signal())
            result = error_set(err, RESULT_INTERRUPTED, "interrupted");
    }
    return result;
}

/* ---- beginning and end */

/* As large as the picture, where that fits the screen. */
static enum result open_window(struct view *view, struct error *err)
{
    const struct gbuffer *gbuffer = &view->levels[0];
    int width = gbuffer->window.width > 0 ? gbuffer->window.width : gbuffer->specular.width;
    int height = gbuffer->window.width > 0 ? gbuffer->window.height : gbuffer->specular.height;
    SDL_Rect screen = {0, 0, width, height + SLIDER_PX};
    if (SDL_Init(SDL_INIT_VIDEO))
        return sdl_error("no window can be opened", err);
    SDL_GetDisplayUsableBounds(0, &screen);
    double scale = fmin(1, fmin((double)screen.w / width, (double)(screen.h - SLIDER_PX) / height));
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
    view->window = SDL_CreateWindow(program, SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                    (int)fmax(scale * width, 160), (int)fmax(scale * height, 1) + SLIDER_PX,
                                    SDL_WINDOW_RESIZABLE);
    view->renderer = view->window ? SDL_CreateRenderer(view->window, -1, 0) : NULL;
    view->mutex = SDL_CreateMutex();
    view->changed = SDL_CreateCond();
    view->idle = SDL_CreateCond();
    return view->renderer && view->mutex && view->changed && view->idle ? RESULT_OK : sdl_error("no window can be opened", err);
}

static void close_window(struct view *view)
{
    image_free(&view->drawn);
    SDL_DestroyTexture(view->texture);
    SDL_DestroyRenderer(view->renderer);
    SDL_DestroyWindow(view->window);
    SDL_DestroyCond(view->changed);
    SDL_DestroyCond(view->idle);
    SDL_DestroyMutex(view->mutex);
    SDL_Quit();
}

/* The slider begins at the exponents' geometric mean, those of mirrors left out. */
static double first_roughness(const struct gbuffer *gbuffer, const struct filter_options *options)
{
    double sum = 0, count = 0;
    if (options->phong_override || !gbuffer->phong.pixels)
        return lobe_roughness_from_phong(options->phong >= 0 ? (double)options->phong : 300);
    for (int y = 0; y < gbuffer->phong.height; y++)
        for (int x = 0; x < gbuffer->phong.width; x++) {
            float phong = image_row(&gbuffer->phong, 0, y)[x];
            if (phong > 0 && isfinite(phong)) {
                sum += log((double)phong);
                count++;
            }
        }
    return count > 0 ? lobe_roughness_from_phong(exp(sum / count)) : 0;
}

static enum result run(const struct cli_glossfilter *command, struct error *err)
{
    struct view view = {.command = command, .coarse = 2};
    SDL_Thread *thread = NULL;
    enum result result = cli_read(command, &view.levels[0], err);
    for (int level = 1; !result && level < LEVELS; level++)
        result = picture_reduce(&view.levels[0], 1 << level, &view.levels[level], err);
    for (int level = 0; !result && level < LEVELS; level++)
        result = filter_open(&view.levels[level], &view.filters[level], err);
    if (!result)
        result = open_window(&view, err);
    if (!result) {
        view.wish = (struct wish){.own = view.levels[0].phong.pixels && !command->options.filter.phong_override,
                                  .roughness = first_roughness(&view.levels[0], &command->options.filter),
                                  .number = 1};
        thread = SDL_CreateThread(refine, "refine", &view);
        result = thread ? loop(&view, err) : sdl_error("no thread can be started", err);
    }
    if (thread) {
        SDL_LockMutex(view.mutex);
        view.ending = true;
        SDL_CondSignal(view.changed);
        SDL_UnlockMutex(view.mutex);
        interrupt_stop(true);
        SDL_WaitThread(thread, NULL);
    }
    close_window(&view);
    for (int level = 0; level < LEVELS; level++) {
        filter_close(view.filters[level]);
        gbuffer_free(&view.levels[level]);
    }
    return result;
}

int main(int argc, char **argv)
{
    struct cli_glossfilter command;
    struct error err;
    interrupt_install();
    enum result result = cli_glossfilter(argc, argv, &command, &err);
    if (result == RESULT_OK)
        result = run(&command, &err);
    text_list_free(&command.map);
    if (result == RESULT_INTERRUPTED)
        interrupt_reraise();
    if (result != RESULT_OK)
        cli_complain(program, &err);
    return (int)result;
}
