#include "check/mistakes/path_mistakes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace check {

namespace {

std::string say_edges(int number)
{
    return std::to_string(number) + (number == 1 ? " edge" : " edges");
}

/// 1 for paths of `first` to `last` edges.
PathFactor of_edges(int first, int last)
{
    return [first, last](const FinishedPath& path) {
        const auto k = static_cast<int>(path.edges());
        return first <= k && k <= last ? 1.0 : 0.0;
    };
}

/// The number of strategies that can make the path.
double possible_strategies(const FinishedPath& path)
{
    return static_cast<double>(std::count(path.possible.begin(), path.possible.end(), true));
}

double is_possible(const FinishedPath& path, std::size_t s)
{
    return path.possible[s] ? 1.0 : 0.0;
}

} // namespace

Mistake RouletteMistake::with(double q) const
{
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.2f", q);
    Mistake mistake{"one in which a walk survives roulette with a probability of about " +
                        std::string(text.data()) + " " + from + ", and its light is not divided by it",
                    adds};
    for (const Decisions& of : decisions) mistake.adds.push_back({of.part, std::pow(q, of.count) - 1.0});
    return mistake;
}

std::size_t Mistakes::add_part(PathFactor factor)
{
    parts.push_back(std::move(factor));
    return parts.size() - 1;
}

void Mistakes::add(std::string is, PathFactor factor)
{
    mistakes.push_back({std::move(is), {{add_part(std::move(factor)), 1.0}}});
}

PathFactor up_to(int longest, PathFactor factor)
{
    return [longest, factor = std::move(factor)](const FinishedPath& path) {
        return static_cast<int>(path.edges()) <= longest ? factor(path) : 0.0;
    };
}

double bidirectional(const FinishedPath& path, std::size_t s)
{
    return path.share(s);
}

double path_tracing(const FinishedPath& path, std::size_t s)
{
    if (s > 1) return 0.0;
    if (path.edges() == 1) return s == 0 ? is_possible(path, 0) : 0.0;
    const double sum = path.density[0] + path.density[1];
    return sum > 0.0 ? path.density[s] / sum : 0.0;
}

double next_event_first(const FinishedPath& path, std::size_t s)
{
    if (s > 1) return 0.0;
    const bool by_hit = path.edges() == 1 || !path.possible[1];
    return by_hit == (s == 0) ? is_possible(path, s) : 0.0;
}

double found_by_path_tracing(const FinishedPath& path)
{
    return path.possible[0] || (path.edges() > 1 && path.possible[1]) ? 1.0 : 0.0;
}

void add_lengths(Mistakes& mistakes, int longest)
{
    const auto add = [&](const std::string& is, double times, int first, int last) {
        mistakes.mistakes.push_back({is, {{mistakes.add_part(of_edges(first, last)), times}}});
    };
    add("without the light of emitters that are seen directly (paths of 1 edge)", -1.0, 1, 1);
    add("one in which emitters that are seen directly count twice (paths of 1 edge)", 1.0, 1, 1);
    add("one of direct light alone (paths of up to 2 edges)", -1.0, 3, longest);
    add("without direct light (paths of 2 edges)", -1.0, 2, 2);
    add("one in which direct light counts twice (paths of 2 edges)", 1.0, 2, 2);
    const std::string limit = ", where the golden's have up to " + say_edges(longest);
    if (longest >= 4)
        add("one of paths of up to " + say_edges(longest - 1) + limit, -1.0, longest, longest);
    add("one of paths of up to " + say_edges(longest + 1) + limit, 1.0, longest + 1, longest + 1);
}

void add_weights(Mistakes& mistakes, int longest)
{
    const auto add = [&](const std::string& is, PathFactor factor) {
        mistakes.add(is, up_to(longest, [factor = std::move(factor)](const FinishedPath& path) {
                         return factor(path) - 1.0;
                     }));
    };
    // A renderer that leaves emission hits to next events: those of emitters that are seen directly.
    const auto seen_directly = [](const FinishedPath& path) { return path.edges() == 1; };
    add("one in which all strategies are added without weights, so that each path counts as often as "
        "strategies can make it",
        possible_strategies);
    add("one in which all strategies but the light image are added without weights",
        [](const FinishedPath& path) {
            return possible_strategies(path) - is_possible(path, path.edges());
        });
    add("one in which hits of emitters and next events are added without weights (path tracing)",
        [=](const FinishedPath& path) {
            return is_possible(path, 0) + (seen_directly(path) ? 0.0 : is_possible(path, 1));
        });
    add("one in which hits of emitters and next events have the weight 1/2 each (path tracing)",
        [=](const FinishedPath& path) {
            if (seen_directly(path)) return is_possible(path, 0);
            return (is_possible(path, 0) + is_possible(path, 1)) / 2.0;
        });
    const std::string impossible = ", which count strategies that cannot make the path";
    add("one of weights 1/(s + t)" + impossible, [](const FinishedPath& path) {
        return possible_strategies(path) / static_cast<double>(path.edges() + 1);
    });
    add("one of weights 1/(s + t + 1)" + impossible + ", t = 0 among them",
        [](const FinishedPath& path) {
            return possible_strategies(path) / static_cast<double>(path.edges() + 2);
        });
    // images::Heuristic::uniform
    add("one of weights 1/(s + t - 1) for s >= 1" + impossible, [=](const FinishedPath& path) {
        if (seen_directly(path)) return is_possible(path, 0);
        return (possible_strategies(path) - is_possible(path, 0)) / static_cast<double>(path.edges());
    });
    add("one of weights 1/(s + t - 1) for t >= 2" + impossible, [](const FinishedPath& path) {
        return (possible_strategies(path) - is_possible(path, path.edges())) /
               static_cast<double>(path.edges());
    });
}

Mistakes usual_mistakes(const scenes::Scene& scene, int longest)
{
    Mistakes mistakes;
    add_lengths(mistakes, longest);
    add_strategies(mistakes, longest);
    add_weights(mistakes, longest);
    if (std::any_of(scene.materials.begin(), scene.materials.end(), [](const auto& material) {
            return std::holds_alternative<scenes::Glass>(material);
        }))
        add_refraction(mistakes, longest);
    add_roulette(mistakes, longest);
    return mistakes;
}

} // namespace check
