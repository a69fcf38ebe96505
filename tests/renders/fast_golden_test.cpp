// Compares the fast path with the goldens, which the reference made: every scene, by every integrator
// and executor.

#include "cuda/launch/renderer.h"
#include "scenes/requirements.h"
#include "tests/cuda/parallel/on_device.h"
#include "tests/renders/judged_render.h"

#include <gtest/gtest.h>

#include <optional>

namespace {

using renders_test::JudgedRender;
using renders_test::Plan;
using renders_test::RenderBatch;

enum class Where { one_thread, two_threads, two_threads_deterministic, device };

std::unique_ptr<fast::Renderer> fast_renderer(const Plan& plan, fast::Integrator integrator, Where where,
                                              std::uint64_t seed)
{
    images::RenderOptions options;
    options.integrator = integrator;
    options.seed = seed;
    options.max_edges = plan.max_edges;
    options.batch_size = plan.batch_size;
    options.deterministic = where == Where::two_threads_deterministic;
    if (where == Where::device)
        return fast::device_renderer(plan.scene, plan.width, plan.height, options);
    return fast::host_renderer(plan.scene, plan.width, plan.height, options,
                               where == Where::one_thread ? 1 : 2);
}

JudgedRender judge(const std::string& name, fast::Integrator integrator, Where where,
                   golden::Method method,
                   const golden::CompareOptions& options = renders_test::short_options())
{
    const auto make = [&](const Plan& plan) -> RenderBatch {
        std::shared_ptr<fast::Renderer> renderer;
        std::optional<std::uint64_t> made_for;
        return [=](std::uint64_t seed, std::uint64_t number) mutable {
            if (made_for != seed) renderer = fast_renderer(plan, integrator, where, seed);
            made_for = seed;
            return renderer->render_batch(number, {})->mean;
        };
    };
    const std::string estimator = integrator == fast::Integrator::bdpt   ? "bdpt"
                                  : integrator == fast::Integrator::path ? "path"
                                                                         : "light";
    JudgedRender judged = renders_test::judge_render(name, std::function<RenderBatch(const Plan&)>(make),
                                                     estimator, method, options);
    renders_test::print(name, "fast " + estimator, judged);
    return judged;
}

void expect_bdpt_agrees(const std::string& name, Where where)
{
    const JudgedRender judged = judge(name, fast::Integrator::bdpt, where, golden::Method::ranks);
    EXPECT_EQ(judged.comparison.verdict, golden::Verdict::pass)
        << renders_test::with_report(name, "fast_bdpt", judged);
}

/// The estimator differs from the golden's. If its noise is too skewed, the comparison is inconclusive.
void expect_path_does_not_disagree(const std::string& name, Where where)
{
    if (name == "point_in_glass") {
        // No eye walk hits a point light, and no shadow ray refracts: path tracing cannot find this
        // light.
        const JudgedRender judged =
            judge(name, fast::Integrator::path, where, golden::Method::welch, renders_test::one_stage());
        EXPECT_EQ(judged.comparison.verdict, golden::Verdict::fail);
        return;
    }
    const JudgedRender judged = judge(name, fast::Integrator::path, where, golden::Method::welch);
    EXPECT_NE(judged.comparison.verdict, golden::Verdict::fail)
        << renders_test::with_report(name, "fast_path", judged);
}

void expect_light_does_not_disagree(const std::string& name, Where where)
{
    const auto needs = scenes::requirements(scenes::read_scene(renders_test::scene_of(name)));
    if (needs.bsdfs.contains(scenes::Bsdf::mirror) || needs.bsdfs.contains(scenes::Bsdf::glass))
        GTEST_SKIP()
            << "light tracing cannot find light that the camera sees by way of mirrors or glass";
    const JudgedRender judged = judge(name, fast::Integrator::light, where, golden::Method::welch);
    EXPECT_NE(judged.comparison.verdict, golden::Verdict::fail)
        << renders_test::with_report(name, "fast_light", judged);
}

class FastGolden : public testing::TestWithParam<std::string> {};

TEST_P(FastGolden, BidirectionalPathTracingAgrees)
{
    expect_bdpt_agrees(GetParam(), Where::two_threads);
}

TEST_P(FastGolden, PathTracingDoesNotDisagree)
{
    expect_path_does_not_disagree(GetParam(), Where::one_thread);
}

TEST_P(FastGolden, LightTracingDoesNotDisagree)
{
    expect_light_does_not_disagree(GetParam(), Where::two_threads_deterministic);
}

TEST_P(FastGolden, OnADeviceAllAgree)
{
    parallel_test::skip_without_device();
    if (testing::Test::IsSkipped() || testing::Test::HasFailure()) return;
    expect_bdpt_agrees(GetParam(), Where::device);
    expect_path_does_not_disagree(GetParam(), Where::device);
    expect_light_does_not_disagree(GetParam(), Where::device);
}

INSTANTIATE_TEST_SUITE_P(Scenes, FastGolden, testing::ValuesIn(renders_test::scenes_with_goldens()),
                         [](const auto& scene) { return scene.param; });

} // namespace
