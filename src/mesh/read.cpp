#include "slipscale/mesh/read.hpp"

#include "gmsh_file.hpp"
#include "slipscale/base/parallel.hpp"
#include "stages.hpp"

namespace slipscale {
namespace {

using mesh_stages::GmshFile;

void broadcast(MPI_Comm comm, std::string& text) {
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, comm);
}

void broadcast(MPI_Comm comm, GmshFile& file) {
  int count = static_cast<int>(file.names.size());
  MPI_Bcast(&count, 1, MPI_INT, 0, comm);
  MPI_Bcast(&file.checksum, 1, MPI_UINT64_T, 0, comm);
  MPI_Bcast(&file.has_periodic_section, 1, MPI_CXX_BOOL, 0, comm);
  MPI_Bcast(&file.is_read, 1, MPI_CXX_BOOL, 0, comm);
  file.names.resize(static_cast<std::size_t>(count));
  for (auto& entry : file.names) {
    MPI_Bcast(&entry.dimension, 1, MPI_INT, 0, comm);
    MPI_Bcast(&entry.tag, 1, MPI_INT, 0, comm);
    broadcast(comm, entry.name);
  }
}

GmshFile read_file(MPI_Comm comm, const std::string& path) {
  GmshFile file;
  std::string fault;
  if (is_root(comm)) {
    file = mesh_stages::read_gmsh(path, fault);
    if (fault.empty() && file.version < 4 && file.has_periodic_section)
      fault = "mesh '" + path +
              "' is periodic but written as MSH 2, which loses periodicity; use gmsh -format msh41";
    if (fault.empty()) fault = mesh_stages::fault_in_names(path, file.names);
  }
  throw_together(comm, fault);
  broadcast(comm, file);
  return file;
}

}  // namespace

Schema mesh_schema() {
  return {
      {"mesh_file", Kind::text, "", required, range::any,
       "gmsh mesh (MSH 4.1, in metres) with named physical surfaces and curves"},
      {"mesh_partitioner", Kind::text, "", "metis", range::one_of({"metis", "simple", "ptscotch"}),
       "how the mesh is cut: METIS with a fixed seed, equal runs of the node order, or PT-Scotch"},
      {"mesh_refine", Kind::integer, "1", "0", range::non_negative,
       "uniform refinements before partitioning; new nodes are not moved onto curved boundaries"},
  };
}

MeshSource mesh_source(const Options& options) {
  MeshSource source;
  source.file = options.text("mesh_file");
  const std::string name = options.text("mesh_partitioner");
  source.partitioner = name == "simple"     ? Partitioner::simple
                       : name == "ptscotch" ? Partitioner::ptscotch
                                            : Partitioner::metis;
  source.refine = static_cast<int>(options.integer("mesh_refine"));
  return source;
}

Schema periodic_mesh_schema() {
  return mesh_schema() +
         Schema{{"mesh_periodic",
                 Kind::flag,
                 "",
                 "true",
                 {},
                 "keep the sides periodic that gmsh made so; false opens them, so that one mesh "
                 "serves as periodic cell and as block"}};
}

MeshSource periodic_mesh_source(const Options& options) {
  MeshSource source = mesh_source(options);
  source.cut = source.cut_by_choice = !options.flag("mesh_periodic");
  return source;
}

Mesh read_mesh(MPI_Comm comm, const MeshSource& source) {
  Mesh mesh;
  mesh.file = source.file;
  GmshFile file = read_file(comm, source.file);
  if (source.cut_by_choice && !file.has_periodic_section)
    throw UserError("-mesh_periodic false has no effect: mesh '" + source.file +
                    "' is not periodic; leave the option out");
  mesh.checksum = file.checksum;
  mesh_stages::distribute(comm, mesh_stages::load_whole(comm, source, std::move(file)), source.partitioner,
                          mesh);
  return mesh;
}

}  // namespace slipscale
