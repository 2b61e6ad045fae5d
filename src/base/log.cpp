#include "slipscale/base/log.hpp"

#include "slipscale/base/error.hpp"

namespace slipscale {

LogStage::LogStage(const char* name) {
  PetscLogStage stage = 0;
  petsc(PetscLogStageRegister(name, &stage));
  petsc(PetscLogStagePush(stage));
}

LogEvent::LogEvent(const char* name) {
  PetscClassId family = 0;
  petsc(PetscClassIdRegister("slipscale", &family));
  petsc(PetscLogEventRegister(name, family, &id_));
}

}  // namespace slipscale
