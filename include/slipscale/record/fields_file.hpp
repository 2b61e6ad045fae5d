#pragma once

#include <string>
#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/record/file_order.hpp"
#include "slipscale/record/hdf5.hpp"
#include "slipscale/record/mesh_image.hpp"

namespace slipscale {

/// What fields.h5 holds at each saved time.
struct FieldQuantities {
  bool u = true, v = true, stress = true;
};

/// Reads "u,v,stress" or a part of it, in any order. Throws `UserError` naming `option` on anything else.
FieldQuantities field_quantities(const std::string& list, const std::string& option = "fields_quantities");

/// What fields.xdmf says about fields.h5, which lies beside it.
struct XdmfLayout {
  std::string data_file;
  MeshImage::Topology topology = MeshImage::Topology::triangles;
  PetscInt points = 0, cells = 0;
  hsize_t stream_length = 0;  ///< mixed: entries of /mesh/cells
  FieldQuantities quantities;
};

/// fields.h5 and fields.xdmf: the mesh and the fields on it at the saved times; opens in ParaView as it is.
///
/// The order is that of the whole mesh: the same data on any number of ranks. Each frame is on the disk
/// before `write` returns, and fields.xdmf, replaced as a whole, never names one that is not. All members are
/// collective; a failure on one rank, a full disk say, throws `UserError` on all.
class FieldsFile {
 public:
  /// Writes the mesh. `folder` must exist; older files of these names are overwritten.
  FieldsFile(MPI_Comm comm, const Mesh& mesh, const std::string& folder, FieldQuantities quantities);

  /// Adds a frame. u and v [owned nodes (ghosts may follow), 2] m and m/s, stress [local cells, 3] Pa as
  /// (xx, yy, xy); what is not among the quantities may be null.
  void write(double time, const double* u, const double* v, const double* stress);

  /// Closes the file, so that a failure to write its last bytes is not lost.
  void close();

 private:
  struct Description {
    std::string path, units, text;
  };
  std::string path() const;
  XdmfLayout layout() const;
  void reserve(double bytes);
  void write_mesh(const Mesh& mesh);
  void write_nodal(const Description& about, const double* values);
  void write_stress(const Description& about, const double* stress);
  void append_time(double time);
  void write_slice(const Description& about, const FileOrder& order, hsize_t width, hid_t type,
                   const void* slice);
  void write_slice(const Description& about, const std::vector<hsize_t>& shape, hsize_t begin, hsize_t count,
                   hid_t type, const void* slice);

  MPI_Comm comm_;
  int rank_ = 0;
  std::string folder_;
  FieldQuantities quantities_;
  MeshImage image_;
  hsize_t stream_length_ = 0;
  Hdf5File file_;
  Hdf5Dataset time_;
  std::vector<double> times_;
};

}  // namespace slipscale
