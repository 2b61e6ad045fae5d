#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/files/hdf5.hpp"
#include "slipscale/files/mesh_image.hpp"
#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

class SharedFile;
struct XdmfDocument;
struct DatasetDescription;

/// What fields.h5 holds at each saved time.
struct FieldQuantities {
  bool u = true, v = true, stress = true, strain = false, von_mises = false, principal = false,
       damping_work = false;

  bool of_stress() const { return stress || von_mises || principal; }  ///< needs the stress of the cells
};

/// Reads "u,v,stress,strain,von_mises,principal,damping_work" or a part of it, in any order. Throws
/// `UserError` naming `option` on anything else.
FieldQuantities field_quantities(const std::string& list, const std::string& option = "fields_quantities");

/// fields.h5 and fields.xdmf: the mesh and the fields on it at the saved times; opens in ParaView as it is.
///
/// /mesh/coordinates [points, 2] m, /mesh/cells, /mesh/region [cells]; /time [frames] s; /frames/00000/u, v
/// [points, 3] m and m/s, stress [cells, 3] Pa as (xx, yy, xy) with stress_zz [cells] beside it, strain
/// [cells, 3] with engineering shear, von_mises [cells] and principal_high and principal_low [cells], the
/// principal stresses in the plane, Pa; damping_work [cells], J/m³ since t = 0. stress_tensor [cells, 3, 3]
/// is a view of stress and stress_zz without data of its own, from which ParaView names the components XX,
/// YY, ZZ and XY; strain_xx, strain_yy and strain_xy are views of the strain's columns. Of an image with a
/// box only that part. In the order of the whole mesh: the same data on any number of ranks.
///
/// Each frame is on the disk before `write` returns, and the XDMF file, replaced as a whole, never names one
/// that is not. All members are collective; a failure on one rank, a full disk say, throws `RunError` on all.
class FieldsFile {
 public:
  /// Writes the mesh. `folder` must exist; older files of these names, `name`.h5 and .xdmf, are overwritten.
  /// `transverse` [local cells] is σ_zz/(σ_xx + σ_yy), see `transverse_ratio`; without it nothing is known of
  /// zz. `frames`: continues a file that another process began, with so many of its frames; nothing is
  /// written before the next frame, or the end, which remove the others. Throws `UserError` when it has fewer
  /// frames, another mesh or other quantities.
  FieldsFile(MPI_Comm comm, MeshImage image, const std::string& folder, FieldQuantities quantities,
             const std::string& name = "fields", std::vector<double> transverse = {},
             std::optional<std::size_t> frames = {});
  /// Of the whole mesh, without a box.
  FieldsFile(MPI_Comm comm, const Mesh& mesh, const std::string& folder, FieldQuantities quantities);
  ~FieldsFile();

  /// Adds a frame. u and v [owned nodes (ghosts may follow), 2] m and m/s, stress and strain [local cells, 3]
  /// Pa and 1 as (xx, yy, xy), damping_work [local cells] J/m³; what is not among the quantities may be null.
  void write(double time, const double* u, const double* v, const double* stress,
             const double* strain = nullptr, const double* damping_work = nullptr);

  std::size_t frames() const;  ///< so far

  /// On rank 0, what tells whether the mesh, then each frame is still what was written. Of a continued file
  /// they are read from it, wholly, to be compared by `expect`, which throws as the constructor. Collective.
  const std::vector<std::uint64_t>& contents() const { return contents_; }
  void expect(const std::vector<std::uint64_t>& contents) const;

  /// A text about the file, an attribute of its root group; what is continued must have it. Throws as the
  /// constructor. Collective.
  void about(const std::string& name, const std::string& text);

  /// Predicted size after `frames` frames.
  double bytes(double frames) const;

  /// Closes the file, so that a failure to write its last bytes is not lost.
  void close();

 private:
  void check_frames(std::size_t frames) const;
  void check_frame(hid_t file, const std::string& group) const;
  void cut_back();
  void write_nodal(const DatasetDescription& about, const double* values);
  void write_on_cells(const DatasetDescription& about, const double* values);
  void write_stress(const std::string& frame, const double* stress);
  void write_strain(const std::string& frame, const double* strain);

  MPI_Comm comm_;
  const FieldQuantities quantities_;
  const MeshImage image_;
  const std::vector<double> transverse_;
  std::unique_ptr<SharedFile> file_;
  std::string xdmf_path_;
  std::unique_ptr<XdmfDocument> xdmf_;
  std::vector<std::uint64_t> contents_;  ///< [1 + frames] on rank 0
  bool to_cut_ = false;                  ///< there may be frames behind those that count
};

/// Predicted size of fields.h5 after `frames` frames, bytes.
double fields_bytes(double frames, std::int64_t points, std::int64_t cells,
                    const FieldQuantities& quantities);

}  // namespace slipscale
