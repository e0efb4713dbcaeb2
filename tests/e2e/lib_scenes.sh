# Shared by the tests of scenes: each is drawn by POV-Ray itself and by the passes. With mirrors in place of the lobes the
# recombined passes are POV-Ray's own picture; with a wide lobe they are not, or else nothing was taken for glossy.
# Sourced from the project's root.
# shellcheck shell=bash disable=SC2154 # lib.sh assigns them
. tests/e2e/lib.sh

size=(+W120 +H90 -A -D)
at_once=4
gloss=() # options for povgloss, for the scenes that follow
names=()
folder=$scratch/scenes
mkdir "$folder"

# What there is to be mirrored. A scene may declare Own_Camera.
cat > "$folder/stage.inc" << 'POV'
#include "povgloss.inc"
#ifndef (Own_Camera)
  camera { location <0.3, 2.2, -6> right x*4/3 angle 48 look_at <0, 0.8, 0> }
#end
light_source { <-6, 9, -7> rgb 0.9 }
sky_sphere {
  pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [0.4 rgb <0.2, 0.35, 0.8>] } }
}
plane {
  z, 3 inverse
  pigment { checker rgb <0.9, 0.2, 0.1> rgb <0.9, 0.85, 0.7> }
  finish { ambient 0.2 diffuse 0.7 }
}
cylinder { <-1.4, 0, 1.6>, <-1.4, 2, 1.6>, 0.15 pigment { rgb <0.1, 0.7, 0.3> } finish { diffuse 0.8 phong 0.5 } }
sphere { <1.9, 0.5, 1.5>, 0.5 pigment { rgb <0.1, 0.2, 0.9> } }
#declare Floor = box { <-4, -0.1, -3>, <4, 0, 3> }
#declare Ball = sphere { <0, 0.9, -0.2>, 0.9 }
POV

# The reasons for a failure, or nothing. Each works in a folder of its own, since a scene may write files and look for them.
judge() {
    local file=$1 rmse
    mkdir "$file-truth" "$file-passes" && cd "$file-truth" || return
    povray "$file.pov" "+L$folder" "+L$root/povscenes" "${size[@]}" +FE "+O$file-truth.exr" > "$file.log" 2>&1 ||
        { sed -n '/rror/,$p' "$file.log"; fail "povray itself fails"; return; }
    cd "$file-passes" || return
    "$bin/povgloss" passes "$file.pov" "+L$root/povscenes" "${size[@]}" "${gloss[@]}" --quiet \
        -o "$file-passes.exr" 2>&1 || return
    "$bin/glossfilter" "$file-passes.exr" --phong inf -o "$file-mirror.exr" 2>&1 || return
    "$bin/glossfilter" "$file-passes.exr" --phong 20 -o "$file-glossy.exr" 2>&1 || return
    idiff -fail 0.01 -failpercent 0.1 -warn 0.01 -warnpercent 0.1 "$file-truth.exr" "$file-mirror.exr" > "$file.diff" ||
        { echo "mirrors aren't povray's:"; cat "$file.diff"; }
    rmse=$(sed -n 's/ *RMS error = //p' "$file.diff")
    awk "BEGIN { exit !(\"$rmse\" != \"\" && ${rmse:-1} > 0.002) }" && echo "mirrors aren't povray's: RMSE $rmse"
    idiff -fail 0.02 -failpercent 2 "$file-mirror.exr" "$file-glossy.exr" > "$file.blur" &&
        { echo "nothing is blurred:"; cat "$file.blur"; }
}

# whole_scene NAME: the scene is on standard input.
whole_scene() {
    local file=$folder/scene${#names[@]}
    cat > "$file.pov"
    while [ "$(jobs -rp | wc -l)" -ge "$at_once" ]; do wait -n; done
    judge "$file" > "$file.reasons" &
    names+=("$1")
}

# scene NAME: the same, with the usual beginning.
scene() {
    whole_scene "$1" < <(
        printf '#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#include "stage.inc"\n'
        cat
    )
}

verdict() {
    [ -e "$1.blur" ] && [ ! -s "$1.reasons" ] && return
    cat "$1.reasons"
    printf 'the scene:\n'
    cat "$1.pov"
    return 1
}

# The results of all scenes.
end_of_scenes() {
    local index
    wait
    for index in "${!names[@]}"; do
        check "${names[index]}" verdict "$folder/scene$index"
    done
    end_of_tests
}
