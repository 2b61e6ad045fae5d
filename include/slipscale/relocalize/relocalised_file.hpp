#pragma once

#include <mpi.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "slipscale/relocalize/local_histories.hpp"
#include "slipscale/relocalize/relocalisation.hpp"

namespace slipscale {

/// relocalized.h5 and relocalized.xdmf: the mesh of the microstructure over the block and, at the times of
/// the homogeneous run's frames, strain and stress of its cells. Laid out as fields.h5; opens in ParaView as
/// it is. One frame is in memory at a time; both files appear under their names when they are whole.
///
/// /mesh; /time [frames]; /frames/<k>/stress and /frames/<k>/homogeneous_stress [cells, 3] Pa (xx, yy, xy),
/// /frames/<k>/strain [cells, 3] (engineering shear); /points/<k>/x [2] m, region, time [frames], stress,
/// strain, homogeneous_stress [frames, 3]. All members are collective; what fails on one rank, a full disk
/// say, throws UserError on all.
class RelocalisedFile {
 public:
  /// `mine`: this rank's cells of the mesh.
  RelocalisedFile(MPI_Comm comm, const PlaneGrid& grid, const RankShare& mine, const std::string& folder);
  ~RelocalisedFile();

  /// This rank's cells: local stress and strain, and the stress C_eff:E that the homogeneous run saw there.
  void write(double time, std::span<const PlaneTensor> stress, std::span<const PlaneTensor> strain,
             std::span<const PlaneTensor> homogeneous_stress);
  /// Writes the histories; the files get their names.
  void close(const std::vector<LocalHistory>& histories);

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace slipscale
