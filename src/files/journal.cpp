#include "journal.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace slipscale {
namespace {

constexpr std::array<char, 16> mark{"slipscale log 1"};
constexpr std::uint64_t largest_journal = std::uint64_t{1} << 33;  ///< bytes; a larger one is none of ours

}  // namespace

struct Journal::Header {
  std::array<char, 16> mark{};
  std::uint64_t places = 0, bytes = 0, size = 0, checksum = 0;
};

struct Journal::Place {
  std::uint64_t at = 0, length = 0;
};

bool read_at(int file, std::uint64_t at, std::size_t size, std::byte* to) {
  while (size > 0) {
    const ssize_t count = pread(file, to, size, static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    if (count == 0) {
      std::memset(to, 0, size);
      return true;
    }
    at += static_cast<std::uint64_t>(count);
    to += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool write_at(int file, std::uint64_t at, std::size_t size, const std::byte* from) {
  while (size > 0) {
    const ssize_t count = pwrite(file, from, size, static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = ENOSPC;
    if (count <= 0) return false;
    at += static_cast<std::uint64_t>(count);
    from += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

Journal::Journal(const Extents& changes, std::uint64_t size) {
  std::vector<Place> places;
  std::size_t bytes = 0;
  for (const auto& [at, what] : changes) {
    if (!places.empty() && places.back().at + places.back().length == at)
      places.back().length += what.size();
    else
      places.push_back({at, what.size()});
    bytes += what.size();
  }
  Header header{mark, places.size(), bytes, size, 0};
  const std::size_t table = places.size() * sizeof(Place);
  bytes_.resize(sizeof header + table + bytes);
  if (table > 0) std::memcpy(bytes_.data() + sizeof header, places.data(), table);
  std::byte* to = bytes_.data() + sizeof header + table;
  for (const auto& [at, what] : changes) {
    std::memcpy(to, what.data(), what.size());
    to += what.size();
  }
  std::memcpy(bytes_.data(), &header, sizeof header);
  header.checksum = checksum();
  std::memcpy(bytes_.data(), &header, sizeof header);
}

std::optional<Journal> Journal::read(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0) return std::nullopt;
  const auto length = static_cast<std::uint64_t>(status.st_size);
  if (length < sizeof(Header) || length > largest_journal) return std::nullopt;
  Journal journal{std::vector<std::byte>(length)};
  if (!read_at(file, 0, length, journal.bytes_.data()) || !journal.cut() || !journal.whole())
    return std::nullopt;
  return journal;
}

std::string Journal::path(const std::string& of) { return of + ".journal"; }

bool Journal::save(int file) const { return write_at(file, 0, bytes_.size(), bytes_.data()); }

void Journal::strike(int file) {
  const std::array<std::byte, sizeof mark> nothing{};
  if (!write_at(file, 0, sizeof nothing, nothing.data())) (void)!ftruncate(file, 0);
}

bool Journal::apply(int file) const {
  const Header head = header();
  const std::byte* from = bytes_.data() + sizeof head + head.places * sizeof(Place);
  for (std::size_t k = 0; k < head.places; ++k) {
    Place place;
    std::memcpy(&place, bytes_.data() + sizeof head + k * sizeof place, sizeof place);
    if (!write_at(file, place.at, place.length, from)) return false;
    from += place.length;
  }
  return true;
}

std::uint64_t Journal::size() const { return header().size; }

Journal::Header Journal::header() const {
  Header found;
  std::memcpy(&found, bytes_.data(), sizeof found);
  return found;
}

/// FNV-1a of all but the checksum, eight bytes at a time.
std::uint64_t Journal::checksum() const {
  const Header head = header();
  std::uint64_t sum = 14695981039346656037u, word = 0;
  for (const std::uint64_t part : {head.places, head.bytes, head.size}) sum = (sum ^ part) * 1099511628211u;
  for (std::size_t k = sizeof(Header); k < bytes_.size(); k += sizeof word) {
    word = 0;
    std::memcpy(&word, bytes_.data() + k, std::min(sizeof word, bytes_.size() - k));
    sum = (sum ^ word) * 1099511628211u;
  }
  return sum;
}

/// Leaves out what an earlier, longer one has left in the file behind it; false where something is missing.
bool Journal::cut() {
  const Header head = header();
  const std::uint64_t rest = bytes_.size() - sizeof head;
  if (head.places > rest / sizeof(Place) || head.bytes > rest - head.places * sizeof(Place)) return false;
  bytes_.resize(sizeof head + head.places * sizeof(Place) + head.bytes);
  return true;
}

/// Whether it is one, as it was saved, and every change lies in the file.
bool Journal::whole() const {
  const Header head = header();
  if (head.mark != mark || head.checksum != checksum()) return false;
  std::uint64_t bytes = 0;
  for (std::size_t k = 0; k < head.places; ++k) {
    Place place;
    std::memcpy(&place, bytes_.data() + sizeof head + k * sizeof place, sizeof place);
    if (place.length > head.bytes - bytes || place.at > head.size || place.length > head.size - place.at)
      return false;
    bytes += place.length;
  }
  return bytes == head.bytes;
}

}  // namespace slipscale
