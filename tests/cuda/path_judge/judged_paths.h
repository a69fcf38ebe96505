#pragma once

// The expected contributions of a sample, given its walks: the reference joins the fast path's
// vertices.

#include "ref/transport/mis_weight.h"
#include "tests/cuda/path_judge/followed_walk.h"
#include "tests/cuda/path_judge/sight.h"

#include <map>
#include <optional>
#include <string>

namespace path_judge_test {

/// Counts of the comparisons, and of those that were impossible.
struct Tally {
    long samples = 0;
    long contributions = 0;
    long grazing = 0;                            // in the plane of a surface: only bounded
    long weights_left_open = 0;                  // known only to a tenth or worse
    std::map<std::string, long> samples_left;    // a walk was not followed to its end; with the reason
    std::map<std::string, long> strategies_left; // (s, t) not compared; with the reason

    void add(const Tally& other);
    [[nodiscard]] long left() const; // of samples and strategies
    [[nodiscard]] std::string report() const;
};

/// Traces one sample on the fast path and judges all of its results. Throws Disagreement, with (s, t).
void judge_sample(const Setting& setting, const WalkRecorder& scene, fast::Integrator integrator,
                  Tally& tally);

/// The contribution of one strategy of a sample by the reference, with bounds of the difference that
/// rounding explains.
struct ExpectedContribution {
    ref::Rgb value;
    double value_error; // relative
    double weight;
    double weight_error; // absolute; infinite if unknown
    double x = 0, y = 0; // t = 1: film point, with film_error
    double film_error = 0;
};

/// Judges the strategies that join two walks. `found`: whether the fast path has such a contribution,
/// for lines of sight that are too close to decide. Each function throws Undecided or Disagreement.
class PathJudge {
public:
    PathJudge(const Setting& setting, fast::Integrator integrator, const FollowedWalk& y,
              const FollowedWalk& z)
        : setting_(setting), integrator_(integrator), y_(y), z_(z)
    {}
    [[nodiscard]] std::optional<ExpectedContribution> emission_hit(std::size_t t) const;
    [[nodiscard]] std::optional<ExpectedContribution> next_event(std::size_t t, bool found) const;
    [[nodiscard]] std::optional<ExpectedContribution> light_image(std::size_t s, bool found) const;
    [[nodiscard]] std::optional<ExpectedContribution> inner_connection(std::size_t s, std::size_t t,
                                                                       bool found) const;

private:
    /// x_0 ... x_k and the angles of its edges.
    struct JoinedPath {
        ref::Path vertices;
        std::vector<double> turned; // [i]: of the edge from x_i to x_{i+1}
        double normal_error = 0;    // at x_0, in addition
    };
    [[nodiscard]] JoinedPath join(std::size_t s, std::size_t t) const;
    [[nodiscard]] double quotient_error(const JoinedPath& x) const;
    void weigh(const JoinedPath& x, std::size_t s, ExpectedContribution& expected) const;
    [[nodiscard]] double path_tracing_weight(const JoinedPath& x, std::size_t s) const;
    /// The relative error of the cosine with `w` at the end of a connection, where w may be off by the
    /// angle `turned`. Throws Grazing if the sign of the cosine is not certain; `at_most` is the value
    /// for a cosine of 1.
    [[nodiscard]] double end_error(const FollowedWalk& walk, std::size_t i, const ref::Vec3& w,
                                   double turned, const ref::Rgb& at_most) const;
    /// The light that a vertex scatters from a walk, without the cosine. It must not depend on the
    /// side of the surface, which is uncertain where cosines are close to 0.
    [[nodiscard]] ref::Rgb scattered_at_most(const ref::Vertex& vertex) const;
    [[nodiscard]] LineOfSight line_from(const ref::SurfacePoint& point, const ref::Vec3& w) const;

    const Setting& setting_;
    fast::Integrator integrator_;
    const FollowedWalk& y_;
    const FollowedWalk& z_;
};

} // namespace path_judge_test
