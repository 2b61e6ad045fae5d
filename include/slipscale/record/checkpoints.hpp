#pragma once

#include <string>

#include "slipscale/base/stop_request.hpp"
#include "slipscale/record/checkpoint.hpp"
#include "slipscale/record/recorder.hpp"

namespace slipscale {

/// Sees to it that a run can be gone on with: writes checkpoints when they are due, and ends the run in good
/// order when a signal or its wall time asks for it.
///
/// All ranks must do so at the same step. They look together, at one small reduction, at steps that lie about
/// a tenth of a second apart, which rank 0's clock chooses and hands out at the look before.
class Checkpoints {
 public:
  Checkpoints(SlidingBody& body, Recorder& recorder, const StopRequest& request, SceneMarks marks,
              const CheckpointChoice& choice);

  /// What it will take, for the user to see. Collective.
  std::string forecast();
  /// After the record of step n. Throws Interruption when the run is to end here. Collective at the steps
  /// that all ranks share.
  void after_step(long n) {
    if (n >= next_look_) look(n);
  }
  /// After the last step, when everything else is written. Collective.
  void finish(long n);

 private:
  void look(long n);
  void write(long n, bool sync);
  [[noreturn]] void interrupt(long n, const std::string& why);
  long next_look(long n) const;  ///< on rank 0

  SlidingBody& body_;
  Recorder& recorder_;
  const SceneMarks marks_;
  const CheckpointChoice choice_;
  const StopRequest& request_;
  long next_look_, first_;
  double begun_, written_at_;  ///< s since the program began
  double longest_write_ = 0;   ///< s
};

}  // namespace slipscale
