#pragma once

#include <mpi.h>

#include <optional>
#include <vector>

#include "slipscale/relocalize/boundary_layer.hpp"
#include "slipscale/relocalize/relocalisation.hpp"

namespace slipscale {

/// What mends stresses that are no numbers, which sound tensors make of a damaged run alone.
inline constexpr const char* cure_of_overflow =
    "strains of the homogeneous run are too large: run slide anew";

/// Strain and stress of the phases at one rank's share of the target cells, from the strain of the macro
/// cells: relocalised, and put into equilibrium next to the contact where that is asked for.
class LocalStress {
 public:
  /// `strip`: depth of the boundary layer to correct, m; absent: none is. `targets` must outlive this object.
  /// Throws UserError when a region of the targets has no stiffness. Collective.
  LocalStress(MPI_Comm comm, const LocalisationTensors& tensors, const PlaneGrid& macro, Recovery recovery,
              const Targets& targets, const RankShare& mine, std::optional<double> strip);

  /// From E of all macro cells, of a frame or a mean over time. Collective where the boundary layer is
  /// corrected.
  void update(std::span<const PlaneTensor> macro_strain);

  /// [share], after `update`.
  const std::vector<PlaneTensor>& stress() const { return stress_; }  ///< Pa
  const std::vector<PlaneTensor>& strain() const { return strain_; }
  const std::vector<PlaneTensor>& homogeneous_stress() const { return homogeneous_; }  ///< C_eff:E, Pa

  /// Covariances at the share from those of the strain of all macro cells. The boundary layer is not
  /// corrected: its corrector needs the strain of many places at once.
  struct Covariances {
    std::vector<PlaneCovariance> stress, strain, homogeneous_stress;
  };
  Covariances covariances(std::span<const PlaneCovariance> macro_strain);

  const std::optional<BoundaryLayer>& boundary_layer() const { return layer_; }

 private:
  Eigen::Matrix3d effective_;
  Relocalisation relocalisation_;
  std::optional<BoundaryLayer> layer_;
  std::vector<PlaneTensor> macroscopic_, strain_, stress_, homogeneous_;
};

}  // namespace slipscale
