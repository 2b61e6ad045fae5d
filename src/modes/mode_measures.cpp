#include "slipscale/modes/mode_measures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "inner.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

constexpr double near = 0.1;  ///< of the height

/// The region of the cell that has each of the boundary's edges, in their order.
std::vector<int> regions_above(const Mesh& mesh, const Boundary& boundary) {
  std::map<std::pair<int, int>, std::size_t> place;
  for (std::size_t e = 0; e < boundary.edges.size(); ++e)
    place[std::minmax(boundary.edges[e].nodes[0], boundary.edges[e].nodes[1])] = e;
  std::vector<int> region(boundary.edges.size(), 0);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto found = place.find(std::minmax(nodes[k], nodes[(k + 1) % nodes.size()]));
      if (found != place.end()) region[found->second] = mesh.cells.region[cell];
    }
  }
  return region;
}

}  // namespace

ModeMeasurement::ModeMeasurement(const SlidingOperator& body, const Boundary& contact) : body_(body) {
  const Mesh& mesh = body.model().mesh;
  const auto& closed = body.closed();
  shares_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(closed.size()),
                                  static_cast<Eigen::Index>(mesh.regions.size()));
  std::map<int, Eigen::Index> row;
  for (std::size_t k = 0; k < closed.size(); ++k) row[closed[k].node] = static_cast<Eigen::Index>(k);
  const std::vector<int> region = regions_above(mesh, contact);
  for (std::size_t e = 0; e < contact.edges.size(); ++e) {
    const BoundaryEdge& edge = contact.edges[e];
    const double half = 0.5 * std::hypot(edge.outward[0], edge.outward[1]);
    for (const int end : edge.nodes)
      if (const auto found = row.find(end); found != row.end())
        shares_(found->second, region[e]) += half / closed[static_cast<std::size_t>(found->second)].length;
  }
}

double ModeMeasurement::near_contact_energy(const Columns& shape) const {
  const Model& model = body_.model();
  const Mesh& mesh = model.mesh;
  const double limit = mesh.lower[1] + near * (mesh.upper[1] - mesh.lower[1]);
  double energy[2] = {0, 0};
  for (Eigen::Index part = 0; part < 2; ++part) {
    NodalVector u(body_.comm(), mesh.nodes, true);
    body_.free().expand(shape.col(part).data(), u.data());
    u.begin_update();
    u.end_update();
    for (int cell = 0; cell < mesh.cells.size(); ++cell) {
      if (!mesh.cells.owned[cell]) continue;
      const auto nodes = mesh.cells.nodes_of(cell);
      const auto seen = mesh.shape_of(cell);
      Eigen::VectorXd corners(2 * static_cast<Eigen::Index>(nodes.size()));
      double height = 0;
      for (std::size_t c = 0; c < nodes.size(); ++c) {
        for (int axis = 0; axis < 2; ++axis)  // seen from the first corner: a translation costs nothing
          corners[2 * static_cast<Eigen::Index>(c) + axis] =
              u.data()[nodes[c]][axis] - u.data()[nodes[0]][axis];
        height += mesh.cells.corners_of(cell)[c][1] / static_cast<double>(nodes.size());
      }
      const auto k = element_stiffness({seen.data(), nodes.size()},
                                       model.materials[mesh.cells.region[cell]].at(cell).stiffness);
      const double strain = corners.dot(k * corners);
      energy[0] += strain;
      if (height < limit) energy[1] += strain;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, energy, 2, MPI_DOUBLE, MPI_SUM, body_.comm());
  return energy[0] > 0 ? energy[1] / energy[0] : 0;
}

ModeMeasures ModeMeasurement::measure(const ModesBasis& basis, const SlidingLaw& law,
                                      const SlidingMode& mode) const {
  // ¼|p|² uᴴMu + ¼ uᴴKu is the mean over a period, in the basis with ΦᵀMΦ = I.
  const Complex p = mode.exponent;
  const double strain = mode.vector.dot(basis.problem().stiffness * mode.vector).real(),
               kinetic = std::norm(p) * mode.vector.squaredNorm(),
               scale = 1 / std::sqrt(0.25 * (strain + kinetic));
  ModeMeasures found;
  const Eigen::VectorXcd y = scale * mode.vector;
  found.shape = basis.shape_of(y);
  found.near_contact = near_contact_energy(found.shape);
  found.normal = (1.0 + law.damping.stiffness * p) * basis.reaction_of(y);
  const SlidingLaw::Value value = law.at(p);
  found.tangential = body_.direction() * value.friction * found.normal;
  for (Eigen::Index k = 0; k < found.tangential.size(); ++k)
    found.tangential[k] *= body_.closed()[static_cast<std::size_t>(k)].weight;
  for (std::size_t k = 0; k < body_.slip_slope.size(); ++k)
    if (const int place = body_.sliding_places()[k]; place >= 0)
      found.tangential[static_cast<Eigen::Index>(k)] -= (1.0 + law.damping.stiffness * p) * value.slip *
                                                        body_.slip_slope[k] *
                                                        Complex(found.shape(place, 0), found.shape(place, 1));
  Eigen::VectorXd work = Eigen::VectorXd::Zero(shares_.cols());
  const double frequency = std::abs(p.imag());
  for (Eigen::Index k = 0; frequency > 0 && k < shares_.rows(); ++k) {
    const int place = body_.sliding_places()[static_cast<std::size_t>(k)];
    if (place < 0) continue;
    const Complex u{found.shape(place, 0), found.shape(place, 1)};
    work += std::numbers::pi / frequency * (found.tangential[k] * std::conj(p * u)).real() *
            shares_.row(k).transpose();
  }
  MPI_Allreduce(MPI_IN_PLACE, work.data(), static_cast<int>(work.size()), MPI_DOUBLE, MPI_SUM, body_.comm());
  found.friction_work.assign(work.begin(), work.end());
  return found;
}

}  // namespace slipscale
