#pragma once

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

#include "slipscale/files/hdf5.hpp"
#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale {

/// Where a file is expected and who makes it, for the sentences to the user.
struct GridFileSource {
  std::string path;    ///< the file, or its folder
  std::string name;    ///< fields.h5
  std::string option;  ///< that led here, without dash
  std::string cure;    ///< how to get such a file: "run slide with -fields_every or -fields_times"
};

/// An HDF5 file with a /mesh, read by each rank by itself: serial driver, no file locking, so that the file
/// of a running job can be read. What fails on one rank throws UserError on all: every member that reads is
/// collective, and so is the constructor.
class GridFile {
 public:
  GridFile(MPI_Comm comm, GridFileSource source);

  const std::string& path() const { return source_.path; }
  bool has(const std::string& dataset) const;

  /// Runs what reads; its failure, a damaged file, becomes a UserError on all ranks.
  void together(const std::function<void()>& read) const;
  /// Throws UserError on all ranks, the file, the fault and the cure, unless `fine` on all of them.
  void refuse_unless(bool fine, const std::string& fault, const std::string& cure) const;
  void refuse_unless(bool fine, const std::string& fault) const { refuse_unless(fine, fault, source_.cure); }

  /// Whether an object has an attribute, as files of older versions may not.
  bool has_attribute(const std::string& object, const std::string& attribute) const;

  /// /mesh with its regions; checked: no index leads astray, every cell has an area, and they do not overlap.
  /// Collective.
  PlaneGrid grid() const;

  // To be called within `together`; throw LibraryError, also for what is not a finite number and where the
  // file is too small for what a dataset declares.

  std::vector<hsize_t> shape(const std::string& dataset) const;
  std::vector<double> reals(const std::string& dataset) const;
  /// Rows [begin, begin + count) of `width` numbers each, of a dataset that must have `rows` of them.
  void read_rows(const std::string& dataset, hsize_t rows, hsize_t width, hsize_t begin, hsize_t count,
                 double* to) const;
  double number(const std::string& object, const std::string& attribute) const;
  /// A text, or a list of texts.
  std::vector<std::string> texts(const std::string& object, const std::string& attribute) const;

 private:
  std::vector<int> integers(const std::string& dataset) const;
  void read_mesh(PlaneGrid& grid) const;

  MPI_Comm comm_;
  GridFileSource source_;
  Hdf5File file_;
};

}  // namespace slipscale
