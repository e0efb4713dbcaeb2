/* The passes file and the finished image: channels, refusals by name, formats. */
#include "passes_file.h"

#include "image_file.h"
#include "io_support.h"

static void fill_gbuffer(struct gbuffer *gbuffer, int width, int height)
{
    struct error err;
    *gbuffer = (struct gbuffer){
        .has_eye = true, .eye = {1, -2, 3.5f}, .view_angle = 1.1f, .working_gamma = GBUFFER_GAMMA_SRGB};
    struct image *images[] = {&gbuffer->base,     &gbuffer->specular, &gbuffer->reflectance,
                              &gbuffer->position, &gbuffer->endpoint, &gbuffer->phong};
    static const int channels[] = {3, 3, 3, 3, 4, 1};
    for (int i = 0; i < 6; i++) {
        assert_ok(image_alloc(images[i], width, height, channels[i], &err), err);
        fill_distinct(images[i]);
        for (int channel = 0; channel < channels[i]; channel++) /* no two planes alike */
            image_row(images[i], channel, 0)[0] = (float)(10 * i + channel);
    }
}

static void assert_same_image(const struct image *a, const struct image *b)
{
    assert_int_equal(a->channels, b->channels);
    for (int channel = 0; channel < a->channels; channel++)
        assert_same_plane(a, channel, b, channel);
}

static void passes_file__whole_gbuffer__comes_back(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 40}, {17, 3}, {67, 35}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        struct gbuffer written, seen;
        struct error err;
        fill_gbuffer(&written, sizes[i][0], sizes[i][1]);
        assert_ok(passes_file_write(in_scratch("a.exr"), &written, &err), err);
        assert_ok(passes_file_read(in_scratch("a.exr"), &seen, &err), err);
        assert_same_image(&written.base, &seen.base);
        assert_same_image(&written.specular, &seen.specular);
        assert_same_image(&written.reflectance, &seen.reflectance);
        assert_same_image(&written.position, &seen.position);
        assert_same_image(&written.endpoint, &seen.endpoint);
        assert_same_image(&written.phong, &seen.phong);
        assert_true(seen.has_eye);
        assert_memory_equal(seen.eye, written.eye, sizeof written.eye);
        assert_near(seen.view_angle, 1.1f, 0);
        assert_near(seen.working_gamma, GBUFFER_GAMMA_SRGB, 0);
        gbuffer_free(&written);
        gbuffer_free(&seen);
    }
}

static void passes_file_write__whole_gbuffer__contract_of_the_format(void **state)
{
    (void)state;
    struct gbuffer gbuffer;
    struct error err;
    fill_gbuffer(&gbuffer, 17, 3);
    assert_ok(passes_file_write(in_scratch("a.exr"), &gbuffer, &err), err);
    const char *info = run("oiiotool --info -v a.exr");
    assert_contains(info, "17 x    3, 17 channel, float openexr");
    assert_contains(info, "compression: \"zip\"");
    assert_contains(info, "povgloss:viewAngle: 1.1\n");
    assert_contains(info, "povgloss:version: \"");
    assert_contains(run("oiiotool a.exr --ch R,G,B,specular.R,specular.G,specular.B,reflectance.R,reflectance.G,"
                        "reflectance.B,P.X,P.Y,P.Z,endpoint.X,endpoint.Y,endpoint.Z,endpoint.W,phong.V "
                        "--cut 1x1+0+0 --echo 'first pixel {TOP.AVGCOLOR}.'"),
                    "first pixel 0,1,2,10,11,12,20,21,22,30,31,32,40,41,42,43,50.");
    gbuffer_free(&gbuffer);
}

static void passes_file__empty_images__left_out(void **state)
{
    (void)state;
    struct gbuffer gbuffer, seen;
    struct error err;
    fill_gbuffer(&gbuffer, 17, 3);
    image_free(&gbuffer.base);
    image_free(&gbuffer.reflectance);
    image_free(&gbuffer.phong);
    gbuffer.has_eye = false;
    gbuffer.view_angle = gbuffer.working_gamma = 0;
    assert_ok(passes_file_write(in_scratch("b.exr"), &gbuffer, &err), err);
    assert_ok(passes_file_read(in_scratch("b.exr"), &seen, &err), err);
    assert_null(seen.base.pixels);
    assert_null(seen.reflectance.pixels);
    assert_null(seen.phong.pixels);
    assert_false(seen.has_eye);
    assert_near(seen.view_angle, 0, 0);
    assert_near(seen.working_gamma, 0, 0);
    assert_same_image(&gbuffer.endpoint, &seen.endpoint);
    gbuffer_free(&gbuffer);
    gbuffer_free(&seen);
}

static void assert_refused(const char *name, const char *part)
{
    struct gbuffer gbuffer;
    struct error err;
    enum result result = passes_file_read(in_scratch(name), &gbuffer, &err);
    if (result != RESULT_DATA)
        fail_msg("%s: result %d", part, result);
    assert_contains(err.text, name);
    assert_contains(err.text, part);
    const struct gbuffer empty = {0};
    assert_memory_equal(&gbuffer, &empty, sizeof empty);
}

static void passes_file_read__one_channel_missing__names_it_and_its_meaning(void **state)
{
    (void)state;
    static const char *const names[] = {"R",             "G",             "B",          "specular.R", "specular.G",
                                        "specular.B",    "reflectance.R", "reflectance.G", "reflectance.B", "P.X",
                                        "P.Y",           "P.Z",           "endpoint.X", "endpoint.Y", "endpoint.Z",
                                        "endpoint.W"};
    struct gbuffer gbuffer;
    struct exr_contents contents;
    struct error err;
    fill_gbuffer(&gbuffer, 5, 4);
    assert_ok(passes_file_write(in_scratch("a.exr"), &gbuffer, &err), err);
    gbuffer_free(&gbuffer);
    assert_ok(exr_read(in_scratch("a.exr"), &contents, &err), err);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        struct exr_channel channels[17];
        char expected[64];
        int count = 0;
        for (int j = 0; j < contents.image.channels; j++) {
            if (strcmp(contents.names[j], names[i]) == 0)
                continue;
            channels[count] = (struct exr_channel){.image = &contents.image, .channel = j};
            strcpy(channels[count++].name, contents.names[j]);
        }
        assert_int_equal(count, 16);
        assert_ok(exr_write(in_scratch("c.exr"), channels, count, NULL, &err), err);
        snprintf(expected, sizeof expected, "has no channel %s (", names[i]);
        assert_refused("c.exr", expected);
    }
    exr_contents_free(&contents);
}

static void passes_file_read__required_group_missing__refused_with_its_meaning(void **state)
{
    (void)state;
    static const char *const expected[] = {"specular.R (the radiance along", "P.X (the position of",
                                           "endpoint.X (the end of the mirrored ray"};
    for (int i = 0; i < 3; i++) {
        struct gbuffer gbuffer;
        struct error err;
        fill_gbuffer(&gbuffer, 5, 4);
        image_free(i == 0 ? &gbuffer.specular : i == 1 ? &gbuffer.position : &gbuffer.endpoint);
        assert_ok(passes_file_write(in_scratch("d.exr"), &gbuffer, &err), err);
        assert_refused("d.exr", expected[i]);
        gbuffer_free(&gbuffer);
    }
}

static void passes_file_read__attribute_out_of_range__refused(void **state)
{
    (void)state;
    static const struct {
        float eye, view_angle, working_gamma;
        const char *name;
    } cases[] = {{NAN, 1, 1, "povgloss:eye"},         {INFINITY, 1, 1, "povgloss:eye"},
                 {0, -1, 1, "povgloss:viewAngle"},    {0, NAN, 1, "povgloss:viewAngle"},
                 {0, 6.3f, 1, "povgloss:viewAngle"},  {0, 1, NAN, "povgloss:workingGamma"},
                 {0, 1, -2, "povgloss:workingGamma"}, {0, 1, INFINITY, "povgloss:workingGamma"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct gbuffer gbuffer;
        struct error err;
        fill_gbuffer(&gbuffer, 5, 4);
        gbuffer.eye[1] = cases[i].eye;
        gbuffer.view_angle = cases[i].view_angle;
        gbuffer.working_gamma = cases[i].working_gamma;
        assert_ok(passes_file_write(in_scratch("e.exr"), &gbuffer, &err), err);
        assert_refused("e.exr", cases[i].name);
        gbuffer_free(&gbuffer);
    }
}

static void passes_file_read__not_an_exr__refused(void **state)
{
    (void)state;
    write_bytes(in_scratch("f.exr"), "text", 4);
    assert_refused("f.exr", "not an OpenEXR file");
}

static void image_format_choose__extension_or_name__format(void **state)
{
    (void)state;
    static const struct {
        const char *path, *name;
        int format; /* -1: refused */
    } cases[] = {
        {"a.exr", NULL, IMAGE_FORMAT_EXR}, {"a.b/c.PnG", NULL, IMAGE_FORMAT_PNG}, {".exr", NULL, IMAGE_FORMAT_EXR},
        {"a.png", "exr", IMAGE_FORMAT_EXR}, {"-", "PNG", IMAGE_FORMAT_PNG},        {"a", "Exr", IMAGE_FORMAT_EXR},
        {"-", NULL, -1},                   {"a", NULL, -1},                       {"a.exr/b", NULL, -1},
        {"a.jpg", NULL, -1},               {"a.exr.", NULL, -1},                  {"a.exr", "jpg", -1},
        {"a.exr", "", -1},                 {"", NULL, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        enum image_format format;
        struct error err;
        enum result result = image_format_choose(cases[i].path, cases[i].name, &format, &err);
        if (cases[i].format >= 0) {
            assert_ok(result, err);
            assert_int_equal(format, cases[i].format);
        } else {
            assert_int_equal(result, RESULT_USAGE);
            assert_contains(err.text, "--format exr");
        }
    }
}

static void image_write__exr_with_layers__all_channels(void **state)
{
    (void)state;
    struct image image, glossy, radius;
    struct exr_contents contents;
    struct error err;
    assert_ok(image_alloc(&image, 17, 3, 3, &err), err);
    assert_ok(image_alloc(&glossy, 17, 3, 3, &err), err);
    assert_ok(image_alloc(&radius, 17, 3, 1, &err), err);
    fill_distinct(&image);
    image_row(&glossy, 2, 1)[4] = 7;
    image_row(&radius, 0, 2)[16] = 9;
    const struct exr_channel layers[] = {
        {"glossy.R", &glossy, 0}, {"glossy.G", &glossy, 1}, {"glossy.B", &glossy, 2}, {"radius.V", &radius, 0}};
    assert_ok(image_write(in_scratch("g.exr"), IMAGE_FORMAT_EXR, 0, &image, layers, 4, &err), err);
    assert_contains(run("oiiotool --info -v g.exr"), "channel list: R, G, B, glossy.R, glossy.G, glossy.B, radius.V");
    assert_ok(exr_read(in_scratch("g.exr"), &contents, &err), err);
    assert_same_plane(&image, 0, &contents.image, exr_find(&contents, "R"));
    assert_same_plane(&image, 1, &contents.image, exr_find(&contents, "G"));
    assert_same_plane(&image, 2, &contents.image, exr_find(&contents, "B"));
    for (int i = 0; i < 4; i++)
        assert_same_plane(layers[i].image, layers[i].channel, &contents.image, exr_find(&contents, layers[i].name));
    exr_contents_free(&contents);
    assert_int_equal(image_write(in_scratch("g.png"), IMAGE_FORMAT_PNG, 8, &image, layers, 4, &err), RESULT_USAGE);
    assert_contains(err.text, "--format exr");
    assert_int_not_equal(access(in_scratch("g.png"), F_OK), 0);
    image_free(&image);
    image_free(&glossy);
    image_free(&radius);
}

static void image_write__without_layers__both_formats(void **state)
{
    (void)state;
    struct image image;
    struct error err;
    assert_ok(image_alloc(&image, 17, 3, 3, &err), err);
    assert_ok(image_write(in_scratch("h.exr"), IMAGE_FORMAT_EXR, 0, &image, NULL, 0, &err), err);
    assert_contains(run("oiiotool --info h.exr"), "17 x    3, 3 channel, float openexr");
    assert_ok(image_write(in_scratch("h.png"), IMAGE_FORMAT_PNG, 16, &image, NULL, 0, &err), err);
    assert_contains(run("oiiotool --info h.png"), "17 x    3, 3 channel, uint16 png");
    image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passes_file__whole_gbuffer__comes_back),
        cmocka_unit_test(passes_file_write__whole_gbuffer__contract_of_the_format),
        cmocka_unit_test(passes_file__empty_images__left_out),
        cmocka_unit_test(passes_file_read__one_channel_missing__names_it_and_its_meaning),
        cmocka_unit_test(passes_file_read__required_group_missing__refused_with_its_meaning),
        cmocka_unit_test(passes_file_read__attribute_out_of_range__refused),
        cmocka_unit_test(passes_file_read__not_an_exr__refused),
        cmocka_unit_test(image_format_choose__extension_or_name__format),
        cmocka_unit_test(image_write__exr_with_layers__all_channels),
        cmocka_unit_test(image_write__without_layers__both_formats),
    };
    return cmocka_run_group_tests_name("passes_file", tests, scratch_setup, scratch_teardown);
}
