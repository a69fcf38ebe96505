// Strategies that are missing or count twice.

#include "check/mistakes/path_mistakes.h"

#include <algorithm>
#include <array>

namespace check {

namespace {

/// Whether strategy (s, t) belongs to a family (ref/transport/connect.h).
struct Family {
    const char* name;
    bool plural;
    bool (*contains)(std::size_t s, std::size_t t);
};

constexpr std::array<Family, 4> families = {
    Family{"emission hits (s = 0)", true, [](std::size_t s, std::size_t) { return s == 0; }},
    Family{"next events (s = 1, t >= 2)", true,
           [](std::size_t s, std::size_t t) { return s == 1 && t >= 2; }},
    Family{"the light image (t = 1)", false, [](std::size_t, std::size_t t) { return t == 1; }},
    Family{"inner connections (s, t >= 2)", true,
           [](std::size_t s, std::size_t t) { return s >= 2 && t >= 2; }}};

/// `part` of the light, which `name` makes, is missing, or counts twice.
void add_missing_and_twice(Mistakes& mistakes, const std::string& name, bool plural, std::size_t part)
{
    mistakes.mistakes.push_back({"one without " + name + ", with the weights of the others as if " +
                                     (plural ? "they were" : "it were") + " there",
                                 {{part, -1.0}}});
    mistakes.mistakes.push_back(
        {"one in which " + name + (plural ? " count twice" : " counts twice"), {{part, 1.0}}});
}

/// The share of the family's strategies in the path.
double share_of(const Family& family, const FinishedPath& path)
{
    double sum = 0.0;
    for (std::size_t s = 0; s <= path.edges(); ++s)
        if (family.contains(s, path.edges() + 1 - s)) sum += path.share(s);
    return sum;
}

bool only_it_makes(const Family& family, const FinishedPath& path)
{
    for (std::size_t s = 0; s <= path.edges(); ++s)
        if (path.possible[s] && !family.contains(s, path.edges() + 1 - s)) return false;
    return true;
}

} // namespace

void add_strategies(Mistakes& mistakes, int longest)
{
    // With weights that are right without them, only light that has no other strategy is missing.
    mistakes.add(
        "one of path tracing, which has no strategy for some of the light",
        up_to(longest, [](const FinishedPath& path) { return found_by_path_tracing(path) - 1.0; }));
    for (const Family& family : families)
        mistakes.add(std::string("one without ") + family.name +
                         ", which has no other strategy for some of the light",
                     up_to(longest, [family](const FinishedPath& path) {
                         return only_it_makes(family, path) ? -1.0 : 0.0;
                     }));
    for (const Family& family : families)
        add_missing_and_twice(mistakes, family.name, family.plural,
                              mistakes.add_part(up_to(longest, [family](const FinishedPath& path) {
                                  return share_of(family, path);
                              })));
    for (std::size_t k = 1; k <= static_cast<std::size_t>(longest); ++k)
        for (std::size_t s = 0; s <= k; ++s)
            add_missing_and_twice(mistakes,
                                  "strategy (s, t) = (" + std::to_string(s) + ", " +
                                      std::to_string(k + 1 - s) + ")",
                                  false, mistakes.add_part([k, s](const FinishedPath& path) {
                                      return path.edges() == k ? path.share(s) : 0.0;
                                  }));
}

} // namespace check
