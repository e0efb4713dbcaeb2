#!/usr/bin/env bash
# povgloss.inc: plain povray draws as if its macros were not there; wrong arguments are told; the roughness has one mapping,
# in the include as in the C code.
. tests/e2e/lib.sh

# draw SCENE IMAGE: plain povray, one thread, so that two renders are the same to the bit.
draw() {
    (cd povscenes && povray "+I$1" "+O$2" +FE +W160 +H120 -A +WT1 -D) > "$scratch/log" 2>&1 || { tail -5 "$scratch/log"; return 1; }
}

draws_the_same() {
    sed -e 's/Gloss\(_Roughness\)\?([^()]*)//' -e '/#include "povgloss.inc"/d' "povscenes/$1.pov" > "$scratch/without.pov"
    ! grep -q 'Gloss(\|Gloss_Roughness(' <(sed 's,//.*,,' "$scratch/without.pov") || fail "still glossy" || return 1
    draw "$1.pov" "$scratch/with.exr" && draw "$scratch/without.pov" "$scratch/without.exr" &&
        oiiotool -a --fail 0 --diff "$scratch/with.exr" "$scratch/without.exr"
}

# scene GLOSS: a glossy ball; further lines come first.
scene() {
    cat <<POV
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
$2
camera { location <0, 1, -4> look_at 0 }
light_source { <-3, 5, -4>, 1 }
sphere { 0, 1 pigment { rgb 0.3 } finish { reflection 0.5 $1 } }
POV
}

# phong_is SCENE LOW HIGH: every glossy pixel's exponent lies between.
phong_is() {
    "$bin/povgloss" passes "$1" +Lpovscenes +W40 +H30 --quiet -o "$scratch/phong.exr" || return 1
    oiiotool "$scratch/phong.exr" --ch phong.V --printstats |
        awk -v low="$2" -v high="$3" '/Stats Max/ { print; found = 1; bad = $3 < low || $3 > high } END { exit !found || bad }'
}

is_refused() {
    run povray "+I$1" +Lpovscenes "+O$scratch/refused.png" +W8 +H6 -D
    if [ "$status" -eq 0 ] || ! grep -q "$2" "$scratch/err"; then
        show_run
        return 1
    fi
}

for name in contact spheres metal two_exponents; do
    check "plain_povray__${name}__as_if_the_macros_were_not_there" draws_the_same "$name"
done

# (1/0.3^4 - 1)/2 = 61.228395; the first is read from the scene's text, the second coded in the exponent pass.
scene 'Gloss_Roughness(0.3)' '' > "$scratch/literal.pov"
scene 'Gloss_Roughness(R)' '#declare R = 0.3;' > "$scratch/computed.pov"
check 'Gloss_Roughness__literal__maps_as_documented' phong_is "$scratch/literal.pov" 61.2283 61.2285
check 'Gloss_Roughness__computed__maps_as_documented' phong_is "$scratch/computed.pov" 61.2283 61.2285
scene 'Gloss(P*10)' '#declare P = 12345.6;' > "$scratch/computed.pov"
check 'Gloss__computed__exact_to_7_digits' phong_is "$scratch/computed.pov" 123455.98 123456.02

scene 'Gloss(-1)' '' > "$scratch/negative.pov"
check 'Gloss__negative__told' is_refused "$scratch/negative.pov" 'Phong exponent is 0 or more'
scene 'Gloss_Roughness(1.5)' '' > "$scratch/rough.pov"
check 'Gloss_Roughness__above_1__told' is_refused "$scratch/rough.pov" 'from 0 (mirror) to 1'
end_of_tests
