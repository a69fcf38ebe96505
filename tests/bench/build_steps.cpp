#include "tests/bench/build_steps.h"

#include "ref/trees/bvh.h"
#include "ref/trees/radix_sort.h"
#include "ref/trees/radix_tree.h"
#include "ref/trees/refit.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <numeric>

namespace bench {

std::vector<Step> lbvh_steps(const std::vector<ref::Aabb>& boxes)
{
    constexpr int bits_per_axis = 10;
    const auto codes =
        std::make_shared<const std::vector<std::uint64_t>>(ref::morton_codes(boxes, bits_per_axis));
    const auto tree = std::make_shared<const ref::Tree>(ref::build(boxes, ref::Builder::morton30));
    const auto sorted = std::make_shared<std::vector<std::uint64_t>>(); // in the order of the tree
    for (const std::uint32_t primitive : tree->primitives) sorted->push_back((*codes)[primitive]);

    return {{"codes",
             [=, &boxes] { benchmark::DoNotOptimize(ref::morton_codes(boxes, bits_per_axis).data()); }},
            {"sort",
             [=] {
                 std::vector<std::uint64_t> keys = *codes;
                 std::vector<std::uint32_t> primitives(keys.size());
                 std::iota(primitives.begin(), primitives.end(), 0);
                 ref::radix_sort(keys, primitives, 3 * bits_per_axis);
                 benchmark::DoNotOptimize(primitives.data());
             }},
            {"ranges", [=] { benchmark::DoNotOptimize(ref::radix_tree(*sorted).data()); }},
            {"refit",
             [&boxes, unboxed = *tree]() mutable {
                 unboxed.bounds = std::vector<ref::Aabb>();
                 ref::refit(unboxed, boxes);
                 benchmark::DoNotOptimize(unboxed.bounds.data());
             }},
            {"first touch",
             [=] { benchmark::DoNotOptimize(std::vector<ref::Aabb>(tree->nodes.size()).data()); }}};
}

} // namespace bench
