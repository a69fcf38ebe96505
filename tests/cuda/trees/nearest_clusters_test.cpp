// The nearest neighbours in a list of clusters (nearest_clusters.h).

#include "cuda/trees/nearest_clusters.h"

#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <tuple>
#include <vector>

namespace {

using fast::Aabb;
using fast::Cluster;
using fast::Vec3;
using trees_test::Random;

constexpr std::uint32_t most_in_list = 32;

/// Boxes of many sizes. Some are equal to another, some are not legal.
std::vector<Cluster> random_list(std::size_t count, Random& random)
{
    constexpr float unbounded = std::numeric_limits<float>::infinity();
    std::vector<Cluster> list;
    for (std::uint32_t slot = 0; slot < count; ++slot) {
        const ref::Vec3 at = random.magnitude(-2, 2) * random.in_cube();
        const Vec3 extent(random.magnitude(-3, 1) * glm::abs(random.in_cube()));
        Aabb box{Vec3(at), Vec3(at) + extent};
        if (slot > 0 && random.below(4) == 0) box = list[random.below(slot)].box;
        if (random.below(40) == 0) box.upper.y = unbounded;
        if (random.below(40) == 0) box.upper[static_cast<int>(random.below(3))] = 1e38f;
        if (random.below(40) == 0) box.lower[static_cast<int>(random.below(3))] = std::nanf("");
        list.push_back({box, slot | 0x8000'0000, slot, 0});
    }
    return list;
}

/// nearest_cluster by its definition: of all pairs with cluster i, the first.
std::uint32_t expected_nearest(const std::vector<Cluster>& list, std::uint32_t i)
{
    using Order = std::tuple<float, std::uint32_t, bool, std::uint32_t>;
    std::optional<Order> first;
    std::uint32_t nearest = (i ^ 1) < list.size() ? i ^ 1 : i - 1;
    for (std::uint32_t j = 0; j < list.size(); ++j) {
        const auto [lower, upper] = std::minmax(i, j);
        const float area = half_area(unite(list[lower].box, list[upper].box));
        if (j == i || upper - lower > fast::search_radius || !std::isfinite(area)) continue;
        const Order order{area, upper - lower, lower % 2 == 1, lower};
        if (first && *first < order) continue;
        first = order;
        nearest = j;
    }
    return nearest;
}

RC_GTEST_PROP(NearestClusters, OneByOneAndAtOnceAreThoseOfTheDefinition, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const std::vector<Cluster> list =
        random_list(*rc::gen::inRange<std::size_t>(2, most_in_list + 1), random);
    const fast::NearestOneByOne<most_in_list> one_by_one(list);
    const fast::NearestAtOnce<most_in_list> at_once(list);
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        RC_ASSERT(one_by_one[i] == expected_nearest(list, i));
        RC_ASSERT(at_once[i] == expected_nearest(list, i));
    }
}

std::vector<std::uint32_t> all_nearest(const std::vector<Cluster>& list)
{
    const fast::NearestAtOnce<most_in_list> nearest(list);
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < list.size(); ++i) result.push_back(nearest[i]);
    return result;
}

/// Boxes of the same size, at these places along an axis.
std::vector<Cluster> in_a_row(std::initializer_list<float> places)
{
    std::vector<Cluster> list;
    for (const float x : places) list.push_back({{Vec3(x, 0, 0), Vec3(x + 1, 1, 1)}, 0, 0, 0});
    return list;
}

TEST(NearestClusters, OfEqualAreasTheOneNearestInTheListIsNearest)
{
    // Cluster 2 has the same area with all others, and the pair (2, 3) begins with an even number.
    EXPECT_EQ(all_nearest(in_a_row({1, 3, 2, 3, 1}))[2], 3u);
    // At the same distance neither pair begins with one: the first.
    EXPECT_EQ(all_nearest(in_a_row({9, 1, 5, 2, 5, 3}))[3], 1u);
    EXPECT_EQ(all_nearest(in_a_row({1, 5, 2, 5, 3}))[2], 0u);
}

TEST(NearestClusters, EqualDistancesInSpaceGivePairs)
{
    EXPECT_EQ(all_nearest(in_a_row({1, 2, 3, 4, 5, 6})), (std::vector<std::uint32_t>{1, 0, 3, 2, 5, 4}));
}

TEST(NearestClusters, EqualBoxesGivePairs)
{
    EXPECT_EQ(all_nearest(in_a_row({1, 1, 1, 1, 1})), (std::vector<std::uint32_t>{1, 0, 3, 2, 3}));
}

TEST(NearestClusters, WithoutAFiniteAreaPartnersAreNearest)
{
    std::vector<Cluster> list = in_a_row({1, 1, 1, 1, 1});
    for (Cluster& cluster : list) cluster.box.upper = Vec3(3e38f);
    EXPECT_EQ(all_nearest(list), (std::vector<std::uint32_t>{1, 0, 3, 2, 3}));
}

} // namespace
