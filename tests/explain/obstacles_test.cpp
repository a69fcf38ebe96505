// The reasons that explain_sample gives, and its densities, against the path-space oracle, which shares
// only the scene with ref/.

#include "explain/sample.h"
#include "tests/ref/transport/path_oracle.h"
#include "tests/ref/transport/random_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>

namespace {

using explain::Obstacle;
using explain::Sample;
using explain::Strategy;
using transport_test::Judgement;
using transport_test::PathOracle;
using transport_test::Place;
using transport_test::Places;
using Kind = ref::Vertex::Kind;

constexpr int width = 5;
constexpr int height = 3;
constexpr double worst_condition = 1e6;

Place place_of(const ref::Vertex& vertex)
{
    if (vertex.kind == Kind::eye) return {Place::Kind::eye, vertex.point.position, 0};
    if (vertex.kind == Kind::surface)
        return {Place::Kind::surface, vertex.point.position, vertex.point.primitive};
    const std::uint32_t index = vertex.emitter->index;
    switch (vertex.emitter->kind) {
    case ref::EmitterKind::spot:
        return {Place::Kind::spot, vertex.point.position, index};
    case ref::EmitterKind::point:
        return {Place::Kind::point, vertex.point.position, index};
    case ref::EmitterKind::directional:
        return {Place::Kind::directional, vertex.towards, index};
    default:
        return {Place::Kind::environment, vertex.towards, index};
    }
}

Places places_of(const Strategy& strategy)
{
    Places x;
    for (const ref::Vertex& vertex : strategy.path) x.push_back(place_of(vertex));
    return x;
}

/// The scene with only one of its primitives: the others are so small and so far away that no line meets
/// them. All keep their numbers.
scenes::Scene alone(const scenes::Scene& scene, std::uint32_t primitive)
{
    scenes::Scene result = scene;
    const ref::Vec3 far(1e6, 2e6, 3e6);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        if (i != primitive) result.triangles[i].vertices.fill(far);
    for (std::size_t i = 0; i < scene.spheres.size(); ++i)
        if (i + scene.triangles.size() != primitive) {
            result.spheres[i].center = far;
            result.spheres[i].radius = 1e-3;
        }
    return result;
}

/// The material of the vertex that the obstacle names.
const scenes::Material* material_named(const scenes::Scene& scene, const Strategy& strategy)
{
    const auto number = static_cast<std::size_t>(std::stoi(strategy.at.substr(2)));
    const std::size_t i = strategy.at[0] == 'y' ? number : strategy.path.size() - 1 - number;
    const ref::Vertex& vertex = strategy.path[i];
    return vertex.kind == Kind::surface ? &scene.materials[vertex.point.material] : nullptr;
}

/// The reasons that the vertices alone tell.
void check_named_vertex(const scenes::Scene& scene, const Strategy& strategy)
{
    const scenes::Material* material = material_named(scene, strategy);
    const bool emits = material != nullptr && std::holds_alternative<scenes::Emission>(*material);
    const bool scatters = material != nullptr && std::holds_alternative<scenes::Lambertian>(*material);
    switch (strategy.obstacle) {
    case Obstacle::not_an_emitter:
        return RC_ASSERT(material != nullptr && !emits);
    case Obstacle::no_scattering:
        return RC_ASSERT(emits);
    case Obstacle::delta_vertex:
        return RC_ASSERT(material != nullptr && !emits && !scatters);
    case Obstacle::at_infinity:
    case Obstacle::delta_emitter:
        return RC_ASSERT(material == nullptr);
    default:
        return;
    }
}

/// The reasons that concern the light along the path, which has an oracle.
void check_light(const scenes::Scene& scene, const PathOracle& oracle, const Strategy& strategy,
                 std::map<Obstacle, long>& seen)
{
    const auto s = static_cast<std::size_t>(strategy.s);
    const Places x = places_of(strategy);
    const bool joined = strategy.s > 0;
    const int pixel = strategy.t == 1 ? oracle.pixel_of(x[s - 1]) : 0;
    if (strategy.obstacle == Obstacle::outside_picture) {
        ++seen[strategy.obstacle];
        return RC_ASSERT(pixel < 0);
    }
    if (pixel < 0) return RC_ASSERT(pixel == -2); // else it must be outside_picture
    RC_ASSERT(oracle.can_join(x, s));
    const auto blocked = joined ? oracle.blocked(x[s - 1], x[s]) : PathOracle::Answer::no;
    const Judgement judgement = oracle.judge(x);
    if (!(judgement.condition < worst_condition) || blocked == PathOracle::Answer::undecided) return;
    ++seen[strategy.obstacle];
    const bool dark = judgement.throughput == transport_test::Rgb(0.0);
    switch (strategy.obstacle) {
    case Obstacle::none:
        return RC_ASSERT(!dark && blocked == PathOracle::Answer::no);
    case Obstacle::dark_side:
    case Obstacle::other_side:
        return RC_ASSERT(dark);
    case Obstacle::blocked: {
        RC_ASSERT(!dark && blocked == PathOracle::Answer::yes);
        const scenes::Scene only = alone(scene, strategy.blocker.value());
        return RC_ASSERT(PathOracle(only, width, height, true).blocked(x[s - 1], x[s]) !=
                         PathOracle::Answer::no);
    }
    default:
        RC_FAIL("an obstacle that these scenes do not have");
    }
}

/// The density of each strategy, its share in the weights, and the value f / p_s.
void check_densities(const PathOracle& oracle, const ref::World& world, const Strategy& strategy)
{
    const auto s = static_cast<std::size_t>(strategy.s);
    const Judgement judgement = oracle.judge(places_of(strategy));
    if (!(judgement.condition < worst_condition) || strategy.balance == 0.0) return;
    // Some 100 operations at each of at most 10 vertices, with one roundoff each.
    const double tolerance = 1024.0 * 0x1p-53 * judgement.condition;
    const bool no_delta = std::ranges::none_of(strategy.path, [&](const ref::Vertex& vertex) {
        return vertex.kind == Kind::surface && vertex.emitter == nullptr && !scatters(world, vertex);
    });
    double sum = 0.0;
    double squares = 0.0;
    for (const explain::Density& density : strategy.densities) {
        const double expected = judgement.densities[static_cast<std::size_t>(density.s)];
        const double relative = expected / judgement.densities[s];
        RC_ASSERT(std::abs(density.relative - relative) <= 4.0 * tolerance * relative);
        // Delta vertices have a factor of their own, the same for all strategies.
        if (no_delta)
            RC_ASSERT(std::abs(static_cast<double>(density.value) - expected) <= tolerance * expected);
        sum += relative;
        squares += relative * relative;
    }
    RC_ASSERT(std::abs(strategy.balance * sum - 1.0) <= 4.0 * tolerance);
    RC_ASSERT(std::abs(strategy.power * squares - 1.0) <= 8.0 * tolerance);
}

void check_strategy(const ref::World& world, const PathOracle& oracle, const Sample& sample,
                    const Strategy& strategy, std::map<Obstacle, long>& seen)
{
    const int eye = static_cast<int>(sample.eye.steps.size());
    const int light = static_cast<int>(sample.light.steps.size());
    const bool fresh = strategy.s == 1 && strategy.t > 1;
    switch (strategy.obstacle) {
    case Obstacle::no_eye_vertex:
        ++seen[strategy.obstacle];
        return RC_ASSERT(strategy.t > eye);
    case Obstacle::no_light_vertex:
        ++seen[strategy.obstacle];
        return RC_ASSERT(strategy.s > light && !fresh);
    case Obstacle::too_long:
        ++seen[strategy.obstacle];
        return RC_ASSERT(strategy.s + strategy.t - 1 > sample.options.max_edges);
    case Obstacle::no_emitter:
        return RC_ASSERT(world.emitters.all().empty());
    case Obstacle::not_an_emitter:
    case Obstacle::no_scattering:
    case Obstacle::delta_vertex:
    case Obstacle::at_infinity:
    case Obstacle::delta_emitter:
        ++seen[strategy.obstacle];
        return check_named_vertex(world.scene, strategy);
    default:
        break;
    }
    // The rest is judged by the path, if all of it is known: a spot light of which the point is outside
    // the cone has no vertex.
    if (static_cast<int>(strategy.path.size()) < strategy.s + strategy.t) return;
    check_light(world.scene, oracle, strategy, seen);
    if (strategy.made) check_densities(oracle, world, strategy);
}

void check_scene(const scenes::Scene& scene, const ref::PathOptions& options, std::uint32_t samples,
                 std::map<Obstacle, long>& seen)
{
    const ref::World world(scene, width, height);
    const PathOracle oracle(scene, width, height, options.roulette, options.roulette_from);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const ref::SampleId id{options.seed, i % (width * height), i};
        const Sample sample = explain::explain_sample(world, images::Integrator::bdpt, options, id);
        for (const Strategy& strategy : sample.strategies)
            check_strategy(world, oracle, sample, strategy, seen);
    }
}

RC_GTEST_PROP(ExplainObstacles, AreTrueAndDensitiesAreThoseOfTheOracle, ())
{
    const scenes::Scene scene = transport_test::any_scene();
    std::map<Obstacle, long> seen;
    check_scene(scene,
                {.seed = *transport_test::any_word(),
                 .max_edges = static_cast<int>(transport_test::any_number(1.0, 8.0)),
                 .roulette = transport_test::any_chance(0.7),
                 .roulette_from = *rc::gen::element(1, 2, 5)},
                20, seen);
}

// The property above on fixed scenes: every reason occurs in them that such scenes can have.
TEST(ExplainObstacles, AllOccur)
{
    std::map<Obstacle, long> seen;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const auto scene =
            rc::gen::exec(transport_test::any_scene)(rc::Random(seed), rc::kNominalSize).value();
        check_scene(scene, {.seed = seed, .max_edges = 6}, 30, seen);
    }
    for (const Obstacle obstacle :
         {Obstacle::none, Obstacle::no_eye_vertex, Obstacle::no_light_vertex, Obstacle::too_long,
          Obstacle::not_an_emitter, Obstacle::dark_side, Obstacle::delta_vertex, Obstacle::no_scattering,
          Obstacle::at_infinity, Obstacle::delta_emitter, Obstacle::outside_picture,
          Obstacle::other_side, Obstacle::blocked})
        EXPECT_GE(seen[obstacle], 20) << static_cast<int>(obstacle);
}

} // namespace
