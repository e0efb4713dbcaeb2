/* The input is a picture's size, the filter's options, and its planes: one byte chooses a value, often an awkward one.
 * Every float of the results is finite. */
#include "fuzz_support.h"

#include "compose.h"
#include "filter.h"

#include <float.h>
#include <math.h>

enum { MAX_SIDE = 24 };

struct bytes {
    const uint8_t *data;
    size_t size, next;
};

/* The input over and over. */
static unsigned take(struct bytes *bytes)
{
    return bytes->data[bytes->next++ % bytes->size];
}

static float take_float(struct bytes *bytes)
{
    static const float awkward[] = {0,     -0.0f, 1,      -1,      0.5f, INFINITY, -INFINITY, NAN,
                                    1e-45f, 1e-30f, 1e30f, FLT_MAX, FLT_MIN, 1e20f, 65504,  1e-6f};
    unsigned byte = take(bytes);
    if (byte < 32)
        return awkward[byte / 2];
    if (byte < 40) {
        uint32_t bits = 0;
        float value;
        for (int i = 0; i < 4; i++)
            bits = bits << 8 | take(bytes);
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    return ((float)byte - 148) / 16;
}

static void fill(struct bytes *bytes, int width, int height, int channels, struct image *image)
{
    struct error err;
    FUZZ_REQUIRE(!image_alloc(image, width, height, channels, &err));
    for (int channel = 0; channel < channels; channel++)
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                image_row(image, channel, y)[x] = take_float(bytes);
}

static void require_finite(const struct image *image)
{
    for (int channel = 0; channel < image->channels; channel++)
        for (int y = 0; y < image->height; y++)
            for (int x = 0; x < image->width; x++)
                FUZZ_REQUIRE(isfinite(image_row(image, channel, y)[x]));
}

static struct filter_options take_options(struct bytes *bytes)
{
    struct filter_options options = filter_options_default();
    unsigned kinds = take(bytes), limits = take(bytes);
    options.weights = (enum filter_weights)(kinds % 3);
    options.formula = (enum filter_formula)(kinds / 3 % 2);
    options.window = (enum filter_window)(kinds / 6 % 2);
    options.phong_override = kinds / 12 % 2;
    options.isa = (enum cpu_isa)(kinds / 24 % CPU_ISA_COUNT);
    options.threads = 1 + (int)(kinds / 128);
    options.phong = fabsf(take_float(bytes));
    if (isnan(options.phong))
        options.phong = powf(2, (float)take(bytes) / 8);
    options.radius_step = 1 << limits % 4;
    options.max_radius_px = limits / 4 % 4 ? 0 : (int)take(bytes);
    options.energy = (take(bytes) + 0.5) / 256;
    options.tolerance = FILTER_TOLERANCE_DRAFT * (take(bytes) % 2);
    options.max_angle_rad = (take(bytes) + 1) / 256.0 * 1.5707963267948966;
    return options;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct gbuffer gbuffer = {0};
    struct image glossy = {0}, radius = {0}, image = {0};
    struct error err = {0};
    if (!size)
        return 0;
    struct bytes bytes = {.data = data, .size = size};
    int width = 1 + (int)take(&bytes) % MAX_SIDE, height = 1 + (int)take(&bytes) % MAX_SIDE;
    struct filter_options options = take_options(&bytes);
    unsigned present = take(&bytes);
    gbuffer.has_eye = present & 1;
    options.mode = present & 32 ? FILTER_MODE_PAPER : FILTER_MODE_BEST;
    for (int i = 0; i < 3; i++) {
        float value = take_float(&bytes);
        gbuffer.eye[i] = isfinite(value) ? value : 0;
    }
    gbuffer.view_angle = (float)take(&bytes) / 255 * 6.2831853f;
    gbuffer.working_gamma = present & 2 ? GBUFFER_GAMMA_SRGB : (float)take(&bytes) / 64;
    fill(&bytes, width, height, 3, &gbuffer.specular);
    fill(&bytes, width, height, 3, &gbuffer.position);
    fill(&bytes, width, height, 4, &gbuffer.endpoint);
    if (present & 4)
        fill(&bytes, width, height, 3, &gbuffer.base);
    if (present & 8)
        fill(&bytes, width, height, 3, &gbuffer.reflectance);
    if (present & 16)
        fill(&bytes, width, height, 1, &gbuffer.phong);
    if (present & 64)
        fill(&bytes, width, height, 4, &gbuffer.rays);
    FUZZ_REQUIRE(filter_left_out(&gbuffer) <= (long)width * height);
    enum result result = filter_glossy(&gbuffer, &options, &glossy, &radius, &err);
    FUZZ_REQUIRE(result == RESULT_OK || *err.text);
    if (!result) {
        require_finite(&glossy);
        require_finite(&radius);
        FUZZ_REQUIRE(!compose(&gbuffer, &glossy, &image, &err));
    }
    image_free(&image);
    image_free(&radius);
    image_free(&glossy);
    gbuffer_free(&gbuffer);
    return 0;
}
