/* The table of the passes, and the wrapper that puts a pass's copies, macros, textures and skies into one scene. */
#include "pass_scene.h"

#include "scene_discover.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What povgloss_finish puts last into every finish. Later items of a finish override earlier ones; povgloss_phong is 0 or
 * more when the finish is glossy, povgloss_reflects is 1 when it names a reflection of its own. A finish without either
 * keeps what it has. */
#define DARK "ambient 0 emission 0 diffuse 0 specular 0 phong 0 irid { 0 }"
static const char end_base[] = "#if (povgloss_phong >= 0) reflection { 0 } #end";
/* In a marked pass what isn't glossy shines, by which the glossy share of a pixel is known. */
#define MARK "#ifdef (povgloss_marker) emission povgloss_marker #end"
static const char end_mirror[] = DARK "\n"
                                 "  #if (povgloss_phong >= 0) reflection { povgloss_mirror_colour() fresnel off falloff 1 "
                                 "exponent 1 metallic 0 }\n"
                                 "  #else " MARK " #if (povgloss_reflects) reflection { 0 } #end #end";
static const char end_haze[] = DARK "\n"
                               "  #if (povgloss_phong >= 0 | povgloss_reflects) reflection { 0 } #end";
/* The same where a glossy finish keeps its reflectivity: any other reflects something next to white (to the power
 * 1e-6), in the haze as well. */
#define PLAIN_WHITE "#else #if (povgloss_reflects) reflection_exponent 1e6 #end #end"
static const char end_reflection[] = DARK "\n  #if (povgloss_phong >= 0) reflection_exponent 1\n  " PLAIN_WHITE;
static const char end_haze_of_reflection[] = DARK "\n  #if (povgloss_phong >= 0) reflection { 0 }\n  " PLAIN_WHITE;
/* The sky is next to black, as a total reflection shows it, which isn't glossy. POV-Ray takes what a finish reflects to
 * the power 1/exponent: 20 makes one half of the sky, 0.001 nothing, and leaves the reflectivity for a later
 * Gloss(). */
static const char end_reflectance[] = DARK "\n"
                                      "  #if (povgloss_phong >= 0) reflection_exponent 20\n"
                                      "  #else #if (povgloss_reflects) reflection_exponent 0.001 #end #end";

static const char mirror_white[] = "rgb 1";
/* An exponent is coded as (20 + log2 p)/128, in two digits of 16 bits. That of a painted finish is in its pigment. */
static const char mirror_exponent[] =
    "#local povgloss_v = 65535*povgloss_exponent_code(povgloss_phong);\n"
    "  rgb (povgloss_phong < povgloss_maps_from)*<floor(povgloss_v)/65535, povgloss_v - floor(povgloss_v), 1>";

/* The sky of the camera's own rays, over that of mirrored ones. */
#define CAMERA_SKY(emission) \
    "sphere { 0, 9e6 inverse hollow pigment { rgb 1 } finish { " DARK " emission " emission \
    " reflection { 0 } } no_reflection no_shadow no_radiosity }\n"
#define BLACK_SKY CAMERA_SKY("0")
#define SKY(colour) BLACK_SKY "sky_sphere { pigment { rgb " colour " } }\n"
static const char black_sky[] = BLACK_SKY;
static const char marker_sky[] = CAMERA_SKY("povgloss_marker");
static const char sky_half[] = SKY("pow(0.5, 20)");
static const char sky_white[] = SKY("1");
#define MIRRORS "no_reflection no_shadow no_radiosity"
#define SEEN_IN_MIRRORS "no_image"
static const char outside[] = "povgloss_leave_copy() object { povgloss_object } povgloss_enter_copy()";
/* From this transparency on a surface before a glossy one is looked through. A mirrored ray ends where most of it
 * does. */
#define CLEAR 0.01
#define DIGITS_(number) #number
#define DIGITS(number) DIGITS_(number)
#define MOSTLY_CLEAR 0.5

/* What several passes have in common. */
#define CODES .codes = true, .technical = true
#define POSITIONS \
    CODES, .clear_from = CLEAR, .first = {.copy = SCENE_COPY_CODED, .modifiers = "", .coded = true}, .second = {.copy = -1}
#define ENDPOINTS \
    CODES, .margin = true, .glossy_part = true, .clear_from = MOSTLY_CLEAR, .mirror_colour = mirror_white, \
        .first = {.copy = SCENE_COPY_CODED, .modifiers = SEEN_IN_MIRRORS, .coded = true}, \
        .second = {.copy = SCENE_COPY_MIRROR_SECOND, .modifiers = MIRRORS, .finish_end = end_mirror}, .coded_sky = true
#define DIRECTIONS \
    CODES, .digits = POSITION_DIGITS_ALL, .clear_from = CLEAR, \
        .first = {.copy = SCENE_COPY_CODED, .modifiers = SEEN_IN_MIRRORS}, .second = {.copy = -1}, .coded_sky = true
#define MIRROR_COPY \
    .first = {.copy = SCENE_COPY_MIRROR, .modifiers = MIRRORS, .finish_end = end_mirror}, .second = {.copy = -1}
#define EXPONENTS CODES, .margin = true, .mirror_colour = mirror_exponent, MIRROR_COPY, .trailer = sky_white
#define MIRRORED CODES, .glossy_part = true, .mirror_colour = mirror_white, MIRROR_COPY, .coded_sky = true
#define REFLECTIVITIES \
    .glossy_part = true, .first = {.copy = SCENE_COPY_REFLECTANCE, .modifiers = MIRRORS, .finish_end = end_reflectance}, \
    .second = {.copy = -1}, .trailer = sky_half

const struct pass pass_table[PASS_COUNT] = {
    [PASS_PHOTONS] = {.name = "photons",
                      .full_size = true,
                      .first = {.copy = SCENE_COPY_PLAIN, .modifiers = ""},
                      .second = {.copy = -1}},
    [PASS_BASE] = {.name = "base",
                   .full_size = true,
                   .first = {.copy = SCENE_COPY_BASE_FIRST, .modifiers = SEEN_IN_MIRRORS, .finish_end = "",
                             .placed = outside, .placed_once = true},
                   .second = {.copy = SCENE_COPY_BASE_SECOND, .modifiers = MIRRORS, .finish_end = end_base, .placed = ""}},
    [PASS_SPECULAR] = {.name = "specular",
                       .margin = true,
                       .glossy_part = true,
                       .marked = true,
                       .mirror_colour = mirror_white,
                       .first = {.copy = SCENE_COPY_PLAIN, .modifiers = SEEN_IN_MIRRORS},
                       .second = {.copy = SCENE_COPY_MIRROR_SECOND, .modifiers = MIRRORS, .finish_end = end_mirror},
                       .trailer = marker_sky},
    [PASS_HAZE] = {.name = "haze",
                   .margin = true,
                   .glossy_part = true,
                   .mirror_colour = mirror_white,
                   .first = {.copy = SCENE_COPY_PLAIN, .modifiers = SEEN_IN_MIRRORS},
                   .second = {.copy = SCENE_COPY_MIRROR_SECOND, .modifiers = MIRRORS, .finish_end = end_haze}},
    [PASS_REFLECTANCE] = {.name = "reflectance", .full_size = true, REFLECTIVITIES},
    [PASS_REFLECTIVITY] = {.name = "reflectivity", .margin = true, REFLECTIVITIES},
    [PASS_POSITION] = {.name = "position", .margin = true, .glossy_part = true, .digits = POSITION_DIGITS_HIGH, POSITIONS},
    [PASS_POSITION_LOW] = {.name = "position-low", .margin = true, .glossy_part = true, .digits = POSITION_DIGITS_LOW,
                           POSITIONS},
    [PASS_ENDPOINT] = {.name = "endpoint", .digits = POSITION_DIGITS_HIGH, ENDPOINTS, .trailer = black_sky},
    [PASS_ENDPOINT_LOW] = {.name = "endpoint-low", .digits = POSITION_DIGITS_LOW, ENDPOINTS},
    [PASS_VIEW] = {.name = "view", DIRECTIONS},
    [PASS_DIRECTION] = {.name = "direction", DIRECTIONS},
    [PASS_PLACE] = {.name = "place", .digits = POSITION_DIGITS_HIGH, POSITIONS},
    [PASS_PLACE_LOW] = {.name = "place-low", .digits = POSITION_DIGITS_LOW, POSITIONS},
    [PASS_EXPONENT] = {.name = "exponent", EXPONENTS},
    [PASS_EXPONENT_MEAN] = {.name = "exponent-mean", .glossy_part = true, .smooth = true, EXPONENTS},
    [PASS_OWN] = {.name = "own",
                  .full_size = true,
                  .first = {.copy = SCENE_COPY_PLAIN, .modifiers = ""},
                  .second = {.copy = -1}},
    [PASS_MIRROR] = {.name = "mirror", .digits = POSITION_DIGITS_HIGH, MIRRORED},
    [PASS_MIRROR_LOW] = {.name = "mirror-low", .digits = POSITION_DIGITS_LOW, MIRRORED},
    [PASS_PROBE] = {.name = "probe",
                    .first = {.copy = SCENE_COPY_PLAIN, .modifiers = SEEN_IN_MIRRORS},
                    .second = {.copy = -1},
                    .trailer = "#include \"" PASS_PROBE_VIEW "\"\n"},
};

/* What a copy without textures refers to. */
static enum result add_coded_macros(const struct pass *pass, struct buffer *text, struct error *err)
{
    return buffer_printf(text, err,
                         "#macro povgloss_coded(povgloss_c)\n"
                         "  #if (povgloss_c >= %g) pigment { rgbt 1 } #else transform {} #end\n"
                         "#end\n"
                         "#macro povgloss_no_interior() #ifdef (povgloss_interior) #undef povgloss_interior #end #end\n"
                         "#macro povgloss_coded_interior()\n"
                         "  #ifdef (povgloss_interior) interior { povgloss_interior } #end\n"
                         "#end\n",
                         pass->clear_from);
}

static bool is_mirror_copy(const struct scene_part *part)
{
    return part->copy == SCENE_COPY_MIRROR || part->copy == SCENE_COPY_MIRROR_SECOND;
}

/* The scene's macros call few others: POV-Ray reads a macro's text from its file at each call. Of a transparency and of a
 * state: */
#define IS_CLEAR(transparency) "(" transparency " >= " DIGITS(CLEAR) ")"
#define EXPONENT(state) \
    "(" state ".x >= 0 | " state ".y <= 0 | " IS_CLEAR(state ".t") " ? " state ".x :\n" \
    "    (povgloss_automatic & " state ".z >= 0 ? " state ".z : povgloss_all))"

/* What takes the place of povgloss_cover, a pigment that may be transparent, in a texture and in an object. */
static enum result add_cover_macros(const struct pass *pass, const struct scene_part *part, struct buffer *text,
                                    struct error *err)
{
    static const char keep[] = "pigment { povgloss_cover }", coded[] = "povgloss_coded(povgloss_t)";
#define THROUGH(place) "(povgloss_through(" place ").filter + povgloss_through(" place ").transmit)"
    static const char thin[] = "pigment { #if (povgloss_uv) uv_mapping #end\n"
                               "    function { min(0.999, " THROUGH("x, y, z") ") }\n"
                               "    color_map { [0 rgb %2$d] [%1$g rgb %2$d] [%1$g rgbt 1] [1 rgbt 1] } }";
    bool mirror = is_mirror_copy(part);
    char *thinned;
    enum result result = text_printf(&thinned, err, thin, CLEAR, pass->marked);
    if (!result)
        result = buffer_printf(text, err,
                               "#macro povgloss_see()\n"
                               "  #ifdef (povgloss_through) #undef povgloss_through #end\n"
                               "  #declare povgloss_through = function { pigment { povgloss_cover } };\n"
                               "  #declare povgloss_t = min(" THROUGH("0.1, 0.2, 0.3") ", " THROUGH("-5.3, 3.1, -2.7") ");\n"
                               "#end\n"
                               "#macro povgloss_cover_of_texture(povgloss_uv)\n"
                               "  povgloss_see()\n"
                               "  #declare povgloss_texture = <povgloss_texture.x, povgloss_texture.y, povgloss_texture.z,\n"
                               "    min(povgloss_lower, povgloss_t)>;\n"
                               "  #declare povgloss_last = povgloss_texture; %1$s\n"
                               "  #ifdef (povgloss_plain) povgloss_set_default(povgloss_t) #end %2$s %3$s %4$s\n"
                               "  #ifdef (povgloss_plain) povgloss_set_default(0) #end\n"
                               "#end\n"
                               "#macro povgloss_cover_of_object(povgloss_uv)\n"
                               "  povgloss_see()\n"
                               "  #declare povgloss_own = <povgloss_default_state.x, povgloss_default_state.y,\n"
                               "    povgloss_default_state.z, povgloss_t>;\n"
                               "  %1$s\n"
                               "  #ifdef (povgloss_plain) povgloss_set_default(povgloss_t) #end %5$s\n"
                               "  #ifdef (povgloss_plain) povgloss_set_default(0) #end\n"
                               "#end\n",
                               part->placed ? "povgloss_count(<-1, 0, -1, povgloss_t>)" : "",
                               mirror ? "#if (povgloss_texture.x < povgloss_maps_from)" : "", mirror ? thinned : keep,
                               mirror ? "#end" : "", part->copy == SCENE_COPY_CODED ? coded : mirror ? thinned : keep);
    free(thinned);
    return result;
}

/* What a texture refers to. A #default has a state, too, and its finish in two forms: povgloss_plain as it is written,
 * and povgloss_shiny, which is glossy where the state says so. The latter is the default but while a transparent
 * pigment takes it.
 * The state of a finish is a vector: x the exponent of its Gloss() or of the user's choice for the
 * name that is being declared, or -1; y whether it reflects; z the exponent of its highlight's lobe, or -1; t how
 * transparent the pigment with it is, and all layers below. Automatic gloss leaves transparent surfaces alone: what
 * they reflect inside can't be blurred. POV-Ray's specular highlight is a power 1/roughness of the cosine about the
 * half vector, whose angle is half of that from the mirror direction: an exponent of 1/(4 roughness) there. phong_size
 * is an exponent about the mirror direction.
 * Where objects are placed povgloss_counts is how many glossy textures came by (x), transparent ones (y), objects by names
 * of which neither is known (z), and transparent mirrors without gloss (t). */
static enum result add_state_macros(const struct scene *scene, const struct scene_part *part, struct buffer *text,
                                    struct error *err)
{
    const struct gloss_choice *choice = scene->choice;
    enum result result = buffer_add_text(
        text,
        "#declare povgloss_none = <-1, 0, -1, 0>;\n"
        "#declare povgloss_state = povgloss_none; #declare povgloss_texture = povgloss_none;\n"
        "#declare povgloss_last = povgloss_none; #declare povgloss_own = povgloss_none; #declare povgloss_lower = 1;\n"
        "#declare povgloss_reflects = 0; #declare povgloss_given = -1;\n"
        "#declare povgloss_default_state = povgloss_none; #declare povgloss_value = 0;\n"
        "#ifdef (povgloss_plain) #undef povgloss_plain #end\n"
        "#macro povgloss_set_default(povgloss_c)\n"
        "  #if " IS_CLEAR("povgloss_c") " #default { finish { povgloss_plain } }\n"
        "  #else #default { finish { povgloss_shiny } } #end\n"
        "#end\n"
        "#macro povgloss_set(povgloss_x, povgloss_y, povgloss_z)\n"
        "  #declare povgloss_state = <povgloss_x, povgloss_y, povgloss_z, povgloss_state.t>;\n"
        "#end\n"
        "#macro povgloss_phong_size()\n"
        "  povgloss_set(povgloss_state.x, povgloss_state.y, povgloss_size) phong_size povgloss_size\n"
        "#end\n"
        "#macro povgloss_roughness()\n"
        "  povgloss_set(povgloss_state.x, povgloss_state.y, 1/(4*max(povgloss_size, 1e-9))) roughness povgloss_size\n"
        "#end\n",
        err);
    if (!result)
        result = buffer_printf(text, err,
                               "#declare povgloss_all = %.9g; #declare povgloss_automatic = %d;\n"
                               "#macro povgloss_exponent(povgloss_s) " EXPONENT("povgloss_s") " #end\n",
                               choice->all ? fmin(choice->all_exponent, 1e30) : -1, choice->automatic);
    if (!result && part->placed)
        result = buffer_add_text(text,
                                 "#declare povgloss_counts = <0, 0, 0, 0>;\n"
                                 "#macro povgloss_add(povgloss_c)\n"
                                 "  #declare povgloss_counts = povgloss_counts + povgloss_c;\n"
                                 "#end\n"
                                 "#macro povgloss_count(povgloss_s)\n"
                                 "  #local povgloss_c = " IS_CLEAR("povgloss_s.t") ";\n"
                                 "  #local povgloss_g = (" EXPONENT("povgloss_s") " >= 0);\n"
                                 "  #declare povgloss_counts = povgloss_counts +\n"
                                 "    <povgloss_g, povgloss_c, 0, (povgloss_c & !povgloss_g & povgloss_s.y > 0)>;\n"
                                 "#end\n",
                                 err);
    return result;
}

static bool is_base(const struct scene_part *part)
{
    return part->copy == SCENE_COPY_BASE || part->copy == SCENE_COPY_BASE_FIRST || part->copy == SCENE_COPY_BASE_SECOND;
}

/* A finish with a Gloss_Map has an exponent from povgloss_painted on in its state. Where exponents are drawn each map
 * becomes a pigment of codes, which takes the place of the finish's own from there on where the texture transforms it,
 * and the exponent is then (2 + its number in povgloss_maps) povgloss_painted. */
static enum result add_map_macros(const struct pass *pass, struct buffer *text, struct error *err)
{
    return buffer_printf(
        text, err,
        "#declare povgloss_maps_from = %s;\n"
        "#declare povgloss_maps = array[1]; #declare povgloss_map_count = 0;\n"
        "#macro povgloss_take_map()\n"
        "  #if (povgloss_phong = povgloss_maps_from)\n"
        "    #if (povgloss_map_count = dimension_size(povgloss_maps, 1))\n"
        "      #local povgloss_more = array[2*povgloss_map_count];\n"
        "      #local povgloss_i = 0;\n"
        "      #while (povgloss_i < povgloss_map_count)\n"
        "        #local povgloss_more[povgloss_i] = povgloss_maps[povgloss_i];\n"
        "        #local povgloss_i = povgloss_i + 1;\n"
        "      #end\n"
        "      #declare povgloss_maps = povgloss_more;\n"
        "    #end\n"
        "    #declare povgloss_maps[povgloss_map_count] = pigment {\n"
        "      pigment_pattern { povgloss_map }\n"
        "      color_map {\n"
        "        [0 rgb <povgloss_exponent_code(povgloss_map_min), 0, 1>]\n"
        "        [1 rgb <povgloss_exponent_code(povgloss_map_max), 0, 1>]\n"
        "      }\n"
        "    }\n"
        "    #declare povgloss_phong = povgloss_maps_from*(2 + povgloss_map_count);\n"
        "    #declare povgloss_map_count = povgloss_map_count + 1;\n"
        "  #end\n"
        "#end\n"
        "#macro povgloss_paint()\n"
        "  #if (povgloss_value = 0 & povgloss_last.x >= povgloss_maps_from & povgloss_last.x != povgloss_begun)\n"
        "    pigment { povgloss_maps[floor(povgloss_last.x/povgloss_maps_from + 0.5) - 2] }\n"
        "  #end\n"
        "#end\n"
        "#macro povgloss_repaint()\n"
        "  #if (povgloss_last.x >= povgloss_maps_from) finish { } #else pigment { povgloss_pigment } #end\n"
        "#end\n",
        pass->mirror_colour == mirror_exponent ? "2e30" : "1e60");
}

/* What a copy with marked finishes refers to besides. */
static enum result add_finish_macros(const struct scene *scene, const struct pass *pass, const struct scene_part *part,
                                     struct buffer *text, struct error *err)
{
    enum result result = buffer_add_text(
        text,
        "#macro povgloss_hide(povgloss_s)\n"
        "  #if (" EXPONENT("povgloss_s") " >= 0 & (povgloss_mirrors | " IS_CLEAR("povgloss_s.t") ")\n"
        "       & povgloss_s.x < povgloss_maps_from) pigment { rgb 0 } #end\n"
        "#end\n"
        "#macro povgloss_exponent_code(povgloss_p)\n"
        "  ((20 + log(min(max(povgloss_p, pow(2, -20)), 1e30))/log(2))/128)\n"
        "#end\n",
        err);
    if (!result)
        result = scene->painted ? add_map_macros(pass, text, err)
                                : buffer_add_text(text, "#declare povgloss_maps_from = 1e60;\n", err);
    if (!result)
        result = buffer_printf(text, err,
                               "#declare povgloss_mirrors = %d; #declare povgloss_pigment = pigment { rgb %d };\n",
                               pass->mirror_colour != NULL, pass->marked);
    if (!result && pass->mirror_colour)
        result = buffer_printf(text, err, "#macro povgloss_mirror_colour() %s #end\n", pass->mirror_colour);
    if (!result)
        result = buffer_printf(text, err,
                               "#macro povgloss_finish(povgloss_named)\n"
                               "  #if (povgloss_given >= 0) #declare povgloss_phong = povgloss_given; #end\n"
                               "  %s\n"
                               "  #if (povgloss_phong >= 0)\n"
                               "    #declare povgloss_state =\n"
                               "      <povgloss_phong, povgloss_state.y, povgloss_state.z, povgloss_state.t>;\n"
                               "  #end\n"
                               "  #declare povgloss_last = povgloss_state; %s\n"
                               "  #declare povgloss_phong = (povgloss_named ? povgloss_state.x :\n"
                               "    " EXPONENT("povgloss_state") ");\n"
                               "  %s\n"
                               "  #if (povgloss_phong >= povgloss_maps_from) emission 1 crand 0 #end\n"
                               "#end\n"
                               "#macro povgloss_enter_default()\n"
                               "  #ifdef (povgloss_plain) povgloss_set_default(1) #end " STATE_LAYER "\n"
                               "  #declare povgloss_last = povgloss_default_state;\n"
                               "#end\n"
                               "#macro povgloss_leave_default()\n"
                               "  #if (povgloss_last.x >= 2e30)\n"
                               "    #error \"Gloss_Map() can't stand in a #default: write it into the finishes\\n\"\n"
                               "  #end\n"
                               "  #declare povgloss_default_state = <povgloss_last.x, povgloss_last.y, povgloss_last.z, 0>;\n"
                               "  #declare povgloss_plain = finish { };\n"
                               "  #declare povgloss_shiny = finish { " STATE_FINISH("povgloss_last") " povgloss_finish(0) };\n"
                               "  povgloss_set_default(0)\n"
                               "#end\n"
                               "#macro povgloss_of_default() #ifdef (povgloss_plain) povgloss_plain #end #end\n",
                               scene->painted ? "povgloss_take_map()" : "",
                               part->placed ? "povgloss_count(povgloss_state)" : "", part->finish_end);
    /* POV-Ray gives a name that is first declared within its own first declaration the inner value. */
    if (!result && part->placed)
        result = buffer_printf(text, err,
                               "#declare povgloss_object = povgloss_nothing()\n"
                               "#declare povgloss_depth = 0;\n"
                               "#declare povgloss_default_counts = <0, 0, 0, 0>;\n"
                               "#macro povgloss_counted_default()\n"
                               "  #declare povgloss_default_counts =\n"
                               "    povgloss_default_counts + povgloss_counts - povgloss_before_default;\n"
                               "#end\n"
                               "#macro povgloss_enter()\n"
                               "  #if (povgloss_depth = 0) #declare povgloss_before = povgloss_counts; #end\n"
                               "  #declare povgloss_depth = povgloss_depth + 1;\n"
                               "#end\n"
                               "#macro povgloss_leave() #declare povgloss_depth = povgloss_depth - 1; #end\n"
                               "#macro povgloss_is_glossy()\n"
                               "  (povgloss_counts.x > povgloss_before.x | (povgloss_counts.y = povgloss_before.y &\n"
                               "   (povgloss_default_counts.x > 0 | povgloss_counts.z > povgloss_before.z)))\n"
                               "#end\n"
                               "#macro povgloss_is_clear()\n"
                               "  (povgloss_counts.y > povgloss_before.y | povgloss_default_counts.y > 0)\n"
                               "#end\n"
                               "#macro povgloss_place(povgloss_f, povgloss_l)\n"
                               "  povgloss_leave()\n"
                               "  povgloss_note_object(povgloss_f, povgloss_l)\n"
                               "  #if (povgloss_depth = 0 & povgloss_is_clear() & !povgloss_is_glossy()) %s\n"
                               "  #else object { povgloss_object } #end\n"
                               "#end\n"
                               "#macro povgloss_note_object(povgloss_f, povgloss_l)\n"
                               "  #if (povgloss_depth = 0 & povgloss_is_glossy() & povgloss_counts.y > povgloss_before.y)\n"
                               "    povgloss_note(\"" PASS_MIXED_FILE "\", povgloss_f, povgloss_l)\n"
                               "  #end\n"
                               "  #if (povgloss_depth = 0 & povgloss_counts.t > povgloss_before.t)\n"
                               "    povgloss_note(\"" PASS_GLASS_FILE "\", povgloss_f, povgloss_l)\n"
                               "  #end\n"
                               "#end\n"
                               "#macro povgloss_note(povgloss_n, povgloss_f, povgloss_l)\n"
                               "  #if (!file_exists(povgloss_n))\n"
                               "    #fopen povgloss_file povgloss_n write\n"
                               "    #write (povgloss_file, str(povgloss_f, 0, 0), \" \", str(povgloss_l, 0, 0))\n"
                               "    #fclose povgloss_file\n"
                               "  #end\n"
                               "#end\n",
                               part->placed);
    if (!result && part->placed)
        result = buffer_printf(text, err,
                               "#macro povgloss_place_part(povgloss_f, povgloss_l)\n"
                               "  povgloss_leave() povgloss_note_object(povgloss_f, povgloss_l)\n"
                               "  #if (povgloss_depth > 0) object { povgloss_object }\n"
                               "  #else #if (povgloss_is_glossy()) object { povgloss_object %s }\n"
                               "  #else %s #end #end\n"
                               "#end\n"
                               "#macro povgloss_leave_copy() %s #end\n"
                               "#macro povgloss_enter_copy() %s #end\n",
                               part->placed_once ? part->modifiers : "",
                               part->placed_once ? "object { povgloss_object }" : "",
                               part->placed_once ? "#if (povgloss_depth = 0) povgloss_modifiers() } #end" : "",
                               part->placed_once ? "#if (povgloss_depth = 0) union { povgloss_nothing() #end" : "");
    if (!result && !is_base(part))
        result = buffer_add_text(text, "#default { pigment { povgloss_pigment } finish { " DARK " " MARK " } }\n", err);
    return result;
}

static enum result add_coding_texture(const struct pass *pass, struct buffer *text, struct error *err)
{
    enum result result = buffer_add_text(text, "texture { ", err);
    if (!result)
        result = position_code_pigment(text, false, pass->digits, err);
    return result ? result : buffer_add_text(text,
                                             "finish { emission 1 ambient 0 diffuse 0 specular 0 phong 0 irid { 0 } "
                                             "crand 0 reflection { 0 } } }\n",
                                             err);
}

static enum result add_part(const struct scene *scene, const struct pass *pass, const struct scene_part *part,
                            struct buffer *text, struct error *err)
{
    bool coded = part->copy == SCENE_COPY_CODED, tracked = part->copy != SCENE_COPY_PLAIN;
    enum result result = tracked ? add_state_macros(scene, part, text, err) : RESULT_OK;
    if (!result && tracked)
        result = scene_declare_states(scene, text, err);
    if (!result && tracked)
        result = add_cover_macros(pass, part, text, err);
    if (!result && tracked)
        result = coded ? add_coded_macros(pass, text, err) : add_finish_macros(scene, pass, part, text, err);
    char *name = NULL;
    if (!result)
        result = scene_copy_name(scene, (enum scene_copy)part->copy, 0, &name, err);
    if (!result && part->copy == SCENE_COPY_BASE) {
        result = buffer_printf(text, err, "#include \"%s\"\n", name);
        free(name);
        return result;
    }
    /* Objects of a union that have no interior of their own share one, which is as hollow as the last of them: where it
     * is, the haze fills their hollow ones. */
    if (!result)
        result = buffer_printf(text, err, "#macro povgloss_modifiers()\n%s%s\n",
                               scene->atmosphere ? "povgloss_nothing() " : "", part->modifiers);
    if (!result && part->coded)
        result = add_coding_texture(pass, text, err);
    if (!result)
        result = buffer_printf(text, err,
                               "#end\nunion { povgloss_nothing()\n#include \"%s\"\npovgloss_modifiers() }\n"
                               "#undef povgloss_modifiers\n",
                               name);
    free(name);
    return result;
}

/* Between two copies: neither names nor defaults of the first one hold for the second. */
static enum result add_separation(const struct scene *scene, struct buffer *text, struct error *err)
{
    enum result result = scene_restore_names(scene, text, err);
    return result ? result : buffer_add_text(text, "#default { texture { povgloss_default } }\n", err);
}

static enum result add_coded_sky(const struct pass *pass, struct buffer *text, struct error *err)
{
    enum result result = buffer_add_text(text, "sky_sphere { ", err);
    if (!result)
        result = position_code_pigment(text, true, pass->digits, err);
    return result ? result : buffer_add_text(text, "}\n", err);
}

/* Whether a mirror without gloss may show a glossy surface. With --gloss all only transparent surfaces are such
 * mirrors. */
static bool scene_mirrors_gloss(const struct scene *scene)
{
    return scene->plain_mirrors && (!scene->choice->all || scene->may_be_clear);
}

bool pass_weights_specular(const struct scene *scene)
{
    return scene->focal_blur || scene->mixes;
}

double pass_marker(const struct scene *scene)
{
    return scene->working_gamma == 1 ? -64 : 64;
}

struct pass pass_of(const struct scene *scene, enum pass_id id)
{
    struct pass pass = pass_table[id];
    /* The second copy is needed only where a glossy surface is seen in a mirror, and where the light counts that it
     * throws onto others. Light under a surface is lost where a second copy of the surface lies on it. */
    bool doubled = scene->glossy && !scene->limits[SCENE_LIMIT_SUBSURFACE].line &&
                   (scene_mirrors_gloss(scene) || scene->radiosity);
    if (id == PASS_BASE && !doubled) {
        pass.first = (struct scene_part){.copy = SCENE_COPY_BASE, .finish_end = end_base};
        pass.second.copy = -1;
    }
    if (pass_weights_specular(scene) && (id == PASS_SPECULAR || id == PASS_HAZE)) {
        pass.mirror_colour = NULL;
        pass.second.copy = SCENE_COPY_REFLECTION;
        pass.second.finish_end = id == PASS_HAZE ? end_haze_of_reflection : end_reflection;
    }
    if (pass.marked && pass_needed(scene, PASS_HAZE)) {
        pass.marked = false;
        pass.trailer = NULL;
    }
    /* An aperture sees glossy surfaces beyond the silhouettes of codes, which have none. */
    if (id == pass_of_glossy(scene) || (scene->focal_blur && !pass.codes))
        pass.glossy_part = false;
    return pass;
}

enum pass_id pass_of_glossy(const struct scene *scene)
{
    return pass_exponents_differ(scene) ? PASS_EXPONENT : PASS_ENDPOINT;
}

enum result pass_discovery_text(const struct scene *scene, struct buffer *text, struct error *err)
{
    char *name = NULL;
    enum result result = scene->version > 0 ? buffer_printf(text, err, "#version %.9g;\n", scene->version) : RESULT_OK;
    if (!result)
        result = scene_copy_name(scene, SCENE_COPY_DISCOVERY, 0, &name, err);
    if (!result)
        result = buffer_printf(text, err,
                               "#macro povgloss_camera() #end\n#include \"%s\"\n" SCENE_DISCOVERY_WRITE("\"end\"")
                               "\n#error \"discovered\"\n",
                               name);
    free(name);
    return result;
}

/* Photons don't meet what is no_image, and nothing reflects them in the base: all passes take those of the scene
 * itself. */
static enum result add_photon_macro(enum pass_id id, struct buffer *text, struct error *err)
{
    return buffer_add_text(text,
                           id == PASS_PHOTONS ? "#macro povgloss_photons() save_file \"" PASS_PHOTONS_FILE "\" #end\n"
                                              : "#macro povgloss_photons()\n"
                                                "  #if (file_exists(\"../photons/" PASS_PHOTONS_FILE "\")) load_file "
                                                "\"../photons/" PASS_PHOTONS_FILE "\" #end\n"
                                                "#end\n",
                           err);
}

bool pass_is_verbatim(const struct scene *scene, enum pass_id id)
{
    return id == PASS_OWN && !(scene->photons && scene->glossy);
}

enum result pass_scene_text(const struct scene *scene, enum pass_id id, struct buffer *text, struct error *err)
{
    const struct pass pass = pass_of(scene, id);
    enum result result = RESULT_OK;
    if (pass_is_verbatim(scene, id))
        return buffer_add(text, scene->files[0].source.data, scene->files[0].source.size, err);
    if (scene->version > 0)
        result = buffer_printf(text, err, "#version %.9g;\n", scene->version);
    if (!result && pass.technical)
        result = buffer_add_text(text, "global_settings { assumed_gamma 1.0 }\n", err);
    if (!result)
        result = buffer_add_text(
            text, "#macro povgloss_nothing() sphere { 0, 1e-6 hollow no_image no_reflection no_shadow no_radiosity } #end\n", err);
    if (!result)
        result = buffer_add_text(text, "#declare povgloss_default = texture { pigment { rgb 0 } };\n", err);
    /* Codes must not be averaged by focal blur. */
    if (!result)
        result = buffer_printf(text, err, "#macro povgloss_camera() %s #end\n", pass.codes ? "aperture 0" : "");
    if (!result && pass.marked)
        result = buffer_printf(text, err, "#declare povgloss_marker = %g;\n", pass_marker(scene));
    if (!result)
        result = add_photon_macro(id, text, err);
    if (!result)
        result = scene_save_names(scene, text, err);
    if (!result)
        result = add_part(scene, &pass, &pass.first, text, err);
    if (!result && (pass.second.copy >= 0 || id == PASS_PROBE))
        result = add_separation(scene, text, err);
    if (!result && pass.second.copy >= 0)
        result = add_part(scene, &pass, &pass.second, text, err);
    if (!result && pass.coded_sky)
        result = add_coded_sky(&pass, text, err);
    if (!result && pass.trailer)
        result = buffer_add_text(text, pass.trailer, err);
    if (!result && pass.technical)
        result = buffer_add_text(text, "global_settings { max_trace_level 20 adc_bailout 1/255 }\n", err);
    return result;
}

bool pass_is_place(enum pass_id id)
{
    return id == PASS_PLACE || id == PASS_PLACE_LOW;
}

bool pass_is_mirror(enum pass_id id)
{
    return id == PASS_MIRROR || id == PASS_MIRROR_LOW;
}

bool pass_needed(const struct scene *scene, enum pass_id id)
{
    if (id == PASS_PROBE || pass_is_mirror(id) || pass_is_place(id))
        return false;
    if (id == PASS_EXPONENT_MEAN && !scene->painted)
        return false;
    if (id == PASS_EXPONENT && !pass_exponents_differ(scene))
        return false;
    /* The camera may be in an object with media: those of the copy that only mirrored rays see are before its eye,
     * too. */
    if (id == PASS_HAZE && !scene->atmosphere && !scene->limits[SCENE_LIMIT_MEDIA].line && !pass_weights_specular(scene))
        return false;
    if (id == PASS_REFLECTIVITY && !pass_weights_specular(scene))
        return false;
    return id == PASS_BASE || id == PASS_OWN || (scene->glossy && (id != PASS_PHOTONS || scene->photons));
}

bool pass_exponents_differ(const struct scene *scene)
{
    return scene->exponent < 0 || scene->mixes || (scene->refracts && scene->may_be_clear);
}

void pass_copies(const struct scene *scene, enum pass_id id, bool needed[SCENE_COPY_COUNT])
{
    if (pass_is_verbatim(scene, id))
        return;
    const struct pass pass = pass_of(scene, id);
    needed[pass.first.copy] = true;
    if (pass.second.copy >= 0)
        needed[pass.second.copy] = true;
}
