#!/usr/bin/env bash
# Both filters against their oracles (the sums in double, all pixels by all pixels) on small passes files of real scenes: a
# flat floor with one exponent, curved mirrors, two exponents.
. tests/e2e/lib.sh

render() {
    "$bin/povgloss" passes "povscenes/$1.pov" +W80 +H60 --quiet -o "$scratch/$1.exr"
}

for name in contact spheres two_exponents; do
    check "passes__${name}__written" render "$name"
    for weights in 'exact 1e-5' 'table 1e-4' 'best 1e-4'; do
        # shellcheck disable=SC2086 # the weights and their tolerance
        check "filter__${name}_${weights% *}__within_${weights#* }_of_the_oracle" \
            "${TOOLS:-build/tests/tools}/compare_oracle" "$scratch/$name.exr" $weights
    done
done
end_of_tests
