#include "disk_space.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "slipscale/base/error.hpp"

namespace slipscale {

void reserve_space(const std::string& path, std::uint64_t from, std::uint64_t bytes) {
  rlimit largest{};
  if (getrlimit(RLIMIT_FSIZE, &largest) == 0 && from + bytes > largest.rlim_cur)
    throw LibraryError(std::strerror(EFBIG));
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  const bool failed =
      fallocate(file, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(from), static_cast<off_t>(bytes)) != 0;
  const int reason = errno;
  close(file);
  if (failed && (reason == ENOSPC || reason == EDQUOT || reason == EFBIG))
    throw LibraryError(std::strerror(reason));
}

}  // namespace slipscale
