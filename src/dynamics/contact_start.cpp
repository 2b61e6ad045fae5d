// The contact nodes of a body as they stand at the start.
#include <cmath>

#include "slipscale/base/print.hpp"
#include "slipscale/dynamics/contact_places.hpp"
#include "slipscale/dynamics/sliding_body.hpp"

namespace slipscale {
namespace {

/// Half of each edge of the boundary to each of its ends, by local node, m.
std::vector<double> tributary_lengths(const Mesh& mesh, const Boundary& boundary) {
  std::vector<double> length(static_cast<std::size_t>(mesh.nodes.size()), 0);
  for (const BoundaryEdge& edge : boundary.edges)
    for (int end : edge.nodes) length[end] += 0.5 * std::hypot(edge.outward[0], edge.outward[1]);
  return length;
}

}  // namespace

void SlidingBody::set_contact_nodes() {
  const Mesh& mesh = model_.mesh;
  const Boundary& boundary = *mesh.find_boundary(scene_.surface->boundary);
  const auto length = tributary_lengths(mesh, boundary);
  const auto places = slipscale::contact_places(mesh, boundary);
  std::string fault, shared;
  for (int i : boundary.nodes) {
    const int slot = boundary_.slot_of(i);
    if (straight_->holds(slot))
      shared =
          "-boundary_…_y keeps a side straight that shares a node with boundary '" + boundary.name +
          "', which meets the surface; a side that touches the surface cannot be kept straight, so make it "
          "free along y";
    if (supports_->prescribes(slot, 1)) continue;
    const Vector2& place = mesh.nodes.position[i];
    const double height = scene_.surface->height_at(place[0], 0), clearance = place[1] - height;
    const double tolerance = 1e-6 * length[i];  // rounding tilts a straight side by far less
    if (clearance + u_.data()[i][1] < -tolerance)
      fault = format(
          "-surface_height is {:g} m, but the body reaches down to {} m at x = {:g} m; lower the surface or "
          "lift the body with -initial_gap",
          height, apart_from(height, mesh.nodes.position[i][1] + u_.data()[i][1], 6),
          mesh.nodes.position[i][0]);
    contact_.add(i, slot, model_.mass[i], length[i], clearance, supports_->prescribes(slot, 0));
    contact_places_.push_back(places[i]);
  }
  throw_together(comm_, shared);
  throw_together(comm_, fault);
  const InitialState& initial = scene_.initial;
  if (initial.pressure == 0 && initial.shear == 0) return;
  for (int k = 0; k < contact_.size(); ++k) {
    const double shear = initial.shear_at_start().at(contact_places_[k].place, 0);
    contact_.memory[k] = {scene_.friction.stored_strength ? std::abs(shear) : shear,
                          initial.pressure_at_start().at(contact_places_[k].place, 0)};
  }
}

}  // namespace slipscale
