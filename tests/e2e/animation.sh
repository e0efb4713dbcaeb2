#!/usr/bin/env bash
# Animations: the frames that POV-Ray draws, under its own file names, with mirrors in place of the lobes its own
# pictures; .ini files; a frame that fails; going on after it.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
library=+L$root/povscenes
size=(+W64 +H48 -A)
# Everything that POV-Ray tells a frame is seen in its picture.
cat > scene.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <1, 2, -6> right x*4/3 angle 60 look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
background { rgb <0.2, 0.4, 0.8> }
#declare Told = array[6] { clock_delta, initial_clock/9, final_clock/19, frame_number/11, initial_frame/2, final_frame/12 }
plane { y, 0 pigment { rgb 0.3 } finish { reflection { 0.2, 0.7 } Gloss(80) } }
sphere { <2*clock - 1, 1, 0>, 1 pigment { rgb <0.9, 0.4*clock_on, 0.1> } finish { reflection 0.3 Gloss(20) } }
#for (I, 0, 5)
  cylinder { <I - 3, 0, 3>, <I - 3, 0.1 + 3*mod(Told[I], 1), 3>, 0.3 pigment { rgb 0.9 } finish { emission 0.5 } }
#end
POV

# animation_is_povrays SWITCH...: both draw it; names, number and pictures of the files are the same.
animation_is_povrays() {
    local file
    rm -rf truth ours
    mkdir truth ours
    povray +Iscene.pov "$library" "${size[@]}" -D +FE +Otruth/my.image.exr "$@" > povray.log 2>&1 ||
        { tail -5 povray.log; return 1; }
    "$bin/povgloss" passes scene.pov "$library" "${size[@]}" --quiet -o ours/my.image.exr "$@" || return 1
    diff <(ls -A truth) <(ls -A ours) || return 1
    for file in truth/*; do
        "$bin/glossfilter" "ours/${file#truth/}" --phong inf -o mirror.exr && same_picture "$file" mirror.exr || return 1
    done
    expect_nothing_left
}
check "three frames" animation_is_povrays +KFI1 +KFF3
check "frames from 0, with a clock of their own" animation_is_povrays +KFI0 +KFF1 +KI2 +KF9.5
check "a subset of ten frames" animation_is_povrays +KFF10 +SF9
check "a cyclic animation, whose numbers have a digit more" animation_is_povrays +KFF9 +KC +SF8
check "every fifth frame, from a share of them on" animation_is_povrays +KFF11 Subset_Start_Frame=0.4 Frame_Step=5
check "no animation, but a clock" animation_is_povrays +K0.7
check "from frame 1 to 1: no animation" animation_is_povrays +KFI1 +KFF1 +K0.2

# ---- .ini files

mkdir elsewhere
cp scene.pov "elsewhere/the scene.pov"
cat > movie.ini << 'INI'
; an animation
Input_File_Name="the scene.pov" ; found in the library folder
Library_Path=elsewhere
Antialias = Off
Output_File_Type=T
Output_File_Name=nowhere/x.tga
Final_Frame=9
+W640 +H480
[Small]
Width=64
Height=48
Subset_Start_Frame=2
Subset_End_Frame=3
Cyclic_Animation=on
[Large]
+W800
INI
ini_is_switches() {
    rm -rf ini switches
    mkdir ini switches
    "$bin/povgloss" passes "movie.ini[small]" "$library" --quiet -o ini/i.exr &&
        "$bin/povgloss" passes scene.pov "$library" "${size[@]}" +KFF9 +KC +SF2 +EF3 --quiet -o switches/i.exr &&
        [ "$(ls -A ini)" = "$(printf 'i02.exr\ni03.exr')" ] && diff -r ini switches && expect_nothing_left
}
check "an .ini file with sections that names the scene" ini_is_switches
povrays_own_ini() {
    printf 'Include_Ini="movie.ini[small]"\n' > own.ini
    mkdir own
    POVINI=own.ini "$bin/povgloss" passes "$library" +EF2 --quiet -o own/i.exr && [ "$(ls -A own)" = i02.exr ] &&
        cmp own/i02.exr switches/i02.exr
}
check "the .ini file that POV-Ray reads by itself, with another one in it" povrays_own_ini
command_line_wins() {
    "$bin/povgloss" render "movie.ini[small]" scene.pov "$library" -KC +KFF1 +SF1 +EF1 --quiet -o won.png &&
        [ -s won1.png ] && [ ! -e won01.png ]
}
check "switches after the .ini file win, and its scene is for want of another" command_line_wins
refused_in_ini() {
    printf '+W9\n%s\n' "$1" > refused.ini
    run "$bin/povgloss" render scene.pov "$library" refused.ini -o x.png
    expect_status 2 && expect_message "$1 can't be passed on to POV-Ray" && expect_one_line povgloss && expect_no_file x.png
}
check "a header in an .ini file" refused_in_ini Include_Header=head.inc
check "a shell command in an .ini file" refused_in_ini "Post_Scene_Command=ffmpeg -i out%02d.png"
no_section() {
    run "$bin/povgloss" render "movie.ini[none]" "$library" -o x.png
    expect_status 3 && expect_message "movie.ini: has no section [none]" && expect_one_line povgloss
}
check "a section that isn't there" no_section

# ---- one frame after the other

# The folders of the passes hold no images when a frame begins.
cat > counting-povray << SH
#!/bin/sh
ls | grep image >> "$scratch/leftovers"
exec $(command -v povray) "\$@"
SH
chmod +x counting-povray
no_images_pile_up() {
    : > leftovers
    "$bin/povgloss" render scene.pov "$library" "${size[@]}" +KFF2 --povray ./counting-povray --quiet -o piled.png &&
        [ -s piled2.png ] && [ ! -s leftovers ]
}
check "a frame's images go before the next frame" no_images_pile_up
from_stdin() {
    "$bin/povgloss" render - "$library" "${size[@]}" +KFF2 --quiet -o stdin.png < scene.pov &&
        cmp stdin1.png piled1.png && cmp stdin2.png piled2.png
}
check "a scene from standard input, for all frames" from_stdin
kept() {
    run "$bin/povgloss" render scene.pov "$library" "${size[@]}" +KFF2 --keep kept -o kept.png
    expect_status 0 &&
        [ "$(echo kept/base/image*)" = "kept/base/image1.exr kept/base/image2.exr" ] && [ -s kept/endpoint/image2.ppm ]
}
check "--keep leaves the images of all frames" kept
tells_frames() {
    [ "$(grep -c '^povgloss: frame [12]: rendering passes, 100 %$' "$scratch/err")" -eq 2 ] || { show_run; return 1; }
}
check "progress names the frame" tells_frames

# ---- a frame that fails

{
    cat scene.pov
    printf '#if (frame_number = 2 & !Healed) #error "the second frame is ill\\n" #end\n'
} > ill.pov
frames_of_ill() {
    run "$bin/povgloss" render ill.pov "$library" "${size[@]}" +KFF3 "Declare=Healed=$1" --quiet -o ill.png "${@:2}"
}
failing_frame() {
    frames_of_ill 0
    expect_status 4 && expect_message "povgloss: frame 2: ill.pov: " && expect_message "the second frame is ill" &&
        expect_nothing_left && [ "$(echo ill*.png)" = ill1.png ]
}
check "a failed frame is named, those before it stay, none follows" failing_frame
resumes() {
    cp ill1.png before.png
    touch -d 2001-01-01 ill1.png
    frames_of_ill 1 --resume
    expect_status 0 && expect_nothing_left && [ "$(echo ill*.png)" = "ill1.png ill2.png ill3.png" ] &&
        [ "$(stat -c %Y ill1.png)" -eq "$(date -d 2001-01-01 +%s)" ] && cmp ill1.png before.png || return 1
    frames_of_ill 0 --resume
    expect_status 0 && [ ! -s "$scratch/err" ]
}
check "--resume draws only what is missing" resumes
resumes_one() {
    printf 'a picture\n' > one.png
    run "$bin/povgloss" render scene.pov "$library" "${size[@]}" --resume -o one.png --povray /none
    expect_status 0 && [ "$(cat one.png)" = 'a picture' ]
}
check "--resume without an animation" resumes_one
cat > interrupting-povray << SH
#!/bin/sh
case "\$*" in *Subset_Start_Frame=2*) kill -INT \$PPID; exec sleep 60 ;; esac
exec $(command -v povray) "\$@"
SH
chmod +x interrupting-povray
interrupted() {
    run env --default-signal=INT "$bin/povgloss" render scene.pov "$library" "${size[@]}" +KFF3 --quiet -o stopped.png \
        --povray ./interrupting-povray
    expect_status 130 && expect_nothing_left && [ "$(echo stopped*)" = stopped1.png ]
}
check "an interrupt in the second frame" interrupted
one_stream() {
    local output
    for output in - /dev/null; do
        run "$bin/povgloss" render scene.pov "$library" "${size[@]}" +KFF3 --format png -o "$output"
        expect_status 2 && expect_message "takes one image, and the animation has 3" && expect_one_line povgloss || return 1
    done
    "$bin/povgloss" render scene.pov "$library" "${size[@]}" +KFF2 +SF2 --resume --quiet --format png -o - > stream.png &&
        cmp stream.png piled2.png
}
check "standard output takes one frame" one_stream

# ---- names

named() {
    local folder="names/$1" name="$1"
    mkdir -p "$folder/$name lib" "$folder/out"
    cp scene.pov "$folder/$name lib/$name.pov"
    printf 'Library_Path="%s lib"\nInput_File_Name="%s.pov"\n+W40 +H30\nFinal_Frame=10\n' "$name" "$name" > "$folder/$name.ini"
    (cd "$folder" && "$bin/povgloss" render "./$name.ini" "$library" +SF9 +EF9 --quiet -o "out/$name.png") &&
        [ "$(ls -A "$folder/out")" = "${name}09.png" ] && expect_nothing_left
}
for name in "two words, it's" 'Grüße=日本' '--dash [x] +plus; #'; do
    check "an .ini file, its scene and its folder named <$name>" named "$name"
done
end_of_tests
