#!/usr/bin/env bash
# +A: L0 is the mean over a pixel, but at the borders of glossy surfaces. The mirror is then as smooth as POV-Ray's own, and
# the blur nearer to the truth.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
scene=$root/povscenes/spheres.pov
options=("+L$root/povscenes" +W160 +H120 --quiet)

# passes NAME OPTION...
passes() {
    "$bin/povgloss" passes "$scene" "${options[@]}" "${@:2}" -o "$1.exr"
}
check "passes__antialiased__work" passes mean +A0.3 --keep kept
check "passes__no_means__work" passes point +A0.3 --no-means

# Differences of L0, and what of the picture is glossy with all pixels about it.
inside() {
    oiiotool mean.exr --ch specular.R,specular.G,specular.B point.exr --ch specular.R,specular.G,specular.B --absdiff \
        -o differences.exr || return 1
    oiiotool mean.exr --ch phong.V --mulc 1e6 --clamp:min=0:max=1 --erode 3x3 --ch 0,0,0 -o inside.exr
}
largest() {
    oiiotool "$@" --printstats | awk '/Stats Max/ { print $3 }'
}
of_surfaces() {
    inside || return 1
    local in out
    in=$(largest differences.exr inside.exr --mul)
    out=$(largest differences.exr inside.exr --mulc -1 --addc 1 --mul)
    echo "differs by up to $in inside, $out at the borders"
    awk -v inside="$in" -v outside="$out" 'BEGIN { exit !(inside > 0.1 && outside == 0) }'
}
check "passes__antialiased__L0_at_borders_is_that_of_one_ray" of_surfaces

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

kept() {
    [ -d "$1/specular" ] || fail "there is no specular pass" || return 1
    [ ! -e "$1/specular-mean" ] || fail "there is a specular-mean pass"
}
none() {
    passes other "${@:2}" --keep "$1" && kept "$1"
}
check "passes__antialiased__one_more" [ -d kept/specular-mean ]
check "passes__not_antialiased__no_means" none plain -A
check "passes__subsampled__no_means" none subsampled +A0.3 --subsample 2
draft() {
    "$bin/povgloss" render "$scene" "${options[@]}" +A0.3 --quality draft --keep draft -o draft.png && kept draft
}
check "render__draft__no_means" draft
printf 'fog { distance 50 rgb 0.5 }\n#include "%s"\n' "$scene" > fog.pov
fog() {
    "$bin/povgloss" passes fog.pov "${options[@]}" +A0.3 --keep fog -o fog.exr && kept fog
}
check "passes__fog__no_means" fog
end_of_tests
