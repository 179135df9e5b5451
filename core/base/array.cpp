#include "core/base/array.h"

#include <tbb/scalable_allocator.h>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace boxwood {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

// Sanitizers watch what comes from operator new.
namespace {
constexpr std::align_val_t kAlignment{kLargePage};
void* allocate(size_t size) { return ::operator new(size, kAlignment); }
}  // namespace

void free_large(void* memory) { ::operator delete(memory, kAlignment); }
void release_kept_memory() {}

#else

namespace {

/// Nothing that is kept is given back before all there is exceeds kMostKept.
bool keep_all() {
    constexpr intptr_t kMostKept = intptr_t{2} << 30;
    scalable_allocation_mode(TBBMALLOC_SET_HUGE_SIZE_THRESHOLD, static_cast<intptr_t>(kLargePage));
    return scalable_allocation_mode(TBBMALLOC_SET_SOFT_HEAP_LIMIT, kMostKept) == TBBMALLOC_OK;
}

void* allocate(size_t size) {
    [[maybe_unused]] static const bool is_kept = keep_all();
    void* const memory = scalable_aligned_malloc(size, kLargePage);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

void free_large(void* memory) { scalable_aligned_free(memory); }
void release_kept_memory() { scalable_allocation_command(TBBMALLOC_CLEAN_ALL_BUFFERS, nullptr); }

#endif

void* allocate_large(size_t size) {
    void* const memory = allocate(size);
#ifdef __linux__
    // A refusal costs speed alone.
    static_cast<void>(madvise(memory, size / kLargePage * kLargePage, MADV_HUGEPAGE));
#endif
    return memory;
}

}  // namespace boxwood
