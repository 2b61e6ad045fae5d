#include "slipscale/dynamics/cell_damping.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>

#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

/// dᵀ K e of a cell with `size`/2 + 1 corners, of displacements relative to the first; in a fixed order.
template <int size>
double product(const double* k, const Vector2* d, const Vector2* e, const int* nodes) {
  std::array<double, size> left, right;
  for (int c = 0; c < size / 2; ++c)
    for (int axis = 0; axis < 2; ++axis) {
      left[2 * c + axis] = d[nodes[c + 1]][axis] - d[nodes[0]][axis];
      right[2 * c + axis] = e[nodes[c + 1]][axis] - e[nodes[0]][axis];
    }
  double sum = 0;
  for (int i = 0; i < size; ++i) {
    double row = 0;
    for (int j = 0; j < size; ++j) row += k[i * size + j] * right[j];
    sum += left[i] * row;
  }
  return sum;
}

}  // namespace

CellDamping::CellDamping(MPI_Comm comm, const Model& model, const Damping& damping, double beta2,
                         double time_step, const Vector2* displacement, const Vector2* past,
                         const Vector2* predictor)
    : comm_(comm),
      model_(model),
      mass_(damping.mass),
      stiffness_(damping.stiffness / time_step),
      beta2_(beta2),
      before_(comm, model.mesh.nodes, true),
      increment_(comm, model.mesh.nodes, true),
      weighed_(model.mesh.nodes.number.size()),
      past_predictor_(comm, model.mesh.nodes, false),
      mass_work_(comm, model.mesh.nodes, true) {
  const Mesh& mesh = model.mesh;
  std::map<std::tuple<int, int, int, std::array<Vector2, 4>>, int> known;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (!mesh.cells.owned[cell]) continue;
    const int region = mesh.cells.region[cell],
              own = model.materials[region].grading ? cell : -1;  // each cell is a material of its own
    const auto [found, is_new] =
        known.try_emplace({region, own, mesh.cells.corner_count(cell), mesh.shape_of(cell)}, 0);
    if (is_new) found->second = add_stiffness(cell);
    cells_.push_back({cell, found->second});
  }
  work_.assign(cells_.size(), 0);
  for (int i = 0; i < mesh.nodes.size(); ++i) {
    before_.data()[i] = displacement[i];
    for (int axis = 0; axis < 2; ++axis) increment_.data()[i][axis] = displacement[i][axis] - past[i][axis];
  }
  std::copy_n(predictor, mesh.nodes.owned, past_predictor_.data());
}

int CellDamping::add_stiffness(int cell) {
  const Mesh& mesh = model_.mesh;
  const auto shape = mesh.shape_of(cell);
  const auto corners = static_cast<std::size_t>(mesh.cells.corner_count(cell));
  const auto k = element_stiffness(std::span(shape.data(), corners),
                                   model_.materials[mesh.cells.region[cell]].at(cell).stiffness);
  const int first = static_cast<int>(relative_.size());
  for (int i = 2; i < k.rows(); ++i)
    for (int j = 2; j < k.cols(); ++j) relative_.push_back(k(i, j));
  return first;
}

void CellDamping::close_step(const Vector2* displacement, const Vector2* predictor) {
  const Mesh& mesh = model_.mesh;
  Vector2 *const before = before_.data(), *const increment = increment_.data();
  for (int i = 0; i < mesh.nodes.size(); ++i)
    for (int axis = 0; axis < 2; ++axis) {
      const double moved = displacement[i][axis] - before[i][axis];
      weighed_[i][axis] = beta2_ * moved + (1 - beta2_) * increment[i][axis];
      increment[i][axis] = moved;
      before[i][axis] = displacement[i][axis];
    }
  if (mass_ > 0)
    for (int i = 0; i < mesh.nodes.owned; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        double& past = past_predictor_.data()[i][axis];
        mass_work_.data()[i][0] += increment[i][axis] * (beta2_ * predictor[i][axis] + (1 - beta2_) * past);
        past = predictor[i][axis];
      }
  if (stiffness_ > 0)
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const int* const nodes = &mesh.cells.corner_nodes[mesh.cells.first[cells_[c].local]];
      const double* const k = &relative_[cells_[c].stiffness];
      work_[c] += stiffness_ * (mesh.cells.corner_count(cells_[c].local) == 3
                                    ? product<4>(k, increment, weighed_.data(), nodes)
                                    : product<6>(k, increment, weighed_.data(), nodes));
    }
}

void CellDamping::density(std::vector<double>& of_cells) {
  const Cells& cells = model_.mesh.cells;
  mass_work_.begin_update();
  mass_work_.end_update();
  of_cells.assign(static_cast<std::size_t>(cells.size()), 0);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const int cell = cells_[c].local;
    const auto areas = corner_areas(cells.corners_of(cell));
    const auto nodes = cells.nodes_of(cell);
    const double density = model_.materials[cells.region[cell]].at(cell).density;
    double work = work_[c];
    for (std::size_t k = 0; k < nodes.size(); ++k)
      work += mass_ * density * areas[k] * mass_work_.data()[nodes[k]][0];
    of_cells[cell] = work / std::accumulate(areas.begin(), areas.end(), 0.0);
  }
}

double CellDamping::bytes() const {
  const double nodes = static_cast<double>(model_.mesh.nodes.size());
  return nodes * 5 * sizeof(Vector2) + static_cast<double>(cells_.size() * (sizeof(Cell) + sizeof(double)) +
                                                           relative_.size() * sizeof(double));
}

void CellDamping::add_state(StateGroup& nodes) {
  nodes.arrays.push_back(
      {"past_displacement", "m", "u at the beginning of the step", 2, before_.data()->data()});
  nodes.arrays.push_back({"past_increment", "m", "of u over the step before", 2, increment_.data()->data()});
  if (mass_ == 0) return;
  nodes.arrays.push_back(
      {"past_predictor", "m/s", "w at the beginning of the step", 2, past_predictor_.data()->data()});
  nodes.arrays.push_back({"mass_damping", "m^2/s",
                          "what mass damping took since t = 0, over mass and coefficient; and zero", 2,
                          mass_work_.data()->data()});
}

StateGroup CellDamping::cells_state() {
  StateGroup group{"cell_damping", {}, model_.mesh.cells.total, true, {}};
  for (const Cell& cell : cells_) group.keys.push_back(model_.mesh.cells.number[cell.local]);
  group.arrays = {{"work", "J/m", "that stiffness damping took in the cell since t = 0", 1, work_.data()}};
  return group;
}

void CellDamping::resume() {
  for (NodalVector* field : {&before_, &increment_}) {
    field->begin_update();
    field->end_update();
  }
}

}  // namespace slipscale
