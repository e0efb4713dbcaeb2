// povgloss render contact.pov +W640 +H480 +A0.3 -o contact.png
// Things that touch a terrace of glossy hexagonal tiles in the evening: a ball, blocks standing and leaning, a cone, a ring,
// a fan of thin rods. Mirror images are sharp where they begin and soften with every centimetre of height.
// The tiles differ in reflectivity, not in gloss: all of them blur alike.
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }

camera {
  location <0.4, 2.30, -6.6>
  up y
  right x*image_width/image_height
  angle 49
  look_at <0.1, 0.58, 0>
}

// ---- Evening: light from the low sun on the left, blue from the sky on the right.

sky_sphere {
  pigment {
    gradient y
    color_map {
      [0.00 rgb <1.15, 0.50, 0.16>]
      [0.07 rgb <1.20, 0.62, 0.26>]
      [0.16 rgb <0.90, 0.46, 0.42>]
      [0.30 rgb <0.42, 0.27, 0.48>]
      [0.55 rgb <0.12, 0.15, 0.42>]
      [1.00 rgb <0.03, 0.06, 0.24>]
    }
  }
  pigment {
    wrinkles turbulence 0.4 octaves 4
    color_map {
      [0.50 rgbt <1.2, 0.75, 0.45, 1>]
      [0.90 rgbt <1.3, 0.80, 0.50, 0.55>]
    }
    scale <1.2, 0.09, 1.2>
    rotate z*4
  }
}
light_source { <-60, 34, -22> rgb <1.75, 1.28, 0.84> parallel point_at 0 }
light_source { <40, 60, -30> rgb <0.34, 0.38, 0.56> area_light <24, 0, 16>, <0, 24, 0>, 3, 3 adaptive 1 }
light_source { <5, 3, -40> rgb <0.16, 0.15, 0.18> shadowless }

// ---- The terrace

#declare Tile_Gloss = finish {
  ambient 0 diffuse 0.7
  Gloss(300)
}

#macro Tile(Colour, Low, High)
  texture {
    pigment { Colour }
    finish { Tile_Gloss reflection { Low, High fresnel } }
  }
#end

cylinder {
  -y*0.5, 0, 13
  texture {
    hexagon
    Tile(srgb <0.05, 0.14, 0.20>, 0.42, 0.75)
    Tile(srgb <0.10, 0.30, 0.36>, 0.28, 0.65)
    Tile(srgb <0.62, 0.60, 0.52>, 0.16, 0.50)
    scale 0.40
    rotate y*17
    translate <0.2, 0, 0.1>
  }
  interior { ior 1.55 }
}

// Beyond its edge: a valley and two ranges of hills.
#declare Hill_Seed = seed(77);
union {
  plane { y, -6 pigment { srgb <0.72, 0.52, 0.52> } }
  #declare Row = 0;
  #while (Row < 3)
    #declare I = 0;
    #while (I < 12)
      sphere {
        0, 1
        scale <14 + 16*rand(Hill_Seed), 5.0 + 2.0*Row + 3.2*rand(Hill_Seed)*rand(Hill_Seed), 8>
        translate <-130 + 260*(I + 0.9*rand(Hill_Seed))/12, -5, 45 + 20*Row>
        pigment { srgb <0.34, 0.27, 0.42> + Row*<0.15, 0.08, 0.05> }
      }
      #declare I = I + 1;
    #end
    #declare Row = Row + 1;
  #end
  finish { ambient 0 diffuse 0.45 emission 0.35 }
}

// ---- What stands there

#declare Chalk = finish { ambient 0 diffuse 0.85 }
#declare Glaze = finish { ambient 0 diffuse 0.8 specular 0.35 roughness 0.02 }

#declare Coral = srgb <0.93, 0.40, 0.30>;
#declare Ivory = srgb <0.95, 0.91, 0.82>;
#declare Sea = srgb <0.16, 0.55, 0.58>;
#declare Ochre = srgb <0.94, 0.68, 0.22>;

#macro Block(Size, Edge)
  union {
    box { -Size/2 + <Edge, 0, Edge>, Size/2 - <Edge, 0, Edge> }
    box { -Size/2 + <0, Edge, Edge>, Size/2 - <0, Edge, Edge> }
    box { -Size/2 + <Edge, Edge, 0>, Size/2 - <Edge, Edge, 0> }
    translate y*Size.y/2
  }
#end

// A tall block, and a plank that leans on it: its corner touches the floor.
#declare Lean = 24;
#declare Plank = <0.16, 2.15, 0.46>;
union {
  object {
    Block(<0.72, 2.1, 0.72>, 0.012)
    texture {
      pigment {
        gradient y
        color_map { [0.0 Ivory] [0.5 Ivory] [0.5 Sea] [1.0 Sea] }
        scale 0.525
      }
      finish { Chalk }
    }
  }
  box {
    0, Plank
    texture { pigment { Ochre } finish { Chalk } }
    rotate z*Lean
    translate <0.36 + Plank.y*sin(radians(Lean)), 0, -0.23>
  }
  rotate y*22
  translate <-1.40, 0, 0.70>
}

// A ball, and a cube that stands on one edge and leans on it.
#declare Ball = sphere { y, 1 scale 0.62 }
object {
  Ball
  texture {
    pigment {
      gradient y
      color_map { [0.00 Coral] [0.42 Coral] [0.42 Ivory] [0.58 Ivory] [0.58 Coral] [1.00 Coral] }
      scale 1.24
    }
    finish { Glaze }
    translate y*(-0.62) rotate <20, 0, -28> translate y*0.62
  }
  translate <0.82, 0, -0.62>
}
box {
  0, 0.42
  texture { pigment { Sea } finish { Chalk } }
  rotate z*31
  rotate y*14
  translate <1.61, 0, -0.86>
}

cone {
  0, 0.46, y*1.55, 0
  texture {
    pigment {
      spiral1 1
      color_map { [0.5 Ivory] [0.5 Coral] }
      rotate x*90
      scale 0.9
    }
    finish { Chalk }
  }
  translate <2.15, 0, 0.85>
}

// A ring lies flat, another stands on its edge, turned to the light.
torus { 0.36, 0.11 texture { pigment { Ochre } finish { Glaze } } translate <-0.42, 0.11, -1.55> }
torus {
  0.52, 0.085
  texture {
    pigment {
      radial
      color_map { [0.5 Sea] [0.5 Ivory] }
      frequency 8
    }
    finish { Glaze }
  }
  rotate x*90 rotate y*38
  translate <-2.05, 0.605, -0.55>
}

// Thin rods fan out of one line, like a comb that has been trodden on.
#declare Rod_Seed = seed(4);
#declare I = 0;
#while (I < 11)
  cylinder {
    0, y*(1.15 + 0.9*sin(pi*I/10)), 0.022
    texture {
      pigment {
        #switch (mod(I, 4))
          #case (0) Coral #break
          #case (1) Ivory #break
          #case (2) Sea #break
          #else Ochre
        #end
      }
      finish { Glaze }
    }
    rotate <8*(rand(Rod_Seed) - 0.5), 0, -16 + 32*(10 - I)/10>
    translate <0.25 + 0.115*I, 0, 1.75>
  }
  #declare I = I + 1;
#end
