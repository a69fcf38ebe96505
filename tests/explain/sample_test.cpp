// What explain_sample says of a sample is what the renderer adds to the picture, bit for bit.

#include "explain/sample.h"
#include "images/families.h"
#include "ref/transport/renderer.h"
#include "tests/ref/transport/random_scene.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

namespace {

using explain::Sample;
using explain::Strategy;
using images::Integrator;

constexpr Integrator every_integrator[] = {Integrator::path, Integrator::bdpt, Integrator::light};

/// The contributions of the sample, in order.
std::vector<ref::Contribution> made_by(const Sample& sample)
{
    std::vector<ref::Contribution> made;
    for (const Strategy& strategy : sample.strategies)
        if (strategy.made) made.push_back(*strategy.made);
    return made;
}

bool same_bits(const ref::Contribution& a, const ref::Contribution& b)
{
    return a.pixel == b.pixel && a.s == b.s && a.t == b.t && a.value == b.value && a.weight == b.weight;
}

/// The sum of what the explanations of all pixels say, added up as ref/transport/batch.cpp does.
images::Image picture_of_samples(const ref::World& world, const images::RenderOptions& options,
                                 const ref::PathOptions& path, std::uint32_t number)
{
    images::Image own(world.camera.width(), world.camera.height());
    images::Image splats(world.camera.width(), world.camera.height());
    for (std::uint32_t pixel = 0; pixel < own.pixels.size(); ++pixel) {
        const Sample sample =
            explain::explain_sample(world, options.integrator, path, {path.seed, pixel, number});
        own.pixels[pixel] = sample.own;
        for (const Strategy& strategy : sample.strategies)
            if (strategy.made && strategy.t == 1)
                splats.pixels[strategy.made->pixel] += strategy.contribution();
    }
    for (std::size_t i = 0; i < own.pixels.size(); ++i) own.pixels[i] += splats.pixels[i];
    return own;
}

/// Equal in every bit that is written to a file, and logs both if not.
bool same_numbers(const ref::Rgb& a, const ref::Rgb& b)
{
    const bool same = a == b;
    if (!same)
        RC_LOG() << std::hexfloat << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y
                 << ' ' << b.z << '\n';
    return same;
}

/// Some families of those that the integrator has, at least one.
images::Families any_families(Integrator integrator)
{
    const images::Families has = images::families_of(integrator);
    images::Families families;
    if (integrator == Integrator::light) return families;
    families.emission_hit = transport_test::any_chance(0.7);
    families.inner_connection = !has.inner_connection || transport_test::any_chance(0.7);
    families.light_image = !has.light_image || transport_test::any_chance(0.7);
    return families;
}

RC_GTEST_PROP(ExplainSample, IsWhatTheRendererAddsToThePicture, ())
{
    const scenes::Scene scene = transport_test::any_scene();
    const ref::World world(scene, 5, 3);
    images::RenderOptions options{
        .integrator = *rc::gen::element(Integrator::path, Integrator::bdpt, Integrator::light),
        .seed = *transport_test::any_word(),
        .batch_size = 1};
    if (transport_test::any_chance(0.5))
        options.max_edges = static_cast<int>(transport_test::any_number(1.0, 9.0));
    options.roulette_from = static_cast<int>(transport_test::any_number(1.0, 7.0));
    options.roulette = options.max_edges == images::unlimited_edges || transport_test::any_chance(0.7);
    options.heuristic = *rc::gen::element(images::Heuristic::balance, images::Heuristic::power,
                                          images::Heuristic::uniform);
    options.families = any_families(options.integrator);
    const ref::PathOptions path{options.seed,          options.max_edges, options.roulette,
                                options.roulette_from, options.heuristic, options.families};
    RC_LOG() << "integrator " << static_cast<int>(options.integrator) << ", heuristic "
             << static_cast<int>(options.heuristic) << ", at most " << options.max_edges << " edges\n";
    const auto number = static_cast<std::uint32_t>(transport_test::any_number(0.0, 1e6));

    const auto batch =
        ref::renderer(world, ref::integrator_of(options.integrator), options)->render_batch(number);
    const images::Image picture = picture_of_samples(world, options, path, number);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        RC_ASSERT(same_numbers(picture.pixels[i], batch->mean.pixels[i]));
}

TEST(ExplainSample, HasTheContributionsOfTheIntegratorInEveryScene)
{
    std::map<Integrator, std::size_t> counted;
    for (const std::string& name : transport_test::our_scene_names()) {
        const scenes::Scene scene = transport_test::our_scene(name);
        const ref::World world(scene, 24, 16);
        for (const Integrator integrator : every_integrator)
            for (std::uint32_t i = 0; i < 20; ++i) {
                const ref::PathOptions options{.seed = 3, .max_edges = i % 2 == 0 ? 6 : 40};
                const ref::SampleId id{3, (37 * i + 11) % (24 * 16), i};
                std::vector<ref::Contribution> expected;
                ref::integrator_of(integrator)(world, options, id, expected);
                const Sample sample = explain::explain_sample(world, integrator, options, id);
                ASSERT_TRUE(std::ranges::equal(made_by(sample), expected, same_bits)) << name;
                counted[integrator] += expected.size();
            }
    }
    for (const Integrator integrator : every_integrator) EXPECT_GT(counted[integrator], 100u);
}

/// Each vertex has the weight that the bounce before gives it, so the numbers of the bounce are those
/// that were used.
void expect_chain(const explain::Walk& walk, std::size_t& bounces)
{
    for (std::size_t j = 1; j + 1 < walk.steps.size(); ++j) {
        const explain::Step& step = walk.steps[j];
        ASSERT_TRUE(step.bounce && step.bounce->survives);
        const ref::Rgb weight = step.bounce->sample.value / step.bounce->survival;
        ASSERT_EQ(step.vertex.alpha * weight, walk.steps[j + 1].vertex.alpha);
        ++bounces;
    }
}

// The densities of the walk come from the sampling routines, those of the path from its vertices alone.
// Each has some 20 roundings, and a cosine above 0.01 magnifies them by at most 100: 1e-11 is 45 times
// that. The densities of delta lobes follow different conventions.
void expect_same_densities(const ref::World& world, const Strategy& strategy, const Sample& sample)
{
    const std::size_t k = strategy.path.size() - 1;
    const auto expect = [&](const explain::Step& step, double in_path, std::size_t i) {
        if (step.probability || in_path == 0.0) return;
        const ref::Vertex& x = strategy.path[i];
        for (const std::size_t j : {i - 1, i + 1})
            if (j <= k && cosine(x, direction(x, strategy.path[j])) < 0.01) return;
        const double in_walk = step.pdf_area ? *step.pdf_area : *step.pdf_solid_angle;
        EXPECT_NEAR(in_walk, in_path, 1e-11 * in_path) << strategy.s << ' ' << strategy.t << ' ' << i;
    };
    const auto after_glass = [&](const explain::Walk& walk, std::size_t j) {
        return j > 0 && walk.steps[j - 1].vertex.kind == ref::Vertex::Kind::surface &&
               ref::is_delta(material_at(world, walk.steps[j - 1].vertex));
    };
    for (int j = 0; strategy.s > 1 && j < strategy.s; ++j) {
        const auto i = static_cast<std::size_t>(j);
        if (!after_glass(sample.light, i)) expect(sample.light.steps[i], strategy.p->light[i], i);
    }
    for (int j = 1; j < strategy.t; ++j) {
        const auto i = static_cast<std::size_t>(j);
        if (!after_glass(sample.eye, i)) expect(sample.eye.steps[i], strategy.p->eye[k - i], k - i);
    }
}

TEST(ExplainSample, WalksHaveTheDensitiesAndWeightsOfTheirBounces)
{
    std::size_t bounces = 0;
    for (const char* name : {"cornell_glass", "all_emitters"}) {
        const scenes::Scene scene = transport_test::our_scene(name);
        const ref::World world(scene, 24, 16);
        for (std::uint32_t i = 0; i < 200; ++i) {
            const ref::SampleId id{5, i, i};
            const Sample sample =
                explain::explain_sample(world, Integrator::bdpt, {.seed = 5, .max_edges = 8}, id);
            expect_chain(sample.eye, bounces);
            expect_chain(sample.light, bounces);
            for (const Strategy& strategy : sample.strategies)
                if (strategy.made) expect_same_densities(world, strategy, sample);
        }
    }
    EXPECT_GT(bounces, 1000u);
}

// Of two strategies, p_0 and p_1 give both weights. Some 10 roundings each.
TEST(ExplainSample, DensitiesOfThePathTracerGiveItsWeights)
{
    std::size_t compared = 0;
    for (const char* name : {"cornell_glass", "all_emitters"}) {
        const scenes::Scene scene = transport_test::our_scene(name);
        const ref::World world(scene, 24, 16);
        for (std::uint32_t i = 0; i < 200; ++i) {
            const Sample sample =
                explain::explain_sample(world, Integrator::path, {.seed = 5, .max_edges = 8}, {5, i, i});
            for (const Strategy& strategy : sample.strategies) {
                if (!strategy.made) continue;
                double sum = 0.0;
                double squares = 0.0;
                for (const explain::Density& density : strategy.densities) {
                    sum += density.relative;
                    squares += density.relative * density.relative;
                }
                EXPECT_NEAR(strategy.made->weight * sum, 1.0, 1e-14);
                EXPECT_NEAR(strategy.power * squares, 1.0, 1e-14);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 300u);
}

// A matte surface sends a walk off at the cosine sqrt(1 - u), with the first number u of the bounce.
TEST(ExplainSample, TellsTheNumbersThatTheWalksUsed)
{
    std::map<ref::Event, std::size_t> compared;
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    const ref::World world(scene, 24, 16);
    for (std::uint32_t i = 0; i < 100; ++i) {
        const Sample sample =
            explain::explain_sample(world, Integrator::bdpt, {.seed = 5, .max_edges = 8}, {5, i, i});
        for (const explain::Draw& draw : sample.draws) {
            const bool eye = draw.event == ref::Event::eye_bounce;
            if ((!eye && draw.event != ref::Event::light_bounce) || draw.use[0] == nullptr) continue;
            const explain::Step& step = (eye ? sample.eye : sample.light).steps.at(draw.vertex);
            ASSERT_TRUE(step.bounce);
            EXPECT_NEAR(cosine(step.vertex, step.bounce->wi), std::sqrt(1.0 - draw.uniforms[0]), 1e-12);
            ++compared[draw.event];
        }
    }
    EXPECT_GT(compared[ref::Event::eye_bounce], 100u);
    EXPECT_GT(compared[ref::Event::light_bounce], 100u);
}

} // namespace
