// Where scenes::longest_path states a bound, no longer path carries light.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "scenes/longest_path.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

namespace {

TEST(LongestPathOfScenes, NoLongerOneCarriesLight)
{
    int bounded = 0;
    for (const std::string& name : transport_test::our_scene_names()) {
        const scenes::Scene scene = transport_test::our_scene(name);
        const auto bound = longest_path(scene);
        if (!bound) continue;
        ++bounded;
        const ref::World world(scene, 8, 8);
        const ref::PathOptions options{.seed = 1, .max_edges = 8};
        std::vector<ref::Contribution> all;
        for (const ref::Integrator integrator : {ref::trace_path, ref::trace_bidirectionally})
            for (std::uint32_t pixel = 0; pixel < 64; ++pixel)
                for (std::uint32_t sample = 0; sample < 64; ++sample)
                    integrator(world, options, {1, pixel, sample}, all);
        bool reached = false;
        for (const ref::Contribution& one : all) {
            if (one.value == ref::Rgb(0.0)) continue;
            EXPECT_LE(edges(one), *bound) << name;
            reached = reached || edges(one) == *bound;
        }
        EXPECT_TRUE(reached) << name; // the bound is no larger than needed
    }
    EXPECT_GE(bounded, 5);
}

} // namespace
