// A square block of composite: stiff discs in a softer matrix, in metres.
//   gmsh -2 -format msh41 block.geo -o block.msh
// Names for the scene: surfaces `matrix`, `inclusion`; curves `bottom`, `top`, `left`, `right`.

DefineConstant[
  mm = 1e-3,
  side = 5 * mm,
  radius = 0.25 * mm,
  discs = 38,           // area fraction 38 pi radius^2 / side^2 = 0.298
  gap = 0.08 * mm,      // least distance between two discs, and from a disc to an edge: two elements
  divisions = 120,      // elements along an edge; even, so that a node sits at its middle
  seed = 2007           // another number, another morphology
];
size = side / divisions;

Macro NextRandom  // the next number between 0 and 1 (Park and Miller's generator: the same everywhere)
  seed = Fmod(16807 * seed, 2147483647);
  drawn = seed / 2147483647;
Return

// Discs are dropped one after the other; one that falls too near another is dropped again.
placed = 0;
For attempt In {1:20000}
  If (placed < discs)
    Call NextRandom;
    x_new = radius + gap + drawn * (side - 2 * (radius + gap));
    Call NextRandom;
    y_new = radius + gap + drawn * (side - 2 * (radius + gap));
    free = 1;
    For k In {0:placed - 1}
      If (Hypot(x_new - x~{k}, y_new - y~{k}) < 2 * radius + gap)
        free = 0;
      EndIf
    EndFor
    If (free)
      x~{placed} = x_new;
      y~{placed} = y_new;
      placed += 1;
    EndIf
  EndIf
EndFor
If (placed < discs)
  Error("Only %g of %g discs found room: take fewer discs or a smaller gap.", placed, discs);
  Abort;
EndIf

Point(1) = {0, 0, 0, size};
Point(2) = {side, 0, 0, size};
Point(3) = {side, side, 0, size};
Point(4) = {0, side, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1:4} = divisions + 1;
Curve Loop(1) = {1:4};

disc_loops[] = {};
disc_surfaces[] = {};
For k In {0:discs - 1}
  centre = newp; Point(centre) = {x~{k}, y~{k}, 0, size};
  east = newp;   Point(east) = {x~{k} + radius, y~{k}, 0, size};
  north = newp;  Point(north) = {x~{k}, y~{k} + radius, 0, size};
  west = newp;   Point(west) = {x~{k} - radius, y~{k}, 0, size};
  south = newp;  Point(south) = {x~{k}, y~{k} - radius, 0, size};
  arc = newl;
  Circle(arc) = {east, centre, north};
  Circle(arc + 1) = {north, centre, west};
  Circle(arc + 2) = {west, centre, south};
  Circle(arc + 3) = {south, centre, east};
  loop = newll; Curve Loop(loop) = {arc:arc + 3};
  disc = news;  Plane Surface(disc) = {loop};
  disc_loops[] += loop;
  disc_surfaces[] += disc;
EndFor
outer = news;
Plane Surface(outer) = {1, disc_loops[]};

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("matrix") = {outer};
Physical Surface("inclusion") = {disc_surfaces[]};

Mesh.Algorithm = 6;         // frontal-Delaunay: near-equilateral triangles, and with them a long stable step
Mesh.SaveAll = 0;           // only what has a name
Mesh.MshFileVersion = 4.1;
