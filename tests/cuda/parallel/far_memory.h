#pragma once

// Memory that only kernels and copies may access, like that of a GPU. Any other access of the host ends
// the program, by the protection of the pages.

#include "cuda/parallel/memory.h"

#include <cstdint>
#include <functional>

namespace parallel_test {

class FarMemory : public fast::Memory {
public:
    /// For `bytes` bytes in all. What is released is not used again.
    explicit FarMemory(std::size_t bytes);
    ~FarMemory() override;

    void release(void* block) noexcept override;
    void write(void* to, const void* from, std::size_t bytes) override;
    void read(void* to, const void* from, std::size_t bytes) override;

    /// Calls `function` while the memory can be accessed.
    void accessed_by(const std::function<void()>& function);

private:
    void* try_allocate(std::size_t bytes) override;
    [[nodiscard]] std::size_t free_bytes() const override { return bytes_ - used_; }
    [[nodiscard]] std::string name() const override { return "far memory"; }

    std::size_t bytes_;
    std::size_t used_ = 0;
    void* begin_;
};

/// Runs kernels of `executor` on this memory.
template <class E>
class FarExecutor {
public:
    FarExecutor(FarMemory& memory, E& executor) : memory_(memory), executor_(executor) {}

    template <class K>
    void operator()(std::uint32_t count, const K& kernel)
    {
        memory_.accessed_by([&] { executor_(count, kernel); });
    }
    void wait() const {}

private:
    FarMemory& memory_;
    E& executor_;
};

} // namespace parallel_test
