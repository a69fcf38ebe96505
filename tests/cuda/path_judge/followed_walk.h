#pragma once

// A walk of the fast path, followed step by step in double precision.
//
// Two walks in different precision drift apart, on spheres by a factor at every bounce, until they go
// different ways; how far is a matter of the whole walk, and a bound that grows so is soon a bound no
// more. So no walk is compared with another. Each step is: from the very vertex that the floats have
// come to, exactly as they hold it, the reference takes the next step, and the floats' next vertex must
// be that, to within what one step can round (path_rounding.h). Then the next step starts from the
// floats' own vertex. By induction the whole walk is right, however long; and where a ray passes an edge
// within its rounding, either side is right, and no walk is lost to it.

#include "cuda/parallel/vec.h"
#include "ref/transport/subpath.h"
#include "tests/cuda/path_judge/walk_recorder.h"

#include <stdexcept>
#include <vector>

namespace cuda_test {

/// The fast path has done what no rounding explains.
class Disagreement : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A decision was so close to its threshold that either outcome is right, and what follows from it is
/// not followed.
class Undecided : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A connection so nearly in the plane of a surface that rounding decides whether there is one. It may
/// be missing; a value above `most` is a Disagreement.
struct Grazing {
    ref::Rgb most;
};

/// Throws Disagreement.
void require(bool condition, const char* otherwise);

/// What a sample is followed by.
struct Setting {
    const ref::World& world; // of a float_scene
    ref::PathOptions options;
    ref::SampleId id;
};

/// The reference's numbers with the bits that floats have (uniforms_test.cpp).
ref::Uniforms float_uniforms(const ref::SampleId& id, ref::Event event, std::uint32_t j = 0);

/// The surface at `position`, with the normal and the clearance that the floats have there.
ref::SurfacePoint surface_of(const ref::World& world, const gpu::SurfacePoint& point);

struct Range {
    double low, high;
};

/// How far from the primitive, in floats, a ray may begin that leaves it at `p` (clearance.h), with
/// a thousandth for rounding.
Range clearance_of(const ref::World& world, std::uint32_t primitive, const ref::Vec3& p,
                   const ref::Vec3& normal);

/// Throws Disagreement unless `point` lies on its primitive and has its normal and a sensible clearance.
void require_on_surface(const ref::World& world, const gpu::SurfacePoint& point);

/// Bound on the error of the normal of a primitive, where it is computed from the primitive itself.
double normal_error(const ref::World& world, const ref::SurfacePoint& point);

/// How far the floats' point of an emitter may be from `drawn`, the reference's by the same numbers.
double drawn_point_error(const ref::World& world, const ref::SurfacePoint& drawn);

/// A walk as the floats went it, in double.
struct FollowedWalk {
    std::vector<ref::Vertex> vertices; // v_0, v_1, ...: alpha is the reference's
    std::vector<double> turned;      // [i]: angle between the direction that was sampled at v_{i-1} and
                                     // that of v_i seen from it, which clearances turn a little
    std::vector<double> alpha_error; // relative bound
};

/// The light walk of a sample; empty if no emitter has power.
FollowedWalk followed_light_walk(const Setting& setting, const RecordedSample& sample,
                                 std::size_t most_vertices);

/// The eye walk.
FollowedWalk followed_eye_walk(const Setting& setting, const RecordedSample& sample);

/// Where a walk goes next: the ray, how far the floats' may be from it, and what it carries.
struct NextStep {
    ref::Vec3 origin;
    double slack;
    ref::Vec3 direction;
    double error;
    ref::Rgb alpha;
    double alpha_error;
};

/// Follows `recorded` from `step` on. `bounce`: from the reference's next step and its alternatives.
/// Appends to `walk`.
void follow(const Setting& setting, ref::Transport carried, const RecordedSample::Walk& recorded,
            std::size_t most_vertices, NextStep step, FollowedWalk& walk);

/// How a walk may go on from its vertex v_n: more than one way only where a lobe is drawn within
/// rounding of the border of two; none if it ends.
std::vector<NextStep> next_steps(const Setting& setting, ref::Transport carried,
                                 const gpu::WalkVertex& vertex, const NextStep& last);

} // namespace cuda_test
