#!/usr/bin/env bash
# +A: L0 is the mean over what is glossy of a pixel. The mirror is then as smooth as POV-Ray's own, and the blur nearer to the
# truth.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
scene=$root/povscenes/spheres.pov
options=("+L$root/povscenes" +W160 +H120 --quiet)

# passes NAME OPTION...
passes() {
    "$bin/povgloss" passes "$scene" "${options[@]}" "${@:2}" -o "$1.exr"
}
check "passes__antialiased__work" passes mean +A0.3
check "passes__no_means__work" passes point +A0.3 --no-means --keep point

# A mirror behind bars, some thinner than a pixel, and under a sky of one colour.
bars() {
    cat << SCENE
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma $1 }
camera { location <0, 2, -6> look_at y*0.3 }
sky_sphere { pigment { rgb $2 } }
plane { y, 0 pigment { rgb 0.1 } finish { reflection 0.5 Gloss(300) } }
#for (I, -20, 20) cylinder { <I/4, 0, -3>, <I/3, 3, -2>, 0.003 + 0.002*abs(I) pigment { rgb 0.2 } no_reflection } #end
SCENE
}
largest() {
    oiiotool "$@" --printstats | awk '/Stats Max/ { print $3 }'
}
# only_sky GAMMA WORKING LINEAR MOST: L0 is the sky's colour, within MOST, wherever something is glossy.
only_sky() {
    bars "$1" "$2" > bars.pov
    "$bin/povgloss" passes bars.pov "${options[@]}" +A0.1 --keep bars -o bars.exr || return 1
    local off mixed
    off=$(largest bars.exr --ch specular.R --subc "$3" --abs bars.exr --ch phong.V --clamp:max=1 --mul)
    mixed=$(largest bars.exr --ch specular.R bars/specular/image.exr --ch R --absdiff bars.exr --ch phong.V --clamp:max=1 --mul)
    rm -r bars
    echo "L0 is off by $off; of what POV-Ray drew some $mixed had to be taken away"
    awk -v off="$off" -v most="$4" -v mixed="$mixed" 'BEGIN { exit !(off <= most && mixed > 1) }'
}
check "passes__antialiased__L0_of_what_is_glossy_alone" only_sky 1 0.8 0.8 0.08
check "passes__antialiased__bright_L0_of_what_is_glossy_alone" only_sky 1 10 10 0.1
check "passes__antialiased__L0_of_what_is_glossy_alone__power" only_sky 2.2 0.8 0.6121 0.06
check "passes__antialiased__L0_of_what_is_glossy_alone__srgb" only_sky srgb 0.8 0.6038 0.06

mirror() {
    local name
    povray "+I$scene" "+L$root/povscenes" +W160 +H120 +A0.0 +AM1 +R3 -J -D +FE +Oown.exr > log 2>&1 || { tail -5 log; return 1; }
    for name in mean point; do
        "$bin/glossfilter" $name.exr --phong inf -o $name-mirror.exr || return 1
    done
    less 0.75 "$(rmse own.exr mean-mirror.exr)" "$(rmse own.exr point-mirror.exr)"
}
# less SHARE A B: A is less than that share of B.
less() {
    echo "RMSE $2, and without means $3"
    awk -v most="$1" -v mean="$2" -v point="$3" 'BEGIN { exit !(mean > 0 && mean < most * point) }'
}
check "filter__mirror__as_smooth_as_povrays" mirror

nearer() {
    local name p
    "$bin/povgloss" probe "$scene" "${options[@]}" --grid 16 --phong 100 --phong 1000 --error 0.01 -o probes.csv || return 1
    for p in 100 1000; do
        for name in mean point; do
            "$bin/glossfilter" $name.exr --phong $p --layers -o glossy.exr &&
                "$bin/povgloss" compare probes.csv glossy.exr --phong $p | awk '$1 == "rmse" { print $2 }' > $name.rmse
        done
        less 0.8 "$(cat mean.rmse)" "$(cat point.rmse)" || return 1
    done
}
check "filter__antialiased__nearer_to_the_truth" nearer

# one_ray A B: what POV-Ray drew of L0 in the folder A of kept passes is by one ray a pixel, as in B.
one_ray() {
    idiff -a -fail 0 -hardfail 0 "$1/specular/image.exr" "$2/specular/image.exr"
}
none() {
    passes other "${@:3}" --keep "$1" && one_ray "$1" "$2"
}
check "passes__not_antialiased__no_means" none plain point -A
check "passes__subsampled__work" passes few -A --subsample 2 --keep few
check "passes__subsampled__no_means" none subsampled few +A0.3 --subsample 2
draft() {
    "$bin/povgloss" render "$scene" "${options[@]}" +A0.3 --quality draft --keep draft -o draft.png && one_ray draft point
}
check "render__draft__no_means" draft
printf 'fog { distance 50 rgb 0.5 }\n#include "%s"\n' "$scene" > fog.pov
fog() {
    local switch
    for switch in +A0.3 -A; do
        "$bin/povgloss" passes fog.pov "${options[@]}" $switch --keep fog$switch -o fog.exr || return 1
    done
    one_ray fog+A0.3 fog-A
}
check "passes__fog__no_means" fog
end_of_tests
