// Compares wrong renderers (mistakes.h) with the goldens: each is found.

#include "tests/renders/judged_render.h"
#include "tests/renders/mistakes.h"

#include <gtest/gtest.h>

#include <iostream>
#include <ostream>
#include <string>
#include <vector>

namespace {

using namespace renders_test;

struct Mistake {
    const char* name;
    const char* scene;
    ref::Integrator integrator;
    std::vector<std::uint64_t> stages = {64, 256};
};

void PrintTo(const Mistake& mistake, std::ostream* out)
{
    *out << mistake.name;
}

class WrongPictures : public testing::TestWithParam<Mistake> {};

TEST_P(WrongPictures, AreFound)
{
    golden::CompareOptions options;
    options.stages = GetParam().stages;
    const auto judged = renders_test::judge_render(GetParam().scene, GetParam().integrator, "bdpt",
                                                   golden::Method::ranks, options);
    std::cout << describe(judged.comparison.verdict) << ": " << judged.comparison.reason << '\n';
    EXPECT_EQ(judged.comparison.verdict, golden::Verdict::fail);
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, WrongPictures,
    testing::Values(Mistake{"DimmedByTwoPercent", "all_emitters", altered<dim_by_two_percent>},
                    Mistake{"UniformWeights", "cornell_glass", altered<weigh_uniformly>, {32, 128}},
                    Mistake{"SplatsNotScaled", "all_emitters", altered<scale_splats>},
                    Mistake{"SplatsMisplaced", "all_emitters", altered<misplace_splats>},
                    Mistake{"NextEventDropped", "all_emitters", altered<drop_next_event>},
                    Mistake{"InnerConnectionDropped", "all_emitters", altered<drop_inner_connection>}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

} // namespace
