#pragma once

#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// The text of a file, read by rank 0 of MPI_COMM_WORLD and given to all. Throws `UserError` naming `option`
/// when it cannot be read. Collective.
std::string read_on_all(const std::string& option, const std::string& file);

/// Adds the options of a YAML text to PETSc's database. `file` is for messages. Throws `UserError` when the
/// text is no YAML, nests lists or says the same thing twice. Every rank must pass the same text.
void insert_scene(const std::string& file, const std::string& text);

/// Adds those of a command line, which ends with a null pointer and begins with the program's name.
void insert_arguments(std::vector<char*> arguments);

/// Who wrote which option, in the order in which they were added.
const Origins& written_options();

}  // namespace slipscale
