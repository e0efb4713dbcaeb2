#!/usr/bin/env bash
# Scenes with every kind of texture, finish, light and medium, on and around something glossy.
. tests/e2e/lib_scenes.sh

oiiotool --pattern checker:width=8:height=8:color1=0.9,0.2,0.1:color2=0.2,0.3,0.8 64x64 3 -d uint8 -o "$folder/map.png"
oiiotool --pattern fill:left=0,0,0,0.2:right=1,0.8,0.2,1 32x32 4 -d uint8 -o "$folder/alpha.png"
oiiotool --pattern checker:width=4:height=4 16x16 3 --resize 64x64 --ch R -d uint8 -o "$folder/grey.png"

# ---- pigments

scene "image_map, image_pattern and bump_map" << 'POV'
object { Floor pigment { image_map { png "map.png" interpolate 2 } rotate x*90 scale 2 }
  finish { diffuse 0.4 reflection 0.5 Gloss(100) } }
object { Ball translate x*1.1 pigment { image_pattern { png "grey.png" } color_map { [0 rgb <0.3, 0.1, 0>] [1 rgb 0.3]
  } }
  normal { bump_map { png "grey.png" bump_size 2 } } finish { reflection 0.4 Gloss(100) } }
object { Ball translate -x*1.1 pigment { image_map { png "map.png" map_type 1 } } finish { diffuse 0.7 } }
POV
scene "pigment_map, average, gradients of pigments" << 'POV'
#declare P = pigment { average pigment_map { [1 checker rgb 0.1 rgb 0.4] [2 gradient x color_map { [0 rgb x] [1 rgb z]
  }] } }
object { Floor pigment { gradient z scale 3 pigment_map { [0.3 P] [0.7 rgb 0.2] } }
  finish { diffuse 0.4 reflection { 0.5 metallic } Gloss(100) } }
object { Ball translate x pigment { checker pigment { P } pigment { rgb 0.1 } scale 0.3 }
  finish { reflection 0.4 Gloss(100) } }
POV
scene "a pigment as a function in an isosurface" << 'POV'
#declare Bumps = function { pigment { bozo color_map { [0 rgb 0] [1 rgb 1] } scale 0.5 } }
isosurface {
  function { y - 0.2*Bumps(x, y, z).red }
  contained_by { box { <-3, -0.1, -2>, <3, 0.3, 2> } } max_gradient 3
  pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) }
}
POV
scene "a declared pigment as a function" << 'POV'
#declare P = pigment { bozo color_map { [0 rgbt <0, 0, 0, 0>] [1 rgbt <1, 0, 0, 0.3>] } scale 0.5 }
#declare Bumps = function { pigment { P } }
isosurface {
  function { y - 0.2*Bumps(x, y, z).red }
  contained_by { box { <-3, -0.1, -2>, <3, 0.3, 2> } } max_gradient 3
  pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) }
}
POV

# ---- normals

scene "slope maps, normal maps and average normals" << 'POV'
object { Floor pigment { rgb 0.3 } normal { gradient x 0.3 slope_map { [0 <0, 1>] [0.5 <1, 0>] [1 <0, -1>] } }
  finish { reflection 0.5 Gloss(100) } }
object { Ball translate x*1.1 pigment { rgb 0.2 }
  normal { gradient y normal_map { [0.4 bumps 0.2 scale 0.2] [0.6 ripples 0.2 scale 0.3] } }
    finish { reflection 0.5 Gloss(100) } }
object { Ball translate -x*1.1 pigment { rgb 0.2 }
  normal { average normal_map { [1 bumps 0.3 scale 0.2] [1 wrinkles 0.3] } } finish { reflection 0.5 Gloss(100) } }
POV
scene "a normal declared, and a normal by the object" << 'POV'
#declare N = normal { dents 0.4 scale 0.4 }
object { Floor pigment { rgb 0.3 } normal { N scale 2 } finish { reflection 0.5 Gloss(100) } }
union {
  object { Ball translate x texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } } normal { N } }
  object { Ball translate -x pigment { rgb <0.5, 0.2, 0> } }
}
POV

# ---- textures

scene "layers, each glossy" << 'POV'
object { Floor
  texture { pigment { rgb 0.3 } finish { reflection 0.3 Gloss(100) } }
  texture { pigment { rgbt <0.5, 0.2, 0.1, 0.5> } finish { reflection 0.3 Gloss(100) } } }
POV
scene "an upper layer from an image with alpha, a glossy lower one" << 'POV'
object { Floor texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
  texture { pigment { image_map { png "alpha.png" } rotate x*90 scale 3 } finish { diffuse 0.7 } } }
POV
scene "texture maps inside texture maps, without transitions" << 'POV'
#declare A = texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
#declare B = texture { checker texture { A } texture { pigment { rgb <0.7, 0.5, 0.2> } } scale 0.5 }
object { Floor texture { gradient x scale 4 texture_map { [0.3 A] [0.3 B] [0.7 B] [0.7 pigment { rgb <0.1, 0.3, 0.1> }
  finish { reflection 0.2 }] } } }
POV
scene "averaged textures, both glossy" << 'POV'
object { Floor texture { average texture_map {
  [1 pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }] [1 pigment { rgb <0.7, 0.5, 0.2> }
    finish { reflection 0.3 Gloss(100) }] } } }
POV
scene "brick, hexagon, object and cells textures" << 'POV'
#declare A = texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
#declare B = texture { pigment { rgb <0.7, 0.5, 0.2> } finish { diffuse 0.7 } }
object { Floor texture { brick texture { B } texture { A } brick_size <1, 0.5, 0.7> mortar 0.05 } }
object { Ball translate x*1.2 texture { hexagon texture { A } texture { B } texture { A } scale 0.3 } }
object { Ball translate -x*1.2 texture { object { box { <-3, 0.5, -3>, <3, 1.2, 3> } texture { B } texture { A } } } }
POV
scene "material_map" << 'POV'
object { Floor texture { material_map { png "map.png"
  texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } } texture { pigment { rgb <0.7, 0.5, 0.2> }
    finish { diffuse 0.7 } } }
  rotate x*90 scale 2 } }
POV
scene "uv_mapping in the texture and by the object" << 'POV'
object { Ball translate x texture { uv_mapping pigment { checker rgb 0.1 rgb <0.4, 0.1, 0> scale 0.1 }
  finish { reflection 0.5 Gloss(100) } } }
sphere { <-1, 0.8, 0>, 0.8 uv_mapping pigment { checker rgb 0.1 rgb <0.1, 0.3, 0> scale 0.1 }
  finish { reflection 0.5 Gloss(100) } }
object { Floor pigment { rgb 0.6 } }
POV
scene "material with a texture and an interior, changed where it is used" << 'POV'
#declare M = material { texture { pigment { rgb 0.2 } finish { reflection { 0, 1 fresnel } Gloss(100) } }
  interior { ior 2 } }
object { Floor material { M scale 2 } }
object { Ball translate x material { M interior { ior 1.3 } } }
object { Ball scale 0.6 translate -x material { texture { pigment { rgb <0.6, 0.4, 0> } } interior { ior 1.5 } } }
POV
scene "interior_texture that is glossy" << 'POV'
object { Floor pigment { rgb 0.4 } }
cylinder { 0, y*1.6, 1 open hollow
  texture { pigment { rgb <0.5, 0.2, 0.1> } finish { diffuse 0.6 } }
  interior_texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
  rotate x*(-50) translate y*0.3 }
POV

scene "a declared texture_map, and a declared texture that has one" << 'POV'
#declare M = texture_map { [0.5 pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }] [0.5
  pigment { rgb <0.7, 0.5, 0.2> } finish { diffuse 0.7 }] }
#declare T = texture { gradient x texture_map { M } }
object { Floor texture { T scale 3 } }
object { Ball translate x texture { gradient y texture_map { M } } }
POV
scene "exponents of a texture's parts" << 'POV'
object { Floor texture { checker texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } } texture {
  pigment { rgb 0.3 } finish { reflection 0.3 Gloss(30) } } } }
POV
scene "declared fog that isn't used, declared background colour" << 'POV'
#declare F = fog { distance 10 color rgb 0.5 }
background { rgb <0.2, 0.3, 0.4> }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "colours: hsl macros, srgb, rgb with operators, bit by bit" << 'POV'
#include "colors.inc"
object { Floor pigment { checker srgb <0.5, 0.4, 0.3> color CHSL2RGB(<200, 0.5, 0.3>) }
  finish { diffuse 0.4 reflection rgb <0.5, 0.4, 0.3> + 0.1*y Gloss(100) } }
object { Ball translate x pigment { color red 0.3 green 0.1 blue 0 filter 0 transmit 0 }
  finish { reflection White*0.4 Gloss(100) } }
POV

# ---- finishes

scene "exponent of a plain mirror" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x pigment { rgb 0.2 } finish { reflection { 0.6 exponent 0.5 } } }
POV
scene "brilliance, ambient in colours, emission" << 'POV'
object { Floor pigment { rgb <0.3, 0.25, 0.2> } finish { ambient rgb <0.2, 0.1, 0> emission rgb <0, 0, 0.1> diffuse
  0.4 brilliance 2 reflection 0.5 Gloss(100) } }
POV
scene "diffuse and specular given as albedo" << 'POV'
object { Floor pigment { rgb <0.5, 0.3, 0.1> } finish { diffuse albedo 0.6 specular albedo 0.3 roughness 0.05
  reflection 0.3 Gloss(100) } }
object { Ball translate x pigment { rgb <0.5, 0.3, 0.1> } finish { diffuse 0.6, 0.2 phong albedo 0.3 phong_size 20
  reflection 0.3 Gloss(100) } }
POV
scene "finish with fresnel off, metallic by a number, falloff and two reflections" << 'POV'
object { Floor pigment { rgb <0.7, 0.5, 0.2> } finish { diffuse 0.3 reflection { 0.9 } reflection { rgb 0.1, rgb <0.9,
  0.8, 0.7> fresnel off falloff 2 metallic 0.5 } Gloss(100) } }
object { Ball translate x pigment { rgb <0.7, 0.5, 0.2> } interior { ior 1.5 }
  finish { diffuse 0.3 reflection { 0.05, 0.9 fresnel on metallic } Gloss(100) } }
POV
scene "gloss in a metallic finish whose colour is a function" << 'POV'
object { Floor pigment { function { 0.5 + 0.5*sin(6*x) } color_map { [0 rgb <1, 0.5, 0.1>] [1 rgb <0.1, 0.4, 1>] } }
  finish { diffuse 0.2 metallic reflection { 0.8 metallic } Gloss(100) } }
POV
scene "subsurface light" << 'POV'
global_settings { mm_per_unit 10 }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x pigment { rgb <0.8, 0.6, 0.4> } finish { reflection 0.2 Gloss(100) } }
POV

# ---- lights and media

scene "lights in unions, with a plain mirror" << 'POV'
#declare Lamp = union { light_source { 0, rgb <0.5, 0.4, 0.2> } sphere { 0, 0.15 pigment { rgb 1 }
  finish { emission 1 } no_shadow } }
#declare L = light_source { <3, 4, -3> rgb 0.3 }
object { Lamp translate <1, 1.6, -1> }
union { light_source { L } object { Ball scale 0.5 pigment { rgb x } } translate -x }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x*1.3 pigment { rgb <0.1, 0.1, 0.3> } finish { reflection 0.4 } }
POV
scene "a light that is a macro's parameter, with a plain mirror" << 'POV'
#macro Put(Light) light_source { Light } #end
#declare L = light_source { <-3, 2, -3> rgb <0, 0.3, 0> }
Put(L)
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x*1.3 pigment { rgb <0.1, 0.1, 0.3> } finish { reflection 0.4 } }
POV
scene "#default finish that conserves energy, after the glossy object" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
#default { finish { conserve_energy } }
object { Ball translate x pigment { rgb <0.5, 0.3, 0.1> } }
POV
scene "light groups in unions, declared and nested, with a plain mirror" << 'POV'
#declare G = light_group {
  light_source { <2, 2, -3> rgb <0.6, 0.2, 0> }
  object { Ball scale 0.5 pigment { rgb 0.7 } finish { reflection 0.3 Gloss(100) } }
}
light_group { G translate x*1.5 global_lights on }
object { G translate -x*1.5 }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball scale 0.6 translate <0, 0, 0.5> pigment { rgb <0.1, 0.1, 0.3> } finish { reflection 0.4 } }
POV
scene "a spotlight, a cylinder light, a parallel light and a projected_through one" << 'POV'
light_source { <2, 3, -1> rgb 0.5 cylinder point_at x radius 0.5 falloff 1 }
light_source { <-2, 5, -2> rgb 0.3 parallel point_at 0 }
light_source { <0, 5, -2> rgb 0.3 projected_through { sphere { y*2, 0.3 } } }
light_source { <0, 3, -2> rgb 0.3 shadowless fade_distance 3 fade_power 1 media_interaction off }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x*1.3 pigment { rgb <0.3, 0.1, 0.1> } finish { diffuse 0.6 reflection 0.3 } }
POV
scene "media in a glass ball behind the glossy floor" << 'POV'
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
sphere { <0.5, 1.2, 3>, 0.9 pigment { rgbt 1 } hollow interior { media { emission <0.4, 0.2, 0> density { spherical
  scale 0.9 translate <0.5, 1.2, 3> } } } }
POV
scene "a map of glossy textures that reflect unlike, and one that doesn't" << 'POV'
#declare Bumpy = texture { pigment { rgb <0.9, 0.6, 0.2> } finish { reflection { 0.7 metallic } Gloss(100) } normal { bumps 0.1 scale 0.2 } };
#declare Dim = texture { pigment { rgb 0.3 } finish { reflection 0.1 Gloss(100) } };
#declare Plain = texture { pigment { rgb 0.2 } finish { reflection 0.3 } };
object { Floor texture { gradient x texture_map { [0 Dim] [0.5 Bumpy] [0.8 Plain] [1 Dim] } scale 1.3 } }
sphere { <0, 0.7, -0.5>, 0.7 texture { average texture_map { [1 Bumpy] [2 Dim] } } }
POV
scene "a clear box around everything" << 'POV'
box { -30, 30 pigment { rgbt 1 } hollow }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "no_radiosity, double_illuminate, hollow, inverse" << 'POV'
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } no_radiosity }
polygon { 4, <1, 0>, <2, 0>, <2, 1.5>, <1, 1.5> double_illuminate pigment { rgb <0.7, 0.2, 0.1> } rotate y*10 }
object { Ball scale 0.8 hollow translate -x pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } }
sphere { 0, 20 inverse hollow pigment { gradient y color_map { [0 rgb 0.3] [1 rgb <0.2, 0.3, 0.9>] } scale 20 }
  finish { emission 0.5 diffuse 0 } no_shadow }
POV
scene "averaged textures" << 'POV'
object { Floor texture { average texture_map {
  [1 pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }] [1 pigment { rgb <0.7, 0.5, 0.2> } finish { diffuse 0.7 }] } } }
POV
scene "declared nested pigment as a function" << 'POV'
#declare P = pigment { checker pigment { rgb 0 } pigment { bozo color_map { [0 rgb 0] [1 rgb 1] } scale 0.3 } scale 2 }
#declare Bumps = function { pigment { P } }
height_field {
  function 60, 60 { Bumps(6*x, 0, 6*y).grey }
  smooth translate <-0.5, 0, -0.5> scale <6, 0.4, 5>
  pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }
}
POV
scene "declared pigment map as normal pattern" << 'POV'
#declare P = pigment { gradient x pigment_map { [0 rgb 0] [1 bozo color_map { [0 rgb 0] [1 rgb 1] } scale 0.2] } scale 3 }
#declare Q = pigment { checker pigment { rgb 0 } pigment { bozo color_map { [0 rgb 0] [1 rgb 1] } scale 0.2 } }
object { Floor pigment { rgb 0.3 } normal { pigment_pattern { P } 0.5 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x pigment { rgb 0.3 } normal { pigment_pattern { Q } 0.5 } finish { reflection 0.5 Gloss(100) } }
POV
scene "declared sky sphere" << 'POV'
#declare S = sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb z] } } }
sky_sphere { S rotate x*10 }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "eval_pigment of nested pigments" << 'POV'
#include "functions.inc"
#declare P = pigment { checker pigment { rgb 0.2 } pigment { rgb <0.2, 0.5, 0.9> } }
#for (I, 0, 4)
  #declare C = eval_pigment(P, <I + 0.5, 0.5, 0.5>);
  sphere { <I - 2, C.green, -1>, 0.3 pigment { rgb C } finish { reflection 0.4 Gloss(100) } }
#end
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "pigments in pigment_pattern of normals" << 'POV'
object { Floor pigment { rgb 0.3 }
  normal { pigment_pattern { checker pigment { rgb 0 } pigment { bozo color_map { [0 rgb 0] [1 rgb 1] } scale 0.2 } } 0.5 }
  finish { reflection 0.5 Gloss(100) } }
POV
scene "pigments in pigment_pattern of textures" << 'POV'
object {
  Floor
  texture {
    pigment_pattern { checker pigment { rgb 0 } pigment { gradient x color_map { [0.5 rgb 0.2] [0.5 rgb 1] } } scale 1.5 }
    texture_map {
      [0.5 pigment { rgb <0.8, 0.6, 0.2> } finish { diffuse 0.7 }]
      [0.5 pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }]
    }
  }
}
POV
scene "skies inc" << 'POV'
#include "colors.inc"
#include "arrays.inc"
#include "strings.inc"
#include "consts.inc"
#include "functions.inc"
#include "skies.inc"
#include "shapes_old.inc"
sky_sphere { S_Cloud1 }
isosurface { function { f_torus(x, y, z, 0.7, 0.25) } contained_by { sphere { 0, 1 } } max_gradient 2 rotate x*50 translate <1, 0.8, 0>
  pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
object { Cylinder_Y scale <0.3, 1, 0.3> clipped_by { plane { y, 1 } } translate -x pigment { rgb x/3 } finish { reflection 0.5 Gloss(100) } }
object { Floor pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } }
POV
scene "sky_sphere declared with two pigments" << 'POV'
#declare S = sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb z] } } pigment { bozo color_map { [0 rgbt 1] [0.8 rgbt <1, 1, 1, 0.3>] } scale 0.2 } emission 0.8 }
sky_sphere { S rotate x*10 }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "texture_map with a soft transition" << 'POV'
object { Floor texture { gradient x scale 4 texture_map {
  [0.2 pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) }] [0.8 pigment { rgb <0.7, 0.5, 0.2> } finish { diffuse 0.7 }] } } }
POV
scene "textures inc" << 'POV'
#include "shapes.inc"
#include "transforms.inc"
#include "math.inc"
#include "rand.inc"
#include "textures.inc"
#include "glass.inc"
#declare R = RdmA;
object { Round_Box_Union(<-1, 0, -1>, <0, 1, 0>, 0.1) texture { Chrome_Metal finish { Gloss(100) } } }
object { Supertorus(0.5, 0.2, 0.6, 0.6, 0.01, 1.5) scale 0.8 rotate x*60 translate <1, 0.8, 0> pigment { rgb <0.3, 0.1, 0> } finish { Shiny reflection 0.4 Gloss(100) } }
object { Ball scale 0.3 Shear_Trans(x, <0.2, 1, 0>, z) translate <SRand(R), 0, -1.5> pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
object { Floor pigment { rgb clamp(2, 0, 0.4) } finish { reflection 0.4 Gloss(100) } }
POV
scene "transmit of a declared pigment as a function" << 'POV'
#declare P = pigment { bozo color_map { [0 rgbt <0, 0, 0, 0>] [1 rgbt <1, 0, 0, 1>] } scale 0.5 }
#declare Bumps = function { pigment { P } }
isosurface {
  function { y - 0.2*Bumps(x, y, z).transmit }
  contained_by { box { <-3, -0.1, -2>, <3, 0.3, 2> } } max_gradient 3
  pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) }
}
POV
scene "upper layer declared elsewhere" << 'POV'
#declare Dirt = texture { pigment { checker rgbt <1, 0.2, 0.1, 0.5> rgbt 1 } finish { diffuse 0.8 } }
object { Floor texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } } texture { Dirt } }
POV
scene "upper layer with a declared colour" << 'POV'
#declare Dirt = rgbt <1, 0.2, 0.1, 0.5>;
object { Floor texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } } texture { pigment { color Dirt } finish { diffuse 0.7 } } }
POV
scene "upper layer with a declared colour_map" << 'POV'
#declare M = color_map { [0 rgbt <1, 0.2, 0.1, 0.2>] [0.6 rgbt 1] }
object { Floor texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } } texture { pigment { bozo color_map { M } } } }
POV
scene "upper layer with a declared pigment" << 'POV'
#declare Dirt = pigment { checker rgbt <1, 0.2, 0.1, 0.5> rgbt 1 }
object { Floor texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } } texture { pigment { Dirt } } }
POV
scene "woods and stones as they are" << 'POV'
#include "colors.inc"
#include "woods.inc"
#include "stones.inc"
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } }
object { Ball scale 0.7 translate x*1.1 texture { T_Stone24 scale 0.3 } }
object { Ball scale 0.7 translate <-1.1, 0, -0.5> texture { T_Wood10 scale 0.5 } }
POV
scene "photons that a glossy mirror throws, and a ball that collects none" << 'POV'
global_settings { photons { count 20000 jitter 0 } }
light_source { <-3, 3, -3> rgb 0.15 photons { reflection on refraction on } }
object { Floor pigment { rgb 0.4 } finish { reflection 0.3 Gloss(100) } }
box { <1.5, 0, -1>, <1.6, 2, 1> pigment { rgb 0.1 } finish { reflection 0.8 Gloss(100) } photons { target reflection on } }
sphere { <-0.5, 0.5, -1>, 0.5 pigment { rgb 0.6 } photons { collect off } }
POV
scene "a glossy part that is declared by itself, in a union with glass" << 'POV'
#declare Cage = difference { box { -0.7, 0.7 } box { <-0.6, -0.6, -1>, <0.6, 0.6, 1> } box { <-1, -0.6, -0.6>, <1, 0.6, 0.6> }
  pigment { rgb <0.5, 0.4, 0.2> } finish { diffuse 0.3 reflection { 0.6 metallic } Gloss(100) } }
union { object { Cage } sphere { 0, 0.3 pigment { rgbt 0.9 } } rotate y*20 translate <0, 0.8, -0.5> }
object { Floor pigment { rgb 0.4 } finish { reflection 0.2 } }
POV
end_of_scenes
