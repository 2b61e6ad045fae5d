#pragma once

#include <mpi.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/files/hdf5.hpp"
#include "slipscale/files/state_file.hpp"
#include "slipscale/record/run_position.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// Files of one run's folder from which another process can go on with it: checkpoint.h5, and
/// checkpoint_older.h5 before it, should the newer be damaged.
inline constexpr const char* checkpoint_names[] = {"checkpoint.h5", "checkpoint_older.h5"};
/// Until a checkpoint is whole.
inline constexpr const char* checkpoint_next = "checkpoint_next.h5";

/// Whether the folder holds a run that ended before its time and could go on. On the calling rank.
bool can_go_on(const std::string& folder);

/// What a checkpoint says of the scene, so that none goes on with another.
struct SceneMarks {
  std::string options;          ///< in effect, as YAML
  std::string mesh, materials;  ///< checksums
  std::string run;              ///< see Recorder::run
  std::string initial = {};     ///< checksum of the initial state's file; empty: none
};
SceneMarks scene_marks(const Options& options, const Mesh& mesh, const std::vector<Material>& materials,
                       const std::string& run, const std::string& initial);

/// Writes a checkpoint under a name of its own, seals and syncs it, and only then gives it the place of the
/// newest. RunError on all ranks when it cannot; the one that was there stays. `sync`: wait for the disk.
/// Collective.
void write_checkpoint(MPI_Comm comm, const std::string& folder, const SceneMarks& marks,
                      const std::vector<StateGroup>& groups, bool sync);

/// The newest checkpoint of a folder whose seal is right.
class Restart {
 public:
  /// Throws UserError when there is none. Collective.
  Restart(MPI_Comm comm, const std::string& folder);

  /// What the user should know of the file that was taken; empty when it is the newest.
  const std::string& note() const { return note_; }
  const RunPosition& position() const { return position_; }
  const std::string& folder() const { return folder_; }
  long steps_done() const { return steps_done_; }  ///< by the body
  const std::string& run() const { return run_; }  ///< see Recorder::run
  /// Whether the files that such a run leaves are there. Collective.
  void expect_files() const;

  /// Throws UserError when mesh, materials or the file of the initial state (`initial`: its checksum, or
  /// empty) are not those of the run.
  void check(const Mesh& mesh, const std::vector<Material>& materials, const std::string& initial) const;
  /// The run's time step, with an end that may be later than its own. Throws UserError for an earlier one.
  TimeStep time_step(double end) const;
  /// Fills in the arrays of the groups. Collective.
  void read(std::vector<StateGroup> groups) const;

 private:
  MPI_Comm comm_;
  std::string folder_, path_, note_, mesh_, materials_, run_, initial_;
  Hdf5File file_;  ///< on rank 0
  RunPosition position_;
  long steps_done_ = 0;
};

/// The options of the newest sound checkpoint of a folder, for `RestartRule`. On the calling rank. Throws
/// UserError.
std::string options_of_checkpoint(const std::string& folder);

}  // namespace slipscale
