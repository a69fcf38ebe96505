// `plumbline check-renderer`: our own program behind a script, exit statuses, wrong usage, interruption.
// The verdicts themselves: tests/check/renderers/check_renderer_test.cpp.

#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace {

using namespace cli_test;

class CheckRendererCommand : public testing::Test {
protected:
    TemporaryFolder folder;
    const std::string script = (folder / "mine.sh").string();

    [[nodiscard]] static Outcome check(const Arguments& options, const Arguments& command)
    {
        return run(Arguments{"check-renderer", "--suite", PLUMBLINE_SOURCE_DIR} + options +
                   Arguments{"--"} + command);
    }
    /// The command of a script, which is given here, in the language of sh.
    [[nodiscard]] Arguments mine(const std::string& text) const
    {
        write_bytes(script, text);
        return {"sh",        script,   "{scene}",     "{width}x{height}",
                "{samples}", "{seed}", "{max_edges}", "{out}"};
    }
    static std::string error_of(const Arguments& options, const Arguments& command)
    {
        const Outcome outcome = check(options, command);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        return outcome.err;
    }
};

TEST_F(CheckRendererCommand, PassesOurOwnProgram)
{
    const Arguments own = mine(std::string("exec ") + PLUMBLINE_PROGRAM +
                               " render $1 --size $2 -s $3 --seed $4 --max-edges $5 -o $6 -q "
                               "--device host\n");
    const std::string page = (folder / "page.html").string();
    const Outcome outcome =
        check({"--scenes", "directional_over_plane", "-s", "4", "--report", page, "--json"}, own);
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["verdict"], "PASS");
    EXPECT_EQ(json["scenes"][0]["name"], "directional_over_plane");
    EXPECT_EQ(json["command"][2], "{scene}");
    EXPECT_NE(read_bytes(page).find("1 PASS"), std::string::npos);
}

TEST_F(CheckRendererCommand, ACrashIsAVerdictAndTheRunGoesOn)
{
    const Outcome outcome = check({"--scenes", "point_over_plane,spot_over_plane"},
                                  mine("echo no light >&2; kill -SEGV $$\n"));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(
        outcome.out.find("spot_over_plane: Did not render: killed by signal 11 (Segmentation fault).\n"
                         "    The end of its output:\n        no light\n"),
        std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("\n2 NO PICTURE, after "), std::string::npos) << outcome.out;
}

TEST_F(CheckRendererCommand, PassesTheWordsOnAsTheyAre)
{
    const std::string words = (folder / "words").string();
    const Outcome outcome = check({"--scenes", "point_over_plane"},
                                  {"sh", "-c", "printf '%s|' \"$@\" >" + words, "sh", "[a,b]", "--json",
                                   "", "--", "{ x }", "{width}x{height}", "{out}{scene}"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(read_bytes(words).find("[a,b]|--json||--|{ x }|64x64|"), 0U) << read_bytes(words);
}

TEST_F(CheckRendererCommand, SpentBudgetIsInconclusive)
{
    const Outcome outcome = check({"--scenes", "point_over_plane", "--budget", "0"}, mine("exit 1"));
    EXPECT_EQ(outcome.status, 3) << outcome.out;
}

TEST_F(CheckRendererCommand, WrongUsageIsOneLine)
{
    const Arguments good = {"true", "{scene}", "{out}"};
    EXPECT_EQ(error_of({}, {"true", "{scene}"}),
              "plumbline: the renderer's command does not contain {out}\n");
    EXPECT_NE(error_of({}, {"true", "{scene}", "{out}", "{depth}"})
                  .find("{depth} in the command has no value"),
              std::string::npos);
    EXPECT_EQ(error_of({"--scenes", "furnace"}, {"/no/such", "{scene}", "{out}"}),
              "plumbline: /no/such: cannot be started: No such file or directory\n");
    EXPECT_NE(error_of({"--scense", "a"}, good).find("not expected: a --scense"), std::string::npos);
    EXPECT_NE(error_of({"--without", "fog"}, good).find("--without fog: no such feature"),
              std::string::npos);
    EXPECT_NE(error_of({"--report", "page.png"}, good).find("must end in .html"), std::string::npos);
    EXPECT_NE(
        error_of({"--keep", folder.path().string()}, mine("")).find("is neither empty nor a folder"),
        std::string::npos);
    const Outcome nothing = run({"check-renderer"});
    EXPECT_EQ(nothing.status, 2);
    EXPECT_NE(nothing.err.find("no renderer is given: its command follows --"), std::string::npos);
}

TEST_F(CheckRendererCommand, InterruptedItPrintsWhatIsKnown)
{
    const std::string began = (folder / "began").string();
    Process process(Arguments{"check-renderer", "--suite", PLUMBLINE_SOURCE_DIR, "--scenes",
                              "door_ajar,spot_over_plane", "--"} +
                    mine("case $1 in *door_ajar*) exit 9;; esac; touch " + began + "; sleep 100\n"));
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(began); }));
    process.send(SIGINT);
    const Outcome outcome = process.finish();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_EQ(outcome.err, "plumbline: interrupted\n");
    EXPECT_NE(outcome.out.find("door_ajar: Did not render: exit status 9."), std::string::npos);
    EXPECT_NE(outcome.out.find("spot_over_plane: Not rendered before the end"), std::string::npos);
}

TEST_F(CheckRendererCommand, ListsScenesAndFeatures)
{
    const Outcome outcome =
        run({"check-renderer", "--suite", PLUMBLINE_SOURCE_DIR, "--list", "--without", "sphere,point"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("mesh_knot: emission_hit"), std::string::npos);
    EXPECT_EQ(outcome.out.find("cornell"), std::string::npos);
}

} // namespace
