// Output that cannot be written to standard output is an error.

#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

namespace {

using namespace cli_test;
using Output = Surroundings::Output;

class StandardOutput : public testing::TestWithParam<Output> {
protected:
    TemporaryFolder folder;
    Surroundings unwritable{.output = GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Kinds, StandardOutput,
                         testing::Values(Output::closed_pipe, Output::full_disk, Output::closed),
                         [](const auto& output) {
                             return std::string(output.param == Output::closed_pipe ? "ClosedPipe"
                                                : output.param == Output::full_disk ? "FullDisk"
                                                                                    : "Closed");
                         });

TEST_P(StandardOutput, IsMissedByEveryCommandThatPrints)
{
    const std::string scene = scene_file("point_over_plane");
    const std::string picture = (folder / "a.exr").string();
    for (const Arguments& arguments :
         {Arguments{"render", scene, "-o", picture, "--size", "6x4", "-s", "4", "--json"},
          {"bvh", scene, "--device", "host", "--repeats", "1"},
          {"golden", scene, "--folder", folder.path().string(), "--list"},
          {"--help"},
          {"render", "--help"},
          {"--version"}}) {
        const Outcome outcome = run(arguments, unwritable);
        EXPECT_EQ(outcome.status, 2) << arguments[0];
        EXPECT_EQ(outcome.err, "plumbline: standard output cannot be written\n") << arguments[0];
    }
    EXPECT_TRUE(std::filesystem::exists(picture)) << "the picture itself is written all the same";
}

TEST_P(StandardOutput, IsNotMissedByACommandThatPrintsNothing)
{
    const Outcome outcome = run({"render", scene_file("point_over_plane"), "-o",
                                 (folder / "a.exr").string(), "--size", "6x4", "-s", "4"},
                                unwritable);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

} // namespace
