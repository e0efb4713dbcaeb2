#!/usr/bin/env bash
# The filters against the truth (`povgloss probe`), with and without each part of the best one: a table for README.md.
# RMSE of the blurred reflection at the probes, linear light; time of glossfilter, median of five, files included.
# usage: scripts/accuracy.sh [SCENE.pov ...]
# BIN: folder of the programs; OUT: scratch folder, kept; PHONG: exponents; SIZE: POV-Ray's switches; GRID: of the
# probes; MARGIN: of the passes
set -eu
bin=${BIN:-build/bin} out=${OUT:-build/accuracy} grid=${GRID:-16}
read -ra exponents <<< "${PHONG:-30 100 300 1000}"
read -ra size <<< "${SIZE:-+W320 +H240}"
[ $# -gt 0 ] || set -- povscenes/*.pov
mkdir -p "$out"

settings=('no blur|--phong inf' 'paper|--mode paper' 'best|' 'best without density|--without density'
    'best without visibility|--without visibility' 'best without pool|--without pool' 'best without fit|--without fit')

filter() { # SCENE SETTING P
    local options=()
    read -ra options <<< "${2#*|}"
    [ "${options[1]:-}" = inf ] || options+=(--phong "$3")
    "$bin/glossfilter" "$out/$1.exr" "${options[@]}" --layers -o "$out/filtered.exr"
}

milliseconds() { # SCENE SETTING P: median of five
    local i start
    for i in 1 2 3 4 5; do
        start=$(date +%s%N)
        filter "$@"
        echo $((($(date +%s%N) - start) / 1000000))
    done | sort -n | sed -n 3p
}

printf '| scene, p |'; printf ' %s |' "${settings[@]%|*}" 'time paper, ms' 'time best, ms'; echo
printf '|---|'; printf -- '---|%.0s' "${settings[@]}" 1 2; echo
for path; do
    scene=$(basename "$path" .pov)
    [ -e "$out/$scene.exr" ] || "$bin/povgloss" passes "$path" "${size[@]}" --margin "${MARGIN:-0}" --quiet \
        -o "$out/$scene.exr"
    [ -e "$out/$scene.csv" ] || "$bin/povgloss" probe "$path" "${size[@]}" --grid "$grid" \
        "${exponents[@]/#/--phong=}" --quiet -o "$out/$scene.csv"
    for p in "${exponents[@]}"; do
        printf '| %s %s |' "$scene" "$p"
        for setting in "${settings[@]}"; do
            filter "$scene" "$setting" "$p"
            printf ' %.4f |' "$("$bin/povgloss" compare "$out/$scene.csv" "$out/filtered.exr" --phong "$p" |
                sed -n 's/^rmse[^0-9]*//p')"
        done
        for setting in "${settings[1]}" "${settings[2]}"; do
            printf ' %s |' "$(milliseconds "$scene" "$setting" "$p")"
        done
        echo
    done
done
