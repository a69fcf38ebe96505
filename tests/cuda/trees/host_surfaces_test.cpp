// Trees of surfaces built by the threads of the host, with every set of instructions.

#include "cuda/launch/host_kernels.h"
#include "tests/cuda/trees/narrow_trees.h"
#include "tests/cuda/trees/same_trees.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using fast::HostMemory;
using fast::HostThreads;
using fast::SurfaceTree;
using fast_trees_test::Narrow;

RC_GTEST_PROP(SurfacesOnHostThreads, AreTheSameWithAllInstructionsAndBuilders, ())
{
    trees_test::Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto triangles = Narrow(*rc::gen::inRange<std::size_t>(0, 400), random).triangles;
    HostMemory memory;
    fast::SerialExecutor serial;
    HostThreads threads(2, 1);
    for (const fast::TreeBuilder builder : fast::tree_builders) {
        const SurfaceTree expected(memory, serial, triangles, {}, builder);
        const fast::WideTreeView tree = expected.view<false>().tree;
        for (const fast::InstructionSet set : fast::instruction_sets()) {
            threads.instructions = set;
            const SurfaceTree built = surface_tree(memory, threads, triangles, {}, builder);
            RC_ASSERT(fast_trees_test::same_nodes(built.view<false>().tree.nodes, tree.nodes));
            RC_ASSERT(fast_trees_test::same_groups(built.view<false>().tree.groups, tree.groups));
            RC_ASSERT(built.builder() == expected.builder());
            RC_ASSERT(built.diagonal() == expected.diagonal());
        }
    }
}

TEST(SurfacesOnHostThreads, NameTheFirstPrimitiveThatIsNotLegalWithAllInstructions)
{
    trees_test::Random random(1);
    std::vector<fast::Triangle> triangles = Narrow(40, random).triangles;
    triangles[7].vertices[1].y = std::numeric_limits<float>::quiet_NaN();
    HostMemory memory;
    HostThreads threads(2, 1);
    for (const fast::InstructionSet set : fast::instruction_sets()) {
        threads.instructions = set;
        try {
            (void)surface_tree(memory, threads, triangles, {}, fast::default_tree_builder);
            ADD_FAILURE() << "no error with " << name_of(set);
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string(error.what()).find("primitive 7"), std::string::npos) << error.what();
        }
    }
}

} // namespace
