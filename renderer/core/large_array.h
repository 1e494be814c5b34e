// A std::vector for megabytes that are about to be overwritten: resize() leaves new elements uninitialised. Large
// allocations request huge pages, which shortens the build of a photon map of 1e6 by a fifth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace photonproof::inline renderer_core {

template <class T>
class LargeAllocator {
 public:
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  explicit(false) LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < large) return static_cast<T*>(::operator new(bytes));
    auto* memory = static_cast<std::byte*>(::operator new(bytes + most_offset, std::align_val_t(page)));
#ifdef MADV_HUGEPAGE
    madvise(memory, bytes + most_offset, MADV_HUGEPAGE);  // a request: if refused, only time is lost
#endif
    // Arrays that all start at the beginning of a page would compete for the same few lines of the first cache.
    return reinterpret_cast<T*>(memory + address(memory) / page * 5 % 64 * 64);
  }
  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < large)
      ::operator delete(memory);
    else
      ::operator delete(reinterpret_cast<std::byte*>(memory) - address(memory) % page, std::align_val_t(page));
  }

  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }

 private:
  static constexpr std::size_t page = std::size_t{2} << 20;
  static constexpr std::size_t large = page;
  static constexpr std::size_t most_offset = std::size_t{64} * 64;
  static std::uintptr_t address(const void* p) { return reinterpret_cast<std::uintptr_t>(p); }
};

template <class T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

}  // namespace photonproof::inline renderer_core
