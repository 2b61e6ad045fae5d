#pragma once

#include <cstdint>
#include <string>

namespace slipscale {

/// The sentence for the user: what could not be written, the system's reason, the cure.
std::string write_fault(const std::string& path, const std::string& reason);

/// Sets room aside for bytes [from, from + bytes) of a file, or throws `LibraryError` with the system's words
/// ("No space left on device", or that the file is gone) and leaves the file as it was.
///
/// So it is known before HDF5 works on rows or a frame how much of them the disk takes. Where the file system
/// cannot reserve (ext2, NFS), the room behind the file's end is filled with zeros, which HDF5 overwrites;
/// otherwise the file's size does not change. `from` must not lie before data that count.
void reserve_space(const std::string& path, std::uint64_t from, std::uint64_t bytes);

/// Room set aside for a file that grows, further ahead than it grows at a time, as that takes the system
/// long.
class Reservation {
 public:
  /// As `reserve_space`.
  void reach(const std::string& path, std::uint64_t from, std::uint64_t bytes);

 private:
  std::uint64_t end_ = 0;
};

/// What `reserve_space` does where the system cannot: the file gets this size, of zeros that are on the disk.
void fill_with_zeros(const std::string& path, std::uint64_t size);

/// Gives back what was set aside behind the end of a file of this size.
void give_back_space(const std::string& path, std::uint64_t size);

/// Returns when the file and its name in its folder would outlast a power cut. Throws `LibraryError` with the
/// system's words.
void sync_file(const std::string& path);

}  // namespace slipscale
