#pragma once

// Rays that leave surfaces: a ray meets a surface, and the light goes on from there. Which surface does
// it meet next, and where?

#include "extremes/axis.h"
#include "extremes/exact.h"
#include "extremes/grey_scene.h"
#include "scenes/scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace extremes {

/// A ray that is aimed at a primitive, and the direction in which the light goes on from there. Neither
/// direction needs unit length; both have coordinates of about 1.
struct LeaveRay {
    scenes::Vec3 origin, direction;
    std::uint32_t start; // the primitive that the ray meets first (scenes::primitive_count)
    scenes::Vec3 onward;
};

/// Rays in one scene of triangles and spheres, as a file would state it.
struct LeaveCase {
    scenes::Scene scene; // one material
    std::vector<LeaveRay> rays;
    double size; // the length that errors are relative to, in the scene's unit
};

/// The primitive that the light meets next, and how far it goes: in multiples of LeaveRay::onward.
struct Onward {
    std::uint32_t primitive;
    Exact distance;
};

/// The exact answer for a ray: the ray meets LeaveRay::start exactly where it does, and the light goes
/// on from that point to the first of the other primitives, or to the far side of a sphere that it
/// starts in. None if the ray does not meet `start` first, or if the light goes nowhere.
std::optional<Onward> exact_onward(const scenes::Scene& scene, const LeaveRay& ray);

/// Makes a case of `rays` rays for a value of the axis' parameter.
using MakeLeaveCase = LeaveCase (*)(double parameter, Random& random, int rays);

/// A case and the exact answer for each of its rays.
struct AnsweredCase {
    LeaveCase from;
    std::vector<std::optional<Onward>> truths;
};

/// Random cases with `cases` rays in all, 25 in each. The answers cost far more than what any method
/// finds, so the last result of each thread is kept: methods that ask one after the other for the same
/// cases, by equal arguments, share it. It is valid until this thread asks for others.
const std::vector<AnsweredCase>& answered_cases(MakeLeaveCase make, double parameter, Random& random,
                                                int cases);

/// What a method finds.
struct FoundOnward {
    std::optional<std::uint32_t> first, second; // primitives; none where nothing is hit
    Exact distance = 0;                         // to the second, as Onward::distance
    bool finite = true;                         // else the distance is not a number
};

/// Adds a ray to `tally`, as an error or as a failure:
///   missed       the first ray does not find the surface that it is aimed at;
///   self_hit     the light comes back to the surface that it leaves;
///   leaked       it finds nothing, or another surface that is farther away than the true one;
///   wrong_order  it finds another surface that is nearer.
/// Cases are made so that no ray passes near an edge: the true surface is the only right answer.
void judge_onward(const LeaveCase& from, const LeaveRay& ray, const Onward& truth,
                  const FoundOnward& found, Tally& tally);

/// "ref", "host", "cuda" where there is a GPU, and, if `tricks`, the usual tricks in both formats.
std::vector<Method> leave_methods(MakeLeaveCase make, bool tricks = true);

/// The usual tricks alone (leave_tricks.cpp). Without `triangles`, a threshold of determinants does
/// nothing that excluding does not, and is left out.
std::vector<Method> leave_tricks(MakeLeaveCase make, bool triangles = true);

} // namespace extremes
