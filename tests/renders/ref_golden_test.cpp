// Compares the reference integrators with the goldens, by the procedure of golden/compare.h, with new
// random numbers in each run. For a picture that fails, a report is written, and the message names its
// file.
//
// Bidirectional path tracing made the goldens. As long as it makes four of their batches again, bit for
// bit, a comparison with new random numbers can only raise a false alarm, and is left out.
//
// The short version prints the error of the whole picture that it could have detected. PLUMBLINE_LONG=1
// compares always, and uses enough batches to detect half a percent.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "tests/renders/judged_render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;
using renders_test::golden_of;
using renders_test::JudgedRender;
using renders_test::scenes_with_goldens;
using renders_test::source;
using renders_test::with_report;

JudgedRender judge(const std::string& name, const char* estimator, ref::Integrator integrator,
                   golden::Method method,
                   const golden::CompareOptions& options = renders_test::short_options())
{
    JudgedRender judged = renders_test::judge_render(name, integrator, estimator, method, options);
    renders_test::print(name, estimator, judged);
    return judged;
}

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, BidirectionalPathTracingAgrees)
{
    if (!renders_test::is_long() &&
        renders_test::makes_it_again(GetParam(), ref::trace_bidirectionally, 4)) {
        std::cout << GetParam() << ", bdpt: four batches of the golden are the same, bit for bit.\n";
        return;
    }
    const JudgedRender judged =
        judge(GetParam(), "bdpt", ref::trace_bidirectionally, golden::Method::ranks);
    EXPECT_EQ(judged.comparison.verdict, golden::Verdict::pass)
        << with_report(GetParam(), "bdpt", judged);
}

/// The estimator differs from the golden's, so its batches have another distribution, and means are
/// compared. If its noise is too skewed for that, the comparison is inconclusive: neither failed nor
/// passed.
TEST_P(Golden, PathTracingDoesNotDisagree)
{
    if (GetParam() == "point_in_glass") {
        // No eye walk hits a point light, and no shadow ray refracts: path tracing cannot find this
        // light.
        const JudgedRender judged =
            judge(GetParam(), "path", ref::trace_path, golden::Method::welch, renders_test::one_stage());
        EXPECT_EQ(judged.comparison.verdict, golden::Verdict::fail);
        return;
    }
    const JudgedRender judged = judge(GetParam(), "path", ref::trace_path, golden::Method::welch);
    EXPECT_NE(judged.comparison.verdict, golden::Verdict::fail)
        << with_report(GetParam(), "path", judged);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::ValuesIn(scenes_with_goldens()),
                         [](const auto& scene) { return scene.param; });

TEST(Goldens, EverySceneHasOneOfItsPresentState)
{
    for (const auto& entry : fs::directory_iterator(source / "scenes")) {
        if (entry.path().extension() != ".dae") continue;
        const std::string name = entry.path().stem().string();
        ASSERT_TRUE(fs::exists(golden_of(name))) << name << ": make it with plumbline golden";
        EXPECT_EQ(golden::read_golden(golden_of(name)).metadata.at("scene_hash"),
                  scenes::read_scene(entry.path()).hash)
            << name << ": the scene has changed since";
    }
}

TEST(Goldens, LetAnErrorOfHalfAPercentBeSeen)
{
    // Almost no light passes the door, so the noise is large: on two cores this would take hours.
    const std::set<std::string> unaffordable = {"door_ajar"};
    for (const std::string& name : scenes_with_goldens()) {
        const auto detectable = golden::detectable_error(golden::read_golden(golden_of(name)),
                                                         golden::CompareOptions{}.stages.front());
        for (const double error : detectable) {
            if (std::isnan(error)) continue; // a channel that is black
            EXPECT_LE(error, unaffordable.contains(name) ? 0.05 : 0.005) << name;
        }
    }
}

TEST(Goldens, TogetherStayBelow40MiB)
{
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(source / "golden/renders"))
        bytes += entry.file_size();
    EXPECT_LE(bytes, 40u << 20);
}

} // namespace
