#include "tests/support/failing_heap.h"

#include <cstdlib>
#include <new>

namespace {

thread_local bool t_is_limited = false, t_has_failed = false;
thread_local std::size_t t_left = 0;

bool is_out_of_memory() noexcept {
    if (!t_is_limited) return false;
    if (t_left > 0) {
        --t_left;
        return false;
    }
    return t_has_failed = true;
}

void* allocated(std::size_t bytes) noexcept {
    return is_out_of_memory() ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
}
void* allocated(std::size_t bytes, std::align_val_t alignment) noexcept {
    const auto a = static_cast<std::size_t>(alignment);
    return is_out_of_memory() ? nullptr : std::aligned_alloc(a, (bytes + a - 1) / a * a);
}

void* checked(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

namespace burin::test {

FailingHeap::FailingHeap(std::size_t good) {
    t_left = good;
    t_has_failed = false;
    t_is_limited = true;
}
FailingHeap::~FailingHeap() { t_is_limited = false; }
bool FailingHeap::has_failed() const { return t_has_failed; }

}  // namespace burin::test

// The other forms of new and delete call these.
void* operator new(std::size_t bytes) { return checked(allocated(bytes)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) { return checked(allocated(bytes, alignment)); }
// A sanitizer's library has these of its own, which would never fail.
void* operator new[](std::size_t bytes) { return checked(allocated(bytes)); }
void* operator new[](std::size_t bytes, std::align_val_t alignment) { return checked(allocated(bytes, alignment)); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocated(bytes); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return allocated(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
