#include "core/base/array.h"

#include <tbb/scalable_allocator.h>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace boxwood {

namespace {

size_t alignment_of(size_t size) { return size < kLargePage ? kCacheLine : kLargePage; }

}  // namespace

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

// Sanitizers watch what comes from operator new.
namespace {
void* allocate(size_t size) { return ::operator new (size, std::align_val_t{alignment_of(size)}); }
}  // namespace

void free_kept(void* memory, size_t size) {
    ::operator delete (memory, std::align_val_t{alignment_of(size)});
}
void release_kept_memory() {}

#else

namespace {

/// What is kept is given back when all there is exceeds this: a quarter of the machine's memory.
intptr_t most_kept() {
#ifdef __linux__
    return static_cast<intptr_t>(sysconf(_SC_PHYS_PAGES)) / 4 * sysconf(_SC_PAGESIZE);
#else
    return intptr_t{2} << 30;
#endif
}
bool keep_all() {
    scalable_allocation_mode(TBBMALLOC_SET_HUGE_SIZE_THRESHOLD, static_cast<intptr_t>(kLargePage));
    return scalable_allocation_mode(TBBMALLOC_SET_SOFT_HEAP_LIMIT, most_kept()) == TBBMALLOC_OK;
}

void* allocate(size_t size) {
    [[maybe_unused]] static const bool is_kept = keep_all();
    void* const memory = scalable_aligned_malloc(size, alignment_of(size));
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

void free_kept(void* memory, size_t /*size*/) { scalable_aligned_free(memory); }
void release_kept_memory() { scalable_allocation_command(TBBMALLOC_CLEAN_ALL_BUFFERS, nullptr); }

#endif

void* allocate_kept(size_t size) {
    void* const memory = allocate(size);
#ifdef __linux__
    // A refusal costs speed alone.
    if (size >= kLargePage) static_cast<void>(madvise(memory, size / kLargePage * kLargePage, MADV_HUGEPAGE));
#endif
    return memory;
}

}  // namespace boxwood
