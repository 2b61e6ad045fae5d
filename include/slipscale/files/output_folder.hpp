#pragma once

#include <mpi.h>

#include <functional>
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
  /// Whether the older run in a folder, which nobody writes to now, is worth more than its files' room.
  using WorthKeeping = std::function<bool(const std::string& folder)>;

  /// Creates it and the folders above it, and removes the files of an older run that this one will write,
  /// `replaced`, and nothing else; when they are worth keeping (asked on rank 0) they go into the folder
  /// `replaced` below it, in place of what that held of an earlier one. Throws `UserError` on all ranks when
  /// the folder cannot be created or written to, holds a folder by the name of a file, or belongs to a run
  /// that goes on. Collective.
  OutputFolder(MPI_Comm comm, const std::string& folder, const std::vector<std::string>& replaced = {},
               const WorthKeeping& worth_keeping = {});
  ~OutputFolder();
  OutputFolder(OutputFolder&&) noexcept;

  const std::string& path() const { return path_; }
  std::string path(const std::string& file) const { return path_ + "/" + file; }
  /// Where the older run is kept; empty when there is none.
  const std::string& kept() const { return kept_; }

  /// Replaces a text file as a whole; rank 0 writes, `RunError` on all ranks when it cannot. Collective.
  void write_text(const std::string& file, const std::string& text) const;

 private:
  MPI_Comm comm_;
  std::string path_, kept_;
  std::unique_ptr<FolderLock> lock_;  ///< on rank 0
};

}  // namespace slipscale
