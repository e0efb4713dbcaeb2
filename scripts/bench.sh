#!/usr/bin/env bash
# The fast filter against the exact one: a table for docs/performance.md. Fails where an error is above what is stated.
# Times are medians in seconds of filter_glossy() alone, variants in turn; errors are of the blurred reflection, linear.
# usage: scripts/bench.sh [SCENE.pov ...]
# BIN: folder of the programs; TOOLS: of bench_filter; OUT: scratch folder, kept; PHONG: exponents; SIZE: POV-Ray's
# switches; RUNS: an odd number; THREADS: 0 for all processors
set -eu
bin=${BIN:-build/bin} tools=${TOOLS:-build/tests/tools} out=${OUT:-build/bench}
read -ra exponents <<< "${PHONG:-30 300 3000 30000}"
read -ra size <<< "${SIZE:-+W320 +H180}"
[ $# -gt 0 ] || set -- povscenes/{contact,interior,spheres}.pov
mkdir -p "$out"
status=0
echo '| variant | s | exact / it | RMSE | 99.9 % | largest |'
echo '|---|---|---|---|---|---|'
for path; do
    passes=$out/$(basename "$path" .pov)${size[0]#+}.exr
    [ -e "$passes" ] || "$bin/povgloss" passes "$path" "${size[@]}" --quiet -o "$passes"
    for p in "${exponents[@]}"; do
        name="$(basename "$path" .pov) $p"
        "$tools/bench_filter" "$passes" "$p" "${THREADS:-0}" "${RUNS:-5}" "$name exact=0" "$name fine=0.002:0.002" \
            "$name fast=0.006:0.004" || { echo "bench: $name: the error is above what is stated" >&2; status=1; }
    done
done
exit $status
