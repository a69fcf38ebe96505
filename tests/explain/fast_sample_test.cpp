// What FastScene::sample says of a sample is what the fast path adds to the picture, bit for bit; and
// where rounding does not decide, its walks are those of the reference.

#include "cuda/launch/renderer.h"
#include "cuda/transport/exact_sum.h"
#include "explain/fast_sample.h"
#include "scenes/placed.h"
#include "tests/ref/transport/random_scene.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>

namespace {

using explain::FastSample;
using explain::FastVertex;
using explain::Step;

/// The sum of what the explanations of all pixels say, added up as cuda/launch/batch_renderer.h does
/// with --deterministic.
images::Image picture_of_fast_samples(const explain::FastScene& scene, int width, int height,
                                      images::Integrator integrator, const ref::PathOptions& options,
                                      std::uint32_t number)
{
    images::Image own(width, height);
    std::vector<std::array<fast::ExactSum, 3>> splats(own.pixels.size());
    for (std::uint32_t pixel = 0; pixel < own.pixels.size(); ++pixel) {
        const FastSample sample = scene.sample(integrator, options, {options.seed, pixel, number});
        own.pixels[pixel] = images::Rgb(sample.own);
        for (const explain::FastContribution& made : sample.made)
            for (int channel = 0; channel < 3 && made.t == 1 && !made.is_dropped(); ++channel)
                splats[made.pixel][static_cast<std::size_t>(channel)].add(made.contribution()[channel]);
    }
    for (std::size_t i = 0; i < own.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            own.pixels[i][channel] += splats[i][static_cast<std::size_t>(channel)].value();
    return own;
}

RC_GTEST_PROP(ExplainFastSample, IsWhatTheFastPathAddsToThePicture, ())
{
    const scenes::Scene scene = scenes::placed(transport_test::any_scene());
    images::RenderOptions options{.integrator = *rc::gen::element(images::Integrator::path,
                                                                  images::Integrator::bdpt,
                                                                  images::Integrator::light),
                                  .seed = *transport_test::any_word(),
                                  .batch_size = 1,
                                  .deterministic = true};
    options.max_edges = static_cast<int>(transport_test::any_number(1.0, 12.0));
    options.roulette = transport_test::any_chance(0.7);
    options.heuristic = *rc::gen::element(images::Heuristic::balance, images::Heuristic::power);
    const auto number = static_cast<std::uint32_t>(transport_test::any_number(0.0, 1e6));

    const auto batch = fast::host_renderer(scene, 5, 3, options, 1)->render_batch(number);
    const images::Image picture =
        picture_of_fast_samples(explain::FastScene(scene, 5, 3, options.roulette), 5, 3,
                                options.integrator, ref::path_options(options), number);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        RC_ASSERT(picture.pixels[i] == batch->mean.pixels[i]);
}

/// How far both walks may have drifted apart for their next steps to be compared, in units of the scene,
/// the diagonal of which is between 1 and 2.
constexpr double near = 1e-5;
/// How far a ray is turned to see whether rounding may decide what it meets: more than `near` turns it
/// over a distance of 0.1, and more than a step of single precision does, except near the critical
/// angle (tests/cuda/path_judge/path_rounding.h: direction_error, refraction_error).
constexpr double turned = 1e-4;

/// The step of the reference from z_j or y_j, if rounding cannot change where it leads: neither the
/// choice of the lobe and roulette, nor the primitive that the ray meets. False if it may.
bool is_certain(const ref::World& world, const explain::Sample& sample, const Step& step,
                const ref::Uniforms& u, const std::optional<std::uint32_t>& next)
{
    if (!step.bounce || !step.bounce->survives || step.vertex.kind != ref::Vertex::Kind::surface)
        return false;
    const explain::Bounce& bounce = *step.bounce;
    const double lobe = bounce.sample.pdf_fwd;
    const bool delta = bounce.sample.delta;
    if (delta && lobe < 1.0 && (std::abs(u[2] - lobe) < turned || std::abs(u[2] - 1 + lobe) < turned))
        return false;
    if (sample.options.roulette && std::abs(u[3] - bounce.survival) < turned) return false;
    if (std::abs(glm::dot(step.vertex.point.normal, bounce.wi)) < 0.05) return false;
    for (int i = 0; i < 6; ++i) {
        ref::Vec3 turn(0.0);
        turn[i / 2] = i % 2 == 0 ? turned : -turned;
        const ref::Vec3 wi = glm::normalize(bounce.wi + turn);
        const ref::Vec3& n = step.vertex.point.normal;
        const ref::Vec3 moved = near / turned * (turn - glm::dot(turn, n) * n); // on the surface
        const auto hit = intersect(world.geometry, {leave_surface(step.vertex.point, wi) + moved, wi});
        if (hit ? std::optional(hit->primitive) != next : next.has_value()) return false;
    }
    return true;
}

/// Both vertices and the distance between them are such that the densities differ by less than 2%: both
/// cosines are above 0.1 and the distance is above 0.05. A direction then differs by less than
/// 2 near / 0.05 = 4e-4, and a normal by 1e-4 at most: a cosine by 5e-3 of itself. The densities per
/// area have two of them and the square of the distance, which differs by 8e-4.
bool is_moderate(const Step& last, const Step& step, const FastVertex& fast)
{
    const ref::Vec3 w = direction(last.vertex, step.vertex);
    return last.vertex.kind != ref::Vertex::Kind::infinity && cosine(last.vertex, w) > 0.1 &&
           cosine(step.vertex, w) > 0.1 &&
           glm::length(step.vertex.point.position - last.vertex.point.position) > 0.05 &&
           glm::length(step.vertex.point.normal - fast.normal) < 1e-4;
}

struct Compared {
    int steps = 0, ends = 0, densities = 0;
};

void expect_same_densities(const Step& step, const FastVertex& fast, Compared& compared)
{
    for (const auto& [a, b] : {std::pair(step.pdf_solid_angle, fast.pdf_solid_angle),
                               std::pair(step.pdf_area, fast.pdf_area)}) {
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        EXPECT_NEAR(*b, *a, 0.02 * *a);
        ++compared.densities;
    }
}

/// Follows both walks while they are together and rounding does not decide the next step.
void compare_walks(const ref::World& world, const explain::Sample& sample, const explain::Walk& walk,
                   const std::vector<FastVertex>& fast, ref::Event event, Compared& compared)
{
    for (std::size_t j = 1; j < walk.steps.size() && j < fast.size(); ++j) {
        const Step& step = walk.steps[j];
        if (step.vertex.kind != ref::Vertex::Kind::surface ||
            fast[j].kind != ref::Vertex::Kind::surface ||
            fast[j].primitive != step.vertex.point.primitive)
            return;
        if (glm::length(fast[j].position - step.vertex.point.position) > near) return;
        if (is_moderate(walk.steps[j - 1], step, fast[j]))
            expect_same_densities(step, fast[j], compared);
        const ref::Uniforms u = uniforms(sample.id, event, static_cast<std::uint32_t>(j));
        const bool goes_on = j + 1 < walk.steps.size();
        const bool to_surface = goes_on && walk.steps[j + 1].vertex.kind == ref::Vertex::Kind::surface;
        std::optional<std::uint32_t> next;
        if (to_surface) next = walk.steps[j + 1].vertex.point.primitive;
        if (!is_certain(world, sample, step, u, next)) return;
        ASSERT_EQ(fast.size() > j + 1, goes_on) << "after vertex " << j;
        ++(to_surface ? compared.steps : compared.ends);
        if (!to_surface) return;
        ASSERT_EQ(fast[j + 1].kind, ref::Vertex::Kind::surface);
        ASSERT_EQ(fast[j + 1].primitive, *next) << "after vertex " << j;
    }
}

TEST(ExplainFastSample, VisitsThePrimitivesOfTheReferenceWhereRoundingDoesNotDecide)
{
    Compared compared;
    for (const std::string& name : transport_test::our_scene_names()) {
        SCOPED_TRACE(name);
        const scenes::Scene scene = scenes::placed(transport_test::our_scene(name));
        const ref::World world(scene, 24, 16);
        const explain::FastScene fast(scene, 24, 16, true);
        for (std::uint32_t i = 0; i < 60; ++i) {
            const ref::PathOptions options{.seed = 9, .max_edges = 12};
            const ref::SampleId id{9, (37 * i + 11) % (24 * 16), i};
            const auto bdpt = images::Integrator::bdpt;
            const explain::Sample sample = explain::explain_sample(world, bdpt, options, id);
            const FastSample one = fast.sample(bdpt, options, id);
            compare_walks(world, sample, sample.eye, one.eye, ref::Event::eye_bounce, compared);
            compare_walks(world, sample, sample.light, one.light, ref::Event::light_bounce, compared);
        }
    }
    EXPECT_GT(compared.steps, 1000);
    EXPECT_GT(compared.ends, 100);
    EXPECT_GT(compared.densities, 1000);
}

} // namespace
