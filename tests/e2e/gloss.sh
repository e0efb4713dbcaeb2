#!/usr/bin/env bash
# --gloss makes finishes glossy without an edit: its passes are those of the same scene with Gloss() written into it.
. tests/e2e/lib.sh

size=(+W120 +H90 -A)

# write NAME FINISH...: a scene of a floor, a chrome-like ball and a dull one; each FINISH replaces @0, @1, ... in it.
write() {
    local name=$1 text index=0
    shift
    text=$(cat "$scratch/stage")
    for finish; do
        text=${text//@$index/$finish}
        index=$((index + 1))
    done
    printf '%s\n' "$text" > "$scratch/$name.pov"
}
cat > "$scratch/stage" << 'POV'
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> right x*4/3 look_at <0, 0.7, 0> }
light_source { <-6, 9, -7> rgb 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [0.4 rgb <0.2, 0.35, 0.8>] } } }
#declare Polished = finish { diffuse 0.5 phong 0.6 phong_size 4*15 @0 }
#declare Mirror = finish { reflection 0.5 @1 }
#declare Metal = texture { pigment { rgb 0.2 } finish { specular 0.5 roughness 1/80 reflection { 0.3 metallic } @2 } }
#declare Coat = material { texture { Metal @3 } interior { ior 1.5 } }
plane { y, 0 pigment { checker rgb 0.2 rgb 0.8 } finish { Polished reflection 0.3 @4 } }
sphere { <-1.2, 1, 0>, 1 texture { Metal } }
sphere { <1.2, 1, 0>, 1 pigment { rgb 0.1 } finish { Mirror } }
sphere { <0, 0.5, -1.5>, 0.5 material { Coat } }
box { <-0.3, 0, 1.5>, <0.3, 2, 1.7> pigment { rgb x } finish { Polished } }
POV

# same_as_written OPTIONS FINISH...: the passes of the scene with OPTIONS are those with Gloss() in each FINISH.
same_as_written() {
    local options=$1
    shift
    write plain "" "" "" "" ""
    write edited "$@"
    # shellcheck disable=SC2086 # several options in one word
    "$bin/povgloss" passes "$scratch/plain.pov" +Lpovscenes "${size[@]}" $options --quiet -o "$scratch/plain.exr" &&
        "$bin/povgloss" passes "$scratch/edited.pov" +Lpovscenes "${size[@]}" --quiet -o "$scratch/edited.exr" &&
        idiff -a -fail 1e-6 -hardfail 1e-6 "$scratch/plain.exr" "$scratch/edited.exr"
}


check 'gloss__finish__as_written' same_as_written '--gloss Mirror=50' '' 'Gloss(50)' '' '' ''
check 'gloss__texture__as_written' same_as_written '--gloss Metal=50' '' '' 'Gloss(50)' '' ''
check 'gloss__material__as_written' same_as_written '--gloss Coat=50' '' '' '' 'finish { Gloss(50) }' ''
check 'gloss__two_names__as_written' same_as_written '--gloss Mirror=50 --gloss Metal=inf' \
    '' 'Gloss(50)' 'Gloss(1e30)' '' ''
check 'gloss__finish_without_a_reflection__hands_gloss_on' same_as_written '--gloss Polished=70' 'Gloss(70)' '' '' '' ''
check 'gloss_all__every_mirror__as_written' same_as_written '--gloss all=40' '' 'Gloss(40)' 'Gloss(40)' '' 'Gloss(40)'
check 'gloss_auto__highlights__as_written' same_as_written '--gloss auto' '' '' 'Gloss(20)' '' 'Gloss(60)'
check 'gloss_auto_and_all__highlights_first' same_as_written '--gloss all=40 --gloss auto' \
    '' 'Gloss(40)' 'Gloss(20)' '' 'Gloss(60)'
check 'gloss_auto_and_a_name__the_name_first' same_as_written '--gloss Metal=inf --gloss auto' \
    '' '' 'Gloss(1e30)' '' 'Gloss(60)'

# POV-Ray's picture of a light's highlight in (N.H)^(1/roughness) is that of phong_size 1/(4 roughness).
highlights_match() {
    for highlight in 'specular 1 roughness 1/400' 'phong 1 phong_size 100'; do
        printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 }' \
            'camera { location -9*z look_at 0 angle 20 } light_source { <3, 4, -9>*1e4 rgb 1 parallel point_at 0 }' \
            "sphere { 0, 1 pigment { rgb 0 } finish { ambient 0 diffuse 0 $highlight } }" > "$scratch/highlight.pov"
        povray "+I$scratch/highlight.pov" "+O$scratch/${highlight%% *}.exr" +FE "${size[@]}" -D > "$scratch/log" 2>&1 ||
            { tail -3 "$scratch/log"; return 1; }
    done
    oiiotool "$scratch/phong.exr" --printstats | grep -qE 'Stats Max: (0.9|1)' || fail "no highlight is seen" || return 1
    idiff -fail 0.03 -hardfail 0.03 "$scratch/specular.exr" "$scratch/phong.exr"
}
check 'gloss_auto__roughness__is_the_lobe_of_povrays_highlight' highlights_match

nothing_chosen_is_povrays_own() {
    printf '%s\n' 'camera { location -5*z } light_source { -9*z rgb 1 }' \
        'sphere { 0, 1 pigment { rgb x } finish { phong 1 } }' > "$scratch/dull.pov"
    povray "+I$scratch/dull.pov" "+O$scratch/dull.exr" +FE "${size[@]}" -D > "$scratch/log" 2>&1
    run "$bin/povgloss" render "$scratch/dull.pov" "${size[@]}" --gloss auto -o "$scratch/dull-glossy.exr"
    expect_status 0 && expect_message "no finish is glossy with this --gloss" &&
        idiff -fail 0 "$scratch/dull.exr" "$scratch/dull-glossy.exr"
}
check 'gloss_auto__nothing_to_find__povrays_picture_and_a_warning' nothing_chosen_is_povrays_own

refused() {
    local message=$1 expected=$2
    shift 2
    run "$bin/povgloss" render "$scratch/plain.pov" +Lpovscenes "${size[@]}" "$@" -o "$scratch/refused.exr"
    expect_status "$expected" && expect_message "$message" && expect_one_line povgloss &&
        expect_no_file "$scratch/refused.exr" && expect_nothing_left
}
check 'gloss__unknown_name__refused' refused 'declared by the name Bronze' 3 --gloss Bronze=40
check 'gloss__name_of_a_pigment__refused' refused 'declared by the name Stage' 3 --gloss Stage=40
for wrong in '' Mirror Mirror= =40 Mirror=-1 Mirror=nan Mirror=40x all all=; do
    check "gloss__${wrong:-nothing}__refused" refused 'must be auto, all=P or NAME=P' 2 "--gloss=$wrong"
done
end_of_tests
