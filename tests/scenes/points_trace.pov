// povray points_trace.pov +W160 +H120: writes points.txt, one line for every glossy pixel: x y, a, b and w (1 where b is a
// position, 0 where it is a direction), by trace() in double precision.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "points.inc"
camera { location Eye direction View right Right up Up }

// Nearest hit of the ray among both kinds of objects: Hit, Normal, and Kind: 0 none, 1 glossy, 2 matte.
#macro Nearest(From, Along)
  #declare Normal = <0, 0, 0>;
  #declare MatteNormal = <0, 0, 0>;
  #declare Hit = trace(Glossy, From, Along, Normal);
  #declare MatteHit = trace(Matte, From, Along, MatteNormal);
  #declare Kind = (vlength(Normal) > 0 ? 1 : 0);
  #if (vlength(MatteNormal) > 0)
    #if (Kind = 0 | vlength(MatteHit - From) < vlength(Hit - From))
      #declare Kind = 2;
      #declare Hit = MatteHit;
      #declare Normal = MatteNormal;
    #end
  #end
#end

#fopen Points "points.txt" write
#for (Row, 0, image_height - 1)
  #for (Column, 0, image_width - 1)
    #declare Ray = vnormalize(View + ((Column + 0.5)/image_width - 0.5)*Right + (0.5 - (Row + 0.5)/image_height)*Up);
    Nearest(Eye, Ray)
    #if (Kind = 1)
      #declare A = Hit;
      #declare N = vnormalize(Normal);
      #declare Mirrored = Ray - 2*vdot(Ray, N)*N;
      Nearest(A + 1e-6*Mirrored, Mirrored)
      #declare W = (Kind > 0 ? 1 : 0);
      #declare B = (W > 0 ? Hit : Mirrored);
      #write (Points, str(Column, 0, 0), " ", str(Row, 0, 0), " ", vstr(3, A, " ", 0, 12), " ", vstr(3, B, " ", 0, 12), " ",
              str(W, 0, 0), "\n")
    #end
  #end
#end
#fclose Points
