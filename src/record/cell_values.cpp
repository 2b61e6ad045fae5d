#include "slipscale/record/cell_values.hpp"

#include <cmath>
#include <string>

#include "slipscale/base/parallel.hpp"
#include "slipscale/record/stress_measures.hpp"
#include "slipscale/solid/stress.hpp"

namespace slipscale {
namespace {

Eigen::Matrix3d compliance(const Eigen::Matrix3d& stiffness) {
  return stiffness.llt().solve(Eigen::Matrix3d::Identity());
}

std::vector<Eigen::Matrix3d> compliances(const std::vector<Material>& materials) {
  std::vector<Eigen::Matrix3d> found;
  for (const Material& material : materials) found.push_back(compliance(material.stiffness));
  return found;
}

}  // namespace

CellValues::CellValues(const SlidingBody& body)
    : body_(body), compliance_(compliances(body.model().materials)) {}

void CellValues::make(bool stress, bool strain, bool damping) {
  const Model& model = body_.model();
  if (stress || strain) cell_stress(model.mesh, model.materials, body_.displacement_n(), stress_);
  if (strain) make_strain();
  if (damping) body_.cell_damping(damping_);
}

void CellValues::make_strain() {
  const Model& model = body_.model();
  const Cells& cells = model.mesh.cells;
  strain_.resize(stress_.size());
  for (int cell = 0; cell < cells.size(); ++cell) {
    const int region = cells.region[cell];
    const auto stress = Eigen::Vector3d::Map(stress_[cell].data());
    auto found = Eigen::Vector3d::Map(strain_[cell].data());
    if (model.materials[region].grading)
      found = compliance(model.materials[region].at(cell).stiffness) * stress;
    else
      found = compliance_[region] * stress;
  }
}

std::vector<double> transverse_of_cells(const Model& model, bool needed) {
  std::vector<double> of_region;
  for (const Material& material : model.materials) of_region.push_back(transverse_ratio(material));
  std::vector<double> of_cell;
  std::string fault;
  for (int cell = 0; cell < model.mesh.cells.size(); ++cell) {
    const int region = model.mesh.cells.region[cell];
    const Solid solid = model.materials[region].at(cell);
    const bool graded = model.materials[region].grading != nullptr;
    of_cell.push_back(graded ? transverse_ratio({solid.stiffness, solid.density, ""}) : of_region[region]);
    if (fault.empty() && needed && std::isnan(of_cell.back()))
      fault = "-fields_quantities has von_mises, but the stiffness of region '" +
              model.mesh.regions[region].name +
              "' is not isotropic and does not tell the stress across the plane; leave von_mises out";
  }
  throw_together(model.mesh.comm, fault);
  return of_cell;
}

}  // namespace slipscale
