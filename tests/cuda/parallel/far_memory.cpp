#include "tests/cuda/parallel/far_memory.h"

#include <sys/mman.h>

#include <cstring>
#include <stdexcept>

namespace parallel_test {

namespace {

/// A multiple of the size of a page.
constexpr std::size_t whole_pages(std::size_t bytes)
{
    constexpr std::size_t page = 0x10000;
    return (bytes + page - 1) / page * page;
}

void protect(void* begin, std::size_t bytes, int access)
{
    if (mprotect(begin, bytes, access) != 0) throw std::runtime_error("mprotect failed");
}

} // namespace

FarMemory::FarMemory(std::size_t bytes)
    : bytes_(whole_pages(bytes)),
      begin_(mmap(nullptr, bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0))
{
    if (begin_ == MAP_FAILED) throw std::runtime_error("mmap failed");
}

FarMemory::~FarMemory()
{
    munmap(begin_, bytes_);
}

void FarMemory::release(void* /*block*/) noexcept {}

void FarMemory::write(void* to, const void* from, std::size_t bytes)
{
    if (bytes > 0) accessed_by([&] { std::memcpy(to, from, bytes); }); // else a pointer may be null
}

void FarMemory::read(void* to, const void* from, std::size_t bytes)
{
    if (bytes > 0) accessed_by([&] { std::memcpy(to, from, bytes); }); // else a pointer may be null
}

void FarMemory::accessed_by(const std::function<void()>& function)
{
    const std::size_t pages = whole_pages(used_);
    protect(begin_, pages, PROT_READ | PROT_WRITE);
    function();
    protect(begin_, pages, PROT_NONE);
}

void* FarMemory::try_allocate(std::size_t bytes)
{
    const std::size_t rounded = (bytes + 255) / 256 * 256;
    if (rounded > free_bytes()) return nullptr;
    void* const block = static_cast<std::byte*>(begin_) + used_;
    used_ += rounded;
    accessed_by([&] { std::memset(block, 0x5a, bytes); }); // no element is 0 by accident
    return block;
}

} // namespace parallel_test
