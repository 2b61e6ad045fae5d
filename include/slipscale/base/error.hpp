#pragma once

#include <petscsys.h>

#include <source_location>
#include <stdexcept>
#include <string>

namespace slipscale {

/// A mistake of the user: one sentence that names the option or the mesh entity, the fault and the cure.
/// Must be thrown on every rank of the communicator (see `throw_together`); the program exits with code 2.
class UserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The run cannot go on (a state that is not finite, a full disk): one sentence with the step and the place.
/// Must be thrown on every rank, like `UserError`; exit code 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The run was asked to stop and has left all that it takes to go on: one sentence that says how. Must be
/// thrown on every rank, like `UserError`; exit code 3.
class Interruption : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A library (PETSc, METIS, HDF5, …) reported a failure that is not a mistake of the user; exit code 1.
class LibraryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws `LibraryError` with PETSc's own message when `code` is not zero: `petsc(VecSet(x, 0.0));`
void petsc(PetscErrorCode code, std::source_location where = std::source_location::current());

/// From now on PETSc keeps the text of a failure for `petsc` and `take_petsc_message` instead of printing it.
void keep_petsc_messages();

/// PETSc's text of the failure that is being handled; empty when there is none. Reading it clears it.
std::string take_petsc_message();

/// Makes a rank-local finding collective: when any rank passes a text that is not empty, all ranks throw
/// `UserError` with the text of the lowest such rank. Collective.
void throw_together(MPI_Comm comm, const std::string& fault);

/// The same with `RunError`: for what no option of the user's could have spared him, a full disk say.
/// Collective.
void stop_together(MPI_Comm comm, const std::string& fault);

}  // namespace slipscale
