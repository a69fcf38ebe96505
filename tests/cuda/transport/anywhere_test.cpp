// Scenes of any size and at any place give the same picture, although floats have only seven digits.

#include "cuda/launch/renderer.h"
#include "scenes/bounds.h"
#include "tests/ref/transport/changed_scene.h"
#include "tests/ref/transport/scene_files.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace {

std::vector<scenes::Scene> all_scenes()
{
    std::vector<scenes::Scene> result;
    for (const auto& file : transport_test::our_scene_files())
        result.push_back(scenes::read_scene(file));
    return result;
}

images::Image picture_of(const scenes::Scene& scene)
{
    images::RenderOptions options;
    options.max_edges = 6;
    options.deterministic = true;
    return fast::host_renderer(scene, 24, 16, options, 1)->render_batch(0, {})->mean;
}

double diameter(const scenes::Scene& scene)
{
    const auto box = scenes::bounds(scene);
    return box ? glm::length(box->max - box->min) : 0.0;
}

/// The fraction of pixels that differ by more than a thousandth. The same random numbers make the same
/// paths except where rounding decides: at edges that a ray passes within about 2^-20 of the scene's
/// diameter. Curved mirrors or glass can magnify that: a few samples in a thousand.
double share_of_different_pixels(const images::Image& a, const images::Image& b)
{
    int different = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (!(glm::length(a.pixels[i] - b.pixels[i]) <= 1e-3 * glm::length(a.pixels[i]))) ++different;
    return different / static_cast<double>(a.pixels.size());
}

/// Lights without extent are scaled by the square of a length, which must not overflow.
constexpr int largest_exponent = 300;

RC_GTEST_PROP(Anywhere, ScalingByAPowerOfTwoChangesNoBit, ())
{
    static const std::vector<scenes::Scene> scenes = all_scenes();
    const auto& scene = *rc::gen::elementOf(scenes);
    const double factor = std::ldexp(1.0, *rc::gen::inRange(-largest_exponent, largest_exponent));
    RC_ASSERT(picture_of(transport_test::scaled(scene, factor)) == picture_of(scene));
}

TEST(Anywhere, TheSmallestAndTheLargestSizeOfEverySceneChangeNoBit)
{
    for (const auto& scene : all_scenes())
        for (const int exponent : {-largest_exponent, largest_exponent})
            EXPECT_TRUE(picture_of(transport_test::scaled(scene, std::ldexp(1.0, exponent))) ==
                        picture_of(scene))
                << scene.name << " by 2^" << exponent;
}

RC_GTEST_PROP(Anywhere, ThePictureIsTheSameAtAnySizeAndPlace, ())
{
    static const std::vector<scenes::Scene> scenes = all_scenes();
    const auto& scene = *rc::gen::elementOf(scenes);
    const double factor = std::pow(10.0, *rc::gen::inRange(-30, 31) / 10.0);
    const double distance = diameter(scene) * std::pow(10.0, *rc::gen::inRange(0, 41) / 10.0);
    const auto changed = transport_test::scaled(
        transport_test::moved(scene, distance * scenes::Vec3(0.6, -0.64, 0.48)), factor);
    // One pixel in 50, each of four samples with up to 40 contributions.
    RC_ASSERT(share_of_different_pixels(picture_of(scene), picture_of(changed)) <= 0.02);
}

} // namespace
