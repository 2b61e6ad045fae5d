#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "slipscale/relocalize/local_stress.hpp"
#include "slipscale/relocalize/statistics_reader.hpp"

namespace slipscale {

/// Of the strain of a run over the window of its statistics.
struct StrainStatistics {
  std::vector<PlaneTensor> mean;            ///< [cells]
  std::vector<PlaneCovariance> covariance;  ///< [cells]
};

/// The numbers that the cells of a part of a mesh have in the whole of it, ascending. Throws UserError when
/// it is no part.
std::vector<int> cells_among(const PlaneGrid& whole, const PlaneGrid& part);

/// At the cells of the frames, which may be a part of the run's mesh (-fields_box) while its statistics are
/// those of the whole. Throws UserError where the meshes do not go together. Collective.
StrainStatistics strain_statistics(const StatisticsReader& run, const PlaneGrid& frames);

/// Writes relocalized_statistics.h5 and .xdmf, laid out as statistics.h5: mean, deviation and covariance of
/// local stress and strain over the window of the homogeneous run's own statistics. They follow from those of
/// its strain exactly, without a frame: mean σ = C:A:mean E, cov σ = (C A) cov E (C A)ᵀ. Next to the contact
/// the mean is corrected where that was asked for, deviation and covariance are not. `local` is left with the
/// mean. Collective.
void write_relocalised_statistics(MPI_Comm comm, const StatisticsReader& run, const StrainStatistics& of_run,
                                  const PlaneGrid& grid, const RankShare& mine, LocalStress& local,
                                  const std::string& folder);

}  // namespace slipscale
