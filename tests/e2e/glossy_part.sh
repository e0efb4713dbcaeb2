#!/usr/bin/env bash
# Passes that are of use where something glossy is are rendered there alone; what comes of it is the same to the bit.
# A part of the picture (+SR1) is rendered as it is asked for: there all passes are whole.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
cat > small.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <0, 1, -6> look_at <0, 1, 0> }
light_source { <-5, 8, -6> rgb 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb <0.2, 0.3, 0.8>] } } }
plane { y, 0 pigment { checker rgb 0.2 rgb 0.9 } }
sphere { <SHIFT, 0.7, 0>, 0.7 pigment { rgb 0.1 } finish { reflection 0.8 Gloss(50) } }
sphere { <-0.6, 1, -1>, 0.5 pigment { rgb <1, 0, 0> } }
POV

# draw NAME SHIFT OPTION...
draw() {
    local name=$1 shift=$2
    sed "s/SHIFT/$shift/" small.pov > scene.pov
    shift 2
    rm -rf "$name.keep"
    "$bin/povgloss" passes scene.pov "+L$root/povscenes" +W160 +H120 "$@" --quiet --keep "$name.keep" -o "$name.exr"
}
# is_part NAME PASS LEAST MOST: how many of a hundred pixels the pass's image has in the smallest rectangle around what isn't
# black.
is_part() {
    oiiotool "$1.keep/$2/image".* --trim --printinfo | head -1 |
        awk -v least="$3" -v most="$4" '{ part = 100 * $1 * $3 / (160 * 120); exit !(part >= least && part <= most) }' ||
        fail "$2: $(oiiotool "$1.keep/$2/image".* --trim --printinfo | head -1)"
}
same() {
    draw part "$@" && draw whole "$@" +SR1 && oiiotool -a --fail 0 --diff part.exr whole.exr
}
check "antialiased__of_part_and_whole__the_same" same 0.4 +A0.3
parts() {
    local pass
    for pass in position position-low; do
        is_part part $pass 5 30 && is_part whole $pass 60 100 || return 1
    done
    is_part part base 90 100
}
check "passes__small_glossy_sphere__its_rectangle" parts
# Where all exponents are one, the endpoints tell where something is glossy, unless a total reflection may be in sight.
exponents() {
    draw part 0.4 -A && [ ! -e part.keep/exponent ] && is_part part endpoint 3 30 || return 1
    sed 's/rgb 0.1 }/rgbt <0.1, 0.1, 0.1, 0.5> } interior { ior 1.5 }/' scene.pov > clear.pov
    "$bin/povgloss" passes clear.pov "+L$root/povscenes" +W160 +H120 -A --quiet --keep clear.keep -o clear.exr &&
        is_part clear exponent 3 30
}
check "exponents__one_for_all__no_pass" exponents
check "subsampled__of_part_and_whole__the_same" same 0.4 +A0.3 --subsample 4
check "at_the_border__of_part_and_whole__the_same" same -3.5 -A
nothing() {
    draw part -50 -A && is_part part base 90 100
}
check "nothing_glossy_in_sight__the_base" nothing
frame() {
    local frames=(-A +KFF2 +SF2 +EF2)
    draw part 'clock - 3' "${frames[@]}" && draw whole 'clock - 3' "${frames[@]}" +SR1 &&
        oiiotool -a --fail 0 --diff part2.exr whole2.exr
}
check "frame__of_part_and_whole__the_same" frame
end_of_tests
