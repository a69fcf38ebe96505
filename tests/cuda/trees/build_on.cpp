#include "tests/cuda/trees/build_on.h"

#include "cuda/launch/device_lbvh.h"
#include "cuda/parallel/threaded_executor.h"
#include "cuda/trees/lbvh.h"
#include "tests/cuda/parallel/interleaved_executor.h"

#include <numeric>
#include <random>

namespace fast_trees_test {

namespace {

template <class Code, fast::Executor E>
Built build_with(E& executor, std::span<const fast::Aabb> boxes)
{
    fast::HostMemory memory;
    fast::Lbvh<Code> tree(memory, executor, static_cast<std::uint32_t>(boxes.size()));
    tree.build(executor, boxes);
    fast::throw_if_rejected(tree.first_rejected(), boxes);
    return copy_of(tree);
}

template <fast::Executor E>
Built build_with(E& executor, int code_bits, std::span<const fast::Aabb> boxes)
{
    return code_bits == 30 ? build_with<std::uint32_t>(executor, boxes)
                           : build_with<std::uint64_t>(executor, boxes);
}

Built build_on_device(int code_bits, std::span<const fast::Aabb> boxes)
{
    fast::DeviceLbvh tree(static_cast<std::uint32_t>(boxes.size()), code_bits);
    tree.build(boxes);
    fast::BuiltTree built = tree.download();
    return {std::move(built.nodes), std::move(built.leaf_links), std::move(built.primitives),
            std::move(built.codes)};
}

ref::Vec3 exactly(const fast::Vec3& v)
{
    return {v.x, v.y, v.z};
}

} // namespace

std::string name(const Setup& setup)
{
    constexpr std::array names = {"serial", "threads", "interleaved", "device"};
    return names[static_cast<std::size_t>(setup.on)] + std::to_string(setup.code_bits);
}

Built build_on(const Setup& setup, std::span<const fast::Aabb> boxes, std::uint64_t seed)
{
    switch (setup.on) {
    case On::serial: {
        fast::SerialExecutor executor;
        return build_with(executor, setup.code_bits, boxes);
    }
    case On::threads: { // three, so that most sizes are not divisible; blocks of one unless too slow
        fast::ThreadedExecutor executor(3, boxes.size() < 1000 ? 1 : 4096);
        return build_with(executor, setup.code_bits, boxes);
    }
    case On::interleaved: {
        std::mt19937_64 random(seed);
        parallel_test::InterleavedExecutor executor(
            8, [&](std::uint32_t ready) { return static_cast<std::uint32_t>(random() % ready); });
        return build_with(executor, setup.code_bits, boxes);
    }
    case On::device:
        break;
    }
    return build_on_device(setup.code_bits, boxes);
}

ref::Tree neutral(const Built& built, const fast::Aabb& root)
{
    ref::Tree tree;
    const std::size_t n = built.primitives.size();
    if (n == 0) return tree;
    tree.primitives = built.primitives;
    tree.leaf_begin.resize(n + 1);
    std::iota(tree.leaf_begin.begin(), tree.leaf_begin.end(), 0);
    tree.nodes.resize(2 * n - 1);
    tree.bounds.resize(2 * n - 1);
    tree.bounds[0] = exactly(root);
    if (n > 1) tree.bounds[0] = exactly(unite(built.nodes[0].bounds[0], built.nodes[0].bounds[1]));

    const auto set_parent = [&](std::size_t node, std::uint32_t link) {
        if (link == fast::no_node) return;
        tree.nodes[node].parent = link >> 1;
        tree.bounds[node] = exactly(built.nodes.at(link >> 1).bounds[link & 1]);
    };
    for (std::size_t i = 0; i + 1 < n; ++i) {
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t child = built.nodes[i].children[side];
            tree.nodes[i].children[side] =
                fast::is_leaf(child) ? static_cast<std::uint32_t>(n - 1) + (child & ~fast::leaf_bit)
                                     : child;
        }
        set_parent(i, built.nodes[i].link);
    }
    for (std::size_t leaf = 0; leaf < n; ++leaf) set_parent(n - 1 + leaf, built.leaf_links[leaf]);
    return tree;
}

ref::Aabb exactly(const fast::Aabb& box)
{
    return {exactly(box.lower), exactly(box.upper)};
}

std::vector<ref::Aabb> exactly(std::span<const fast::Aabb> boxes)
{
    std::vector<ref::Aabb> result;
    for (const fast::Aabb& box : boxes) result.push_back(exactly(box));
    return result;
}

std::vector<fast::Aabb> rounded(std::span<const ref::Aabb> boxes)
{
    std::vector<fast::Aabb> result;
    for (const ref::Aabb& box : boxes) result.push_back({fast::Vec3(box.lower), fast::Vec3(box.upper)});
    return result;
}

} // namespace fast_trees_test
