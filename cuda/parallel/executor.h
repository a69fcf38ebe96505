#pragma once

// A kernel is a function object of one index. It carries its data as members (mostly spans), shares
// nothing with the kernel of another index except the data that those refer to, and never waits for
// another. So any order of the indices is a legal schedule, concurrent or one by one, and an executor
// is the choice of a schedule. Every executor is called as executor(count, kernel), for the indices 0
// to count - 1.

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

/// An object that runs kernels. Launches on one executor run one after the other.
template <class E>
concept Executor = requires(E& executor)
{
    executor(std::uint32_t{}, detail::AnyKernel{});
};

/// An executor on the host. `width()` is the number of parts into which it is useful to divide a task.
template <class E>
concept HostExecutor = Executor<E> && requires(const E& idle)
{
    {
        idle.width()
        } -> std::convertible_to<std::uint32_t>;
};

/// Runs the indices in order on the calling thread. An error that occurs here is not one of
/// concurrency.
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
