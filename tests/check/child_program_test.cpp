// A child process in all the ways that it can end.

#include "check/child_program.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <string>

namespace {

using check::ChildEnd;
using check::filled_in;
using check::run_child;

ChildEnd shell(const std::string& script, double limit_seconds = 30.0)
{
    return run_child({"sh", "-c", script}, limit_seconds);
}

TEST(ChildProgram, ReplacesNamesInBracesAndNothingElse)
{
    const std::vector<std::string> words = {"my {b}", "--x={a}{a}", "{ print $1 }", "{}", "{a"};
    const std::vector<std::string> expected = {"my 2", "--x=11", "{ print $1 }", "{}", "{a"};
    EXPECT_EQ(filled_in(words, {{"a", "1"}, {"b", "2"}}), expected);
}

TEST(ChildProgram, NamesAnUnknownPlaceholder)
{
    try {
        filled_in({"{tre}"}, {{"tree", "x"}, {"primitives", "y"}});
        FAIL() << "nothing was thrown";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(),
                     "{tre} in the command has no value (those with one: {primitives}, {tree})");
    }
}

TEST(ChildProgram, ReturnsExitStatusAndOutput)
{
    const ChildEnd end = shell("echo out; echo err >&2; exit 3");
    EXPECT_EQ(end.how, ChildEnd::How::exited);
    EXPECT_EQ(end.code, 3);
    EXPECT_EQ(end.last_lines, "out\nerr\n");
    EXPECT_EQ(describe(end), "exit status 3");
}

TEST(ChildProgram, KeepsTheEndOfALongOutput)
{
    const ChildEnd end = shell("for i in $(seq 20000); do echo line $i; done");
    EXPECT_EQ(end.last_lines.size(), 2000U);
    EXPECT_TRUE(end.last_lines.ends_with("line 20000\n"));
}

TEST(ChildProgram, NamesTheSignalOfACrash)
{
    const ChildEnd end = shell("kill -SEGV $$");
    EXPECT_EQ(end.how, ChildEnd::How::signalled);
    EXPECT_EQ(describe(end), "killed by signal 11 (Segmentation fault)");
}

TEST(ChildProgram, KillsAtTheLimitTheProgramAndWhatItStarted)
{
    const ChildEnd end = shell("sleep 60 & echo $!; sleep 60", 0.2);
    EXPECT_EQ(end.how, ChildEnd::How::timed_out);
    EXPECT_GE(end.seconds, 0.2);
    EXPECT_LT(end.seconds, 20.0);
    const int started = std::stoi(end.last_lines);
    // The process may stay as a zombie until its new parent has waited for it.
    const ChildEnd state = shell("for i in $(seq 100); do grep -q '^State:.*[ZX]' /proc/" +
                                 std::to_string(started) + "/status 2>/dev/null || [ ! -e /proc/" +
                                 std::to_string(started) + " ] && exit 0; sleep 0.05; done; exit 1");
    EXPECT_EQ(state.code, 0);
}

TEST(ChildProgram, DoesNotWaitForProcessesThatItLeft)
{
    const ChildEnd end = shell("sleep 60 & exit 0", 30.0);
    EXPECT_EQ(end.how, ChildEnd::How::exited);
    EXPECT_LT(end.seconds, 20.0);
}

TEST(ChildProgram, WaitsForAProgramThatHasClosedItsOutput)
{
    const ChildEnd end = shell("exec >&- 2>&-; sleep 0.1; exit 5");
    EXPECT_EQ(end.how, ChildEnd::How::exited);
    EXPECT_EQ(end.code, 5);
}

TEST(ChildProgram, KillsAProgramThatNeverStopsWriting)
{
    const ChildEnd end = run_child({"yes"}, 0.1);
    EXPECT_EQ(end.how, ChildEnd::How::timed_out);
    EXPECT_LT(end.seconds, 20.0);
}

TEST(ChildProgram, HasAnEmptyStandardInput)
{
    EXPECT_EQ(shell("cat").code, 0);
}

TEST(ChildProgram, StopsWhenAsked)
{
    const ChildEnd end = run_child({"sleep", "60"}, 60.0, [] { return true; });
    EXPECT_EQ(end.how, ChildEnd::How::timed_out);
    EXPECT_LT(end.seconds, 20.0);
}

TEST(ChildProgram, SaysWhatCannotBeStarted)
{
    try {
        run_child({"/no/such/program"}, 1.0);
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "/no/such/program: cannot be started: No such file or directory");
    }
}

} // namespace
