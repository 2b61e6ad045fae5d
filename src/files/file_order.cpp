#include "slipscale/files/file_order.hpp"

namespace slipscale {
namespace {

/// `width` numbers that travel as one.
class RowType {
 public:
  RowType(MPI_Datatype number, int width) {
    MPI_Type_contiguous(width, number, &type_);
    MPI_Type_commit(&type_);
  }
  ~RowType() { MPI_Type_free(&type_); }
  RowType(const RowType&) = delete;
  RowType& operator=(const RowType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

class OwnedLayout {
 public:
  OwnedLayout(MPI_Comm comm, PetscInt total) {
    petsc(PetscLayoutCreateFromSizes(comm, PETSC_DECIDE, total, 1, &layout_));
  }
  ~OwnedLayout() { (void)PetscLayoutDestroy(&layout_); }
  OwnedLayout(const OwnedLayout&) = delete;
  OwnedLayout& operator=(const OwnedLayout&) = delete;
  operator PetscLayout() const { return layout_; }

 private:
  PetscLayout layout_ = nullptr;
};

}  // namespace

FileOrder::FileOrder(MPI_Comm comm, PetscInt total, const std::vector<PetscInt>& numbers)
    : total_(total), rows_(numbers.size()) {
  const OwnedLayout layout(comm, total);
  PetscInt end = 0;
  petsc(PetscLayoutGetRange(layout, &begin_, &end));
  count_ = end - begin_;
  petsc(PetscSFCreate(comm, sf_.put()));
  petsc(PetscSFSetGraphLayout(sf_, layout, static_cast<PetscInt>(rows_), nullptr, PETSC_COPY_VALUES,
                              numbers.data()));
  petsc(PetscSFSetUp(sf_));
}

template <class Number>
std::vector<Number> FileOrder::reduce(const Number* rows, int width, MPI_Datatype number) const {
  std::vector<Number> slice(static_cast<std::size_t>(count_) * width);
  const RowType row(number, width);
  petsc(PetscSFReduceBegin(sf_, row, rows, slice.data(), MPI_REPLACE));
  petsc(PetscSFReduceEnd(sf_, row, rows, slice.data(), MPI_REPLACE));
  return slice;
}

std::vector<double> FileOrder::to_file(const double* rows, int width) const {
  return reduce(rows, width, MPI_DOUBLE);
}

std::vector<PetscInt> FileOrder::to_file(const PetscInt* rows, int width) const {
  return reduce(rows, width, MPIU_INT);
}

template <class Number>
std::vector<Number> FileOrder::broadcast(const Number* slice, int width, MPI_Datatype number) const {
  std::vector<Number> rows(rows_ * width);
  const RowType row(number, width);
  petsc(PetscSFBcastBegin(sf_, row, slice, rows.data(), MPI_REPLACE));
  petsc(PetscSFBcastEnd(sf_, row, slice, rows.data(), MPI_REPLACE));
  return rows;
}

std::vector<double> FileOrder::from_file(const double* slice, int width) const {
  return broadcast(slice, width, MPI_DOUBLE);
}

std::vector<PetscInt> FileOrder::from_file(const PetscInt* slice, int width) const {
  return broadcast(slice, width, MPIU_INT);
}

}  // namespace slipscale
