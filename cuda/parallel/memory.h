#pragma once

// Where arrays live: in the memory of the host or of a device.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace fast {

/// Says which memory, how many bytes were wanted and how many are free. Nothing is lost by it: memory
/// held before is still held, and what is given back can be had again.
class OutOfMemory : public std::runtime_error {
public:
    OutOfMemory(const std::string& memory, std::size_t wanted, std::size_t free);
};

/// Gives out blocks of bytes and moves bytes in and out of them, in the order of the calls.
class Memory {
public:
    Memory() = default;
    virtual ~Memory() = default;
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    /// At least `bytes` bytes, aligned for every type, contents undefined. Throws OutOfMemory.
    void* allocate(std::size_t bytes);
    /// Gives back what `allocate` returned, once all work queued so far is done with it.
    virtual void release(void* block) noexcept = 0;

    /// From host memory into a block. `from` may be changed or freed when it returns.
    virtual void write(void* to, const void* from, std::size_t bytes) = 0;
    /// From a block into host memory; returns when the bytes are there.
    virtual void read(void* to, const void* from, std::size_t bytes) = 0;

private:
    /// Null if there is not so much.
    virtual void* try_allocate(std::size_t bytes) = 0;
    [[nodiscard]] virtual std::size_t free_bytes() const = 0;
    [[nodiscard]] virtual std::string name() const = 0;
};

/// That of the process.
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
