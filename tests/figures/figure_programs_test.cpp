// The programs that make figures and tables print their usage, and refuse unknown arguments.

#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace {

using namespace cli_test;

class FigureProgram : public testing::TestWithParam<const char*> {
protected:
    [[nodiscard]] static Outcome run_figure(const Arguments& arguments)
    {
        const auto folder = std::filesystem::path(PLUMBLINE_PROGRAM).parent_path();
        return run(arguments, {.program = (folder / GetParam()).string()});
    }
};

INSTANTIATE_TEST_SUITE_P(All, FigureProgram,
                         testing::Values("figure_epsilon", "figure_equal_time", "figure_fast_transport",
                                         "figure_ladder", "figure_leaving", "figure_tree_by_hand",
                                         "figure_uniform_weights"),
                         [](const auto& program) { return std::string(program.param); });

TEST_P(FigureProgram, SaysHowItIsCalled)
{
    const Outcome help = run_figure({"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_NE(help.out.find("Usage: " + std::string(GetParam())), std::string::npos) << help.out;
    EXPECT_EQ(help.out.find('|'), std::string::npos) << "a table";
}

TEST_P(FigureProgram, RefusesUnknownArguments)
{
    for (const Arguments& arguments : {Arguments{"--brighter", scene_file("point_over_plane"), "a.png"},
                                       {"a", "b.png", "c", "--d"}}) {
        const Outcome outcome = run_figure(arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("--help"), std::string::npos) << outcome.err;
    }
}

/// The cells of each line of a table.
std::vector<std::vector<std::string>> cells_of(const std::string& table)
{
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, '|');) rows.back().push_back(cell);
    }
    return rows;
}

TEST(EqualTime, MakesATableWithIntervalsAndAVerdictThatFollowsFromThem)
{
    const Outcome outcome = run({scene_file("point_over_plane"), scene_file("cornell_glass"), "--rounds",
                                 "2", "--seconds", "0.01", "--reference-seconds", "0.02"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto rows = cells_of(outcome.out);
    ASSERT_EQ(rows.size(), 4u) << outcome.out; // head, line, two scenes
    for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size()) << outcome.out;
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::ranges::find(rows[0], name) - rows[0].begin());
    };
    const std::size_t ratio = column(" relMSE path / bdpt ");
    const std::size_t verdict = column(" less error ");
    ASSERT_LT(ratio, rows[0].size());
    ASSERT_LT(verdict, rows[0].size());
    for (std::size_t i = 2; i < rows.size(); ++i) {
        double low = 0.0;
        double high = 0.0;
        double middle = 0.0;
        ASSERT_EQ(std::sscanf(rows[i][ratio].c_str(), " %lf (%lf to %lf)", &middle, &low, &high), 3);
        EXPECT_EQ(rows[i][verdict], high < 1.0 ? " path " : low > 1.0 ? " bdpt " : " not decided ");
        EXPECT_NE(rows[i][2].find("+-"), std::string::npos) << rows[i][2];
    }
}

TEST(EqualTime, NeedsAScene)
{
    const Outcome outcome = run({});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "figure_equal_time: no scene is named\n");
}

// docs/tree-by-hand.md: its numbers and pictures are those of the code.
class TreeByHand : public testing::Test {
protected:
    const std::filesystem::path docs_ = std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "docs";
    TemporaryFolder folder_;

    [[nodiscard]] Outcome check(const std::filesystem::path& page) const
    {
        const auto programs = std::filesystem::path(PLUMBLINE_PROGRAM).parent_path();
        return run({(docs_ / "scenes/karras_keys.dae").string(), page.string(),
                    (docs_ / "images").string(), "--check"},
                   {.program = (programs / "figure_tree_by_hand").string()});
    }
    /// A copy of the page with the first `from` replaced.
    [[nodiscard]] std::filesystem::path changed_page(const std::string& from,
                                                     const std::string& to) const
    {
        std::string page = read_bytes(docs_ / "tree-by-hand.md");
        const std::size_t at = page.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        write_bytes(folder_.path() / "page.md", page.replace(at, from.size(), to));
        return folder_.path() / "page.md";
    }
};

TEST_F(TreeByHand, IsUpToDate)
{
    const Outcome outcome = check(docs_ / "tree-by-hand.md");
    EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out
                                 << "run build/release/docs/figures/figure_tree_by_hand --help";
    EXPECT_EQ(outcome.out, "");
}

TEST_F(TreeByHand, AWrongNumberIsFound)
{
    const auto page = changed_page("delta(0, 4) = 0", "delta(0, 4) = 1");
    const Outcome outcome = check(page);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, page.string() + " is not what figure_tree_by_hand writes\n");
}

TEST_F(TreeByHand, NeedsItsMarks)
{
    const Outcome none = check(changed_page("figure_tree_by_hand: splits", "splits"));
    EXPECT_EQ(none.status, 2);
    EXPECT_NE(none.err.find("page.md: an end without a beginning"), std::string::npos) << none.err;
    const Outcome twice =
        check(changed_page("figure_tree_by_hand: splits", "figure_tree_by_hand: keys"));
    EXPECT_EQ(twice.status, 2);
    EXPECT_NE(twice.err.find("page.md: no part of the page, or one twice: keys"), std::string::npos)
        << twice.err;
}

// The rungs of docs/ladder.md have the same mean where each of them sees all light. The half width of an
// interval of 8 rounds is 2.36 standard errors (Student, 7 degrees of freedom); five half widths are
// exceeded by chance in 1 of 1e5 pictures. A path that counts twice adds much more: more than half of
// the light of this room is found by each of the first two rungs.
TEST(Ladder, AllRungsHaveTheSameMean)
{
    const TemporaryFolder folder;
    std::string page = "before\n";
    for (const char* part : {"cornell_diffuse", "machine"})
        page += "<!-- figure_ladder: " + std::string(part) + " -->\n<!-- figure_ladder: end -->\n";
    write_bytes(folder.path() / "page.md", page);
    const auto programs = std::filesystem::path(PLUMBLINE_PROGRAM).parent_path();
    const Outcome outcome =
        run({(folder.path() / "page.md").string(), folder.path().string(), scene_file("cornell_diffuse"),
             "--width", "24", "--rounds", "8", "--seconds", "0.03", "--reference-seconds", "0.5"},
            {.program = (programs / "figure_ladder").string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string written = read_bytes(folder.path() / "page.md");
    EXPECT_TRUE(written.starts_with(page.substr(0, page.find('\n')))) << written;
    std::size_t rungs = 0;
    for (const auto& row : cells_of(written)) {
        double mean = 0.0;
        double half_width = 0.0;
        if (row.size() != 7 || std::sscanf(row[6].c_str(), " %lf +- %lf", &mean, &half_width) != 2)
            continue;
        EXPECT_NEAR(mean, 100.0, 5 * half_width) << row[1];
        EXPECT_LT(half_width, 10.0) << row[1];
        ++rungs;
    }
    EXPECT_EQ(rungs, 5u) << written;
    for (const char* picture : {"emission", "next_event", "path", "light", "bdpt", "reference", "sheet"})
        EXPECT_TRUE(exists(folder.path() / ("ladder_" + std::string(picture) + ".png"))) << picture;
}

// docs/leaving-a-surface.md: a distance that is too small meets the surface again, one that is too large
// leaks light through the wall, and the bound does neither, at any scale. The pictures have the same
// random numbers as the right one, so the means agree but for paths that rounding sends elsewhere.
TEST(Leaving, FixedDistancesFailAtOneScaleOrTheOtherAndTheBoundAtNone)
{
    const TemporaryFolder folder;
    std::string page;
    for (const char* part : {"scales", "rings", "leaks"})
        page += "<!-- figure_leaving: " + std::string(part) + " -->\n<!-- figure_leaving: end -->\n";
    write_bytes(folder.path() / "page.md", page);
    const auto programs = std::filesystem::path(PLUMBLINE_PROGRAM).parent_path();
    const Outcome outcome = run({(folder.path() / "page.md").string(), folder.path().string(),
                                 scene_file("cornell_glass"), scene_file("door_ajar"), "--samples", "1"},
                                {.program = (programs / "figure_leaving").string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    struct Values {
        double self_hits, brightness; // in percent
    };
    std::map<std::string, std::vector<Values>>
        rules; // by rule: scale 1 and 1000, the ball twice, the door
    for (const auto& row : cells_of(read_bytes(folder.path() / "page.md"))) {
        Values values{};
        if (row.size() == 5 && std::sscanf(row[3].c_str(), " %lf", &values.self_hits) == 1 &&
            std::sscanf(row[4].c_str(), " %lf", &values.brightness) == 1)
            rules[row[2]].push_back(values);
    }
    ASSERT_EQ(rules.size(), 4u);
    for (const auto& [rule, values] : rules) ASSERT_EQ(values.size(), 5u) << rule;
    for (const Values& bound : rules[" error bound "]) {
        EXPECT_EQ(bound.self_hits, 0.0);
        EXPECT_NEAR(bound.brightness, 100.0, 0.5);
    }
    for (const Values& small : rules[" fixed, 1e-07 "]) EXPECT_GT(small.self_hits, 0.05);
    EXPECT_EQ(rules[" fixed, 0.0001 "][0].self_hits, 0.0);
    EXPECT_GT(rules[" fixed, 0.0001 "][1].self_hits, 0.05);
    EXPECT_GT(rules[" fixed, 0.05 "][4].brightness, 110.0);
}

} // namespace
