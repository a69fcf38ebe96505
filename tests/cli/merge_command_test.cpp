// `plumbline merge`, and the parts that --batches of render and golden makes.

#include "images/exr.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

namespace {

using namespace cli_test;

class Merge : public testing::Test {
protected:
    TemporaryFolder folder;

    [[nodiscard]] std::string file(const std::string& name) const { return (folder / name).string(); }

    /// A render of 11 batches, or of a part of them, into `name`.
    void render(const std::string& name, const Arguments& samples, const Arguments& more = {}) const
    {
        const Outcome outcome =
            run(Arguments{"render", scene_file("cornell_glass"), "-o", file(name), "--size", "12x8",
                          "--integrator", "bdpt", "--max-edges", "4", "--batch", "1", "-q"} +
                samples + more);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    void render_parts(const Arguments& more = {}) const
    {
        for (const char* range : {"0..3", "3..8", "8..11"})
            render(std::string(range) + ".exr", {"--batches", range}, more);
    }
    [[nodiscard]] Outcome merge(const std::vector<std::string>& names, const Arguments& more) const
    {
        Arguments arguments = {"merge"};
        for (const std::string& name : names) arguments.push_back(file(name));
        return run(arguments + more);
    }
    void expect_same_bytes(const std::string& a, const std::string& b) const
    {
        EXPECT_TRUE(read_bytes(folder / a) == read_bytes(folder / b)) << a << " and " << b;
    }
};

TEST_F(Merge, GivesTheBytesOfOneRenderInAnyOrderAndNesting)
{
    render("one.exr", {"-s", "11"}, {"-o", file("one.png")});
    render_parts();
    ASSERT_EQ(merge({"8..11.exr", "0..3.exr", "3..8.exr"},
                    {"-o", file("whole.exr"), "-o", file("whole.png"), "-s", "11"})
                  .status,
              0);
    expect_same_bytes("whole.exr", "one.exr");
    expect_same_bytes("whole.png", "one.png");
    ASSERT_EQ(merge({"8..11.exr", "3..8.exr"}, {"-o", file("late.exr")}).status, 0);
    ASSERT_EQ(merge({"late.exr", "0..3.exr"}, {"-o", file("nested.exr")}).status, 0);
    expect_same_bytes("nested.exr", "one.exr");
    // A render goes on from a merge.
    render("nested.exr", {"-s", "13"}, {"--resume"});
    render("longer.exr", {"-s", "13"});
    expect_same_bytes("nested.exr", "longer.exr");
}

TEST_F(Merge, JoinsStrategiesAndKeptBatches)
{
    render("one.exr", {"-s", "11"}, {"--keep-batches", "--strategies", file("layers.exr")});
    for (const char* range : {"0..3", "3..8", "8..11"})
        render(std::string(range) + ".exr", {"--batches", range},
               {"--keep-batches", "--strategies", file(std::string("l") + range + ".exr")});
    ASSERT_EQ(merge({"8..11.exr", "0..3.exr", "3..8.exr"}, {"-o", file("whole.exr")}).status, 0);
    expect_same_bytes("whole.exr", "one.exr");
    ASSERT_EQ(merge({"l3..8.exr", "l8..11.exr"}, {"-o", file("late.exr")}).status, 0);
    ASSERT_EQ(merge({"late.exr", "l0..3.exr"}, {"-o", file("all.exr"), "--finish"}).status, 0);
    expect_same_bytes("all.exr", "layers.exr");
    // A picture and a file of strategies are different things.
    const Outcome mixed = merge({"0..3.exr", "l3..8.exr"}, {"-o", file("mixed.exr")});
    EXPECT_EQ(mixed.status, 2);
    EXPECT_NE(mixed.err.find("its strategies is 'weighted', not said in the other"), std::string::npos)
        << mixed.err;
}

TEST_F(Merge, WhatDoesNotMakeAWholeIsAnErrorOfOneLineAndLeavesNoFile)
{
    render_parts();
    render("other.exr", {"--batches", "3..8"}, {"--seed", "7"});
    const std::size_t entries = folder.entries();
    const auto expect_error = [&](const std::vector<std::string>& names, const std::string& text,
                                  const Arguments& more = {}) {
        const Outcome outcome = merge(names, Arguments{"-o", file("whole.exr")} + more);
        EXPECT_EQ(outcome.status, 2) << text;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
        EXPECT_EQ(folder.entries(), entries);
    };
    expect_error({"8..11.exr", "0..3.exr"}, "8..11.exr: batches 3..8 are missing before it");
    expect_error({"0..3.exr", "3..8.exr"}, "batches 8..11 are missing after it", {"-s", "11"});
    expect_error({"0..3.exr", "0..3.exr", "3..8.exr"}, "batches 0..3 are also in 0..3.exr");
    expect_error({"0..3.exr", "other.exr"},
                 "is no part of the same render as 0..3.exr: its seed is '7', not '0'");
    expect_error({"0..3.exr", "nowhere.exr"}, "nowhere.exr");
    EXPECT_EQ(merge({"0..3.exr"}, {}).status, 2);
    EXPECT_EQ(merge({"0..3.exr", "3..8.exr"}, {"-o", file("3..8.exr")}).status, 2); // a part itself

    // A part that was cut short, and one with a wrong byte.
    const std::string sound = read_bytes(folder / "3..8.exr");
    write_bytes(folder / "3..8.exr", sound.substr(0, sound.size() - 1));
    expect_error({"0..3.exr", "3..8.exr"}, "3..8.exr: ");
    std::string wrong = sound;
    wrong[sound.size() / 2] = static_cast<char>(wrong[sound.size() / 2] ^ 1);
    write_bytes(folder / "3..8.exr", wrong);
    expect_error({"0..3.exr", "3..8.exr"}, "3..8.exr: is damaged, cut short or changed");
    const Outcome check = merge({"0..3.exr", "3..8.exr"}, {"--check"});
    EXPECT_EQ(check.status, 1);
    EXPECT_NE(check.out.find("0..3.exr: batches 0..3\n"), std::string::npos) << check.out;
    EXPECT_NE(check.out.find("\n" + file("3..8.exr") + ": is damaged"), std::string::npos) << check.out;
    write_bytes(folder / "3..8.exr", sound);
    EXPECT_EQ(merge({"0..3.exr", "3..8.exr"}, {"--check"}).status, 0);
    // A full disk.
    const Outcome full = run({"merge", file("0..3.exr"), file("3..8.exr"), "-o", file("whole.exr")},
                             {.largest_file = 100});
    EXPECT_EQ(full.status, 2);
    EXPECT_EQ(folder.entries(), entries);
}

TEST_F(Merge, RangesThatAreNoneAreRefused)
{
    const auto refused = [&](const Arguments& more) {
        const Outcome outcome =
            run(Arguments{"render", scene_file("cornell_glass"), "-o", file("a.exr"), "-q"} + more);
        return std::pair(outcome.status, outcome.err);
    };
    for (const char* text : {"3", "3..3", "8..3", "a..b", "..3", "-1..3", "0..536870913", ""})
        EXPECT_EQ(refused({"--batches", text}).first, 2) << text;
    EXPECT_NE(refused({"--batches", "3..3"}).second.find("expected A..B for batches A to B - 1"),
              std::string::npos);
    EXPECT_EQ(refused({"--batches", "0..3", "-s", "12"}).first, 2);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST_F(Merge, MakesAGoldenOfItsParts)
{
    const Arguments common = {"golden",      scene_file("cornell_glass"),
                              "--size",      "8x6",
                              "--batch",     "1",
                              "--pilot",     "5",
                              "-s",          "14",
                              "--max-edges", "4",
                              "-q"};
    ASSERT_EQ(run(common + Arguments{"--folder", file("whole")}).status, 0);
    const auto part = [&](const std::string& range, const Arguments& more = {}) {
        return run(common + Arguments{"--batches", range, "-o", file(range + ".exr")} + more);
    };
    ASSERT_EQ(part("0..2").status, 0);
    ASSERT_EQ(part("2..5").status, 0);
    EXPECT_NE(part("5..9").err.find("--pilot-file names the merge of the parts of 0..5"),
              std::string::npos);
    EXPECT_NE(part("3..6").err.find("crosses the end of the pilot"), std::string::npos);
    EXPECT_NE(part("9..15").err.find("a golden of -s 14 ends with batch 13"), std::string::npos);
    EXPECT_NE(part("5..9", {"--pilot-file", file("2..5.exr")}).err.find("the pilot is 0..5"),
              std::string::npos);
    ASSERT_EQ(merge({"2..5.exr", "0..2.exr"}, {"-o", file("pilot.exr")}).status, 0);
    const Arguments with_pilot = {"--pilot-file", file("pilot.exr")};
    ASSERT_EQ(part("5..9", with_pilot).status, 0);
    ASSERT_EQ(part("9..14", with_pilot).status, 0);
    const std::string bytes = read_bytes(folder / "9..14.exr");
    ASSERT_EQ(part("9..14", with_pilot).status, 0); // it is there
    EXPECT_TRUE(read_bytes(folder / "9..14.exr") == bytes);
    const Outcome made = merge({"9..14.exr", "0..2.exr", "5..9.exr", "2..5.exr"},
                               {"-o", file("made.exr"), "-s", "14", "--finish"});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_TRUE(read_bytes(folder / "made.exr") == read_bytes(folder / "whole/cornell_glass.exr"));
    EXPECT_EQ(merge({"9..14.exr", "5..9.exr"}, {"-o", file("x.exr"), "--finish"}).status, 2);
    EXPECT_NE(merge({"0..2.exr", "2..5.exr"}, {"-o", file("x.png")}).err.find("a golden is an .exr"),
              std::string::npos);
}

} // namespace
