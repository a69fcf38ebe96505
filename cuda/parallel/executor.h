#pragma once

// A kernel is a function object of one index. It carries what it works on as members (spans, mostly),
// shares nothing with the kernel of another index but what those refer to, and never waits for another.
// So any order of the indices is a legal schedule, at once or one by one, and to execute a kernel is to
// choose a schedule. Every executor is called as executor(count, kernel), for the indices 0 to count
// - 1.

#include <concepts>
#include <cstdint>

namespace fast {

template <class K>
concept Kernel = std::copy_constructible<K> && requires(const K& kernel, std::uint32_t index)
{
    {
        kernel(index)
        } -> std::same_as<void>;
};

namespace detail {

struct AnyKernel {
    void operator()(std::uint32_t /*index*/) const {}
};

} // namespace detail

/// What runs kernels. Launches on one executor happen one after the other.
template <class E>
concept Executor = requires(E& executor)
{
    executor(std::uint32_t{}, detail::AnyKernel{});
};

/// On the host. `width()` is how many indices it is worth to divide a task into that could as well be
/// done by one.
template <class E>
concept HostExecutor = Executor<E> && requires(const E& idle)
{
    {
        idle.width()
        } -> std::convertible_to<std::uint32_t>;
};

/// Runs the indices in order on the calling thread. What goes wrong here is no matter of concurrency.
class SerialExecutor {
public:
    template <Kernel K>
    void operator()(std::uint32_t count, const K& kernel) const
    {
        for (std::uint32_t index = 0; index < count; ++index) kernel(index);
    }
    [[nodiscard]] static std::uint32_t width() { return 1; }
};

} // namespace fast
