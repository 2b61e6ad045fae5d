#pragma once

#include <petscsys.h>

namespace slipscale {

/// A part of the run that `-log_view` reports on its own, from construction to destruction.
class LogStage {
 public:
  explicit LogStage(const char* name);
  ~LogStage() { (void)PetscLogStagePop(); }
  LogStage(const LogStage&) = delete;
  LogStage& operator=(const LogStage&) = delete;
};

/// A line of `-log_view`, registered once: `static const LogEvent event("Contact");`
class LogEvent {
 public:
  explicit LogEvent(const char* name);

  /// Counts and times from construction to destruction.
  class Scope {
   public:
    explicit Scope(const LogEvent& event) : id_(event.id_) { (void)PetscLogEventBegin(id_, 0, 0, 0, 0); }
    ~Scope() { (void)PetscLogEventEnd(id_, 0, 0, 0, 0); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    PetscLogEvent id_;
  };

 private:
  PetscLogEvent id_ = 0;
};

}  // namespace slipscale
