#!/usr/bin/env bash
# Time and memory of glossfilter against pixels, exponent and threads: docs/growth.csv, docs/growth.png, and the powers
# of the number of pixels that fit.
#
# Passes are POV-Ray's own, 16:9, of MEGAPIXELS (0.1 to 64) and SCENES (contact, interior); the EXPONENTS and threads
# are tried at 1 megapixel. Processor time (so other work on the machine counts for little) and wall time of the step
# "filter" of --timings, medians of RUNS (3; one where it takes more than 30 s); the largest resident memory of the
# program. A size is the last one once its filter takes more than LIMIT (600) seconds, or where there is no memory for
# the next. BIN: folder of the programs; OUT: scratch folder, kept: passes that are there are not drawn again; CSV, PNG:
# the results. Needs gnuplot and GNU time.
set -eu
export LC_ALL=C.UTF-8
bin=${BIN:-build/bin} out=${OUT:-build/growth} csv=${CSV:-docs/growth.csv} png=${PNG:-docs/growth.png}
read -ra scenes <<< "${SCENES:-contact interior}"
read -ra sizes <<< "${MEGAPIXELS:-0.1 0.25 0.5 1 2 4 8 16 32 64}"
read -ra exponents <<< "${EXPONENTS:-1 10 100 1000 10000 100000}"
middle=1 phong=300
mkdir -p "$out"

# passes SCENE MEGAPIXELS: their file's name in $passes; false where there is no memory for so many pixels.
passes() {
    local width height bytes=300 # of a pixel
    passes=$out/$1-$2.exr
    awk -v need="$2e6" -v bytes=$bytes '/^MemAvailable/ { exit !($2 * 1024 > need * bytes) }' /proc/meminfo || return
    [ ! -e "$passes" ] || return 0
    width=$(awk -v pixels="$2e6" 'BEGIN { print int(sqrt(pixels * 16 / 9) + 0.5) }')
    height=$(awk -v pixels="$2e6" -v width="$width" 'BEGIN { print int(pixels / width + 0.5) }')
    "$bin/povgloss" passes "povscenes/$1.pov" "+W$width" "+H$height" --no-check --quiet -o "$passes"
}

# measure SERIES SCENE MEGAPIXELS PHONG THREADS: one line of the table.
measure() {
    local lines=() line
    while [ ${#lines[@]} -lt "${RUNS:-3}" ]; do
        line=$(/usr/bin/time -f 'memory %M' "$bin/glossfilter" "$passes" --phong "$4" --threads "$5" --quiet --timings \
            -o "$out/filtered.exr" 2>&1 |
            awk '$1 == "filter" { times = $4 "," $3 } $1 == "memory" { print times "," $2 / 1024 }')
        lines+=("$line")
        awk -v seconds="${line%%,*}" 'BEGIN { exit !(seconds > 30) }' && break
    done
    line=$(printf '%s\n' "${lines[@]}" | sort -g | awk '{ line[NR] = $0 } END { print line[int((NR + 1) / 2)] }')
    echo "$1,$2,$3,$4,$5,$line" | tee -a "$csv"
}

echo 'series,scene,megapixels,phong,threads,cpu_s,wall_s,memory_mb' | tee "$csv"
for scene in "${scenes[@]}"; do
    for size in "${sizes[@]}"; do
        passes "$scene" "$size" || { echo "growth: no memory for $size megapixels" >&2; break; }
        measure pixels "$scene" "$size" $phong 1
        awk -F, -v limit="${LIMIT:-600}" 'END { exit $6 > limit }' "$csv" || break
    done
    passes "$scene" $middle
    for p in "${exponents[@]}"; do
        measure exponent "$scene" $middle "$p" 1
    done
    for threads in 1 2; do
        measure threads "$scene" $middle $phong $threads
    done
done

# slope SCENE COLUMN FIRST: of a straight line through the logarithms, by least squares, from FIRST megapixels on.
slope() {
    awk -F, -v scene="$1" -v column="$2" -v first="$3" '$1 == "pixels" && $2 == scene && $3 >= first {
        x = log($3); y = log($column); n++; sx += x; sy += y; sxx += x * x; sxy += x * y
    } END { if (n > 1) printf "%.2f", (n * sxy - sx * sy) / (n * sxx - sx * sx) }' "$csv"
}
titles=
for scene in "${scenes[@]}"; do
    time=$(slope "$scene" 6 0) memory=$(slope "$scene" 8 0)
    echo "$scene: processor time ~ pixels^$time, from 1 megapixel on ^$(slope "$scene" 6 1); memory ~ pixels^$memory"
    titles+="time_$scene = '$scene, pixels^{$time}'; memory_$scene = '$scene, pixels^{$memory}'; "
done
gnuplot << END
set terminal pngcairo size 1320,400 font 'sans,10'
set output '$png'
set datafile separator ','
set style data linespoints
set grid
set key bottom right
set multiplot layout 1,3
$titles
rows(series, scene, column) = sprintf("< grep '^%s,%s,' '$csv' | cut -d, -f%s", series, scene, column)
set logscale xy
set xlabel 'megapixels, p = $phong'
set ylabel 'filter: processor time, s'
plot for [scene in '${scenes[*]}'] rows('pixels', scene, '3,6') title value('time_' . scene)
set ylabel 'glossfilter: memory, MB'
plot for [scene in '${scenes[*]}'] rows('pixels', scene, '3,8') title value('memory_' . scene)
set xlabel 'Phong exponent, $middle megapixel'
set ylabel 'filter: processor time, s'
set yrange [0:*]
set key top right
unset logscale y
plot for [scene in '${scenes[*]}'] rows('exponent', scene, '4,6') title scene
END
