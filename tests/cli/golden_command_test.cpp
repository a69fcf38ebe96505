// `plumbline golden`: made, resumed, found again, verified, listed.

#include "golden/golden.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

namespace {

using namespace cli_test;

class GoldenCommand : public testing::Test {
protected:
    TemporaryFolder folder;
    std::string file = (folder / "cornell_glass.exr").string();

    [[nodiscard]] Arguments golden(const std::string& samples = "64", const Arguments& more = {}) const
    {
        return Arguments{"golden",   scene_file("cornell_glass"),
                         "--folder", folder.path().string(),
                         "--size",   "12x8",
                         "--batch",  "4",
                         "--pilot",  "4",
                         "-s",       samples} +
               more;
    }
};

TEST_F(GoldenCommand, MakesOneThatSaysHowItWasMade)
{
    const Outcome outcome = run(golden());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("cornell_glass: 64 samples per pixel, ", 0), 0u) << outcome.out;
    const golden::Golden made = golden::read_golden(file);
    EXPECT_EQ(made.mean.width, 12);
    EXPECT_EQ(made.reference.size(), 12u); // 16 batches, of which 4 are the pilot
    EXPECT_EQ(made.metadata.at("integrator"), "bdpt");
    EXPECT_EQ(made.metadata.at("samples"), "64");
    EXPECT_EQ(made.metadata.at("command"),
              "plumbline golden cornell_glass.dae --size 12x8 -s 64 --batch 4 "
              "--pilot 4 --max-edges 6");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST_F(GoldenCommand, FindsTheNextTimeThatItIsThere)
{
    ASSERT_EQ(run(golden()).status, 0);
    const std::string bytes = read_bytes(file);
    const Outcome again = run(golden());
    EXPECT_EQ(again.status, 0);
    EXPECT_EQ(again.out, "cornell_glass: is there\n");
    EXPECT_TRUE(read_bytes(file) == bytes);
}

TEST_F(GoldenCommand, NeverReplacesAnotherGolden)
{
    ASSERT_EQ(run(golden()).status, 0);
    const std::string bytes = read_bytes(file);
    for (const auto& [other, complaint] : {std::pair(golden("128"), "remove the file"),
                                           {golden("64", {"--max-edges", "3"}), "max_edges"}}) {
        const Outcome outcome = run(other);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find(complaint), std::string::npos) << outcome.err;
    }
    EXPECT_TRUE(read_bytes(file) == bytes);
}

TEST_F(GoldenCommand, InterruptedAndResumedGivesTheBitsOfAnUninterruptedRun)
{
    Process process(golden("2147483648", {"--watch", "0"}));
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(file); }));
    process.send(SIGINT);
    const Outcome outcome = process.finish();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_NE(outcome.err.find("goes on from here"), std::string::npos) << outcome.err;

    const auto held = std::stoull(golden::read_exr(file).metadata.at("samples"));
    ASSERT_GT(held, 0u);
    const std::string samples = std::to_string(held + 64);
    ASSERT_EQ(run(golden(samples, {"-t", "2"})).status, 0);
    const std::string resumed = read_bytes(file);
    std::filesystem::remove(file);
    ASSERT_EQ(run(golden(samples, {"-t", "1"})).status, 0);
    EXPECT_TRUE(read_bytes(file) == resumed);
}

TEST_F(GoldenCommand, VerifiesItsOwnBits)
{
    ASSERT_EQ(run(golden()).status, 0);
    const Outcome some = run(golden("64", {"--verify", "2"}));
    EXPECT_EQ(some.status, 0) << some.err;
    EXPECT_EQ(some.out, "cornell_glass: 2 of 16 batches are the same, bit for bit\n");
    const Outcome all = run(golden("64", {"--verify", "16"}));
    EXPECT_EQ(all.status, 0);
    EXPECT_EQ(all.out,
              "cornell_glass: 16 of 16 batches are the same, bit for bit, and so is the mean\n");
}

TEST_F(GoldenCommand, VerifyFindsABatchThatWasAltered)
{
    // What says of itself that it was rendered like the others, and is dimmer by 1%.
    ASSERT_EQ(run(golden()).status, 0);
    const golden::Metadata metadata = golden::read_golden(file).metadata;
    const std::string batches = (folder / "batches.exr").string();
    ASSERT_EQ(run({"render", scene_file("cornell_glass"), "-o", batches, "--size", "12x8", "-s", "64",
                   "--integrator", "bdpt", "--max-edges", "6", "--seed", metadata.at("seed"),
                   "--keep-batches"})
                  .status,
              0);
    golden::GoldenMaker maker(12, 8, 4);
    for (const auto& [name, batch] : golden::read_exr(batches).layers) {
        golden::Image altered = batch;
        if (maker.film().batches() == 9)
            for (golden::Rgb& pixel : altered.pixels) pixel *= 0.99;
        maker.add_batch(altered);
    }
    ASSERT_EQ(maker.film().batches(), 16u);
    maker.write(file, metadata, golden::FilmState::omit);
    const Outcome outcome = run(golden("64", {"--verify", "16"}));
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_EQ(outcome.out, "cornell_glass: batch 9 is another one now\n");
}

TEST_F(GoldenCommand, ListsWhatIsThereAndWhatIsNot)
{
    ASSERT_EQ(run(golden()).status, 0);
    const Outcome outcome = run({"golden", scene_file("cornell_glass"), scene_file("furnace"),
                                 "--folder", folder.path().string(), "--list"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("cornell_glass"), std::string::npos);
    EXPECT_NE(outcome.out.find("12x8"), std::string::npos);
    EXPECT_NE(outcome.out.find("furnace                    no golden"), std::string::npos)
        << outcome.out;
}

TEST_F(GoldenCommand, SaysWhenTheSceneIsAnotherOneNow)
{
    ASSERT_EQ(run(golden()).status, 0);
    const std::string changed = (folder / "cornell_glass.dae").string();
    write_bytes(changed, read_bytes(scene_file("cornell_glass")) + "\n<!-- changed -->\n");
    const Arguments in_folder = {"golden", changed, "--folder", folder.path().string()};
    const Outcome list = run(in_folder + Arguments{"--list"});
    EXPECT_EQ(list.status, 0);
    EXPECT_NE(list.out.find("the scene has changed since"), std::string::npos) << list.out;
    const Outcome verify = run(in_folder + Arguments{"--verify", "1"});
    EXPECT_EQ(verify.status, 2);
    EXPECT_NE(verify.err.find("scene"), std::string::npos) << verify.err;
}

TEST_F(GoldenCommand, AbsurdOptionsAreErrors)
{
    for (const auto& [arguments, complaint] :
         {std::pair(Arguments{"golden"}, "--all"),
          {Arguments{"golden", "--all", scene_file("furnace")}, "--all"},
          {golden("16"), "pilot"},
          {golden("63"), "multiple"},
          {golden("64", {"--list", "--verify", "1"}), "--list"},
          {golden("64", {"--size", "0x3"}), "--size"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find(complaint), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(folder.entries(), 0u);
}

} // namespace
