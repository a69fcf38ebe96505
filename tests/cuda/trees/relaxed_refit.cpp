// Refits a tree of ten leaves on threads, many times. `relaxed_refit right` arrives correctly;
// `relaxed_refit relaxed` arrives without the order that makes boxes visible. ThreadSanitizer must
// accept the first and report the second (thread_sanitizer_test.cpp). The exit status is 0 if
// ThreadSanitizer reports nothing.

#include "cuda/parallel/threaded_executor.h"
#include "cuda/trees/lbvh.h"
#include "tests/cuda/trees/refit_arrivals.h"

#include <cstdio>
#include <string_view>
#include <vector>

namespace {

template <std::uint32_t (*arrive_at)(std::uint32_t&)>
void refit_often()
{
    constexpr std::uint32_t n = 10;
    std::vector<fast::Aabb> boxes;
    for (std::uint32_t i = 0; i < n; ++i)
        boxes.push_back({fast::Vec3(static_cast<float>(i)), fast::Vec3(static_cast<float>(i + 1))});
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    fast::ThreadedExecutor threaded(4, 1);
    fast::Lbvh<std::uint32_t> tree(memory, serial, n);
    tree.build(serial, boxes);
    for (int i = 0; i < 100; ++i)
        threaded(
            n, fast::RefitBounds<arrive_at>{boxes, tree.primitives(), tree.leaf_links(), tree.nodes()});
}

} // namespace

int main(int argc, char** argv)
{
    const std::string_view how = argc == 2 ? argv[1] : "";
    if (how == "right") {
        refit_often<fast::arrive>();
    } else if (how == "relaxed") {
        refit_often<fast_trees_test::arrive_relaxed>();
    } else {
        std::fputs("usage: relaxed_refit right|relaxed\n", stderr);
        return 2;
    }
    return 0;
}
