// `plumbline golden`: goldens are made, resumed, found again, verified and listed.

#include "golden/golden.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST_F(GoldenCommand, RefusesAPartInItsPlace)
{
    const Arguments part = {"--pilot", "4", "--max-edges", "6", "-s", "64", "--batches"};
    const Arguments common = {"golden", scene_file("cornell_glass"), "--size", "12x8", "--batch", "4"};
    ASSERT_EQ(run(common + part + Arguments{"2..4", "-o", file}).status, 0);
    const std::string bytes = read_bytes(file);
    const Outcome outcome = run(golden());
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("a part of a golden: plumbline merge joins parts"), std::string::npos)
        << outcome.err;
    EXPECT_TRUE(read_bytes(file) == bytes);
}

TEST_F(GoldenCommand, NeverReplacesAnotherGolden)
{
    ASSERT_EQ(run(golden()).status, 0);
    const std::string bytes = read_bytes(file);
    const auto with = [&](const std::string& option, const std::string& value) {
        Arguments arguments = golden();
        const auto found = std::find(arguments.begin(), arguments.end(), option);
        if (found == arguments.end()) return arguments + Arguments{option, value};
        *(found + 1) = value;
        return arguments;
    };
    for (const auto& [other, complaint] :
         {std::pair(with("-s", "128"), "its number of samples is 64, not 128 (-s)"),
          {with("--size", "24x8"), "its size is 12x8, not 24x8 (--size)"},
          {with("--batch", "8"), "its batch_size is 4, not 8 (--batch)"},
          {with("--pilot", "5"), "its number of pilot batches is 4, not 5 (--pilot)"},
          {with("--max-edges", "3"), "its max_edges is 6, not 3 (--max-edges)"}}) {
        const Outcome outcome = run(other);
        EXPECT_EQ(outcome.status, 2) << complaint << outcome.out;
        EXPECT_NE(outcome.err.find(complaint), std::string::npos) << complaint << '\n' << outcome.err;
        EXPECT_NE(outcome.err.find("remove the file"), std::string::npos) << outcome.err;
    }
    // All differences are reported at once.
    Arguments two = with("--size", "24x8");
    two = two + Arguments{"--max-edges", "3"};
    const std::string both = run(two).err;
    EXPECT_NE(both.find("--size"), std::string::npos) << both;
    EXPECT_NE(both.find("--max-edges"), std::string::npos) << both;
    EXPECT_TRUE(read_bytes(file) == bytes);
}

TEST_F(GoldenCommand, NeverGoesOnFromAnotherOne)
{
    Process process(golden("2147483648", {"--watch", "0"}));
    ASSERT_TRUE(eventually([&] {
        return std::filesystem::exists(file) &&
               std::stoull(images::read_exr(file).metadata.at("samples")) > 20;
    }));
    process.send(SIGINT);
    ASSERT_EQ(process.finish().status, 130);
    const std::string bytes = read_bytes(file);
    const std::string held = images::read_exr(file).metadata.at("samples");
    const std::string more = std::to_string(std::stoull(held) + 64);
    Arguments other_size = golden(more);
    std::replace(other_size.begin(), other_size.end(), std::string("12x8"), std::string("24x8"));
    Arguments other_pilot = golden(more);
    *(std::find(other_pilot.begin(), other_pilot.end(), "--pilot") + 1) = "5";
    for (const auto& [other, complaint] :
         {std::pair(other_size, std::string("its size is 12x8, not 24x8 (--size)")),
          {other_pilot, "its number of pilot batches is 4, not 5 (--pilot)"},
          {golden(more, {"--max-edges", "3"}), "its max_edges is 6, not 3 (--max-edges)"},
          {golden("20"), "it has " + held + " samples already, more than 20 (-s)"}}) {
        const Outcome outcome = run(other);
        EXPECT_EQ(outcome.status, 2) << complaint << outcome.out;
        EXPECT_NE(outcome.err.find(complaint), std::string::npos) << complaint << '\n' << outcome.err;
    }
    EXPECT_TRUE(read_bytes(file) == bytes);
}

TEST_F(GoldenCommand, OptionsThatAreGivenMustBeThoseOfAGoldenThatIsCheckedOrListed)
{
    ASSERT_EQ(run(golden()).status, 0);
    const Arguments in_folder = {"golden", scene_file("cornell_glass"), "--folder",
                                 folder.path().string()};
    for (const Arguments& what : {Arguments{"--list"}, Arguments{"--verify", "1"}}) {
        EXPECT_EQ(run(in_folder + what).status, 0);
        const Outcome outcome = run(in_folder + what + Arguments{"--size", "64x64"});
        EXPECT_EQ(outcome.status, 2) << outcome.out;
        EXPECT_NE(outcome.err.find("its size is 12x8, not 64x64 (--size)"), std::string::npos)
            << outcome.err;
        EXPECT_EQ(run(in_folder + what + Arguments{"--watch", "3"}).status, 2);
    }
}

TEST_F(GoldenCommand, FindsAllScenesOfAFolderFromAnywhere)
{
    const TemporaryFolder scenes;
    std::filesystem::copy_file(scene_file("cornell_glass"), scenes / "cornell_glass.dae");
    std::filesystem::copy_file(scene_file("furnace"), scenes / "furnace.dae");
    const Outcome list = run({"golden", "--all", "--list", "--scene-folder", scenes.path().string(),
                              "--folder", folder.path().string()});
    EXPECT_EQ(list.status, 0) << list.err;
    EXPECT_NE(list.out.find("cornell_glass"), std::string::npos) << list.out;
    EXPECT_NE(list.out.find("furnace "), std::string::npos) << list.out;

    const TemporaryFolder empty;
    const std::string nowhere = (empty / "none").string();
    for (const auto& [where, complaint] :
         {std::pair(empty.path().string(), " holds no .dae"), {nowhere, " is no folder"}}) {
        const Outcome outcome = run({"golden", "--all", "--scene-folder", where});
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find("--all: " + where + complaint), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("--scene-folder"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run({"golden", scene_file("furnace"), "--scene-folder", nowhere}).status, 2);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST_F(GoldenCommand, InterruptedAndResumedGivesTheBitsOfAnUninterruptedRun)
{
    Process process(golden("2147483648", {"--watch", "0"}));
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(file); }));
    process.send(SIGINT);
    const Outcome outcome = process.finish();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_NE(outcome.err.find("goes on from here"), std::string::npos) << outcome.err;

    const auto held = std::stoull(images::read_exr(file).metadata.at("samples"));
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
    // One batch is 1% darker. The metadata is that of the original golden.
    ASSERT_EQ(run(golden()).status, 0);
    const images::Metadata metadata = golden::read_golden(file).metadata;
    const std::string batches = (folder / "batches.exr").string();
    ASSERT_EQ(run({"render", scene_file("cornell_glass"), "-o", batches, "--size", "12x8", "-s", "64",
                   "--integrator", "bdpt", "--max-edges", "6", "--seed", metadata.at("seed"),
                   "--keep-batches"})
                  .status,
              0);
    golden::GoldenMaker maker(12, 8, 4);
    for (const auto& [name, batch] : images::read_exr(batches).layers) {
        images::Image altered = batch;
        if (maker.film().batches() == 9)
            for (images::Rgb& pixel : altered.pixels) pixel *= 0.99;
        maker.add_batch(altered);
    }
    ASSERT_EQ(maker.film().batches(), 16u);
    maker.write(file, metadata, images::FilmState::omit);
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

TEST_F(GoldenCommand, ReportsThatTheSceneHasChanged)
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
          {golden("64", {"--size", "0x3"}), "--size"},
          {golden("64", {"-"}), "golden -: expected the name of a scene file"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find(complaint), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(folder.entries(), 0u);
}

} // namespace
