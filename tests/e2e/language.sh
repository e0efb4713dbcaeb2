#!/usr/bin/env bash
# Scenes that use POV-Ray's language in ways that a reader of tokens could take for something else.
. tests/e2e/lib_scenes.sh

# ---- macros

scene "macro parameters that are a finish, a texture, a pigment, a normal and an object, by name" << 'POV'
#declare Polished = finish { reflection 0.5 Gloss(100) }
#declare Grey = pigment { rgb 0.3 }
#declare Red = texture { pigment { rgb <0.5, 0.1, 0.1> } finish { Polished } }
#declare Wavy = normal { bumps 0.1 scale 0.5 }
#macro Place(Thing, Texture, Where) object { Thing texture { Texture } translate Where } #end
#macro Paint(Thing, Pigment, Normal, Finish) object { Thing pigment { Pigment } normal { Normal } finish { Finish } }
  #end
Paint(Floor, Grey, Wavy, Polished)
Place(Ball, Red, x*1.2)
Place(object { Ball scale 0.5 }, texture { Red scale 2 }, -x)
POV
scene "recursion that ends in a glossy object" << 'POV'
#macro Tower(Level, Size)
  #if (Level > 0)
    union {
      box { <-Size, 0, -Size>, <Size, Size, Size> }
      object { Tower(Level - 1, Size*0.7) translate y*Size }
    }
  #else
    sphere { y*Size, Size texture { pigment { rgb <0.3, 0.1, 0> } finish { reflection 0.6 Gloss(100) } } }
  #end
#end
object { Tower(3, 0.6) pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } rotate y*20 }
object { Floor pigment { rgb 0.6 } }
POV
scene "#local shadows a global name, glossy or not" << 'POV'
#declare F = finish { reflection 0.5 Gloss(100) }
#macro Dull() #local F = finish { diffuse 0.6 } object { Ball scale 0.6 translate x finish { F } pigment { rgb x } }
  #end
Dull()
object { Floor pigment { rgb 0.3 } finish { F } }
POV
scene "a macro in place of a texture, given a further finish" << 'POV'
#macro Made(P) texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(P) } } #end
object { Floor Made(100) }
object { Ball translate x Made(50) }
POV
scene "a macro that is the inside of a texture" << 'POV'
#macro Inside(P) pigment { rgb 0.3 } finish { reflection 0.5 Gloss(P) } #end
object { Floor texture { Inside(100) } }
object { Ball translate x Inside(100) }
POV
scene "arrays of objects, some glossy" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
#declare Things = array[3] { object { Ball texture { T } }, box { 0, 1 pigment { rgb x } }, sphere { 0, 0.5
  texture { T } } }
#declare More = array[1][2];
#declare More[0][1] = object { Floor texture { T } }
object { Things[0] translate x }
object { Things[1] rotate y*20 translate -x*1.5 }
object { Things[2] translate <0, 0.5, -1> }
object { More[0][1] }
POV
scene "#undef and #ifdef guards" << 'POV'
#ifndef (Shiny)
  #declare Shiny = finish { reflection 0.5 Gloss(100) }
  #declare Count = 1;
#end
#ifdef (Twice) #declare Count = Count + 1; #else #declare Twice = 1; #end
#ifdef (Count) object { Ball scale 0.5 translate x*Count pigment { rgb <0.2, 0.6, 0.1> } } #end
#undef Count
#ifndef (Count) object { Floor pigment { rgb 0.3 } finish { Shiny } } #end
POV
scene "#switch, #range, #case, #break, #while, #for" << 'POV'
#declare I = 0;
#while (I < 4)
  #switch (I)
    #case (0) object { Floor pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } } #break
    #range (1, 2) object { Ball scale 0.4 translate x*I texture {
      pigment { #switch (I) #case (1) rgb 0.1 #break #else rgb <0.4, 0.1, 0.1> #end }
      finish { reflection #if (I = 1) 0.6 #else 0.3 #end Gloss(100) } } } #break
    #else object { Ball scale 0.4 translate -x pigment { rgb y } }
  #end
  #declare I = I + 1;
#end
#for (I, 0, 10) #if (I > 2) #break #end sphere { <I - 1, 0.2, -1.5>, 0.2 pigment { rgb <0.2, 0.2*I, 0.7> } } #end
POV
scene "a block opened in both branches of an #if" << 'POV'
#declare Round = 1;
#if (Round)
  object { Ball
#else
  object { Floor
#end
  pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) }
}
object { Floor pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } }
POV
scene "a finish opened in one macro and closed in another" << 'POV'
#macro Open(R) finish { diffuse 0.3 reflection R #end
#macro Close() Gloss(100) } #end
object { Floor pigment { rgb 0.3 } Open(0.5) Close() }
POV
scene "#declare inside objects, textures, finishes and vectors" << 'POV'
object {
  #declare F = finish { #declare Strength = 0.5; reflection Strength Gloss(100) }
  Floor
  texture { #local Grey = 0.3; pigment { rgb <Grey, #declare Blue = 0.4; Blue, Grey> } finish { F } }
}
object { Ball translate x*Blue*2 pigment { rgb Blue/2 } finish { F } }
POV
scene "names that are POV-Ray's words in another case" << 'POV'
#declare Finish = finish { reflection 0.5 Gloss(100) }
#declare Texture = texture { pigment { rgb 0.2 } finish { Finish } }
#declare Pigment = pigment { rgb 0.3 }
#declare Camera = 3;
#declare Union = union { object { Ball } object { Floor } }
#declare GLOSS = 1;
#declare Reflection = 0.4;
#declare Light_Source = light_source { <3, 4, -3> rgb 0.3 }
light_source { Light_Source }
object { Union texture { Texture } }
object { Ball scale 0.4 translate -x*Camera/2 pigment { Pigment } finish { Finish reflection Reflection } }
POV
scene "macros called like items of a finish" << 'POV'
#macro Reflection(R) reflection { R } #end
#macro Glossy_Finish(R) finish { Reflection(R) Gloss(100) } #end
#macro Finish_Of(F, R) finish { F Reflection(R) Gloss(100) } #end
#declare Base = finish { diffuse 0.3 }
object { Floor pigment { rgb 0.3 } Glossy_Finish(0.5) }
object { Ball translate x pigment { rgb 0.1 } Finish_Of(Base, 0.4) }
POV
scene "a finish of several lines of tokens without spaces" << 'POV'
object{Floor pigment{rgb.3}finish{diffuse.4reflection{.1,.6}Gloss(100)}}
object{Ball pigment{rgb<.4,.1,.1>}finish{reflection.4Gloss(1e2)}translate<1,0,0>}
POV
scene "# apart from its word, comments between a word and its brace" << 'POV'
# declare F /* a finish */ = /* { */ finish // {
{ reflection /* nested /* */ } */ 0.5 Gloss // (
( 100 ) } // }
# if (1) object { Floor pigment /* } */ { rgb 0.3 } finish
{ F } } # end
POV
scene "strings with braces, quotes and comment signs" << 'POV'
#declare S = concat("{ finish { /* ", "} */ \" // }", str(3, 0, 0));
#debug "finish { reflection 1 Gloss(1) {{{ \\"
#debug S
text { ttf "timrom.ttf" "} /* {" 0.2, 0 scale 1.2 translate <-1.5, 0.2, -1> pigment { rgb <0.3, 0, 0> }
  finish { reflection 0.4 Gloss(100) } }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "every statement in a conditional or a macro" << 'POV'
#macro Sky(C) background { rgb C } #end
#macro Eye(Where) camera { location Where right x*4/3 angle 50 look_at <0, 0.6, 0> } #end
#macro Settings(Level) global_settings { max_trace_level Level } #end
#if (1) Sky(0.5) #else background { rgb x } #end
#for (I, 0, 1) Eye(<I, 2, -6>) #end
#ifndef (Level) Settings(6) #end
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
POV
for version in 3.1 3.5 3.6; do
    whole_scene "#version $version" << POV
#version $version;
#include "stage.inc"
object { Floor pigment { color red 0.3 green 0.2 } finish { ambient 0.1 reflection 0.5 Gloss(100) } }
object { Ball translate x texture { pigment { checker color rgb 0.2, color rgb <0.4, 0.1, 0.1> scale 0.3 }
  finish { ambient 0.1 diffuse 0.4 reflection 0.3 Gloss(100) } } }
POV
done
scene "old words of colours and maps" << 'POV'
object { Floor texture { pigment { marble turbulence 0.5
  color_map { [0.0, 0.6 color red 0.3 color red 0.1 green 0.2] [0.6 1.0 color blue 0.3 colour rgb 0.2] } scale 2 }
  finish { reflection 0.5 Gloss(100) } } }
POV

scene "exponents from a loop, a condition and an override" << 'POV'
#declare F = finish { reflection 0.5 Gloss(100) }
#for (I, 0, 4) object { Ball scale 0.4 translate x*(I - 2) pigment { rgb 0.2 }
  finish { reflection 0.5 Gloss(10*pow(2, I)) } } #end
object { Ball scale 0.4 translate <-1, 0, -1.5> pigment { rgb 0.2 } finish { F Gloss(500) } }
object { Ball scale 0.4 translate <1, 0, -1.5> pigment { rgb 0.2 } finish { F #if (1) Gloss(700) #else Gloss(900)
  #end } }
POV
scene "unpaired braces in a branch that isn't taken" << 'POV'
#if (0) } } finish { texture { ( #else object { Floor #end
  pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
object { Ball translate x pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
POV
scene "comment signs in comments" << 'POV'
//* finish {
/* // */ object { Floor pigment { rgb 0.3 } finish { reflection 0.5 /* " */ Gloss(100) //" {
} } /**/
/*/ { /*/ */ } finish { */
POV
scene "copies of glossy objects, textures and pigments by name" << 'POV'
#declare T = texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
#declare U = T;
#declare A = object { Ball texture { U } }
#declare B = A;
#declare C = array[2]
#declare C[0] = B;
#declare C[1] = C[0];
object { B translate x }
object { C[1] scale 0.5 translate -x }
object { Floor texture { U } }
POV
scene "macros in macros: of a finish, a texture and an object" << 'POV'
#macro Shine() reflection 0.5 Gloss(100) #end
#macro Whole() finish { Shine() } #end
#macro Coat() texture { pigment { rgb 0.3 } Whole() } #end
#macro Coated(Thing) object { Thing Coat() } #end
Coated(Floor)
object { Ball translate x texture { pigment { rgb 0.1 } Whole() } }
POV
scene "#debug, #warning, #local and #if inside a finish" << 'POV'
object { Floor pigment { rgb 0.3 } finish { #debug "in { a finish\n" #local A = 0.5; #if (A > 0.4) #local B = A;
  #end reflection B #while (B > 1) #end Gloss(100) } }
POV
scene "a material, an interior and a transform as a macro's parameters" << 'POV'
#declare M = material { texture { pigment { rgb 0.2 } finish { reflection { 0, 1 fresnel } Gloss(100) } }
  interior { ior 1.6 } }
#macro Put(Thing, Material, Where) object { Thing material { Material } transform { Where } } #end
#declare Still = transform { translate 0 }
Put(Floor, M, Still)
Put(Ball, material { texture { pigment { rgb <0.3, 0, 0> } finish { reflection 0.4 Gloss(100) } } }, transform {
  translate x })
POV

# ---- files that a scene writes and reads

scene "a file written and read back" << 'POV'
#fopen Out "numbers.txt" write
#for (I, 0, 4) #write (Out, I/5, ",", <I, 0, 1>, ",\n") #end
#fclose Out
#fopen In "numbers.txt" read
#while (defined(In))
  #read (In, Size, Where)
  sphere { Where - <2, -0.3, 1.5>, 0.3 pigment { rgb Size } finish { reflection 0.2 + Size/2 Gloss(100) } }
#end
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV

# ---- the text itself

as_text() {
    printf '#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#include "stage.inc"\n'
    printf 'object {\n\tFloor\n\tpigment {\n\t\trgb 0.3\n\t}\n\tfinish {\n\t\treflection
      0.5\n\t\tGloss(100)\n\t}\n}\n// end'
}
whole_scene "CRLF, tabs, no final newline" < <(as_text | sed 's/$/\r/')
whole_scene "CR alone ends a line" < <(as_text | tr '\n' '\r')
whole_scene "one line of 200,000 characters" < <(
    as_text
    printf '\n'
    for ((i = 0; i < 2000; i++)); do
        printf 'sphere { <%d.%03d, 0.1, -1.2>, 0.05 pigment { rgb <0.2, 0.5, 0.1> } finish { diffuse 0.7 } } ' \
            $((i % 3)) $((i % 1000))
    done
)
scene "copy of a finish then new reflection" << 'POV'
#declare F = finish { reflection 0.1 Gloss(100) }
#declare G = F;
object { Floor pigment { rgb 0.3 } finish { G reflection 0.5 } }
POV
scene "finish opened in both branches" << 'POV'
#declare Strong = 0;
object {
  Floor
  pigment { rgb 0.3 }
  #if (Strong) finish { reflection 0.9 #else finish { reflection 0.5 #end
  Gloss(100) }
}
POV
scene "local shadows then new reflection" << 'POV'
#declare F = finish { reflection 0.5 Gloss(100) }
#macro Dull() #local F = finish { diffuse 0.6 } object { Ball scale 0.6 translate x finish { F } pigment { rgb x } } #end
Dull()
object { Floor pigment { rgb 0.3 } finish { F reflection 0.4 } }
POV
scene "macro with braces that pair across branches" << 'POV'
#macro Thing(Kind, Where, P)
  #if (Kind = 0)
    union {
      object { Ball }
      box { <-0.2, 0, -0.2>, <0.2, 2, 0.2> }
  #else
    #if (Kind = 1)
      difference {
        object { Ball }
        box { <-2, 1, -2>, <2, 3, 2>
          texture {
            #if (P > 0)
              pigment { rgb <0.2, 0.1, 0.3> }
              finish { reflection 0.6 Gloss(P)
            #else
              pigment { rgb <0.8, 0.7, 0.3> }
              finish { diffuse 0.7
            #end
            phong 0.2 }
          }
        }
    #else
      merge {
        object { Ball }
        cylinder { 0, y*2, 0.3 }
    #end
  #end
    texture { pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
    scale 0.6
    translate Where
  }
#end
Thing(0, x*1.4, 100)
Thing(1, 0, 100)
Thing(1, <0.3, 0, -1.5>, 0)
Thing(2, x*(-1.4), 100)
object { Floor pigment { rgb 0.5 } }
POV
scene "places computed from the transmit of a colour" << 'POV'
#declare C = rgbt <1, 0, 0, 0.4>;
#declare D = color transmit 0.5 red 1;
object { Ball scale 0.5 translate <C.transmit*3, 0, D.transmit - 1.5> pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "assumed gamma in a dead branch" << 'POV'
#version 3.7;
#if (0) global_settings { assumed_gamma 2.2 } #else global_settings { assumed_gamma 1.0 } #end
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "loop variable tested before it is there" << 'POV'
#ifndef (K) object { Ball scale 0.5 translate x pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } } #end
#for (K, 0, 1) object { Ball scale 0.3 translate <K - 1, 0, -1> pigment { rgb 0.2*K } finish { reflection 0.5 Gloss(100) } } #end
#ifndef (Size) object { Ball scale 0.5 translate -x pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } } #end
#fopen Out "size.txt" write #write (Out, 0.4) #fclose Out
#fopen In "size.txt" read #read (In, Size) #fclose In
object { Floor pigment { rgb Size } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "version after a declare" << 'POV'
#declare Old = version;
#version 3.7;
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
#version Old;
POV
scene "array element then new reflection" << 'POV'
#declare F = array[2]
#declare F[0] = finish { reflection 0.1 Gloss(100) }
object { Floor pigment { rgb 0.3 } finish { F[0] reflection 0.5 } }
POV
scene "default finish after a plain mirror" << 'POV'
object { Ball scale 0.7 translate -x pigment { rgb <0.3, 0.1, 0> } finish { reflection 0.5 } }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
#default { finish { brilliance 3 } }
POV
scene "default finish in the middle" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
object { Ball scale 0.7 translate -x pigment { rgb <0.3, 0.1, 0> } finish { reflection 0.5 } }
#default { finish { ambient 0.3 diffuse 0.3 brilliance 3 metallic specular 0.5 roughness 0.1 conserve_energy } }
object { Ball translate x pigment { rgb <0.5, 0.3, 0.1> } finish { reflection 0.5 Gloss(100) } }
POV
scene "default normal in the middle" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
#default { normal { bumps 0.4 scale 0.3 } }
object { Ball translate x pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "default texture glossy then not" << 'POV'
#default { texture { pigment { rgb 0.3 } finish { reflection 0.4 Gloss(100) } } }
object { Floor }
#default { texture { pigment { rgb <0.4, 0.2, 0.1> } finish { reflection 0 } } }
object { Ball translate x }
POV
scene "untextured objects between two defaults" << 'POV'
#default { pigment { rgb <0.7, 0.3, 0.1> } }
object { Ball scale 0.6 translate x }
#default { pigment { rgb <0.1, 0.3, 0.7> } finish { ambient 0.2 } }
object { Ball scale 0.6 translate -x }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
end_of_scenes
