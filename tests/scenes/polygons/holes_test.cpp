#include "scenes/polygons/holes.h"

#include "tests/scenes/polygons/shapes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace {

using transport_test::Ring;
using transport_test::Shape;
using transport_test::WholePoint;

Shape any_shape()
{
    Shape shape = transport_test::any_shape_with_holes(15, 5);
    for (std::size_t i = 1; i < shape.size(); ++i)
        if (transport_test::twice_area(shape[i]) > 0) std::reverse(shape[i].begin(), shape[i].end());
    return shape;
}

std::optional<Ring> join(const Shape& shape)
{
    const std::vector<Ring> rings = transport_test::rings_of(shape);
    return scenes::polygons::join_holes(transport_test::points_of(shape), rings[0],
                                        {rings.begin() + 1, rings.end()});
}

RC_GTEST_PROP(JoinHoles, TheWalkHasEveryEdgeOnceAndEveryBridgeThereAndBack, ())
{
    const Shape shape = any_shape();
    const auto walk = join(shape);
    RC_ASSERT(walk.has_value());
    const std::size_t corners = transport_test::all_corners(shape).size();
    const std::size_t holes = shape.size() - 1;
    RC_ASSERT(walk->size() == corners + 2 * holes);

    std::map<std::pair<std::uint32_t, std::uint32_t>, int> steps;
    for (std::size_t i = 0; i < walk->size(); ++i)
        ++steps[{(*walk)[i], (*walk)[(i + 1) % walk->size()]}];
    std::size_t bridges = 0;
    for (const auto& [step, count] : steps) {
        RC_ASSERT(count == 1);
        if (steps.contains({step.second, step.first})) ++bridges;
    }
    RC_ASSERT(bridges == 2 * holes);
    RC_ASSERT(std::set<std::uint32_t>(walk->begin(), walk->end()).size() == corners);
}

RC_GTEST_PROP(JoinHoles, BridgesCrossNothing, ())
{
    const Shape shape = any_shape();
    const std::vector<Ring> walk = {join(shape).value()};
    RC_LOG(transport_test::text_of(shape));
    RC_ASSERT(!scenes::polygons::cross(transport_test::points_of(shape), walk));
}

TEST(JoinHoles, AHoleOutsideIsNotReached)
{
    EXPECT_FALSE(join({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{-3, 1}, {-1, 1}, {-2, 2}}}));
}

} // namespace
