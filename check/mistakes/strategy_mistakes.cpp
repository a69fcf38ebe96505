// Strategies that are missing or count twice.

#include "check/mistakes/path_mistakes.h"

#include <algorithm>
#include <array>

namespace check {

namespace {

/// Whether strategy (s, t) belongs to a family (ref/transport/connect.h).
struct Family {
    const char* name;
    bool (*contains)(std::size_t s, std::size_t t);
};

constexpr std::array<Family, 4> families = {
    Family{"emission hits (s = 0)", [](std::size_t s, std::size_t) { return s == 0; }},
    Family{"next events (s = 1, t >= 2)", [](std::size_t s, std::size_t t) { return s == 1 && t >= 2; }},
    Family{"the light image (t = 1)", [](std::size_t, std::size_t t) { return t == 1; }},
    Family{"inner connections (s, t >= 2)",
           [](std::size_t s, std::size_t t) { return s >= 2 && t >= 2; }}};

/// `part` of the light is missing, or counts twice.
void add_missing_and_twice(Mistakes& mistakes, const std::string& missing, const std::string& twice,
                           std::size_t part)
{
    mistakes.mistakes.push_back({missing, {{part, -1.0}}});
    mistakes.mistakes.push_back({twice, {{part, 1.0}}});
}

} // namespace

void add_strategies(Mistakes& mistakes, int longest)
{
    // With weights that are right without them: only light that has no other strategy is missing.
    mistakes.mistakes.push_back(
        {"one of path tracing, which has no strategy for some of the light",
         {{mistakes.add_part(up_to(longest, found_by_path_tracing)), 1.0},
          {mistakes.add_part(up_to(longest, [](const FinishedPath&) { return 1.0; })), -1.0}}});
    for (const auto& [name, contains] : families) {
        mistakes.mistakes.push_back(
            {std::string("one without ") + name + ", which has no other strategy for some of the light",
             {{mistakes.add_part(up_to(longest,
                                       [contains = contains](const FinishedPath& path) {
                                           for (std::size_t s = 0; s <= path.edges(); ++s)
                                               if (path.possible[s] &&
                                                   !contains(s, path.edges() + 1 - s))
                                                   return 0.0;
                                           return 1.0;
                                       })),
               -1.0}}});
    }
    for (const auto& [name, contains] : families)
        add_missing_and_twice(
            mistakes, std::string("one without ") + name + ", whose weights count them",
            std::string("one in which ") + name + " count twice",
            mistakes.add_part(up_to(longest, [contains = contains](const FinishedPath& path) {
                double sum = 0.0;
                for (std::size_t s = 0; s <= path.edges(); ++s)
                    if (contains(s, path.edges() + 1 - s)) sum += path.share(s);
                return sum;
            })));
    for (std::size_t k = 1; k <= static_cast<std::size_t>(longest); ++k)
        for (std::size_t s = 0; s <= k; ++s) {
            const std::string name =
                "strategy (s, t) = (" + std::to_string(s) + ", " + std::to_string(k + 1 - s) + ")";
            add_missing_and_twice(mistakes, "one without " + name + ", whose weights count it",
                                  "one in which " + name + " counts twice",
                                  mistakes.add_part([k, s](const FinishedPath& path) {
                                      return path.edges() == k ? path.share(s) : 0.0;
                                  }));
        }
}

} // namespace check
