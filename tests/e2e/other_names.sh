#!/usr/bin/env bash
# Passes as other renderers write them: their names, --map, parts, half floats and windows. And glossfilter --check.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
glossfilter=$bin/glossfilter
"$bin/povgloss" passes "$root/povscenes/contact.pov" "+L$root/povscenes" +W120 +H90 -A --quiet -o own.exr
"$glossfilter" own.exr -o own_picture.exr
chmod a-w own.exr
own=R,G,B,specular.R,specular.G,specular.B,reflectance.R,reflectance.G,reflectance.B,P.X,P.Y,P.Z
own=$own,endpoint.X,endpoint.Y,endpoint.Z,endpoint.W,phong.V

# renamed NAMES FILE: the same channels under other names.
renamed() {
    oiiotool own.exr --ch "$own" --chnames "$1" -d float -o "$2"
}

# gives_the_same FILE OPTION...: the picture is that of our own names, to the last bit.
gives_the_same() {
    run "$glossfilter" "$@" -o picture.exr
    expect_status 0 && cmp picture.exr own_picture.exr
}

colours() {
    printf '%s.R,%s.G,%s.B' "$1" "$1" "$1"
}
vector() {
    printf '%s.X,%s.Y,%s.Z' "$1" "$1" "$1"
}
endpoint=endpoint.X,endpoint.Y,endpoint.Z,endpoint.W

blender=$(colours ViewLayer.base),$(colours ViewLayer.specular),$(colours ViewLayer.GlossCol)
blender=$blender,$(vector ViewLayer.Position),$(colours ViewLayer.endpoint),ViewLayer.endpoint.A,ViewLayer.phong.X
renamed "$blender" blender.exr
check "blender__names_of_layers_and_passes__same_picture" gives_the_same blender.exr

vray=R,G,B,$(colours vrayRE_Raw_Reflection),$(colours vrayRE_Reflection_Filter),$(colours 'World Position')
vray=$vray,$endpoint,phong.V
renamed "$vray" vray.exr
check "vray__raw_reflection_and_its_filter__same_picture" gives_the_same vray.exr

renderman=R,G,B,$(colours specular),$(colours reflectance),__Pworld.r,__Pworld.g,__Pworld.b,$endpoint,phong.V
renamed "$renderman" renderman.exr
check "renderman__lower_case_components__same_picture" gives_the_same renderman.exr

arnold=R,G,B,$(colours specular),$(colours specular_albedo),$(vector P),$endpoint,phong.Y
renamed "$arnold" arnold.exr
check "arnold__specular_albedo__same_picture" gives_the_same arnold.exr

odd=a1,a2,a3,$(colours b.c),x.R,x.G,x.B,$(vector 'my pos'),e1,e2,e3,e4,power
renamed "$odd" odd.exr
maps=(--map R=a1 --map G=a2 --map=B=a3 --map specular=b.c --map reflectance=x --map 'P=my pos' --map endpoint.X=e1
    --map endpoint.Y=e2 --map endpoint.Z=e3 --map endpoint.W=e4 --map phong=power)
check "map__every_channel__same_picture" gives_the_same odd.exr "${maps[@]}"
check "map__the_last_one__wins" gives_the_same own.exr --map R=G --map R=R

fails() {
    local status=$1 message=$2
    shift 2
    run "$glossfilter" "$@"
    expect_status "$status" && expect_message "$message" && expect_one_line glossfilter
}
check "map__a_name_that_is_not_there__refused" fails 3 "has no channel nowhere" own.exr --map P.X=nowhere -o x.exr
check "map__a_layer_without_all_channels__refused" \
    fails 3 "no layer specular with 4" own.exr --map endpoint=specular -o x.exr
for wrong in P =P P= P.W=x Q=x p=x; do
    check "map__${wrong}__refused" fails 2 "--map $wrong: must be CHANNEL=NAME" own.exr --map "$wrong" -o x.exr
done
check "missing__specular__cure" fails 3 "--map specular.R=NAME" odd.exr -o x.exr

oiiotool blender.exr --ch ViewLayer.Position.X,ViewLayer.Position.Y,ViewLayer.Position.Z \
    --chnames "$(vector Other.position)" -d float -o second.exr
oiiotool blender.exr second.exr --chappend -d float -o two.exr
check "alias__two_layers__refused" \
    fails 3 "Other.position.X and ViewLayer.Position.X could both be P; say which: --map 'P=ViewLayer.Position'" \
    two.exr -o x.exr
check "alias__two_layers__the_cure_works" gives_the_same two.exr --map P=ViewLayer.Position

# One part for each pass, as Blender 5 and Nuke write them, with and without the layer in the channels' names.
groups=("R,G,B" "$(colours specular)" "$(colours reflectance)" "$(vector P)" "$endpoint" phong.V)
# parts NAMES CHANNELS: each a list with one word for each group.
parts() {
    local names channels inputs=() i
    read -ra names <<< "$1"
    read -ra channels <<< "$2"
    for i in 0 1 2 3 4 5; do
        oiiotool own.exr --ch "${groups[i]}" --chnames "${channels[i]}" -d float -o "part$i.exr"
        inputs+=("part$i.exr::${names[i]}")
    done
    exrmultipart -combine -i "${inputs[@]}" -override 1 -o parts.exr > /dev/null && gives_the_same parts.exr
}
check "parts__full_names__same_picture" parts 'rgba specular reflectance P endpoint phong' "${groups[*]}"
check "parts__names_in_the_parts_alone__same_picture" \
    parts 'rgba View.specular View.GlossCol View.Position View.endpoint View.phong' 'R,G,B R,G,B R,G,B X,Y,Z X,Y,Z,W V'

# Half floats are coarse, but they are read: colours and exponents of this scene survive.
half() {
    oiiotool own.exr -d float -d R=half -d G=half -d B=half -d phong.V=half -o half.exr
    run "$glossfilter" half.exr -o picture.exr
    expect_status 0 && oiiotool --fail 0.001 --diff picture.exr own_picture.exr
}
check "half__some_channels__read" half

# The data window wider than the picture: a margin, which the blur sees and the picture leaves out.
angle=$(oiiotool --info -v own.exr | awk '/povgloss:viewAngle/ { printf "%.9g", $2 * 100 / 120 }')
overscan() {
    oiiotool own.exr --fullsize 100x80+10+5 --attrib:type=float povgloss:viewAngle "$angle" -o overscan.exr
    run "$glossfilter" overscan.exr --layers -o picture.exr
    expect_status 0 || return 1
    "$glossfilter" own.exr --layers -o layers.exr
    oiiotool layers.exr --cut 100x80+10+5 -o cut.exr
    oiiotool --fail 1e-4 --diff picture.exr cut.exr
}
check "overscan__wider_data_window__in_the_blur_not_in_the_picture" overscan
subwindow() {
    oiiotool own.exr --crop 60x40+20+30 -o sub.exr
    run "$glossfilter" sub.exr --phong inf -o picture.exr
    expect_status 0 || return 1
    "$glossfilter" own.exr --phong inf -o mirror.exr
    oiiotool mirror.exr --cut 60x40+20+30 --origin +20+30 --fullsize 120x90 --croptofull -o wanted.exr
    oiiotool --diff picture.exr wanted.exr && oiiotool --info picture.exr | grep -q '120 x *90'
}
check "subwindow__smaller_data_window__black_around_it" subwindow

# ---- --check

# reports STATUS TEXT ARGUMENT...: the report, on standard output, has TEXT.
reports() {
    local status_wanted=$1 text=$2
    shift 2
    run "$glossfilter" --check "$@"
    expect_status "$status_wanted" || return 1
    grep -qF -e "$text" "$scratch/out" || { cat "$scratch/out"; return 1; }
    [ "$status" -eq 0 ] || grep -q 'wrong with these passes' "$scratch/err"
}
nothing_wrong() {
    reports 0 "glossy  " "$@" && ! grep -E '^(wrong|note)|issing' "$scratch/out"
}
check "check__our_own_passes__nothing_wrong" nothing_wrong own.exr
check "check__aliases__told" \
    reports 0 "P            ViewLayer.Position.X ViewLayer.Position.Y ViewLayer.Position.Z" blender.exr
check "check__map__told" reports 0 "specular     b.c.R b.c.G b.c.B" odd.exr "${maps[@]}"
check "check__standard_input__read" nothing_wrong - < own.exr
check "check__required_ones_missing__told" \
    reports 3 "P            MISSING: P.X (the position of the visible point)" odd.exr
check "check__what_is_not_used__told" reports 3 "not used     a1 a2 a3 b.c.B" odd.exr
check "check__an_output__refused" fails 2 "leave out -o" --check own.exr -o x.exr
check "check__no_file__refused" fails 3 "none.exr" --check none.exr

# spoiled CHANNEL EXPRESSION...: oiiotool's commands on one channel, the others as they are.
spoiled() {
    local channel=$1 rest
    shift
    rest=$(tr ',' '\n' <<< "$own" | grep -vxF "$channel" | paste -sd,)
    oiiotool own.exr --ch "$channel" "$@" -o spoiled_channel.exr
    oiiotool own.exr --ch "$rest" spoiled_channel.exr --chappend --ch "$own" -d float -o spoiled.exr
}
spoils() {
    local status_wanted=$1 text=$2
    shift 2
    spoiled "$@" && reports "$status_wanted" "$text" spoiled.exr
}
without() {
    local text=$1 pattern=$2
    oiiotool own.exr --ch "$(tr ',' '\n' <<< "$own" | grep -v "$pattern" | paste -sd,)" -d float -o less.exr
    reports 0 "$text" less.exr
}
check "check__no_base__consequence" without "base         missing: it counts as black" '^.$'
check "check__no_reflectance__consequence" without "reflectance  missing: it counts as 1" reflectance
check "check__no_exponent__consequence" without "phong        missing: say it with --phong" phong
check "check__positions_not_finite__told" spoils 3 "have no finite position (P)" P.X --addc 1e38 --mulc 1e38
check "check__endpoints_not_finite__told" spoils 3 "have no finite endpoint" endpoint.Z --addc 1e9 --mulc 1e38
check "check__radiance_not_finite__told" \
    spoils 3 "have no finite specular radiance" specular.G --addc 1 --mulc 1e38 --mulc 1e38
check "check__exponents_below_0__told" spoils 3 "have an exponent below 0 or NaN" phong.V --subc 1
check "check__w_below_0__told" spoils 3 "whose W is below 0" endpoint.W --mulc -1
check "check__nothing_glossy__told" spoils 3 "nothing is glossy" phong.V --mulc 0
check "check__positions_of_another_space__told" spoils 3 "off the ray through their pixel's centre" P.X --addc 3
# warns TEXT CHANNEL EXPRESSION...: filtering says it in one line, unless it is asked to be quiet.
warns() {
    local text=$1
    shift
    spoiled "$@"
    run "$glossfilter" spoiled.exr -o x.exr
    expect_status 0 && expect_message "$text" && expect_one_line glossfilter || return 1
    run "$glossfilter" spoiled.exr --quiet -o x.exr
    [ ! -s "$scratch/err" ]
}
glossy_pixels=$("$glossfilter" --check own.exr | awk '$1 == "glossy" { print $2 }')
check "filter__radiance_not_finite__counted" warns "spoiled.exr: $glossy_pixels glossy pixels are left out" \
    specular.G --addc 1 --mulc 1e38 --mulc 1e38
check "filter__base_not_finite__counted" warns "spoiled.exr: base or reflectance isn't finite at " \
    G --addc 1 --mulc 1e38 --mulc 1e38
long_directions() {
    oiiotool own.exr --ch "$endpoint" --mulc 3,3,3,1 -o long.exr
    oiiotool own.exr --ch "${own%%,endpoint*}",phong.V long.exr --chappend --ch "$own" -d float -o spoiled.exr
    run "$glossfilter" --check spoiled.exr
    grep -q '^note: .* a direction (W 0) whose length is not 1' "$scratch/out"
}
check "check__directions_of_any_length__note" long_directions
zero() {
    oiiotool own.exr --ch "$(vector P)" --mulc 0 -o zero.exr
    oiiotool own.exr zero.exr --chappend --ch "${own%%,P.X*},20,21,22,$endpoint,phong.V" --chnames "$own" -d float \
        -o spoiled.exr
    reports 3 "have the position 0, 0, 0" spoiled.exr
}
check "check__positions_never_written__told" zero
touching() {
    oiiotool own.exr --ch P.X,P.Y,P.Z -o p.exr
    oiiotool own.exr --ch endpoint.W --mulc 0 --addc 1 -o one.exr
    oiiotool own.exr --ch "${own%%,endpoint*}",phong.V p.exr --chappend one.exr --chappend \
        --ch 0,1,2,3,4,5,6,7,8,9,10,11,13,14,15,16,12 --chnames "$own" -d float -o spoiled.exr
    reports 3 "that end where they begin" spoiled.exr
}
check "check__rays_that_end_where_they_begin__told" touching

"$bin/povgloss" passes "$root/povscenes/metal.pov" "+L$root/povscenes" +W480 +H360 -A --quiet -o large.exr
oiiotool large.exr --resize:filter=box 160x120 -d float -o averaged.exr
check "check__averaged_w__told" reports 3 "whose W is neither 0 nor 1" averaged.exr
check "check__averaged_positions__told" \
    reports 3 "of the silhouettes the position (P) lies between near and far" averaged.exr
check "check__averaged_endpoints__told" \
    reports 3 "of the silhouettes the endpoint lies between near and far" averaged.exr
oiiotool large.exr -d half -o half.exr
check "check__half_positions__told" reports 3 "half floats" half.exr
end_of_tests
