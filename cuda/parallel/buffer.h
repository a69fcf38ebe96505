#pragma once

// An array in the memory of the host or of a device.

#include "cuda/parallel/memory.h"

#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace fast {

/// Owns `size()` elements, undefined until they are written. The memory must outlive the buffer.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    /// Throws OutOfMemory.
    Buffer(Memory& memory, std::size_t size)
        : memory_(&memory),
          data_(size == 0 ? nullptr : static_cast<T*>(memory.allocate(size * sizeof(T)))), size_(size)
    {}
    Buffer(Memory& memory, std::span<const T> contents) : Buffer(memory, contents.size())
    {
        write(contents);
    }
    ~Buffer()
    {
        if (data_ != nullptr) memory_->release(data_);
    }
    Buffer(Buffer&& other) noexcept
        : memory_(other.memory_), data_(std::exchange(other.data_, nullptr)),
          size_(std::exchange(other.size_, 0))
    {}
    Buffer& operator=(Buffer&& other) noexcept
    {
        std::swap(memory_, other.memory_);
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    [[nodiscard]] std::size_t size() const { return size_; }
    /// All elements, for kernels of the executor that the memory belongs to.
    [[nodiscard]] std::span<T> all() { return {data_, size_}; }
    [[nodiscard]] std::span<const T> all() const { return {data_, size_}; }
    /// The first `count` elements.
    [[nodiscard]] std::span<T> first(std::size_t count) { return all().first(count); }
    [[nodiscard]] std::span<const T> first(std::size_t count) const { return all().first(count); }

    /// Writes `contents` to the first contents.size() elements.
    void write(std::span<const T> contents)
    {
        memory_->write(first(contents.size()).data(), contents.data(), contents.size_bytes());
    }
    /// Copies the first `count` elements to the host.
    [[nodiscard]] std::vector<T> read(std::size_t count) const { return read(0, count); }
    /// Copies `count` elements from number `begin` on to the host.
    [[nodiscard]] std::vector<T> read(std::size_t begin, std::size_t count) const
    {
        std::vector<T> contents(count);
        if (count > 0)
            memory_->read(contents.data(), all().subspan(begin, count).data(), count * sizeof(T));
        return contents;
    }

private:
    Memory* memory_;
    T* data_;
    std::size_t size_;
};

} // namespace fast
