#pragma once

// Multiple importance sampling for bidirectional path tracing: the weight of every strategy, with a
// constant amount of work per connection. docs/cuda-bdpt.md, section 2, derives it; (1) to (6) are its
// equations. The sums are those of [Georgiev 2012], without vertex merging and with other letters.
//
// Each walk, v_0, v_1, ..., carries sums over the strategies in which the other walk samples its
// vertices. For each vertex, pdf_fwd is the density with which the walk itself samples it, and pdf_rev
// the density with which the other walk would sample it, coming from the other end. Both have the same
// measure, per area on a surface, so their quotient has no unit. The value of pdf_rev of v_{n-1} is
// available one vertex later, at v_n, as a density per solid angle there; the walk has kept the factor
// that converts it to the quotient.

#include "cuda/transport/bsdf.h"
#include "images/render_options.h"

namespace fast {

using images::Heuristic;

/// Keeps sums finite: a weight below the reciprocal has no effect on a sum of floats.
constexpr float largest_sum = 1e30f;

/// A quotient of densities, to the exponent of the heuristic: 1, or 2 for the power heuristic
/// [Veach 1997, sec. 9.2]. At most largest_sum.
template <class F>
HD F raised(Heuristic heuristic, const F& quotient)
{
    // map: power
    return lesser(heuristic == Heuristic::power ? quotient * quotient : quotient, F(largest_sum));
}

/// The sums that a walk carries to its vertex v_n, n >= 1: the bracket B_{n-1} of equation (4), in all
/// versions that differ by roulette. Version m is for a path in which the next m bounces of the other
/// walk, at v_{n-1}, v_{n-2}, ..., are without roulette: their probability to go on is 1.
template <class F>
class RunningSumsOf {
public:
    RunningSumsOf() = default;
    /// At v_1. `joinable` is c_0: whether the other walk can make the whole path, v_0 included (true
    /// for a light walk whose emitter can be hit; false for an eye walk, since a pinhole cannot be
    /// hit). `geometry_over_pdf`: see advance.
    HD RunningSumsOf(const MaskOf<F>& joinable, const F& geometry_over_pdf)
        : geometry_over_pdf_(geometry_over_pdf)
    {
        for (F& version : brackets_) version = select(joinable, F(1.0f), F(0.0f)); // (4), B_0
    }

    /// From v_n to v_{n+1}. `joinable` is c_n: whether v_{n-1} and v_n can be joined.
    /// `pdf_rev_solid_angle`: the density (sr^-1; for a delta lobe as in BsdfSample) with which the
    /// other walk would go on from v_n to v_{n-1}, without roulette. `survival`: the probability that
    /// it goes on from v_n where roulette applies. `geometry_over_pdf`: converts such a density at
    /// v_{n+1} to pdf_rev / pdf_fwd of v_n. It is the cosine at v_n over the squared distance (1 at
    /// infinity) and over the pdf_fwd of v_n; 0 if the other walk cannot reach v_n.
    HD void advance(const MaskOf<F>& joinable, const F& pdf_rev_solid_angle, const F& survival,
                    const F& geometry_over_pdf, Heuristic heuristic)
    {
        // The factor of B_{n-1} in (4): pdf_rev / pdf_fwd of v_{n-1}, without and with roulette.
        const F spared = raised(heuristic, pdf_rev_solid_angle * geometry_over_pdf_);
        const F not_spared = spared * raised(heuristic, survival);
        const F c = select(joinable, F(1.0f), F(0.0f)); // map: impossible
        for (int m = versions - 1; m > 0; --m)          // (4); [Georgiev 2012, eqs. 34 and 35]
            brackets_[m] = lesser(c + spared * brackets_[m - 1], F(largest_sum));
        brackets_[0] = lesser(c + not_spared * brackets_[0], F(largest_sum)); // (4); map: density-ratio
        geometry_over_pdf_ = geometry_over_pdf;
    }

    /// B_n of equation (4), for a path in which v_n is the last vertex of this walk and the other walk
    /// has `other_vertices` >= 0. The other parameters are as in advance; if v_n is at infinity,
    /// `pdf_rev_solid_angle` is instead a density per area across the direction (emitter.h:
    /// pdf_direction).
    [[nodiscard]] HD F bracket(const MaskOf<F>& joinable, const F& pdf_rev_solid_angle,
                               const F& survival, int other_vertices, Heuristic heuristic) const
    {
        // At v_n the other walk would make its bounce number other_vertices.
        const int spared_beyond = bounces_without_roulette - other_vertices; // later, without roulette
        const F chance = spared_beyond >= 0 ? F(1.0f) : survival;
        const F quotient = raised(heuristic, pdf_rev_solid_angle * geometry_over_pdf_ * chance);
        return lesser(select(joinable, F(1.0f), F(0.0f)) +
                          quotient * brackets_[spared_beyond > 0 ? spared_beyond : 0],
                      F(largest_sum)); // (4)
    }

private:
    // bracket() chooses version 4 - other_vertices or version 0; other_vertices is 0 for an emission
    // hit.
    static constexpr int versions = bounces_without_roulette + 1;

    F brackets_[versions]; // B_{n-1}
    F geometry_over_pdf_;  // of v_{n-1}
};
using RunningSums = RunningSumsOf<float>;

/// The last vertex of one walk, y_{s-1} or z_{t-1}, where the strategy joins it to the other walk.
template <class F>
struct SubpathEndOf {
    F pdf_fwd; // > 0: per area; per solid angle at infinity; a probability for a point
    F pdf_rev; // given the last vertices of the other walk, in the measure of pdf_fwd
    F bracket; // B of equation (4) at this vertex
};
using SubpathEnd = SubpathEndOf<float>;

/// S of the end of a light walk, or T of the end of an eye walk.
template <class F>
HD F sum_of_others(Heuristic heuristic, const SubpathEndOf<F>& end)
{
    return raised(heuristic, end.pdf_rev / end.pdf_fwd) * end.bracket; // (3)
}

/// The weight of a strategy, 0 ... 1. S is the sum over the strategies with fewer light vertices, T over
/// those with more.
template <class F>
HD F weight_of_sums(const F& S, const F& T)
{
    return 1.0f / (1.0f + S + T); // (5); [Georgiev 2012, eq. 37]; map: balance
}

/// s = 0, t >= 2: the eye walk hits an emitter at `z`. No light vertex, so S = 0.
template <class F>
HD F emission_hit_weight(Heuristic heuristic, const SubpathEndOf<F>& z)
{
    return weight_of_sums(F(0.0f), sum_of_others(heuristic, z)); // (5); [Georgiev 2012, eqs. 42 and 43]
}

/// s = 1, t >= 2: `z` is joined to a fresh point of an emitter. `pdf_fwd`, `pdf_rev` are those of that
/// point as in SubpathEnd; pdf_rev is 0 if the emitter cannot be hit, which means c_0 = 0.
template <class F>
HD F next_event_weight(Heuristic heuristic, const F& pdf_fwd, const F& pdf_rev, const SubpathEndOf<F>& z)
{
    const F S = raised(heuristic, pdf_rev / pdf_fwd);      // (3) with B_0 = 1; [Georgiev 2012, eq. 44]
    return weight_of_sums(S, sum_of_others(heuristic, z)); // (5); [Georgiev 2012, eq. 45]
}

/// s >= 1, t = 1: `y` is joined to the pinhole. A pinhole cannot be hit, so T = 0.
template <class F>
HD F light_image_weight(Heuristic heuristic, const SubpathEndOf<F>& y)
{
    return weight_of_sums(sum_of_others(heuristic, y), F(0.0f)); // (5); [Georgiev 2012, eqs. 46 and 47]
}

/// s >= 2, t >= 2: `y` is joined to `z`.
template <class F>
HD F inner_connection_weight(Heuristic heuristic, const SubpathEndOf<F>& y, const SubpathEndOf<F>& z)
{
    return weight_of_sums(sum_of_others(heuristic, y),
                          sum_of_others(heuristic, z)); // (5); [Georgiev 2012, eqs. 40 and 41]
}

/// Path tracing has two strategies for a path, emission hit and next event, and uses the balance
/// heuristic. Returns the weight of the strategy with density `pdf`, where the other has `pdf_other`,
/// both in the same measure.
template <class F>
HD F balance_of_two(const F& pdf, const F& pdf_other)
{
    return weight_of_sums(F(0.0f), pdf_other / pdf); // (6); [Veach 1997, sec. 9.2.2]
}

/// Path tracing, s = 0: `pdf_hit` is the density of the emission hit, > 0, and `pdf_next_event` that
/// of a next event at the vertex before, per area of the emitter (per solid angle for the
/// environment). `previous_joinable`: whether there is a next event at that vertex at all.
template <class F>
HD F path_emission_hit_weight(const MaskOf<F>& previous_joinable, const F& pdf_hit,
                              const F& pdf_next_event)
{
    // map: weight-of-hit
    return select(previous_joinable, balance_of_two(pdf_hit, pdf_next_event), F(1.0f)); // (6)
}

/// Path tracing, s = 1. The densities are as above; `pdf_hit` is 0 if the emitter cannot be hit.
template <class F>
HD F path_next_event_weight(const F& pdf_hit, const F& pdf_next_event)
{
    return balance_of_two(pdf_next_event, pdf_hit); // (6); map: weight-of-event
}

} // namespace fast
