#include "journaled_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

/// An open file, or none.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : number_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (number_ >= 0) (void)close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  bool opened() const { return number_ >= 0; }
  operator int() const { return number_; }

 private:
  int number_;
};

std::uint64_t size_of(int file) {
  struct stat status {};
  return fstat(file, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

}  // namespace

JournaledFile::JournaledFile(std::string path, int flags)
    : file_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {
  if (file_ < 0) throw LibraryError(std::strerror(errno));
  size_ = committed_ = reached_ = size_of(file_);
  if (size_ > 0) publish(path);
}

JournaledFile::~JournaledFile() {
  if (torn_) {
    (void)close(journal_);
  } else {
    forget_journal();
    if (changed_) (void)!ftruncate(file_, static_cast<off_t>(committed_));
  }
  (void)close(file_);
}

bool JournaledFile::read(std::uint64_t at, std::size_t size, void* bytes) const {
  auto* const to = static_cast<std::byte*>(bytes);
  if (!read_at(file_, at, size, to)) return false;
  auto extent = held_.upper_bound(at);
  if (extent != held_.begin()) --extent;
  for (; extent != held_.end() && extent->first < at + size; ++extent) {
    const auto& [begin, what] = *extent;
    const std::uint64_t from = std::max(at, begin), end = std::min(at + size, begin + what.size());
    if (from < end) std::memcpy(to + (from - at), what.data() + (from - begin), end - from);
  }
  return true;
}

void JournaledFile::write(std::uint64_t at, std::size_t size, const void* bytes, bool straight) {
  const auto* const from = static_cast<const std::byte*>(bytes);
  if (size == 0) return;
  size_ = std::max(size_, at + size);
  if (straight && !holds_part_of(at, size)) return put(at, size, from);
  const std::size_t below = at < committed_ ? std::min<std::uint64_t>(size, committed_ - at) : 0;
  if (below > 0) hold(at, below, from);
  if (below < size) put(at + below, size - below, from + below);
}

/// To the disk, or into memory where there is none any more.
void JournaledFile::put(std::uint64_t at, std::size_t size, const std::byte* bytes) {
  changed_ = true;
  reached_ = std::max(reached_, at + size);
  if (!lost_ && write_at(file_, at, size, bytes)) return;
  fail();
  hold(at, size, bytes);
}

void JournaledFile::fail() {
  if (!lost_) *failure_ = std::strerror(errno);
  lost_ = true;
}

bool JournaledFile::holds_part_of(std::uint64_t at, std::size_t size) const {
  const auto next = held_.lower_bound(at + size);
  if (next == held_.begin()) return false;
  const auto& [begin, what] = *std::prev(next);
  return begin + what.size() > at;
}

/// Keeps the bytes, in place of older ones.
void JournaledFile::hold(std::uint64_t at, std::size_t size, const std::byte* bytes) {
  std::uint64_t begin = at, end = at + size;
  auto first = held_.lower_bound(at), last = held_.lower_bound(end);
  if (first != held_.begin())
    if (const auto before = std::prev(first); before->first + before->second.size() > at) first = before;
  if (first == last) {
    held_.emplace_hint(first, at, std::vector<std::byte>(bytes, bytes + size));
    return;
  }
  begin = std::min(begin, first->first);
  end = std::max(end, std::prev(last)->first + std::prev(last)->second.size());
  if (first->first != begin || first->second.size() != end - begin) {
    std::vector<std::byte> all(end - begin);
    for (auto extent = first; extent != last; ++extent)
      std::ranges::copy(extent->second, all.begin() + static_cast<std::ptrdiff_t>(extent->first - begin));
    held_.erase(first, last);
    first = held_.emplace(begin, std::move(all)).first;
  }
  std::copy_n(bytes, size, first->second.begin() + static_cast<std::ptrdiff_t>(at - begin));
}

/// The committed state must not end behind the end of the file.
bool JournaledFile::grow(std::uint64_t end) const {
  return size_of(file_) >= end || ftruncate(file_, static_cast<off_t>(end)) == 0;
}

void JournaledFile::commit(std::uint64_t end) {
  if (lost_) return;
  if (!grow(end)) return fail();
  changed_ = true;
  if (!held_.empty() && !change(Journal(held_, std::max(end, committed_)))) {
    torn_ = true;
    return fail();
  }
  held_.clear();
  if (end < reached_) (void)!ftruncate(file_, static_cast<off_t>(end));
  size_ = committed_ = reached_ = end;
}

/// Without a journal, where there is no room for one say, a kill in this moment may leave the file torn.
bool JournaledFile::change(const Journal& changes) {
  open_journal();
  const bool kept = journal_ >= 0 && changes.save(journal_);
  if (!kept) forget_journal();
  if (!changes.apply(file_)) return false;
  if (kept) Journal::strike(journal_);
  return true;
}

void JournaledFile::open_journal() {
  if (journal_ >= 0 || journal_path_.empty()) return;
  journal_ = open(journal_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (journal_ >= 0) (void)flock(journal_, LOCK_EX | LOCK_NB);  // tells that somebody is at work
}

void JournaledFile::forget_journal() {
  if (journal_ < 0) return;
  (void)unlink(journal_path_.c_str());
  (void)close(journal_);
  journal_ = -1;
}

void JournaledFile::publish(const std::string& path) { journal_path_ = Journal::path(path); }

void JournaledFile::recover(const std::string& path, bool to_write) {
  const std::string from = Journal::path(path);
  const Descriptor journal(from, O_RDWR);
  if (!journal.opened()) return;
  if (flock(journal, LOCK_EX | (to_write ? 0 : LOCK_NB)) != 0 && !to_write) return;
  const Descriptor file(path, O_WRONLY);
  const std::optional<Journal> changes = Journal::read(journal);
  const bool of_this = changes && file.opened() && size_of(file) >= changes->size();
  if (of_this ? changes->apply(file) : to_write) (void)unlink(from.c_str());
}

}  // namespace slipscale
