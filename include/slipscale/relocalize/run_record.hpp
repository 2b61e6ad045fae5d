#pragma once

#include <mpi.h>

#include <map>
#include <string>
#include <vector>

namespace slipscale {

/// What run.yaml says of a run of `slide`: its options by name, and its facts as run_<fact>
/// (run_mesh_checksum).
using RunRecord = std::map<std::string, std::string>;

/// Empty where the folder has no run.yaml. Rank 0 reads. Collective.
RunRecord read_run_record(MPI_Comm comm, const std::string& folder);

/// The options of the load, the surface and the damping in which two runs differ, as "-friction_coefficient
/// (0.1 and 0.3)". None where one of the records is empty.
std::vector<std::string> differences_of_scene(const RunRecord& one, const RunRecord& other);

/// What homogenize was not content with in the materials of a run, "of region 'block': …"; empty as a rule.
std::vector<std::string> doubts_of(const RunRecord& record);

}  // namespace slipscale
