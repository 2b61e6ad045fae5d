#pragma once

#include <cstddef>
#include <vector>

namespace slipscale {

/// Memory that starts on a large page of the system and asks for such pages, where there is enough of it to
/// fill one; else from the heap, on a line of the cache. A sweep through many arrays at once spends a quarter
/// of its time on finding pages of 4 KiB.
void* take_pages(std::size_t bytes);
void give_back_pages(void* memory, std::size_t bytes) noexcept;

/// Gives back to the system what the heap holds of memory that was freed: as much as a stage has worked with.
void give_back_freed();

template <class T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <class Other>
  LargePages(const LargePages<Other>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(take_pages(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) noexcept { give_back_pages(memory, count * sizeof(T)); }
  bool operator==(const LargePages&) const { return true; }
};

/// An array over the whole mesh that every step runs through.
template <class T>
using LargeArray = std::vector<T, LargePages<T>>;

}  // namespace slipscale
