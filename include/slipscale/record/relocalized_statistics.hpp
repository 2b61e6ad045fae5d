#pragma once

#include <mpi.h>

#include <string>

#include "slipscale/cell/local_stress.hpp"
#include "slipscale/record/statistics_reader.hpp"

namespace slipscale {

/// Writes relocalized_statistics.h5 and .xdmf, laid out as statistics.h5: mean, deviation and covariance of
/// local stress and strain over the window of the homogeneous run's own statistics. They follow from those of
/// its strain exactly, without a frame: mean σ = C:A:mean E, cov σ = (C A) cov E (C A)ᵀ. Next to the contact
/// the mean is corrected where that was asked for, deviation and covariance are not. `local` is left with the
/// mean. Collective.
void write_relocalized_statistics(MPI_Comm comm, const StatisticsReader& run, const PlaneGrid& grid,
                                  const RankShare& mine, LocalStress& local, const std::string& folder);

}  // namespace slipscale
