# Shared by the end-to-end tests: a scratch folder that goes away, results as TAP, and checks of a program's manners.
# Sourced from the project's root. BIN is the folder of the programs.
# shellcheck shell=bash disable=SC2034
set -u
export LC_ALL=C.UTF-8
root=$PWD
bin=$(realpath "${BIN:-build/bin}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/tmp" "$scratch/home"

# The user's own settings of POV-Ray play no part, and what povgloss leaves in the temporary folder is seen.
export TMPDIR=$scratch/tmp HOME=$scratch/home
unset POVINI

tests=0

# check NAME COMMAND...: one test, that COMMAND succeeds; what it prints explains a failure.
check() {
    local name=$1 output
    shift
    tests=$((tests + 1))
    if output=$("$@" 2>&1); then
        printf 'ok %d - %s\n' "$tests" "$name"
    else
        printf 'not ok %d - %s\n' "$tests" "$name"
        printf '%s\n' "$output" | sed 's/^/# /'
    fi
}

# The plan comes last: a script that stops early has none, and fails.
end_of_tests() {
    printf '1..%d\n' "$tests"
}

# run COMMAND...: leaves the exit status in $status, and what it wrote in $scratch/out and $scratch/err.
run() {
    "$@" > "$scratch/out" 2> "$scratch/err"
    status=$?
}

fail() {
    printf '%s\n' "$*"
    return 1
}

# What the last `run` wrote, for a failure.
show_run() {
    printf 'standard output: %s bytes\nstandard error:\n' "$(stat -c %s "$scratch/out")"
    cat "$scratch/err"
}

expect_status() {
    [ "$status" -eq "$1" ] && return
    printf 'exit status %s, not %s\n' "$status" "$1"
    show_run
    return 1
}

# expect_message TEXT: standard error has TEXT, and nothing went to standard output.
expect_message() {
    [ ! -s "$scratch/out" ] || { show_run; return 1; }
    grep -qF -e "$1" "$scratch/err" && return
    printf 'no message with: %s\n' "$1"
    show_run
    return 1
}

# expect_one_line PROGRAM: one line on standard error, that begins with the program's name.
expect_one_line() {
    [ "$(wc -l < "$scratch/err")" -eq 1 ] && grep -q "^$1: " "$scratch/err" && return
    show_run
    return 1
}

expect_no_file() {
    local file
    for file; do
        [ ! -e "$file" ] || fail "$file is there" || return 1
    done
}

# Nothing in the temporary folder, and no process that works there.
expect_nothing_left() {
    local left process
    left=$(find "$TMPDIR" -mindepth 1)
    [ -z "$left" ] || fail "left in TMPDIR: $left" || return 1
    for process in /proc/[0-9]*; do
        case $(readlink "$process/cwd") in
            "$TMPDIR"*) fail "left running: $(tr '\0' ' ' < "$process/cmdline")" || return 1 ;;
        esac
    done
}

rmse() {
    oiiotool -a --diff "$1" "$2" | awk '/RMS error/ { print $4 }'
}

# same_picture FILE FILE: in linear light, but for the half floats that colours travel as.
same_picture() {
    oiiotool -a --fail 0.01 --failpercent 0.1 --hardfail inf --diff "$1" "$2" || return 1
    awk -v rmse="$(rmse "$1" "$2")" 'BEGIN { exit !(rmse != "" && rmse <= 0.002) }'
}
