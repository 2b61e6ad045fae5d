#include "slipscale/files/disk_space.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

/// An open file, closed on the way out.
class File {
 public:
  explicit File(const std::string& path, int flags = O_WRONLY)
      : number_(open(path.c_str(), flags | O_CLOEXEC)) {
    if (number_ < 0) throw LibraryError(std::strerror(errno));
  }
  ~File() { (void)close(number_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

/// Past this limit the system ends the process where it would report a fault of the disk.
void refuse_above_limit(std::uint64_t size) {
  rlimit largest{};
  if (getrlimit(RLIMIT_FSIZE, &largest) == 0 && size > largest.rlim_cur)
    throw LibraryError(std::strerror(EFBIG));
}

}  // namespace

std::string write_fault(const std::string& path, const std::string& reason) {
  return path + " cannot be written: " + reason +
         "; see that -output_folder is writable and its disk has room";
}

void reserve_space(const std::string& path, std::uint64_t from, std::uint64_t bytes) {
  if (bytes == 0) return;
  refuse_above_limit(from + bytes);
  int reason = 0;
  {
    const File file(path);
    if (fallocate(file, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(from), static_cast<off_t>(bytes)) == 0)
      return;
    reason = errno;
  }
  if (reason == EOPNOTSUPP || reason == ENOSYS)
    fill_with_zeros(path, from + bytes);
  else
    throw LibraryError(std::strerror(reason));
}

void Reservation::reach(const std::string& path, std::uint64_t from, std::uint64_t bytes) {
  if (from + bytes <= end_) {  // but the file may have been removed
    if (access(path.c_str(), F_OK) != 0) throw LibraryError(std::strerror(errno));
    return;
  }
  const std::uint64_t ahead = 2 * bytes;
  try {
    reserve_space(path, from, ahead);
    end_ = from + ahead;
  } catch (const LibraryError&) {
    reserve_space(path, from, bytes);
    end_ = from + bytes;
  }
}

void fill_with_zeros(const std::string& path, std::uint64_t size) {
  refuse_above_limit(size);
  const File file(path);
  struct stat status {};
  if (fstat(file, &status) != 0) throw LibraryError(std::strerror(errno));
  const auto old = static_cast<std::uint64_t>(status.st_size);
  const std::vector<char> zeros(std::size_t{1} << 20, 0);
  for (std::uint64_t at = old; at < size;) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(zeros.size(), size - at));
    const ssize_t written = pwrite(file, zeros.data(), count, static_cast<off_t>(at));
    if (written <= 0) {
      const int reason = written < 0 ? errno : ENOSPC;
      (void)ftruncate(file, status.st_size);
      throw LibraryError(std::strerror(reason));
    }
    at += static_cast<std::uint64_t>(written);
  }
  // Over a network the answer comes only now.
  if (fdatasync(file) != 0) {
    const int reason = errno;
    (void)ftruncate(file, status.st_size);
    throw LibraryError(std::strerror(reason));
  }
}

void give_back_space(const std::string& path, std::uint64_t size) {
  if (truncate(path.c_str(), static_cast<off_t>(size)) != 0) throw LibraryError(std::strerror(errno));
}

void sync_file(const std::string& path) {
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  const File file(path, O_RDONLY), place(folder, O_RDONLY | O_DIRECTORY);
  if (fsync(file) != 0) throw LibraryError(std::strerror(errno));
  // Some file systems have nothing to write for a folder, and say so.
  if (fsync(place) != 0 && errno != EINVAL && errno != ENOTSUP) throw LibraryError(std::strerror(errno));
}

}  // namespace slipscale
