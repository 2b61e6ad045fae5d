#pragma once

#include <string>

namespace slipscale {

/// Keeps a folder for one process, by a lock of the system on a file in it. The system drops the lock when
/// the process ends, however it ends, so a file that a killed run leaves is in nobody's way.
class FolderLock {
 public:
  /// Throws `UserError` where another process, or another object of this one, holds the folder, and
  /// `LibraryError` with the system's words where no file can be made in it. A file system that has no locks
  /// is taken as it is.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();  ///< removes the file
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace slipscale
