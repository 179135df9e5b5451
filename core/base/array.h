#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace boxwood {

/// Leaves new elements as the memory was: they are first touched by the threads that write them, and nothing
/// is written twice. For plain data alone, every element of which is written before it is read.
template <class T>
struct Uninitialized : std::allocator<T> {
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);

    template <class U>
    struct rebind {
        using other = Uninitialized<U>;
    };
    Uninitialized() = default;
    template <class U>
    Uninitialized(const Uninitialized<U>&) {}

    template <class U>
    void construct(U*) {}
    template <class U, class... Args>
    void construct(U* place, Args&&... args) {
        std::construct_at(place, std::forward<Args>(args)...);
    }
};

/// A vector whose resize() leaves new elements unset (see Uninitialized).
template <class T>
using Array = std::vector<T, Uninitialized<T>>;

}  // namespace boxwood
