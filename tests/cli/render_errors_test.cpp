// Wrong input and failed writes: one line that states the error, exit status 2, and no file.

#include "images/exr.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

namespace {

using namespace cli_test;

/// Expects exit status 2 and one readable line that begins with the program's name and contains `what`.
void expect_complaint(const Outcome& outcome, const std::string& what)
{
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind("plumbline: ", 0), 0u) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.find_first_of("\t\r\033"), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with('\n'));
    EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err << "does not say: " << what;
    EXPECT_LE(outcome.err.size(), 400u) << outcome.err;
}

struct Mistake {
    const char* name;
    Arguments arguments; // "SCENE" and "OUT" stand for a good scene and a good output
    std::string complaint;
};

void PrintTo(const Mistake& mistake, std::ostream* out)
{
    *out << mistake.name;
}

const std::vector<Mistake> mistakes = {
    {"NoSubcommand", {}, "subcommand"},
    {"UnknownSubcommand", {"paint"}, "paint: no such command"},
    {"UnknownOption", {"render", "SCENE", "-o", "OUT", "--brighter"}, "--brighter"},
    {"UnknownOptionAndWhereHelpIs",
     {"render", "SCENE", "-o", "OUT", "--brighter"},
     "(plumbline render --help lists the options)"},
    {"OptionOfNoKnownValueAndWhereHelpIs",
     {"compare", "a.exr", "b.exr", "--device", "abacus"},
     "(plumbline compare --help lists the options)"},
    {"NoSceneAndWhereHelpIs", {"golden", "--size"}, "(plumbline golden --help lists the options)"},
    {"NoScene", {"render", "-o", "OUT"}, "scene"},
    {"TwoScenes", {"render", "SCENE", "-o", "OUT", "--seed", "1", "SCENE"}, ".dae"},
    {"NoOutput", {"render", "SCENE"}, "--output"},
    {"OutputWithoutName", {"render", "SCENE", "-o"}, "--output"},
    {"SceneMissing", {"render", "/nowhere/room.dae", "-o", "OUT"}, "room.dae: "},
    {"SceneIsAFolder", {"render", "/dev", "-o", "OUT"}, "dev: "},
    {"SceneIsADevice", {"render", "/dev/zero", "-o", "OUT"}, "zero: "},
    {"SceneIsEmpty", {"render", "/dev/null", "-o", "OUT"}, "null: "},
    {"UnknownEnding", {"render", "SCENE", "-o", "picture.jpg"}, "picture.jpg"},
    {"NoEnding", {"render", "SCENE", "-o", "picture"}, "picture"},
    {"SecondOutputBad", {"render", "SCENE", "-o", "OUT", "-o", "picture.tiff"}, "picture.tiff"},
    {"FolderMissing", {"render", "SCENE", "-o", "/nowhere/a.exr"}, "/nowhere"},
    {"FolderUnwritable", {"render", "SCENE", "-o", "/proc/a.exr"}, "/proc/a.exr"},
    {"OutputIsEmpty", {"render", "SCENE", "-o", ""}, ""},
    {"SizeOfNothing", {"render", "SCENE", "-o", "OUT", "--size", "0x0"}, "--size 0x0"},
    {"SizeNegative", {"render", "SCENE", "-o", "OUT", "--size", "-1x5"}, "--size"},
    {"SizeNegativeHeight", {"render", "SCENE", "-o", "OUT", "--size", "5x-1"}, "--size 5x-1"},
    {"SizeWithoutHeight", {"render", "SCENE", "-o", "OUT", "--size", "10x"}, "--size 10x"},
    {"SizeWithoutX", {"render", "SCENE", "-o", "OUT", "--size", "10"}, "--size 10"},
    {"SizeWithMore", {"render", "SCENE", "-o", "OUT", "--size", "10x10x3"}, "--size 10x10x3"},
    {"SizeWithSpace", {"render", "SCENE", "-o", "OUT", "--size", "10 x10"}, "--size 10 x10"},
    {"SizeHuge",
     {"render", "SCENE", "-o", "OUT", "--size", "99999999x99999999"},
     "--size 99999999x99999999"},
    {"SizeBeyondIntegers",
     {"render", "SCENE", "-o", "OUT", "--size", "4294967297x1"},
     "--size 4294967297x1"},
    {"NoSamples", {"render", "SCENE", "-o", "OUT", "-s", "0"}, "--samples"},
    {"NegativeSamples", {"render", "SCENE", "-o", "OUT", "-s", "-4"}, "--samples"},
    {"SamplesInWords", {"render", "SCENE", "-o", "OUT", "-s", "many"}, "many"},
    {"ExplainWithoutAPixel", {"explain", "SCENE"}, "--pixel"},
    {"ExplainAWordForAPixel", {"explain", "SCENE", "--pixel", "middle"}, "--pixel middle: expected X,Y"},
    {"ExplainHalfAPixel", {"explain", "SCENE", "--pixel", "3"}, "--pixel 3: expected X,Y"},
    {"ExplainMoreThanAPixel", {"explain", "SCENE", "--pixel", "3,4,5"}, "--pixel 3,4,5: expected X,Y"},
    {"ExplainAPixelOutside",
     {"explain", "SCENE", "--size", "8x6", "--pixel", "3,6"},
     "--pixel 3,6: the picture has columns 0 to 7 and rows 0 to 5 (--size)"},
    {"ExplainANegativePixel", {"explain", "SCENE", "--pixel", "-1,0"}, "--pixel -1,0: the picture has"},
    {"ExplainWithHeuristicOfAnother",
     {"explain", "SCENE", "--pixel", "0,0", "--heuristic", "power"},
     "--heuristic power has no effect with --integrator path"},
    {"ExplainTwoSearches",
     {"explain", "SCENE", "--where", "s=2", "--largest"},
     "--where and --largest exclude each other"},
    {"ExplainAnUnknownTerm",
     {"explain", "SCENE", "--where", "s=2,u=1"},
     "--where: u=1: expected s, t, edges, weight, value, adds, family or obstacle"},
    {"ExplainASampleThatIsSearched",
     {"explain", "SCENE", "--where", "s=2", "--sample", "3"},
     "--sample has no effect with --where or --largest"},
    {"ExplainToAPictureOfNoKnownKind",
     {"explain", "SCENE", "--pixel", "0,0", "--picture", "path.png"},
     "--picture path.png: its name must end in .svg"},
    {"ExplainToAFolderThatIsMissing",
     {"explain", "SCENE", "--pixel", "0,0", "--report", "/nowhere/page.html"},
     "/nowhere"},
    {"ExplainAPrimitiveThatDoesNotExist",
     {"explain-tree", "SCENE", "--primitive", "100000"},
     "--primitive 100000: there are "},
    {"ExplainANegativePrimitive", {"explain-tree", "SCENE", "--primitive", "-1"}, "--primitive"},
    {"ExplainANegativeSample", {"explain", "SCENE", "--pixel", "0,0", "--sample", "-1"}, "--sample"},
    {"HalfASample", {"render", "SCENE", "-o", "OUT", "-s", "4.5"}, "4.5"},
    {"SamplesNoWholeBatch", {"render", "SCENE", "-o", "OUT", "-s", "6", "--batch", "4"}, "-s 6"},
    {"SamplesBelowOneByExponent", {"render", "SCENE", "-o", "OUT", "-s", "1e-1"}, "1e-1"},
    {"SamplesHugeByExponent", {"render", "SCENE", "-o", "OUT", "-s", "1e10"}, "--samples"},
    {"SamplesEndlessByExponent",
     {"render", "SCENE", "-o", "OUT", "-s", "1e99999999999"},
     "1e99999999999"},
    {"SamplesAsPower", {"render", "SCENE", "-o", "OUT", "-s", "2^10"}, "2^10"},
    {"SamplesHuge", {"render", "SCENE", "-o", "OUT", "-s", "2147483652"}, "--samples"},
    {"SamplesBeyondIntegers",
     {"render", "SCENE", "-o", "OUT", "-s", "99999999999999999999999"},
     "--samples"},
    {"BatchOfNothing", {"render", "SCENE", "-o", "OUT", "--batch", "0"}, "--batch"},
    {"NoThreads", {"render", "SCENE", "-o", "OUT", "-t", "0"}, "--threads"},
    {"ThreadsHuge", {"render", "SCENE", "-o", "OUT", "-t", "4000000000"}, "--threads"},
    {"NoEdges", {"render", "SCENE", "-o", "OUT", "--max-edges", "0"}, "--max-edges"},
    {"NegativeEdges", {"render", "SCENE", "-o", "OUT", "--max-edges", "-3"}, "--max-edges"},
    {"EndlessPaths", {"render", "SCENE", "-o", "OUT", "--no-roulette"}, "--max-edges"},
    {"UnknownIntegrator", {"render", "SCENE", "-o", "OUT", "--integrator", "magic"}, "--integrator"},
    {"UnknownDevice", {"render", "SCENE", "-o", "OUT", "--device", "abacus"}, "--device"},
    {"BuilderOfTheReference",
     {"render", "SCENE", "-o", "OUT", "--device", "host", "--builder", "sah-leaf"},
     "--builder sah-leaf has no effect with --device host: its trees are morton30, morton63, hploc30, "
     "hploc63, hploc\n"},
    {"BuilderOfTheReferenceOnAGpu",
     {"render", "SCENE", "-o", "OUT", "--device", "cuda", "--builder", "sah"},
     "--builder sah has no effect with --device cuda: its trees are morton30,"},
    {"BuilderOfTheFastPath",
     {"render", "SCENE", "-o", "OUT", "--builder", "hploc63"},
     "--builder hploc63 has no effect with --device ref: its trees are morton30, morton63, sah, "
     "sah-leaf\n"},
    {"KernelNeedsOfTheReference", // given although it is the default
     {"render", "SCENE", "-o", "OUT", "--kernel-needs", "scene"},
     "--kernel-needs scene has no effect with --device ref: it is for the fast path"},
    {"UnknownKernelNeeds",
     {"render", "SCENE", "-o", "OUT", "--device", "host", "--kernel-needs", "x"},
     "--kernel-needs"},
    {"NoLeaf", {"render", "SCENE", "-o", "OUT", "--leaf-size", "0"}, "--leaf-size"},
    {"LeafTooLarge", {"render", "SCENE", "-o", "OUT", "--leaf-size", "65"}, "--leaf-size"},
    {"LeafOfAnotherBuilder",
     {"render", "SCENE", "-o", "OUT", "--builder", "sah", "--leaf-size", "4"},
     "--leaf-size 4 has no effect with --builder sah: it is for sah-leaf"},
    {"LeafOfTheFastPath",
     {"render", "SCENE", "-o", "OUT", "--device", "host", "--leaf-size", "8"},
     "--leaf-size 8 has no effect with --device host"},
    {"HeuristicOfPaths",
     {"render", "SCENE", "-o", "OUT", "--integrator", "path", "--heuristic", "power"},
     "--heuristic power has no effect with --integrator path"},
    {"HeuristicOfTheDefaultIntegrator",
     {"render", "SCENE", "-o", "OUT", "--heuristic", "balance"},
     "--heuristic balance has no effect with --integrator path"},
    {"HeuristicOfLight",
     {"render", "SCENE", "-o", "OUT", "--integrator", "light", "--heuristic", "balance"},
     "--heuristic balance has no effect with --integrator light"},
    {"UniformWeightsOfTheFastPath",
     {"render", "SCENE", "-o", "OUT", "--device", "host", "--integrator", "bdpt", "--heuristic",
      "uniform"},
     "--heuristic uniform has no effect with --device host: it is for the reference"},
    {"NoFirstBounceOfRoulette",
     {"render", "SCENE", "-o", "OUT", "--roulette-from", "0"},
     "--roulette-from"},
    {"FirstBounceOfNoRoulette",
     {"render", "SCENE", "-o", "OUT", "--roulette-from", "5", "--no-roulette", "--max-edges", "3"},
     "--roulette-from 5 has no effect with --no-roulette"},
    {"FirstBounceOfRouletteOfTheFastPath",
     {"render", "SCENE", "-o", "OUT", "--device", "host", "--roulette-from", "5"},
     "--roulette-from 5 has no effect with --device host: it is for the reference"},
    {"FamilyThatThePathTracerLacks",
     {"render", "SCENE", "-o", "OUT", "--without", "light_image"},
     "--without with --integrator path: the integrator has no light_image to leave out"},
    {"FamiliesOfLightTracing",
     {"render", "SCENE", "-o", "OUT", "--integrator", "light", "--without", "light_image"},
     "--without with --integrator light: nothing of the integrator is left"},
    {"EveryFamily",
     {"render", "SCENE", "-o", "OUT", "--without", "next_event", "--without", "emission_hit"},
     "nothing of the integrator is left"},
    {"FamilyOfTheFastPath",
     {"render", "SCENE", "-o", "OUT", "--device", "host", "--without", "next_event"},
     "--without next_event has no effect with --device host: it is for the reference"},
    {"UnknownFamily", {"render", "SCENE", "-o", "OUT", "--without", "case_iv"}, "--without"},
    {"ThreadsOfAGpu",
     {"render", "SCENE", "-o", "OUT", "--device", "cuda", "-t", "2"},
     "--threads 2 has no effect with --device cuda"},
    {"KernelsOfTheHost",
     {"render", "SCENE", "-o", "OUT", "--device", "host", "--kernels", "stages"},
     "--kernels stages has no effect with --device host: it is for the GPU"},
    {"KernelsOfTheReference", // given although it is the default
     {"render", "SCENE", "-o", "OUT", "--kernels", "samples"},
     "--kernels samples has no effect with --device ref: it is for the GPU"},
    {"UnknownKernels",
     {"render", "SCENE", "-o", "OUT", "--device", "cuda", "--kernels", "x"},
     "--kernels"},
    {"ExposureOfNumbers",
     {"render", "SCENE", "-o", "OUT", "-o", "OUTs.pfm", "--exposure", "0"},
     "--exposure 0 has no effect without a .png"},
    {"UnweightedLight",
     {"render", "SCENE", "-o", "OUT", "--integrator", "light", "--max-edges", "3", "--strategies",
      "OUTs.exr", "--unweighted"},
     "--unweighted has no effect with --integrator light"},
    {"BatchesWithoutExr",
     {"render", "SCENE", "-o", "OUTb.pfm", "--keep-batches"},
     "--keep-batches has no effect without an .exr"},
    {"UnknownBuilder", {"render", "SCENE", "-o", "OUT", "--builder", "magic"}, "--builder"},
    {"SeedNegative", {"render", "SCENE", "-o", "OUT", "--seed", "-1"}, "--seed"},
    {"SeedBeyond64Bits", {"render", "SCENE", "-o", "OUT", "--seed", "18446744073709551616"}, "--seed"},
    {"ExposureInWords", {"render", "SCENE", "-o", "OUT", "--exposure", "bright"}, "--exposure"},
    {"ExposureNan", {"render", "SCENE", "-o", "OUT", "--exposure", "nan"}, "--exposure"},
    {"WatchNan", {"render", "SCENE", "-o", "OUT", "--watch", "nan"}, "--watch"},
    {"StrategiesEndless", {"render", "SCENE", "-o", "OUT", "--strategies", "OUTs.exr"}, "--max-edges"},
    {"StrategiesEnding",
     {"render", "SCENE", "-o", "OUT", "--strategies", "OUTs.png", "--max-edges", "3"},
     ".exr"},
    {"UnweightedWhat",
     {"render", "SCENE", "-o", "OUT", "--unweighted"},
     "--unweighted has no effect without --strategies"},
    {"OneNameTwice", {"render", "SCENE", "-o", "OUT", "-o", "OUT"}, "are the same file"},
    {"ResumeWithoutExr", {"render", "SCENE", "-o", "OUT.png", "--resume"}, ".exr"},
};

class RenderRefuses : public testing::TestWithParam<Mistake> {};

INSTANTIATE_TEST_SUITE_P(Render, RenderRefuses, testing::ValuesIn(mistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

TEST_P(RenderRefuses, WithOneLineAndNoFile)
{
    const TemporaryFolder folder;
    Arguments arguments = GetParam().arguments;
    for (std::string& word : arguments) {
        if (word == "SCENE") word = scene_file("point_over_plane");
        if (word.rfind("OUT", 0) == 0) word = (folder / (word == "OUT" ? "out.exr" : word)).string();
    }
    if (!arguments.empty() && arguments[0] == "render" &&
        std::find(arguments.begin(), arguments.end(), "--size") == arguments.end())
        arguments.insert(arguments.begin() + 1, {"--size", "6x4"}); // in case it is not refused
    expect_complaint(run(arguments), GetParam().complaint);
    EXPECT_EQ(folder.entries(), 0u);
}

class RenderFailures : public testing::Test {
protected:
    TemporaryFolder folder;
    std::string out = (folder / "out.exr").string();
    const Arguments good = {"render", scene_file("point_over_plane"), "-o", out, "--size", "24x16", "-s",
                            "8"};

    Outcome render_file(const std::string& text)
    {
        write_bytes(folder / "scene.dae", text);
        const Outcome outcome =
            run({"render", (folder / "scene.dae").string(), "-o", out, "--size", "6x4"});
        EXPECT_FALSE(std::filesystem::exists(out));
        EXPECT_EQ(folder.entries(), 1u);
        return outcome;
    }
};

TEST_F(RenderFailures, BrokenXmlIsNamedWithItsLine)
{
    const std::string text = read_bytes(scene_file("point_over_plane"));
    const Outcome outcome = render_file(text.substr(0, text.size() / 2));
    expect_complaint(outcome, "scene.dae:");
    const std::string rest = outcome.err.substr(outcome.err.find("scene.dae:") + 10);
    EXPECT_GT(std::atoi(rest.c_str()), 0) << outcome.err;
}

TEST_F(RenderFailures, AnErrorInTheSceneIsNamedWithItsLineAndElement)
{
    std::string text = read_bytes(scene_file("point_over_plane"));
    const std::size_t at = text.find("<yfov>");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 6, "<yfov>wide ");
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const Outcome outcome = render_file(text);
    expect_complaint(outcome, "scene.dae:" + std::to_string(line) + ": ");
    EXPECT_NE(outcome.err.find("<yfov>"), std::string::npos) << outcome.err;
}

TEST_F(RenderFailures, AFolderInThePlaceOfTheOutputStays)
{
    std::filesystem::create_directory(out);
    expect_complaint(run(good), out);
    EXPECT_TRUE(std::filesystem::is_directory(out));
    EXPECT_EQ(folder.entries(), 1u);
}

// A file may have 300 bytes: enough for the header of each format, too few for the picture.
TEST_F(RenderFailures, OnAFullDiskNothingIsLeft)
{
    for (const char* name : {"out.exr", "out.pfm", "out.png"}) {
        Arguments arguments = good;
        arguments[3] = (folder / name).string();
        expect_complaint(run(arguments, {.largest_file = 300}), name);
        EXPECT_EQ(folder.entries(), 0u);
    }
}

TEST_F(RenderFailures, OnAFullDiskAnEarlierPictureStays)
{
    ASSERT_EQ(run(good).status, 0);
    const std::string before = read_bytes(out);
    expect_complaint(run(good + Arguments{"--seed", "2"}, {.largest_file = 300}), "out.exr");
    EXPECT_TRUE(before == read_bytes(out));
    EXPECT_EQ(folder.entries(), 1u);
}

/// A picture of 8 samples exists already and must not change.
class Resume : public RenderFailures {
protected:
    Resume()
    {
        EXPECT_EQ(run(good).status, 0);
        before = read_bytes(out);
    }
    std::string before;

    void expect_refusal(const Arguments& arguments, const std::string& complaint)
    {
        const Outcome outcome = run(arguments + Arguments{"--resume"});
        expect_complaint(outcome, complaint);
        EXPECT_NE(outcome.err.find("out.exr"), std::string::npos) << outcome.err;
        EXPECT_TRUE(before == read_bytes(out));
        EXPECT_EQ(folder.entries(), 1u);
    }
};

TEST_F(Resume, RefusesAnotherPicture)
{
    expect_refusal(good + Arguments{"--seed", "5"}, "seed is '0', not '5'");
    expect_refusal(good + Arguments{"--max-edges", "5"}, "max_edges");
    expect_refusal(good + Arguments{"--frame"}, "camera");
    expect_refusal(good + Arguments{"--batch", "2"}, "batch_size is '4', not '2'");
    expect_refusal({"render", good[1], "-o", out, "--size", "24x16", "-s", "9"},
                   "batch_size is '4', not '3': --batch 4 goes on with it");
    expect_refusal(good + Arguments{"--integrator", "bdpt"}, "integrator");
    expect_refusal({"render", scene_file("sphere_over_plane"), "-o", out, "--size", "24x16", "-s", "8"},
                   "scene");
    expect_refusal({"render", good[1], "-o", out, "--size", "16x24", "-s", "8"}, "24x16");
    expect_refusal({"render", good[1], "-o", out, "--size", "24x16", "-s", "4"}, "8 samples");
}

TEST_F(Resume, RefusesTheSameSceneFileWithOtherContent)
{
    const TemporaryFolder elsewhere;
    const std::string copy = (elsewhere / "point_over_plane.dae").string();
    write_bytes(copy, read_bytes(good[1]) + "<!-- changed -->");
    Arguments arguments = good;
    arguments[1] = copy;
    expect_refusal(arguments, "scene_hash");
}

TEST_F(Resume, RefusesADamagedFileAndLeavesItAlone)
{
    for (const std::string& damaged : {before.substr(0, before.size() / 2), before.substr(0, 200),
                                       std::string(), std::string("no picture")}) {
        write_bytes(out, damaged);
        expect_complaint(run(good + Arguments{"--resume"}), "out.exr");
        EXPECT_TRUE(damaged == read_bytes(out));
        EXPECT_EQ(folder.entries(), 1u);
    }
}

TEST_F(Resume, RefusesAPictureOfAnotherMaking)
{
    images::ExrPicture picture = images::read_exr(out);
    images::write_exr(out, *picture.film, picture.metadata, {}, images::FilmState::omit);
    before = read_bytes(out);
    expect_refusal(good, "state");
}

TEST_F(Resume, OfAFinishedPictureChangesNothing)
{
    const Outcome outcome = run(good + Arguments{"--resume"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(before == read_bytes(out));
}

TEST_F(Resume, OfNothingBeginsAtTheBeginning)
{
    std::filesystem::remove(out);
    EXPECT_EQ(run(good + Arguments{"--resume"}).status, 0);
    EXPECT_TRUE(before == read_bytes(out));
}

} // namespace
