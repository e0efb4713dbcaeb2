// povgloss render metal.pov +W640 +H480 +A0.3 -o metal.png
// Satin gold, copper and bronze on a walnut table: metals tint what they mirror, more so face on than at a glancing angle.
// The casket is wood under a clear coat: the upper of two texture layers is the glossy one, the lower one is not.
// The looking-glass on the wall is a perfect mirror without Gloss(); it shows the metal from behind.
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 max_trace_level 6 }

camera {
  location <-0.35, 1.95, -4.4>
  up y
  right x*image_width/image_height
  angle 42
  look_at <0.03, 0.72, 0>
}

// ---- A room with a tall window on the left, behind the camera a bright one, and warm walls.

light_source {
  <-4.6, 4.4, -2.6> rgb <1.75, 1.62, 1.42>
  area_light <0.6, 0, -1.0>, <0, 1.6, 0>, 3, 3 adaptive 1
}
light_source { <4.2, 2.8, -2.8> rgb <0.46, 0.35, 0.25> }
light_source { <0, 2.4, -4.5> rgb 0.26 shadowless }

#declare Wall_Paint = finish { ambient 0 diffuse 0.75 emission 0.12 }

box {
  <-6, -1, 2.2>, <6, 6, 2.4>
  pigment {
    gradient x
    color_map { [0.5 srgb <0.16, 0.33, 0.31>] [0.5 srgb <0.19, 0.37, 0.35>] }
    scale 0.44
  }
  finish { Wall_Paint }
}
box {
  <-6.2, -1, -8>, <-6, 6, 2.2>
  pigment { srgb <0.78, 0.70, 0.58> }
  finish { Wall_Paint }
}
box {
  <6, -1, -8>, <6.2, 6, 2.2>
  pigment {
    gradient z
    color_map {
      [0.4 srgb <0.68, 0.26, 0.19>] [0.4 srgb <0.86, 0.58, 0.30>]
      [0.7 srgb <0.86, 0.58, 0.30>] [0.7 srgb <0.24, 0.32, 0.44>]
    }
    scale 3
  }
  finish { Wall_Paint emission 0.26 }
}
box { <-6, -1, -8.2>, <6, 6, -8> pigment { srgb <0.80, 0.62, 0.50> } finish { Wall_Paint } }
box { <-6, 6, -8>, <6, 6.2, 2.2> pigment { srgb <0.72, 0.68, 0.62> } finish { Wall_Paint } }

box {
  <-6, -1.2, -8>, <6, -1, 2.2>
  pigment {
    gradient z
    color_map {
      [0.55 srgb <0.66, 0.50, 0.38>] [0.55 srgb <0.50, 0.22, 0.20>]
      [0.80 srgb <0.50, 0.22, 0.20>] [0.80 srgb <0.80, 0.68, 0.50>]
    }
    scale 2.4
  }
  finish { Wall_Paint emission 0.25 }
}

// Window panes: they glow, the light itself comes from the light sources.
#macro Window(Pane_Light)
  union {
    #local I = 0;
    #while (I < 6)
      box { <-0.95 + mod(I, 2), 0.05 + 1.1*div(I, 2), 0>, <-0.05 + mod(I, 2), 1.1 + 1.1*div(I, 2), 0.02> }
      #local I = I + 1;
    #end
    pigment { rgb Pane_Light }
    finish { ambient 0 diffuse 0 emission 1 }
    no_shadow
  }
#end
object { Window(<1.7, 1.75, 1.8>) rotate y*90 scale <1, 1, 1.5> translate <-5.9, 1.3, -2.2> }
object { Window(<1.5, 1.3, 1.0>) translate <2.4, 1.2, -7.9> }

// ---- The looking-glass

#declare Gilt_Frame = finish { ambient 0.03 diffuse 0.6 specular 0.5 roughness 0.04 metallic }
union {
  box {
    <-1.08, -0.55, 0>, <1.08, 0.55, 0.03>
    pigment { rgb 0 }
    finish { ambient 0 diffuse 0 reflection 0.86 }
  }
  #declare Rim = difference {
    box { <-1.18, -0.65, -0.06>, <1.18, 0.65, 0.05> }
    box { <-1.07, -0.54, -1>, <1.07, 0.54, 1> }
  }
  object { Rim pigment { srgb <0.72, 0.52, 0.26> } finish { Gilt_Frame } }
  rotate x*(-8)
  translate <-0.10, 1.29, 2.05>
}

// ---- The table

#declare Grain = pigment {
  wood turbulence <0.05, 0.05, 0.3> octaves 4
  color_map {
    [0.0 srgb <0.56, 0.38, 0.25>]
    [0.7 srgb <0.51, 0.34, 0.22>]
    [1.0 srgb <0.42, 0.27, 0.17>]
  }
  scale <0.16, 0.16, 1.8>
}
union {
  cylinder { -y*0.06, 0, 2.05 }
  torus { 2.05, 0.03 translate -y*0.03 }
  pigment { Grain rotate <3, 68, 0> translate y*0.3 }
  finish { ambient 0 diffuse 0.8 specular 0.1 roughness 0.08 }
  translate z*0.1
}

// ---- Metals

#declare Matt = finish { ambient 0 diffuse 0.75 }
#declare Metal_Ior = 8;

#macro Metal(Tint, Shininess)
  texture {
    pigment { rgb Tint }
    finish {
      ambient 0 diffuse 0.22
      specular 0.35 roughness 0.025 metallic
      conserve_energy
      reflection { 0.1, 0.95 fresnel metallic }
      Gloss(Shininess)
    }
  }
  interior { ior Metal_Ior }
#end
#declare Gold = <1.00, 0.60, 0.20>;
#declare Copper = <0.97, 0.36, 0.20>;
#declare Bronze = <0.78, 0.50, 0.27>;

// A big ring stands on the table, two thin ones lie about.
torus {
  0.42, 0.105
  Metal(Gold, 260)
  rotate x*90
  rotate y*(-28)
  translate <-0.28, 0.525, -0.42>
}
torus { 0.17, 0.022 Metal(Gold, 260) translate <0.60, 0.022, -1.12> }
torus { 0.17, 0.022 Metal(Copper, 260) rotate x*7 translate <0.80, 0.062, -1.00> }

// A copper vase.
lathe {
  cubic_spline
  12,
  <0, -0.05>, <0.001, 0.004>, <0.24, 0.0>, <0.30, 0.04>, <0.42, 0.34>, <0.36, 0.66>,
  <0.17, 0.90>, <0.15, 1.04>, <0.235, 1.16>, <0.20, 1.15>, <0.12, 1.02>, <0.1, 0.9>
  Metal(Copper, 260)
  translate <-1.16, 0, 0.35>
}

// A bronze paperweight, nearly a cube.
superellipsoid {
  <0.28, 0.28>
  Metal(Bronze, 260)
  scale 0.24
  rotate y*32
  translate <-1.12, 0.24, -0.78>
}

// A gold bowl on a foot, with three balls in it.
union {
  difference {
    sphere { 0, 0.46 }
    sphere { 0, 0.435 }
    plane { -y, 0.10 }
    translate y*0.62
  }
  torus { 0.437, 0.0125 translate y*0.52 }
  cone { 0, 0.24, y*0.035, 0.21 }
  cone { y*0.035, 0.06, y*0.19, 0.045 }
  sphere { <-0.17, 0.36, -0.05>, 0.14 pigment { srgb <0.20, 0.38, 0.55> } finish { Matt } }
  sphere { <0.14, 0.36, -0.10>, 0.14 pigment { srgb <0.92, 0.87, 0.76> } finish { Matt } }
  sphere { <0.02, 0.37, 0.17>, 0.14 pigment { srgb <0.80, 0.28, 0.20> } finish { Matt } }
  Metal(Gold, 260)
  translate <0.30, 0, 0.78>
}

// ---- The casket: a clear coat over wood.

#declare Clear_Coat = finish {
  ambient 0 diffuse 0
  reflection { 0.05, 1 fresnel }
  Gloss(260)
}
#declare Casket = box { <-0.46, 0, -0.30>, <0.46, 0.46, 0.30> }
union {
  object {
    Casket
    texture {
      pigment {
        wood turbulence 0.09 octaves 3
        color_map {
          [0.0 srgb <0.66, 0.24, 0.12>]
          [0.6 srgb <0.55, 0.17, 0.09>]
          [1.0 srgb <0.36, 0.09, 0.06>]
        }
        scale <0.05, 0.05, 0.7>
        rotate <3, 82, 0>
      }
      finish { ambient 0 diffuse 0.75 }
    }
    texture {
      pigment { rgbt 1 }
      finish { Clear_Coat }
    }
    interior { ior 1.6 }
  }
  // Fittings.
  box { <-0.06, 0.24, -0.315>, <0.06, 0.38, -0.29> Metal(Gold, 260) }
  box { <-0.47, 0.335, -0.306>, <0.47, 0.345, 0.306> pigment { srgb <0.20, 0.09, 0.06> } finish { ambient 0 diffuse 0.6 } }
  sphere { <0, 0.27, -0.325>, 0.022 pigment { srgb <0.10, 0.08, 0.07> } finish { ambient 0 diffuse 0.6 } }
  rotate y*24
  translate <1.02, 0, -0.22>
}

// A candlestick, and a pear.
union {
  cylinder { 0, y*0.03, 0.17 Metal(Bronze, 260) }
  cone { y*0.03, 0.07, y*0.62, 0.035 Metal(Bronze, 260) }
  torus { 0.07, 0.03 translate y*0.62 Metal(Bronze, 260) }
  cylinder { y*0.60, y*1.28, 0.042 pigment { srgb <0.94, 0.86, 0.70> } finish { Matt emission 0.05 } }
  translate <1.42, 0, 0.72>
}
union {
  sor {
    7, <0.0, -0.03>, <0.06, 0.0>, <0.165, 0.12>, <0.135, 0.25>, <0.075, 0.36>, <0.0, 0.42>, <0.0, 0.44>
    pigment {
      bozo
      color_map { [0.3 srgb <0.62, 0.68, 0.22>] [0.8 srgb <0.84, 0.74, 0.28>] }
      scale 0.1
    }
  }
  cylinder { <0, 0.40, 0>, <0.03, 0.50, 0.01>, 0.011 pigment { srgb <0.30, 0.20, 0.12> } }
  finish { Matt }
  translate <0.12, 0, -0.98>
}
