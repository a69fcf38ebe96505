#include "explain/fast_text.h"

#include "explain/layout.h"

#include <algorithm>
#include <cmath>

namespace explain {

namespace {

/// A difference in two digits, in brackets.
std::string in_brackets(double difference)
{
    std::array<char, 32> text{};
    (void)std::snprintf(text.data(), text.size(), difference == 0.0 ? "(0)" : "(%.1e)", difference);
    return text.data();
}

double relative(double x, double expected)
{
    return x == expected ? 0.0 : std::abs(x - expected) / std::abs(expected);
}

/// The largest of the channels.
double relative(const Rgb& x, const Rgb& expected)
{
    return std::max({relative(x.x, expected.x), relative(x.y, expected.y), relative(x.z, expected.z)});
}

/// A number, and its difference if there is one to compare it with.
std::string compared(double x, const std::optional<double>& expected)
{
    return number(x) + (expected ? " " + in_brackets(relative(x, *expected)) : "");
}

/// Whether both walks have come to the same place.
bool is_same_place(const scenes::Scene& scene, const FastVertex& vertex, const Step& step)
{
    return vertex.kind == step.vertex.kind && describe(scene, vertex) == describe(scene, step.vertex);
}

void add_part(std::string& text, const char* name, const std::optional<double>& x,
              const std::optional<double>& expected)
{
    if (x) text += (text.empty() ? "" : ", ") + std::string(name) + " " + compared(*x, expected);
}

std::string fast_densities(const FastVertex& vertex, const Step* step)
{
    std::string text;
    add_part(text, "probability", vertex.probability,
             step != nullptr ? step->probability : std::nullopt);
    add_part(text, "pdf_solid_angle", vertex.pdf_solid_angle,
             step != nullptr ? step->pdf_solid_angle : std::nullopt);
    add_part(text, "pdf_area", vertex.pdf_area, step != nullptr ? step->pdf_area : std::nullopt);
    return text;
}

std::string fast_bounce_text(const FastBounce& bounce, const Step* step)
{
    std::string text = "bounce";
    const auto of = [&](double ref::BsdfSample::*member) {
        return step != nullptr && step->bounce ? std::optional(step->bounce->sample.*member)
                                               : std::nullopt;
    };
    if (bounce.delta)
        text += " by a delta lobe";
    else
        text += ", pdf_fwd " + compared(bounce.pdf_fwd, of(&ref::BsdfSample::pdf_fwd)) + ", pdf_rev " +
                compared(bounce.pdf_rev, of(&ref::BsdfSample::pdf_rev));
    if (bounce.survival < 1.0F)
        text += ", goes on with probability " +
                compared(bounce.survival, step != nullptr && step->bounce
                                              ? std::optional(step->bounce->survival)
                                              : std::nullopt);
    return text;
}

/// The vertex, and its differences from the reference's `step`, if there is one at the same place.
std::string vertex_text(const FastVertex& vertex, const Step* step)
{
    const auto off = [&](const Vec3& x, const Vec3& expected) {
        return numbers(x) + (step != nullptr ? " " + in_brackets(glm::length(x - expected)) : "");
    };
    const Vec3 none(0.0);
    const bool far = vertex.kind == ref::Vertex::Kind::infinity;
    std::string place =
        far ? "towards " + off(vertex.towards, step != nullptr ? step->vertex.towards : none)
            : "position " + off(vertex.position, step != nullptr ? step->vertex.point.position : none);
    if (vertex.kind == ref::Vertex::Kind::surface)
        place = padded(place, 54) + "normal " +
                off(vertex.normal, step != nullptr ? step->vertex.point.normal : none);
    std::string text = trimmed("       " + place);
    text += trimmed(
        "       " +
        padded(
            "alpha " + numbers(vertex.alpha) +
                (step != nullptr ? " " + in_brackets(relative(vertex.alpha, step->vertex.alpha)) : ""),
            54) +
        (far || vertex.probability ? fast_densities(vertex, step) : std::string()));
    if (!far && !vertex.probability && !fast_densities(vertex, step).empty())
        text += "       " + fast_densities(vertex, step) + "\n";
    if (vertex.bounce) text += "       " + fast_bounce_text(*vertex.bounce, step) + "\n";
    return text;
}

std::string fast_walk_text(const ref::World& world, const std::vector<FastVertex>& walk,
                           const Walk& expected, char letter)
{
    std::string text = std::string(letter == 'z' ? "\nEye walk, " : "\nLight walk, ") +
                       plural(walk.size(), "vertex", "vertices") + "; of the reference " +
                       std::to_string(expected.steps.size()) + "\n";
    bool together = true;
    for (std::size_t j = 0; j < walk.size(); ++j) {
        const Step* step = together && j < expected.steps.size() ? &expected.steps[j] : nullptr;
        text += "  " + padded(std::string(1, letter) + "_" + std::to_string(j), 5) +
                describe(world.scene, walk[j]);
        if (together && (step == nullptr || !is_same_place(world.scene, walk[j], *step))) {
            text += " - here the walks part: the reference " +
                    (step == nullptr ? std::string("has no such vertex")
                                     : "is at " + describe(world.scene, step->vertex));
            together = false;
            step = nullptr;
        }
        text += "\n" + vertex_text(walk[j], step);
    }
    if (together && walk.size() < expected.steps.size())
        text += "  here the walks part: the reference goes on to " +
                describe(world.scene, expected.steps[walk.size()].vertex) + "\n";
    return text;
}

const Strategy* find_strategy(const Sample& sample, int s, int t)
{
    const auto found = std::ranges::find_if(
        sample.strategies, [&](const Strategy& one) { return one.s == s && one.t == t; });
    return found == sample.strategies.end() ? nullptr : &*found;
}

std::string fast_row(const FastContribution& made, const Strategy* expected)
{
    std::vector<std::string> cells = {"  " + std::to_string(made.s), std::to_string(made.t)};
    if (made.is_dropped()) {
        cells.emplace_back("- not finite: left out of the picture");
    } else {
        const bool both = expected != nullptr && expected->made;
        const auto difference = [&](double of_both) { return both ? in_brackets(of_both) : "(alone)"; };
        cells.push_back(short_numbers(Vec3(made.value)));
        cells.push_back(difference(both ? relative(Rgb(made.value), expected->made->value) : 0.0));
        cells.push_back(short_number(made.weight));
        cells.push_back(difference(both ? relative(made.weight, expected->made->weight) : 0.0));
        cells.push_back(short_numbers(Vec3(made.contribution())));
    }
    return row(cells, {5, 3, 31, 10, 9, 10});
}

std::string fast_strategies_text(const ref::World& world, const Sample& sample, const FastSample& fast)
{
    std::string text =
        "\nStrategies: s vertices of the light walk, t of the eye walk\n" +
        row({"  s", "t", "value alone (R G B)", "", "weight", "", "adds"}, {5, 3, 31, 10, 9, 10});
    const auto reason = [&](const Strategy& strategy) {
        return strategy.made && !strategy.is_dropped()
                   ? "value " + short_numbers(strategy.made->value) + ", weight " +
                         short_number(strategy.made->weight)
                   : sentence(strategy, world.scene);
    };
    for (const Strategy& strategy : sample.strategies) {
        const FastContribution* made = fast.of(strategy.s, strategy.t);
        if (made != nullptr) text += fast_row(*made, &strategy);
        if ((made == nullptr) == !strategy.made && made != nullptr) continue;
        text += made != nullptr
                    ? "          the reference: " + reason(strategy) + "\n"
                    : row({"  " + std::to_string(strategy.s), std::to_string(strategy.t),
                           (strategy.made ? "- nothing; the reference: " : "- ") + reason(strategy)},
                          {5, 3});
    }
    for (const FastContribution& made : fast.made)
        if (find_strategy(sample, made.s, made.t) == nullptr)
            text +=
                fast_row(made, nullptr) + "          the reference: its walks have no such vertices\n";
    return text;
}

std::string fast_sums_text(const ref::World& world, const Sample& sample, const FastSample& fast)
{
    const int width = world.camera.width();
    std::string text = "\nAdds to its pixel " + pixel_name(sample.id.pixel, width) + ": " +
                       numbers(Vec3(fast.own)) + " " + in_brackets(relative(Rgb(fast.own), sample.own)) +
                       "\n";
    for (const FastContribution& made : fast.made) {
        if (made.t != 1 || made.is_dropped()) continue;
        const Strategy* expected = find_strategy(sample, made.s, 1);
        const bool both = expected != nullptr && expected->made;
        text += "Adds to pixel " + pixel_name(made.pixel, width) + ": " +
                numbers(Vec3(made.contribution())) +
                (both ? " " + in_brackets(relative(Rgb(made.contribution()), expected->contribution()))
                      : "") +
                " (splat of strategy (" + std::to_string(made.s) + ",1))\n";
        if (both && expected->made->pixel != made.pixel)
            text +=
                "  the reference adds it to pixel " + pixel_name(expected->made->pixel, width) + "\n";
    }
    return text;
}

} // namespace

std::string describe(const ref::World& world, const Sample& sample, const FastSample& fast)
{
    std::string text =
        heading(world, sample) +
        "By the fast path on the host, in single precision, from the highest 24 bits of the same\n"
        "random numbers. In brackets the difference from the reference: relative to its number, and\n"
        "of positions and directions a length. 2^-24 is 6.0e-08.\n" +
        fast_walk_text(world, fast.eye, sample.eye, 'z');
    if (sample.light.end != WalkEnd::not_walked)
        text += fast_walk_text(world, fast.light, sample.light, 'y');
    return text + fast_strategies_text(world, sample, fast) + fast_sums_text(world, sample, fast);
}

} // namespace explain
