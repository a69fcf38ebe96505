// Scenes at the ends of the range of doubles, rendered with the program. The picture is right, or a
// message states the problem.

#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <sstream>

namespace {

using namespace cli_test;

using Mean = std::array<double, 3>;

/// A copy of a scene of the repository. A new node that begins with `transform` contains all its nodes.
std::filesystem::path wrapped(const TemporaryFolder& folder, const std::string& scene,
                              const std::string& transform)
{
    std::string text = read_bytes(scene_file(scene));
    const std::size_t open = text.find('>', text.find("<visual_scene")) + 1;
    text.insert(text.rfind("</visual_scene>"), "</node>");
    text.insert(open, "<node id=\"wrapped\">" + transform);
    const std::filesystem::path file = folder / (scene + ".dae");
    write_bytes(file, text);
    return file;
}

Outcome render(const std::filesystem::path& scene, const Arguments& more)
{
    const TemporaryFolder folder;
    return run(Arguments{"render", scene.string(), "-o", (folder / "out.pfm").string(), "--size",
                         "24x16", "-s", "8", "--max-edges", "5", "--json", "-q"} +
               more);
}

Mean mean_of(const Outcome& outcome)
{
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    if (outcome.status != 0) return {};
    return nlohmann::json::parse(outcome.out)["mean_rgb"].get<Mean>();
}

std::string scale(double factor)
{
    std::ostringstream text;
    text.precision(17);
    text << "<scale>" << factor << " " << factor << " " << factor << "</scale>";
    return text.str();
}

TEST(Extremes, ASceneScaledByAPowerOfTwoHasTheSamePictureToTheBit)
{
    const TemporaryFolder folder;
    for (const char* integrator : {"path", "bdpt", "light"})
        for (const char* device : {"ref", "host"}) {
            const Arguments how = {"--integrator", integrator, "--device", device, "-t", "1"};
            const Mean right = mean_of(render(scene_file("cornell_glass"), how));
            EXPECT_GT(right[0], 0.0);
            for (const double factor : {0x1p498, 0x1p-498, 0x1p267})
                EXPECT_EQ(mean_of(render(wrapped(folder, "cornell_glass", scale(factor)), how)), right)
                    << integrator << " " << device << " " << factor;
        }
}

// Rounding differs, so one path in a billion may take another direction. The means agree to 1e-10.
TEST(Extremes, ASceneOfAnySizeHasTheSamePicture)
{
    const TemporaryFolder folder;
    const Arguments how = {"--integrator", "bdpt"};
    const Mean right = mean_of(render(scene_file("cornell_glass"), how));
    for (const double factor : {1e78, 1e150, 1e-80, 1e-100, 1e-150, 1e290, 1e-290}) {
        const Mean mean = mean_of(render(wrapped(folder, "cornell_glass", scale(factor)), how));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(mean[i] / right[i], 1.0, 1e-10) << factor;
    }
}

TEST(Extremes, ASceneTooFarAwayToBeHeldIsRefused)
{
    const TemporaryFolder folder;
    const Arguments how = {"--integrator", "bdpt"};
    const Mean right = mean_of(render(scene_file("cornell_glass"), how));
    // At a distance of 2^20 scene diagonals, a coordinate is rounded to 1e-10 of the scene's size.
    const Mean moved =
        mean_of(render(wrapped(folder, "cornell_glass", "<translate>4e6 -4e6 4e6</translate>"), how));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(moved[i] / right[i], 1.0, 1e-3);
    for (const char* far : {"1e15", "1e17"}) {
        const Outcome outcome = render(
            wrapped(folder, "cornell_glass", std::string("<translate>") + far + " 0 0</translate>"),
            how);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find("so far from the origin"), std::string::npos) << outcome.err;
    }
}

TEST(Extremes, LightThatNoPictureCanHoldIsRefused)
{
    const TemporaryFolder folder;
    std::string text = read_bytes(scene_file("sphere_over_plane"));
    const std::size_t radiance = text.find("<radiance>");
    const std::size_t end = text.find("</radiance>");
    text.replace(radiance, end - radiance, "<radiance>1e308 1e308 1e308");
    write_bytes(folder / "bright.dae", text);
    for (const char* device : {"ref", "host"}) {
        const Outcome outcome = render(folder / "bright.dae", {"--device", device});
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find("a radiance of 1e+308"), std::string::npos) << outcome.err;
    }
}

// Path tracing never finds the light in the glass. The picture is black, and a warning is printed.
TEST(Extremes, ABlackPictureOfASceneWithEmittersIsSaid)
{
    const Outcome path = render(scene_file("point_in_glass"), {"--integrator", "path"});
    EXPECT_EQ(path.status, 0);
    EXPECT_NE(path.err.find("exactly black although the scene has emitters"), std::string::npos)
        << path.err;
    EXPECT_TRUE(nlohmann::json::parse(path.out)["black_despite_emitters"].get<bool>());
    const Outcome light = render(scene_file("point_in_glass"), {"--integrator", "light"});
    EXPECT_EQ(light.err, "");
    EXPECT_FALSE(nlohmann::json::parse(light.out)["black_despite_emitters"].get<bool>());
    EXPECT_EQ(nlohmann::json::parse(light.out)["dropped"].get<int>(), 0);
}

TEST(Extremes, TheTreeOfATinySceneCostsWhatTheTreeOfTheSceneCosts)
{
    const TemporaryFolder folder;
    const auto costs = [](const std::filesystem::path& file) {
        const Outcome outcome = run({"bvh", file.string(), "--json", "-q", "--builder", "morton30",
                                     "--size", "24x16", "--repeats", "1"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out)["builders"][0]["sah_cost"].get<double>();
    };
    const double right = costs(scene_file("cornell_glass"));
    for (const double factor : {1e-200, 1e200})
        EXPECT_NEAR(costs(wrapped(folder, "cornell_glass", scale(factor))) / right, 1.0, 1e-9) << factor;
}

} // namespace
