#!/usr/bin/env bash
# The command lines: help, version, and what is refused before any work: exit status 2 and one line that says why.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
mkdir work
cd work || exit 1
touch scene.pov passes.exr
export PATH=$bin:$PATH

# refuses PROGRAM MESSAGE ARGUMENT...: status 2, one line with the message, nothing on standard output, nothing written.
refuses() {
    local program=$1 message=$2 lines
    shift 2
    run "$program" "$@" < /dev/null
    mapfile -t lines < "$scratch/err"
    expect_status 2 || return 1
    if [ -s "$scratch/out" ] || [ "${#lines[@]}" -ne 1 ] || [[ ${lines[0]} != "$program: "*"$message"* ]]; then
        fail "wanted the one line '$program: ... $message ...'"
        show_run
        return 1
    fi
    [ "$(echo * "$TMPDIR"/*)" = "passes.exr scene.pov $TMPDIR/*" ] || fail "written: $(echo * "$TMPDIR"/*)"
}

# refuses_values PROGRAM OPTION MESSAGE VALUES ARGUMENT...: each of the values, and what is no value of any option.
refuses_values() {
    local program=$1 option=$2 message=$3 values value
    read -ra values <<< "$4"
    shift 4
    for value in '' nan ' 1' 1x 0x nonsense -1 "${values[@]}"; do
        refuses "$program" "$option $value: $message" "$@" "$option" "$value" || return 1
        refuses "$program" "$option $value: $message" "$@" "$option=$value" || return 1
    done
}

# on_terminal COMMAND...: standard output is a terminal; what it shows goes to $scratch/out.
on_terminal() {
    script -qec "$(printf '%q ' "$@")" /dev/null < /dev/null > "$scratch/out" 2> "$scratch/err"
    status=$?
}

helps() {
    local program=$1 option
    shift
    run "$program" --help
    expect_status 0 || return 1
    [ ! -s "$scratch/err" ] || { show_run; return 1; }
    for option; do
        grep -qE -e "(^|[ ,])$option([ ,=]|$)" "$scratch/out" || fail "--help doesn't mention $option" || return 1
    done
}

tells_version() {
    run "$1" --version
    expect_status 0 || return 1
    [ ! -s "$scratch/err" ] && grep -qxE "$1 [0-9]+\.[0-9]+\.[0-9]+" "$scratch/out" && return
    show_run
    cat "$scratch/out"
    return 1
}

filter_options=(--phong --roughness --mode --weights --formula --window --energy --max-angle --max-radius --radius-step
    --without --threads --isa --format --bits)
own_options=(--depfile -o --from-scene --resume --subsample --jobs --keep --povray --grid --error --samples --seed)
check "povgloss --help names every option" \
    helps povgloss "${own_options[@]}" "${filter_options[@]}" --layers -q --quiet --help --version
check "glossfilter --help names every option" \
    helps glossfilter -o --output --map --check "${filter_options[@]}" --layers -q --quiet -h --help --version
check "povgloss --version" tells_version povgloss
check "glossfilter --version" tells_version glossfilter

check "povgloss without arguments" refuses povgloss "no command"
check "povgloss with an unknown command" refuses povgloss "unknown command draw" draw scene.pov -o x.png
check "povgloss with an option in place of the command" refuses povgloss "no command" --quiet
check "povgloss render without a scene" refuses povgloss "no scene" render -o x.png
check "povgloss render without an output" refuses povgloss "no output" render scene.pov
check "povgloss render with two scenes" refuses povgloss "two scenes, scene.pov and b.pov" render scene.pov b.pov -o x.png
check "povgloss render with a scene and +I" refuses povgloss "two scenes" render scene.pov +Ib.pov -o x.png
check "povgloss with an unknown option" refuses povgloss "unknown option --nonsense" render scene.pov -o x.png --nonsense
check "povgloss passes with an option of the filter" refuses povgloss "glossfilter" passes scene.pov -o x.exr --phong 5
check "povgloss passes to a PNG" refuses povgloss "exr" passes scene.pov -o x.png
check "povgloss probe without an output" refuses povgloss "no output" probe scene.pov
for option in --layers --radius-step=2 --depfile=x.d --resume --subsample=2; do
    check "povgloss probe with $option" refuses povgloss "povgloss probe neither filters" probe scene.pov -o x.csv "$option"
done
check "povgloss probe of an animation" refuses povgloss "one frame" probe scene.pov +KFF3 -o x.csv
for option in --radius-step=2 --max-radius=3 --resume --subsample=2; do
    check "povgloss brute with $option" refuses povgloss "povgloss brute neither filters" brute scene.pov -o x.exr "$option"
done
check "povgloss brute without a format" refuses povgloss "--format exr|png" brute scene.pov -o picture
check "povgloss brute with layers in a PNG" refuses povgloss "--layers" brute scene.pov -o x.png --layers
check "povgloss brute with two exponents" refuses povgloss "one --phong" brute scene.pov -o x.exr --phong 1 --phong 2
check "povgloss: --grid is the probes'" refuses povgloss "unknown option --grid" render scene.pov -o x.png --grid 3
check "povgloss compare with one file" refuses povgloss "needs two files" compare probes.csv
check "povgloss compare with three files" refuses povgloss "needs two files" compare probes.csv a.exr b.exr
check "povgloss compare with two exponents" refuses povgloss "one --phong" compare probes.csv a.exr --phong 1 --phong 2
for option in -o=x --layers --keep=x --gloss=auto --from-scene; do
    check "povgloss compare with $option" refuses povgloss "povgloss compare takes" compare probes.csv a.exr "$option"
done
check "glossfilter without arguments" refuses glossfilter "no passes file"
check "glossfilter without an output" refuses glossfilter "no output" passes.exr
check "glossfilter --check without a passes file" refuses glossfilter "no passes file" --check
check "glossfilter: --map without a value" refuses glossfilter "--map needs a value" passes.exr -o x.exr --map
check "glossfilter to check two passes files" refuses glossfilter "b.exr" passes.exr b.exr --check
check "glossfilter with an unknown option" refuses glossfilter "--nonsense: unknown option" passes.exr -o x.exr --nonsense
check "glossfilter with an unknown short option" refuses glossfilter "-z: unknown option" passes.exr -o x.exr -z

# Switches of POV-Ray that the passes can't have.
for switch in +Oelsewhere.png +FN Output_File_Name=elsewhere.png +HIhead.inc Pre_Scene_Command=true; do
    check "povgloss with POV-Ray's $switch" refuses povgloss "$switch can't be passed on" render scene.pov "$switch" -o x.png
done

for program in povgloss glossfilter; do
    if [ "$program" = povgloss ]; then input=(render scene.pov); else input=(passes.exr); fi
    check "$program: an output whose name says no format" refuses "$program" "--format exr|png" "${input[@]}" -o picture
    check "$program: an output of an unknown format" refuses "$program" "--format exr|png" "${input[@]}" -o x.jpg
    check "$program: standard output without a format" refuses "$program" "--format exr|png" "${input[@]}" -o -
    check "$program: layers in a PNG" refuses "$program" "--layers" "${input[@]}" -o x.png --layers
    for option in "${filter_options[@]}" -o; do
        check "$program: $option without a value" refuses "$program" "$option needs a value" "${input[@]}" "$option"
    done
    while read -r option values; do
        check "$program: wrong values of $option" \
            refuses_values "$program" "$option" "must be" "$values" "${input[@]}" -o x.exr
    done << 'END'
--phong -inf -1e-9 1,5
--roughness 1.0001 inf -0.1
--mode Paper paper, better
--without all pools
--weights EXACT exact, gauss0
--formula 2 cos
--window circle Round
--energy 0 1 1.5 inf
--max-angle 0 90.01 inf
--max-radius 1.5 99999999999999999999 inf
--radius-step 0 3 16 4.0
--threads 257 1.5 99999999999999999999
--isa sse9 AVX2
--format jpg EXR
--bits 0 10 8.0 32
END
done
check "povgloss: wrong values of --subsample" \
    refuses_values povgloss --subsample "" "0 3 5 8 1.5" render scene.pov +W640 +H480 -o x.png
check "povgloss: wrong values of --jobs" refuses_values povgloss --jobs "" "65 1.5 99999999999999999999" render scene.pov -o x.png
while read -r option values; do
    check "povgloss probe: wrong values of $option" \
        refuses_values povgloss "$option" "must be" "$values" probe scene.pov -o x.csv
done << 'END'
--grid 0 1.5 65536
--error 0 1e-7 1.1 inf
--phong -inf -1e-9 1,5
--seed 1.5 99999999999999999999
END
check "povgloss brute: wrong values of --samples" \
    refuses_values povgloss --samples "must be" "0 1.5 65537" brute scene.pov -o x.exr
for option in --keep --povray; do
    check "povgloss: $option without a value" refuses povgloss "$option needs a value" render scene.pov -o x.png "$option"
done
check "povgloss: an empty output" refuses povgloss "" render scene.pov -o ""
check "glossfilter: an empty output" refuses glossfilter "" passes.exr -o ""

export POVINI=/dev/null # the usual one says a size
check "--subsample without +W and +H" refuses povgloss "+W and +H" render scene.pov -o x.png --subsample 2
check "--subsample with +W alone" refuses povgloss "+W and +H" render scene.pov +W640 -o x.png --subsample 2
check "--subsample of a size that is no multiple" \
    refuses povgloss "multiples of 4" render scene.pov +W640 +H482 -o x.png --subsample 4

refuses_terminal() {
    on_terminal "$@"
    expect_status 2 && grep -q "terminal" "$scratch/out" && return
    head -c 1000 "$scratch/out"
    return 1
}
check "povgloss: a PNG to the terminal" refuses_terminal povgloss render scene.pov -o - --format png
check "povgloss: probes to the terminal" refuses_terminal povgloss probe scene.pov -o -
check "povgloss: passes to the terminal" refuses_terminal povgloss passes scene.pov -o -
check "glossfilter: an EXR to the terminal" refuses_terminal glossfilter passes.exr -o - --format exr

cannot_say() {
    "$@" > /dev/full 2> "$scratch/err"
    status=$?
    : > "$scratch/out"
    expect_status 3 && expect_message "standard output"
}
for program in povgloss glossfilter; do
    check "$program --help on a full disk" cannot_say "$program" --help
    check "$program --version on a full disk" cannot_say "$program" --version
done
end_of_tests
