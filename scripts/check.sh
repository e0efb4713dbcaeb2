#!/usr/bin/env bash
# Runs every test under prove and closes with one line, `N passed, N failed`, over all of them.
#
# Arguments: the unit test programs. BIN and TOOLS name the folders of the programs and of the tests' own tools; JOBS,
# test programs at the same time (the processors' number).
set -u

log=$(mktemp)
trap 'rm -f "$log"' EXIT

scripts=()
for script in tests/e2e/*.sh; do
    case $script in
        tests/e2e/lib*.sh) ;;
        *) scripts+=("$script") ;;
    esac
done
export CMOCKA_MESSAGE_OUTPUT=TAP BIN TOOLS
# The formatter for files keeps what test programs print together when several run at a time.
prove --jobs "${JOBS:-$(nproc)}" --formatter TAP::Formatter::File --exec '' --merge --timer --verbose \
    "$@" "${scripts[@]}" >"$log"
status=$?

# What failed and why, and prove's own line for every test program; not each test that passed.
grep -vE '^ok [0-9]|^1\.\.[0-9]+$|^ok$|^# ok' "$log"
passed=$(grep -E '^ok [0-9]' "$log" | grep -cv '# SKIP')
skipped=$(grep -cE '^ok [0-9].*# SKIP' "$log")
failed=$(grep -cE '^not ok [0-9]' "$log")
# A program that died or ran fewer tests than it planned has failed as well.
if [ "$status" -ne 0 ] && [ "$failed" -eq 0 ]; then
    failed=1
fi
echo "$passed passed, $failed failed$([ "$skipped" -eq 0 ] || echo ", $skipped skipped")"
[ "$status" -eq 0 ] && [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
