#include "tests/check/mistakes/wrong_renderers.h"

#include "ref/transport/bdpt.h"
#include "ref/transport/connect.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/subpath.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <variant>

namespace mistakes_test {

namespace {

using ref::Contribution;

/// What a contribution counts for; `eye` and `light`: the vertices up to which roulette lets the walks
/// of this sample live.
struct Alteration {
    std::string is;
    std::function<double(const Contribution&, int eye, int light)> weight;
};

/// Numbers of the test's own, uniform in (0, 1).
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed * 2654435761U + 1) {}
    double roll()
    {
        state_ ^= state_ << 13;
        state_ ^= state_ >> 7;
        state_ ^= state_ << 17;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

/// The vertices that a walk reaches: the second without a bounce, each further one if it survives.
int last_vertex(Dice& dice, double survival, int first_bounce)
{
    constexpr int longest = 32;
    int vertices = 2;
    for (int bounce = 1; vertices < longest && (bounce < first_bounce || dice.roll() < survival);
         ++bounce)
        ++vertices;
    return vertices;
}

struct Roulette {
    double survival;
    int first_bounce;
};

std::vector<WrongPicture> pictures_of(const ref::World& world, const ref::PathOptions& options,
                                      ref::Integrator integrator, std::uint32_t samples,
                                      const std::vector<Alteration>& alterations,
                                      const Roulette& roulette)
{
    std::vector<WrongPicture> pictures;
    const int width = world.camera.width();
    const int height = world.camera.height();
    for (const Alteration& alteration : alterations)
        pictures.push_back({alteration.is, images::Image(width, height)});
    std::vector<Contribution> contributions;
    Dice dice(options.seed);
    for (std::uint32_t pixel = 0; pixel < static_cast<std::uint32_t>(width * height); ++pixel)
        for (std::uint32_t i = 0; i < samples; ++i) {
            contributions.clear();
            integrator(world, options, {options.seed, pixel, i}, contributions);
            const int eye = last_vertex(dice, roulette.survival, roulette.first_bounce);
            const int light = last_vertex(dice, roulette.survival, roulette.first_bounce);
            for (const Contribution& c : contributions)
                for (std::size_t a = 0; a < alterations.size(); ++a)
                    pictures[a].image.pixels[c.pixel] +=
                        alterations[a].weight(c, eye, light) / samples * c.value;
        }
    return pictures;
}

std::string name_of(int s, int t)
{
    return "(" + std::to_string(s) + ", " + std::to_string(t) + ")";
}

using Contains = bool (*)(const Contribution&);

} // namespace

std::vector<WrongPicture> wrong_bidirectional(const ref::World& world, const ref::PathOptions& options,
                                              std::uint32_t samples)
{
    const int longest = options.max_edges - 1; // of a right picture
    std::vector<Alteration> all;
    const auto add = [&](const std::string& is,
                         const std::function<double(const Contribution&)>& weight) {
        all.push_back({is, [=](const Contribution& c, int, int) {
                           return ref::edges(c) <= longest ? weight(c) : 0.0;
                       }});
    };
    add("", [](const Contribution& c) { return c.weight; });
    all.push_back({"one of paths of up to " + std::to_string(longest + 1) + " edges",
                   [](const Contribution& c, int, int) { return c.weight; }});
    add("without the light of emitters that are seen directly",
        [](const Contribution& c) { return ref::edges(c) == 1 ? 0.0 : c.weight; });
    add("one in which emitters that are seen directly count twice",
        [](const Contribution& c) { return ref::edges(c) == 1 ? 2.0 * c.weight : c.weight; });
    add("one of direct light alone",
        [](const Contribution& c) { return ref::edges(c) > 2 ? 0.0 : c.weight; });
    add("without direct light",
        [](const Contribution& c) { return ref::edges(c) == 2 ? 0.0 : c.weight; });
    add("one in which direct light counts twice",
        [](const Contribution& c) { return ref::edges(c) == 2 ? 2.0 * c.weight : c.weight; });
    for (const auto& [name, contains] :
         {std::pair<std::string, Contains>{"emission hits",
                                           [](const Contribution& c) { return c.s == 0; }},
          {"next events", [](const Contribution& c) { return c.s == 1 && c.t > 1; }},
          {"the light image", [](const Contribution& c) { return c.t == 1; }},
          {"inner connections", [](const Contribution& c) { return c.s > 1 && c.t > 1; }}}) {
        const std::function<bool(const Contribution&)> of = [contains = contains,
                                                             longest](const Contribution& c) {
            return ref::edges(c) > longest || contains(c);
        };
        add("one without " + name, [of](const Contribution& c) { return of(c) ? 0.0 : c.weight; });
        add("one in which " + name,
            [of](const Contribution& c) { return of(c) ? 2.0 * c.weight : c.weight; });
    }
    for (int k = 2; k <= longest; ++k)
        for (int s = 0; s <= k; ++s) {
            const auto is_it = [=](const Contribution& c) { return c.s == s && ref::edges(c) == k; };
            add("one without strategy (s, t) = " + name_of(s, k + 1 - s),
                [=](const Contribution& c) { return is_it(c) ? 0.0 : c.weight; });
            add("one in which strategy (s, t) = " + name_of(s, k + 1 - s),
                [=](const Contribution& c) { return is_it(c) ? 2.0 * c.weight : c.weight; });
        }
    add("one in which all strategies are added without weights",
        [](const Contribution&) { return 1.0; });
    add("one in which all strategies but the light image are added",
        [](const Contribution& c) { return c.t > 1 ? 1.0 : 0.0; });
    add("one of weights 1/(s + t),", [](const Contribution& c) { return 1.0 / (c.s + c.t); });
    add("one of weights 1/(s + t + 1)", [](const Contribution& c) { return 1.0 / (c.s + c.t + 1); });
    add("one of weights 1/(s + t - 1) for s >= 1", [](const Contribution& c) {
        if (ref::edges(c) == 1) return c.s == 0 ? 1.0 : 0.0;
        return c.s == 0 ? 0.0 : 1.0 / ref::edges(c);
    });
    add("one of weights 1/(s + t - 1) for t >= 2",
        [](const Contribution& c) { return c.t == 1 ? 0.0 : 1.0 / ref::edges(c); });
    const Roulette roulette{0.6, 1};
    all.push_back({"(both walks of bidirectional path tracing), and its light is not divided by it",
                   [=](const Contribution& c, int eye, int light) {
                       return ref::edges(c) <= longest && c.t <= eye && c.s <= light ? c.weight : 0.0;
                   }});
    return pictures_of(world, options, ref::trace_bidirectionally, samples, all, roulette);
}

std::vector<WrongPicture> wrong_path_tracing(const ref::World& world, const ref::PathOptions& options,
                                             std::uint32_t samples)
{
    std::vector<Alteration> all;
    const auto add = [&](const std::string& is, double (*weight)(const Contribution&, int, int)) {
        all.push_back({is, weight});
    };
    add("", [](const Contribution& c, int, int) { return c.weight; });
    add("one in which hits of emitters and next events are added without weights",
        [](const Contribution&, int, int) { return 1.0; });
    add("one in which hits of emitters and next events have the weight 1/2",
        [](const Contribution& c, int, int) { return ref::edges(c) == 1 ? 1.0 : 0.5; });
    add("(path tracing, hits and next events weighted), and its light is not divided by it",
        [](const Contribution& c, int eye, int) { return c.t <= eye ? c.weight : 0.0; });
    return pictures_of(world, options, ref::trace_path, samples, all, {0.5, 1});
}

namespace {

/// The walk with alpha times what `factor` makes of (eta_i / eta_t)^2 at each refraction before.
std::vector<ref::Vertex> altered(const ref::World& world, std::vector<ref::Vertex> walk,
                                 double (*factor)(double eta_squared))
{
    double all = 1.0;
    for (std::size_t i = 0; i < walk.size(); ++i) {
        walk[i].alpha *= all;
        if (i == 0 || i + 1 == walk.size() || walk[i].kind != ref::Vertex::Kind::surface) continue;
        const auto* glass = std::get_if<scenes::Glass>(&ref::material_at(world, walk[i]));
        if (glass == nullptr) continue;
        const double before = glm::dot(walk[i].point.normal, ref::direction(walk[i], walk[i - 1]));
        const double after = glm::dot(walk[i].point.normal, ref::direction(walk[i], walk[i + 1]));
        if (before * after > 0.0) continue;
        const double eta = before > 0.0 ? 1.0 / glass->ior : glass->ior;
        all *= factor(eta * eta);
    }
    return walk;
}

} // namespace

std::vector<WrongPicture> wrong_refraction(const ref::World& world, const ref::PathOptions& options,
                                           std::uint32_t samples)
{
    struct Kind {
        std::string is;
        double (*eye)(double);
        double (*light)(double);
    };
    const auto right = [](double) { return 1.0; };
    const auto undone = [](double eta_squared) { return 1.0 / eta_squared; };
    const auto turned = [](double eta_squared) { return 1.0 / (eta_squared * eta_squared); };
    const auto scaled = [](double eta_squared) { return eta_squared; };
    const std::vector<Kind> kinds = {
        {"", right, right},
        {"one in which radiance is not scaled by (eta_i / eta_t)^2 where an eye walk is refracted "
         "(bidirectional)",
         undone, right},
        {"one in which radiance is scaled by (eta_t / eta_i)^2 instead of (eta_i / eta_t)^2 where an "
         "eye "
         "walk is refracted (bidirectional)",
         turned, right},
        {"one in which the power of light walks is scaled", right, scaled}};
    std::vector<WrongPicture> pictures;
    const int width = world.camera.width();
    const int height = world.camera.height();
    const auto longest = static_cast<std::size_t>(options.max_edges);
    for (const Kind& kind : kinds) pictures.push_back({kind.is, images::Image(width, height)});
    for (std::uint32_t pixel = 0; pixel < static_cast<std::uint32_t>(width * height); ++pixel)
        for (std::uint32_t i = 0; i < samples; ++i) {
            const ref::SampleId id{options.seed, pixel, i};
            const auto right_z = ref::eye_subpath(world, options, id, longest + 1);
            const auto right_y = ref::light_subpath(world, options, id, longest);
            for (std::size_t j = 0; j < kinds.size(); ++j) {
                const auto add = [&](const std::optional<Contribution>& c) {
                    if (c) pictures[j].image.pixels[c->pixel] += c->weight / samples * c->value;
                };
                const auto z = altered(world, right_z, kinds[j].eye);
                const auto y = altered(world, right_y, kinds[j].light);
                for (std::size_t t = 2; t <= z.size(); ++t) {
                    const std::span eye(z.data(), t);
                    add(ref::emission_hit(world, options, id, eye));
                    if (t <= longest) add(ref::next_event(world, options, id, eye));
                    for (std::size_t s = 2; s <= y.size() && s + t - 1 <= longest; ++s)
                        add(ref::inner_connection(world, options, id, {y.data(), s}, eye));
                }
                for (std::size_t s = 1; s <= y.size(); ++s)
                    add(ref::light_image(world, options, {y.data(), s}, z[0]));
            }
        }
    return pictures;
}

} // namespace mistakes_test
