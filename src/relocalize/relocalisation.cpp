#include "slipscale/relocalize/relocalisation.hpp"

#include <algorithm>
#include <cmath>

namespace slipscale {
namespace {

std::vector<CellPlace> macro_places(std::span<const Site> sites) {
  std::vector<CellPlace> places;
  places.reserve(sites.size());
  for (const Site& site : sites) places.push_back(site.macro);
  return places;
}

void multiply(const std::vector<Eigen::Matrix3d>& tensors, const std::vector<int>& cell,
              std::span<const PlaneTensor> from, std::span<PlaneTensor> to) {
  for (std::size_t p = 0; p < cell.size(); ++p) {
    const Eigen::Vector3d local = tensors[cell[p]] * Eigen::Map<const Eigen::Vector3d>(from[p].data());
    Eigen::Map<Eigen::Vector3d>(to[p].data()) = local;
  }
}

Eigen::Matrix3d matrix(const PlaneCovariance& c) {
  Eigen::Matrix3d full;
  full << c[0], c[5], c[4], c[5], c[1], c[3], c[4], c[3], c[2];
  return full;
}

PlaneCovariance six(const Eigen::Matrix3d& c) {
  return {c(0, 0), c(1, 1), c(2, 2), c(1, 2), c(0, 2), c(0, 1)};
}

void transform(const std::vector<Eigen::Matrix3d>& tensors, const std::vector<int>& cell,
               std::span<const CovarianceRoot> from, std::span<PlaneCovariance> to) {
  for (std::size_t p = 0; p < cell.size(); ++p) to[p] = transformed(from[p], tensors[cell[p]]);
}

}  // namespace

CovarianceRoot square_root(const PlaneCovariance& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(matrix(covariance));
  const Eigen::Vector3d roots = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
  return {six(axes.eigenvectors() * roots.asDiagonal() * axes.eigenvectors().transpose())};
}

bool is_covariance(const PlaneCovariance& covariance) {
  constexpr double rounding = 1e-6;  // variances of little beside the mean are differences of large squares
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(matrix(covariance), Eigen::EigenvaluesOnly);
  return axes.eigenvalues()[0] >= -rounding * std::abs(axes.eigenvalues()[2]);
}

PlaneCovariance transformed(const CovarianceRoot& root, const Eigen::Matrix3d& t) {
  const Eigen::Matrix3d factor = t * matrix(root.entries);
  return six(factor * factor.transpose());
}

Relocalisation::Relocalisation(const LocalisationTensors& tensors, const PlaneGrid& macro, Recovery recovery,
                               std::span<const Site> sites)
    : recovery_(macro, recovery, macro_places(sites)), localisation_(tensors.localisation) {
  micro_cell_.reserve(sites.size());
  for (const Site& site : sites) micro_cell_.push_back(site.micro_cell);
  concentration_.reserve(localisation_.size());
  for (std::size_t cell = 0; cell < localisation_.size(); ++cell)
    concentration_.push_back(tensors.stiffness[tensors.grid.region[cell]] * localisation_[cell]);
}

void Relocalisation::macroscopic_roots(std::span<const PlaneCovariance> macro_cells,
                                       std::span<CovarianceRoot> at_places) {
  macro_roots_.clear();
  for (const PlaneCovariance& covariance : macro_cells)
    macro_roots_.push_back(square_root(covariance).entries);
  roots_.resize(at_places.size());
  recovery_(std::span<const PlaneCovariance>(macro_roots_), roots_);
  std::ranges::transform(roots_, at_places.begin(),
                         [](const PlaneCovariance& r) { return CovarianceRoot{r}; });
}

void Relocalisation::strain(std::span<const PlaneTensor> macroscopic, std::span<PlaneTensor> local) const {
  multiply(localisation_, micro_cell_, macroscopic, local);
}

void Relocalisation::stress(std::span<const PlaneTensor> macroscopic, std::span<PlaneTensor> local) const {
  multiply(concentration_, micro_cell_, macroscopic, local);
}

void Relocalisation::strain_covariance(std::span<const CovarianceRoot> macroscopic,
                                       std::span<PlaneCovariance> local) const {
  transform(localisation_, micro_cell_, macroscopic, local);
}

void Relocalisation::stress_covariance(std::span<const CovarianceRoot> macroscopic,
                                       std::span<PlaneCovariance> local) const {
  transform(concentration_, micro_cell_, macroscopic, local);
}

PlaneTensor deviation(const PlaneCovariance& covariance) {
  PlaneTensor root{};
  for (std::size_t i = 0; i < 3; ++i) root[i] = std::sqrt(std::max(0.0, covariance[i]));
  return root;
}

}  // namespace slipscale
