#pragma once

// Multiple importance sampling with a constant amount of work per connection: sums that a walk carries
// along [Georgiev 2012, for the strategies of bidirectional path tracing].
//
// The literal weight (ref/transport/mis_weight.h computes it) of strategy s for a path x_0 ... x_k is
// 1 / sum_j p_j / p_s, where p_j = c_j prod_{i<j} L_i prod_{i>=j} E_i: L_i and E_i are the densities of
// vertex x_i as the light walk and the eye walk make it, and c_j is 1 if x_{j-1} and x_j can be joined,
// else 0. Almost everything cancels: for j < s the quotient is prod_{j<=i<s} E_i / L_i. Summed from the
// inside out, with s light vertices y_i = x_i,
//
//   S = E_{s-1}/L_{s-1} (c_{s-1} + E_{s-2}/L_{s-2} (c_{s-2} + E_{s-3}/L_{s-3} (... c_0))),
//
// and for j > s the same sum T over the eye vertices, with L and E in each other's place. The weight is
// 1 / (1 + S + T). E_i depends on x_{i+1} and x_{i+2} alone, so that all but the two outermost factors
// of S is known to the light walk before it is joined to anything: that is what it carries.
//
// Roulette makes one exception. E_i holds the chance that the eye walk went on from x_{i+1}, which is 1
// for its first four bounces: so it does depend on how long the eye walk is, but only whether it is 1 or
// not. A walk carries the sum in versions: in number m the m outermost chances are 1, in the order from
// where it will be joined. Two walks choose each other's version by their own lengths.

#include "cuda/transport/material.h"
#include "images/render_options.h"

namespace gpu {

using images::Heuristic;

/// Keeps sums finite: a share below the reciprocal does not show in a sum of floats.
constexpr float largest_sum = 1e30f;

/// What a quotient of densities counts in the sums: itself, or its square for the power heuristic.
HD inline float shared(Heuristic heuristic, float quotient)
{
    return glm::min(heuristic == Heuristic::power ? quotient * quotient : quotient, largest_sum);
}

/// What the walk carries when it is at its vertex v_n, n >= 1, of those before: for either walk, "own"
/// means densities of the walk itself, "other" those of the other walk, were it to come this way.
class RunningSums {
public:
    /// At v_1. `joinable` is c for the strategy that makes all of the path from the other end (from the
    /// light's side 1 if the emitter can be hit; 0 from the eye's: a pinhole cannot). `back` turns the
    /// other walk's density per solid angle at v_1 into its quotient by the own density at v_0: the
    /// cosine at v_0 over squared distance and own density; 0 if v_0 cannot be hit.
    HD RunningSums(bool joinable, float back, float own) : back_(back), own_(own)
    {
        for (float& version : inner_) version = joinable ? 1.0f : 0.0f;
    }

    /// From v_n to v_{n+1}. `joinable`: whether v_{n-1} and v_n could be joined. `other`: density per
    /// solid angle with which the other walk would go on from v_n to v_{n-1}, without the chance that it
    /// does, which is `survival` unless it is 1. `back`, `own`: as above, for v_n and v_{n+1}.
    HD void advance(bool joinable, float other, float survival, float back, float own,
                    Heuristic heuristic)
    {
        const float passed = shared(heuristic, other * back_);
        const float ended = passed * shared(heuristic, survival);
        const float join = joinable ? 1.0f : 0.0f;
        for (int m = versions - 1; m > 0; --m)
            inner_[m] = glm::min(join + passed * inner_[m - 1], largest_sum);
        inner_[0] = glm::min(join + ended * inner_[0], largest_sum);
        back_ = back;
        own_ = own;
    }

    /// S, or T, of a path in which v_n is the last of this walk, before it could be told what is beyond:
    /// all but the outermost factor. `others`: how many vertices the other walk has; the rest as above.
    [[nodiscard]] HD float without_last_factor(bool joinable, float other, float survival, int others,
                                               Heuristic heuristic) const
    {
        const int free = bounces_without_roulette - others; // bounces beyond v_n that roulette spares
        const float chance = free >= 0 ? 1.0f : survival;
        const float passed = shared(heuristic, other * back_ * chance);
        return glm::min((joinable ? 1.0f : 0.0f) + passed * inner_[free > 0 ? free : 0], largest_sum);
    }

    /// The density with which the walk found v_n: per area, or per solid angle at infinity.
    [[nodiscard]] HD float own() const { return own_; }

private:
    // A light walk (none at all for an emission hit) leaves the eye's sum up to four.
    static constexpr int versions = bounces_without_roulette + 1;

    float inner_[versions];
    float back_;
    float own_;
};

} // namespace gpu
