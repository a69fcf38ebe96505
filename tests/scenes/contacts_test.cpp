// Coincident surfaces, and points on surfaces.

#include "scenes/contacts.h"
#include "scenes/overlapping_boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace {

using scenes::Scene;
using scenes::Vec3;

double any_between(double low, double high)
{
    return low + (high - low) * (*rc::gen::inRange(0, 1 << 30) / double(1 << 30));
}

Vec3 any_point(double half)
{
    return {any_between(-half, half), any_between(-half, half), any_between(-half, half)};
}

/// An orthonormal frame and an origin: walls in files may have any angle.
struct Place {
    Vec3 origin, x, y, z;
    [[nodiscard]] Vec3 operator()(double a, double b, double c) const
    {
        return origin + a * x + b * y + c * z;
    }
};

Place any_place()
{
    const Vec3 z = glm::normalize(any_point(1) + Vec3(0, 0, 3));
    const Vec3 x = glm::normalize(glm::cross(Vec3(0.3, 0.9, 0.1), z));
    return {any_point(2), x, glm::cross(z, x), z};
}

/// The two triangles of a rectangle in the plane at height `c`.
void add_rectangle(Scene& scene, const Place& place, double a0, double b0, double a1, double b1,
                   double c)
{
    const Vec3 v[] = {place(a0, b0, c), place(a1, b0, c), place(a1, b1, c), place(a0, b1, c)};
    scene.triangles.push_back({{v[0], v[1], v[2]}, 0});
    scene.triangles.push_back({{v[0], v[2], v[3]}, 0});
}

std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_of(const scenes::Coincidences& coincident,
                                                           std::uint32_t count)
{
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i < count; ++i)
        for (const std::uint32_t other : coincident.of(i)) pairs.emplace(i, other);
    return pairs;
}

RC_GTEST_PROP(Coincidences, ALampInItsWallCoincidesWithWhatItOverlapsAndNeighboursDoNot, ())
{
    Scene scene;
    const Place place = any_place();
    add_rectangle(scene, place, -2, -2, 2, 2, 0);            // 0, 1: divided by the diagonal
    add_rectangle(scene, place, 2, -2, 3, 2, 0);             // 2, 3: continues the wall beside it
    add_rectangle(scene, place, 0.5, -0.9, 1.5, -0.2, 0);    // 4, 5: a lamp on the right of the diagonal
    add_rectangle(scene, place, 0.5, -0.9, 1.5, -0.2, 1e-9); // 6, 7: clearly in front of it
    const double size = std::ldexp(1.0, *rc::gen::inRange(-500, 500)); // 1e-150 to 1e150
    for (auto& triangle : scene.triangles)
        for (Vec3& v : triangle.vertices) v *= size;
    const auto pairs = pairs_of(scenes::coincidences(scene), 8);
    const std::set<std::pair<std::uint32_t, std::uint32_t>> expected = {{0, 4}, {0, 5}, {4, 0}, {5, 0}};
    RC_ASSERT(pairs == expected);
}

RC_GTEST_PROP(Coincidences, TheBackOfATriangleCoincidesAndWallsAtAnAngleDoNot, ())
{
    Scene scene;
    const Vec3 a = any_point(2);
    const Vec3 b = a + Vec3(1, any_between(0, 1), 0.2);
    const Vec3 c = a + Vec3(any_between(0, 0.5), 0.3, 1);
    scene.triangles.push_back({{a, b, c}, 0});
    scene.triangles.push_back({{a, c, b}, 0});
    scene.triangles.push_back({{a, b, a + Vec3(0.2, 1, 0.5)}, 0}); // shares an edge, at an angle
    scene.triangles.push_back({{a, a, b}, 0});                     // no area
    const std::set<std::pair<std::uint32_t, std::uint32_t>> expected = {{0, 1}, {1, 0}};
    RC_ASSERT(pairs_of(scenes::coincidences(scene), 4) == expected);
}

TEST(Coincidences, SpheresCoincideWhenBothCentreAndRadiusDo)
{
    Scene scene;
    scene.spheres = {{Vec3(1, 2, 3), 0.5, 0},
                     {Vec3(1, 2, 3), 0.5, 0},
                     {Vec3(1, 2, 3), 0.5000001, 0},
                     {Vec3(1, 2, 3.0000001), 0.5, 0}};
    const std::set<std::pair<std::uint32_t, std::uint32_t>> expected = {{0, 1}, {1, 0}};
    EXPECT_EQ(pairs_of(scenes::coincidences(scene), 4), expected);
    scene.spheres.erase(scene.spheres.begin());
    EXPECT_TRUE(scenes::coincidences(scene).empty());
}

TEST(Coincidences, TooManyInOnePlaceAreSaid)
{
    Scene scene;
    for (int i = 0; i < 5000; ++i)
        scene.triangles.push_back({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, 0});
    bool complete = true;
    (void)scenes::coincidences(scene, scenes::double_rounding, &complete);
    EXPECT_FALSE(complete);
}

RC_GTEST_PROP(OverlappingBoxes, AreThoseThatComparingAllPairsFinds, ())
{
    std::vector<scenes::Bounds> boxes;
    const int count = *rc::gen::inRange(0, 300);
    for (int i = 0; i < count; ++i) {
        const Vec3 p = any_point(1);
        const double size = std::exp2(-any_between(0, 8));
        boxes.push_back({p, p + Vec3(size, size * any_between(0, 1), size)});
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
            bool apart = false;
            for (int axis = 0; axis < 3; ++axis)
                apart = apart || boxes[i].max[axis] < boxes[j].min[axis] ||
                        boxes[j].max[axis] < boxes[i].min[axis];
            if (!apart) expected.emplace(i, j);
        }
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    RC_ASSERT(
        scenes::for_each_overlap(boxes, [&](std::uint32_t a, std::uint32_t b) { found.emplace(a, b); }));
    RC_ASSERT(found == expected);
}

RC_GTEST_PROP(SurfacesNear, APointOnAWallIsOnItAndOneBesideItIsOnOneSide, ())
{
    Scene scene;
    const Place place = any_place();
    add_rectangle(scene, place, -1, -1, 1, 1, 0);
    const double a = any_between(-0.9, 0.9);
    const double b = any_between(-0.9, 0.9);
    const bool lower = a - b > 0.01; // of the diagonal from (-1, -1) to (1, 1)
    const bool upper = b - a > 0.01;
    RC_PRE(lower || upper);
    const std::uint32_t number = lower ? 0 : 1;

    const auto on = scenes::surfaces_near(scene, place(a, b, 0));
    RC_ASSERT(on.size() == 1u);
    RC_ASSERT(on[0].primitive == number);
    RC_ASSERT(on[0].side == 0);
    RC_ASSERT(glm::length(on[0].normal - place.z) < 1e-12);

    const double height = (any_between(0, 1) < 0.5 ? -1 : 1) * std::exp2(-any_between(8, 30));
    RC_ASSERT(scenes::surfaces_near(scene, place(a, b, height)).empty());
    const auto near = scenes::surfaces_near(scene, place(a, b, height), 0.005);
    RC_ASSERT(near.size() == 1u);
    RC_ASSERT(near[0].side == (height > 0 ? 1 : -1));
    RC_ASSERT(scenes::surfaces_near(scene, place(1.1, 0.3, 0), 0.05).empty()); // beside the wall
}

TEST(SurfacesNear, ACornerIsOnAllItsWallsAndASphereHasTwoSides)
{
    Scene scene;
    const Place place{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    const Place side{Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
    add_rectangle(scene, place, 0, 0, 1, 1, 0);
    add_rectangle(scene, side, 0, 0, 1, 1, 0);
    scene.spheres.push_back({Vec3(3, 0, 0), 0.5, 0});
    EXPECT_EQ(scenes::surfaces_at(scene, Vec3(0)), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(scenes::surfaces_at(scene, Vec3(3, 0.3, 0.4)), (std::vector<std::uint32_t>{4}));
    EXPECT_EQ(scenes::surfaces_near(scene, Vec3(3, 0, 0.499), 0.01).at(0).side, -1);
    EXPECT_EQ(scenes::surfaces_near(scene, Vec3(3, 0, 0.501), 0.01).at(0).side, 1);
}

TEST(MeetingRank, AnEmitterIsFirstFromItsShiningSideAndLastFromTheOther)
{
    using scenes::meeting_rank;
    const scenes::Material emission = scenes::Emission{scenes::Rgb(1)};
    const scenes::Material matte = scenes::Lambertian{scenes::Rgb(1)};
    const scenes::Material mirror = scenes::Mirror{scenes::Rgb(1)};
    const scenes::Material glass = scenes::Glass{scenes::Rgb(1), scenes::Rgb(1), 1.5};
    for (const bool front : {true, false}) {
        EXPECT_EQ(meeting_rank(matte, front), meeting_rank(mirror, front));
        EXPECT_LT(meeting_rank(matte, front), meeting_rank(glass, front));
    }
    EXPECT_LT(meeting_rank(emission, true), meeting_rank(matte, true));
    EXPECT_GT(meeting_rank(emission, false), meeting_rank(glass, true));
}

TEST(ContactNotices, SayNothingOfABodyThatStandsOnTheGround)
{
    Scene scene;
    scene.material_names = {"ground", "body", "glass"};
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}, scenes::Lambertian{scenes::Rgb(0.2)},
                       scenes::Glass{scenes::Rgb(1), scenes::Rgb(1), 1.5}};
    scene.triangles.push_back({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, 0});
    scene.triangles.push_back({{Vec3(0.1, 0.1, 0), Vec3(0.1, 0.2, 0), Vec3(0.2, 0.1, 0)}, 1});
    EXPECT_FALSE(scenes::coincidences(scene).empty());
    EXPECT_TRUE(scenes::contact_notices(scene).empty());
    std::swap(scene.triangles[1].vertices[1],
              scene.triangles[1].vertices[2]); // faces as the ground does
    EXPECT_EQ(scenes::contact_notices(scene).size(), 1u);
    std::swap(scene.triangles[1].vertices[1], scene.triangles[1].vertices[2]);
    scene.triangles[1].material = 2;
    EXPECT_EQ(scenes::contact_notices(scene).size(), 1u);
}

TEST(ContactNotices, SayThatNoTreePartsWhatIsInOnePlace)
{
    Scene scene;
    scene.material_names = {"wall"};
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}};
    const auto add = [&](int count) {
        for (int i = 0; i < count; ++i)
            scene.triangles.push_back({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, 0});
    };
    add(50);
    EXPECT_TRUE(scenes::contact_notices(scene).empty());
    add(50);
    ASSERT_EQ(scenes::contact_notices(scene).size(), 1u);
    EXPECT_EQ(
        scenes::contact_notices(scene)[0],
        "99 surfaces coincide with triangle 1 (material \"wall\"): no tree can part them, and every "
        "ray that comes near tests them all");
    add(5000);
    ASSERT_EQ(scenes::contact_notices(scene).size(), 1u);
    EXPECT_TRUE(scenes::contact_notices(scene)[0].starts_with("more than 4096 surfaces overlap"));
}

TEST(ContactNotices, NameWhatTouches)
{
    Scene scene;
    scene.material_names = {"wall", "lamp"};
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}, scenes::Emission{scenes::Rgb(1)}};
    const Place place{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    add_rectangle(scene, place, -1, -1, 1, 1, 0);
    EXPECT_TRUE(scenes::contact_notices(scene).empty());
    scene.triangles.push_back({{Vec3(0.5, 0, 0), Vec3(0.6, 0, 0), Vec3(0.6, 0.1, 0)}, 1});
    scene.point_lights.push_back({Vec3(-0.5, 0, 0), scenes::Rgb(1)});
    scene.camera = scenes::Camera{Vec3(0.2, 0.5, 0),
                                  Vec3(1, 0, 0),
                                  Vec3(0, 1, 0),
                                  Vec3(0, 0, 1),
                                  scenes::FovAxis::horizontal,
                                  1.0};
    const std::vector<std::string> notices = scenes::contact_notices(scene);
    ASSERT_EQ(notices.size(), 3u);
    EXPECT_EQ(notices[0],
              "the eye lies on triangle 2 (material \"wall\"): it is not hidden by what it lies on");
    EXPECT_TRUE(notices[1].starts_with("point light 1 lies on triangle 2 (material")) << notices[1];
    EXPECT_TRUE(notices[2].starts_with("1 pair(s) of surfaces coincide, first triangle 1 (material "
                                       "\"wall\") and triangle 3 (material \"lamp\"): a ray"))
        << notices[2];
}

} // namespace
