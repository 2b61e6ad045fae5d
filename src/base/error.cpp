#include "slipscale/base/error.hpp"

#include <utility>

#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

std::string petsc_message;

/// Keeps PETSc's first message and prints nothing: whoever catches the exception decides what the user sees.
PetscErrorCode keep_message(MPI_Comm comm, int line, const char* function, const char* file,
                            PetscErrorCode code, PetscErrorType type, const char* message, void* context) {
  // A crash never comes back to us, so PETSc's own report of where it was is the only one there will be.
  if (code == PETSC_ERR_SIG)
    return PetscTraceBackErrorHandler(comm, line, function, file, code, type, message, context);
  if (type == PETSC_ERROR_REPEAT) return code;
  const char* generic = nullptr;
  (void)PetscErrorMessage(code, &generic, nullptr);
  petsc_message = message && *message ? message : generic ? generic : "unknown failure";
  while (!petsc_message.empty() && petsc_message.back() == '\n') petsc_message.pop_back();
  petsc_message += std::string(" [") + (function ? function : "?") + "() at " + (file ? file : "?") + ":" +
                   std::to_string(line) + "]";
  return code;
}

/// The text of the lowest rank that has one; empty when none has. Collective.
std::string first_fault(MPI_Comm comm, std::string fault) {
  const int rank = rank_of(comm), size = ranks_of(comm);
  int speaker = fault.empty() ? size : rank;
  MPI_Allreduce(MPI_IN_PLACE, &speaker, 1, MPI_INT, MPI_MIN, comm);
  if (speaker == size) return "";
  int length = static_cast<int>(fault.size());
  MPI_Bcast(&length, 1, MPI_INT, speaker, comm);
  fault.resize(static_cast<std::size_t>(length));
  MPI_Bcast(fault.data(), length, MPI_CHAR, speaker, comm);
  return fault;
}

}  // namespace

void keep_petsc_messages() { (void)PetscPushErrorHandler(keep_message, nullptr); }

std::string take_petsc_message() { return std::exchange(petsc_message, {}); }

void petsc(PetscErrorCode code, std::source_location where) {
  if (code == 0) return;
  std::string message = take_petsc_message();
  if (message.empty()) {
    const char* generic = nullptr;
    (void)PetscErrorMessage(code, &generic, nullptr);
    message = generic ? generic : "unknown failure";
  }
  throw LibraryError("PETSc error " + std::to_string(static_cast<int>(code)) + ": " + message +
                     ", called from " + where.file_name() + ":" + std::to_string(where.line()));
}

void throw_together(MPI_Comm comm, const std::string& fault) {
  if (const std::string first = first_fault(comm, fault); !first.empty()) throw UserError(first);
}

void stop_together(MPI_Comm comm, const std::string& fault) {
  if (const std::string first = first_fault(comm, fault); !first.empty()) throw RunError(first);
}

}  // namespace slipscale
