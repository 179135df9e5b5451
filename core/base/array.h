#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace boxwood {

constexpr size_t kCacheLine = 64, kLargePage = size_t{2} << 20;

/// Aligned to a line of the cache; kLargePage bytes or more to that, in pages of that size where the system
/// has them. What was freed is kept for a while: a build that is repeated, as by a slider, has its memory at
/// once, where the system would have to clear it again. Throws std::bad_alloc.
void* allocate_kept(size_t size);
void free_kept(void* memory, size_t size);
/// Gives what was freed and is still kept back to the system.
void release_kept_memory();

/// Memory for arrays that may be large. New elements are left as the memory was: they are first touched by
/// the threads that write them, and nothing is written twice; for plain data alone, every element of which is
/// written before it is read. Large ones in large pages (see allocate_kept): arrays that are read here and
/// there then need few entries of the translation buffer, and writing them few page faults.
template <class T>
struct ArrayAllocator {
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);
    static_assert(alignof(T) <= kCacheLine);
    using value_type = T;

    ArrayAllocator() = default;
    template <class U>
    explicit(false) ArrayAllocator(const ArrayAllocator<U>&) {}

    T* allocate(size_t count) { return static_cast<T*>(allocate_kept(count * sizeof(T))); }
    void deallocate(T* memory, size_t count) { free_kept(memory, count * sizeof(T)); }
    template <class U>
    void construct(U*) {}
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        std::construct_at(place, std::forward<Arguments>(arguments)...);
    }
    bool operator==(const ArrayAllocator&) const = default;
};

/// A vector whose resize() leaves new elements unset (see ArrayAllocator).
template <class T>
using Array = std::vector<T, ArrayAllocator<T>>;

}  // namespace boxwood
