// The nearest neighbours in a list of clusters (nearest_clusters.h).

#include "cuda/trees/nearest_clusters.h"

#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
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

/// nearest_cluster by its definition.
std::uint32_t expected_nearest(const std::vector<Cluster>& list, std::uint32_t i)
{
    if ((i ^ 1) < list.size() && list[i].box.lower == list[i ^ 1].box.lower &&
        list[i].box.upper == list[i ^ 1].box.upper)
        return i ^ 1;
    std::uint32_t best = most_in_list;
    float smallest = std::numeric_limits<float>::infinity();
    for (std::uint32_t j = 0; j < list.size(); ++j) {
        if (j == i || (j > i ? j - i : i - j) > fast::search_radius) continue;
        const float area = half_area(unite(list[i].box, list[j].box));
        if (best == most_in_list || area < smallest) best = j;
        if (area < smallest) smallest = area;
    }
    return best;
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

TEST(NearestClusters, OfEqualAreasTheFirstIsNearest)
{
    std::vector<Cluster> list(5);
    const float at[] = {1, 3, 2, 3, 1};
    for (std::uint32_t i = 0; i < 5; ++i) list[i].box = {Vec3(at[i], 0, 0), Vec3(at[i] + 1, 1, 1)};
    const fast::NearestAtOnce<most_in_list> nearest(list);
    EXPECT_EQ(nearest[2], 0u); // all four others have the same area with it
    EXPECT_EQ(nearest[0], 4u); // equal boxes, but not of a pair: no area is smaller
    EXPECT_EQ(nearest[1], 3u);
}

TEST(NearestClusters, OfEqualBoxesInPairsThePairIsNearest)
{
    const std::vector<Cluster> list(7, Cluster{{Vec3(0), Vec3(1)}, 0, 0, 0});
    const fast::NearestAtOnce<most_in_list> nearest(list);
    for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(nearest[i], i ^ 1);
    EXPECT_EQ(nearest[6], 0u); // without a partner
}

} // namespace
