#!/usr/bin/env bash
# --quality: high errs least against the exact sums, draft most.
. tests/e2e/lib.sh

render() {
    "$bin/glossfilter" "$scratch/passes.exr" --quality "$1" --quiet -o "$scratch/$1.exr"
}

errors_rise() {
    local high normal draft
    high=$(rmse "$scratch/exact.exr" "$scratch/high.exr")
    normal=$(rmse "$scratch/exact.exr" "$scratch/normal.exr")
    draft=$(rmse "$scratch/exact.exr" "$scratch/draft.exr")
    echo "RMSE $high, $normal, $draft"
    awk -v h="$high" -v n="$normal" -v d="$draft" 'BEGIN { exit !(h > 0 && h < n && n < d && h < 0.001 && n < 0.0015 && d < 0.002) }'
}

default_is_normal() {
    "$bin/glossfilter" "$scratch/passes.exr" --quiet -o "$scratch/default.exr" &&
        cmp "$scratch/default.exr" "$scratch/normal.exr"
}

small_is_exact() {
    "$bin/povgloss" passes povscenes/contact.pov +W120 +H90 --quiet -o "$scratch/small.exr" &&
        "$bin/glossfilter" "$scratch/small.exr" --quiet -o "$scratch/one.exr" &&
        "$bin/glossfilter" "$scratch/small.exr" --quality exact --quiet -o "$scratch/two.exr" &&
        cmp "$scratch/one.exr" "$scratch/two.exr"
}

# A tolerance that a quality stands for gives its picture; others are kept.
tolerance_is_high() {
    "$bin/glossfilter" "$scratch/passes.exr" --tolerance 0.001 --quiet -o "$scratch/tolerance.exr" &&
        cmp "$scratch/tolerance.exr" "$scratch/high.exr"
}

tolerance_is_kept() {
    local error
    "$bin/glossfilter" "$scratch/passes.exr" --tolerance "$1" --quiet -o "$scratch/tolerance.exr"
    error=$(rmse "$scratch/exact.exr" "$scratch/tolerance.exr")
    echo "RMSE $error"
    awk -v e="$error" -v limit="$1" 'BEGIN { exit !(e > 0 && e <= limit) }'
}

refused() {
    run "$bin/glossfilter" "$scratch/passes.exr" "$@" -o "$scratch/refused.exr"
    expect_status 2 && expect_message "$1" && expect_no_file "$scratch/refused.exr"
}

"$bin/povgloss" passes povscenes/contact.pov +W320 +H240 --quiet -o "$scratch/passes.exr"
for quality in exact high normal draft; do
    check "glossfilter__quality_${quality}__written" render "$quality"
done
check 'glossfilter__qualities__errors_rise_from_high_to_draft' errors_rise
check 'glossfilter__no_quality__is_normal' default_is_normal
check 'glossfilter__small_picture__is_exact' small_is_exact
check 'glossfilter__tolerance_of_high__is_high' tolerance_is_high
for tolerance in 0.0007 0.0012 0.0018; do
    check "glossfilter__tolerance_${tolerance}__kept" tolerance_is_kept "$tolerance"
done
check 'glossfilter__unknown_quality__refused' refused --quality best
check 'glossfilter__quality_of_paper__refused' refused --quality high --mode paper
check 'glossfilter__tolerance_of_paper__refused' refused --tolerance 0.001 --mode paper
check 'glossfilter__tolerance_out_of_range__refused' refused --tolerance 0.003
end_of_tests
