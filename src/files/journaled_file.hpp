#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "journal.hpp"

namespace slipscale {

/// A file that goes from one whole state to the next, wherever its process is killed.
///
/// What is written behind the end of the last committed state goes straight to the disk: nothing refers to it
/// yet. What would change the committed state waits in memory; `commit` writes it as a journal, a file beside
/// this one, then into the file, and removes the journal. A journal that a killed process leaves is made good
/// by `recover`; one that is not whole tells that the file was not touched yet.
///
/// This is against the end of a process, not against that of the machine: nothing is synced.
///
/// A write that fails is kept in `failure`, not reported: from then on everything stays in memory, and the
/// file as it was committed last. So HDF5, which does not survive a write that fails, never sees one.
class JournaledFile {
 public:
  /// `flags` of open(2). Throws `LibraryError` with the system's words.
  JournaledFile(std::string path, int flags);
  /// Cuts off what lies behind the last committed state.
  ~JournaledFile();
  JournaledFile(const JournaledFile&) = delete;
  JournaledFile& operator=(const JournaledFile&) = delete;

  /// What was written last; zeros behind the end. False when the system cannot.
  bool read(std::uint64_t at, std::size_t size, void* bytes) const;
  /// `straight`: to the disk at once, wherever it lies.
  void write(std::uint64_t at, std::size_t size, const void* bytes, bool straight = false);
  /// Makes what was written the state of the file, which ends there.
  void commit(std::uint64_t end);
  /// Nothing more gets to the disk.
  void abandon() { lost_ = true; }

  /// Of a file whose process was killed while it committed: makes good what a journal tells. `to_write`: for
  /// a process that owns the file now; any other leaves a file that somebody is at work on, or that it may
  /// not write, as it is.
  static void recover(const std::string& path, bool to_write);
  /// The file has this name now; until it has one, it commits without journal.
  void publish(const std::string& path);

  std::uint64_t size() const { return size_; }         ///< as the writer sees it
  void set_size(std::uint64_t size) { size_ = size; }  ///< as the next commit leaves it
  bool waiting() const { return !held_.empty(); }      ///< whether something is not committed
  /// The system's words, empty while all is well; outlives the file, whose last write may be the one.
  std::shared_ptr<const std::string> failure() const { return failure_; }
  int descriptor() const { return file_; }

 private:
  void put(std::uint64_t at, std::size_t size, const std::byte* bytes);
  void hold(std::uint64_t at, std::size_t size, const std::byte* bytes);
  bool holds_part_of(std::uint64_t at, std::size_t size) const;
  bool grow(std::uint64_t end) const;
  bool change(const Journal& changes);
  void fail();

  void open_journal();
  void forget_journal();

  std::string journal_path_;  ///< empty while nobody knows the file
  int journal_ = -1;          ///< open from the first commit that needs it
  std::shared_ptr<std::string> failure_ = std::make_shared<std::string>();
  int file_ = -1;
  bool lost_ = false, changed_ = false;
  bool torn_ = false;                                     ///< and the journal needed
  std::uint64_t size_ = 0, committed_ = 0, reached_ = 0;  ///< ends: as seen, of the state, of what was put
  Extents held_;
};

}  // namespace slipscale
