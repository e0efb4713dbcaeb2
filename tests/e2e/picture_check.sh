#!/usr/bin/env bash
# The sum of the passes is compared with POV-Ray's own picture: what they don't model is said, and nothing is said of
# antialiasing, sizes, noise, or what else isn't the same in a small picture.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
library=+L$root/povscenes
small=(+W160 +H120 -A)

# A glossy floor; more is on standard input.
write_scene() {
    {
        cat << 'POV'
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }
camera { location <0, 2, -6> right x*image_width/image_height look_at <0, 0.8, 0> }
sky_sphere { pigment { gradient y color_map { [0 rgb 0.9] [1 rgb <0.1, 0.3, 0.9>] } } }
plane { y, 0 pigment { checker rgb 0.3 rgb 0.5 } finish { reflection 0.5 Gloss(50) } }
sphere { <0, 1, 1>, 1 pigment { rgb <0.9, 0.3, 0.1> } }
POV
        cat
    } > "$1"
}
sun='light_source { <-5, 8, -6> rgb 1 }'
smoke='box { <-9, -1, -4>, <9, 5, -3> hollow pigment { rgbt 1 } interior { media { absorption 0.5 } } }'
write_scene right.pov <<< "$sun"
write_scene wrong.pov <<< "$sun $smoke"
write_scene later.pov <<< "$sun #if (frame_number > 1) $smoke #end"

# warnings SCENE ARGUMENT...: what is said of its picture, in $said.
warnings() {
    run "$bin/povgloss" passes "$1" "$library" -o out.exr "${@:2}"
    expect_status 0 || return
    said=$(grep 'add up to' err) || :
}

# shellcheck disable=SC2015 # show_run is for both
says() {
    warnings "${@:2}" || return
    [[ $said =~ $1 ]] && [ "$(wc -l <<< "$said")" -eq 1 ] || { echo "not said: $1"; show_run; return 1; }
}

says_nothing() {
    warnings "$@" || return
    [ -z "$said" ] || { show_run; return 1; }
}

for scene in "$root"/povscenes/*.pov; do
    check "passes__$(basename "$scene" .pov)__adds_up" says_nothing "$scene" +W320 +H240 +A0.3
done
check "passes__smoke__is_said" says \
    "^povgloss: warning: wrong.pov: the passes .* in [1-9][0-9]? % of the image, most at pixel [0-9]+,[0-9]+: " wrong.pov "${small[@]}"
check "passes__smoke_antialiased__is_said" says 'wrong.pov: ' wrong.pov +W320 +H240 +A0.3
check "passes__smoke_in_a_size_without_a_whole_ratio__is_said" says 'wrong.pov: ' wrong.pov +W256 +H192 -A
check "passes__smoke_in_a_later_frame__names_the_frame" says 'warning: frame 2: later.pov: ' later.pov "${small[@]}" +KFF2
check "passes__scene_on_standard_input__is_said" says 'in [0-9]+ % ' - "${small[@]}" < wrong.pov
for size in "+W160 +H120 +A0.3" "+W256 +H192 -A" "+W256 +H192 +A0.3" "+W333 +H217 +A0.3" "+W320 +H240 -A" "+W40 +H30" ; do
    # shellcheck disable=SC2086 # several switches
    check "passes__size_${size// /_}__adds_up" says_nothing right.pov $size
done
check "passes__no_size__adds_up" says_nothing right.pov -A
check "passes__subsampled__adds_up" says_nothing right.pov +W320 +H240 -A --subsample 4

write_scene noise.pov << 'POV'
light_source { <-5, 8, -6> rgb 1 area_light 4*x, 4*y, 3, 3 jitter }
box { <-3, 0, 2>, <-1, 2, 3> pigment { rgb 0.7 } finish { crand 0.3 } }
POV
check "passes__noise__adds_up" says_nothing noise.pov "${small[@]}"
check "passes__noise_antialiased__adds_up" says_nothing noise.pov +W320 +H240 +A0.3
write_scene light.pov << POV
$sun
global_settings { radiosity { count 30 error_bound 0.8 } photons { count 5000 } }
sphere { <2, 0.7, -1>, 0.7 pigment { rgbt 0.9 } interior { ior 1.5 } photons { target refraction on } }
POV
check "passes__radiosity_and_photons__adds_up" says_nothing light.pov +W320 +H240 -A
write_scene pixels.pov << POV
$sun
sphere { <3 - 0.01*image_width, 1, -1>, 1 pigment { rgb <0.2, 0.9, 0.3> } }
POV
check "passes__scene_that_depends_on_the_size__adds_up" says_nothing pixels.pov +W320 +H240 -A
cat > mesh_camera.pov << 'POV'
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }
#declare Grid = mesh {
  #for (Y, 0, 134) #for (X, 0, 179)
    triangle { <X/45 - 2, 3 - Y/45, -2>, <X/45 - 2, 3.01 - Y/45, -2>, <X/45 - 1.99, 3 - Y/45, -2> }
  #end #end
}
camera { mesh_camera { 1 0 mesh { Grid } } location z*-0.001 }
POV
sed '/^camera/d; /^#version/,/^global/d' right.pov >> mesh_camera.pov
check "passes__a_camera_made_of_a_mesh__adds_up" says_nothing mesh_camera.pov +W180 +H135 -A

# no_own SWITCH...: POV-Ray's own picture isn't drawn.
no_own() {
    rm -rf kept
    says_nothing wrong.pov "${small[@]}" --keep kept "$@" && [ -d kept/base ] && expect_no_file kept/own
}
check "passes__no_check__draws_no_picture_of_its_own" no_own --no-check
check "passes__quiet__draws_no_picture_of_its_own" no_own --quiet
check "passes__part_of_the_picture__draws_no_picture_of_its_own" no_own +SR20 +ER60

own_is_povrays() {
    rm -rf kept
    warnings wrong.pov +W320 +H240 +A0.3 --keep kept && povray +Iwrong.pov "$library" +W64 +H48 -A -D +FE +Otruth.exr \
        > povray.log 2>&1 && oiiotool -a --fail 0 --diff truth.exr kept/own/image.exr
}
check "passes__own_picture__is_povrays_to_the_bit" own_is_povrays
end_of_tests
