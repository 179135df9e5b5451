#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace boxwood {

/// Memory in pages of 2 MiB where the system has them: arrays of many megabytes that are read here and there
/// then need few entries of the translation buffer, and few page faults while they are written first. New
/// elements are default-initialised (those of plain types not at all): the threads that fill them touch them
/// first.
template <class T>
struct LargePageAllocator {
    using value_type = T;
    static constexpr size_t kPage = size_t{2} << 20;

    LargePageAllocator() = default;
    template <class U>
    explicit(false) LargePageAllocator(const LargePageAllocator<U>&) {}

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
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) == 0) {
            ::new (static_cast<void*>(place)) U;
        } else {
            ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
        }
    }
    bool operator==(const LargePageAllocator&) const = default;

private:
    static std::align_val_t alignment(size_t size) {
        return std::align_val_t{size >= kPage ? kPage : std::max(alignof(T), size_t{64})};
    }
};

/// A vector for arrays of many megabytes.
template <class T>
using LargeArray = std::vector<T, LargePageAllocator<T>>;

}  // namespace boxwood
