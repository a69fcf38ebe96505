// Buffers, and their behaviour when there is not enough memory.

#include "cuda/parallel/buffer.h"
#include "cuda/trees/lbvh.h"
#include "tests/cuda/trees/build_on.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace {

using fast::Buffer;

/// A memory of a fixed number of bytes that tracks its allocated blocks.
class SmallMemory : public fast::Memory {
public:
    explicit SmallMemory(std::size_t bytes) : free(bytes) {}
    void release(void* block) noexcept override
    {
        const auto entry = held_.find(block);
        if (entry == held_.end()) std::abort(); // released twice, or never allocated
        free += entry->second;
        held_.erase(entry);
        host_.release(block);
    }
    void write(void* to, const void* from, std::size_t bytes) override { host_.write(to, from, bytes); }
    void read(void* to, const void* from, std::size_t bytes) override { host_.read(to, from, bytes); }
    [[nodiscard]] std::size_t blocks() const { return held_.size(); }

    std::size_t free; // bytes

private:
    void* try_allocate(std::size_t bytes) override
    {
        if (bytes > free) return nullptr;
        void* const block = host_.allocate(bytes);
        free -= bytes;
        held_[block] = bytes;
        return block;
    }
    [[nodiscard]] std::size_t free_bytes() const override { return free; }
    [[nodiscard]] std::string name() const override { return "a small memory"; }

    fast::HostMemory host_;
    std::map<void*, std::size_t> held_;
};

TEST(Buffer, GivesItsMemoryBackOnceAndOnlyOnce)
{
    SmallMemory memory(1000);
    {
        Buffer<float> a(memory, 100);
        EXPECT_EQ(memory.free, 600u);
        Buffer<float> b = std::move(a);
        EXPECT_EQ(b.size(), 100u);
        EXPECT_EQ(a.size(), 0u); // NOLINT: moved from, and empty
        Buffer<float> c(memory, 10);
        c = std::move(b);
        EXPECT_EQ(c.size(), 100u);
        const Buffer<float> none(memory, 0);
        EXPECT_TRUE(none.all().empty());
    }
    EXPECT_EQ(memory.free, 1000u);
    EXPECT_EQ(memory.blocks(), 0u);
}

TEST(Buffer, KeepsWhatIsWritten)
{
    fast::HostMemory memory;
    const std::vector<int> numbers = {3, 1, 4, 1, 5};
    Buffer<int> buffer(memory, numbers);
    EXPECT_EQ(buffer.read(5), numbers);
    buffer.write(std::vector{9, 2});
    EXPECT_EQ(buffer.read(3), (std::vector{9, 2, 4}));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.all().data()) % 64, 0u);
}

TEST(OutOfMemory, NamesTheMemoryTheBytesWantedAndTheBytesFree)
{
    SmallMemory memory(1000);
    const Buffer<char> held(memory, 300);
    try {
        const Buffer<float> too_much(memory, 200);
        FAIL() << "800 bytes out of 700";
    } catch (const fast::OutOfMemory& error) {
        EXPECT_STREQ(error.what(), "a small memory is exhausted: 800 bytes wanted, 700 bytes free");
    }
    EXPECT_EQ(memory.blocks(), 1u);
}

TEST(OutOfMemory, WhereverItHappensATreeGivesEverythingBackAndTheNextOneIsBuilt)
{
    trees_test::Random random(1);
    const auto boxes =
        fast_trees_test::rounded(trees_test::boxes(trees_test::Kind::uniform, 100, random));
    fast::SerialExecutor executor;
    SmallMemory memory(1 << 20);
    std::size_t needed = 0;
    {
        const fast::Lbvh<std::uint32_t> tree(memory, executor, 100);
        needed = (1 << 20) - memory.free;
    }
    // Every number of bytes that is a little too small for one of the buffers.
    int failures = 0;
    for (std::size_t bytes = 0; bytes < needed; bytes += 100) {
        memory.free = bytes;
        EXPECT_THROW(fast::Lbvh<std::uint32_t>(memory, executor, 100), fast::OutOfMemory) << bytes;
        EXPECT_EQ(memory.free, bytes);
        EXPECT_EQ(memory.blocks(), 0u);
        ++failures;
    }
    EXPECT_GT(failures, 50);

    memory.free = needed;
    fast::Lbvh<std::uint32_t> tree(memory, executor, 100);
    EXPECT_EQ(memory.free, 0u); // no memory is left for a build to allocate
    tree.build(executor, boxes);
    EXPECT_EQ(tree.first_rejected(), fast::no_primitive);
}

TEST(Lbvh, RefusesMoreBoxesThanItHasRoomFor)
{
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    fast::Lbvh<std::uint32_t> tree(memory, executor, 3);
    const std::vector<fast::Aabb> boxes(4, fast::Aabb{fast::Vec3(0), fast::Vec3(1)});
    EXPECT_THROW(tree.build(executor, boxes), std::length_error);
    EXPECT_THROW(fast::Lbvh<std::uint32_t>(memory, executor, fast::most_primitives + 1),
                 std::invalid_argument);
}

} // namespace
