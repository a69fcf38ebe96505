#pragma once

// A walk of the fast path, followed step by step in double precision.
//
// Two walks in different precision drift apart, on spheres by a factor at every bounce, until they
// take different directions. A bound on their distance would depend on the whole walk, and would soon
// be too large to be useful. So no two walks are compared. Instead each step is compared: the
// reference takes the next step from the fast path's vertex, exactly as the fast path stores it, and
// the fast path's next vertex must agree within the rounding of one step (path_rounding.h). The step
// after that starts from the fast path's own vertex again. By induction the whole walk is right,
// however long it is. Where a ray passes an edge within its rounding, either side is right, and the
// walk can still be followed.

#include "cuda/parallel/vec.h"
#include "ref/transport/subpath.h"
#include "tests/cuda/path_judge/walk_recorder.h"

#include <stdexcept>
#include <vector>

namespace path_judge_test {

/// A result of the fast path that rounding cannot explain.
class Disagreement : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A decision was so close to its threshold that either outcome is right. The steps that depend on it
/// are not followed.
class Undecided : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A connection so nearly in the plane of a surface that rounding decides whether it exists. It may be
/// missing; a value above `most` is a Disagreement.
struct Grazing {
    ref::Rgb most;
};

/// Throws Disagreement with the message `otherwise` unless `condition` holds.
void require(bool condition, const char* otherwise);

/// The scene and options of a sample to be followed.
struct Setting {
    const ref::World& world; // of a float_scene
    ref::PathOptions options;
    ref::SampleId id;
};

/// The reference's numbers, reduced to the bits that floats have (uniforms_test.cpp).
ref::Uniforms float_uniforms(const ref::SampleId& id, ref::Event event, std::uint32_t j = 0);

/// The surface at `position`, with the fast path's normal and clearance.
ref::SurfacePoint surface_of(const ref::World& world, const fast::SurfacePoint& point);

struct Range {
    double low, high;
};

/// The distances from the primitive at which a ray of the fast path may start that leaves it at `p`
/// (clearance.h), with a thousandth for rounding.
Range clearance_of(const ref::World& world, std::uint32_t primitive, const ref::Vec3& p,
                   const ref::Vec3& normal);

/// Throws Disagreement unless `point` lies on its primitive and has the right normal and clearance.
void require_on_surface(const ref::World& world, const fast::SurfacePoint& point);

/// A bound on the error of the normal of a primitive, where it is computed from the primitive itself.
double normal_error(const ref::World& world, const ref::SurfacePoint& point);

/// A bound on the distance of the fast path's point of an emitter from `drawn`, the reference's point
/// from the same numbers.
double drawn_point_error(const ref::World& world, const ref::SurfacePoint& drawn);

/// A walk of the fast path, in double.
struct FollowedWalk {
    std::vector<ref::Vertex> vertices; // v_0, v_1, ...: alpha is the reference's
    std::vector<double> turned;      // [i]: angle between the direction that was sampled at v_{i-1} and
                                     // that of v_i seen from it; clearances change it a little
    std::vector<double> alpha_error; // relative bound
};

/// The light walk of a sample; empty if no emitter has power.
FollowedWalk followed_light_walk(const Setting& setting, const RecordedSample& sample,
                                 std::size_t most_vertices);

/// The eye walk.
FollowedWalk followed_eye_walk(const Setting& setting, const RecordedSample& sample);

/// The next step of a walk: its ray, a bound on the distance of the fast path's ray, and its weight.
struct NextStep {
    ref::Vec3 origin;
    double slack;
    ref::Vec3 direction;
    double error;
    ref::Rgb alpha;
    double alpha_error;
};

/// Follows `recorded` from `step` on, with the reference's next step and its alternatives at each
/// bounce, and appends to `walk`.
void follow(const Setting& setting, ref::Transport carried, const RecordedSample::Walk& recorded,
            std::size_t most_vertices, NextStep step, FollowedWalk& walk);

/// The possible next steps of a walk from its vertex v_n: more than one only if the number that
/// chooses the lobe is within rounding of the border of two lobes; empty if the walk ends.
std::vector<NextStep> next_steps(const Setting& setting, ref::Transport carried,
                                 const fast::WalkVertex& vertex, const NextStep& last);

} // namespace path_judge_test
