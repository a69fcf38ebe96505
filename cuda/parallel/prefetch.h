#pragma once

// Reading from memory ahead of time.

#include "cuda/parallel/host_device.h"

namespace fast {

/// Begins to load an element that will be read later; meanwhile a processor does other work. A GPU has
/// other threads for that time, so there it does nothing.
template <class T>
HD void prefetch([[maybe_unused]] const T& element)
{
#if !defined(__CUDA_ARCH__)
    static_assert(sizeof(T) <= 64); // a cache line, so at most two are loaded
    const char* const bytes = reinterpret_cast<const char*>(&element);
    __builtin_prefetch(bytes);
    __builtin_prefetch(bytes + sizeof(T) - 1);
#endif
}

/// The same for an element in one cache line that will be written.
template <class T>
HD void prefetch_to_write([[maybe_unused]] T& element)
{
#if !defined(__CUDA_ARCH__)
    static_assert(sizeof(T) <= alignof(T)); // so it lies in one line
    __builtin_prefetch(&element, 1);
#endif
}

} // namespace fast
