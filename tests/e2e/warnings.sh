#!/usr/bin/env bash
# What the picture of a glossy scene lacks is said, in one line, and nothing is said of a scene without it.
. tests/e2e/lib.sh

cd "$scratch" || exit 1

# draw SETTINGS CAMERA FINISH [OBJECTS]: a scene of a glossy floor with these; leaves the warnings in $warnings.
draw() {
    printf '%s\n' '#version 3.7;' '#include "povgloss.inc"' "global_settings { assumed_gamma 1.0 $1 }" \
        "camera { location <0, 2, -6> look_at 0 $2 }" 'light_source { <-5, 8, -6> rgb 1 }' \
        "plane { y, 0 pigment { rgb 0.3 } finish { $3 } }" "${4:-}" > scene.pov
    run "$bin/povgloss" passes scene.pov "+L$root/povscenes" +W16 +H12 -A -o passes.exr
    warnings=$(grep '^povgloss: warning' err)
    expect_status 0
}

# says TEXT SETTINGS CAMERA FINISH [OBJECTS]: "N: text" is about line N.
says() {
    draw "${@:2}" || return 1
    [[ $warnings == "povgloss: warning: scene.pov:$1" ]] || { echo "not said: $1"; show_run; return 1; }
}

says_nothing() {
    draw "$@" || return 1
    [ -z "$warnings" ] || { show_run; return 1; }
}

glossy='reflection 0.5 Gloss(50)'
check "nothing" says_nothing '' '' "$glossy"
check "exponent in a reflection" says '6: the exponent of a glossy reflection counts as 1' \
    '' '' 'reflection { 0.5 exponent 2 } Gloss(50)'
check "exponent 1" says_nothing '' '' 'reflection { 0.5 exponent 1 } Gloss(50)'
check "reflection_exponent" says '6: the reflection_exponent of a glossy finish counts as 1' '' '' "reflection_exponent 2 $glossy"
check "irid" says "6: irid in a glossy finish doesn't tint its reflection" '' '' "irid { 0.3 thickness 0.5 } $glossy"
check "irid in a finish that reflects nothing" says_nothing '' '' "$glossy" \
    'sphere { y, 1 pigment { rgb 1 } finish { irid { 0.3 } } }'
check "photons that are saved" says "3: photons that the scene saves aren't reflected by glossy surfaces" \
    'photons { count 100 save_file "mine.ph" }' '' "$glossy"
check "photons" says_nothing 'photons { count 100 }' '' "$glossy" 'sphere { y, 1 pigment { rgb 1 } photons { target } }'
lit='mm_per_unit 40 subsurface { samples 9, 9 }'
check "subsurface light without plain mirrors" says_nothing "$lit" '' "$glossy"
check "subsurface light and a plain mirror" says \
    '3: with subsurface light, glossy surfaces that are seen in a mirror reflect nothing there' "$lit" '' "$glossy" \
    'sphere { y, 1 pigment { rgb 1 } finish { reflection 0.2 } }'
check "media in an object" says \
    "7: media in an object that the camera is outside of neither dim nor tint the reflection of a glossy surface in or \
behind it" '' '' "$glossy" \
    'sphere { y, 1 hollow pigment { rgbt 1 } interior { media { emission 0.1 } } }'
glass='pigment { rgbt 0.9 } finish { reflection 0.1 }'
shows="7: a glossy surface reflects nothing where it is seen by a reflection in this object and then through something \
transparent"
mixed="7: this object holds something transparent and something glossy: reflections inside the transparent part are left out; \
make them objects of their own; scene.pov:$shows"
gold="box { 0, 2 pigment { rgb 1 } finish { $glossy } }"
check "glass and gloss in one object" says "$mixed" '' '' "$glossy" "difference { sphere { y, 1 $glass } $gold }"
check "glass and gloss in a union with bounds" says "$mixed" '' '' "$glossy" \
    "union { sphere { y, 1 $glass } $gold bounded_by { box { -3, 3 } } }"
check "glass and gloss in a declared union that is given a texture" says "$mixed" '' '' "$glossy" \
    "#declare U = union { sphere { y, 1 $glass } $gold } object { U pigment { rgb x } }"
check "glass and gloss in one union" says "$shows" '' '' "$glossy" "union { sphere { y, 1 $glass } $gold }"
check "glass that mirrors nothing" says_nothing '' '' "$glossy" \
    'sphere { y, 1 pigment { rgbt 0.9 } } box { 0, 2 pigment { rgb 1 } finish { reflection 0.1 } }'
check "two of them" says "6: the exponent of a glossy reflection counts as 1; scene.pov:6: irid in a glossy finish doesn't tint \
its reflection" '' '' 'reflection { 0.5 exponent 2 } irid { 0.3 } Gloss(50)'
end_of_tests
