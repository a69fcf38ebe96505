#pragma once

// Atomic operations, named by their purpose. This is the only place where device and host code differ.

#include "cuda/parallel/host_device.h"

#include <atomic>
#include <cstdint>

#if defined(__CUDACC__)
#include <cuda/atomic>
#endif

namespace fast {

/// Host only: a function that a thread calls before each of its atomic operations, or null. Tests use
/// it to decide there which thread goes on.
using SchedulePoint = void (*)();
extern constinit thread_local SchedulePoint schedule_point;

/// Adds one to `counter` and returns its previous value: the first thread to arrive gets 0, the second
/// 1.
///
/// Acquire and release in one operation. Everything that the first of two threads wrote before it
/// arrived is visible to the second after the second has arrived: the second's read of the counter
/// reads the value that the first wrote (read-modify-write operations on one variable have a single
/// total order), so the first's release synchronises with the second's acquire [C++20, intro.races;
/// PTX ISA, memory consistency model]. If either half is missing, the second thread may read data
/// before they are written.
HD inline std::uint32_t arrive(std::uint32_t& counter)
{
#if defined(__CUDA_ARCH__)
    return cuda::atomic_ref<std::uint32_t, cuda::thread_scope_device>(counter).fetch_add(
        1, cuda::memory_order_acq_rel);
#else
    if (schedule_point != nullptr) schedule_point();
    return std::atomic_ref<std::uint32_t>(counter).fetch_add(1, std::memory_order_acq_rel);
#endif
}

/// Adds `count` to `counter` and returns its previous value, without ordering any other access: every
/// thread gets numbers of its own, the one returned and those that follow it.
HD inline std::uint32_t next_numbers(std::uint32_t& counter, std::uint32_t count)
{
#if defined(__CUDA_ARCH__)
    return atomicAdd(&counter, count);
#else
    if (schedule_point != nullptr) schedule_point();
    return std::atomic_ref<std::uint32_t>(counter).fetch_add(count, std::memory_order_relaxed);
#endif
}

/// One such number.
HD inline std::uint32_t next_number(std::uint32_t& counter)
{
    return next_numbers(counter, 1);
}

/// Adds `term` to `sum`, without ordering any other access. Sums of floats depend on the order of
/// their terms, so concurrent additions may differ from run to run in the last bits.
HD inline void add(float& sum, float term)
{
#if defined(__CUDA_ARCH__)
    atomicAdd(&sum, term);
#else
    if (schedule_point != nullptr) schedule_point();
    std::atomic_ref<float>(sum).fetch_add(term, std::memory_order_relaxed);
#endif
}

/// The same for whole numbers, whose sums do not depend on the order.
HD inline void add(std::uint64_t& sum, std::uint64_t term)
{
#if defined(__CUDA_ARCH__)
    cuda::atomic_ref<std::uint64_t, cuda::thread_scope_device>(sum).fetch_add(
        term, cuda::memory_order_relaxed);
#else
    if (schedule_point != nullptr) schedule_point();
    std::atomic_ref<std::uint64_t>(sum).fetch_add(term, std::memory_order_relaxed);
#endif
}

/// Replaces `least` by `value` if that is smaller, without ordering any other access.
HD inline void take_least(std::uint64_t& least, std::uint64_t value)
{
#if defined(__CUDA_ARCH__)
    cuda::atomic_ref<std::uint64_t, cuda::thread_scope_device>(least).fetch_min(
        value, cuda::memory_order_relaxed);
#else
    if (schedule_point != nullptr) schedule_point();
    const std::atomic_ref<std::uint64_t> shared(least);
    std::uint64_t known = shared.load(std::memory_order_relaxed);
    while (value < known && !shared.compare_exchange_weak(known, value, std::memory_order_relaxed))
        continue;
#endif
}

} // namespace fast
