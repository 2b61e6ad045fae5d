#pragma once

#include "slipscale/morphology/drawing.hpp"
#include "slipscale/morphology/mesh_size.hpp"

/// What a drawing becomes in gmsh's model, of which there is one. gmsh throws.
namespace slipscale::in_gmsh_model {

void new_model();

/// Points, lines, surfaces and the names of the sides.
void add_geometry(const Drawing& drawing);
void make_periodic(const Drawing& drawing, const Box& block, const std::array<bool, 2>& periodic);

/// gmsh places nodes of a periodic side to some 1e-12 of its length only: makes it the last bit.
void match_periodic_nodes(const Drawing& drawing, const Box& block, const std::array<bool, 2>& periodic);

/// Interfaces keep the points that were drawn: the polygon's area is right only with those.
void divide_interfaces(const Drawing& drawing, double length);
void name_regions(const std::vector<std::string>& regions, const std::vector<int>& region_of);

void set(const char* option, double value);
void set_sizes(const SizeField& field, const MeshSize& size);

/// Triangles that the size field asks for, by samples.
double expected_triangles(const SizeField& field, const Box& block);

/// gmsh's best pairing of triangles (blossom) leaves 7 % of the cells unpaired, at a cost that is quadratic
/// in their number: half a minute for 150 000, more than six for 600 000. The greedy one leaves 23 %.
void recombine(std::size_t faces, double triangles);

}  // namespace slipscale::in_gmsh_model
