#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh_group.hpp"

namespace slipscale {

/// A field that an XDMF file shows.
struct XdmfAttribute {
  enum class Centre { node, cell };
  enum class Number { real, index };

  std::string name;
  Centre centre = Centre::cell;
  std::string path;          ///< of its dataset; without leading '/': below that of each frame
  std::vector<hsize_t> row;  ///< {} shows a scalar, {3} a vector, {3, 3} a tensor
  Number number = Number::real;
};

/// What an XDMF file says of the HDF5 file that lies beside it.
struct XdmfDocument {
  std::string data_file, grid;
  MeshLayout mesh;
  std::vector<XdmfAttribute> attributes;
  std::optional<std::vector<double>> times = {};  ///< s, of the frames; absent: the fields do not change
};

/// Writes a view of each entry of a dataset on cells, "<path>_<component>", and returns how XDMF shows them,
/// so that a list of tensor components does not pass for a vector in space. `row`: the shape of the dataset's
/// rows, with as many entries as there are `components`; `name`: of the field. Collective.
std::vector<XdmfAttribute> write_components(SharedFile& file, const MeshLayout& mesh,
                                            const DatasetDescription& about, const std::vector<hsize_t>& row,
                                            const std::vector<std::string>& components,
                                            const std::string& name);

/// /mesh/region as a field.
XdmfAttribute xdmf_region();

/// Where the fields of a frame are: "/frames/00012/".
std::string frame_path(std::size_t frame);

/// The whole file. Every frame repeats the references to the mesh, which all readers take: ParaView's two and
/// meshio's TimeSeriesReader.
std::string xdmf_text(const XdmfDocument& document);

/// Replaces the file as a whole; `RunError` on all ranks when it cannot be written. Collective.
void write_xdmf(MPI_Comm comm, const std::string& path, const XdmfDocument& document);

}  // namespace slipscale
