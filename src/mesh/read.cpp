#include "slipscale/mesh/read.hpp"

#include "slipscale/base/large_array.hpp"
#include "stages.hpp"

namespace slipscale {
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
  mesh.comm = comm;
  mesh.file = source.file;
  mesh_stages::Whole whole = mesh_stages::load_whole(comm, source);
  mesh.checksum = whole.checksum;
  mesh.notes = whole.notes;
  mesh_stages::distribute(comm, std::move(whole), source.partitioner, mesh);
  give_back_freed();
  return mesh;
}

}  // namespace slipscale
