#pragma once

// What a sample must contribute, given how its walks went: the reference joins the floats' own vertices.

#include "ref/transport/mis_weight.h"
#include "tests/cuda/path_judge/followed_walk.h"
#include "tests/cuda/path_judge/sight.h"

#include <map>
#include <optional>
#include <string>

namespace cuda_test {

/// What was compared, and what could not be.
struct Tally {
    long samples = 0;
    long contributions = 0;
    long grazing = 0;                            // in the plane of a surface: held to be next to nothing
    long weights_left_open = 0;                  // known to less than a tenth
    std::map<std::string, long> samples_left;    // of which a walk was not followed to its end, and why
    std::map<std::string, long> strategies_left; // (s, t) of a sample that were not compared, and why

    void add(const Tally& other);
    [[nodiscard]] long left() const; // of samples and strategies
    [[nodiscard]] std::string report() const;
};

/// Traces one sample in floats and judges everything about it. Throws Disagreement, with (s, t).
void judge_sample(const Setting& setting, const WalkRecorder& scene, gpu::Integrator integrator,
                  Tally& tally);

/// The contribution of one strategy of a sample by the reference, with bounds of the difference that
/// rounding in the floats explains.
struct ExpectedContribution {
    ref::Rgb value;
    double value_error; // relative
    double weight;
    double weight_error; // absolute; infinite where it is not known
    double x = 0, y = 0; // t = 1: film point, and by how much it may differ
    double film_error = 0;
};

/// Both walks, and what judges them. `found`: whether the floats have such a contribution, for lines of
/// sight that are too close to tell. Each throws Undecided or Disagreement.
class PathJudge {
public:
    PathJudge(const Setting& setting, gpu::Integrator integrator, const FollowedWalk& y,
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
        double normal_error = 0;    // at x_0, besides
    };
    [[nodiscard]] JoinedPath join(std::size_t s, std::size_t t) const;
    [[nodiscard]] double quotient_error(const JoinedPath& x) const;
    void weigh(const JoinedPath& x, std::size_t s, ExpectedContribution& expected) const;
    [[nodiscard]] double path_tracing_weight(const JoinedPath& x, std::size_t s) const;
    /// Relative, of the cosine with `w` at the end of a connection, where `turned` is the angle by which
    /// w may be off. Throws Grazing if its sign is not certain, with `at_most` the value for a cosine
    /// of 1.
    [[nodiscard]] double end_error(const FollowedWalk& walk, std::size_t i, const ref::Vec3& w,
                                   double turned, const ref::Rgb& at_most) const;
    /// What a vertex scatters from a walk, its cosine excluded: where cosines are next to 0, which side
    /// of the surface it is on must not matter.
    [[nodiscard]] ref::Rgb scattered_at_most(const ref::Vertex& vertex) const;
    [[nodiscard]] LineOfSight line_from(const ref::SurfacePoint& point, const ref::Vec3& w) const;

    const Setting& setting_;
    gpu::Integrator integrator_;
    const FollowedWalk& y_;
    const FollowedWalk& z_;
};

} // namespace cuda_test
