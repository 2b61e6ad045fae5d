#include "slipscale/base/large_array.hpp"

#include <cstdint>
#include <new>

#if defined(__linux__)
#include <malloc.h>
#include <sys/mman.h>
#endif

namespace slipscale {
namespace {

constexpr std::align_val_t line{64};  // of the cache

}  // namespace

#if defined(__linux__)
namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;

std::size_t whole_pages(std::size_t bytes) {
  constexpr std::size_t page = 4096;
  return (bytes + page - 1) / page * page;
}

}  // namespace

void* take_pages(std::size_t bytes) {
  if (bytes < large_page) return ::operator new(bytes, line);
  const std::size_t size = whole_pages(bytes);
  void* const all =
      mmap(nullptr, size + large_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED) throw std::bad_alloc();
  auto* const memory = static_cast<char*>(all);
  const std::size_t before = (large_page - reinterpret_cast<std::uintptr_t>(all) % large_page) % large_page;
  if (before > 0) (void)munmap(memory, before);
  if (before < large_page) (void)munmap(memory + before + size, large_page - before);
  (void)madvise(memory + before, size, MADV_HUGEPAGE);  // a system may have none
  return memory + before;
}

void give_back_pages(void* memory, std::size_t bytes) noexcept {
  if (bytes < large_page)
    ::operator delete(memory, line);
  else
    (void)munmap(memory, whole_pages(bytes));
}

#else

void* take_pages(std::size_t bytes) { return ::operator new(bytes, line); }
void give_back_pages(void* memory, std::size_t) noexcept { ::operator delete(memory, line); }

#endif

void give_back_freed() {
#if defined(__GLIBC__)
  (void)malloc_trim(0);
#endif
}

}  // namespace slipscale
