#pragma once

#include <petscdmplex.h>
#include <petscsf.h>
#include <petscvec.h>

#include <utility>

#include "slipscale/base/error.hpp"

namespace slipscale {

/// The one owner of a PETSc object. Pass the plain handle (`Vec`, `DM`, …) to whoever only looks at it.
template <class Handle, PetscErrorCode (*Destroy)(Handle*)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(Handle handle) : handle_(handle) {}
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owned() {
    if (handle_) (void)Destroy(&handle_);
  }

  Handle get() const { return handle_; }
  operator Handle() const { return handle_; }
  /// Where a PETSc `…Create` function stores its new object; frees the one held before.
  Handle* put() {
    if (handle_) petsc(Destroy(&handle_));
    return &handle_;
  }

 private:
  Handle handle_ = nullptr;
};

using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedDM = Owned<DM, DMDestroy>;
using OwnedSF = Owned<PetscSF, PetscSFDestroy>;
using OwnedSection = Owned<PetscSection, PetscSectionDestroy>;
using OwnedIS = Owned<IS, ISDestroy>;

}  // namespace slipscale
