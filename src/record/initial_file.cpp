#include "slipscale/record/initial_file.hpp"

#include <filesystem>

#include "slipscale/base/error.hpp"
#include "slipscale/files/hdf5.hpp"
#include "slipscale/files/nodal_fields.hpp"

namespace slipscale {
namespace {

namespace fs = std::filesystem;

bool lies_in(const std::string& path, const std::string& folder) {
  std::error_code ignored;
  const fs::path own = fs::is_directory(path, ignored) ? fs::path(path) : fs::absolute(path).parent_path();
  return fs::weakly_canonical(own, ignored) == fs::weakly_canonical(fs::absolute(folder), ignored);
}

}  // namespace

InitialFile read_initial_file(const Mesh& mesh, const std::string& folder, InitialState& initial) {
  if (initial.file.empty()) return {};
  if (!initial.file.ends_with(".csv") && lies_in(initial.file, folder))
    throw UserError("-initial_file lies in '" + folder +
                    "', where this run writes its own files; give another -output_folder");
  NodalFields found = read_nodal_fields(mesh.comm, initial.file, "initial_file", initial.file_time,
                                        "initial_time", mesh.nodes.position);
  auto fields = std::make_shared<InitialFields>();
  fields->displacement = std::move(found.displacement);
  fields->velocity = std::move(found.velocity);
  initial.fields = std::move(fields);
  return {found.description, checksum_text(found.checksum)};
}

}  // namespace slipscale
