#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace boxwood {

/// Memory for arrays of many megabytes. New elements are left as the memory was: they are first touched by
/// the threads that write them, and nothing is written twice; for plain data alone, every element of which is
/// written before it is read. From 2 MiB on in pages of that size where the system has them: arrays that are
/// read here and there then need few entries of the translation buffer, and writing them few page faults.
template <class T>
struct ArrayAllocator {
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);
    using value_type = T;
    static constexpr size_t kPage = size_t{2} << 20;

    ArrayAllocator() = default;
    template <class U>
    explicit(false) ArrayAllocator(const ArrayAllocator<U>&) {}

    T* allocate(size_t count) {
        const size_t size = count * sizeof(T);
        void* const memory = ::operator new(size, alignment(size));
#ifdef __linux__
        // A refusal costs speed alone.
        if (size >= kPage) static_cast<void>(madvise(memory, size / kPage * kPage, MADV_HUGEPAGE));
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, size_t count) { ::operator delete(memory, alignment(count * sizeof(T))); }
    template <class U>
    void construct(U*) {}
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        std::construct_at(place, std::forward<Arguments>(arguments)...);
    }
    bool operator==(const ArrayAllocator&) const = default;

private:
    static std::align_val_t alignment(size_t size) {
        return std::align_val_t{size >= kPage ? kPage : std::max(alignof(T), size_t{64})};
    }
};

/// A vector whose resize() leaves new elements unset (see ArrayAllocator).
template <class T>
using Array = std::vector<T, ArrayAllocator<T>>;

}  // namespace boxwood
