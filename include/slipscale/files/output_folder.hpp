#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace slipscale {

/// Writes a text under a temporary name and renames it, so that nobody ever sees half of it. On the calling
/// rank only; throws `LibraryError` with the system's words.
void replace_text_file(const std::string& path, const std::string& text);

/// The folder of one run.
class OutputFolder {
 public:
  /// Creates it and the folders above it, and removes the files of an older run that this one will write,
  /// `replaced`, and nothing else. Throws `UserError` on all ranks when the folder cannot be created or
  /// written to. Collective.
  OutputFolder(MPI_Comm comm, const std::string& folder, const std::vector<std::string>& replaced = {});

  const std::string& path() const { return path_; }
  std::string path(const std::string& file) const { return path_ + "/" + file; }

  /// Replaces a text file as a whole; rank 0 writes, `UserError` on all ranks when it cannot. Collective.
  void write_text(const std::string& file, const std::string& text) const;

 private:
  MPI_Comm comm_;
  std::string path_;
};

}  // namespace slipscale
