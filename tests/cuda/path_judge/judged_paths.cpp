#include "tests/cuda/path_judge/judged_paths.h"

#include <numeric>
#include <sstream>

namespace path_judge_test {

void Tally::add(const Tally& other)
{
    samples += other.samples;
    contributions += other.contributions;
    grazing += other.grazing;
    weights_left_open += other.weights_left_open;
    for (const auto& [why, count] : other.samples_left) samples_left[why] += count;
    for (const auto& [why, count] : other.strategies_left) strategies_left[why] += count;
}

long Tally::left() const
{
    long sum = 0;
    for (const auto& [why, count] : samples_left) sum += count;
    for (const auto& [why, count] : strategies_left) sum += count;
    return sum;
}

std::string Tally::report() const
{
    std::ostringstream text;
    text << samples << " samples, " << contributions << " contributions compared, " << weights_left_open
         << " of them without weight; " << grazing << " grazing\n";
    for (const auto& [why, count] : samples_left)
        text << "  samples left: " << count << ": " << why << '\n';
    for (const auto& [why, count] : strategies_left)
        text << "  strategies left: " << count << ": " << why << '\n';
    return text.str();
}

namespace {

/// A product that becomes subnormal loses 2^-150; the factors that follow magnify it by less than
/// 2^50.
constexpr double underflow = 0x1p-100;

fast::PathOptions float_options(const ref::PathOptions& options)
{
    return {options.seed, options.max_edges,
            options.heuristic == ref::Heuristic::power ? fast::Heuristic::power
                                                       : fast::Heuristic::balance};
}

[[noreturn]] void differ(const std::string& what, double floats, double reference, double bound)
{
    std::ostringstream text;
    text << what << ": " << floats << ", reference " << reference << ", bound " << bound;
    throw Disagreement(text.str());
}

/// The pixel must be that of a point within the error of the film point.
void require_pixel(std::uint32_t pixel, int width, const ExpectedContribution& expected)
{
    const double x = pixel % static_cast<std::uint32_t>(width);
    const double y = pixel / static_cast<std::uint32_t>(width);
    const double e = expected.film_error;
    require(expected.x >= x - e && expected.x <= x + 1 + e && expected.y >= y - e &&
                expected.y <= y + 1 + e,
            "a light image has a wrong pixel");
}

void compare(const RecordedSample::Found& found, const ExpectedContribution& expected, Tally& tally)
{
    for (int i = 0; i < 3; ++i) {
        const double bound = expected.value_error * expected.value[i] + underflow;
        if (!(std::abs(found.value[i] - expected.value[i]) <= bound))
            differ("value", found.value[i], expected.value[i], bound);
    }
    if (!(std::abs(found.weight - expected.weight) <= expected.weight_error))
        differ("weight", found.weight, expected.weight, expected.weight_error);
    ++tally.contributions;
    if (std::isinf(expected.weight_error)) ++tally.weights_left_open;
}

/// Compares the fast path's contribution by one strategy, or none, with the expected one.
template <class Strategy>
void judge_strategy_of(const Setting& setting, const RecordedSample::Found* found, std::size_t t,
                       const Strategy& strategy, Tally& tally)
{
    try {
        const std::optional<ExpectedContribution> expected = strategy(found != nullptr);
        if (found == nullptr) {
            require(!expected || ref::max_component(expected->value) < underflow,
                    "a contribution is missing");
            return;
        }
        require(expected.has_value(), "an impossible contribution");
        if (t == 1)
            require_pixel(found->pixel, setting.world.camera.width(), *expected);
        else
            require(found->pixel == setting.id.pixel, "a sample has a wrong pixel");
        compare(*found, *expected, tally);
    } catch (const Undecided& why) {
        ++tally.strategies_left[why.what()];
    } catch (const Grazing& bound) {
        ++tally.grazing;
        for (int i = 0; found != nullptr && i < 3; ++i)
            if (!(found->value[i] <= 1.01 * bound.most[i] + underflow))
                differ("a connection in the plane of a surface", found->value[i], 0, bound.most[i]);
    }
}

} // namespace

void judge_sample(const Setting& setting, const WalkRecorder& scene, fast::Integrator integrator,
                  Tally& tally)
{
    const RecordedSample sample = scene.sample(integrator, float_options(setting.options),
                                               {setting.id.seed, setting.id.pixel, setting.id.sample});
    require(!sample.found_twice, "a strategy contributes twice");
    ++tally.samples;
    FollowedWalk y;
    FollowedWalk z;
    const bool light = integrator != fast::Integrator::path;
    const bool eye = integrator != fast::Integrator::light;
    try {
        if (light) {
            const int most = scene.most_light_vertices(integrator, setting.options.max_edges);
            y = followed_light_walk(setting, sample, static_cast<std::size_t>(most));
        }
        if (eye)
            z = followed_eye_walk(setting, sample);
        else
            z = {{eye_vertex(setting.world)}, {0}, {0}};
    } catch (const Undecided& why) {
        ++tally.samples_left[why.what()];
        return;
    }
    const PathJudge judge(setting, integrator, y, z);
    auto left = sample.found;
    const auto check = [&](std::size_t s, std::size_t t, const auto& judge_strategy) {
        const auto entry = left.find({static_cast<int>(s), static_cast<int>(t)});
        const bool is_found = entry != left.end();
        try {
            judge_strategy_of(setting, is_found ? &entry->second : nullptr, t, judge_strategy, tally);
        } catch (const Disagreement& why) {
            throw Disagreement("s = " + std::to_string(s) + ", t = " + std::to_string(t) + ": " +
                               why.what());
        }
        if (is_found) left.erase(entry);
    };
    // Paths of at most max_edges edges: a path has s + t - 1.
    const auto longest = static_cast<std::size_t>(setting.options.max_edges);
    for (std::size_t t = 2; t <= z.vertices.size(); ++t) {
        check(0, t, [&](bool) { return judge.emission_hit(t); });
        if (t > longest || z.vertices[t - 1].kind == ref::Vertex::Kind::infinity) continue;
        check(1, t, [&](bool found) { return judge.next_event(t, found); });
        for (std::size_t s = 2; s <= y.vertices.size() && s + t - 1 <= longest; ++s)
            check(s, t, [&](bool found) { return judge.inner_connection(s, t, found); });
    }
    for (std::size_t s = 1; s <= y.vertices.size(); ++s)
        check(s, 1, [&](bool found) { return judge.light_image(s, found); });
    if (!left.empty())
        throw Disagreement("s = " + std::to_string(left.begin()->first.first) +
                           ", t = " + std::to_string(left.begin()->first.second) +
                           ": a contribution that no two walks can make");
}

} // namespace path_judge_test
