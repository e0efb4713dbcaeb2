#!/usr/bin/env bash
# The order of the source files: a file includes only headers of its own row or of rows above it; every header compiles
# alone; OpenEXR's and libpng's headers stay out of ours.
. tests/e2e/lib.sh

rows='error preload_reads preload_waits
interrupt cpu mem lobe gamma timings
image gbuffer weights bands own_files input_file output_file frames
exr_io png_io ppm_io control_variate position_code eye camera interpolate filter_weight filter_kernel filter_sight sheet child scene_lexer scene_names gloss_choice ini_file povray_switches work_folder depfile
channels picture passes_file passes_check image_file filter filter_internal filter_cells filter_visibility filter_walk filter_fast gloss compose probe picture_check povray sandbox scene scene_tokens scene_discover scene_surfaces scene_unions scene_uses
scene_rewrite scene_list
pass_scene pass_images preload reads probe_file
passes
cli
command
lobe_rays
draw
measure
main_glossfilter main_povgloss main_view'

row_of() {
    printf '%s\n' "$rows" | grep -nwE "$1" | cut -d: -f1
}

# The header may be of the file's own row only if it doesn't include back, which compiling each header alone shows.
includes_point_up() {
    local file name row header
    for file in src/*.[ch]; do
        name=$(basename "${file%.*}")
        row=$(row_of "$name")
        [ -n "$row" ] || fail "$file is in no row" || return 1
        for header in $(sed -n 's/^#include "\([a-z_]*\)\.h"$/\1/p' "$file"); do
            [ "$(row_of "$header")" -le "$row" ] || fail "$file includes $header.h" || return 1
        done
    done
}

compiles_alone() {
    "${CC:-gcc}" -std=c11 -D_GNU_SOURCE -Isrc -Wall -Wextra -Werror -fsyntax-only -x c "$1"
}

foreign_headers_stay_out() {
    ! grep -lE '#include <(openexr|png)' src/*.h
}

check 'includes__order__from_programs_down' includes_point_up
for header in src/*.h; do
    check "$(basename "$header")__alone__compiles" compiles_alone "$header"
done
check 'headers__openexr_and_png__stay_in_their_files' foreign_headers_stay_out
end_of_tests
