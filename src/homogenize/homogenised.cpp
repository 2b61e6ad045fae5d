#include "slipscale/homogenize/homogenised.hpp"

namespace slipscale {

Material effective_material(const Homogenised& found) {
  const Eigen::Matrix3d& c = found.solutions.front().stiffness;
  return {0.5 * (c + c.transpose()), mean_density(found.phases), "homogenised"};
}

double hill_mandel_residual(const CellSolution& solution) {
  return (solution.energy_stiffness - solution.stiffness).norm() / solution.stiffness.norm();
}

double mean_localisation_defect(const CellSolution& solution) {
  return (solution.mean_localisation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

std::optional<double> two_phase_residual(const Homogenised& found) {
  const std::vector<Phase> distinct = elastic_phases(found.phases);
  if (distinct.size() != 2 || found.phase_means.size() != found.phases.size()) return std::nullopt;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < found.phases.size(); ++k)
    if (found.phases[k].material.stiffness == distinct[1].material.stiffness)
      second += found.phases[k].fraction / distinct[1].fraction * found.phase_means[k];
  return two_phase_identity(distinct, found.solutions.front().stiffness, second);
}

std::optional<Richardson> discretisation_error(const Homogenised& found, std::size_t solution) {
  if (solution >= found.refined.size()) return std::nullopt;
  return richardson(found.solutions[solution].stiffness, found.refined[solution]);
}

std::optional<FrictionOfPhases> friction_of_phases(const Homogenised& found) {
  if (found.coefficients.empty()) return std::nullopt;
  std::vector<double> fractions;
  double sum = 0, whole = 0;
  for (std::size_t k = 0; k < found.coefficients.size(); ++k) {  // holes come after the regions
    fractions.push_back(found.phases[k].fraction);
    sum += fractions[k] * found.coefficients[k];
    whole += fractions[k];
  }
  const double poisson = engineering_constants(effective_material(found).stiffness).poisson;
  return FrictionOfPhases{effective_friction(fractions, found.coefficients, poisson), sum / whole};
}

}  // namespace slipscale
