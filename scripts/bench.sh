#!/usr/bin/env bash
# Times of the filter, for docs/performance.md: one weight of the exact sums, qualities, instruction sets, threads, and
# the paper's filter with its optimisations.
# Fails where an error is above what is stated. Times are medians in seconds of filter_glossy() alone, variants in turn;
# errors are of the blurred reflection, linear, against the first variant of each table.
# usage: scripts/bench.sh [SCENE.pov ...]
# BIN: folder of the programs; TOOLS: of bench_filter and bench_weights; OUT: scratch folder, kept; PHONG: exponents; SIZE: POV-Ray's
# switches; RUNS: an odd number
set -eu
bin=${BIN:-build/bin} tools=${TOOLS:-build/tests/tools} out=${OUT:-build/bench}
read -ra exponents <<< "${PHONG:-30 300 3000 30000}"
read -ra size <<< "${SIZE:-+W320 +H180}"
[ $# -gt 0 ] || set -- povscenes/{contact,interior,spheres}.pov
mkdir -p "$out"
status=0

# table PASSES.exr "LIMIT OPTIONS" ...: limits are of the RMSE.
table() {
    echo "| ${size[*]} $(basename "$path" .pov) | s | first / it | RMSE | 99.9 % | largest |"
    echo '|---|---|---|---|---|---|'
    "$tools/bench_filter" "$1" "${RUNS:-5}" "${@:2}" || { echo "bench: an error is above what is stated" >&2; status=1; }
    echo
}

"$tools/bench_weights" "${RUNS:-5}"
echo
for path; do
    passes=$out/$(basename "$path" .pov)${size[0]#+}.exr
    [ -e "$passes" ] || "$bin/povgloss" passes "$path" "${size[@]}" --quiet -o "$passes"
    for p in "${exponents[@]}"; do
        exact="--phong $p --quality exact"
        table "$passes" "0 $exact" "0.002 --phong $p --quality high" "0.004 --phong $p" "0.005 --phong $p --quality draft"
        table "$passes" "0 $exact" "0 $exact --threads 1" "0 $exact --isa avx2" "0 $exact --isa sse2"
        table "$passes" "0 --phong $p" "0 --phong $p --threads 1" "0 --phong $p --isa avx2" "0 --phong $p --isa sse2"
        table "$passes" "0 --phong $p --mode paper" "0.001 --phong $p --mode paper --weights table" \
            "0.1 --phong $p --mode paper --radius-step 4" "inf --phong $p"
    done
done
exit $status
