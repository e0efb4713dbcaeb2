#!/usr/bin/env bash
# Runs povgloss over a folder of POV-Ray scenes as they are, compares each picture with POV-Ray's own, writes a report.
#
# usage: scripts/corpus.sh [folder of scenes [WIDTHxHEIGHT]]
#
# Every scene is rendered with every reflecting finish glossy, and, where it shows such a finish, with --gloss auto. Where
# nothing in sight is glossy the base must be POV-Ray's picture to the bit (the last bit of a half float may differ where
# something out of sight is); else the picture with mirrors in place of
# the lobes must be POV-Ray's: RMSE at most 0.002 in linear light and 99.9 % of the pixels within 0.01. Where POV-Ray
# itself draws another picture when its threads take the pixels in another order (random samples), or when a camera with
# focal blur takes all its samples (POV-Ray stops where a few of them happen to be alike), twice that difference is
# allowed. Another picture is said where povgloss warned of something in it, and silent where it didn't; where it says
# that its passes don't add up though the picture is POV-Ray's, that is a false alarm. A scene with an .ini file of an
# animation is drawn with it, in its first frame.
#
# Variables: BIN, the folder of the programs; OUT, where everything is kept; JOBS, scenes at the same time; LIMIT,
# seconds for a picture; ONLY, a regular expression for the names of the scenes to run; REPORT, the report's file.
# POV-Ray's own pictures are kept, and verdicts that are newer than povgloss: an interrupted run goes on where it was.
set -u
export LC_ALL=C.UTF-8

scenes=$(realpath "${1:-/usr/share/doc/povray/examples}")
size=${2:-160x120}
bin=$(realpath "${BIN:-build/bin}")
jobs=${JOBS:-$(nproc)}
limit=${LIMIT:-150}
only=${ONLY:-.}
report=${REPORT:-}
modes=(all=300 auto)
# One thread: random samples are the same in every run.
switches=("+W${size%x*}" "+H${size#*x}" -A +WT1)

out=${OUT:-build/corpus}/$size
mkdir -p "$out"
out=$(realpath "$out")

# ---- one scene

# Leaves in $own what a scene that is an animation needs: its .ini file, and switches for the first frame.
find_own_switches() {
    own=()
    grep -qi '^final_frame' "${1%.pov}.ini" 2> /dev/null && own=("${1%.pov}.ini" +SF1 +EF1)
}

# draw FOLDER SCENE SWITCH...: POV-Ray's own picture, in a folder of its own since scenes write files.
draw() {
    local folder=$1 scene=$2 own
    shift 2
    find_own_switches "$scene"
    mkdir -p "$folder"
    (cd "$folder" && timeout -k 5 "$limit" povray "${own[@]}" "+I$scene" "+L$(dirname "$scene")" "${switches[@]}" \
        -D -P -C -UA +FE +Opart.exr "$@" && mv part*.exr image.exr) > "$folder/log" 2>&1
    echo $? > "$folder/status"
}

# difference IMAGE IMAGE: RMSE, largest difference, percentage of pixels that differ by more than 0.01, and the place of
# the largest.
difference() {
    oiiotool -a --fail 0.01 "$1" --ch R,G,B "$2" --ch R,G,B --diff | awk '
        /^PASS/ { same = 1 }
        /RMS error/ { rmse = $4 }
        /Max error/ { most = $4; place = $6 $7 }
        /over 0.01$/ { percent = substr($3, 2) + 0 }
        END {
            if (rmse == "") rmse = most = same ? 0 : "nan"
            gsub(/[()]|,$/, "", place)
            print rmse, most, percent + 0, place == "" ? "-" : place
        }'
}

# within DIFFERENCE LIMITS [FACTOR]: no number of it is above its limit times the factor.
within() {
    awk -v difference="$1" -v limits="$2" -v factor="${3:-1}" 'BEGIN {
        split(difference, d, " ")
        if (split(limits, l, " ") < 3) exit 1
        for (i = 1; i <= 3; i++)
            if (d[i] !~ /^[0-9]/ || d[i] > l[i]*factor) exit 1
    }'
}

# The errors in a log of POV-Ray or povgloss, in one line and without this machine's folders. POV-Ray's messages are
# wrapped: a further line begins with a space.
reason() {
    tr '\r' '\n' < "$1" | awk '
        function take() {
            if (line ~ /^povgloss: (warning|rendering)|^Fatal error/) return
            if (line !~ /[Ee]rror|^povgloss: |^glossfilter: /) return
            printf "%s%s", separator, line
            separator = " "
        }
        /^ / { line = line $0; next }
        { take(); line = $0 }
        END { take() }' | sed "s|$scenes/||g; s/^povgloss: //" | tr -s '\t ' ' ' | cut -c 1-400
}

# spread FOLDER SCENE: the difference between POV-Ray's picture and the one with its threads in another order, or with all
# samples of its focal blur.
spread() {
    if [ ! -e "$1/again/status" ]; then
        if grep -q '^[^/]*\baperture\b' "$2"; then
            mkdir -p "$1/again"
            sed -E 's|^([^/]*)\bvariance\b\s*[-+*/0-9.e]+|\1 |; s|^([^/]*)\b(aperture)\b|\1 variance 0 \2|' "$2" \
                > "$1/again/all.pov"
            draw "$1/again" "$1/again/all.pov" "+L$(dirname "$2")"
        else
            draw "$1/again" "$2" +WT2 +BS8
        fi
    fi
    [ ! -e "$1/again/image.exr" ] || difference "$1/truth/image.exr" "$1/again/image.exr"
}

# says LOG [PATTERN]: whether a warning in it is about what the picture lacks, or is this one.
says() {
    grep '^povgloss: warning: ' "$1" | grep -v -e ': no finish is glossy' -e ': the camera sees no glossy' |
        grep -q -e "${2:-}"
}

# judge FOLDER SCENE MODE: the verdict, what it is about, and the difference, separated by tabs.
judge() {
    local folder=$1 scene=$2 mode=$3 truth=$1/truth/image.exr run=$1/$3
    local kind=base limits="0 0 0" picture=$run/mirror.exr right=ok wrong=silent status measured random own
    status=$(cat "$folder/truth/status")
    case $status in
        0) ;;
        124 | 137) printf 'limit\tPOV-Ray itself takes more than %s s\n' "$limit" && return ;;
        *) printf 'povray\t%s\n' "$(reason "$folder/truth/log")" && return ;;
    esac
    rm -rf "$run" && mkdir "$run"
    find_own_switches "$scene"
    (cd "$run" && timeout -k 5 "$limit" "$bin/povgloss" passes "$scene" "${own[@]}" "${switches[@]}" --gloss "$mode" \
        -o part.exr && mv part*.exr passes.exr) > "$run/log" 2>&1
    status=$?
    case $status in
        0) ;;
        3) printf 'refused\t%s\n' "$(reason "$run/log")" && return ;;
        4) printf 'fails\t%s\n' "$(reason "$run/log")" && return ;;
        124 | 137) printf 'limit\tmore than %s s\n' "$limit" && return ;;
        *) printf 'crash\texit status %s: %s\n' "$status" "$(reason "$run/log")" && return ;;
    esac
    if oiiotool "$run/passes.exr" --ch phong.V --printstats | grep -q 'Stats Max: 0\.000000 '; then
        picture=$run/base.exr
        mv "$run/passes.exr" "$picture"
    else
        kind=mirror limits="0.002 1e30 0.1"
        "$bin/glossfilter" "$run/passes.exr" --phong inf --quiet -o "$picture" 2>> "$run/log" || {
            printf 'crash\t%s\n' "$(reason "$run/log")"
            return
        }
    fi
    measured=$(difference "$truth" "$picture")
    says "$run/log" "don't add up" && right=alarm
    # A base of two copies is rounded elsewhere: the last bit of a half float may differ.
    if [ "$kind" = base ] && ! within "$measured" "$limits" && ! grep -q ': no finish is glossy' "$run/log"; then
        kind="base, rounded" limits="1e-5 0.001 0"
    fi
    within "$measured" "$limits" && printf '%s\t%s\t%s\n' "$right" "$kind" "$measured" && return
    random=$(spread "$folder" "$scene")
    within "$measured" "$random" 2 && printf '%s\t%s, random\t%s\t%s\n' "$right" "$kind" "$measured" "$random" && return
    says "$run/log" && wrong=said
    printf '%s\t%s\t%s\t%s\n' "$wrong" "$kind" "$measured" "$random"
}

# run_scene NAME SCENE: leaves a line of NAME, mode, seconds, and what judge says, in MODE.verdict.
run_scene() {
    local folder=$out/$1 scene=$2 dull=$out/$1/${modes[0]}/base.exr mode verdict start tenths
    [ -e "$folder/truth/status" ] || draw "$folder/truth" "$scene"
    for mode in "${modes[@]}"; do
        [ "$folder/$mode.verdict" -nt "$bin/povgloss" ] && continue
        rm -rf "${folder:?}/$mode" "$folder/$mode.verdict"
        # One verdict is enough where POV-Ray fails, and where the first mode finds nothing glossy.
        if [ "$mode" != "${modes[0]}" ] && { [ ! -e "$folder/truth/image.exr" ] || [ -e "$dull" ]; }; then continue; fi
        start=${EPOCHREALTIME/./}
        verdict=$(judge "$folder" "$scene" "$mode")
        tenths=$(((${EPOCHREALTIME/./} - start) / 100000))
        printf '%s\t%s\t%s.%s\t%s\n' "$1" "$mode" $((tenths / 10)) $((tenths % 10)) "$verdict" > "$folder/$mode.verdict"
    done
}

# ---- the report

# count MODE VERDICT [WHAT]
count() {
    awk -F '\t' -v mode="$1" -v verdict="$2" -v what="${3:-}" \
        '$2 == mode && $4 == verdict && (what == "" || $5 == what) { n++ } END { print n + 0 }' "$out/verdicts"
}

# counts TITLE VERDICT [WHAT]: a row of the table of counts.
counts() {
    printf '| %s |' "$1"
    for mode in "${modes[@]}"; do printf ' %s |' "$(count "$mode" "${@:2}")"; done
    printf '\n'
}

# section TITLE VERDICT: the scenes of this verdict and what there is to say, in the order of that.
section() {
    awk -F '\t' -v verdict="$2" '$4 == verdict { print $1 "\t" $2 "\t" $5 "\t" $6 }' "$out/verdicts" |
        sort -t $'\t' -k 3,3 -k 1,2 | awk -F '\t' -v title="$1" '
            NR == 1 { printf "\n## %s\n\n| scene | `--gloss` | |\n|---|---|---|\n", title }
            {
                split($4, m, " ")
                difference = sprintf("%s: RMSE %s, at most %s (at %s), %s %% of the pixels", $3, m[1], m[2], m[4], m[3])
                text = $4 == "" ? $3 : difference
                gsub(/[|<*_]/, "\\\\&", text)
                printf "| %s | %s | %s |\n", $1, $2, text
            }'
}

write_report() {
    cat << EOF
# The scenes of povray-examples

Written by \`make corpus\`; \`scripts/corpus.sh\` says how each scene is judged.
$(date +%F), $("$bin/povgloss" --version), $(povray --version 2>&1 | grep -o '^POV-Ray [0-9.]*[0-9]'),
povray-examples $(dpkg-query -W -f '${Version}' povray-examples), $(wc -l < "$out/scenes") scenes: $size,
no antialiasing, at most $limit s a picture, $(nproc) processors.

| | --gloss ${modes[0]} | --gloss ${modes[1]} |
|---|---|---|
$(counts "nothing glossy in sight: POV-Ray's picture to the bit" ok base)
$(counts "the same but for the last bit" ok "base, rounded")
$(counts "with mirrors POV-Ray's picture" ok mirror)
$(counts "the same, as far as POV-Ray draws it twice" ok "mirror, random")
$(counts "another picture, said" said)
$(counts "another picture, silent" silent)
$(counts "POV-Ray's picture, but a false alarm" alarm)
$(counts "refused" refused)
$(counts "POV-Ray fails in a pass" fails)
$(counts "stopped by a defect" crash)
$(counts "time limit" limit)
$(counts "POV-Ray itself fails" povray)
EOF
    section "Another picture, silent" silent
    section "Another picture, said" said
    section "False alarm" alarm
    section "Refused" refused
    section "POV-Ray fails in a pass" fails
    section "Stopped by a defect" crash
    section "Time limit" limit
    section "POV-Ray itself fails" povray
}

# ---- all scenes

find "$scenes" -name '*.pov' | sort | while read -r scene; do
    name=${scene#"$scenes/"}
    name=${name%.pov}
    printf '%s\t%s\n' "${name//[\/ ]/_}" "$scene"
done > "$out/scenes"

while IFS=$'\t' read -r name scene; do
    [[ $name =~ $only ]] || continue
    while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n; done
    run_scene "$name" "$scene" &
done < "$out/scenes"
wait

cut -f 1 "$out/scenes" | while read -r name; do
    for mode in "${modes[@]}"; do cat "$out/$name/$mode.verdict" 2> /dev/null; done
done > "$out/verdicts"
write_report > "$out/report.md"
[ -z "$report" ] || cp "$out/report.md" "$report"
