// Options of the reference alone: they reach it, the file says so, and a render with others does not
// continue it.

#include "images/exr.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace {

using namespace cli_test;

class ReferenceOptions : public testing::Test {
protected:
    TemporaryFolder folder;

    [[nodiscard]] Arguments render(const std::string& picture, const Arguments& more) const
    {
        return Arguments{"render",       scene_file("cornell_glass"),
                         "-o",           (folder / picture).string(),
                         "--integrator", "bdpt",
                         "--size",       "24x16",
                         "-s",           "8",
                         "--max-edges",  "9"} +
               more;
    }

    /// The picture by these options, which must be another one than that by default. Its file must have
    /// the entry `key` with `value`, and neither render may continue the other.
    void expect_another_picture(const Arguments& option, const std::string& key,
                                const std::string& value)
    {
        ASSERT_EQ(run(render("plain.exr", {})).status, 0);
        const Outcome outcome = run(render("other.exr", option));
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const images::ExrPicture plain = images::read_exr(folder / "plain.exr");
        const images::ExrPicture other = images::read_exr(folder / "other.exr");
        EXPECT_FALSE(plain.mean == other.mean);
        ASSERT_TRUE(other.metadata.contains(key));
        EXPECT_EQ(other.metadata.at(key), value);
        const Outcome with = run(render("plain.exr", option + Arguments{"--resume"}));
        EXPECT_EQ(with.status, 2);
        EXPECT_NE(with.err.find("its " + key + " is "), std::string::npos) << with.err;
        const Outcome without = run(render("other.exr", {"--resume"}));
        EXPECT_EQ(without.status, 2);
        EXPECT_NE(without.err.find("its " + key + " is '" + value + "', not "), std::string::npos)
            << without.err;
        EXPECT_EQ(run(render("other.exr", option + Arguments{"--resume"})).status, 0);
    }
};

TEST_F(ReferenceOptions, WithoutLeavesFamiliesOut)
{
    expect_another_picture({"--without", "light_image"}, "without", "light_image");
    // In any order, and an option of its own each: what follows is the scene.
    ASSERT_EQ(run(render("a.exr", {"--without", "light_image", "--without", "next_event"})).status, 0);
    ASSERT_EQ(run(render("b.exr", {"--without", "next_event", "--without", "light_image"})).status, 0);
    EXPECT_EQ(read_bytes(folder / "a.exr"), read_bytes(folder / "b.exr"));
    EXPECT_EQ(images::read_exr(folder / "a.exr").metadata.at("without"), "next_event light_image");
    EXPECT_EQ(run({"render", "-o", (folder / "c.exr").string(), "--size", "6x4", "-s", "4", "--without",
                   "next_event", scene_file("cornell_glass")})
                  .status,
              0);
}

TEST_F(ReferenceOptions, UniformIsAHeuristic)
{
    expect_another_picture({"--heuristic", "uniform"}, "heuristic", "uniform");
}

TEST_F(ReferenceOptions, RouletteFromIsTheFirstBounceThatItMayEnd)
{
    expect_another_picture({"--roulette-from", "2"}, "roulette_from", "2");
}

} // namespace
