// One primitive far away from all others, or far larger: the grid of the Morton codes spans it, too.

#include "extremes/axes/axes.h"
#include "extremes/grey_scene.h"
#include "extremes/trees/tree_rays.h"

#include <cmath>
#include <string>
#include <utility>

namespace extremes {

namespace {

constexpr std::uint32_t triangles_of_outlier = 1u << 13; // with the outlier
constexpr int rays_of_outlier = 64;

/// Small triangles in the unit cube, and one more: a small one around a point whose coordinates are
/// `distance` or its negative, or a large one whose box has this point for its middle.
scenes::Scene scene_with_outlier(double distance, Random& random)
{
    const auto in_cube = [&] {
        return scenes::Vec3(random.uniform(), random.uniform(), random.uniform());
    };
    scenes::Scene scene = grey_scene();
    const auto add_small = [&](const scenes::Vec3& middle) {
        scenes::Triangle triangle{};
        for (scenes::Vec3& vertex : triangle.vertices) vertex = middle + 0.03 * (in_cube() - 0.5);
        scene.triangles.push_back(triangle);
    };
    for (std::uint32_t i = 1; i < triangles_of_outlier; ++i) add_small(in_cube());
    const scenes::Vec3 far = distance * scenes::Vec3(random.sign(), random.sign(), random.sign());
    if (random.below(2) == 0)
        add_small(far);
    else
        scene.triangles.push_back({{scenes::Vec3(2 * far.x, 0, 0), scenes::Vec3(0, 2 * far.y, 0),
                                    scenes::Vec3(0, 0, 2 * far.z)},
                                   0});
    std::swap(scene.triangles.back(), scene.triangles[random.below(triangles_of_outlier)]);
    return scene;
}

void run_outlier(const AnyBuilder& builder, double distance, Random& random, int cases, Tally& tally)
{
    for (int i = 0; i < cases; ++i) {
        const scenes::Scene scene = scene_with_outlier(distance, random);
        const std::vector<ref::Aabb> boxes = ref::primitive_bounds(scene);
        const JudgedTree tree = judged(builder, boxes);
        if (!tree.fault.empty() || tree.depth > depth_bound(builder, boxes.size()) ||
            wrong_rays(builder, scene, rays_of_outlier, random) > 0)
            tally.add(Failure::wrong_order);
        else
            tally.add(lost_order(tree, [&](std::uint32_t a, std::uint32_t b) {
                return boxes[a].lower + boxes[a].upper == boxes[b].lower + boxes[b].upper;
            }));
    }
}

// The grid is at most R + 1 wide along each axis, and a cell w = (R + 1) / 2^b. The other centroids lie
// in the unit cube with a density of at most 1 along each axis, so two of them are in the same cell with
// a probability of at most w^3.
//
// In single precision, the ends of a cell are moved: a centroid is rounded by u, its difference from the
// lower end of the grid by u (R + 1), and the quotient by as much (the ends of the grid are the same for
// all): in all by u 2^b (2 + 1 / (R + 1)) <= 2.5 u 2^b cells at each end. So the cells are at most
// (1 + 5 u 2^b) w wide: 1.625 w for b = 21 and u = 2^-24.
double lost_by_outlier(double distance, int bits, Format format)
{
    const double cells = std::ldexp(1.0, bits);
    const double u = unit_roundoff(format);
    const double w = (1 + 5 * u * cells) * (distance + 1) / cells;
    return lost_order_bound(triangles_of_outlier, w * w * w);
}

} // namespace

Axis outlier_axis()
{
    Axis axis;
    axis.number = 12;
    axis.name = "outlier";
    axis.title = "One primitive far away or far larger";
    axis.parameter = "distance or size of one primitive, relative to the cube that holds all others";
    axis.about =
        "A case is a tree over 8,192 triangles, all in the unit cube except one: that one is far away, "
        "or "
        "it is large and the middle of its box is far away. The error is the share of neighbours, in "
        "the "
        "order of the leaves, that have the same code though they differ. A tree that is not valid or "
        "too "
        "deep is a failure, and so is a ray whose closest hit is not that of a search without a tree "
        "(64 rays in each case).";
    axis.ordinary = 1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(0, 12, 0.5);
    axis.most_cases = 20;
    axis.methods = tree_methods(run_outlier);
    const auto limit = [&](const std::string& method, int bits, Format format, double safe,
                           double beyond) {
        axis.limits.push_back(
            {method, safe, [=](double R) { return lost_by_outlier(R, bits, format); }, beyond,
             Failure::inaccurate,
             "the outlier spans the grid, and the cube of all others has only 2^" +
                 std::to_string(bits) +
                 " / R cells along each axis for 8,191 primitives; the tree stays valid, "
                 "and its rays stay right"});
    };
    limit("ref, morton30", 10, Format::binary64, 8.5, 20);
    limit("ref, morton63", 21, Format::binary64, 19'500, 40'000);
    limit("host, morton30", 10, Format::binary32, 8.5, 20);
    limit("host, morton63", 21, Format::binary32, 12'000, 40'000);
    limit("host, hploc30", 10, Format::binary32, 8.5, 20);
    limit("host, hploc63", 21, Format::binary32, 12'000, 40'000);
    axis.limits.push_back({"ref, sah", 1e12, [](double) { return 0.0; }, no_failure, Failure::inaccurate,
                           "the sweep has no grid; nothing fails up to here, the most that is tried"});
    return axis;
}

} // namespace extremes
