#!/usr/bin/env bash
# --sandbox: what bubblewrap is asked for, by a bwrap that only writes that down; what its failures give; and, where the
# system lets it work, what a scene can't do in it.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
mkdir fake scenes more secret
povgloss=("$bin/povgloss" render scenes/scene.pov "+L$root/povscenes" +Lmore +W16 +H12 -A --quiet)

# scene STATEMENTS: a glossy floor with these before it.
scene() {
    printf '%s\n' '#version 3.7;' '#include "povgloss.inc"' 'global_settings { assumed_gamma 1.0 }' "$1" \
        'camera { location <0, 2, -6> look_at 0 }' 'light_source { <-5, 8, -6> rgb 1 }' \
        'plane { y, 0 pigment { rgb 0.3 } finish { reflection 0.5 Gloss(50) } }' > scenes/scene.pov
}
scene ''
"${povgloss[@]}" -o plain.png || exit 1

# A bwrap of the commands on standard input.
fake_bwrap() {
    { echo '#!/bin/sh'; cat; } > fake/bwrap
    chmod +x fake/bwrap
}

fails() {
    local message=$1
    shift
    rm -f picture.png
    run "$@" --sandbox -o picture.png
    expect_status 4 && expect_message "$message" && expect_nothing_left && expect_no_file picture.png
}

mkdir programs
ln -s "$(command -v povray)" programs/povray
check "sandbox__no_bwrap__cure" fails "bwrap isn't in PATH: --sandbox needs bubblewrap" \
    env "PATH=$scratch/programs" "${povgloss[@]}"
fake_bwrap << 'SH'
echo 'bwrap: No permissions to create a new namespace' >&2
exit 1
SH
check "sandbox__namespaces_forbidden__told" fails "it says: bwrap: No permissions to create a new namespace" \
    env "PATH=$scratch/fake:$PATH" "${povgloss[@]}"
check "sandbox__no_povray__cure" fails "nopovray isn't in PATH: install POV-Ray" "${povgloss[@]}" --povray nopovray

# Drops its options, whose number of values is known, and goes on as the program.
fake_bwrap << SH
printf '%s\n' "\$@" > "$scratch/asked"
while :; do
    case \$1 in
        --ro-bind | --ro-bind-try | --bind) shift 3 ;;
        --dev | --dir) shift 2 ;;
        --*) shift ;;
        *) break ;;
    esac
done
exec "\$@"
SH
# Pairs of paths follow --bind and --ro-bind.
asked_for() {
    PATH="$scratch/fake:$PATH" "${povgloss[@]}" --sandbox --depfile picture.d -o picture.png || return 1
    cmp picture.png plain.png || return 1
    grep -qx -e --unshare-all asked && grep -qx -e --die-with-parent asked || fail "not asked for: no network" || return 1
    [ "$(grep -cx -e --bind asked)" = 1 ] && [[ $(grep -x -A1 -e --bind asked) == *"$TMPDIR"/* ]] ||
        fail "to be written: $(grep -x -A1 -e --bind asked)" || return 1
    local folder
    for folder in "$scratch" "$scratch/scenes" "$scratch/more" "$root/povscenes"; do
        grep -x -A1 -e --ro-bind asked | grep -qxF "$(realpath "$folder")" || fail "not to be read: $folder" || return 1
    done
    grep -q scenes/scene.pov picture.d
}
check "sandbox__folders_and_network__asked_for" asked_for
fake_bwrap << 'SH'
case $* in *true) ;; *) exit 9 ;; esac
SH
check "sandbox__bwrap_fails_in_a_pass__told" fails "povray failed with exit status 9" env "PATH=$scratch/fake:$PATH" \
    "${povgloss[@]}"

# ---- the real one

if ! bwrap --unshare-all --ro-bind / / --dev /dev true 2> reason; then
    check "sandbox__real_bwrap__not_allowed_here # SKIP $(head -n 1 reason)" true
    end_of_tests
    exit
fi

same_picture_as_without() {
    "${povgloss[@]}" --sandbox "$@" -o picture.png && cmp picture.png plain.png && expect_nothing_left
}
check "sandbox__scene__same_picture" same_picture_as_without
check "sandbox__keep_and_depfile__same_picture" same_picture_as_without --keep kept --depfile picture.d

# What POV-Ray may do is tried in a folder in which the scene isn't.
cd "$scratch/more" || exit 1
mv "$scratch/scenes" "$scratch/secret" .
mkdir "$scratch/outside"
mv secret "$scratch/outside"
echo '#declare Read = 1;' > "$scratch/outside/secret/file.inc"
povgloss=("$bin/povgloss" render scenes/scene.pov "+L$root/povscenes" +W16 +H12 -A --quiet)
# works STATEMENTS, breaks STATEMENTS: under the sandbox; each works without it.
works() {
    scene "$1"
    "${povgloss[@]}" -o without.png && "${povgloss[@]}" --sandbox -o with.png && cmp with.png without.png
}
breaks() {
    scene "$1"
    "${povgloss[@]}" -o without.png || return 1
    rm -f "$scratch"/outside/written* scenes/written*
    fails "$2" "${povgloss[@]}" && expect_no_file "$scratch"/outside/written* scenes/written*
}
writes() {
    printf '#fopen F "%s" write #write (F, "x") #fclose F' "$1"
}
check "sandbox__file_by_a_plain_name__written" works "$(writes plain.txt)"
check "sandbox__file_by_a_plain_name__not_beside_the_scene" expect_no_file plain.txt scenes/plain.txt
check "sandbox__file_beside_the_scene__not_written" breaks "$(writes "$PWD/scenes/written.txt")" "Cannot open"
check "sandbox__file_outside__not_written" breaks "$(writes "$scratch/outside/written.txt")" "Cannot open"
check "sandbox__file_in_the_scenes_folder__read" works "#fopen F \"$PWD/scenes/scene.pov\" read #fclose F"
check "sandbox__file_outside__not_read" breaks "#fopen F \"$scratch/outside/secret/file.inc\" read #fclose F" "Cannot open"

# A povray that tries to reach a server on this machine, and says so.
perl -MIO::Socket::INET -e '$| = 1; $s = IO::Socket::INET->new(Listen => 1, LocalAddr => "127.0.0.1") or die;
    print $s->sockport, "\n"; alarm 60; close $s->accept while 1' > port 2> /dev/null &
server=$!
for ((i = 0; i < 50; i++)); do [ -s port ] || sleep 0.1; done
mkdir tool
cat > tool/povray << SH
#!/bin/bash
if (exec 3<> /dev/tcp/127.0.0.1/$(cat port)) 2> /dev/null; then echo "Parse Error: reached" >&2; else echo "Parse Error: cut off" >&2; fi
exit 1
SH
chmod +x tool/povray
reaches() {
    scene ''
    run "${povgloss[@]}" --povray tool/povray "${@:2}" -o picture.png
    expect_status 4 && expect_message "$1"
}
check "sandbox__network_without_it__reached" reaches "reached"
check "sandbox__network__cut_off" reaches "cut off" --sandbox
kill $server

printf '#!/bin/sh\nsleep 600\n' > tool/povray
ends() {
    scene ''
    fails "took longer than 1 s" "${povgloss[@]}" --povray tool/povray --timeout 1 && expect_nothing_left
}
check "sandbox__timeout__ends_it" ends
stops() {
    "${povgloss[@]}" --povray tool/povray --sandbox -o picture.png 2> err &
    local pid=$!
    sleep 1
    kill -TERM $pid
    wait $pid
    [ $? -eq 143 ] || fail "status $?" || return 1
    sleep 0.2
    expect_nothing_left
}
check "sandbox__signal__nothing_left" stops

# Signals while bwrap starts.
stops_early() {
    local delay
    for delay in 0.02 0.04 0.06 0.08 0.1 0.12 0.15 0.2; do
        "${povgloss[@]}" --povray tool/povray --sandbox -o picture.png 2> err &
        sleep $delay
        kill -TERM $!
        wait $!
        expect_nothing_left || return
    done
}
check "sandbox__signal_while_it_starts__nothing_left" stops_early
end_of_tests
