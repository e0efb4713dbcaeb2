/* The copies of small scenes, as text; what is learnt of a scene; lines, includes and hostile input.
 *
 * Runs of spaces count as one in the comparisons.
 */
#include "scene_rewrite.h"

#include "gbuffer.h"
#include "io_support.h"
#include "scene_discover.h"

/* What --gloss says in the tests; nothing unless a test sets it. */
static struct gloss_choice chosen;

/* Loads the scene `name` of the scratch folder, with includes from there. */
static enum result load(struct scene *scene, const char *name, struct error *err)
{
    const char *const directories[] = {scratch};
    return scene_load(scene, in_scratch(name), &chosen, directories, 1, err);
}

static void write_text(const char *name, const char *text)
{
    write_bytes(in_scratch(name), text, strlen(text));
}

/* POV-Ray isn't asked for what only it knows. */
static enum result settle(struct scene *scene, struct error *err)
{
    return scene->needs_discovery ? scene_settle(scene, err) : RESULT_OK;
}

static void load_text(struct scene *scene, const char *text)
{
    struct error err;
    write_text("scene.pov", text);
    assert_ok(load(scene, "scene.pov", &err), err);
    assert_ok(settle(scene, &err), err);
}

/* The text of a file of a copy; the caller frees it. */
static char *copy_text(const struct scene *scene, enum scene_copy copy, int file)
{
    struct error err;
    char *name = NULL;
    size_t size;
    assert_ok(scene_write_copy(scene, copy, scratch, &err), err);
    assert_ok(scene_copy_name(scene, copy, file, &name, &err), err);
    char *text = (char *)read_bytes(in_scratch(name), &size);
    text[size] = 0;
    assert_int_equal(strlen(text), size);
    free(name);
    return text;
}

static void squeeze(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++)
        if (*from != ' ' || from[1] != ' ')
            *to++ = *from;
    *to = 0;
}

struct rewriting {
    enum scene_copy copy;
    const char *source, *expected;
};

/* NULL: the copy is the source. */
static void assert_rewritings(const struct rewriting *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct scene scene;
        load_text(&scene, cases[i].source);
        char *text = copy_text(&scene, cases[i].copy, 0);
        char *expected = strdup(cases[i].expected ? cases[i].expected : cases[i].source);
        squeeze(text);
        squeeze(expected);
        if (strcmp(text, expected))
            fail_msg("copy %d of\n%s\nis\n%s\ninstead of\n%s", (int)cases[i].copy, cases[i].source, text, expected);
        free(text);
        free(expected);
        scene_free(&scene);
    }
}

#define ASSERT_REWRITINGS(cases) assert_rewritings(cases, sizeof(cases) / sizeof *(cases))

#define PLAIN SCENE_COPY_PLAIN
#define BASE SCENE_COPY_BASE
#define BASE2 SCENE_COPY_BASE_SECOND
#define MIRROR SCENE_COPY_MIRROR
#define MIRROR2 SCENE_COPY_MIRROR_SECOND
#define REFLECTANCE SCENE_COPY_REFLECTANCE
#define CODED SCENE_COPY_CODED

#define OPEN " union { povgloss_nothing()"
#define FINISH(of) "finish { " STATE_FINISH(of) " "
#define INHERIT_FINISH(state) \
    "#ifdef (" state ") #declare povgloss_state = " state "; #declare povgloss_state = <povgloss_state.x, " \
    "povgloss_state.y, povgloss_state.z, povgloss_default_state.t>; #end"
#define TEXTURE "texture { " STATE_LAYER " " STATE_LAYERED " "
#define INHERIT_TEXTURE(state) "#ifdef (" state ") #declare povgloss_texture = " state "; #end"

static void copy__statements_of_the_top_level__union_broken_dropped_or_kept(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {PLAIN, "camera { angle 3 }\nsphere { 0, 1 }", "povgloss_modifiers() } camera { angle 3 }" OPEN "\nsphere { 0, 1 }"},
        {PLAIN, "background { rgb 1 } x", "povgloss_modifiers() } background { rgb 1 }" OPEN " x"},
        {PLAIN, "fog { distance 9 } x", "povgloss_modifiers() } fog { distance 9 }" OPEN " x"},
        {PLAIN, "sky_sphere { S } x", "povgloss_modifiers() } sky_sphere { S }" OPEN " x"},
        {PLAIN, "rainbow { R } x", "povgloss_modifiers() } rainbow { R }" OPEN " x"},
        {PLAIN, "media { M } x", "povgloss_modifiers() } media { M }" OPEN " x"},
        {PLAIN, "global_settings { assumed_gamma 1 } x", "povgloss_modifiers() } global_settings { assumed_gamma 1 }" OPEN " x"},
        {PLAIN, "light_source { 0 rgb 1 }", NULL},
        {BASE, "camera { angle 3 } fog { distance 9 } light_source { 0 rgb 1 }", NULL},
        {BASE2, "camera { angle 3 }\nglobal_settings { }\nfog { \n } media { M } x", "\n\n\n x"},
        {MIRROR, "camera { angle 3 } fog { distance 9 } background { rgb 1 } x",
         "povgloss_modifiers() } camera { angle 3 }" OPEN " x"},
        {MIRROR2, "camera { angle 3 } fog { distance 9 } x", " x"},
        {REFLECTANCE, "camera { angle 3 } sky_sphere { S } x", "povgloss_modifiers() } camera { angle 3 }" OPEN " x"},
        {CODED, "camera { angle 3 } rainbow { R } x", "povgloss_modifiers() } camera { angle 3 }" OPEN " x"},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__statements_elsewhere__only_the_top_level_counts(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {PLAIN, "#declare C = camera { angle 3 } #declare F = fog { distance 9 }", NULL},
        {BASE2, "#declare C = camera { angle 3 }", NULL},
        {PLAIN, "sphere { 0, 1 interior { media { M } } }", NULL},
        {PLAIN, "#if (1) camera { angle 3 } #end", "#if (1) povgloss_modifiers() } camera { angle 3 }" OPEN " #end"},
        {BASE2, "#ifdef (X) camera { angle 3 } #else camera { angle 4 } #end", "#ifdef (X) #else #end"},
        {PLAIN, "#macro C() camera { angle 3 } #end", "#macro C() povgloss_modifiers() } camera { angle 3 }" OPEN " #end"},
        /* A macro's media is mostly for an interior. */
        {PLAIN, "#macro M() media { M } #if (1) media { N } #end #end media { O }",
         "#macro M() media { M } #if (1) media { N } #end #end povgloss_modifiers() } media { O }" OPEN},
        {PLAIN, "#while (1) #macro M() #end media { M } #end", "#while (1) #macro M() #end povgloss_modifiers() } media { M }" OPEN " #end"},
        /* Braces that a conditional opens twice and closes once. */
        {PLAIN, "#if (1) union { #else merge { #end sphere { 0, 1 } }\ncamera { angle 3 }",
         "#if (1) union { #else merge { #end sphere { 0, 1 } }\npovgloss_modifiers() } camera { angle 3 }" OPEN},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__camera_with_aperture__ends_by_the_passes_choice(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "camera { aperture 1 }", "povgloss_modifiers() } camera { aperture 1 povgloss_camera() }" OPEN},
        {PLAIN, "#declare C = camera { aperture 1 } camera { C }",
         "#declare C = camera { aperture 1 } povgloss_modifiers() } camera { C povgloss_camera() }" OPEN},
        {BASE2, "camera { aperture 1 }", ""},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__technical_settings__neither_gamma_nor_photons(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "global_settings { assumed_gamma 2.2 max_trace_level 9 }",
         "povgloss_modifiers() } global_settings { adc_bailout 2.2 max_trace_level 9 }" OPEN},
        {MIRROR, "global_settings { assumed_gamma srgb\n radiosity { count 9\n } photons { spacing 1 } number_of_waves 3 }",
         "povgloss_modifiers() } global_settings { \n \n number_of_waves 3 }" OPEN},
        {CODED, "global_settings { subsurface { samples 1, 2 } ambient_light 1 }",
         "povgloss_modifiers() } global_settings { ambient_light 1 }" OPEN},
        {PLAIN, "global_settings { assumed_gamma 2.2 radiosity { } }",
         "povgloss_modifiers() } global_settings { assumed_gamma 2.2 radiosity { } }" OPEN},
        {PLAIN, "global_settings { photons { count 9 load_file \"a\" } } sphere { 0, 1 photons { target } }",
         "povgloss_modifiers() } global_settings { photons { count 9 load_file \"a\" } }" OPEN " sphere { 0, 1 photons { "
         "target } }"},
        {REFLECTANCE, "global_settings { assumed_gamma srgb photons { } }",
         "povgloss_modifiers() } global_settings { assumed_gamma srgb photons { povgloss_photons() } }" OPEN},
    };
    ASSERT_REWRITINGS(cases);
}

static void coded__textures_in_objects__become_transforms(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "sphere { 0, 1 texture { pigment { rgb 1 } } }", "sphere { 0, 1 transform {} }"},
        {CODED, "sphere { 0, 1 pigment { rgb 1 } finish { phong 1 } normal { bumps } }",
         "sphere { 0, 1 transform {} transform {} transform {} }"},
        {CODED, "sphere { 0, 1 material { M } interior_texture { T } }",
         "sphere { 0, 1 transform {} transform {} }"},
        {CODED, "sphere { 0, 1\n texture {\n T\n }\n hollow }", "sphere { 0, 1\n transform {}\n\n\n hollow }"},
        {CODED, "union { object { O texture { A } texture { B } } pigment { P } }",
         "union { object { O transform {} transform {} } transform {} }"},
        {CODED, "blob { sphere { 0, 1, 1 pigment { P } } }", "blob { sphere { 0, 1, 1 transform {} } }"},
        {CODED, "#macro M() texture { T } #end", "#macro M() #if (povgloss_value > 0) texture { T } #else transform {} #end #end"},
        {CODED, "#declare X = sphere { 0, 1 texture { T } }", "#declare X = sphere { 0, 1 transform {} }"},
    };
    ASSERT_REWRITINGS(cases);
}

static void coded__declared_textures__stay_with_their_layers(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "#declare T = texture { pigment { rgb 1 } finish { phong 1 } }", NULL},
        {CODED, "#declare T = texture { A } texture { B }\ntexture { C }\nsphere { 0, 1 texture { T } }",
         "#declare T = texture { A } texture { B }\ntexture { C }\nsphere { 0, 1 transform {} }"},
        {CODED, "#declare P = pigment { rgb 1 } #declare F = finish { phong 1 } #declare N = normal { bumps }", NULL},
        {CODED, "#macro P() #local M = material { texture { T } interior { ior 2 } }; #end", NULL},
        /* In the scene itself, outside macros, #local is #declare. */
        {CODED, "#local M = 1; camera { #if (1) #local M = 2; #end }", "#declare M = 1; povgloss_modifiers() } camera { #if (1) "
                "#declare M = 2; #end } union { povgloss_nothing()"},
        {CODED, "#declare A[0] = texture { T }", NULL},
        {CODED, "#default { texture { pigment { rgb 1 } } }",
         "povgloss_modifiers() } #default { texture { pigment { rgb 1 } } } #default { texture { povgloss_default } } "
         "union { povgloss_nothing()"},
        {CODED, "# default { finish { ambient 0 } } sphere { 0, 1 pigment { P } }",
         "povgloss_modifiers() } # default { finish { ambient 0 } } #default { texture { povgloss_default } } "
         "union { povgloss_nothing() sphere { 0, 1 transform {} }"},
    };
    ASSERT_REWRITINGS(cases);
}

static void coded__triangles__textures_go_without_a_transform(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "mesh { triangle { a, b, c texture { T } } texture { U } }", "mesh { triangle { a, b, c } transform {} }"},
        {CODED, "smooth_triangle { a, n, b, n, c, n texture { T } }", "smooth_triangle { a, n, b, n, c, n }"},
        {CODED, "mesh { triangle { a, b, c\ntexture {\nT } } }", "mesh { triangle { a, b, c\n\n } }"},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__functions__untouched(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "#declare F = function { pigment { bozo } }", NULL},
        {MIRROR, "#declare F = function { pigment { bozo } }", NULL},
        {MIRROR, "isosurface { function { F(x, y, z).transmit + x } }", NULL},
        {REFLECTANCE, "#declare F = function (x, y) { F(x, y, 0).transmit + G.filter }", NULL},
        {MIRROR, "#declare F = function 9, 9 { pigment { bozo } }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

static void mirror__pigments__those_of_the_pass(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {MIRROR, "sphere { 0, 1 pigment { rgb 1 } }", "sphere { 0, 1 pigment { povgloss_pigment } }"},
        {MIRROR2, "sphere { 0, 1 texture { pigment { rgb\n1 } normal { bumps } } }",
         "sphere { 0, 1 " TEXTURE "pigment { povgloss_pigment }\n normal { bumps } } }"},
        {MIRROR, "#declare P = pigment { rgbt 1 } #declare T = pigment { P scale 2 };", NULL},
        {BASE, "sphere { 0, 1 pigment { rgbt 1 } }", NULL},
        {PLAIN, "sphere { 0, 1 pigment { rgbt 1 } finish { reflection 1 } }", NULL},
        {REFLECTANCE, "sphere { 0, 1 pigment { rgb 1 } }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__finishes__marked(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {BASE, "sphere { 0, 1 finish { phong 1 } }",
         "sphere { 0, 1 " FINISH("povgloss_default_state") "phong 1 povgloss_finish(0) } }"},
        {BASE, "sphere { 0, 1 finish { } }", "sphere { 0, 1 " FINISH("povgloss_default_state") "povgloss_finish(0) } }"},
        {MIRROR, "sphere { 0, 1 texture { finish { reflection 0.5 Gloss(9) } } }",
         "sphere { 0, 1 " TEXTURE FINISH("povgloss_texture") STATE_REFLECTION("1") " reflection 0.5 "
         "Gloss(9) povgloss_finish(0) } } }"},
        {REFLECTANCE, "sphere { 0, 1 finish { reflection { 0.1, 1 fresnel } } }",
         "sphere { 0, 1 " FINISH("povgloss_default_state") STATE_REFLECTION("1") " reflection { 0.1, 1 fresnel } "
         "povgloss_finish(0) } }"},
        {PLAIN, "sphere { 0, 1 finish { reflection 1 Gloss(9) } }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__chosen_names__given_their_exponent(void **state)
{
    (void)state;
    static struct gloss_name names[] = {{"N", 300}, {"M", INFINITY}};
    static const struct rewriting cases[] = {
        {BASE, "#declare N = finish { F } x",
         "#declare N = finish { #declare povgloss_given = 300; " STATE_FINISH("povgloss_default_state") " "
         "povgloss_of_default() F povgloss_finish(1) "
         "#declare povgloss_given = -1; } #declare povgloss_of_0 = povgloss_last; x"},
        {BASE, "#declare M = material { texture { T } } x",
         "#declare M = material { #declare povgloss_given = 1e+30; #declare povgloss_last = povgloss_none; " TEXTURE
         "T " FINISH("povgloss_texture") "povgloss_finish(0) } } #declare povgloss_given = -1; } "
         "#declare povgloss_of_0 = povgloss_last; x"},
        {PLAIN, "#declare N = finish { F }", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        chosen = (struct gloss_choice){.names = i == 1 ? names + 1 : names, .name_count = 1};
        assert_rewritings(cases + i, 1);
    }
    chosen = (struct gloss_choice){0};
}

static void copy__highlights__noted_for_automatic_gloss(void **state)
{
    (void)state;
    static const struct rewriting automatic[] = {
        {BASE, "finish { phong 1 phong_size 4*S reflection 0 }",
         FINISH("povgloss_default_state") "phong 1 #declare povgloss_size = 4*S; povgloss_phong_size() "
         STATE_REFLECTION("0") " reflection 0 povgloss_finish(0) }"},
        {MIRROR, "finish { specular 1 roughness\n1/60 }",
         FINISH("povgloss_default_state") "specular 1 #declare povgloss_size =\n1/60; povgloss_roughness() "
         "povgloss_finish(0) }"},
        {CODED, "#declare F = finish { phong_size 9 }", NULL},
    };
    static const struct rewriting else_plain[] = {
        {BASE, "finish { phong_size 9 }", FINISH("povgloss_default_state") "phong_size 9 povgloss_finish(0) }"},
    };
    chosen.automatic = true;
    ASSERT_REWRITINGS(automatic);
    chosen = (struct gloss_choice){0};
    ASSERT_REWRITINGS(else_plain);
}

/* Names have the indices of their first declaration. */
static void copy__declared_finishes_and_textures__hand_their_gloss_on(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {BASE, "#declare X = 1; #declare F = finish { phong 1 }\nsphere { 0, X finish { F } }",
         "#declare X = 1; #declare F = " FINISH("povgloss_default_state") "povgloss_of_default() phong 1 "
         "povgloss_finish(1) } "
         "#declare povgloss_of_1 = povgloss_last; \n"
         "sphere { 0, X " FINISH("povgloss_default_state") "F " INHERIT_FINISH("povgloss_of_1") " "
         "povgloss_finish(0) } }"},
        {BASE, "#declare T = texture { A };\nsphere { 0, 1 texture { T } }",
         "#declare T = " TEXTURE "A }; #declare povgloss_of_0 = povgloss_last; \n"
         "sphere { 0, 1 texture { " STATE_LAYER " T " INHERIT_TEXTURE("povgloss_of_0") " "
         STATE_LAYERED " } }"},
        {BASE, "#declare A[0] = finish { phong 1 }",
         "#declare A[0] = " FINISH("povgloss_default_state") "povgloss_of_default() phong 1 povgloss_finish(0) }"},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__lights__where_they_are_needed(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {PLAIN, "light_source { 0 rgb 1 } #declare L = light_source { 0 rgb 1 } object { L }", NULL},
        {BASE, "light_source { 0 rgb 1 } #declare L = light_source { 0 rgb 1 } object { L }", NULL},
        {BASE2, "light_source { 0\nrgb 1 }\nsphere { 0, 1 }", "\n\nsphere { 0, 1 }"},
        {BASE2, "union { light_source { 0 rgb 1 } sphere { 0, 1 } }", "union { sphere { 0, 1 } }"},
        {BASE2, "light_source { 0 rgb 1 looks_like { sphere { 0, 1 } } }",
         "light_source { 0 rgb 1 looks_like { sphere { 0, 1 } } fade_distance 1e-9 fade_power 20 }"},
        {CODED, "light_source { 0 rgb 1 looks_like { sphere { 0, 1 pigment { P } } } }",
         "light_source { 0 rgb 1 looks_like { sphere { 0, 1 transform {} } } fade_distance 1e-9 fade_power 20 }"},
        {BASE2, "#declare L = light_source { 0 rgb 1 }\nlight_source { L translate x }",
         "#declare L = light_source { 0 rgb 1 fade_distance 1e-9 fade_power 20 }\nlight_source { L translate x }"},
        {BASE2, "#declare Place = <1, 2, 3>; light_source { Place, rgb 1 } light_source { Places[2], rgb 1 } light_source { A[0] }",
         "#declare Place = <1, 2, 3>; light_source { A[0] }"},
        {MIRROR, "#declare L = light_source { 0 rgb 1 } object { L translate x } object { M }",
         "#declare L = light_source { 0 rgb 1 fade_distance 1e-9 fade_power 20 } object { L translate x } object { M }"},
        {BASE2, "light_group { light_source { 0 rgb 1 } sphere { 0, 1 } global_lights off }", NULL},
        {CODED, "light_group { union { light_source { 0 rgb 1 } } }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__blocks_with_effects__evaluated_before_they_go(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {MIRROR, "#declare S = seed(1); sphere { 0, 1 pigment { rgb rand(S) } }",
         "#declare S = seed(1); sphere { 0, 1 #declare povgloss_dropped = pigment { rgb rand(S) }; "
         "pigment { povgloss_pigment } }"},
        {CODED, "#declare S = seed(1); sphere { 0, 1\ntexture {\npigment { rgb rand(S) } } }",
         "#declare S = seed(1); sphere { 0, 1\n#declare povgloss_dropped = texture {\npigment { rgb rand(S) } }; "
         "transform {} }"},
        {CODED, "#macro M() 1 #end sphere { 0, 1 interior_texture { pigment { rgb M() } } }",
         "#macro M() 1 #end sphere { 0, 1 #declare povgloss_dropped = texture { pigment { rgb M() } }; transform {} }"},
        {MIRROR, "sphere { 0, 1 pigment { rgb sin(1) } }", "sphere { 0, 1 pigment { povgloss_pigment } }"},
        {BASE2, "#declare S = seed(1); light_source { x*rand(S) rgb 1 }",
         "#declare S = seed(1); light_source { x*rand(S) rgb 1 fade_distance 1e-9 fade_power 20 }"},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__arrays_of_textures__take_no_directives(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {MIRROR, "#declare F = array[2] { finish { reflection 1 }, finish { diffuse 1 } }", NULL},
        {CODED, "#declare F = array[1] { texture { pigment { P } } }", NULL},
        {BASE, "#declare F = array[1] { finish { phong 1 } } sphere { 0, 1 finish { F[0] } }",
         "#declare povgloss_of_0 = array[1] #declare F = array[1] { finish { phong 1 } } sphere { 0, 1 "
         FINISH("povgloss_default_state") "F[0] " INHERIT_FINISH("povgloss_of_0[0]") " "
         "#declare povgloss_reflects = 1; povgloss_finish(0) } }"},
    };
    ASSERT_REWRITINGS(cases);
}

#define COVER(pigment, where) "#declare povgloss_cover = " pigment "; povgloss_cover_of_" where "(0) "

static void copy__pigments_that_may_be_transparent__looked_at_by_povray(void **state)
{
    (void)state;
    static const char *const clear[] = {
        "pigment { rgbt <1, 2, 3, 0.5> }", "pigment { rgbf V }", "pigment { srgbft 1 }", "pigment { Red transmit 0.5 }",
        "pigment { image_map { \"a.png\" } }",
    };
    for (size_t i = 0; i < sizeof clear / sizeof *clear; i++) {
        char source[128], coded[256], seen[256];
        snprintf(source, sizeof source, "sphere { 0, 1 %s }", clear[i]);
        snprintf(coded, sizeof coded, "sphere { 0, 1 #declare povgloss_cover = %s; povgloss_cover_of_object(0) }", clear[i]);
        snprintf(seen, sizeof seen,
                 "sphere { 0, 1 #declare povgloss_cover = %s; povgloss_cover_of_object(0) "
                 "povgloss_hide(povgloss_own) }",
                 clear[i]);
        const struct rewriting cases[] = {{MIRROR, source, seen}, {REFLECTANCE, source, seen}, {CODED, source, coded},
                                          {BASE, source, NULL},   {PLAIN, source, NULL}};
        ASSERT_REWRITINGS(cases);
    }
    static const struct rewriting cases[] = {
        {REFLECTANCE, "sphere { 0, 1 texture { pigment { rgbt 1 } } }",
         "sphere { 0, 1 " TEXTURE COVER("pigment { rgbt 1 }", "texture") "povgloss_hide(povgloss_last) } }"},
        {MIRROR, "pigment { uv_mapping image_map { \"a.png\" } }",
         "#declare povgloss_cover = pigment { uv_mapping image_map { \"a.png\" } }; povgloss_cover_of_object(1) "
         "povgloss_hide(povgloss_own) "},
        /* By way of other names, also backwards, and of macros' parameters. */
        {CODED, "#declare A = B; #declare B = rgbt 1; pigment { A }",
         "#declare A = B; #ifdef (povgloss_of_1) #declare povgloss_of_0 = povgloss_of_1; #end #declare B = rgbt 1; " COVER("pigment { A }", "object")},
        {CODED, "#macro M(C, D) pigment { D } #end M(1, 2) #macro N(E) M(E, rgbt E) #end",
         "#macro M(C, D) " COVER("pigment { D }", "object") " #end M(1, 2) #macro N(E) M(E, rgbt E) #end"},
        {CODED, "#macro M(C, D) sphere { 0, 1 pigment { C } } #end M(1, rgbt 2)",
         "#macro M(C, D) sphere { 0, 1 transform {} } #end M(1, rgbt 2)"},
        {CODED, "#declare A = rgb 1; // rgbt\npigment { A }", "#declare A = rgb 1; // rgbt\ntransform {}"},
        {REFLECTANCE, "#declare F = function { pigment { rgbt 1 } }", NULL},
        {REFLECTANCE, "pigment { rgb 1 }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

static void coded__textures_that_may_be_clear__declared_in_front(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "sphere { 0, 1 texture { pigment { rgbt 1 } } }",
         "sphere { 0, 1 #declare povgloss_dropped = " TEXTURE COVER("pigment { rgbt 1 }", "texture")
         "}; povgloss_coded(povgloss_last.t) }"},
        /* Of several layers all have to be clear. */
        {CODED, "sphere { 0, 1 texture { pigment { rgb 1 } } texture { pigment { rgbt 1 } } }",
         "sphere { 0, 1 transform {} transform {} }"},
        {CODED, "#declare T = texture { pigment { rgbt 1 } } sphere { 0, 1 texture { T } }",
         "#declare T = " TEXTURE COVER("pigment { rgbt 1 }", "texture")
         "} #declare povgloss_of_0 = povgloss_last; #ifdef (povgloss_interior) #declare povgloss_interior_of_0 = interior { "
         "povgloss_interior } #end sphere { 0, 1 #declare povgloss_dropped = texture { " STATE_LAYER " T "
         INHERIT_TEXTURE("povgloss_of_0") " " STATE_LAYERED " }; povgloss_coded(povgloss_last.t) }"},
    };
    ASSERT_REWRITINGS(cases);
}

static void base__transparent_objects_of_the_top_level__placed_by_povray(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {SCENE_COPY_BASE_FIRST, "sphere { 0, 1 pigment { rgbt 1 } }",
         "#declare povgloss_object = sphere { povgloss_enter() 0, 1 " COVER("pigment { rgbt 1 }", "object")
         "povgloss_count(povgloss_own) } povgloss_place(0, 1) "},
        {BASE2, "#if (1) object { A texture { pigment { rgbt 1 } } } #end",
         "#if (1) #declare povgloss_object = object { povgloss_enter() povgloss_add(<0, 0, 1, 0>) A " TEXTURE
         COVER("pigment { rgbt 1 }", "texture") "} } povgloss_place(0, 1) #end"},
        {BASE2, "union { sphere { 0, 1 pigment { rgbt 1 } } rotate y }",
         "povgloss_leave_copy() union { povgloss_nothing() #declare povgloss_object = sphere { povgloss_enter() 0, 1 "
         COVER("pigment { rgbt 1 }", "object") "povgloss_count(povgloss_own) } povgloss_place_part(0, 1) rotate y } povgloss_enter_copy() "},
        {BASE2, "union { sphere { 0, 1 } pigment { rgbt 1 } }",
         "#declare povgloss_object = union { povgloss_enter() povgloss_count(povgloss_default_state) sphere { 0, 1 } "
         COVER("pigment { rgbt 1 }", "object")
         "povgloss_count(povgloss_own) } povgloss_place(0, 1) "},
        {SCENE_COPY_BASE_FIRST, "sphere { 0, 1 pigment { rgb 1 } } union { sphere { 0, 1 } }", NULL},
        {BASE, "sphere { 0, 1 pigment { rgbt 1 } }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

/* POV-Ray takes no directive in the second layer of a declaration. */
static void copy__declared_layers__declared_one_by_one(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {BASE, "#declare T = texture { A }\ntexture { B }; x",
         "#declare povgloss_layer_0 = " TEXTURE "A }; \n#declare povgloss_layer_1 = texture { " STATE_UPPER_LAYER " "
         STATE_LAYERED " B }; #declare T = texture { povgloss_layer_0 } texture { povgloss_layer_1 } ; "
         "#declare povgloss_of_0 = povgloss_last; x"},
        {PLAIN, "#declare T = texture { A } texture { B }", NULL},
        {CODED, "#declare T = texture { A } texture { B }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__interiors__neither_media_nor_fading(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {MIRROR, "interior { ior 1.5 media { M }\nfade_power 2 }",
         "interior { ior 1.5 \nfade_power 2 fade_distance 0 fade_power 0 dispersion 1 }"},
        {REFLECTANCE, "interior { media { M } fade_power 2 }", "interior { fade_power 2 }"},
        {BASE, "interior { ior 1.5 media { M } }", NULL},
        {PLAIN, "interior { ior 1.5 media { M } }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

static void coded__texture_list__gone_with_its_indices(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "mesh2 { texture_list { 2, texture { A },\ntexture { B } } face_indices { 2, <0, 1, 2>, 0,\n<0, 2, 3>, 1 } }",
         "mesh2 { \n face_indices { 2, <0, 1, 2>, \n<0, 2, 3>, } }"},
        {CODED, "mesh2 { texture_list { 1 texture { A } } face_indices { 2 <0, 1, 2> 0, 1, 2 <0, 2, 3>, 1, 1, 1, } }",
         "mesh2 { face_indices { 2 <0, 1, 2> <0, 2, 3>, } }"},
        {CODED,
         "mesh2 { texture_list { #for (I, 1, N) texture { T[I] } #end } face_indices { N, #while (I < N) <I, (I > 2 ? 0 : 1), J> + "
         "K, mod(I, 2) #declare I = I + 1; #end } }",
         "mesh2 { #for (I, 1, N) #end face_indices { N, #while (I < N) <I, (I > 2 ? 0 : 1), J> + K, #declare I = I + 1; #end } }"},
        {CODED, "mesh2 { texture_list { 1, texture { A } } face_indices { 1, <0, 1, 2>, floor(rand(R)*2) } }",
         "mesh2 { face_indices { 1, <0, 1, 2>, #declare povgloss_dropped = floor(rand(R)*2); } }"},
        {CODED, "#macro M(I)\n#end mesh2 { texture_list { M(1), M(2), M(3) } }",
         "#macro M(I)\n#end mesh2 { #declare povgloss_dropped = M(1); #declare povgloss_dropped = M(2) #declare "
         "povgloss_dropped = M(3) }"},
        {CODED, "triangle { A, B, C texture_list { T, U[0] V } }", "triangle { A, B, C }"},
        {CODED, "mesh2 { texture_list { 1, texture { A } } face_indices { 1, #debug \"x\" <0, 1, 2>, 0 #macro M() 1 #end "
                "#declare S = array[2] {1, 2}; #if (1) #declare J = K + 1 #end #declare } }",
         "mesh2 { face_indices { 1, #debug \"x\" <0, 1, 2>, #macro M() 1 #end "
         "#declare S = array[2] {1, 2}; #if (1) #declare J = K + 1 #end #declare } }"},
        {CODED, "#macro M() mesh2 { face_indices { 1, <0, 1, 2> #for (I, 1, 2) , <I, 1, 2> #end } } #end media { M }",
         "#macro M() mesh2 { face_indices { 1, <0, 1, 2> #for (I, 1, 2) , <I, 1, 2> #end } } #end "},
        {CODED, "mesh2 { face_indices { 1, F(0), 0 } uv_indices { 1, <0, 1, 2> } }", NULL},
        {CODED, "mesh2 { face_indices { 1, <0, 1, 2>, F(0) } }", NULL},
        {CODED, "mesh2 { #include \"vertices.inc\" face_indices { 1, <0, 1, 2>, 0 } }",
         "mesh2 { #include \"vertices.inc\" face_indices { 1, <0, 1, 2>, } }"},
        {CODED, "face_indices { 1, <0, 1, 2>, 0 }", "face_indices { 1, <0, 1, 2>, }"},
        {PLAIN, "mesh2 { texture_list { 1, texture { A } } face_indices { 1, <0, 1, 2>, 0 } }", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

/* The message of a copy of a scene without textures that is refused names its third line. */
static void assert_copy_refused(const char *source, const char *what)
{
    struct scene scene;
    struct error err;
    char message[128];
    load_text(&scene, source);
    assert_int_equal(scene_write_copy(&scene, SCENE_COPY_CODED, scratch, &err), RESULT_DATA);
    snprintf(message, sizeof message, "%s/scene.pov:3: ", scratch);
    assert_memory_equal(err.text, message, strlen(message));
    assert_contains(err.text, what);
    assert_ok(scene_write_copy(&scene, SCENE_COPY_PLAIN, scratch, &err), err);
    scene_free(&scene);
}

static void coded__faces_by_macro_or_include__refused_with_file_and_line(void **state)
{
    (void)state;
    assert_copy_refused("mesh2 { texture_list { 1, texture { A } }\nface_indices { 1,\nF(0) } }", "faces");
    assert_copy_refused("mesh2 { texture_list { 1, texture { A } }\nface_indices { 1,\n#include \"faces.inc\" } }", "faces");
    assert_copy_refused("mesh2 { texture_list { 1, texture { A } } face_indices { 2,\n<0, 1, 2>, 0\n#include \"faces.inc\" } }",
                   "include");
    assert_copy_refused("mesh2 {\ntexture_list { 1,\n#include \"textures.inc\" } }", "include");
}

static void copy__byte_order_mark__gone(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {PLAIN, "\xEF\xBB\xBFsphere { 0, 1 }", "sphere { 0, 1 }"},
        {PLAIN, "\xEF\xBB\xBF", ""},
        {CODED, "\xEF\xBB\xBF#version 3.7; sphere { 0, 1 pigment { P } }", "#version 3.7; sphere { 0, 1 transform {} }"},
        {PLAIN, "", NULL},
        {CODED, "// comment", NULL},
    };
    ASSERT_REWRITINGS(cases);
}

static void copy__line_ends_of_dos_and_old_macs__kept(void **state)
{
    (void)state;
    static const struct rewriting cases[] = {
        {CODED, "sphere { 0, 1 pigment {\r\nP\r\n}\r\n}", "sphere { 0, 1 transform {}\r\n\r\n\r\n}"},
        {CODED, "// c\rsphere { 0, 1 pigment {\rP\r}\r}", "// c\rsphere { 0, 1 transform {}\r\r\r}"},
    };
    ASSERT_REWRITINGS(cases);
}

/* Text that POV-Ray refuses must reach POV-Ray, which says why. */
static void copy__what_no_scene_has__no_crash(void **state)
{
    (void)state;
    static const char *const sources[] = {
        "= finish { phong 1 }",
        "= texture { T }",
        "finish { phong 1 }",
        "texture {",
        "}}}} finish { phong 1 } {{{{",
        "#declare reflection = 1; finish { reflection 1 }",
        "#declare pigment = 1; texture { pigment { P } }",
        "#declare finish = 1; texture { finish { finish finish { } } }",
        "#declare transmit = 1; finish { transmit all } finish { transmit",
        "#declare",
        "#include",
        "#declare X =",
        "#declare X = light_source",
        "object { }",
        "light_source { }",
        "Gloss( Gloss(1 Gloss",
        "assumed_gamma srgb",
        "global_settings { assumed_gamma srgb }",
        "global_settings { photons { } radiosity { assumed_gamma 1 } }",
        "#end #end #macro camera { } function { function { ( { } ) }",
        "reflection",
        "#version",
        "transmit",
        "rgbt all",
    };
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++) {
        struct scene scene;
        struct error err;
        write_text("scene.pov", sources[i]);
        enum result result = load(&scene, "scene.pov", &err);
        if (!result)
            result = settle(&scene, &err);
        for (int copy = 0; !result && copy < SCENE_COPY_COUNT; copy++)
            free(copy_text(&scene, (enum scene_copy)copy, 0));
        scene_free(&scene);
    }
}

static void copy__deep_nesting__no_crash(void **state)
{
    (void)state;
    enum { DEPTH = 1000 };
    struct buffer text = {0};
    struct scene scene;
    struct error err;
    for (int i = 0; i < 2 * DEPTH; i++)
        assert_ok(buffer_add_text(&text, i < DEPTH ? "texture { " : "} ", &err), err);
    load_text(&scene, text.data);
    char *copy = copy_text(&scene, SCENE_COPY_BASE, 0);
    assert_true(strlen(copy) > text.size + DEPTH * 35);
    free(copy);
    for (int i = 0; i < 600; i++) /* more conditionals than are kept track of */
        assert_ok(buffer_add_text(&text, "#if (1) ", &err), err);
    scene_free(&scene);
    load_text(&scene, text.data);
    free(copy_text(&scene, SCENE_COPY_BASE, 0));
    scene_free(&scene);
    buffer_free(&text);
}

/* ---- includes ---- */

static void include__found__renamed_in_the_copy_and_read(void **state)
{
    (void)state;
    struct scene scene;
    write_text("a.inc", "#include \"b.inc\"\nsphere { 0, 1 pigment { P } }");
    write_text("b.inc", "#declare B = 1;");
    load_text(&scene, "#include \"a.inc\"\n  #include   \"b.inc\" // twice\n#include \"not-there.inc\"\n");
    assert_int_equal(scene.file_count, 3);
    assert_string_equal(scene.files[1].path, in_scratch("a.inc"));
    assert_string_equal(scene.files[2].path, in_scratch("b.inc"));
    char *text = copy_text(&scene, SCENE_COPY_CODED, 0), *a = copy_text(&scene, SCENE_COPY_CODED, 1),
         *b = copy_text(&scene, SCENE_COPY_CODED, 2);
    assert_string_equal(text, "#include \"coded-001-a.inc\"\n  #include   \"coded-002-b.inc\" // twice\n"
                              "#include \"not-there.inc\"\n");
    assert_string_equal(a, "#include \"coded-002-b.inc\"\nsphere { 0, 1 transform {} }");
    assert_string_equal(b, "#declare B = 1;");
    free(text);
    free(a);
    free(b);
    scene_free(&scene);
    unlink(in_scratch("a.inc"));
    unlink(in_scratch("b.inc"));
}

static void include__in_two_directories__the_first(void **state)
{
    (void)state;
    struct scene scene;
    struct error err;
    char one[128], two[128];
    snprintf(one, sizeof one, "%s/one", scratch);
    snprintf(two, sizeof two, "%s/two", scratch);
    const char *const directories[] = {one, two};
    mkdir(one, 0777);
    mkdir(two, 0777);
    write_text("one/x.inc", "// one");
    write_text("two/x.inc", "// two");
    write_text("two/y.inc", "// two");
    write_text("scene.inc", "// not in a directory that is looked in");
    write_text("scene.pov", "#include \"x.inc\" #include \"y.inc\" #include \"scene.inc\"");
    assert_ok(scene_load(&scene, in_scratch("scene.pov"), &chosen, directories, 2, &err), err);
    assert_ok(settle(&scene, &err), err);
    assert_int_equal(scene.file_count, 3);
    assert_string_equal(scene.files[1].path, in_scratch("one/x.inc"));
    assert_string_equal(scene.files[2].path, in_scratch("two/y.inc"));
    char *text = copy_text(&scene, SCENE_COPY_BASE, 0);
    assert_string_equal(text, "#include \"base-001-x.inc\" #include \"base-002-y.inc\" #include \"scene.inc\"");
    free(text);
    scene_free(&scene);
    /* No directory at all. */
    assert_ok(scene_load(&scene, in_scratch("scene.pov"), &chosen, NULL, 0, &err), err);
    assert_int_equal(scene.file_count, 1);
    scene_free(&scene);
    run("rm -r one two scene.inc");
}

static void include__absolute_path__taken_as_it_is(void **state)
{
    (void)state;
    struct scene scene;
    char text[256];
    write_text("abs.inc", "#declare X = 1;");
    snprintf(text, sizeof text, "#include \"%s/abs.inc\"", scratch);
    load_text(&scene, text);
    assert_int_equal(scene.file_count, 2);
    char *copy = copy_text(&scene, SCENE_COPY_PLAIN, 0);
    assert_string_equal(copy, "#include \"plain-001-abs.inc\"");
    free(copy);
    scene_free(&scene);
    unlink(in_scratch("abs.inc"));
}

static void include__cycle__ends(void **state)
{
    (void)state;
    struct scene scene;
    write_text("self.inc", "#ifndef (S) #declare S = 1; #include \"self.inc\" #end");
    write_text("ping.inc", "#include \"pong.inc\"");
    write_text("pong.inc", "#include \"ping.inc\" #include \"scene.pov\"");
    load_text(&scene, "#include \"self.inc\" #include \"ping.inc\"");
    assert_int_equal(scene.file_count, 4);
    char *self = copy_text(&scene, SCENE_COPY_PLAIN, 1), *pong = copy_text(&scene, SCENE_COPY_PLAIN, 3);
    assert_string_equal(self, "#ifndef (S) #declare S = 1; #include \"plain-001-self.inc\" #end");
    assert_string_equal(pong, "#include \"plain-002-ping.inc\" #include \"plain-000-scene.pov\"");
    free(self);
    free(pong);
    scene_free(&scene);
    run("rm self.inc ping.inc pong.inc");
}

static void assert_refused(const char *text, const char *place, const char *what)
{
    struct scene scene;
    struct error err;
    char message[128];
    write_text("scene.pov", text);
    if (load(&scene, "scene.pov", &err) != RESULT_DATA)
        fail_msg("taken: %s", text);
    snprintf(message, sizeof message, "%s/%s", scratch, place);
    assert_contains(err.text, message);
    assert_contains(err.text, what);
    scene_free(&scene);
}

/* What POV-Ray must be asked for: what is executed, as far as the text tells. */
static void load__includes_and_gammas__those_that_need_a_discovery(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool needed;
    } cases[] = {
        {"#include \"a.inc\"", false},
        {"#include concat(\"a\", \".inc\")", true},
        {"#include Name", true},
        {"#include \"none.inc\"", true},
        {"#macro M(Name) #if (1) #include Name #end #end", false},
        {"#macro M(Name) #if (1) #end #end #include Name", true},
        {"#macro M(Name) #include Name #end M(\"a.inc\")", true},
        {"#macro M(Name) #include Name #end #macro N() M(\"a.inc\") #end", false},
        {"#macro N() M(\"a.inc\") #end #macro M(Name) #include Name #end N()", true},
        {"#macro M(Name) #include Name M(Name) #end", false},
        /* An older file of that name isn't the one that the scene writes. */
        {"#fopen F \"a.inc\" write #include \"a.inc\"", true},
        {"#fopen F \"a.inc\" read #include \"a.inc\"", false},
        {"#fopen F \"b.inc\" append #include \"a.inc\"", false},
        {"global_settings { assumed_gamma 1 } global_settings { assumed_gamma 1.0 }", false},
        {"global_settings { assumed_gamma 1 } global_settings { assumed_gamma srgb }", true},
        {"global_settings { assumed_gamma G }", true},
        {"global_settings { assumed_gamma 1/2.2 }", true},
        {"global_settings { assumed_gamma (1) }", true},
        {"global_settings { assumed_gamma -1 }", true},
    };
    write_text("a.inc", "");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene scene;
        load_text(&scene, cases[i].text);
        if (scene.needs_discovery != cases[i].needed)
            fail_msg("%s", cases[i].text);
        scene_free(&scene);
    }
    unlink(in_scratch("a.inc"));
}

static void load__include_without_a_name__refused_with_file_and_line(void **state)
{
    (void)state;
    assert_refused("#include", "scene.pov:1:", "#include");
    assert_refused("\n#include 3", "scene.pov:2:", "#include");
    write_text("a.inc", "\n\n#include #if");
    assert_refused("#include \"a.inc\"", "a.inc:3:", "#include");
    unlink(in_scratch("a.inc"));
}

static enum result discover(struct scene *scene, const char *log, bool *again, struct error *err)
{
    const char *const directories[] = {scratch};
    write_text(SCENE_DISCOVERY_LOG, log);
    enum result result = scene_discover(scene, scratch, directories, 1, again, err);
    unlink(in_scratch(SCENE_DISCOVERY_LOG));
    return result;
}

static void discover__log__files_and_gamma_taken(void **state)
{
    (void)state;
    struct scene scene;
    struct error err;
    bool again;
    write_text("a b.inc", "#include Next");
    write_text("plain.inc", "Gloss(70)\n#declare Glass = pigment { rgbt 1 }");
    write_text("scene.pov", "global_settings { assumed_gamma G }\n#include Name #include Name");
    assert_ok(load(&scene, "scene.pov", &err), err);
    assert_ok(discover(&scene, "gamma 0 3 1.8\ninclude 0 7 a b.inc\ninclude 0 9 plain.inc\ngamma 0 3 1.5\nend\n", &again, &err), err);
    assert_true(again);
    assert_near(scene.working_gamma, 1.8, 1e-12);
    assert_int_equal(scene.file_count, 3);
    assert_near(scene.exponent, 70, 1e-12);
    assert_ok(discover(&scene, "include 0 7 a b.inc\ninclude 1 1 plain.inc\ngamma 0 3 srgb\nend\n", &again, &err), err);
    assert_false(again);
    assert_int_equal(scene.file_count, 3);
    assert_near(scene.working_gamma, GBUFFER_GAMMA_SRGB, 1e-12);
    assert_ok(scene_settle(&scene, &err), err);
    assert_true(scene_names_find(&scene.names, "Glass")->facts & NAME_CLEAR);
    char *text = copy_text(&scene, SCENE_COPY_CODED, 0);
    assert_non_null(strstr(text, "\n#declare povgloss_name = Name; #if (strcmp(povgloss_name, \"a b.inc\") = 0) "
                                 "#declare povgloss_name = \"coded-001-a_b.inc\"; #end "));
    free(text);
    assert_int_equal(discover(&scene, "include 0 9 none.inc\nend\n", &again, &err), RESULT_DATA);
    assert_contains(err.text, "scene.pov:2: none.inc");
    scene_free(&scene);
    unlink(in_scratch("a b.inc"));
    unlink(in_scratch("plain.inc"));
}

static void discover__hostile_logs__no_crash(void **state)
{
    (void)state;
    static const char *const logs[] = {"", "\n", "include", "include 0", "include 0 1 ", "include -1 0 x\n", "include 9 0 x\n",
                                       "include 0 99 x\n", "include 0 -1 x\n", "gamma\n", "gamma 0 0 x", "\nend\n",
                                       "include 99999999999999999999 0 x\n"};
    struct scene scene;
    load_text(&scene, "#include Name");
    for (size_t i = 0; i < sizeof logs / sizeof *logs; i++) {
        struct error err;
        bool again;
        assert_ok(discover(&scene, logs[i], &again, &err), err);
        assert_int_equal(scene.file_count, 1);
    }
    scene_free(&scene);
}

static void load__unclosed_comment_in_an_include__refused_with_file_and_line(void **state)
{
    (void)state;
    write_text("a.inc", "\n/*");
    assert_refused("#include \"a.inc\"", "a.inc:2:", "comment");
    unlink(in_scratch("a.inc"));
}

static void load__missing_scene_or_folder__refused(void **state)
{
    (void)state;
    struct scene scene;
    struct error err;
    assert_int_equal(load(&scene, "missing.pov", &err), RESULT_DATA);
    assert_contains(err.text, in_scratch("missing.pov"));
    scene_free(&scene);
    assert_int_equal(scene_load(&scene, scratch, &chosen, NULL, 0, &err), RESULT_DATA);
    assert_contains(err.text, scratch);
    scene_free(&scene);
    scene_free(&scene);
}

static void write__missing_folder__refused(void **state)
{
    (void)state;
    struct scene scene;
    struct error err;
    load_text(&scene, "sphere { 0, 1 }");
    assert_int_equal(scene_write_copy(&scene, SCENE_COPY_PLAIN, in_scratch("missing"), &err), RESULT_DATA);
    assert_contains(err.text, in_scratch("missing"));
    scene_free(&scene);
}

/* ---- what is learnt of a scene ---- */

static void load__gamma__number_srgb_or_by_version(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double gamma;
    } cases[] = {
        {"global_settings { assumed_gamma 2.2 }", 2.2},
        {"global_settings { assumed_gamma 1 max_trace_level 5 }", 1},
        {"global_settings { assumed_gamma srgb }", GBUFFER_GAMMA_SRGB},
        {"global_settings { assumed_gamma 1.0 #if (Rad) radiosity { } #end }", 1},
        {"#version 3.7; sphere { 0, 1 }", 1},
        {"#version 3.8;", 1},
        {"#version 3.6; sphere { 0, 1 }", GBUFFER_GAMMA_SRGB},
        {"sphere { 0, 1 }", GBUFFER_GAMMA_SRGB},
        /* POV-Ray takes the first. */
        {"global_settings { assumed_gamma 1 } global_settings { assumed_gamma 2.2 }", 1},
        {"#version 3.7; global_settings { assumed_gamma 2.2 } global_settings { assumed_gamma srgb }", 2.2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene scene;
        load_text(&scene, cases[i].text);
        assert_near(scene.working_gamma, cases[i].gamma, 1e-12);
        scene_free(&scene);
    }
}

static void load__gamma_without_a_value__refused_with_file_and_line(void **state)
{
    (void)state;
    assert_refused("global_settings {\n assumed_gamma }", "scene.pov:2:", "assumed_gamma");
    assert_refused("global_settings { assumed_gamma #if (1) 1 #end }", "scene.pov:1:", "assumed_gamma");
    assert_refused("global_settings { assumed_gamma", "scene.pov:1:", "assumed_gamma");
}

static void load__version__of_the_first_directive(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double version;
    } cases[] = {
        {"#version 3.7;", 3.7},         {"// c\n/* d */ #version 3.6;", 3.6}, {"sphere { 0, 1 } #version 3.7;", 3.7},
        {"#version unofficial 3.7;", 0}, {"", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene scene;
        load_text(&scene, cases[i].text);
        assert_near(scene.version, cases[i].version, 1e-12);
        scene_free(&scene);
    }
}

static void load__gloss_calls__found_with_their_one_exponent(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool glossy;
        double exponent;
    } cases[] = {
        {"sphere { 0, 1 }", false, -1},
        {"Gloss(300)", true, 300},
        {"Gloss(3e2) Gloss( 300. )", true, 300},
        {"Gloss(300) Gloss(100)", true, -1},
        {"Gloss(300) Gloss(100) Gloss(300)", true, -1},
        {"Gloss(100) Gloss(300) Gloss(300)", true, -1},
        {"Gloss(P)", true, -1},
        {"Gloss(P) Gloss(300)", true, -1},
        {"Gloss(300) Gloss(P)", true, -1},
        {"Gloss(2*150)", true, -1},
        {"Gloss(0)", true, 0},
        {"Gloss_Roughness(0.5)", true, 7.5}, /* 1/(2 r^4) - 1/2 */
        {"Gloss_Roughness(0.5) Gloss(7.5)", true, 7.5},
        {"Gloss_Roughness(1)", true, 0},
        {"Gloss_Roughness(0)", true, INFINITY},
        {"// Gloss(1)\n/* Gloss(2) */ \"Gloss(3)\" Gloss (4)", true, 4},
        {"#macro Gloss(P) #end", false, -1},
        {"Glossy(5) My_Gloss(6) Gloss", false, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene scene;
        load_text(&scene, cases[i].text);
        assert_int_equal(scene.glossy, cases[i].glossy);
        if (!(scene.exponent == cases[i].exponent || fabs(scene.exponent - cases[i].exponent) < 1e-12))
            fail_msg("%s: %g", cases[i].text, scene.exponent);
        scene_free(&scene);
    }
}

static void load__chosen_gloss__noted_with_its_one_exponent(void **state)
{
    (void)state;
    static struct gloss_name one[] = {{"F", 300}}, two[] = {{"F", 300}, {"T", 20}};
    static const char mirror[] = "#declare F = finish { reflection 1 } #declare T = texture { finish { F } }",
                      highlight[] = "finish { reflection 1 phong_size 9 }", dull[] = "finish { reflection 0 phong_size 9 }";
    static const struct {
        const char *text;
        struct gloss_choice choice;
        bool glossy;
        double exponent;
    } cases[] = {
        {mirror, {.name_count = 0}, false, -1},
        {mirror, {.names = one, .name_count = 1}, true, 300},
        {mirror, {.names = two, .name_count = 2}, true, -1},
        {mirror, {.all = true, .all_exponent = 5}, true, 5},
        {mirror, {.automatic = true}, false, -1},
        {highlight, {.automatic = true}, true, -1},
        {highlight, {.automatic = true, .all = true, .all_exponent = 5}, true, -1},
        {dull, {.automatic = true, .all = true, .all_exponent = 5}, false, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene scene;
        chosen = cases[i].choice;
        load_text(&scene, cases[i].text);
        if (scene.glossy != cases[i].glossy || scene.exponent != cases[i].exponent)
            fail_msg("case %zu: %d with %g", i, scene.glossy, scene.exponent);
        scene_free(&scene);
    }
    chosen = (struct gloss_choice){0};
}

static void load__chosen_name_that_nothing_glossy_has__refused(void **state)
{
    (void)state;
    static struct gloss_name name[] = {{"P", 300}};
    static const char *const texts[] = {"sphere { 0, 1 }", "#declare P = pigment { rgb 1 }", "#macro P() #end",
                                        "#declare p = finish { reflection 1 }", "#declare PP = finish { reflection 1 }"};
    chosen = (struct gloss_choice){.names = name, .name_count = 1};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct scene scene;
        struct error err;
        write_text("scene.pov", texts[i]);
        assert_int_equal(load(&scene, "scene.pov", &err), RESULT_DATA);
        assert_non_null(strstr(err.text, "declared by the name P"));
        scene_free(&scene);
    }
    chosen = (struct gloss_choice){0};
}

static void load__povgloss_inc__its_own_calls_do_not_count(void **state)
{
    (void)state;
    struct scene scene;
    write_text("povgloss.inc", "#macro Gloss(P) #end #macro Gloss_Roughness(R) Gloss(1/R) #end");
    load_text(&scene, "#include \"povgloss.inc\" Gloss(50)");
    assert_int_equal(scene.file_count, 2);
    assert_true(scene.glossy);
    assert_near(scene.exponent, 50, 0);
    scene_free(&scene);
    unlink(in_scratch("povgloss.inc"));
}

static void load__plain_mirrors__reflection_without_gloss(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool expected;
    } cases[] = {
        {"finish { phong 1 }", false},
        {"finish { reflection 0.5 }", true},
        {"finish { reflection { 0.1, 1 fresnel } }", true},
        {"finish { reflection 0.5 Gloss(9) }", false},
        {"finish { Gloss_Roughness(0.1) reflection { 0.5 } }", false},
        {"finish { reflection 0.5 Gloss(9) } finish { reflection 0.2 }", true},
        {"finish { reflection 0 }", false},
        {"finish { reflection 0.0 }", false},
        {"finish { reflection R }", true},
        {"sphere { 0, 1 photons { target reflection on refraction off } }", false},
        {"#macro R() reflection 0.3 #end", true},
        {"#declare F = finish { Gloss(9) } finish { F reflection 0.2 }", false},
        {"#declare F = finish { Gloss(9) } #declare F = finish { phong 1 } finish { F reflection 0.2 }", true},
        {"#declare F = finish { Gloss(9) } #macro M(F) finish { F reflection 0.2 } #end", true},
        {"#declare F = finish { #if (X) Gloss(9) #end } finish { F reflection 0.2 }", true},
        {"// finish { reflection 1 }", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene scene;
        load_text(&scene, cases[i].text);
        if (scene.plain_mirrors != cases[i].expected)
            fail_msg("%s", cases[i].text);
        scene_free(&scene);
    }
}

/* What a library declares counts only if the scene uses it. */
static void load__uses__of_a_library_by_name(void **state)
{
    (void)state;
    static const char library[] =
        "#declare Map = texture { gradient x texture_map { [0 T] [1 T] } }\n"
        "#declare Metal = finish { reflection 0.5 }\n"
        "#declare Silver = texture { finish { Metal } }\n"
        "#macro Glass(X) #declare Own = 2; material { texture { pigment { rgbt X } } interior { ior 1.5 } } #end\n"
        "#macro Bottle() object { Any material { Glass(1) } } #end\n";
    static const struct {
        const char *text;
        bool mixes, plain_mirrors, may_be_clear, refracts;
    } cases[] = {
        {"sphere { 0, 1 }", false, false, false, false},
        {"sphere { 0, 1 texture { Map } }", true, false, false, false},
        {"sphere { 0, 1 texture { Silver } }", false, true, false, false},
        {"Bottle()", false, false, true, true},
        {"#declare Unused = texture { Map }", true, false, false, false},
        {"#declare Clear = rgbt 1; sky_sphere { pigment { rgbt 1 } }", false, false, false, false},
        {"#include Name", true, true, true, true},
        {"blob { sphere { C, 1, 2 rotate y } cylinder { 0, 1, 2, 3 } pigment { rgb 1 } }", false, false, false, false},
        {"blob { sphere { C, 1, 2 pigment { rgb 1 } } }", true, false, false, false},
        {"blob { sphere { C, 1, 2 Bottle() } }", true, false, true, true},
        {"blob { #include \"parts.inc\" }", true, false, false, false},
    };
    /* A file that is another one each time. */
    static const char log[] = "write 0 1 parts.inc\ninclude 0 3 parts.inc\nwrite 0 1 parts.inc\ninclude 0 3 parts.inc\nend\n";
    write_text("library.inc", library);
    write_text("parts.inc", "");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[200];
        struct scene scene;
        struct error err;
        snprintf(text, sizeof text, "#include \"library.inc\"\n%s", cases[i].text);
        write_text("scene.pov", text);
        assert_ok(load(&scene, "scene.pov", &err), err);
        if (scene.needs_discovery) {
            bool again;
            assert_ok(discover(&scene, log, &again, &err), err);
            assert_ok(scene_settle(&scene, &err), err);
        }
        if (scene.mixes != cases[i].mixes || scene.plain_mirrors != cases[i].plain_mirrors ||
            scene.may_be_clear != cases[i].may_be_clear || scene.refracts != cases[i].refracts)
            fail_msg("%s: %d %d %d %d", cases[i].text, scene.mixes, scene.plain_mirrors, scene.may_be_clear, scene.refracts);
        scene_free(&scene);
    }
    run("rm library.inc parts.inc");
}

static void copy__library__without_the_blocks_that_the_scene_does_not_use(void **state)
{
    (void)state;
    static const char library[] =
        "#declare Chrome = finish {\n  reflection 1\n};\n"
        "#declare Deep = finish { phong 1 } #declare Shell = texture { finish { Deep } }\n"
        "#declare Called = function { x } #declare Calling = function(x) { Called(x) }\n"
        "#declare Random = texture { pigment { rgb rand(S) } }\n"
        "#macro Unused() object { Part } #end #declare Part = sphere { 0, 1 }\n"
        "#ifndef (Maybe) #declare Maybe = sphere { 0, 1 } #end #declare Red = rgb x;\n";
    struct scene scene;
    struct error err;
    write_text("library.inc", library);
    write_text("scene.pov", "#include \"library.inc\"\nsphere { 0, 1 texture { Shell } }");
    assert_ok(load(&scene, "scene.pov", &err), err);
    char *text = copy_text(&scene, SCENE_COPY_PLAIN, 1);
    assert_string_equal(text,
                        "\n\n\n"
                        "#declare Deep = finish { phong 1 } #declare Shell = texture { finish { Deep } }\n"
                        "#declare Called = function { x } #declare Calling = function(x) { Called(x) }\n"
                        "#declare Random = texture { pigment { rgb rand(S) } }\n"
                        "#macro Unused() object { Part } #end \n"
                        "#ifndef (Maybe) #declare Maybe = sphere { 0, 1 } #end #declare Red = rgb x;\n");
    free(text);
    scene_free(&scene);
    unlink(in_scratch("library.inc"));
}

static void load__atmosphere__at_the_top_level_only(void **state)
{
    (void)state;
    static const struct {
        const char *text, *expected;
    } cases[] = {
        {"fog { distance 9 }", "fog"},
        {"media { scattering { 1, 1 } }", "media"},
        {"rainbow { R }", "rainbow"},
        {"#if (1) fog { F } #end", "fog"},
        {"#declare F = fog { distance 9 }", NULL},
        {"sphere { 0, 1 interior { media { M } } }", NULL},
        {"fog_type 1 fog", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene scene;
        load_text(&scene, cases[i].text);
        if (cases[i].expected)
            assert_string_equal(scene.atmosphere, cases[i].expected);
        else
            assert_null(scene.atmosphere);
        scene_free(&scene);
    }
}

static void load__names__of_all_files_once(void **state)
{
    (void)state;
    struct scene scene;
    write_text("n.inc", "#declare In = 1; #declare A = 2;");
    load_text(&scene, "#declare A = 1; #local Bc = light_source { 0 rgb 1 } #macro M(P) #end #include \"n.inc\"\n"
                      "#declare A = 3; #declare L = sphere { 0, 1 } // #declare No = 1;\n#declare AA = 1;\n#fopen F \"f\" write");
    static const char *const names[] = {"A", "Bc", "M", "In", "L", "AA", "F"};
    const struct scene_name *name = scene.names.declared;
    for (int i = 0; i < 7; i++, name = name->next) {
        assert_non_null(name);
        assert_string_equal(name->text, names[i]);
        assert_int_equal(name->index, i);
        assert_int_equal(!!(name->facts & NAME_LIGHT), i == 1);
    }
    assert_null(name);
    assert_null(scene_names_find(&scene.names, "No"));
    assert_int_equal(scene_names_find(&scene.names, "light_source")->index, -1);
    scene_free(&scene);
    unlink(in_scratch("n.inc"));
}

static void names__saved_and_restored__for_the_second_copy(void **state)
{
    (void)state;
    struct scene scene;
    struct buffer save = {0}, restore = {0};
    struct error err;
    load_text(&scene, "#declare A = 1; #local B = 2;");
    assert_ok(scene_save_names(&scene, &save, &err), err);
    assert_ok(scene_restore_names(&scene, &restore, &err), err);
    assert_string_equal(save.data, "#ifdef (A) #declare povgloss_saved_0 = A; #end\n"
                                   "#ifdef (B) #declare povgloss_saved_1 = B; #end\n");
    assert_string_equal(restore.data, "#ifdef (A) #undef A #end\n"
                                      "#ifdef (povgloss_saved_0) #declare A = povgloss_saved_0; #end\n"
                                      "#ifdef (B) #undef B #end\n"
                                      "#ifdef (povgloss_saved_1) #declare B = povgloss_saved_1; #end\n");
    buffer_free(&save);
    buffer_free(&restore);
    scene_free(&scene);
}

/* ---- names of copies ---- */

static void copy_name__every_file_and_copy__comes_back(void **state)
{
    (void)state;
    struct scene scene;
    struct error err;
    write_text("a b'c=\xC3\xA9.inc", "");
    write_text("n.inc", "");
    load_text(&scene, "#include \"a b'c=\xC3\xA9.inc\" #include \"n.inc\"");
    assert_int_equal(scene.file_count, 3);
    char *names[3 * SCENE_COPY_COUNT];
    for (int copy = 0; copy < SCENE_COPY_COUNT; copy++)
        for (int file = 0; file < 3; file++) {
            char **name = &names[3 * copy + file];
            assert_ok(scene_copy_name(&scene, (enum scene_copy)copy, file, name, &err), err);
            assert_int_equal(scene_file_of_copy(&scene, *name), file);
            for (int other = 0; other < 3 * copy + file; other++)
                assert_string_not_equal(names[other], *name);
            /* A command line of POV-Ray and a string of a scene can hold it. */
            assert_int_equal(strspn(*name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-"),
                             strlen(*name));
        }
    assert_string_equal(names[1], "plain-001-a_b_c___.inc");
    for (int i = 0; i < 3 * SCENE_COPY_COUNT; i++)
        free(names[i]);
    scene_free(&scene);
    unlink(in_scratch("a b'c=\xC3\xA9.inc"));
    unlink(in_scratch("n.inc"));
}

static void file_of_copy__hostile_names__minus_1(void **state)
{
    (void)state;
    static const char *const names[] = {"",           "plain",          "plain-",          "plain-0",     "plain-00",
                                        "plain-0000", "plain-001-x",    "plain-999-x",     "plain--01-x", "plain-+01-x",
                                        "Plain-000",  "base3-000-x",    "xplain-000-x",    "-000-x",      "000",
                                        "mirror-00x", "povgloss.inc",   "scene.pov",       "codedx-000-y", "plain-99999999999"};
    struct scene scene;
    load_text(&scene, "sphere { 0, 1 }");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (scene_file_of_copy(&scene, names[i]) != -1)
            fail_msg("'%s' is a copy", names[i]);
    assert_int_equal(scene_file_of_copy(&scene, "base2-000-scene.pov"), 0);
    scene_free(&scene);
}

/* ---- the sample scenes ---- */

static const char *const samples[] = {"contact", "interior", "metal", "spheres", "two_exponents"};
enum { SAMPLES = sizeof samples / sizeof *samples };

static char *sample_path(int i)
{
    static char path[128];
    snprintf(path, sizeof path, "povscenes/%s.pov", samples[i]);
    return path;
}

static int newlines(const char *text, size_t size)
{
    int count = 0;
    for (size_t i = 0; i < size; i++)
        count += text[i] == '\n';
    return count;
}

/* What a copy keeps is on its line: every #declare of the top level. */
static void assert_declarations_on_their_lines(const struct scene_file *file, const char *text)
{
    struct buffer copy = {0};
    struct token_list list;
    struct error err;
    int at = 0;
    assert_ok(buffer_add_text(&copy, text, &err), err);
    assert_ok(scene_lex("copy", &copy, &list, &err), err);
    for (int i = 0; i < file->list.count; i++) {
        const struct token *token = &file->list.tokens[i];
        if (!token_is(&file->source, token, TOKEN_DIRECTIVE, "declare") || token->parent >= 0)
            continue;
        char name[128];
        snprintf(name, sizeof name, "%.*s", (int)token[1].word_length, file->source.data + token[1].word);
        while (at < list.count && !(token_is(&copy, &list.tokens[at], TOKEN_DIRECTIVE, "declare") &&
                                    token_is(&copy, &list.tokens[at + 1], TOKEN_WORD, name)))
            at++;
        assert_true(at < list.count);
        assert_int_equal(list.tokens[at].line, token->line);
        at++;
    }
    token_list_free(&list);
    buffer_free(&copy);
}

static void copy__sample_scenes__every_line_where_it_was(void **state)
{
    (void)state;
    const char *const directories[] = {"povscenes"};
    for (int i = 0; i < SAMPLES; i++) {
        struct scene scene;
        struct error err;
        assert_ok(scene_load(&scene, sample_path(i), &chosen, directories, 1, &err), err);
        assert_ok(settle(&scene, &err), err);
        assert_true(scene.file_count >= 2);
        assert_true(scene.glossy);
        for (int copy = 0; copy < SCENE_COPY_COUNT; copy++)
            for (int file = 0; file < scene.file_count; file++) {
                char *text = copy_text(&scene, (enum scene_copy)copy, file);
                const struct buffer *source = &scene.files[file].source;
                assert_int_equal(newlines(text, strlen(text)), newlines(source->data, source->size));
                assert_declarations_on_their_lines(&scene.files[file], text);
                free(text);
            }
        scene_free(&scene);
    }
}

/* Loads a damaged scene and writes its copies: any result, no crash, and no line lost where there is a copy. */
static void try_damaged(const char *data, size_t size)
{
    struct scene scene;
    struct error err;
    write_bytes(in_scratch("scene.pov"), data, size);
    enum result result = load(&scene, "scene.pov", &err);
    if (!result)
        result = settle(&scene, &err);
    assert_true(result == RESULT_OK || result == RESULT_DATA);
    for (int copy = 0; !result && copy < SCENE_COPY_COUNT; copy++) {
        size_t copy_size;
        char *name;
        if (scene_write_copy(&scene, (enum scene_copy)copy, scratch, &err))
            continue;
        assert_ok(scene_copy_name(&scene, (enum scene_copy)copy, 0, &name, &err), err);
        char *text = (char *)read_bytes(in_scratch(name), &copy_size);
        assert_int_equal(newlines(text, copy_size), newlines(data, size));
        free(text);
        free(name);
    }
    scene_free(&scene);
}

static void copy__truncated_sample_scenes__no_crash_and_no_line_lost(void **state)
{
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        size_t size;
        char *data = (char *)read_bytes(sample_path(i), &size);
        for (size_t length = 0; length < size; length += 37)
            try_damaged(data, length);
        free(data);
    }
}

static uint32_t next_random(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static void copy__sample_scenes_with_wrong_bytes__no_crash_and_no_line_lost(void **state)
{
    (void)state;
    static const char bytes[] = "{}()\"/*#=;.,-\n\r \0<>eE1x\\";
    uint32_t seed = 2002;
    for (int i = 0; i < SAMPLES; i++) {
        size_t size;
        char *data = (char *)read_bytes(sample_path(i), &size), *damaged = malloc(size);
        assert_non_null(damaged);
        for (int round = 0; round < 60; round++) {
            memcpy(damaged, data, size);
            for (uint32_t flips = 1 + next_random(&seed) % 8; flips > 0; flips--) {
                char *byte = &damaged[next_random(&seed) % size];
                *byte = round % 2 ? (char)next_random(&seed) : bytes[next_random(&seed) % (sizeof bytes - 1)];
            }
            try_damaged(damaged, size);
        }
        free(damaged);
        free(data);
    }
}

/* Nothing but the words that the rewriting knows, in any order. */
static void copy__random_words__no_crash_and_no_line_lost(void **state)
{
    (void)state;
    static const char *const words[] = {
        "camera", "finish", "texture", "pigment", "normal", "interior", "material", "interior_texture", "light_source",
        "light_group", "looks_like", "object", "function", "triangle", "mesh", "fog", "media", "global_settings",
        "assumed_gamma", "srgb", "radiosity", "photons", "reflection", "Gloss", "Gloss_Roughness", "transmit", "filter",
        "rgbt", "all", "aperture", "X", "Y", "{", "}", "{", "}", "{", "}", "(", ")", "=", ";", ",", ".", "1", "0", "\n",
        "#declare", "#local", "#macro", "#end", "#if", "#default", "#include \"scene.pov\"", "#version", "\"s\"", "/**/"};
    uint32_t seed = 7;
    for (int round = 0; round < 300; round++) {
        struct buffer text = {0};
        struct error err;
        for (int count = 1 + (int)(next_random(&seed) % 60); count > 0; count--)
            assert_ok(buffer_printf(&text, &err, "%s ", words[next_random(&seed) % (sizeof words / sizeof *words)]), err);
        try_damaged(text.data, text.size);
        buffer_free(&text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copy__statements_of_the_top_level__union_broken_dropped_or_kept),
        cmocka_unit_test(copy__statements_elsewhere__only_the_top_level_counts),
        cmocka_unit_test(copy__camera_with_aperture__ends_by_the_passes_choice),
        cmocka_unit_test(copy__technical_settings__neither_gamma_nor_photons),
        cmocka_unit_test(coded__textures_in_objects__become_transforms),
        cmocka_unit_test(coded__declared_textures__stay_with_their_layers),
        cmocka_unit_test(coded__triangles__textures_go_without_a_transform),
        cmocka_unit_test(copy__functions__untouched),
        cmocka_unit_test(mirror__pigments__those_of_the_pass),
        cmocka_unit_test(copy__finishes__marked),
        cmocka_unit_test(copy__declared_finishes_and_textures__hand_their_gloss_on),
        cmocka_unit_test(copy__lights__where_they_are_needed),
        cmocka_unit_test(copy__blocks_with_effects__evaluated_before_they_go),
        cmocka_unit_test(copy__arrays_of_textures__take_no_directives),
        cmocka_unit_test(copy__pigments_that_may_be_transparent__looked_at_by_povray),
        cmocka_unit_test(coded__textures_that_may_be_clear__declared_in_front),
        cmocka_unit_test(base__transparent_objects_of_the_top_level__placed_by_povray),
        cmocka_unit_test(copy__declared_layers__declared_one_by_one),
        cmocka_unit_test(copy__interiors__neither_media_nor_fading),
        cmocka_unit_test(coded__texture_list__gone_with_its_indices),
        cmocka_unit_test(coded__faces_by_macro_or_include__refused_with_file_and_line),
        cmocka_unit_test(copy__byte_order_mark__gone),
        cmocka_unit_test(copy__line_ends_of_dos_and_old_macs__kept),
        cmocka_unit_test(copy__what_no_scene_has__no_crash),
        cmocka_unit_test(copy__deep_nesting__no_crash),
        cmocka_unit_test(include__found__renamed_in_the_copy_and_read),
        cmocka_unit_test(include__in_two_directories__the_first),
        cmocka_unit_test(include__absolute_path__taken_as_it_is),
        cmocka_unit_test(include__cycle__ends),
        cmocka_unit_test(load__includes_and_gammas__those_that_need_a_discovery),
        cmocka_unit_test(load__include_without_a_name__refused_with_file_and_line),
        cmocka_unit_test(discover__log__files_and_gamma_taken),
        cmocka_unit_test(discover__hostile_logs__no_crash),
        cmocka_unit_test(load__unclosed_comment_in_an_include__refused_with_file_and_line),
        cmocka_unit_test(load__missing_scene_or_folder__refused),
        cmocka_unit_test(write__missing_folder__refused),
        cmocka_unit_test(load__gamma__number_srgb_or_by_version),
        cmocka_unit_test(load__gamma_without_a_value__refused_with_file_and_line),
        cmocka_unit_test(load__version__of_the_first_directive),
        cmocka_unit_test(load__gloss_calls__found_with_their_one_exponent),
        cmocka_unit_test(load__chosen_gloss__noted_with_its_one_exponent),
        cmocka_unit_test(load__chosen_name_that_nothing_glossy_has__refused),
        cmocka_unit_test(copy__chosen_names__given_their_exponent),
        cmocka_unit_test(copy__highlights__noted_for_automatic_gloss),
        cmocka_unit_test(load__povgloss_inc__its_own_calls_do_not_count),
        cmocka_unit_test(load__plain_mirrors__reflection_without_gloss),
        cmocka_unit_test(load__uses__of_a_library_by_name),
        cmocka_unit_test(copy__library__without_the_blocks_that_the_scene_does_not_use),
        cmocka_unit_test(load__atmosphere__at_the_top_level_only),
        cmocka_unit_test(load__names__of_all_files_once),
        cmocka_unit_test(names__saved_and_restored__for_the_second_copy),
        cmocka_unit_test(copy_name__every_file_and_copy__comes_back),
        cmocka_unit_test(file_of_copy__hostile_names__minus_1),
        cmocka_unit_test(copy__sample_scenes__every_line_where_it_was),
        cmocka_unit_test(copy__truncated_sample_scenes__no_crash_and_no_line_lost),
        cmocka_unit_test(copy__sample_scenes_with_wrong_bytes__no_crash_and_no_line_lost),
        cmocka_unit_test(copy__random_words__no_crash_and_no_line_lost),
    };
    return cmocka_run_group_tests_name("scene_rewrite", tests, scratch_setup, scratch_teardown);
}
