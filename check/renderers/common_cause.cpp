#include "check/renderers/common_cause.h"

#include "check/renderers/features.h"

#include <algorithm>
#include <cstddef>
#include <map>

namespace check {

namespace {

constexpr double level = 0.01;          // of a statement that may hold by chance
constexpr std::size_t fewest = 4;       // scenes with a verdict, for any statement
using Scenes = std::vector<bool>;       // one entry per scene: whether it belongs to the set
using Names = std::vector<std::string>; // phrases that describe one and the same set

/// Sets of scenes, each with all phrases that describe it, in the order of the features.
struct Described {
    Scenes scenes;
    Names names;
};

std::size_t size_of(const Scenes& scenes)
{
    return static_cast<std::size_t>(std::count(scenes.begin(), scenes.end(), true));
}

bool contains(const Scenes& whole, const Scenes& part)
{
    for (std::size_t i = 0; i < whole.size(); ++i)
        if (part[i] && !whole[i]) return false;
    return true;
}

void add(std::vector<Described>& sets, Scenes scenes, std::string name)
{
    const auto known = std::ranges::find(sets, scenes, &Described::scenes);
    if (known != sets.end())
        known->names.push_back(std::move(name));
    else
        sets.push_back({std::move(scenes), {std::move(name)}});
}

std::vector<Described> with_one_feature(const std::vector<Judged>& judged)
{
    std::vector<Described> sets;
    for (const Feature& feature : all_features()) {
        Scenes scenes;
        for (const Judged& scene : judged)
            scenes.push_back(scene.features.contains(std::string(feature.name)));
        add(sets, std::move(scenes), std::string(feature.phrase));
    }
    return sets;
}

/// Sets that no single feature describes. Of features with the same scenes the first stands for all.
std::vector<Described> with_two_features(const std::vector<Described>& single)
{
    std::vector<Described> sets;
    for (std::size_t a = 0; a < single.size(); ++a)
        for (std::size_t b = a + 1; b < single.size(); ++b) {
            Scenes both = single[a].scenes;
            for (std::size_t i = 0; i < both.size(); ++i) both[i] = both[i] && single[b].scenes[i];
            if (std::ranges::find(single, both, &Described::scenes) != single.end()) continue;
            add(sets, std::move(both), "both " + single[a].names[0] + " and " + single[b].names[0]);
        }
    return sets;
}

std::string all_scenes(std::size_t count)
{
    if (count == 1) return "The only scene";
    return count == 2 ? "Both scenes" : "All " + std::to_string(count) + " scenes";
}

std::string exactly(const Described& set, std::size_t failed, std::size_t passed)
{
    return all_scenes(failed) + " with " + name_list(set.names, " or ") +
           (failed == 1 ? " fails, and " : " fail, and ") +
           (passed == 1 ? "the only other one passes."
                        : "the " + std::to_string(passed) + " others pass.");
}

/// The chance that `failed` scenes, drawn at random of `all`, are all among `marked` of them: binomial
/// coefficients (marked over failed) / (all over failed).
double chance_of_containment(std::size_t failed, std::size_t marked, std::size_t all)
{
    double chance = 1.0;
    for (std::size_t i = 0; i < failed; ++i)
        chance *= static_cast<double>(marked - i) / static_cast<double>(all - i);
    return chance;
}

} // namespace

std::string name_list(const std::vector<std::string>& names, const char* last)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? last : ", ") + names[i];
    return text;
}

std::vector<std::string> common_causes(const std::vector<Judged>& scenes)
{
    Scenes failing;
    for (const Judged& scene : scenes) failing.push_back(scene.failed);
    const std::size_t failed = size_of(failing);
    const std::size_t passed = scenes.size() - failed;
    if (failed == 0 || passed == 0 || scenes.size() < fewest) return {};

    const std::vector<Described> single = with_one_feature(scenes);
    for (const Described& set : single)
        if (set.scenes == failing) return {exactly(set, failed, passed)};

    const auto by_chance = [&](const Described& set, const std::vector<Described>& tried) {
        return chance_of_containment(failed, size_of(set.scenes), scenes.size()) *
               static_cast<double>(tried.size());
    };
    const std::vector<Described> pairs = with_two_features(single);
    for (const Described& set : pairs)
        if (set.scenes == failing && by_chance(set, pairs) <= level)
            return {exactly(set, failed, passed)};

    const Described* smallest = nullptr;
    for (const Described& set : single)
        if (contains(set.scenes, failing) && by_chance(set, single) <= level &&
            (smallest == nullptr || size_of(set.scenes) < size_of(smallest->scenes)))
            smallest = &set;
    if (smallest == nullptr) return {};
    return {"All " + std::to_string(failed) + " failing scenes are among the " +
            std::to_string(size_of(smallest->scenes)) + " with " + name_list(smallest->names, " or ") +
            "."};
}

} // namespace check
