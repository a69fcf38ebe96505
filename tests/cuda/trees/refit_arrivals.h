#pragma once

// Wrong versions of `arrive` (cuda/parallel/atomic.h), which tests must be able to detect.

#include "cuda/parallel/atomic.h"

namespace fast_trees_test {

/// Atomic, but without order: the box that was written before may become visible later.
inline std::uint32_t arrive_relaxed(std::uint32_t& counter)
{
    return std::atomic_ref<std::uint32_t>(counter).fetch_add(1, std::memory_order_relaxed);
}

/// Ordered, but in two steps: both children may arrive as the first.
inline std::uint32_t arrive_torn(std::uint32_t& counter)
{
    const std::atomic_ref<std::uint32_t> shared(counter);
    const std::uint32_t before = shared.load(std::memory_order_acquire);
    if (fast::schedule_point != nullptr) fast::schedule_point();
    shared.store(before + 1, std::memory_order_release);
    return before;
}

} // namespace fast_trees_test
