#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "slipscale/base/parallel.hpp"
#include "slipscale/files/interfaces_file.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/mesh/ordered_gather.hpp"
#include "slipscale/relocalize/local_stress.hpp"
#include "slipscale/solid/interface_forces.hpp"

namespace slipscale {

/// Where a periodic run is cut open, m.
struct Seam {
  std::array<double, 2> period{};  ///< along x and y; 0: not periodic
  Vector2 lower{};                 ///< corner of the block
};

/// The region and its inclusions, those that a seam cuts as one wherever the cells on its two sides meet.
RegionInclusions inclusions_across(const PlaneGrid& grid, int region, const Seam& seam);

/// Tractions along the interfaces of inclusions in the target cells, frame by frame: ∫ Bᵀσ over the
/// inclusions' own cells (solid/interface_forces.hpp) of the relocalised stress and, beside it, of the
/// homogeneous run's, which is what is known without relocalisation. Relocalisation is static: the inertia of
/// the cells around a node, of the order of the mesh, is left out. Copies of a tile share their points here,
/// and so do the two sides of a periodic run's seam.
class LocalInterfaces {
 public:
  /// Throws UserError where the region is not there, alone, or has no interface. Collective.
  LocalInterfaces(MPI_Comm comm, const Targets& targets, const RankShare& mine, const InterfaceChoice& choice,
                  const Seam& seam);

  /// Creates interfaces.h5, for so many frames.
  void open(const std::string& folder, std::size_t frames);
  /// A frame. Collective.
  void add(double time, const LocalStress& local);
  /// Writes interfaces.yaml and interfaces.xdmf and returns the headline. Collective.
  std::string close(const OutputFolder& folder);
  std::string describe() const;
  /// What is odd about the inclusions, a sentence each.
  std::vector<std::string> notes() const;

 private:
  std::vector<Vector2> forces(const std::vector<PlaneTensor>& stress) const;
  void share_fault() const;

  MPI_Comm comm_;
  const InterfaceChoice choice_;
  const RankShare mine_;
  const RegionInclusions found_;
  const StressForces of_stress_;
  std::vector<int> own_;  ///< places in this rank's share of the cells that are needed
  OrderedGather gather_;
  std::unique_ptr<InterfacesFile> file_;  ///< on rank 0
};

}  // namespace slipscale
