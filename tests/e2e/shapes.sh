#!/usr/bin/env bash
# Scenes with every kind of shape, of constructive geometry and of the flags of an object.
. tests/e2e/lib_scenes.sh

oiiotool --pattern fill:top=0,0,0:bottom=1,1,1 32x32 3 --ch R -d uint8 -o "$folder/ramp.png"

scene "height field from an image" << 'POV'
height_field { png "ramp.png" smooth water_level 0.2 translate -0.5 scale <5, 0.8, 4> translate y*0.4
  texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } } }
POV
scene "parametric surface" << 'POV'
parametric { function { u } function { 0.15*sin(3*u)*cos(2*v) } function { v } <-3, -2>, <3, 2>
  contained_by { box { <-3.1, -0.3, -2.1>, <3.1, 0.3, 2.1> } } max_gradient 2 accuracy 0.001 precompute 10 x, y, z
  pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "julia fractal" << 'POV'
julia_fractal { <-0.083, 0, -0.83, -0.025> quaternion sqr max_iteration 6 precision 50 translate y*1
  pigment { rgb <0.3, 0.1, 0> } finish { reflection 0.5 Gloss(100) } }
object { Floor pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } }
POV
scene "text, sphere_sweep, ovus, polygon, triangle and quadric" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
text { ttf "crystal.ttf" "Ag" 0.3, 0.1*x texture { T } scale 1.3 translate <-2.2, 0.1, -0.5> }
sphere_sweep { cubic_spline 5, <-1, 0.2, -2>, 0.1, <-0.5, 0.3, -1.5>, 0.2, <0, 0.8, -1>, 0.15, <0.6, 0.4, -1.2>, 0.2,
  <1, 0, -1>, 0.1 tolerance 0.001 texture { T } }
ovus { 0.4, 0.25 texture { T } translate <1, 0.4, 0> }
polygon { 5, <1, 0, 0>, <2, 0, 0>, <2, 1.3, 0>, <1, 1.3, 0>, <1, 0, 0> texture { T } rotate y*20 translate z }
triangle { <-1, 0, 0.5>, <0, 1.8, 0.9>, <1, 0, 0.5> texture { T } }
quadric { <1, 1, 1>, 0, 0, -0.09 translate <1.9, 0.3, -1> texture { T } }
object { Floor pigment { rgb 0.5 } }
POV
scene "splines that place objects" << 'POV'
#declare S = spline { natural_spline 0, <-2, 0.3, 0> 0.5, <0, 0.8, -1> 1, <2, 0.3, 0.5> }
#for (I, 0, 1, 0.125) sphere { S(I), 0.25 pigment { rgb <I, 0.3, 0.1> } finish { reflection 0.1 + 0.5*I Gloss(100) } }
#end
object { Floor pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } }
POV
scene "surface of revolution, polynomial, plane with a hole" << 'POV'
sor { 5, <0.1, -0.2> <0.5, 0> <0.3, 0.6> <0.45, 1.2> <0.3, 1.4> open translate x*(-1.3) pigment { rgb 0.2 }
  finish { reflection 0.5 Gloss(100) } }
poly { 4, <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.25, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0.5, 0, 0, 0, 0, 1, 0,
  -1.25, 0, 0.2> scale 0.7 translate <1, 0.5, 0>
  pigment { rgb <0.2, 0.1, 0> } finish { reflection 0.5 Gloss(100) } }
difference { plane { y, 0 } cylinder { -y, y, 0.6 translate <0, 0, -1> pigment { rgb x } } pigment { rgb 0.3 }
  finish { reflection 0.5 Gloss(100) } }
POV
scene "mesh2 with normals, uv_vectors and a texture" << 'POV'
mesh2 {
  vertex_vectors { 4, <-3, 0, -2>, <3, 0, -2>, <3, 0, 2>, <-3, 0, 2> }
  normal_vectors { 4, <-0.2, 1, 0>, <0.2, 1, 0>, <0.2, 1, 0.1>, <-0.2, 1, 0> }
  uv_vectors { 4, <0, 0>, <1, 0>, <1, 1>, <0, 1> }
  face_indices { 2, <0, 1, 2>, <0, 2, 3> }
  uv_indices { 2, <0, 1, 2>, <0, 2, 3> }
  inside_vector y
  texture { uv_mapping pigment { checker rgb 0.1 rgb <0.4, 0.2, 0> scale 0.1 } finish { reflection 0.5 Gloss(100) } }
}
POV
scene "uv_mapping by a mesh and a torus" << 'POV'
#declare F = finish { reflection 0.5 Gloss(100) }
mesh2 { vertex_vectors { 4, <-3, 0, -2>, <3, 0, -2>, <3, 0, 2>, <-3, 0, 2> } uv_vectors { 4, <0, 0>, <1, 0>, <1, 1>,
  <0, 1> }
  face_indices { 2, <0, 1, 2>, <0, 2, 3> } uv_mapping pigment { checker rgb 0.1 rgb <0.4, 0.2, 0> scale 0.1 }
    finish { F } }
torus { 0.6, 0.2 rotate x*60 translate y*0.9 uv_mapping texture { pigment { checker rgb 0.1 rgb <0.1, 0.2, 0.4>
  scale 0.1 } finish { F } } }
POV
declare_textures='#declare A = texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
#declare B = texture { pigment { rgb <0.7, 0.5, 0.2> } }
#declare C = texture { pigment { rgb z/3 } finish { reflection 0.3 Gloss(100) } }'
scene "mesh of triangles, each with its own texture" << POV
$declare_textures
mesh {
  #for (I, -3, 2)
    triangle { <I, 0, -2>, <I + 1, 0, -2>, <I, 0, 2> texture { A } }
    triangle { <I + 1, 0, -2>, <I + 1, 0, 2>, <I, 0, 2> texture { #if (mod(I, 2)) B #else C #end } }
  #end
  rotate y*10
}
POV
scene "mesh2 with a texture for each face, moved" << POV
$declare_textures
mesh2 {
  vertex_vectors { 5, <-3, 0, -2>, <3, 0, -2>, <3, 0, 2>, <-3, 0, 2>, <0, 0.5, 0> }
  texture_list { 3, texture { A }, texture { pigment { checker rgb 0.6 rgb <0.7, 0.5, 0.2> } },
    texture { pigment { rgb 0.1 } finish { reflection 0.4 Gloss(100) } } }
  face_indices { 4, <0, 1, 4>, 0, <1, 2, 4>, 1
    <2, 3, 4> + 0*x, (1 > 2 ? 0 : 2), <3, (4 > 3 ? 0 : 1), 4>, 2 }
  rotate y*25 scale <1, 1.5, 1> translate <0.2, 0, 0.3>
}
POV
scene "mesh2 with three textures for each face" << POV
$declare_textures
mesh2 {
  vertex_vectors { 5, <-3, 0, -2>, <3, 0, -2>, <3, 0, 2>, <-3, 0, 2>, <0, 0.5, 0> }
  normal_vectors { 5, <-0.1, 1, -0.1>, <0.1, 1, -0.1>, <0.1, 1, 0.1>, <-0.1, 1, 0.1>, y }
  texture_list { 3, texture { A }, texture { A pigment { rgb <0.4, 0, 0> } },
    texture { A pigment { rgb 0 } normal { bumps 0.05 scale 0.2 } } }
  face_indices { 4, <0, 1, 4>, 0, 1, 2, <1, 2, 4>, 1, 2, 2, <2, 3, 4>, 2, 2, 0, <3, 0, 4>, 0, 0, 1, }
  normal_indices { 4, <0, 1, 4>, <1, 2, 4>, <2, 3, 4>, <3, 0, 4> }
  translate z*0.2
}
POV
scene "mesh2 with faces, textures and their numbers from loops and macros" << POV
$declare_textures
#declare Random = seed(3);
#macro Ground(Index) texture { A pigment { rgb Index/5 } } #end
#macro Body(Columns)
  texture_list { Columns #for (I, 1, Columns) #local Shade = I; Ground(I) #end }
  face_indices { 2*Columns
    #declare I = 0;
    #while (I < Columns)
      <2*I, 2*I + 1, 2*I + 2>, I,
      <2*I + 1, 2*I + 3, 2*I + 2>, #if (mod(I, 2) > 0) floor(rand(Random)*Columns) #else Columns - 1 #end
      #declare I = I + 1;
    #end
  }
#end
mesh2 {
  vertex_vectors { 8 #for (I, 0, 3) <2*I - 3, 0, -2>, <2*I - 3, 0, 2> #end }
  Body(3)
  rotate y*15
}
sphere { <rand(Random)*2, 0.5, rand(Random)>, 0.5 texture { A } }
POV
scene "mesh with a texture at each corner" << POV
$declare_textures
mesh {
  #for (I, -3, 2)
    triangle { <I, 0, -2>, <I + 1, 0, -2>, <I, 0, 2> texture_list { A, A B } }
    smooth_triangle { <I + 1, 0, -2>, y + x/9, <I + 1, 0, 2>, y, <I, 0, 2>, y - x/9
      texture_list { #if (mod(I, 2)) A A A #else C C C #end } }
  #end
  rotate y*10
}
object { Ball texture { C } scale 0.6 }
POV
scene "blob with textures of its components" << 'POV'
blob { threshold 0.5
  sphere { <-0.6, 0.8, 0>, 1, 1 texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } } }
  sphere { <0.6, 0.8, 0>, 1, 1 pigment { rgb <0.4, 0.1, 0> } finish { reflection 0.6 Gloss(100) } }
  cylinder { <-1.5, 0.5, 0>, <1.5, 0.3, 0>, 0.4, 1 scale <1, 1.2, 1> texture { pigment { rgb 0.2 }
    finish { reflection 0.6 Gloss(100) } } }
}
object { Floor pigment { rgb 0.3 } }
POV
scene "difference with a glossy cutter, and one without a texture" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
difference { box { <-2, 0, -1>, <0, 1, 1> pigment { rgb <0.7, 0.4, 0.1> } } sphere { <-1, 1.1, -0.8>, 0.8
  texture { T } } }
difference { box { <0.5, 0, -1>, <2, 1, 1> texture { T } } sphere { <1.2, 1.1, -0.8>, 0.7 } }
object { Floor pigment { rgb 0.5 } }
POV
scene "intersection, merge and inverse" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
intersection { object { Ball } box { <-1, 0.2, -1>, <1, 1.5, 0.5> texture { T } } object { Ball inverse scale 0.4 }
  texture { pigment { rgb <0.5, 0.1, 0> } finish { reflection 0.2 Gloss(100) } } translate x }
merge { object { Ball scale 0.6 } box { <-0.3, 0, -0.9>, <0.3, 1.3, 0.2> } texture { T } translate -x*1.2 }
plane { y, 0 inverse pigment { rgb 0.5 } finish { reflection 0.3 Gloss(100) } }
POV
scene "clipped_by a box, bounded_by another one" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
object { Ball clipped_by { box { <-2, 0, -2>, <2, 1.2, 0.1> rotate z*20 } } texture { T } }
union { box { <-3, -0.1, -2>, <3, 0, 2> } bounded_by { box { <-3.1, -0.2, -2.1>, <3.1, 0.1, 2.1> } } texture { T } }
POV
scene "cutaway_textures of several textured parts" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
difference {
  union { box { <-2, 0, -1>, <0, 1, 1> texture { T } } box { <0, 0, -1>, <2, 1, 1> pigment { rgb <0.7, 0.3, 0> } } }
  sphere { <0, 1.1, -0.9>, 0.9 }
  cutaway_textures
}
object { Floor pigment { rgb 0.3 } finish { reflection 0.3 Gloss(100) } }
POV
scene "no_image, no_reflection and no_shadow of glossy objects and in unions" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
object { Floor texture { T } }
object { Ball scale 0.7 translate x*1.3 texture { T } no_reflection }
object { Ball scale 0.7 translate -x*1.3 texture { T } no_shadow }
union { object { Ball scale 0.4 translate <0, 0, -1> texture { T } } sphere { <0, 1.5, 0>, 0.4 pigment { rgb x }
  no_image } no_shadow }
POV
scene "no_image and no_reflection copies by the user" << 'POV'
#declare Thing = union { object { Ball scale 0.6 translate x } object { Ball scale 0.4 translate -x } }
object { Thing pigment { rgb <0.2, 0.6, 0.1> } no_image }
object { Thing pigment { rgb <0.7, 0.2, 0.1> } finish { reflection 0.2 Gloss(100) } no_reflection no_shadow }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "trace, inside, min_extent and max_extent" << 'POV'
#declare Thing = union { object { Ball } box { <-1, 0, -1>, <0, 0.5, 0> } texture { pigment { rgb 0.2 }
  finish { reflection 0.4 Gloss(100) } } }
object { Thing }
#for (I, -1, 1, 0.5)
  #declare N = <0, 0, 0>;
  #declare P = trace(Thing, <I, 5, -0.3>, -y, N);
  #if (vlength(N) > 0 & inside(Thing, <0, 0.9, 0>)) sphere { P, 0.15 pigment { rgb <0.8, 0.4, 0> }
    finish { reflection 0.2 Gloss(100) } } #end
#end
sphere { max_extent(Thing), 0.1 pigment { rgb 1 } }
object { Floor pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } }
POV
scene "objects that are nothing, empty unions and unions of one" << 'POV'
#declare Nothing = union { }
union { object { Ball texture { pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } } } }
union { union { union { object { Floor } } pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } } }
POV
scene "an untextured union with one glossy part" << 'POV'
union { object { Ball scale 0.5 translate x } object { Floor pigment { rgb 0.3 }
  finish { reflection 0.5 Gloss(100) } } }
POV
scene "transforms declared, inverse and by matrix, textures that move with the object" << 'POV'
#declare M = transform { rotate y*30 scale <1, 0.8, 1.2> translate x*0.3 }
object { Floor texture { pigment { checker rgb 0.2 rgb <0.4, 0.1, 0> }
  finish { reflection 0.5 Gloss(100) } } transform { M } }
object { Ball pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } matrix <0.6, 0, 0.2, 0, 0.7, 0, -0.2, 0.1, 0.6,
  1, 0, 0> transform { M inverse } }
POV
scene "split_union, hierarchy off, sturm" << 'POV'
union { object { Ball scale 0.6 } object { Ball scale 0.6 translate x*1.3 } split_union off pigment { rgb 0.2 }
  finish { reflection 0.5 Gloss(100) } }
blob { threshold 0.3 sphere { <-1, 0.5, -1>, 0.6, 1 } sturm hierarchy off pigment { rgb 0.2 }
  finish { reflection 0.5 Gloss(100) } }
object { Floor pigment { rgb 0.4 } }
POV
scene "seams of coplanar and touching glossy surfaces" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
box { <-3, -0.1, -2>, <0, 0, 2> texture { T } }
box { <0, -0.1, -2>, <3, 0, 2> texture { T } }
box { <-0.5, 0, -0.5>, <0.5, 1, 0.5> texture { T } }
POV
scene "a mirror chain of three, and a lamp behind" << 'POV'
object { Floor pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
box { <-2, 0, 0.8>, <2, 1.5, 0.9> pigment { rgb 0.05 } finish { reflection 0.8 } rotate y*10 }
object { Ball scale 0.6 translate <0.8, 0, -0.8> pigment { rgb 0.05 } finish { reflection 0.7 Gloss(100) } }
POV
scene "max_trace_level 2 and adc_bailout" << 'POV'
global_settings { max_trace_level 2 adc_bailout 0.05 }
object { Floor pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } }
object { Ball scale 0.6 translate <0.8, 0, -0.8> pigment { rgb 0.05 } finish { reflection 0.7 Gloss(100) } }
object { Ball scale 0.6 translate <-0.8, 0, -0.8> pigment { rgb 0.05 } finish { reflection 0.7 } }
POV
scene "array filled with lights" << 'POV'
#declare L = array[2] { light_source { <3, 4, -3> rgb 0.3 }, light_source { <-3, 2, -3> rgb <0, 0.3, 0> } }
#for (I, 0, 1) light_source { L[I] } #end
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "declared object that is a declared light" << 'POV'
#declare L = light_source { <3, 4, -3> rgb 0.3 }
#declare Moved = object { L translate x*(-4) }
object { Moved }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x*1.3 pigment { rgb <0.1, 0.1, 0.3> } finish { reflection 0.4 } }
POV
scene "lights in an array" << 'POV'
#declare L = array[1]
#declare L[0] = light_source { <3, 4, -3> rgb 0.3 }
light_source { L[0] }
object { L[0] translate x*(-4) }
object { Floor pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x*1.3 pigment { rgb <0.1, 0.1, 0.3> } finish { reflection 0.4 } }
POV
scene "blob glossy and dull component" << 'POV'
blob { threshold 0.5
  sphere { <-0.6, 0.8, 0>, 1, 1 texture { pigment { rgb 0.2 } finish { reflection 0.6 Gloss(100) } } }
  sphere { <0.6, 0.8, 0>, 1, 1 texture { pigment { rgb <0.4, 0.1, 0> } finish { diffuse 0.7 } } }
}
object { Floor pigment { rgb 0.3 } }
POV
end_of_scenes
