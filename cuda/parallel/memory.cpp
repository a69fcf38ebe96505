#include "cuda/parallel/memory.h"

#include <unistd.h>

#include <cstring>
#include <new>

namespace gpu {

namespace {

/// A cache line: no two blocks share one, and no node of a tree straddles two.
constexpr std::align_val_t alignment{64};

} // namespace

OutOfMemory::OutOfMemory(const std::string& memory, std::size_t wanted, std::size_t free)
    : std::runtime_error(memory + " is exhausted: " + std::to_string(wanted) + " bytes wanted, " +
                         std::to_string(free) + " bytes free")
{}

void* Memory::allocate(std::size_t bytes)
{
    void* const block = try_allocate(bytes);
    if (block == nullptr) throw OutOfMemory(name(), bytes, free_bytes());
    return block;
}

void* HostMemory::try_allocate(std::size_t bytes)
{
    return ::operator new(bytes, alignment, std::nothrow);
}

void HostMemory::release(void* block) noexcept
{
    ::operator delete(block, alignment);
}

void HostMemory::write(void* to, const void* from, std::size_t bytes)
{
    if (bytes > 0) std::memcpy(to, from, bytes);
}

void HostMemory::read(void* to, const void* from, std::size_t bytes)
{
    if (bytes > 0) std::memcpy(to, from, bytes);
}

std::size_t HostMemory::free_bytes() const
{
    return static_cast<std::size_t>(sysconf(_SC_AVPHYS_PAGES)) *
           static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

} // namespace gpu
