#!/usr/bin/env bash
# The whole command's time against POV-Ray's own for the mirror picture, of the same size and antialiasing.
#
# RUNS (5) rounds, in each of which every scene is drawn by both, one after the other; medians. SIZE (+W640 +H480 +A0.3),
# SCENES (below; without povgloss.inc all that reflects is glossy), OPTIONS of povgloss render. Prints a table in Markdown.
set -eu
export LC_ALL=C.UTF-8
root=$PWD
bin=$(realpath "${BIN:-build/bin}")
read -ra size <<< "${SIZE:-+W640 +H480 +A0.3}"
read -ra options <<< "${OPTIONS:---no-check --quiet}"
examples=$(dpkg -L povray-examples | grep -m1 '/examples$')
own=("$root"/povscenes/{contact,interior,spheres,metal}.pov)
others=("$examples"/advanced/{teapot/teapot,biscuit,object_pattern}.pov)
read -ra scenes <<< "${SCENES:-${own[*]} ${others[*]}}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
TIMEFORMAT='%R %U %S'

# timed NAME COMMAND...: adds wall, user and system seconds to the file NAME.
timed() {
    local name=$1
    shift
    { time "$@" > /dev/null 2> "$scratch/log" || { cat "$scratch/log" >&2; exit 1; }; } 2>> "$scratch/$name"
}
# median NAME VALUE
median() {
    awk "{ print $2 }" "$scratch/$1" | sort -g | awk '{ value[NR] = $1 } END { print value[int((NR + 1) / 2)] }'
}

echo '| scene | POV-Ray: wall, s | CPU, s | povgloss render: wall, s | CPU, s | ratio of wall | of CPU |'
echo '|---|---|---|---|---|---|---|'
for scene in "${scenes[@]}"; do
    name=$(basename "$scene" .pov)
    gloss=()
    grep -q povgloss.inc "$scene" || gloss=(--gloss all=300)
    cd "$(dirname "$scene")"
    for ((run = 0; run < ${RUNS:-5}; run++)); do
        timed "$name.povray" povray "$name.pov" "+L$root/povscenes" "${size[@]}" -D +FE "+O$scratch/plain.exr"
        timed "$name.povgloss" "$bin/povgloss" render "$name.pov" "+L$root/povscenes" "${size[@]}" "${gloss[@]}" \
            "${options[@]}" -o "$scratch/glossy.exr"
    done
    # shellcheck disable=SC2016 # awk's fields
    echo "$name $(median "$name.povray" '$1') $(median "$name.povray" '$2 + $3')" \
        "$(median "$name.povgloss" '$1') $(median "$name.povgloss" '$2 + $3')"
done | awk '{ printf "| %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", $1, $2, $3, $4, $5, $4 / $2, $5 / $3; fflush() }'
