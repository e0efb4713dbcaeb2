#!/usr/bin/env bash
# Subsampling: L0, a and b traced at fewer pixels and interpolated. The picture is nearly that of all pixels (RMSE in linear
# light), the more pixels the nearer, and what isn't glossy is the same to the bit.
. tests/e2e/lib.sh

render() {
    "$bin/povgloss" passes povscenes/contact.pov +W320 +H240 +A0.3 --subsample "$1" --quiet -o "$scratch/passes$1.exr" &&
        "$bin/glossfilter" "$scratch/passes$1.exr" --radius-step 1 -o "$scratch/image$1.exr"
}

is_near() {
    local two four
    two=$(rmse "$scratch/image1.exr" "$scratch/image2.exr")
    four=$(rmse "$scratch/image1.exr" "$scratch/image4.exr")
    echo "RMSE $two at every second pixel, $four at every fourth"
    awk -v two="$two" -v four="$four" 'BEGIN { exit !(two > 0 && two < 0.012 && four > two && four < 0.02) }'
}

same_base() {
    local channels
    for channels in R,G,B reflectance.R,reflectance.G,reflectance.B; do
        oiiotool -a "$scratch/passes1.exr" --ch "$channels" -o "$scratch/one.exr" "$scratch/passes4.exr" --ch "$channels" \
            -o "$scratch/four.exr" && oiiotool -a --fail 0 --diff "$scratch/one.exr" "$scratch/four.exr" || return 1
    done
}

for step in 1 2 4; do
    check "passes__subsample_${step}__written" render "$step"
done
check 'render__subsampled__near_the_full_picture' is_near
check 'passes__subsampled__same_base_and_reflectance' same_base
end_of_tests
