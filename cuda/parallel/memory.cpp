#include "cuda/parallel/memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <limits>

namespace fast {

namespace {

/// A cache line: no two blocks share one, and no node of a tree extends over two.
constexpr std::size_t cache_line = 64;

/// Large blocks use pages of this size instead of 4096 bytes: rays access a tree in no regular order,
/// and the processor caches the addresses of only a few pages.
constexpr std::size_t large_page = std::size_t{1} << 21;

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
    const std::size_t unit = bytes < large_page ? cache_line : large_page;
    if (bytes > std::numeric_limits<std::size_t>::max() - unit) return nullptr;
    const std::size_t whole = (bytes + unit - 1) / unit * unit;
    void* const block = std::aligned_alloc(unit, whole);
    if (block != nullptr && unit == large_page) madvise(block, whole, MADV_HUGEPAGE); // may fail
    return block;
}

void HostMemory::release(void* block) noexcept
{
    std::free(block);
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

} // namespace fast
