// `plumbline explain` and the picture of `plumbline render` with the same options.

#include "images/pfm.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace {

using namespace cli_test;

// A .pfm has floats, so the sum of the strategies of the only sample of a pixel is rounded once.
TEST(ExplainCommand, ExplainsTheSampleOfThePicture)
{
    const TemporaryFolder folder;
    const std::string picture = (folder / "picture.pfm").string();
    const Arguments options = {
        scene_file("cornell_glass"), "--size", "5x4", "--seed", "77", "--max-edges", "7", "-q"};
    const Outcome rendered = run(Arguments{"render"} + options + Arguments{"-o", picture, "-s", "1"});
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    const images::Image image = images::read_pfm(picture);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) {
            const std::string pixel = std::to_string(x) + "," + std::to_string(y);
            const Outcome explained =
                run(Arguments{"explain"} + options + Arguments{"--pixel", pixel, "--json"});
            ASSERT_EQ(explained.status, 0) << explained.err;
            const auto own = nlohmann::json::parse(explained.out)["own"];
            for (int i = 0; i < 3; ++i)
                EXPECT_EQ(static_cast<float>(own[static_cast<std::size_t>(i)].get<double>()),
                          static_cast<float>(image.pixels[static_cast<std::size_t>(5 * y + x)][i]))
                    << pixel;
        }
}

/// The picture by the fast path, and beside the sample of it that of the reference.
TEST(ExplainCommand, ExplainsTheSampleOfTheFastPath)
{
    const TemporaryFolder folder;
    const std::string picture = (folder / "picture.pfm").string();
    const Arguments options = {scene_file("cornell_glass"),
                               "--size",
                               "5x4",
                               "--seed",
                               "77",
                               "--max-edges",
                               "7",
                               "--device",
                               "host",
                               "-q"};
    const Outcome rendered =
        run(Arguments{"render"} + options + Arguments{"--deterministic", "-o", picture, "-s", "1"});
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    const images::Image image = images::read_pfm(picture);
    for (const std::size_t pixel : {0u, 7u, 12u, 19u}) {
        const std::string at = std::to_string(pixel % 5) + "," + std::to_string(pixel / 5);
        const Outcome explained =
            run(Arguments{"explain"} + options + Arguments{"--pixel", at, "--json"});
        ASSERT_EQ(explained.status, 0) << explained.err;
        const auto json = nlohmann::json::parse(explained.out);
        for (int i = 0; i < 3; ++i)
            EXPECT_EQ(json["host"]["own"][static_cast<std::size_t>(i)].get<double>(),
                      image.pixels[pixel][i])
                << at;
        EXPECT_GE(json["host"]["eye_walk"]["vertices"].size(), 2u);
        EXPECT_TRUE(json.contains("eye_walk")) << "of the reference";
    }
    const Outcome uniform =
        run(Arguments{"explain"} + options +
            Arguments{"--pixel", "1,1", "--integrator", "bdpt", "--heuristic", "uniform"});
    EXPECT_EQ(uniform.status, 2);
    EXPECT_NE(uniform.err.find("with --device host: it is for the reference"), std::string::npos);
}

TEST(ExplainCommand, FitsATerminal)
{
    for (const auto& [integrator, device] : {std::pair("path", "ref"), std::pair("bdpt", "ref"),
                                             std::pair("light", "ref"), std::pair("bdpt", "host")}) {
        const Outcome outcome =
            run({"explain", scene_file("all_emitters"), "--pixel", "100,90", "--sample", "2",
                 "--integrator", integrator, "--max-edges", "6", "--device", device});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("Adds to its pixel 100,90: "), std::string::npos) << outcome.out;
        std::istringstream lines(outcome.out);
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 104u) << line;
            EXPECT_FALSE(line.ends_with(' ')) << line;
        }
    }
}

} // namespace
