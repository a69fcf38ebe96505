// After Ctrl-C or SIGTERM the finished batches are kept. Resuming gives the same picture as a render
// without interruption. A second signal ends the program at once, and what it has started.

#include "images/exr.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace cli_test;

/// Sends the second signal as soon as the first has reached the process: two that wait are one.
void send_twice(const Process& process, int signal)
{
    process.send(signal);
    EXPECT_TRUE(eventually([&] { return !process.has("ShdPnd:", signal); }));
    process.send(signal);
}

/// Sends the signal again and again for 20 ms.
void send_many(const Process& process, int signal)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
    while (std::chrono::steady_clock::now() < end) process.send(signal);
}

/// Whether there is no such process, or one that has ended and whose parent has not asked for its
/// status.
bool has_ended(pid_t process)
{
    std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
    std::string number;
    std::string name;
    std::string state;
    return !(stat >> number >> name >> state) || state == "Z";
}

class Interrupt : public testing::TestWithParam<int> {
protected:
    TemporaryFolder folder;
    std::string out = (folder / "out.exr").string();
    std::string whole = (folder / "whole.exr").string();

    static Arguments render(const std::string& output, const std::string& samples)
    {
        return {"render", scene_file("cornell_glass"), "-o", output, "--size", "32x24", "-s", samples};
    }
    /// Sends `signal` to a render that would take days, as soon as it has written a picture.
    Outcome interrupted(int signal, const Arguments& more = {})
    {
        Process process(render(out, "2147483648") + Arguments{"--watch", "0.001"} + more);
        EXPECT_TRUE(eventually([&] { return std::filesystem::exists(out); }));
        process.send(signal);
        return process.finish();
    }
    [[nodiscard]] std::uint64_t samples_held() const
    {
        return std::stoull(images::read_exr(out).metadata.at("samples"));
    }
    void expect_as_if_never_interrupted(std::uint64_t samples)
    {
        const std::string s = std::to_string(samples);
        const Outcome resumed = run(render(out, s) + Arguments{"--resume"});
        ASSERT_EQ(resumed.status, 0) << resumed.err;
        ASSERT_EQ(run(render(whole, s)).status, 0);
        EXPECT_TRUE(read_bytes(out) == read_bytes(whole)) << samples << " samples";
    }
};

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, testing::Values(SIGINT, SIGTERM), [](const auto& signal) {
    return std::string(signal.param == SIGINT ? "SIGINT" : "SIGTERM");
});

TEST_P(Interrupt, KeepsWholeBatchesAndSaysHowMany)
{
    const Outcome outcome = interrupted(GetParam());
    EXPECT_EQ(outcome.status, 130);
    EXPECT_EQ(outcome.out, "");
    const images::ExrPicture picture = images::read_exr(out);
    const std::uint64_t held = samples_held();
    EXPECT_GT(held, 0u);
    EXPECT_EQ(held % 4, 0u);
    ASSERT_TRUE(picture.film);
    EXPECT_EQ(picture.film->batches() * 4, held);
    EXPECT_EQ(picture.metadata.at("interrupted"), "before 2147483648 samples");
    EXPECT_EQ(outcome.err, "plumbline: interrupted: kept " + std::to_string(held) +
                               " of 2147483648 samples per pixel\n");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST_P(Interrupt, ResumedGivesThePictureOfAnUninterruptedRender)
{
    ASSERT_EQ(interrupted(GetParam()).status, 130);
    expect_as_if_never_interrupted(samples_held() + 8);
    // Once more, from a picture that is complete.
    expect_as_if_never_interrupted(samples_held() + 12);
}

TEST_P(Interrupt, AResumedRenderCanBeInterruptedAgain)
{
    ASSERT_EQ(interrupted(GetParam()).status, 130);
    const std::uint64_t first = samples_held();
    Process again(render(out, "2147483648") + Arguments{"--resume", "--watch", "0.001", "-t", "2"});
    EXPECT_TRUE(eventually([&] { return samples_held() > first; }));
    again.send(GetParam());
    EXPECT_EQ(again.finish().status, 130);
    EXPECT_GT(samples_held(), first);
    expect_as_if_never_interrupted(samples_held());
}

TEST_P(Interrupt, LeavesNoFileBeforeTheFirstBatchIsDone)
{
    // The batch takes some minutes, each of its tiles some hundredths of a second.
    Process process({"render", scene_file("point_over_plane"), "-o", out, "--size", "1024x1024",
                     "--batch", "256", "-s", "256"});
    ASSERT_TRUE(eventually([&] { return process.catches(GetParam()); }));
    process.send(GetParam());
    const Outcome outcome = process.finish();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_EQ(
        outcome.err,
        "plumbline: interrupted: nothing written, no batch was finished: 0 of 256 samples per pixel\n");
    EXPECT_EQ(folder.entries(), 0u);
}

// A second signal ends the process at once, without a picture. The signal itself ends the process,
// so that a loop of a shell ends too.
TEST_P(Interrupt, TwiceEndsAtOnce)
{
    // A tile of 2^20 samples per pixel takes minutes. After the first signal the tile is finished.
    Process process({"render", scene_file("point_over_plane"), "-o", out, "--size", "16x16", "--batch",
                     "1048576", "-s", "1048576", "-t", "1"});
    ASSERT_TRUE(eventually([&] { return process.catches(GetParam()); }));
    // Wait until the tile has begun: a fifth of a second of CPU time.
    const long long before = process.used();
    ASSERT_TRUE(eventually([&] { return process.used() >= before + sysconf(_SC_CLK_TCK) / 5; }));
    send_twice(process, GetParam());
    EXPECT_EQ(process.finish().status, -GetParam());
    EXPECT_EQ(folder.entries(), 0u);
}

// The other program has started one itself. The first signal ends both within a millisecond; the second
// comes before that, or the program has then ended in order.
TEST_P(Interrupt, TwiceKillsTheCheckedProgramAndRemovesTheTemporaryFolder)
{
    const std::string started = (folder / "started").string();
    const std::string temporary = (folder / "temporary").string();
    const Arguments sleeper = {"--", "sh", "-c",
                               "sleep 1000 & echo $$ $! >" + started + ".new; mv " + started + ".new " +
                                   started + "; wait"};
    for (const Arguments& check :
         {Arguments{"check-renderer", "--suite", PLUMBLINE_SOURCE_DIR, "--scenes", "point_over_plane"} +
              sleeper + Arguments{"{scene}", "{out}"},
          Arguments{"check-builder", "--keep", (folder / "keep.npy").string()} + sleeper +
              Arguments{"{primitives}", "{tree}"}}) {
        std::filesystem::create_directory(temporary);
        Process process(Arguments{"TMPDIR=" + temporary, PLUMBLINE_PROGRAM} + check,
                        {.program = "/usr/bin/env"});
        ASSERT_TRUE(eventually([&] { return std::filesystem::exists(started); })) << check[0];
        std::ifstream ids(started);
        pid_t child = 0;
        pid_t grandchild = 0;
        ids >> child >> grandchild;
        EXPECT_FALSE(std::filesystem::is_empty(temporary)) << check[0];
        send_many(process, GetParam());
        const int status = process.finish().status;
        EXPECT_TRUE(status == -GetParam() || status == 130) << check[0] << status;
        EXPECT_TRUE(std::filesystem::is_empty(temporary)) << check[0];
        for (const pid_t id : {child, grandchild}) {
            EXPECT_TRUE(eventually([&] { return has_ended(id); })) << check[0];
            kill(id, SIGKILL); // nothing is left behind by a test that fails
        }
        std::filesystem::remove_all(temporary);
        std::filesystem::remove(started);
    }
}

// With --watch all files are rewritten while rendering, also those of the strategies.
TEST_F(Interrupt, LayersAndSheetAreRewrittenWhileRendering)
{
    const std::string layers = (folder / "layers.exr").string();
    const std::string sheet = (folder / "sheet.png").string();
    for (const char* device : {"ref", "host"}) {
        Process process(render(out, "2147483648") + Arguments{"--watch", "0.001", "--integrator", "bdpt",
                                                              "--max-edges", "3", "--device", device,
                                                              "--strategies", layers,
                                                              "--strategies-picture", sheet});
        ASSERT_TRUE(eventually([&] { return std::filesystem::exists(sheet); })) << device;
        const auto samples = [&] {
            return std::stoull(images::read_exr(layers).metadata.at("samples"));
        };
        const std::uint64_t first = samples();
        const std::string first_sheet = read_bytes(sheet);
        EXPECT_TRUE(eventually([&] { return samples() > first; })) << device;
        EXPECT_TRUE(eventually([&] { return read_bytes(sheet) != first_sheet; })) << device;
        const images::ExrPicture growing = images::read_exr(layers);
        EXPECT_TRUE(growing.layers.contains("s2t1"));
        EXPECT_EQ(growing.metadata.at("interrupted"), "before 2147483648 samples");
        process.send(SIGINT);
        EXPECT_EQ(process.finish().status, 130);
        EXPECT_EQ(samples(), samples_held());
        for (const std::string& file : {out, layers, sheet}) std::filesystem::remove(file);
    }
}

TEST_F(Interrupt, JsonSaysThatThePictureIsNotComplete)
{
    const Outcome outcome = interrupted(SIGINT, {"--json", "-q"});
    EXPECT_EQ(outcome.status, 130);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json.at("complete"), false);
    EXPECT_EQ(json.at("samples_per_pixel"), samples_held());
    EXPECT_EQ(json.at("samples"), samples_held() * 32 * 24);
}

} // namespace
