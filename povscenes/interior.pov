// povgloss render interior.pov +W640 +H480 +A0.3 -o interior.png
// A dining room in the afternoon: herringbone oak under a coat of lacquer, which mirrors the French window, the shelf, the
// chairs and the lamp. Where a leg touches the floor its image is sharp; the top of the window, metres away, is soft.
// Declare=Roughness=0.5 gives another floor: 0 is a perfect mirror, 0.1 is polished, 0.5 hardly reflects shapes at all.
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 max_trace_level 6 }

#ifndef (Roughness) #declare Roughness = 0.2; #end

camera {
  location <1.25, 1.42, -1.75>
  up y
  right x*image_width/image_height
  angle 62
  look_at <-0.12, 0.72, 3.2>
}

// ---- Light: the sun through the window, the sky, a lamp above the table, and two dim ones for what the walls give back.

sky_sphere {
  pigment {
    gradient y
    color_map {
      [0.00 rgb <1.25, 1.12, 0.86>]
      [0.12 rgb <0.86, 1.02, 1.15>]
      [0.40 rgb <0.42, 0.70, 1.15>]
      [1.00 srgb <0.16, 0.36, 0.70>]
    }
  }
}

light_source { <-15, 29, 46> rgb <2.5, 2.0, 1.4> parallel point_at <-1, 0, 3> }
light_source {
  <-1.05, 1.5, 4.95> rgb <0.46, 0.53, 0.62>
  area_light x*1.2, y*1.2, 3, 3 adaptive 1
  fade_distance 3 fade_power 1
}
light_source {
  <0.2, 2.75, 0.2> rgb <0.42, 0.40, 0.38>
  area_light x*0.7, z*0.7, 3, 3 adaptive 1
}
light_source { <0.2, 0.1, 1.6> rgb <0.50, 0.42, 0.33> shadowless fade_distance 1.6 fade_power 1 }
light_source { <1.2, 1.5, -2.6> rgb 0.20 shadowless }
light_source {
  <0.75, 1.60, 2.75> rgb <0.80, 0.56, 0.31>
  spotlight point_at <0.75, 0, 2.75> radius 40 falloff 80
  fade_distance 1.1 fade_power 2
}

// ---- Textures

#declare Matte = finish { ambient 0 diffuse 0.8 }
#declare Satin = finish { ambient 0 diffuse 0.75 specular 0.18 roughness 0.03 }

#declare White_Paint = texture { pigment { srgb <0.93, 0.92, 0.89> } finish { Satin } }
#declare Brass = texture {
  pigment { srgb <0.82, 0.62, 0.30> }
  finish { ambient 0.04 diffuse 0.55 specular 0.7 roughness 0.02 metallic }
}
#declare Black_Iron = texture { pigment { srgb <0.13, 0.13, 0.14> } finish { Satin } }
#declare Walnut = texture {
  pigment {
    wood turbulence 0.06 octaves 3
    color_map {
      [0.0 srgb <0.47, 0.30, 0.18>]
      [0.6 srgb <0.42, 0.26, 0.15>]
      [1.0 srgb <0.34, 0.20, 0.11>]
    }
    scale <0.06, 0.06, 1> rotate y*90 rotate z*3
  }
  finish { Satin }
}

#declare Lacquer = finish {
  ambient 0 diffuse 0.62
  reflection { 0.22, 0.9 fresnel }
  Gloss_Roughness(Roughness)
}

// ---- The floor: every block of the herringbone is a box with a grain of its own.

#declare Room_Left = -2.6;
#declare Room_Right = 2.7;
#declare Room_Back = 5.4;
#declare Room_Front = -3.2;
#declare Room_Height = 2.9;

#declare Block_Width = 0.14;
#declare Block_Ratio = 5;

#macro Oak_Block(Seed)
  #local Tone = 0.72 + 0.42*rand(Seed);
  #local Warm = 0.92 + 0.13*rand(Seed);
  box {
    <0, -0.02, 0>, <Block_Ratio, 0, 1>
    texture {
      pigment {
        wood turbulence <0.02, 0.10, 0.10> octaves 4
        color_map {
          [0.00 rgb <0.47, 0.235*Warm, 0.085*Warm>*Tone]
          [0.60 rgb <0.43, 0.208*Warm, 0.073*Warm>*Tone]
          [0.92 rgb <0.36, 0.168*Warm, 0.056*Warm>*Tone]
          [1.00 rgb <0.46, 0.228*Warm, 0.081*Warm>*Tone]
        }
        rotate y*90
        scale <8, 0.40, 0.40>
        rotate <0, 3 - 6*rand(Seed), 2 - 4*rand(Seed)>
        translate <20*rand(Seed), 1.5 + rand(Seed), 6*rand(Seed) - 3>
      }
      finish { Lacquer }
    }
  }
#end

#declare Floor = union {
  #local Oak_Seed = seed(1871);
  #local Period = 2*Block_Ratio;
  #local Reach = 52;
  #local X = -Reach;
  #while (X < Reach)
    #local Z = -Reach;
    #while (Z < Reach)
      // X and Z run along the blocks, at 45 degrees to the room.
      #local Room_X = (X + Z)*Block_Width*0.7071;
      #local Room_Z = (Z - X)*Block_Width*0.7071 + 1.1;
      #if (Room_X > Room_Left - 0.8 & Room_X < Room_Right + 0.8 & Room_Z > Room_Front - 0.8 & Room_Z < Room_Back + 0.8)
        #if (mod(X - Z + 20*Period, Period) = 0)
          object { Oak_Block(Oak_Seed) translate <X, 0, Z> }
        #end
        #if (mod(X - Z + 20*Period, Period) = Period - 1)
          object { Oak_Block(Oak_Seed) rotate -y*90 translate <X + 1, 0, Z> }
        #end
      #end
      #local Z = Z + 1;
    #end
    #local X = X + 1;
  #end
  scale <Block_Width, 1, Block_Width>
  rotate y*45
  translate z*1.1
  interior { ior 1.5 }
}
object { Floor }

// ---- Walls. Corners and edges get less light: the pigment says so, as there is no radiosity here.

#macro Wall_Paint(Light, Dark)
  texture {
    pigment {
      function {
        (1 - 0.45*exp(-y/0.30))*(1 - 0.40*exp((y - Room_Height)/0.35))
        *(1 - 0.45*exp(-abs(x - Room_Left)/0.35))*(1 - 0.45*exp(-abs(x - Room_Right)/0.35))
        *(1 - 0.45*exp(-abs(z - Room_Back)/0.35))
      }
      color_map { [0 Dark] [1 Light] }
    }
    finish { Matte }
  }
#end

#declare Teal = srgb <0.20, 0.43, 0.47>;
#declare Cream = srgb <0.90, 0.86, 0.78>;
#declare Window_Left = -1.95;
#declare Window_Right = -0.15;
#declare Window_Top = 2.42;

difference {
  box { <Room_Left - 0.25, -0.1, Room_Back>, <Room_Right + 0.25, Room_Height + 0.1, Room_Back + 0.28> }
  box { <Window_Left, -0.2, Room_Back - 1>, <Window_Right, Window_Top, Room_Back + 1> }
  Wall_Paint(Teal, Teal*0.35)
}
union {
  box { <Room_Left - 0.2, -0.1, Room_Front>, <Room_Left, Room_Height + 0.1, Room_Back> }
  box { <Room_Right, -0.1, Room_Front>, <Room_Right + 0.2, Room_Height + 0.1, Room_Back> }
  box { <Room_Left, -0.1, Room_Front - 0.2>, <Room_Right, Room_Height + 0.1, Room_Front> }
  Wall_Paint(Cream, Cream*0.45)
}
box {
  <Room_Left - 0.25, Room_Height, Room_Front - 0.2>, <Room_Right + 0.25, Room_Height + 0.2, Room_Back + 0.3>
  texture { pigment { srgb <0.94, 0.92, 0.88> } finish { Matte } }
}

union {
  box { <Room_Left, 0, Room_Back - 0.018>, <Window_Left - 0.07, 0.11, Room_Back> }
  box { <Window_Right + 0.07, 0, Room_Back - 0.018>, <Room_Right, 0.11, Room_Back> }
  box { <Room_Left, 0, Room_Front>, <Room_Left + 0.018, 0.11, Room_Back> }
  box { <Room_Right - 0.018, 0, Room_Front>, <Room_Right, 0.11, Room_Back> }
  texture { White_Paint }
}

// ---- The French window: a frame, two sashes with glazing bars, and what lies outside.

#macro Sash(Left, Right)
  union {
    #local Bottom = 0.06;
    #local Top = Window_Top - 0.06;
    box { <Left, Bottom, 0>, <Left + 0.065, Top, 0.05> }
    box { <Right - 0.065, Bottom, 0>, <Right, Top, 0.05> }
    box { <Left, Bottom, 0>, <Right, Bottom + 0.34, 0.05> }
    box { <Left, Top - 0.065, 0>, <Right, Top, 0.05> }
    #local I = 1;
    #while (I < 4)
      #local H = Bottom + 0.34 + (Top - Bottom - 0.40)*I/4;
      box { <Left, H - 0.014, 0.01>, <Right, H + 0.014, 0.04> }
      #local I = I + 1;
    #end
    box { <(Left + Right)/2 - 0.014, Bottom, 0.01>, <(Left + Right)/2 + 0.014, Top, 0.04> }
  }
#end
union {
  difference {
    box { <Window_Left - 0.08, 0, -0.03>, <Window_Right + 0.08, Window_Top + 0.08, 0.16> }
    box { <Window_Left + 0.05, -0.1, -1>, <Window_Right - 0.05, Window_Top - 0.05, 1> }
  }
  Sash(Window_Left + 0.05, (Window_Left + Window_Right)/2)
  Sash((Window_Left + Window_Right)/2, Window_Right - 0.05)
  box { <Window_Left, -0.02, -0.02>, <Window_Right, 0.045, 0.28> }
  union {
    sphere { -z*0.03, 0.022 }
    cylinder { -z*0.03, z*0.02, 0.01 }
    texture { Brass }
    translate <(Window_Left + Window_Right)/2 + 0.03, 1.05, 0>
  }
  texture { White_Paint }
  translate z*Room_Back
}

#macro Tree(Height, Green)
  union {
    cylinder { 0, y*Height*0.5, Height*0.035 pigment { srgb <0.33, 0.25, 0.18> } }
    sphere { <0, 0.62, 0>*Height, 0.27*Height }
    sphere { <0.13, 0.78, 0.05>*Height, 0.21*Height }
    sphere { <-0.15, 0.75, -0.05>*Height, 0.20*Height }
    sphere { <0.03, 0.92, 0>*Height, 0.15*Height }
    pigment { bozo color_map { [0.2 Green*0.7] [0.8 Green] } scale 0.16*Height }
    finish { ambient 0 diffuse 0.55 emission 0.80 }
  }
#end
union {
  plane { y, -0.45 pigment { srgb <0.52, 0.62, 0.28> } }
  sphere { 0, 1 scale <60, 9, 20> translate <-45, -3, 75> pigment { srgb <0.42, 0.56, 0.40> } }
  sphere { 0, 1 scale <80, 13, 20> translate <30, -4, 110> pigment { srgb <0.47, 0.60, 0.58> } }
  box { <-30, -0.5, 24>, <30, 0.45, 25> pigment { srgb <0.33, 0.46, 0.22> } }
  object { Tree(3.6, srgb <0.55, 0.66, 0.22>) translate <-7.3, -0.45, 18.5> }
  object { Tree(3.2, srgb <0.84, 0.60, 0.18>) translate <-6.6, -0.45, 26> }
  object { Tree(5.4, srgb <0.36, 0.54, 0.26>) translate <-13.6, -0.45, 27> }
  box { <-8, -0.46, Room_Back + 0.28>, <6, -0.02, 8.4> pigment { srgb <0.78, 0.72, 0.64> } }
  finish { ambient 0 diffuse 0.5 emission 0.90 }
}

// Curtains: folds are cylinders side by side, thick and thin.
#macro Curtain(Width, Folds)
  union {
    #local I = 0;
    #while (I < Folds)
      #local Fold = Width/Folds;
      cylinder { <Fold*(I + 0.5), 0.015, -0.03*mod(I, 2)>, <Fold*(I + 0.5), 2.58, -0.03*mod(I, 2)>, Fold*(0.66 + 0.12*mod(I, 3)) }
      #local I = I + 1;
    #end
  }
#end
union {
  object { Curtain(0.46, 8) translate <-2.42, 0, 5.27> }
  object { Curtain(0.40, 7) translate <-0.12, 0, 5.27> }
  texture { pigment { srgb <0.87, 0.62, 0.20> } finish { Matte } }
}
union {
  cylinder { <-2.5, 2.6, 5.27>, <0.4, 2.6, 5.27>, 0.016 }
  sphere { <-2.5, 2.6, 5.27>, 0.035 }
  sphere { <0.4, 2.6, 5.27>, 0.035 }
  texture { Brass }
}

// ---- The shelf, with books in rows, some leaning, and a few other things.

#declare Shelf_Width = 1.36;
#declare Shelf_Height = 2.16;

#declare Book_Colour = array[9] {
  srgb <0.76, 0.22, 0.16>, srgb <0.92, 0.86, 0.72>, srgb <0.15, 0.27, 0.45>,
  srgb <0.90, 0.66, 0.20>, srgb <0.22, 0.45, 0.38>, srgb <0.86, 0.45, 0.25>,
  srgb <0.35, 0.18, 0.26>, srgb <0.55, 0.68, 0.70>, srgb <0.96, 0.94, 0.90>
}

#declare Gilt = srgb <0.50, 0.40, 0.20>;

#macro Book_Row(From, To, Room, Seed)
  #local At = From;
  #while (At < To - 0.05)
    #local Thick = 0.022 + 0.034*rand(Seed);
    #local Tall = Room*(0.66 + 0.26*rand(Seed));
    #local Deep = 0.17 + 0.06*rand(Seed);
    #local Ink = Book_Colour[int(8.999*rand(Seed))];
    union {
      box { <0, 0, 0>, <Thick*0.96, Tall, Deep> pigment { Ink } }
      box { <-0.0004, Tall*0.80, -0.0006>, <Thick*0.96 + 0.0004, Tall*0.84, 0.02> pigment { Ink*0.35 + Gilt } }
      finish { Satin }
      #if (rand(Seed) > 0.9)
        #local At = At + 0.05;
        rotate z*9
        translate x*0.01
      #end
      translate <At, 0, 0.02>
    }
    #local At = At + Thick;
  #end
#end

#declare Shelf = union {
  #local Book_Seed = seed(58);
  box { <0, 0, 0>, <0.035, Shelf_Height, 0.32> texture { Walnut rotate z*90 } }
  box { <Shelf_Width - 0.035, 0, 0>, <Shelf_Width, Shelf_Height, 0.32> texture { Walnut rotate z*90 } }
  box { <0, 0, 0.30>, <Shelf_Width, Shelf_Height, 0.32> texture { pigment { srgb <0.30, 0.19, 0.12> } finish { Matte } } }
  #local Level = 0;
  #while (Level < 6)
    #local H = 0.07 + Level*(Shelf_Height - 0.10)/5;
    box { <0.035, H - 0.03, 0.005>, <Shelf_Width - 0.035, H, 0.30> texture { Walnut translate Level*0.37 } }
    #local Level = Level + 1;
  #end
  #local Pitch = (Shelf_Height - 0.10)/5;
  union { Book_Row(0.05, 0.80, Pitch, Book_Seed) translate y*0.07 }
  union { Book_Row(0.42, 1.30, Pitch, Book_Seed) translate y*(0.07 + Pitch) }
  union { Book_Row(0.05, 1.31, Pitch, Book_Seed) translate y*(0.07 + 2*Pitch) }
  union { Book_Row(0.05, 0.62, Pitch, Book_Seed) translate y*(0.07 + 3*Pitch) }
  union { Book_Row(0.60, 1.30, Pitch, Book_Seed) translate y*(0.07 + 4*Pitch) }
  // A box, a bowl, a globe and a jar.
  box { <0.88, 0.07, 0.03>, <1.26, 0.33, 0.27> texture { pigment { srgb <0.85, 0.80, 0.70> } finish { Satin } } }
  box { <1.02, 0.20, 0.02>, <1.12, 0.23, 0.04> texture { Brass } }
  sphere {
    <0.22, 0.62, 0.14>, 0.11
    texture {
      pigment { granite color_map { [0.45 srgb <0.25, 0.47, 0.66>] [0.5 srgb <0.78, 0.72, 0.45>] } scale 0.4 }
      finish { Satin }
    }
  }
  cylinder { <0.22, 0.07 + Pitch, 0.14>, <0.22, 0.09 + Pitch, 0.14>, 0.06 texture { Brass } }
  sor {
    6, <0, -0.02>, <0.06, 0>, <0.13, 0.12>, <0.06, 0.26>, <0.07, 0.30>, <0.09, 0.33>
    translate <1.0, 0.07 + 3*Pitch, 0.15>
    texture { pigment { srgb <0.88, 0.38, 0.26> } finish { Satin } }
  }
  cone {
    <0.3, 0.07 + 4*Pitch, 0.15>, 0.06, <0.3, 0.24 + 4*Pitch, 0.15>, 0.14
    texture { pigment { srgb <0.93, 0.91, 0.86> } finish { Satin } }
  }
}
object { Shelf translate <1.10, 0, Room_Back - 0.34> }

// ---- Table and chairs

#declare Table = union {
  cylinder { y*0.71, y*0.745, 0.58 texture { Walnut scale 1.6 } }
  torus { 0.58, 0.0175 translate y*0.7275 texture { Walnut } }
  cone { y*0.015, 0.24, y*0.045, 0.20 texture { Black_Iron } }
  cylinder { 0, y*0.015, 0.24 texture { Black_Iron } }
  cylinder { y*0.04, y*0.71, 0.035 texture { Black_Iron } }
  cone { y*0.58, 0.035, y*0.71, 0.12 texture { Black_Iron } }
}

#macro Chair_Leg(Foot, Top)
  cone { Foot, 0.011, Top, 0.021 }
#end
#macro Chair(Cloth)
  union {
    union {
      Chair_Leg(<-0.22, 0, -0.21>, <-0.17, 0.44, -0.16>)
      Chair_Leg(<0.22, 0, -0.21>, <0.17, 0.44, -0.16>)
      Chair_Leg(<-0.21, 0, 0.24>, <-0.17, 0.44, 0.16>)
      Chair_Leg(<0.21, 0, 0.24>, <0.17, 0.44, 0.16>)
      cylinder { <-0.19, 0.25, -0.18>, <-0.19, 0.25, 0.20>, 0.010 }
      cylinder { <0.19, 0.25, -0.18>, <0.19, 0.25, 0.20>, 0.010 }
      cone { <-0.17, 0.44, 0.17>, 0.017, <-0.182, 0.66, 0.205>, 0.013 }
      cone { <0.17, 0.44, 0.17>, 0.017, <0.182, 0.66, 0.205>, 0.013 }
      texture { pigment { srgb <0.40, 0.25, 0.15> } finish { Satin } }
    }
    superellipsoid { <0.35, 0.35> rotate x*90 scale <0.235, 0.04, 0.225> translate y*0.455 }
    // The back is a piece of a tall ring.
    intersection {
      difference {
        cylinder { y*0.60, y*0.86, 0.36 }
        cylinder { y*0.50, y*0.96, 0.33 }
      }
      box { <-0.24, 0, 0>, <0.24, 1, 0.5> }
      translate z*(-0.085)
    }
    texture { pigment { Cloth } finish { Matte } }
  }
#end

object { Table translate <0.75, 0, 2.75> }
object { Chair(srgb <0.83, 0.30, 0.20>) rotate y*-128 translate <-0.08, 0, 2.15> }
object { Chair(srgb <0.93, 0.88, 0.78>) rotate y*38 translate <1.38, 0, 3.45> }
object { Chair(srgb <0.22, 0.40, 0.58>) rotate y*-28 translate <0.12, 0, 3.52> }

// On the table: a vase with twigs, a bowl of fruit, a book.
#declare Vase = union {
  sor {
    7, <0, -0.02>, <0.055, 0>, <0.095, 0.09>, <0.070, 0.20>, <0.030, 0.27>, <0.045, 0.31>, <0.06, 0.33>
    texture { pigment { srgb <0.94, 0.93, 0.90> } finish { Satin } }
  }
  #local Twig_Seed = seed(12);
  #local I = 0;
  #while (I < 9)
    #local Tip = <0.26*(rand(Twig_Seed) - 0.5)*2, 0.50 + 0.22*rand(Twig_Seed), 0.20*(rand(Twig_Seed) - 0.5)*2>;
    cylinder { y*0.25, Tip, 0.004 texture { pigment { srgb <0.30, 0.34, 0.18> } finish { Matte } } }
    #local J = 0;
    #while (J < 6)
      #local Along = 0.52 + 0.48*J/5;
      sphere {
        0, 1 scale <0.036, 0.014, 0.022>
        rotate <0, 360*rand(Twig_Seed), 60*(rand(Twig_Seed) - 0.5)>
        translate y*0.25*(1 - Along) + Tip*Along + 0.03*(<rand(Twig_Seed), rand(Twig_Seed), rand(Twig_Seed)> - 0.5)
        texture { pigment { srgb <0.42, 0.54, 0.26>*(0.7 + 0.5*rand(Twig_Seed)) } finish { Matte } }
      }
      #local J = J + 1;
    #end
    sphere { Tip, 0.030 texture { pigment { srgb <0.95, 0.50 + 0.2*rand(Twig_Seed), 0.32> } finish { Matte } } }
    #local I = I + 1;
  #end
}
object { Vase translate <0.86, 0.745, 2.92> }
union {
  difference {
    sphere { 0, 0.13 }
    sphere { y*0.01, 0.12 }
    plane { -y, -0.03 }
    plane { y, -0.11 }
    texture { pigment { srgb <0.20, 0.43, 0.47> } finish { Satin } }
  }
  cylinder { y*(-0.12), y*(-0.10), 0.06 texture { pigment { srgb <0.20, 0.43, 0.47> } finish { Satin } } }
  sphere { <-0.05, 0.00, -0.03>, 0.045 pigment { srgb <0.90, 0.52, 0.14> } finish { Satin } }
  sphere { <0.04, 0.01, -0.04>, 0.045 pigment { srgb <0.93, 0.60, 0.18> } finish { Satin } }
  sphere { <0.01, 0.01, 0.05>, 0.045 pigment { srgb <0.74, 0.16, 0.12> } finish { Satin } }
  translate <0.52, 0.865, 2.62>
}
box {
  <-0.10, 0, -0.07>, <0.10, 0.025, 0.07>
  texture { pigment { srgb <0.15, 0.27, 0.45> } finish { Satin } }
  rotate y*25 translate <0.92, 0.745, 2.45>
}

// The lamp above it: a brass bell, bright inside.
union {
  difference {
    sphere { 0, 0.24 }
    sphere { 0, 0.232 texture { pigment { srgb <1.0, 0.86, 0.58> } finish { ambient 0 diffuse 0.5 emission 0.7 } } }
    plane { y, -0.04 }
    texture { Brass }
  }
  cylinder { y*0.235, y*0.30, 0.025 texture { Brass } }
  cylinder { y*0.30, y*1.40, 0.005 texture { Black_Iron } }
  translate <0.75, 1.66, 2.75>
}

// ---- Along the left wall: a picture, a sideboard, and on it a lamp and a stack of bowls.

union {
  difference {
    box { <0, -0.50, -0.72>, <0.035, 0.50, 0.72> texture { Black_Iron } }
    box { <0.02, -0.46, -0.68>, <1, 0.46, 0.68> texture { pigment { srgb <0.95, 0.94, 0.90> } finish { Matte } } }
  }
  // An abstract landscape: bands with a sun.
  box {
    <0.015, -0.36, -0.56>, <0.022, 0.36, 0.56>
    texture {
      pigment {
        gradient y turbulence <0, 0.12, 0> omega 0.4
        color_map {
          [0.00 srgb <0.12, 0.22, 0.36>] [0.22 srgb <0.12, 0.22, 0.36>]
          [0.22 srgb <0.16, 0.42, 0.46>] [0.40 srgb <0.22, 0.50, 0.52>]
          [0.40 srgb <0.86, 0.44, 0.26>] [0.55 srgb <0.90, 0.55, 0.28>]
          [0.55 srgb <0.95, 0.76, 0.42>] [1.00 srgb <0.97, 0.88, 0.70>]
        }
        scale 0.9 translate y*0.54
      }
      finish { Matte }
    }
  }
  cylinder { <0.015, 0.14, 0.16>, <0.024, 0.14, 0.16>, 0.12 texture { pigment { srgb <0.80, 0.20, 0.14> } finish { Matte } } }
  translate <Room_Left, 1.58, 3.05>
}

#declare Sideboard = union {
  box { <0, 0.24, -0.85>, <0.42, 0.72, 0.85> texture { Walnut rotate y*90 } }
  box { <0.42, 0.27, -0.82>, <0.435, 0.69, -0.29> }
  box { <0.42, 0.27, -0.265>, <0.435, 0.69, 0.265> }
  box { <0.42, 0.27, 0.29>, <0.435, 0.69, 0.82> }
  sphere { <0.45, 0.50, -0.34>, 0.016 texture { Brass } }
  sphere { <0.45, 0.50, 0.215>, 0.016 texture { Brass } }
  sphere { <0.45, 0.50, 0.34>, 0.016 texture { Brass } }
  cone { <0.05, 0, -0.76>, 0.014, <0.07, 0.24, -0.72>, 0.022 texture { Brass } }
  cone { <0.37, 0, -0.76>, 0.014, <0.35, 0.24, -0.72>, 0.022 texture { Brass } }
  cone { <0.05, 0, 0.76>, 0.014, <0.07, 0.24, 0.72>, 0.022 texture { Brass } }
  cone { <0.37, 0, 0.76>, 0.014, <0.35, 0.24, 0.72>, 0.022 texture { Brass } }
  texture { pigment { srgb <0.93, 0.89, 0.80> } finish { Satin } }
}
object { Sideboard translate <Room_Left + 0.02, 0, 3.05> }
union {
  cylinder { 0, y*0.02, 0.09 texture { Brass } }
  sphere { y*0.14, 0.12 texture { pigment { srgb <0.83, 0.30, 0.20> } finish { Satin } } }
  cylinder { y*0.25, y*0.34, 0.012 texture { Brass } }
  cone {
    y*0.32, 0.19, y*0.56, 0.13 open
    texture { pigment { srgb <1.0, 0.86, 0.62> } finish { ambient 0 diffuse 0.4 emission 0.75 } }
  }
  translate <-2.34, 0.72, 3.62>
  no_shadow
}
light_source { <-2.3, 1.36, 3.6> rgb <0.55, 0.36, 0.18> fade_distance 0.7 fade_power 2 shadowless }
difference {
  sphere { y*0.12, 0.12 }
  sphere { y*0.13, 0.112 }
  plane { -y, -0.10 }
  texture { pigment { srgb <0.93, 0.91, 0.86> } finish { Satin } }
  translate <-2.36, 0.72, 2.62>
}
