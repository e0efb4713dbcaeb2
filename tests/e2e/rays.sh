#!/usr/bin/env bash
# Further rays of the lobe (--rays N) by the real POV-Ray: the error falls with N, the passes file holds them, and what
# can't have any is refused.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
size=(+W96 +H72 -A)
library=+L$root/povscenes
cat > room.pov << 'POV'
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }
camera { location <0.3, 1.6, -5> right x*4/3 angle 50 look_at <0, 0.5, 0> }
light_source { <-6, 9, -7> rgb 0.9 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [0.4 rgb <0.2, 0.35, 0.8>] } } }
plane { y, 0 pigment { rgb 0.1 } finish { diffuse 0.3 reflection 0.5 Gloss(60) } }
sphere { <clock, 0.7, 0.5>, 0.7 pigment { checker rgb <0.9, 0.2, 0.1> rgb 0.9 scale 0.3 } }
sphere { <0, 1.2, -7>, 1 pigment { rgb <0.1, 0.8, 0.3> } finish { ambient 0.5 } no_image }
POV

render() { # OUTPUT OPTION...
    local output=$1
    shift
    "$bin/povgloss" render room.pov "$library" "${size[@]}" --quiet -o "$output" "$@"
}

error_falls() {
    local count
    "$bin/povgloss" probe room.pov "$library" "${size[@]}" --quiet --grid 20 -o room.csv || return 1
    for count in 0 1 4 16; do
        render "rays$count.exr" --layers --rays "$count" || return 1
        "$bin/povgloss" compare room.csv "rays$count.exr" | tee "rays$count.txt" | grep rmse || return 1
    done
    awk '/^rmse/ { bad = bad || (before && $2 > before); first = first ? first : $2; before = $2 }
         END { exit bad || !(before < 0.5 * first) }' \
        rays0.txt rays1.txt rays4.txt rays16.txt
}
check 'render__more_rays__nearer_to_the_probes' error_falls

by_passes_file() {
    "$bin/povgloss" passes room.pov "$library" "${size[@]}" --quiet --rays 4 -o room.exr &&
        "$bin/glossfilter" room.exr --quiet --layers -o filtered.exr && cmp filtered.exr rays4.exr &&
        "$bin/glossfilter" --check room.exr | grep -q '^rays  *rays.R rays.G rays.B rays.A$'
}
check 'passes__rays__in_the_file' by_passes_file

joined_bands() {
    local rows
    for rows in '+SR1 +ER40' '+SR41 +ER72'; do
        # shellcheck disable=SC2086
        "$bin/povgloss" passes room.pov "$library" "${size[@]}" $rows --quiet --rays 4 -o "band${rows#*ER}.exr" || return 1
    done
    "$bin/glossfilter" band40.exr band72.exr --quiet --layers -o joined.exr && cmp joined.exr filtered.exr
}
check 'glossfilter__bands_with_rays__the_whole_picture' joined_bands

other_exponent() {
    run "$bin/glossfilter" room.exr --phong 50 -o other.exr
    expect_status 0 && expect_message 'were drawn for another exponent than 50' || return 1
    "$bin/povgloss" passes room.pov "$library" "${size[@]}" --quiet -o plain.exr &&
        "$bin/glossfilter" plain.exr --phong 50 --quiet -o without.exr && cmp other.exr without.exr
}
check 'glossfilter__another_exponent__rays_left_out_with_a_warning' other_exponent

own_exponent() {
    render own.exr --phong 50 --rays 1 && ! cmp -s own.exr other.exr
    render mirror.exr --phong inf && render mirror_rays.exr --phong inf --rays 1 && cmp mirror.exr mirror_rays.exr
}
check 'render__exponent_of_the_command_line__rays_of_it' own_exponent

frames() {
    "$bin/povgloss" render room.pov "$library" +W48 +H36 +KFF2 +KF1 --quiet --rays 2 -o frame.exr &&
        "$bin/povgloss" render room.pov "$library" +W48 +H36 Clock=1 --quiet --rays 2 -o second.exr &&
        cmp frame2.exr second.exr && ! cmp -s frame1.exr frame2.exr
}
check 'render__animation__rays_of_each_frame' frames

refused() { # MESSAGE COMMAND...
    local message=$1
    shift
    run "$@"
    expect_status 2 && expect_message "$message" && expect_nothing_left
}
check 'rays__subsampling__refused' refused 'leave out --subsample' \
    "$bin/povgloss" render room.pov +W96 +H72 --rays 1 --subsample 2 -o x.exr
check 'rays__exponent_0__refused' refused 'leave out --phong 0' \
    "$bin/povgloss" render room.pov +W96 +H72 --rays 1 --phong 0 -o x.exr
check 'rays__probe__refused' refused 'an option of povgloss render' "$bin/povgloss" probe room.pov --rays 1 -o x.csv
end_of_tests
