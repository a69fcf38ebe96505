#pragma once

// Any executor by one type, so that kernels are compiled once for all of them.

#include "cuda/parallel/executor.h"

#include <functional>
#include <typeinfo>

namespace parallel_test {

class AnyExecutor {
public:
    /// Called with the type of every kernel and its number of indices, before it runs.
    using Watch = std::function<void(const std::type_info& kernel, std::uint32_t count)>;
    Watch watch;

    template <fast::Executor E>
    explicit AnyExecutor(E& executor)
        : run_([&executor](std::uint32_t count, const Kernel& kernel) { executor(count, kernel); })
    {}

    template <fast::Kernel K>
    void operator()(std::uint32_t count, const K& kernel) const
    {
        if (watch) watch(typeid(K), count);
        run_(count, [&](std::uint32_t index) { kernel(index); });
    }
    void wait() const {} // every launch is complete when it returns
    [[nodiscard]] static std::uint32_t width() { return 1; }

private:
    using Kernel = std::function<void(std::uint32_t)>;
    std::function<void(std::uint32_t, const Kernel&)> run_;
};

} // namespace parallel_test
