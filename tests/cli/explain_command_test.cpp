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

TEST(ExplainCommand, FitsATerminal)
{
    for (const char* integrator : {"path", "bdpt", "light"}) {
        const Outcome outcome = run({"explain", scene_file("all_emitters"), "--pixel", "100,90",
                                     "--sample", "2", "--integrator", integrator, "--max-edges", "6"});
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
