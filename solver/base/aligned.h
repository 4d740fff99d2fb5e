#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace seapile::base {

/// Allocates on cache lines, which are also the widest vector registers. Large arrays begin on a large page and ask for
/// such pages: 100,000 grains fill more small ones than the processor knows by heart.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::size_t kLine = 64, kPage = std::size_t{1} << 21;

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t count) {
    void* memory = ::operator new(count * sizeof(T), alignment(count));
    if (count * sizeof(T) >= kPage) madvise(memory, count * sizeof(T), MADV_HUGEPAGE);  // a wish: nothing depends on it
    return static_cast<T*>(memory);
  }
  void deallocate(T* p, std::size_t count) { ::operator delete(p, alignment(count)); }
  friend bool operator==(CacheLineAllocator, CacheLineAllocator) { return true; }

 private:
  static std::align_val_t alignment(std::size_t count) {
    return std::align_val_t{count * sizeof(T) >= kPage ? kPage : kLine};
  }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace seapile::base
