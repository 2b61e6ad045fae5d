#pragma once

#include <cstdint>
#include <vector>

#include "slipscale/base/petsc.hpp"

namespace slipscale {

/// Moves rows between the ranks that compute them and the contiguous slices in which a file of the whole mesh
/// is written and read. The file's order is that of the whole mesh, so its bytes do not depend on the ranks.
///
/// `numbers` [rows]: the file row of each row this rank holds. For `to_file` every file row must be held by
/// exactly one rank (owned nodes, owned cells); for `from_file` rows may be held by several (ghosts) or by
/// none. Rows have `width` entries and are stored one after the other. All members are collective.
class FileOrder {
 public:
  FileOrder() = default;
  FileOrder(MPI_Comm comm, PetscInt total, const std::vector<PetscInt>& numbers);

  PetscInt total() const { return total_; }
  PetscInt begin() const { return begin_; }  ///< first file row of this rank's slice
  PetscInt count() const { return count_; }  ///< file rows in it

  /// This rank's slice [count, width] of the file, from the rows [rows, width] of all ranks.
  std::vector<double> to_file(const double* rows, int width) const;
  std::vector<PetscInt> to_file(const PetscInt* rows, int width) const;

  /// This rank's rows [rows, width], from the slices [count, width] of all ranks.
  std::vector<double> from_file(const double* slice, int width) const;
  std::vector<PetscInt> from_file(const PetscInt* slice, int width) const;

 private:
  template <class Number>
  std::vector<Number> reduce(const Number* rows, int width, MPI_Datatype number) const;
  template <class Number>
  std::vector<Number> broadcast(const Number* slice, int width, MPI_Datatype number) const;

  OwnedSF sf_;
  PetscInt total_ = 0, begin_ = 0, count_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace slipscale
