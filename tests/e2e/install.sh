#!/usr/bin/env bash
# make install, uninstall and deb; what is installed works from where it is: the include, the object for --depfile, the
# library, the manual pages and the completion.
. tests/e2e/lib.sh

tree=$scratch/tree
prefix=/opt/gloss
installed=$tree$prefix
# The options of `make check` are not for this make; its compiler is.
unset MAKEFLAGS MAKELEVEL MFLAGS SANITIZE
make=(make --no-print-directory "CC=${CC:-gcc}" "PREFIX=$prefix")

files='bin/glossfilter bin/povgloss include/gloss.h lib/libgloss.a lib/pkgconfig/libgloss.pc lib/povgloss/preload.so
share/bash-completion/completions/glossfilter share/bash-completion/completions/povgloss share/man/man1/glossfilter.1
share/man/man1/povgloss.1 share/man/man5/povgloss-passes.5 share/povgloss/include/povgloss.inc'
if pkg-config --exists sdl2; then files=${files/preload.so/preload.so lib/povgloss/view}; fi
installs() {
    "${make[@]}" "DESTDIR=$tree" install || return 1
    [ "$(cd "$installed" && find . -type f -printf '%P\n' | sort)" = "$(tr ' ' '\n' <<< "$files")" ] ||
        fail "$(find "$tree" -type f)"
}
check "install__an_empty_tree__these_files" installs
check "install__again__the_same" installs
on_path() {
    grep -rlF "$1" "$installed" | grep -v '/bin/\|\.a$\|\.so$\|/view$'
}
no_path_of_the_build() {
    local found
    found=$(on_path "$tree"; on_path "$root")
    [ -z "$found" ] || fail "$found"
}
check "install__DESTDIR__in_no_text" no_path_of_the_build

cd "$scratch" || exit 1
"$installed/bin/povgloss" --version > /dev/null || exit 1
cat > scene.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <0, 2, -6> look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
plane { y, 0 pigment { rgb 0.3 } finish { reflection 0.5 Gloss(50) } }
sphere { y, 1 pigment { rgb x } }
POV

include_dir() {
    [ "$("$installed/bin/povgloss" --print-include-dir)" = "$installed/share/povgloss/include" ] &&
        "$bin/povgloss" --print-include-dir | grep -q '/share/povgloss/include$' || return 1
    ln -sfn "$installed/bin/povgloss" linked
    [ "$(./linked --print-include-dir)" = "$installed/share/povgloss/include" ]
}
check "print_include_dir__installed_built_or_linked_to__beside_the_program" include_dir
check "print_include_dir__povray_itself__draws" \
    povray "+L$("$installed/bin/povgloss" --print-include-dir)" +Iscene.pov +Oplain.png +W40 +H30 -D
depfile() {
    "$installed/bin/povgloss" render scene.pov "+L$installed/share/povgloss/include" +W40 +H30 --quiet --depfile s.d \
        -o s.png &&
        grep -qF "$installed/share/povgloss/include/povgloss.inc" s.d
}
check "depfile__installed__finds_its_object" depfile
lost_files() {
    mkdir -p lost/bin && cp "$installed/bin/povgloss" lost/bin
    run lost/bin/povgloss --print-include-dir
    expect_status 3 && expect_message "build or install povgloss anew"
}
check "print_include_dir__the_program_alone__says_so" lost_files

export PKG_CONFIG_PATH=$installed/lib/pkgconfig PKG_CONFIG_SYSROOT_DIR=$tree
# A sanitized test run has a library without sanitizer, too.
example() {
    local flags
    read -ra flags <<< "$(pkg-config --cflags --libs libgloss)"
    "${CC:-gcc}" -std=c11 -Wall -Wextra -Werror "$root/docs/gloss_example.c" "${flags[@]}" -o example || return 1
    run ./example
    expect_status 0 || return 1
    # From 0 on the left to 1 on the right, without a step back, and soft in the middle.
    awk '{
        for (i = 2; i <= NF; i++) {
            if ($i < $(i - 1)) exit 1
            soft += $i > 0.05 && $i < 0.95
        }
        exit !($1 == 0 && $NF == 1 && soft > 1)
    }' "$scratch/out" || { cat "$scratch/out"; return 1; }
}
check "libgloss__the_example__compiles_and_blurs" example
check "libgloss__pkg_config__its_version" \
    [ "$(pkg-config --modversion libgloss)" = "$("$installed/bin/povgloss" --version | cut -d' ' -f2)" ]
own_names() {
    local names
    names=$(nm -g --defined-only "$installed/lib/libgloss.a" | awk 'NF == 3 { print $3 }' | sort | xargs)
    [ "$names" = "gloss_apply gloss_close gloss_filter gloss_open" ] || fail "$names"
}
check "libgloss__global_names__those_of_the_header_alone" own_names
check "libgloss__header__C++_takes_it" \
    "${CC:-gcc}" -x c++ -Wall -Wextra -Werror -fsyntax-only "$installed/include/gloss.h"

# ---- manual pages

lint() {
    ! mandoc -Tlint "$1" 2> /dev/null | grep -v 'referenced manual not found'
}
for page in "$root"/man/*; do
    check "mandoc__$(basename "$page")__clean" lint "$page"
done
# Every option of --help has a paragraph of its own.
documents() {
    local option
    { "$bin/$1" --help; [ "$1" = glossfilter ] || "$bin/glossfilter" --help; } |
        grep -oE '^  +(-[a-z], )?--[a-z-]+' | grep -oE -e '--[a-z-]+' | sort -u > options
    [ "$(wc -l < options)" -gt 15 ] || return 1
    while read -r option; do
        grep -qE "^\.It .*Fl ${option#-}( |$)" "$root/man/$1.1" "$root/man/glossfilter.1" ||
            fail "no $option" || return 1
    done < options
}
check "manual__povgloss__every_option_of_help" documents povgloss
check "manual__glossfilter__every_option_of_help" documents glossfilter

# ---- completion

# completes WANTED WORD...: the completions of the last word, sorted, by a shell that knows nothing else.
# shellcheck disable=SC2016 # of the inner shell
completes() {
    local wanted=$1 got
    shift
    got=$(env -i "PATH=$installed/bin:$PATH" bash --norc -c '
        . "$0"
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
        $(complete -p "$1" | sed -n "s/.*-F \([^ ]*\).*/\1/p") "$1"
        printf "%s\n" "${COMPREPLY[@]}" | sort | paste -sd" "' \
        "$installed/share/bash-completion/completions/$1" "$@")
    [ "$got" = "$wanted" ] || fail "$got"
}
mkdir files
cd files || exit 1
mkdir 'a folder'
touch a.exr a.png a.pov a.txt b.exr
check "completion__the_first_word__commands" completes "brute compare list passes probe render" povgloss ""
check "completion__an_option__of_the_program" completes "--gloss" povgloss render --gl
check "completion__an_option__of_the_filter" completes "--map --max-angle --max-radius" glossfilter --ma
check "completion__short_options__too" completes "-q" glossfilter -q
check "completion__a_word__as_the_program_allows" completes "exact gauss table" glossfilter --weights ""
check "completion__a_word__after_the_equals_sign" completes "round" glossfilter --window = r
check "completion__a_word__after_the_equals_sign_alone" completes "round square" glossfilter --window =
check "completion__a_number__nothing" completes "" glossfilter --energy ""
check "completion__passes__EXR_and_folders" completes "a folder a.exr b.exr" glossfilter ""
check "completion__a_scene__after_the_command" completes "a folder a.pov" povgloss render ""
check "completion__an_output__images" completes "a folder a.exr a.png" glossfilter b.exr -o a
cd "$scratch" || exit 1

# ---- away again

uninstalls() {
    touch "$installed/bin/another"
    mkdir -p "$installed/share/man/man1" && touch "$installed/share/man/man1/another.1"
    (cd "$root" && "${make[@]}" "DESTDIR=$tree" uninstall) || return 1
    (cd "$installed" && find . | LC_ALL=C sort) > left
    printf '%s\n' . ./bin ./bin/another ./include ./lib ./share ./share/man ./share/man/man1 ./share/man/man1/another.1 |
        diff - left
}
check "uninstall__all__and_nothing_else" uninstalls
again() {
    (cd "$root" && "${make[@]}" "DESTDIR=$tree" uninstall)
}
check "uninstall__again__nothing_to_do" again

deb() {
    (cd "$root" && "${make[@]}" BUILD=build deb) || return 1
    package=$(ls "$root"/build/povgloss_*.deb) && dpkg-deb -x "$package" unpacked &&
        unpacked/usr/bin/povgloss --print-include-dir && dpkg-deb -f "$package" Depends | grep -q libopenexr
}
check "deb__its_files__work" deb
if command -v lintian > /dev/null; then
    check "deb__lintian__no_errors" lintian --fail-on error "$root"/build/povgloss_*.deb
else
    tests=$((tests + 1))
    echo "ok $tests - deb__lintian__no_errors # SKIP lintian is not installed"
fi
end_of_tests
