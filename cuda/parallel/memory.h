#pragma once

// Memory of the host or of a device, in which arrays are stored.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace fast {

/// Names the memory, the number of bytes requested and the number free. The exception changes nothing:
/// memory allocated before is still valid, and released memory can be allocated again.
class OutOfMemory : public std::runtime_error {
public:
    OutOfMemory(const std::string& memory, std::size_t wanted, std::size_t free);
};

/// Allocates blocks of bytes and copies bytes in and out of them, in the order of the calls.
class Memory {
public:
    Memory() = default;
    virtual ~Memory() = default;
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    /// At least `bytes` bytes, aligned for every type, contents undefined. Throws OutOfMemory.
    void* allocate(std::size_t bytes);
    /// Releases a block from `allocate`, once all work queued so far has finished with it.
    virtual void release(void* block) noexcept = 0;

    /// Copies from host memory into a block. `from` may be changed or freed after the call.
    virtual void write(void* to, const void* from, std::size_t bytes) = 0;
    /// Copies from a block into host memory; returns when the bytes are there.
    virtual void read(void* to, const void* from, std::size_t bytes) = 0;

private:
    /// Null if there is not enough memory.
    virtual void* try_allocate(std::size_t bytes) = 0;
    [[nodiscard]] virtual std::size_t free_bytes() const = 0;
    [[nodiscard]] virtual std::string name() const = 0;
};

/// The memory of the process.
class HostMemory : public Memory {
public:
    void release(void* block) noexcept override;
    void write(void* to, const void* from, std::size_t bytes) override;
    void read(void* to, const void* from, std::size_t bytes) override;

private:
    void* try_allocate(std::size_t bytes) override;
    [[nodiscard]] std::size_t free_bytes() const override;
    [[nodiscard]] std::string name() const override { return "host memory"; }
};

} // namespace fast
