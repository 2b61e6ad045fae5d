#pragma once

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace slipscale {

class FolderLock;

/// Writes a text under a temporary name and renames it, so that nobody ever sees half of it. Returns one
/// sentence on why it could not, with the system's words; empty when it could. On the calling rank only.
std::string try_replace_text_file(const std::string& path, const std::string& text);
/// The same; throws the sentence as `LibraryError`.
void replace_text_file(const std::string& path, const std::string& text);

/// Why no file can be written into the folder -output_folder names, which need not exist yet: one sentence
/// with the cure; empty when one can. Leaves everything as it is. On the calling rank only.
std::string why_unwritable(const std::string& folder);

/// Throws `UserError` with that sentence, as rank 0 finds it, on all ranks: to be asked before long work.
/// Collective.
void refuse_unwritable(MPI_Comm comm, const std::string& folder);

/// The folder of one run, and of one only: while this object lives another run is kept out of it.
class OutputFolder {
 public:
  /// Creates it and the folders above it, and removes the files of an older run that this one will write,
  /// `replaced`, and nothing else. Throws `UserError` on all ranks when the folder cannot be created or
  /// written to, or belongs to a run that goes on. Collective.
  OutputFolder(MPI_Comm comm, const std::string& folder, const std::vector<std::string>& replaced = {});
  ~OutputFolder();
  OutputFolder(OutputFolder&&) noexcept;

  const std::string& path() const { return path_; }
  std::string path(const std::string& file) const { return path_ + "/" + file; }

  /// Replaces a text file as a whole; rank 0 writes, `RunError` on all ranks when it cannot. Collective.
  void write_text(const std::string& file, const std::string& text) const;

 private:
  MPI_Comm comm_;
  std::string path_;
  std::unique_ptr<FolderLock> lock_;  ///< on rank 0
};

}  // namespace slipscale
