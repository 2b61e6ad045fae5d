#include "slipscale/relocalize/local_stress.hpp"

#include <algorithm>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

/// C of the regions of the targets, which may be those of another mesh than the tensors'.
std::vector<Eigen::Matrix3d> stiffness_of(const std::vector<std::string>& regions,
                                          const LocalisationTensors& tensors) {
  std::vector<Eigen::Matrix3d> found;
  for (const std::string& region : regions) {
    const auto& known = tensors.grid.regions;
    const auto at = std::ranges::find(known, region);
    if (at == known.end())
      throw UserError("-relocalize_tensors knows no region '" + region +
                      "' of the mesh that -relocalize_reference gives; name the regions of both alike");
    found.push_back(tensors.stiffness[static_cast<std::size_t>(at - known.begin())]);
  }
  return found;
}

std::span<const Site> share_of(const std::vector<Site>& sites, const RankShare& mine) {
  return std::span(sites).subspan(mine.begin, mine.count());
}

}  // namespace

LocalStress::LocalStress(MPI_Comm comm, const LocalisationTensors& tensors, const PlaneGrid& macro,
                         Recovery recovery, const Targets& targets, const RankShare& mine,
                         std::optional<double> strip)
    : effective_(tensors.effective),
      relocalisation_(tensors, macro, recovery, share_of(targets.sites, mine)),
      macroscopic_(mine.count()),
      strain_(mine.count()),
      stress_(mine.count()),
      homogeneous_(mine.count()) {
  const std::vector<Eigen::Matrix3d> stiffness = stiffness_of(targets.grid.regions, tensors);
  if (strip) layer_.emplace(comm, targets.grid, stiffness, mine, *strip);
}

void LocalStress::update(std::span<const PlaneTensor> macro_strain) {
  relocalisation_.macroscopic(macro_strain, macroscopic_);
  relocalisation_.strain(macroscopic_, strain_);
  relocalisation_.stress(macroscopic_, stress_);
  for (std::size_t k = 0; k < macroscopic_.size(); ++k)
    Eigen::Map<Eigen::Vector3d>(homogeneous_[k].data()) =
        effective_ * Eigen::Map<const Eigen::Vector3d>(macroscopic_[k].data());
  if (layer_) layer_->correct(macroscopic_, homogeneous_, strain_, stress_);
}

LocalStress::Covariances LocalStress::covariances(std::span<const PlaneCovariance> macro_strain) {
  const std::size_t places = macroscopic_.size();
  std::vector<CovarianceRoot> macroscopic(places);
  Covariances found{std::vector<PlaneCovariance>(places), std::vector<PlaneCovariance>(places),
                    std::vector<PlaneCovariance>(places)};
  relocalisation_.macroscopic_roots(macro_strain, macroscopic);
  relocalisation_.stress_covariance(macroscopic, found.stress);
  relocalisation_.strain_covariance(macroscopic, found.strain);
  std::ranges::transform(macroscopic, found.homogeneous_stress.begin(),
                         [&](const CovarianceRoot& root) { return transformed(root, effective_); });
  return found;
}

}  // namespace slipscale
