#pragma once

#include <string>

namespace slipscale {

/// The text of a file, read by rank 0 of MPI_COMM_WORLD and given to all. Throws `UserError` naming `option`
/// when it cannot be read. Collective.
std::string read_on_all(const std::string& option, const std::string& file);

/// Adds the options of a YAML text to PETSc's database. `file` is for messages. Throws `UserError` when the
/// text is no YAML, nests lists or says the same thing twice. Every rank must pass the same text.
void insert_scene(const std::string& file, const std::string& text);

}  // namespace slipscale
