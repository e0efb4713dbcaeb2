#!/usr/bin/env bash
# --margin: the reflection is rendered beyond the picture's border, and the picture is what it was but for a better blur.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
library=+L$root/povscenes
contact=$root/povscenes/contact.pov
size=(+W160 +H120 -A)

passes() {
    run "$bin/povgloss" passes "$2" "$library" "${size[@]}" "${@:3}" -o "$1"
    expect_status 0 && expect_nothing_left
}
# has WINDOW: the passes file's data window is that, the display window the picture.
has() {
    oiiotool --info -v "$1" > info || return 1
    grep -q 'full/display size: 160 x 120$' info && grep -q "pixel data origin: x=-$2, y=-$3\$" info || { cat info; return 1; }
}
check "passes__without__of_the_pictures_size" passes plain.exr "$contact" --quiet
windows() {
    passes wide.exr "$contact" --margin 10% && has wide.exr 16 12 || return 1
    ! grep -qF 'no margin' err || { cat err; return 1; }
    passes pixels.exr "$contact" --margin=5 --quiet && has pixels.exr 5 5
}
check "passes__percent_and_pixels__a_wider_data_window" windows
mirror() {
    local name
    for name in plain wide pixels; do
        "$bin/glossfilter" $name.exr --phong inf -o $name.mirror.exr || return 1
    done
    oiiotool --info wide.mirror.exr | grep -q "160 x *120, 3 channel" &&
        rmse_below 0.0005 plain.mirror.exr wide.mirror.exr && rmse_below 0.0005 plain.mirror.exr pixels.mirror.exr
}
rmse_below() {
    awk -v rmse="$(rmse "$2" "$3")" -v most="$1" 'BEGIN { print rmse; exit !(rmse < most) }'
}
check "filter__mirror__the_same_picture" mirror
base() {
    local channels
    for channels in R,G,B reflectance.R,reflectance.G,reflectance.B; do
        oiiotool plain.exr --ch "$channels" -o one.exr wide.exr --ch "$channels" --crop 160x120+0+0 -o two.exr &&
            oiiotool -a --fail 0 --diff one.exr two.exr || return 1
    done
}
check "passes__base_and_reflectance__the_same_to_the_bit" base

# The truth at the border, by rays.
"$bin/povgloss" probe "$contact" "$library" "${size[@]}" --grid 12 --phong 30 --error 0.02 --quiet -o all.csv
awk -F, 'NR == 1 || $1 < 16 || $1 >= 144 || $2 >= 108' all.csv > border.csv
border_rmse() {
    "$bin/glossfilter" "$1" --phong 30 --layers -o glossy.exr &&
        "$bin/povgloss" compare border.csv glossy.exr --phong 30 | awk '$1 == "rmse" { print $2 }'
}
nearer() {
    local plain wide
    plain=$(border_rmse plain.exr) && wide=$(border_rmse wide.exr) || return 1
    echo "RMSE at the border $plain, with a margin $wide"
    awk -v plain="$plain" -v wide="$wide" 'BEGIN { exit !(wide > 0 && wide < 0.7 * plain) }'
}
check "filter__at_the_border__nearer_to_the_truth" nearer
rendered() {
    run "$bin/povgloss" render "$contact" "$library" "${size[@]}" --phong 30 --margin 10% -o rendered.exr
    expect_status 0 && "$bin/glossfilter" wide.exr --phong 30 -o filtered.exr &&
        oiiotool -a --fail 0 --diff rendered.exr filtered.exr
}
check "render__margin__the_passes_filtered" rendered

# scene CAMERA
scene() {
    cat << POV
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
#macro Eye(Height) <1, Height, -6> #end
$1
light_source { <-5, 8, -6> rgb 1 }
plane { y, 0 pigment { checker rgb 0.2 rgb 0.9 } finish { reflection 0.5 Gloss(50) } }
sphere { <0, 1, 0>, 1 pigment { rgb <1, 0, 0> } }
POV
}
# Cameras of all kinds, the same picture: what they see is compared where the mirror is perfect.
camera() {
    scene "$1" > scene.pov
    passes one.exr scene.pov --quiet "${@:2}" && passes two.exr scene.pov --margin 12% "${@:2}" || return 1
    ! grep -qF 'no margin' err || { cat err; return 1; }
    has two.exr 19 14 && "$bin/glossfilter" one.exr --phong inf -o one.png --bits 16 &&
        "$bin/glossfilter" two.exr --phong inf -o two.png --bits 16 && rmse_below 0.002 one.png two.png
}
check "camera__angle_and_look_at" camera 'camera { location Eye(2) angle 50 look_at <0, 1, 0> }'
check "camera__by_a_name_that_is_turned" camera '#declare C = camera { location <0, 2, -6> right 1.6*x }
    camera { C rotate <5, 20, 3> translate 0.5*x }'
check "camera__in_a_macro_with_conditions" camera '#macro C(A) camera { #if (A) location Eye(3) #end look_at y } #end C(1)'
check "camera__askew" camera 'camera { location Eye(2) direction z right <-1.33, 0.1, 0.2> up <0, 1, 0.1> }'
moving() {
    scene 'camera { location <2*clock, 2, -6> look_at y }' > scene.pov
    passes frame.exr scene.pov --margin 10% +KFF3 || return 1
    oiiotool --info -v frame1.exr frame3.exr | grep eye: | tr -d '\n' | grep -q 'eye: -\?[0-9.e-]*, 2, -6 .*eye: 2, 2, -6' ||
        { oiiotool --info -v frame1.exr frame3.exr | grep eye; return 1; }
}
check "animation__moving_camera__each_frame_its_own" moving

painted() {
    cat > scene.pov << 'POV'
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }
camera { location <0, 2, -6> look_at y }
light_source { <-5, 8, -6> rgb 1 }
plane { y, 0
  texture { pigment { checker rgb 0.2 rgb 0.9 } finish { reflection 0.5 Gloss_Map(pigment { checker rgb 0 rgb 1 scale 2 }, 300, 30) } }
}
sphere { <0, 1, 0>, 1 pigment { rgb <1, 0, 0> } }
POV
    passes one.exr scene.pov --quiet && passes two.exr scene.pov --margin 5% --quiet && has two.exr 8 6 &&
        oiiotool one.exr --ch phong.V -o one.phong.exr two.exr --ch phong.V --crop 160x120+0+0 -o two.phong.exr &&
        rmse_below 1 one.phong.exr two.phong.exr
}
check "painted__exponents_with_a_margin__the_same_within_it" painted

# none REASON CAMERA OPTION...: a warning with the reason, and a file without a margin.
none() {
    scene "$2" > scene.pov
    passes none.exr scene.pov --margin 10% "${@:3}" || return 1
    grep -qF "there is no margin: $1" err || { cat err; return 1; }
    ! oiiotool --info -v none.exr | grep -q 'pixel data origin'
}
check "orthographic" none "the camera isn't a perspective one" 'camera { orthographic location <0, 3, -6> look_at 0 angle 60 }'
check "focal blur" none "the camera has an aperture" \
    'camera { location <0, 2, -6> look_at y aperture 0.01 blur_samples 4 focal_point 0 }'
check "fisheye" none "the camera isn't a perspective one" 'camera { fisheye location <0, 2, -6> look_at 0 angle 120 }'
check "part of the picture" none "only a part of the picture" 'camera { location <0, 2, -6> look_at y }' +SR1
check "size" none "the scene depends on the picture's size" \
    'camera { location <0, 2, -6> look_at y } #declare W = image_width;'

refuses() {
    run "$bin/povgloss" "$2" "$contact" "$library" "${size[@]}" "${@:3}" -o refused.exr
    expect_status 2 && expect_message "$1" && expect_no_file refused.exr
}
check "subsampling" refuses "don't go together" render --margin 10% --subsample 2
check "rays" refuses "don't go together" render --margin 10% --rays 4
check "brute" refuses 'no --margin' brute --margin 10%
check "a word" refuses '--margin wide: must be a whole number' render --margin wide
check "too many percent" refuses '--margin 101: must be a number from 0 to 100' render --margin 101%
check "nothing" refuses '--margin : must be' render --margin=
end_of_tests
