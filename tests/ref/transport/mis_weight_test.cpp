// The path oracle: for random complete paths in random small scenes, the density of every strategy,
// every weight and every contribution are compared with path_oracle.h, which shares only the scene
// with ref/.

#include "ref/transport/bdpt.h"
#include "ref/transport/mis_weight.h"
#include "ref/transport/subpath.h"
#include "tests/ref/transport/path_oracle.h"
#include "tests/ref/transport/random_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace {

using ref::Vertex;
using transport_test::Judgement;
using transport_test::PathOracle;
using transport_test::Place;
using transport_test::Places;

constexpr int width = 5;
constexpr int height = 3;

Place place_of(const Vertex& vertex)
{
    switch (vertex.kind) {
    case Vertex::Kind::eye:
        return {Place::Kind::eye, vertex.point.position, 0};
    case Vertex::Kind::surface:
        return {Place::Kind::surface, vertex.point.position, vertex.point.primitive};
    case Vertex::Kind::source:
        return {vertex.emitter->kind == ref::EmitterKind::spot ? Place::Kind::spot : Place::Kind::point,
                vertex.point.position, vertex.emitter->index};
    case Vertex::Kind::infinity:
        break;
    }
    const bool sun = vertex.emitter->kind == ref::EmitterKind::directional;
    return {sun ? Place::Kind::directional : Place::Kind::environment, vertex.towards,
            vertex.emitter->index};
}

Places places_of(std::span<const Vertex> y, std::span<const Vertex> z)
{
    Places x;
    for (const Vertex& vertex : y) x.push_back(place_of(vertex));
    for (auto vertex = z.rbegin(); vertex != z.rend(); ++vertex) x.push_back(place_of(*vertex));
    return x;
}

ref::Path path_of(std::span<const Vertex> y, std::span<const Vertex> z)
{
    ref::Path x;
    for (const Vertex& vertex : y) x.push_back(&vertex);
    for (auto vertex = z.rbegin(); vertex != z.rend(); ++vertex) x.push_back(&*vertex);
    return x;
}

/// The relative difference that rounding may cause: both sides start from the same positions and do
/// some 100 operations at each of at most 10 vertices, with one roundoff each; `condition` bounds the
/// growth of a roundoff at a vertex.
double tolerance(const Judgement& judgement)
{
    return 1024.0 * 0x1p-53 * judgement.condition;
}

/// Paths with a larger condition than this are left out; see the count at the end of the properties.
constexpr double worst_condition = 1e6;

double expected_weight(const Judgement& judgement, std::size_t s, ref::Heuristic heuristic)
{
    const double exponent = heuristic == ref::Heuristic::balance ? 1.0 : 2.0;
    double sum = 0.0;
    for (const double p : judgement.densities) sum += std::pow(p / judgement.densities[s], exponent);
    return 1.0 / sum;
}

/// The first bounce that roulette may end: as early as possible, the default, or later.
int any_first_risk()
{
    return *rc::gen::element(1, 2, 5, 8);
}

/// Checks every weight of the path, and their sum.
void check_weights(const ref::World& world, ref::PathOptions options, const ref::Path& x,
                   const Judgement& judgement)
{
    for (const auto heuristic : {ref::Heuristic::balance, ref::Heuristic::power}) {
        options.heuristic = heuristic;
        double sum = 0.0;
        for (std::size_t s = 0; s < x.size(); ++s) {
            const double weight = mis_weight(world, options, x, s);
            sum += weight;
            if (judgement.densities[s] == 0.0) {
                RC_ASSERT(weight == 0.0); // exactly 0: the strategy is impossible
            } else {
                const double expected = expected_weight(judgement, s, heuristic);
                RC_ASSERT(std::abs(weight - expected) <= 4.0 * tolerance(judgement) * expected);
            }
        }
        const bool possible = std::ranges::any_of(judgement.densities, [](double p) { return p > 0.0; });
        RC_ASSERT(std::abs(sum - (possible ? 1.0 : 0.0)) <= 1e-14 * static_cast<double>(x.size()));
    }
}

bool carries_light(const Judgement& judgement)
{
    return judgement.throughput != transport_test::Rgb(0.0);
}

/// All contributions of two walks by (s, t, pixel), from trace_bidirectionally itself.
using Key = std::tuple<int, int, std::uint32_t>;
std::map<Key, ref::Contribution>
contributions_of(const ref::World& world, const ref::PathOptions& options, const ref::SampleId& id)
{
    std::vector<ref::Contribution> all;
    trace_bidirectionally(world, options, id, all);
    std::map<Key, ref::Contribution> result;
    for (const auto& c : all) {
        const bool first = result.emplace(Key{c.s, c.t, c.pixel}, c).second;
        RC_ASSERT(first); // each strategy at most once
    }
    return result;
}

/// The y_0 of next event at z_{t-1}, sampled with the same numbers.
std::optional<Vertex> next_event_vertex(const ref::World& world, const ref::SampleId& id,
                                        std::span<const Vertex> z)
{
    const auto light =
        sample_incident(world.emitters, z.back().point.position,
                        uniforms(id, ref::Event::next_event, static_cast<std::uint32_t>(z.size() - 1)));
    if (!light) return std::nullopt;
    if (light->infinite) return ref::infinity_vertex(*light->emitter, light->wi, ref::Rgb(1.0));
    if (light->delta) return ref::source_vertex(*light->emitter, light->end.position, ref::Rgb(1.0));
    return surface_vertex(world, light->end, ref::Rgb(1.0));
}

/// Counts of the comparisons: by strategy family, by kind of emitter, and by whether one possible
/// strategy passes some delta vertex in one direction and another strategy in the other.
struct Tally {
    std::map<std::tuple<std::string, Place::Kind, bool>, long> compared;
    long decided = 0;
    long left_open = 0;
};

std::string family(int s, int t)
{
    return t == 1 ? "light image" : s == 0 ? "emission hit" : s == 1 ? "next event" : "inner connection";
}

/// Whether glass is between the first and the last place at which the light walk and the eye walk can
/// be joined.
bool glass_is_passed_both_ways(const ref::World& world, const Places& x, const Judgement& judgement)
{
    std::size_t first = x.size();
    std::size_t last = 0;
    for (std::size_t s = 0; s < x.size(); ++s)
        if (judgement.densities[s] > 0.0) {
            first = std::min(first, s);
            last = s;
        }
    for (std::size_t i = first; i < last; ++i)
        if (x[i].kind == Place::Kind::surface &&
            std::holds_alternative<scenes::Glass>(
                world.scene.materials[material_of(world.scene, x[i].index)]))
            return true;
    return false;
}

/// Checks one strategy (s, t) of joining the two walks: there is a contribution exactly when the path
/// can carry light, and it is f / p_s with the right weight.
void check_join(const ref::World& world, const PathOracle& oracle, const ref::PathOptions& options,
                const ref::SampleId& id, std::map<Key, ref::Contribution>& made,
                std::span<const Vertex> y, std::span<const Vertex> z, Tally& tally)
{
    const int s = static_cast<int>(y.size());
    const int t = static_cast<int>(z.size());
    const Places x = places_of(y, z);
    int pixel = static_cast<int>(id.pixel);
    if (t == 1) pixel = oracle.pixel_of(x[static_cast<std::size_t>(s - 1)]);
    const auto found = pixel < 0 ? made.end() : made.find(Key{s, t, static_cast<std::uint32_t>(pixel)});
    const bool is_made = found != made.end();
    if (!oracle.can_join(x, static_cast<std::size_t>(s))) {
        RC_ASSERT(!is_made);
        return;
    }
    const auto blocked =
        s == 0 ? PathOracle::Answer::no
               : oracle.blocked(x[static_cast<std::size_t>(s - 1)], x[static_cast<std::size_t>(s)]);
    const Judgement judgement =
        pixel == -1 ? Judgement{transport_test::Rgb(0.0), {}, 1.0} : oracle.judge(x);
    const bool undecided = pixel == -2 || blocked == PathOracle::Answer::undecided ||
                           !(judgement.condition < worst_condition);
    if (undecided) {
        ++tally.left_open;
        if (is_made)
            made.erase(found);
        else if (pixel == -2)
            std::erase_if(made, [&](const auto& m) { return m.second.s == s && m.second.t == t; });
        return;
    }
    ++tally.decided;
    const bool expected = pixel >= 0 && carries_light(judgement) &&
                          judgement.densities[static_cast<std::size_t>(s)] > 0.0 &&
                          blocked == PathOracle::Answer::no;
    if (is_made != expected) RC_LOG() << "s = " << s << ", t = " << t << ", pixel " << pixel << '\n';
    RC_ASSERT(is_made == expected);
    if (!is_made) return;

    const ref::Contribution c = found->second;
    made.erase(found);
    ++tally.compared[{family(s, t), x[0].kind, glass_is_passed_both_ways(world, x, judgement)}];
    for (int i = 0; i < 3; ++i) {
        const double value = judgement.throughput[i] / judgement.densities[static_cast<std::size_t>(s)];
        const double error = std::abs(c.value[i] - value);
        if (!(error <= tolerance(judgement) * value))
            RC_LOG() << "s = " << s << ", t = " << t << ": value " << c.value[i] << ", expected "
                     << value << ", relative error " << error / value << ", tolerance "
                     << tolerance(judgement) << '\n';
        RC_ASSERT(error <= tolerance(judgement) * value);
    }
    const double weight = expected_weight(judgement, static_cast<std::size_t>(s), options.heuristic);
    RC_ASSERT(std::abs(c.weight - weight) <= 4.0 * tolerance(judgement) * weight);
    check_weights(world, options, path_of(y, z), judgement);
}

/// Checks all contributions of `samples` pairs of walks in the scene.
void check_scene(const scenes::Scene& scene, const ref::PathOptions& options, std::uint32_t samples,
                 Tally& tally)
{
    const ref::World world(scene, width, height);
    const PathOracle oracle(scene, width, height, options.roulette, options.roulette_from);
    const auto longest = static_cast<std::size_t>(options.max_edges);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const ref::SampleId id{options.seed, i % (width * height), i};
        auto made = contributions_of(world, options, id);
        const auto z = eye_subpath(world, options, id, longest + 1);
        const auto y = light_subpath(world, options, id, longest);
        const auto check = [&](std::span<const Vertex> light, std::span<const Vertex> eye) {
            check_join(world, oracle, options, id, made, light, eye, tally);
        };
        for (std::size_t s = 1; s <= y.size(); ++s) check({y.data(), s}, {z.data(), 1});
        for (std::size_t t = 2; t <= z.size(); ++t) {
            const std::span<const Vertex> eye(z.data(), t);
            if (eye.back().emitter != nullptr) check({}, eye);
            if (eye.back().kind != Vertex::Kind::surface || t > longest) continue;
            if (const auto y0 = next_event_vertex(world, id, eye)) check({&*y0, 1}, eye);
            for (std::size_t s = 2; s <= y.size() && s + t <= longest + 1; ++s)
                check({y.data(), s}, eye);
        }
        RC_ASSERT(made.empty()); // no contribution that two walks cannot produce
    }
}

// map: throughput, delta-lobe, area-conversion, density-light, density-z1, density-eye
// map: impossible, density-ratio, balance, power
RC_GTEST_PROP(MisWeight, EveryContributionIsThroughputOverDensityTimesItsShare, ())
{
    const scenes::Scene scene = transport_test::any_scene();
    ref::PathOptions options{.seed = *transport_test::any_word(),
                             .max_edges = static_cast<int>(transport_test::any_number(1.0, 10.0))};
    options.roulette = transport_test::any_chance(0.7);
    options.roulette_from = any_first_risk();
    if (transport_test::any_chance(0.3)) options.heuristic = ref::Heuristic::power;
    Tally tally;
    check_scene(scene, options, 40, tally);
}

// The property above on three hundred fixed scenes, to check its coverage: every family with every
// emitter that it can join, with and without glass that several strategies pass.
TEST(MisWeight, TheOracleMeetsEveryFamilyWithEveryEmitterAndGlass)
{
    Tally tally;
    for (std::uint64_t seed = 1; seed <= 450; ++seed) {
        const auto scene =
            rc::gen::exec(transport_test::any_scene)(rc::Random(seed), rc::kNominalSize).value();
        check_scene(scene, {.seed = seed, .max_edges = 7}, 160, tally);
    }
    using Kind = Place::Kind;
    for (const Kind kind :
         {Kind::surface, Kind::point, Kind::spot, Kind::directional, Kind::environment})
        for (const int s : {0, 1, 2, 3})
            for (const bool glass : {false, true}) {
                const int t = s == 3 ? 1 : 2; // one (s, t) of each family
                const bool can_be_hit = kind == Kind::surface || kind == Kind::environment;
                if (s == 0 && !can_be_hit) continue;
                if (glass && s == 3 && kind == Kind::directional) continue; // too rare, like the sky
                const long count = tally.compared[{family(s, t), kind, glass}];
                EXPECT_GE(count, glass ? 1 : 20)
                    << family(s, t) << ", emitter " << static_cast<int>(kind)
                    << (glass ? ", through glass" : "");
            }
    EXPECT_LT(tally.left_open, tally.decided / 20);
}

/// A point anywhere on a primitive.
ref::SurfacePoint any_point_on(const ref::World& world, std::uint32_t primitive)
{
    const auto triangles = static_cast<std::uint32_t>(world.scene.triangles.size());
    if (primitive >= triangles)
        return sphere_point(world.geometry, primitive - triangles, *transport_test::any_direction());
    return triangle_point(
        world.geometry, primitive,
        ref::sample_triangle(*transport_test::any_unit(), *transport_test::any_unit()));
}

/// Any point of any emitter.
Vertex any_emitter_vertex(const ref::World& world)
{
    const auto& all = world.emitters.all();
    const auto& emitter =
        all[static_cast<std::size_t>(transport_test::any_number(0.0, static_cast<double>(all.size())))];
    const ref::Rgb one(1.0);
    switch (emitter.kind) {
    case ref::EmitterKind::triangle:
        return surface_vertex(world, any_point_on(world, emitter.index), one);
    case ref::EmitterKind::sphere:
        return surface_vertex(world,
                              any_point_on(world, emitter.index + static_cast<std::uint32_t>(
                                                                      world.scene.triangles.size())),
                              one);
    case ref::EmitterKind::point:
        return source_vertex(emitter, world.scene.point_lights[emitter.index].position, one);
    case ref::EmitterKind::spot:
        return source_vertex(emitter, world.scene.spot_lights[emitter.index].position, one);
    case ref::EmitterKind::directional:
        return infinity_vertex(emitter, -world.scene.directional_lights[emitter.index].direction, one);
    case ref::EmitterKind::environment:
        break;
    }
    return infinity_vertex(emitter, *transport_test::any_direction(), one);
}

// Weights depend only on the path. Here the path is made of points of scattering surfaces that no walk
// has sampled, in any number, visible to each other or not.
// map: area-conversion, density-y0, density-y1, density-ratio
RC_GTEST_PROP(MisWeight, AnyPointsMakeAPathWhoseWeightsAreTheDefinitions, ())
{
    scenes::Scene scene = transport_test::any_scene();
    scene.spheres.push_back(
        {transport_test::any_point(1.0), transport_test::any_number(0.1, 0.7), transport_test::matte});
    const ref::World world(scene, width, height);
    RC_PRE(!world.emitters.all().empty());
    std::vector<std::uint32_t> scattering;
    for (std::uint32_t i = 0; i < primitive_count(scene); ++i)
        if (material_of(scene, i) <= transport_test::grey) scattering.push_back(i);

    const bool roulette = transport_test::any_chance(0.7);
    const int roulette_from = any_first_risk();
    const PathOracle oracle(scene, width, height, roulette, roulette_from);
    for (int repeat = 0; repeat < 20; ++repeat) {
        std::vector<Vertex> y = {any_emitter_vertex(world)};
        const int inner = static_cast<int>(transport_test::any_number(0.0, 9.0));
        for (int i = 0; i < inner; ++i) {
            const auto which = static_cast<std::size_t>(
                transport_test::any_number(0.0, static_cast<double>(scattering.size())));
            y.push_back(surface_vertex(world, any_point_on(world, scattering[which]), ref::Rgb(1.0)));
        }
        const Vertex eye = eye_vertex(world);
        const Places x = places_of(y, {&eye, 1});
        if (oracle.pixel_of(x[x.size() - 2]) < 0) continue;
        const Judgement judgement = oracle.judge(x);
        if (!(judgement.condition < worst_condition) || !carries_light(judgement)) continue;
        check_weights(world, {.roulette = roulette, .roulette_from = roulette_from},
                      path_of(y, {&eye, 1}), judgement);
    }
}

// Two neighbours at distances of h from the edge of two walls, where random points hardly ever are. The
// connection of them has 1 / h^2 in its value, and the weight takes it away: it is about h^2, as the
// densities of the other two strategies have 1 / h^2. With any limit of the distance in these densities,
// the weights still add up to 1, but the connection is a firefly.
TEST(MisWeight, VerticesThatNearlyCoincideHaveTheWeightsOfTheDefinitions) // map: area-conversion
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{ref::Rgb(0.5)}};
    scene.material_names = {"wall"};
    scene.triangles = {{{ref::Vec3(0, -2, 0), ref::Vec3(4, 0, 0), ref::Vec3(0, 2, 0)}, 0},
                       {{ref::Vec3(0, -2, 0), ref::Vec3(0, 2, 0), ref::Vec3(0, 0, 4)}, 0}};
    scene.point_lights = {{ref::Vec3(1.0, 0.3, 1.2), ref::Rgb(1.0)}};
    const double half = std::sqrt(0.5);
    scene.camera =
        scenes::Camera{ref::Vec3(2, 0, 2),       ref::Vec3(0, 1, 0),          ref::Vec3(-half, 0, half),
                       ref::Vec3(half, 0, half), scenes::FovAxis::horizontal, 1.0};
    const ref::World world(scene, width, height);
    const PathOracle oracle(scene, width, height, false);
    for (const double h : {0.1, 1e-2, 1e-3, 1e-4}) {
        const double b = h / 4.0;
        const auto floor = triangle_point(world.geometry, 0, {0.5 * (1.0 - b), b, 0.5 * (1.0 - b)});
        const auto wall = triangle_point(world.geometry, 1, {0.5 * (1.0 - b), 0.5 * (1.0 - b), b});
        const ref::Rgb one(1.0);
        const std::vector<Vertex> y = {
            source_vertex(world.emitters.all()[0], scene.point_lights[0].position, one),
            surface_vertex(world, floor, one), surface_vertex(world, wall, one)};
        const Vertex eye = eye_vertex(world);
        const Judgement judgement = oracle.judge(places_of(y, {&eye, 1}));
        ASSERT_LT(judgement.condition, worst_condition);
        const ref::Path x = path_of(y, {&eye, 1});
        for (std::size_t s = 0; s < x.size(); ++s) {
            const double weight = mis_weight(world, {.roulette = false}, x, s);
            const double expected = judgement.densities[s] > 0.0
                                        ? expected_weight(judgement, s, ref::Heuristic::balance)
                                        : 0.0;
            EXPECT_NEAR(weight, expected, 4.0 * tolerance(judgement) * expected) << h << ", s = " << s;
            if (s == 2) {
                EXPECT_LT(weight, 50.0 * h * h);
            }
        }
    }
}

} // namespace
