#!/usr/bin/env bash
# What the driver promises of a scene however it is written: see lib_scenes.sh.
. tests/e2e/lib_scenes.sh

# ---- where the finish stands

scene "finish in the object" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "Gloss before reflection" << 'POV'
object { Floor pigment { rgb 0.3 } finish { Gloss(100) reflection 0.5 diffuse 0.3 } }
POV
scene "transformed object and texture" << 'POV'
object {
  Floor
  texture { pigment { checker rgb 0.3 rgb <0.5, 0.2, 0.1> } finish { reflection 0.5 Gloss(100) } rotate y*30 scale 0.7 }
  rotate <4, 20, -3> scale <1, 2, 0.8> translate <0.2, -0.1, 0>
}
POV
scene "union whose parts inherit the texture, one has its own" << 'POV'
union {
  object { Floor }
  box { <-2, 0, -1>, <-1, 0.5, 0> pigment { rgb <0.9, 0.7, 0.1> } }
  object { Ball translate x*0.6 }
  pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) }
  rotate y*15
}
POV
scene "nested unions with textures at several levels" << 'POV'
union {
  union {
    object { Ball translate x texture { pigment { rgb 0.1 } finish { reflection 0.6 Gloss(50) } } }
    box { <-1.5, 0, -1>, <-0.5, 0.7, 0> }
    texture { pigment { rgb <0.8, 0.3, 0.1> } finish { diffuse 0.7 } }
  }
  object { Floor }
  texture { pigment { rgb 0.2 } finish { reflection 0.4 Gloss(50) } }
}
POV
scene "difference and intersection, cut away by other textures" << 'POV'
difference {
  object { Floor texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } } }
  box { <-0.7, -0.06, -2>, <0.7, 0.2, 0> pigment { rgb <0.9, 0.8, 0.2> } }
}
intersection {
  object { Ball } box { <-1, 0, -1.5>, <1, 1.4, 0.5> }
  texture { pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
  translate x*1.2
}
POV
scene "difference with cutaway_textures" << 'POV'
object { Floor pigment { rgb 0.5 } finish { diffuse 0.6 } }
difference {
  object { Ball texture { pigment { rgb 0.1 } finish { reflection 0.6 Gloss(100) } } }
  box { <-2, 0.9, -2>, <0, 3, 2> }
  cutaway_textures
}
POV
scene "declared texture, finish, object and material" << 'POV'
#declare F = finish { reflection 0.5 Gloss(100) }
#declare T = texture { pigment { rgb 0.2 } finish { F } }
#declare M = material { texture { T } interior { ior 1.5 } }
#declare O = object { Ball texture { T } }
object { Floor material { M } }
object { O translate x*1.2 }
object { O scale 0.6 translate x*(-0.8) }
POV
scene "finish declared glossy, used with another reflection" << 'POV'
#declare F = finish { reflection 0.1 Gloss(100) }
object { Floor pigment { rgb 0.2 } finish { F reflection 0.6 } }
POV
scene "finish of a texture from metals.inc" << 'POV'
#include "metals.inc"
object { Floor texture { T_Chrome_1A finish { Gloss(60) } } }
object { Ball texture { T_Brass_3C } translate x }
POV
scene "texture given a further finish" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { diffuse 0.3 reflection 0.5 } }
object { Floor texture { T finish { Gloss(80) } } }
POV
scene "#default finish" << 'POV'
#default { finish { ambient 0.05 diffuse 0.4 reflection 0.35 Gloss(100) } }
object { Floor pigment { rgb 0.3 } }
object { Ball texture { pigment { rgb <0.4, 0.1, 0.1> } } translate x }
POV
scene "#default finish without gloss" << 'POV'
#default { finish { ambient 0.3 diffuse 0.4 } pigment { rgb <0.2, 0.5, 0.4> } }
object { Floor finish { reflection 0.5 Gloss(100) } }
object { Ball }
POV
scene "interior_texture" << 'POV'
object { Floor pigment { rgb 0.4 } }
difference {
  object { Ball }
  box { <-2, 1.1, -2>, <2, 3, 2> }
  hollow
  texture { pigment { rgb <0.5, 0.2, 0.1> } finish { reflection 0.5 Gloss(100) } }
  interior_texture { pigment { rgb 0.8 } finish { diffuse 0.7 } }
}
POV

# ---- the scene language

scene "macro with the exponent, macro with the finish, macro with the texture" << 'POV'
#macro Thing(Where, P) object { Ball scale 0.7 translate Where pigment { rgb 0.2 } finish { reflection 0.5 Gloss(P) } } #end
#macro With_Finish(F) object { Floor pigment { rgb 0.3 } finish { F } } #end
#macro With_Texture(T) object { Ball scale 0.6 translate <-1.2, 0, -1> texture { T } } #end
Thing(<1.2, 0, 0>, 200)
Thing(<0, 0, 0.5>, 30)
With_Finish(finish { reflection 0.4 Gloss(50) })
With_Texture(texture { pigment { rgb 0.1 } finish { reflection 0.4 Gloss(50) } })
POV
scene "Gloss in a macro inside a finish" << 'POV'
#macro Polish(Amount) reflection Amount Gloss(150) #end
object { Floor pigment { rgb 0.3 } finish { diffuse 0.4 Polish(0.5) } }
POV
scene "macro that makes a whole finish" << 'POV'
#macro Polished(Amount) finish { diffuse 0.4 reflection Amount Gloss(150) } #end
object { Floor pigment { rgb 0.3 } Polished(0.5) }
POV
scene "macro that is a finish's value" << 'POV'
#macro Polished(Amount) finish { diffuse 0.4 reflection Amount Gloss(150) } #end
#declare F = Polished(0.5)
object { Floor pigment { rgb 0.3 } finish { F } }
POV
scene "#local, names declared anew, #undef" << 'POV'
#macro Place(At)
  #local T = texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
  object { Ball scale 0.7 translate At texture { T } }
#end
#declare T = texture { pigment { rgb <0.8, 0.6, 0.1> } }
#declare Thing = object { Floor texture { T } }
Place(x)
#declare T = texture { pigment { rgb 0.1 } finish { reflection 0.4 Gloss(100) } }
Place(-x)
object { Thing }
#undef T
POV
scene "comments and strings with braces" << 'POV'
// finish { reflection 1 Gloss(1) }
/* texture { /* nested */ finish { */
#declare S = "finish { Gloss(3) } \" }";
object { Floor pigment { rgb 0.3 } finish /* { */ { reflection // }
  0.5 Gloss(100) } }
POV
scene "Gloss_Roughness" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss_Roughness(0.25) } }
POV

# ---- textures and finishes

scene "layered textures, the upper one glossy" << 'POV'
object {
  Floor
  texture { pigment { checker rgb 0.6 rgb <0.2, 0.4, 0.6> } finish { diffuse 0.7 } }
  texture { pigment { rgbt <1, 0.9, 0.8, 0.7> } finish { reflection 0.4 Gloss(100) } }
}
POV
scene "texture_map with a glossy entry, without transitions" << 'POV'
object {
  Floor
  texture {
    gradient x scale 2
    texture_map {
      [0.5 pigment { rgb <0.8, 0.6, 0.2> } finish { diffuse 0.7 }]
      [0.5 pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }]
    }
  }
}
POV
scene "checkered textures, one glossy, one a plain mirror" << 'POV'
object {
  Floor
  texture {
    checker
    texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
    texture { pigment { rgb <0.4, 0.1, 0.1> } finish { reflection 0.3 } }
  }
}
POV
scene "reflection with fresnel, metallic and a range" << 'POV'
object {
  Floor
  pigment { checker rgb <0.9, 0.6, 0.2> rgb <0.3, 0.7, 0.9> }
  finish { diffuse 0.3 reflection { 0.1, 0.9 fresnel metallic } Gloss(100) }
  interior { ior 1.5 }
}
POV
scene "reflection with falloff" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection { 0.1, 0.8 falloff 3 } Gloss(100) } }
POV
scene "coloured, metallic reflection of a patterned pigment" << 'POV'
object {
  Floor
  pigment { bozo color_map { [0 rgb <1, 0.5, 0.1>] [1 rgb <0.1, 0.4, 1>] } scale 0.6 }
  finish { diffuse 0.2 metallic specular 0.4 reflection { rgb <0.9, 0.7, 0.5> metallic 0.8 } Gloss(100) }
}
POV
scene "conserve_energy" << 'POV'
object {
  Floor
  pigment { rgb <0.7, 0.5, 0.3> }
  finish { diffuse 0.8 reflection { 0, 0.8 fresnel } conserve_energy Gloss(100) }
  interior { ior 1.5 }
}
POV
scene "bump normals" << 'POV'
object {
  Floor
  pigment { rgb 0.2 }
  normal { bumps 0.15 scale 0.4 }
  finish { reflection 0.6 Gloss(100) }
}
POV
scene "highlights of a glossy finish" << 'POV'
object { Ball pigment { rgb <0.5, 0.1, 0.1> } finish { phong 0.8 phong_size 30 specular 0.3 reflection 0.4 Gloss(100) } }
object { Floor pigment { rgb 0.4 } }
POV

# ---- what sees what

scene "glossy surfaces seen in each other" << 'POV'
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x pigment { rgb <0.3, 0.1, 0.1> } finish { reflection 0.4 Gloss(100) } }
POV
scene "glossy surface seen in a plain mirror" << 'POV'
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate <0.9, 0, 0> pigment { rgb 0.05 } finish { reflection 0.8 } }
POV
scene "a lamp with looks_like" << 'POV'
light_source {
  <0.8, 1.6, 0.8> rgb 0.6 fade_distance 2 fade_power 2
  looks_like { sphere { 0, 0.25 pigment { rgb 1 } finish { emission <1.2, 1, 0.6> ambient 0 } } }
}
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "light_group" << 'POV'
light_group {
  light_source { <3, 3, -3> rgb <0.9, 0.3, 0.1> }
  object { Ball translate x pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } }
  global_lights off
}
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "no_shadow, no_image and no_reflection of the scene's own" << 'POV'
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x pigment { rgb <0.8, 0.5, 0.1> } no_reflection }
object { Ball translate -x pigment { rgb <0.1, 0.5, 0.8> } no_image }
object { Ball scale 0.4 translate <0, 0, -1> pigment { rgb 0.9 } no_shadow }
POV

# ---- camera, colours, version

whole_scene "assumed_gamma 2.2" << 'POV'
#version 3.7;
global_settings { assumed_gamma 2.2 }
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "assumed_gamma srgb" << 'POV'
#version 3.7;
global_settings { assumed_gamma srgb }
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection { 0.2, 0.7 } Gloss(100) } }
POV
whole_scene "#version 3.5" << 'POV'
#version 3.5;
global_settings { assumed_gamma 1.0 }
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { ambient 0.1 reflection 0.5 Gloss(100) } }
POV
whole_scene "#version 3.7 without assumed_gamma" << 'POV'
#version 3.7;
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "a comment and an include before #version" << 'POV'
// A scene.
#include "colors.inc"
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 ambient_light rgb 0.8 }
#include "stage.inc"
object { Floor pigment { Red*0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "background in place of the sky" << 'POV'
background { rgb <0.3, 0.5, 0.7> }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV

# ---- what only POV-Ray knows: names of includes and the working space

mkdir "$folder/parts" "$folder/parts/deep"
cat > "$folder/parts/ball1.inc" << 'POV'
#include concat("parts/deep/", "floor.inc")
object { Ball translate x*0.7 pigment { rgb <0.2, 0.3, 0.9> } finish { reflection 0.4 Gloss(100) } }
POV
sed 's/x\*0.7/x*(-1.2)/; s/Gloss(100)//' "$folder/parts/ball1.inc" > "$folder/parts/ball2.inc"
echo 'object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(50) } }' > "$folder/parts/deep/floor.inc"
scene "includes by computed names, one in another" << 'POV'
#macro Never(Name) #include Undeclared #end
#for (I, 1, 2) #include concat("parts/ball", str(I, 0, 0), ".inc") #end
POV
scene "includes by absolute names and by names with dots" << POV
#declare Part = "$folder/parts/deep/floor.inc"
#include Part
#declare Part = "parts/../parts/deep/../ball1.inc"
#macro Include(Which, Name) #if (Which) #include Name #end #end
Include(no, "none.inc")
Include(yes, Part)
POV
scene "an include on the right of #declare" << 'POV'
#declare Name = array[1] { "parts/ball1.inc" }
#declare Both = union { #include Name[0] }
object { Both }
POV
echo '#declare Glass = pigment { rgbt <0.9, 1, 0.9, 0.7> }' > "$folder/parts/glass.inc"
scene "a transparent pigment from an include by a computed name" << 'POV'
#include concat("parts/", "glass.inc")
object { Ball translate -z pigment { Glass } }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "a file that the scene writes and includes" << 'POV'
#fopen F "own file.inc" write
#write (F, "object { Ball pigment { rgb 0.2 } finish { reflection 0.4 Gloss(60) } }\n")
#fclose F
#include "own file.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
echo 'sphere { 0, 3 }' > "$folder/older.inc"
scene "an older file of the name that the scene writes" << 'POV'
#fopen F "older.inc" write
#write (F, "object { Ball pigment { rgb 0.2 } finish { reflection 0.4 Gloss(60) } }\n")
#fclose F
#include "older.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "strings that are parsed (strings.inc)" << 'POV'
#include "strings.inc"
#declare Grey = 0.2;
#declare Bright = 0.7;
object { Ball pigment { rgb Parse_String("Grey") } finish { reflection 0.4 Gloss(60) } }
object { Floor pigment { rgb Parse_String("Bright*0.5") } finish { reflection 0.5 Gloss(100) } }
POV
scene "a file that is written once, if it isn't there, and included again and again" << 'POV'
#macro Part(Name, Where)
  #if (!file_exists(Name))
    #fopen F concat(Name) write
    #write (F, "#declare Part_Object = object { Ball scale 0.6 pigment { rgb 0.2 } finish { reflection 0.4 Gloss(60) } }\n")
    #fclose F
  #end
  #include Name
  object { Part_Object translate Where }
#end
Part("part-1.inc", -1.5*x)
Part("part-1.inc", 0)
Part("part-2.inc", 1.5*x)
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "meshes by meshmaker.inc, which may be read from files" << 'POV'
#include "meshmaker.inc"
#declare Fx = function (u, v) { u }
#declare Fy = function (u, v) { 0.6 + 0.3*sin(3*u)*cos(3*v) }
#declare Fz = function (u, v) { v }
object { Parametric(Fx, Fy, Fz, <-1, -1>, <1, 1>, 12, 12, "") pigment { rgb 0.2 } finish { reflection 0.3 Gloss(80) } }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "assumed_gamma by an expression" << 'POV'
#version 3.7;
#declare Display = 2.2;
global_settings { assumed_gamma (Display - 0.2)*1.1 max_trace_level 6 }
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "the second assumed_gamma counts: the first is never reached" << 'POV'
#version 3.7;
#macro Settings(Value) global_settings { assumed_gamma Value } #end
#if (no) global_settings { assumed_gamma 1.0 } #else global_settings { assumed_gamma srgb } #end
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection { 0.2, 0.7 } Gloss(100) } }
POV
scene "#local in the scene itself" << 'POV'
#declare I = 0;
#while (I < 3)
  object { Ball scale 0.5 translate x*(I - 1) pigment { rgb 0.2 + 0.3*I } finish { reflection 0.4 Gloss(60) } }
  #local I = I + 1;
#end
object { Floor pigment { rgb 0.1*I } finish { reflection 0.5 Gloss(100) } }
POV

# ---- sizes and places

for scale in 1e-3 1e5; do
    whole_scene "everything scaled by $scale" << POV
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
#declare K = $scale;
camera { location <0, 2, -6>*K right x*4/3 angle 48 look_at y*0.8*K }
light_source { <-6, 9, -7>*K rgb 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [0.4 rgb <0.2, 0.35, 0.8>] } } }
box { <-4, -0.1, -3>*K, <4, 0, 3>*K pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
sphere { <0.5, 0.7, 0>*K, 0.7*K pigment { checker rgb <0.9, 0.3, 0.1> rgb 0.9 scale 0.3*K } }
sphere { <-1, 0.4, 0>*K, 0.4*K pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
POV
done

# ---- kinds of objects

scene "mesh and mesh2" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
#declare U = texture { pigment { rgb <0.7, 0.5, 0.1> } }
mesh {
  triangle { <-4, 0, -3>, <4, 0, -3>, <4, 0, 3> texture { T } }
  triangle { <-4, 0, -3>, <-4, 0, 3>, <4, 0, 3> texture { T } }
  smooth_triangle { <-1, 0, 0>, <-1, 0.2, -1>, <0, 0, 0>, <0.2, 0, -1>, <-0.5, 1, 0>, <0, 0.3, -1> texture { U } }
  smooth_triangle { <0, 0, 0>, <-1, 0.2, -1>, <1, 0, 0>, <0.2, 0, -1>, <0.5, 1, 0>, <0, 0.3, -1> }
  texture { T }
}
mesh2 {
  vertex_vectors { 4, <1, 0, -1>, <1.5, 0, -1.5>, <1.5, 0, -0.5>, <1.2, 0.8, -1> }
  face_indices { 3, <0, 1, 3>, <1, 2, 3>, <0, 2, 3> }
  texture { T }
}
POV
scene "blob" << 'POV'
blob {
  threshold 0.5
  sphere { <-0.5, 0.8, 0>, 1, 1 }
  cylinder { <0.3, 0.8, 0>, <1.3, 1, 0>, 0.8, 1 }
  pigment { rgb 0.1 } finish { reflection 0.6 Gloss(100) }
}
object { Floor pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } }
POV
scene "height field" << 'POV'
height_field {
  function 60, 60 { pattern { bozo scale 0.25 } }
  smooth translate <-0.5, 0, -0.5> scale <6, 0.5, 5>
  pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }
}
POV
scene "isosurface, parametric and function pigments" << 'POV'
#declare Wave = function (x, z) { 0.05*sin(5*x)*cos(4*z) }
isosurface {
  function { y - Wave(x, z) }
  contained_by { box { <-3, -0.3, -2>, <3, 0.3, 2> } } max_gradient 1.5
  pigment { function { abs(sin(3*x)) } color_map { [0 rgb 0.1] [1 rgb <0.4, 0.2, 0.1>] } }
  finish { reflection 0.6 Gloss(100) }
}
POV
scene "lathe, prism, torus, superellipsoid, cone, disc and plane" << 'POV'
#declare F = finish { reflection 0.5 Gloss(100) }
union {
  lathe { cubic_spline 6, <0, 0>, <0.4, 0>, <0.3, 0.5>, <0.5, 0.9>, <0.3, 1.2>, <0, 1.3> translate <-1.6, 0, 0> }
  prism { 0, 0.6, 4, <0, 0>, <0.6, 0>, <0.3, 0.6>, <0, 0> translate <-0.8, 0, -1> }
  torus { 0.4, 0.12 rotate x*70 translate <0, 0.5, 0> }
  superellipsoid { <0.3, 0.3> scale 0.35 translate <0.9, 0.4, -0.5> }
  cone { <1.7, 0, 0>, 0.4, <1.7, 0.9, 0>, 0.1 }
  pigment { rgb 0.15 } finish { F }
}
plane { y, 0 pigment { checker rgb 0.3 rgb 0.1 } finish { F } }
POV
scene "clipped_by and bounded_by" << 'POV'
object {
  Ball
  clipped_by { plane { y, 1.1 } }
  bounded_by { clipped_by }
  pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) }
}
box { <-3, -0.1, -2>, <3, 0, 2> clipped_by { cylinder { -y, y, 1.8 } } pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "bicubic_patch and disc" << 'POV'
bicubic_patch {
  type 1 flatness 0.01 u_steps 3 v_steps 3
  <-2, 0, -2> <-0.7, 0.3, -2> <0.7, 0, -2> <2, 0.2, -2> <-2, 0, -0.7> <-0.7, 0, -0.7> <0.7, 0.5, -0.7> <2, 0, -0.7>
  <-2, 0.2, 0.7> <-0.7, 0, 0.7> <0.7, 0, 0.7> <2, 0, 0.7> <-2, 0, 2> <-0.7, 0.2, 2> <0.7, 0, 2> <2, 0.3, 2>
  pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }
}
disc { <0, 0.8, 0.5>, <0.2, 0.3, -1>, 0.7 pigment { rgb <0.7, 0.3, 0.1> } finish { reflection 0.4 Gloss(100) } }
POV

# ---- side effects and order

scene "lamps made by a macro" << 'POV'
#macro Lamp(Where) light_source { Where rgb 0.3 looks_like { sphere { 0, 0.2 pigment { rgb 1 } finish { emission 1 } } } } #end
Lamp(<1, 1.5, 0>) Lamp(<-1, 1, 1>)
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "object declared glossy, used with another texture" << 'POV'
#declare Thing = union {
  object { Ball }
  object { Ball translate x*1.5 pigment { rgb x } }
  texture { pigment { rgb 0.1 } finish { reflection 0.5 Gloss(30) } }
}
object { Thing scale 0.6 }
object { Thing scale 0.6 translate x*(-2) texture { pigment { rgb <1, 0.8, 0> } } }
POV

scene "#if around Gloss and around the finish" << 'POV'
#declare Glossy = 1;
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 #if (Glossy) Gloss(100) #else diffuse 0 #end } }
object {
  Ball translate x
  #if (Glossy) texture { pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
  #else pigment { rgb 1 } #end
}
object { Ball scale 0.5 translate x*(-1) pigment { rgb 0.4 } finish { reflection 0.3 #if (!Glossy) Gloss(100) #end } }
POV
scene "seeded random numbers" << 'POV'
#declare R = seed(3);
#for (I, 0, 7)
  sphere { <3*rand(R) - 1.5, 0.3, 2*rand(R) - 1>, 0.3 pigment { rgb <rand(R), rand(R), rand(R)> } }
#end
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "declared lights, spotlight and area light" << 'POV'
#declare L = light_source { <2, 5, -2> rgb 0.4 spotlight point_at 0 radius 15 falloff 25 }
light_source { L }
object { L translate x*(-3) }
light_source { <-2, 4, 0> rgb 0.3 area_light x, z, 3, 3 adaptive 1 }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x pigment { rgb 0.7 } }
POV
whole_scene "declared camera" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare Own_Camera = 1;
#include "stage.inc"
#declare Eye = camera { location <2, 2.5, -5> right x*4/3 angle 50 look_at <0, 0.5, 0> }
camera { Eye }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "camera with transforms" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare Own_Camera = 1;
#include "stage.inc"
camera { location <0, 2, -6> right x*4/3 look_at <0, 0.7, 0> rotate y*20 translate <0.2, 0.1, 0> }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "orthographic camera" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare Own_Camera = 1;
#include "stage.inc"
camera { orthographic location <0, 3, -6> right x*6 up y*4.5 look_at <0, 0.7, 0> }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "fisheye camera" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare Own_Camera = 1;
#include "stage.inc"
camera { fisheye location <0, 2, -4> right x*4/3 angle 120 look_at <0, 0.4, 0> }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "neither version nor assumed_gamma" << 'POV'
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "far from the origin" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare Own_Camera = 1;
#include "stage.inc"
#declare Far = <3000, -2000, 5000>;
camera { location Far + <0, 2, -6> right x*4/3 angle 48 look_at Far + y*0.8 }
box { Far + <-4, -0.1, -3>, Far + <4, 0, 3> pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
sphere { Far + <0.5, 0.7, 0>, 0.7 pigment { checker rgb <0.9, 0.3, 0.1> rgb 0.9 scale 0.3 } }
sphere { Far + <-1, 0.4, 0>, 0.4 pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
POV
scene "arrays of pigments, finishes and textures" << 'POV'
#declare P = array[2] { pigment { rgb 1 }, pigment { rgb <0.4, 0.1, 0.1> } }
#declare F = array[2] { finish { diffuse 0.5 }, finish { reflection 0.2 } }
#declare T = array[2] { texture { P[0] finish { diffuse 0.4 } }, texture { pigment { rgb 0.1 } finish { reflection 0.3 } } }
object { Ball scale 0.5 translate <-1, 0, -1> pigment { P[1] } finish { F[1] } }
object { Ball scale 0.6 translate <1, 0, -1> texture { T[1] } }
object { Floor pigment { P[0] } finish { F[0] reflection 0.5 Gloss(100) } }
POV
scene "arrays with glossy elements" << 'POV'
#declare F = array[2]
#declare F[0] = finish { diffuse 0.3 }
#declare F[1] = finish { reflection 0.6 Gloss(400) }
#declare T = array[2]
#declare T[0] = texture { pigment { rgb <0.3, 0.1, 0.1> } finish { reflection 0.5 Gloss(50) } }
#declare T[1] = texture { pigment { rgb <0.1, 0.3, 0.1> } finish { F[0] } }
#for (I, 0, 1)
  object { Ball scale 0.7 translate x*(1.6*I - 0.8) texture { T[I] } }
#end
object { Floor pigment { rgb 0.3 } finish { F[1] } }
POV
scene "names and random numbers declared inside textures" << 'POV'
#declare R = seed(3);
#macro Colour() rgb <rand(R), rand(R), rand(R)> #end
sphere {
  <3*rand(R) - 1.5, 0.3, 0>, 0.3
  texture { pigment { Colour() } finish { diffuse 0.5 + 0.3*rand(R) } }
  normal { bumps rand(R) }
}
sphere { <3*rand(R) - 1.5, 0.3, 0>, 0.3 pigment { #local Size = 0.8; Colour() } scale Size }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "declared lamp with looks_like" << 'POV'
#declare L = light_source { <1, 1.5, 0> rgb 0.3 looks_like { sphere { 0, 0.2 pigment { rgb 1 } finish { emission 1 } } } }
light_source { L }
light_source { L translate x*(-2) }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "camera, sky and settings after the objects" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
background { rgb 0.5 }
object { Ball translate x pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
camera { location <0, 2, -6> right x*4/3 angle 50 look_at <0, 0.5, 0> }
global_settings { max_trace_level 7 }
object { Ball scale 0.4 translate -x pigment { rgb y } }
POV
scene "random numbers inside what a copy leaves out" << 'POV'
#declare S = seed(5);
#declare I = 0;
#while (I < 8)
  sphere {
    <4*rand(S) - 2, 0.3, 3*rand(S) - 1.5>, 0.3
    pigment { rgb rand(S) } finish { reflection 0.5 Gloss(100) }
  }
  #declare I = I + 1;
#end
object { Floor pigment { #local Grey = 0.3; rgb Grey } }
POV
scene "gloss in the lower of two layers" << 'POV'
object {
  Floor
  texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
  texture { pigment { checker rgbt <1, 0.2, 0.1, 0.5> rgbt 1 scale 0.7 } finish { diffuse 0.8 } }
}
object { Ball translate x pigment { rgb 0.7 } }
POV
end_of_scenes
