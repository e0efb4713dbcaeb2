#!/usr/bin/env bash
# With an infinite exponent every sample scene is POV-Ray's own picture: RMSE at most 0.002 in linear light and 99.9 % of the
# pixels within 0.01 (colours travel as half floats). With the scene's exponents it is not: the reflection is blurred.
. tests/e2e/lib.sh

size=(+W320 +H240 -A)

render_both() {
    local name=$1
    (cd povscenes && povray "+I$name.pov" "+O$scratch/$name-povray.exr" +FE "${size[@]}" -D) > "$scratch/log" 2>&1 ||
        { tail -5 "$scratch/log"; return 1; }
    "$bin/povgloss" passes "povscenes/$name.pov" "${size[@]}" --quiet -o "$scratch/$name.exr" &&
        "$bin/glossfilter" "$scratch/$name.exr" --phong inf -o "$scratch/$name-mirror.exr" &&
        "$bin/glossfilter" "$scratch/$name.exr" -o "$scratch/$name-glossy.exr"
}

is_blurred() {
    awk -v rmse="$(rmse "$1" "$2")" 'BEGIN { print "RMSE", rmse; exit !(rmse > 0.004) }'
}

for scene in povscenes/*.pov; do
    name=$(basename "$scene" .pov)
    check "render__${name}__works" render_both "$name"
    check "render__${name}_at_infinite_exponent__is_povrays_picture" \
        same_picture "$scratch/$name-povray.exr" "$scratch/$name-mirror.exr"
    check "render__${name}_at_its_exponents__is_blurred" is_blurred "$scratch/$name-mirror.exr" "$scratch/$name-glossy.exr"
done
end_of_tests
