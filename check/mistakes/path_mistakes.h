#pragma once

// What usually goes wrong in light transport, as factors of paths. A wrong renderer that makes a path x
// by the strategies s with weights w_s(x), and multiplies each by an error e_s(x), adds on average
//
//   f(x) sum_s w_s(x) e_s(x)
//
// for it instead of f(x). The sum depends on the path alone. So every mistake is what it adds to the
// light of a right picture, path by path, and one render of a right renderer shows all mistakes at once.

#include "check/mistakes/finished_path.h"

#include <cstddef>
#include <string>
#include <vector>

namespace check {

/// A part of the light: each path counts this many times. May be negative.
using PathFactor = std::function<double(const FinishedPath&)>;

/// A part of the light, times a coefficient.
struct PartOfMistake {
    std::size_t part; // into Mistakes::parts
    double times;
};

struct Mistake {
    std::string is;                  // completes "Your picture is ..."
    std::vector<PartOfMistake> adds; // to a right picture
};

/// Roulette whose survivors are not divided by the probability of survival q: light that took n such
/// decisions is q^n of what it should be.
struct RouletteMistake {
    std::string from; // "from bounce 3 on ...": where and how the decisions are taken
    struct Decisions {
        std::size_t part;
        int count;
    };
    std::vector<Decisions> decisions;
    std::vector<PartOfMistake> adds; // whatever q is

    [[nodiscard]] Mistake with(double q) const;
};

struct Mistakes {
    std::vector<PathFactor> parts;
    std::vector<Mistake> mistakes;
    std::vector<RouletteMistake> roulettes;

    std::size_t add_part(PathFactor factor);
    /// A mistake that adds one part, once.
    void add(std::string is, PathFactor factor);
};

/// All of them for paths of up to `longest` edges in this scene, in the order in which they are named if
/// they cannot be told apart: paths of some lengths, strategies, weights, glass, roulette. Their factors
/// are for paths of up to `longest` + 1 edges.
Mistakes usual_mistakes(const scenes::Scene& scene, int longest);

/// The parts of usual_mistakes, each in a file of its own; `mistakes` gets more of them.
void add_lengths(Mistakes& mistakes, int longest);
void add_strategies(Mistakes& mistakes, int longest);
void add_weights(Mistakes& mistakes, int longest);
void add_refraction(Mistakes& mistakes, int longest);
void add_roulette(Mistakes& mistakes, int longest);

/// A renderer that combines some of the strategies: the weight of strategy s for a path.
using Weights = double (*)(const FinishedPath& path, std::size_t s);

double bidirectional(const FinishedPath& path, std::size_t s);
/// Emission hits and next events, weighted by the balance heuristic; a directly seen emitter by its hit.
double path_tracing(const FinishedPath& path, std::size_t s);
/// Next events, and hits only where next events are impossible or of emitters that are seen directly.
double next_event_first(const FinishedPath& path, std::size_t s);

/// 1 if path tracing has a strategy for the path, else 0.
double found_by_path_tracing(const FinishedPath& path);

/// `factor` for paths of up to `longest` edges, 0 for longer ones.
PathFactor up_to(int longest, PathFactor factor);

} // namespace check
