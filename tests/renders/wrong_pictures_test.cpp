// Compares wrong renderers (mistakes.h) with the goldens: each is found, by the statistics of the short
// version and because it does not make the golden's batches again.

#include "tests/renders/judged_render.h"
#include "tests/renders/mistakes.h"

#include <gtest/gtest.h>

#include <iostream>
#include <ostream>
#include <string>

namespace {

using namespace renders_test;

struct Mistake {
    const char* name;
    const char* scene;
    ref::Integrator integrator;
};

void PrintTo(const Mistake& mistake, std::ostream* out)
{
    *out << mistake.name;
}

class WrongPictures : public testing::TestWithParam<Mistake> {};

TEST_P(WrongPictures, AreFound)
{
    const auto judged = judge_render(GetParam().scene, GetParam().integrator, "bdpt",
                                     golden::Method::ranks, short_options());
    std::cout << describe(judged.comparison.verdict) << ": " << judged.comparison.reason << '\n';
    EXPECT_EQ(judged.comparison.verdict, golden::Verdict::fail);
    EXPECT_FALSE(makes_it_again(GetParam().scene, GetParam().integrator, 1));
}

/// No statistics see these, at any number of samples that a test can afford.
TEST(SmallMistakes, ChangeTheBatchesOfAGolden)
{
    EXPECT_TRUE(makes_it_again("all_emitters", altered<change_nothing>, 1));
    EXPECT_FALSE(makes_it_again("all_emitters", altered<dim_by_a_thousandth>, 1));
    EXPECT_FALSE(makes_it_again("all_emitters", altered<dim_one_pixel>, 1));
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, WrongPictures,
    testing::Values(Mistake{"DimmedByTwoPercent", "all_emitters", altered<dim_by_two_percent>},
                    Mistake{"UniformWeights", "cornell_glass", altered<weigh_uniformly>},
                    Mistake{"SplatsNotScaled", "all_emitters", altered<scale_splats>},
                    Mistake{"SplatsMisplaced", "all_emitters", altered<misplace_splats>},
                    Mistake{"NextEventDropped", "all_emitters", altered<drop_next_event>},
                    Mistake{"InnerConnectionDropped", "all_emitters", altered<drop_inner_connection>}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

} // namespace
