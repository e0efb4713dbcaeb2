#!/usr/bin/env bash
# Forty scenes of povray-examples as they are (scripts/corpus.sh): with mirrors in place of the lobes each is POV-Ray's
# own picture, and those in which nothing reflects are so to the bit. In some of them positions and endpoints are as far
# away as POV-Ray's own fog says.
. tests/e2e/lib.sh

examples=/usr/share/doc/povray/examples
out=$scratch/corpus/160x120

# What the scene is, its name, and what it has that is hard.
sample() {
    cat << 'END'
base advanced_crater_crater_dat          height field
base advanced_landscape                  isosurface, texture_map
base camera_mesh_camera_ess_persp-camera mesh_camera
base incdemo_i_internal                  functions of functions.inc
base interior_media_galaxy               media with a density file
base interior_media_media4               media
base language_fileio_fileio              files
base language_trace2                     trace()
base portfolio_allpat1iso                isosurfaces of all patterns
base radiosity_rad_def_test_37           radiosity
mirror advanced_drums2_drums             metals
base advanced_mtmand                   height field, crand
mirror advanced_quilt1                   area light
mirror advanced_sunsethf                 water, filter
base animations_raddem_raddem          radiosity
mirror camera_cylinder1                  cylindrical camera
mirror camera_fisheye                    fisheye camera
mirror advanced_infinitybox              mirrors in mirrors
mirror incdemo_metals_golds              golds.inc
base incdemo_stones_stones1            stones1.inc, layers
base incdemo_woods_wood_7              woods.inc, layers
base interior_magglass                 glass
base interior_nufog2                   fog
base interior_media_media2             media in glass
base lights_soft                       area light
mirror objects_csg_cliptst2              clipped_by
mirror objects_sor1                      sor
base radiosity_radiosity_37            radiosity
mirror textures_normals_norm_acc         normals
mirror textures_patterns_fractals1       julia_fractal
mirror objectmods_no_image               fonts, no_image
base objects_chesmsh                   meshes
base objects_csg_hfclip                clipped height field
mirror objects_mesh2                     mesh2
base portfolio_allobjects              every kind of object
mirror templates_Basic_Scenes_Sea_blue_sky fog
base textures_interior_texture         interior_texture
base textures_pigments_txtrmap         texture_map
mirror camera_mesh_camera_baking_demo    a mesh2 with a texture_list
mirror camera_mesh_camera_meshcam_stereo_demo an #include by a computed name
END
}

verdict() {
    local name=$1 expected=$2 mode verdict what
    [ -s "$out/$name/all=300.verdict" ] || fail "no scene of this name: is povray-examples installed?" || return
    for mode in all=300 auto; do
        [ -e "$out/$name/$mode.verdict" ] || continue
        IFS=$'\t' read -r _ _ _ verdict what _ < "$out/$name/$mode.verdict"
        case $expected:$mode:$verdict in
            base:all=300:ok | mirror:all=300:ok) [[ $what = "$expected"* ]] ;;
            mirror:auto:ok) ;;
            *) false ;;
        esac || { cat "$out/$name/$mode.verdict"; return 1; }
    done
}

# agrees NAME DISTANCE: two passes files of the scene under a white and a black fog in which DISTANCE is well inside.
agrees() {
    local scene=$examples/$1.pov file=$scratch/${1##*/} colour
    for colour in 1 0; do
        printf '\nglobal_settings { max_trace_level 2 }\nfog { distance %s rgb %s }\n' "$2" "$colour" |
            cat "$scene" - > "$file$colour.pov"
        "$bin/povgloss" passes "$file$colour.pov" "+L$(dirname "$scene")" +W160 +H120 -A --gloss all=300 --quiet \
            -o "$file$colour.exr" || return
    done
    "${TOOLS:-build/tests/tools}/compare_depths" "$file"{1,0}.exr "$2" 0.002
}

names=$(sample | awk '{ printf "%s%s", separator, $2; separator = "|" }')
OUT=$scratch/corpus BIN=$bin ONLY="^($names)$" scripts/corpus.sh "$examples" 160x120 > "$scratch/log" 2>&1
while read -r expected name _; do
    check "${name}__$expected" verdict "$name" "$expected"
done < <(sample)

while read -r name distance; do
    check "${name##*/}__positions_and_endpoints__agree_with_fog" agrees "$name" "$distance"
done << 'END'
animations/reflection/reflection 4.7
advanced/sombrero 2.2
camera/fisheye 7.4
camera/perspective 31
camera/spherical 12
objects/csg/granite 4
objects/mesh2 31
objects/prism1 190
END
end_of_tests
