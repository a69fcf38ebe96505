// `plumbline render` without errors: its output, its files, and the options that change the picture.

#include "images/exr.h"
#include "images/pfm.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace {

using namespace cli_test;

const Arguments small = {"--size", "24x16", "-s", "8"};

Arguments render(const std::string& scene, const std::filesystem::path& output,
                 const Arguments& more = {}, const Arguments& size = small)
{
    return Arguments{"render", scene_file(scene), "-o", output.string()} + size + more;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(Help, FitsOneScreenAndShowsAnExample)
{
    for (const Arguments& arguments : {Arguments{"--help"},
                                       {"render", "--help"},
                                       {"render", "-h"},
                                       {"bvh", "--help"},
                                       {"golden", "--help"},
                                       {"compare", "--help"},
                                       {"trade", "--help"}}) {
        const Outcome help = run(arguments);
        EXPECT_EQ(help.status, 0);
        EXPECT_EQ(help.err, "");
        const auto lines = lines_of(help.out);
        EXPECT_GE(lines.size(), 8u);
        EXPECT_LE(lines.size(), 40u);
        for (const std::string& line : lines) EXPECT_LE(line.size(), 100u) << line;
    }
    EXPECT_NE(run({"render", "--help"}).out.find("Example: plumbline render scenes/"),
              std::string::npos);
}

// The example in the help text must work without changes.
TEST(Help, ItsExampleNamesASceneAndOptionsThatThereAre)
{
    const std::string help = run({"render", "--help"}).out;
    std::istringstream example(help.substr(help.find("Example: plumbline ") + 19));
    Arguments arguments;
    for (std::string word; example >> word;) arguments.push_back(word);
    const TemporaryFolder folder;
    for (std::string& word : arguments) {
        if (word.ends_with(".dae")) word = (std::filesystem::path(PLUMBLINE_SOURCE_DIR) / word).string();
        if (word.ends_with(".exr") || word.ends_with(".png")) word = (folder / word).string();
        if (std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; }))
            word = "4";
    }
    const Outcome rendered = run(arguments + Arguments{"--size", "6x4"});
    EXPECT_EQ(rendered.status, 0) << rendered.err;
    EXPECT_EQ(folder.entries(), 2u);
}

TEST(Version, IsAskedForInOneWord)
{
    const Outcome version = run({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.err, "");
    EXPECT_EQ(version.out.rfind("plumbline ", 0), 0u) << version.out;
}

TEST(Render, SaysNothingWhenItIsNotWatched)
{
    const TemporaryFolder folder;
    const Outcome outcome = run(render("point_over_plane", folder / "a.exr"));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(Render, WritesEveryFormatThatIsAskedForAtOnce)
{
    const TemporaryFolder folder;
    const Outcome outcome =
        run(render("cornell_glass", folder / "a.exr",
                   {"-o", (folder / "b.pfm").string(), "-o", (folder / "c.png").string(), "-o",
                    (folder / "d.exr").string()}));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(folder.entries(), 4u);
    const images::ExrPicture exr = images::read_exr(folder / "a.exr");
    EXPECT_EQ(exr.mean.width, 24);
    EXPECT_EQ(exr.mean.height, 16);
    EXPECT_EQ(exr.mean, images::read_pfm(folder / "b.pfm"));
    EXPECT_EQ(read_bytes(folder / "c.png").substr(1, 3), "PNG");
    EXPECT_EQ(read_bytes(folder / "a.exr"), read_bytes(folder / "d.exr"));
}

TEST(Render, TheExrSaysHowItWasMade)
{
    const TemporaryFolder folder;
    ASSERT_EQ(
        run(render("cornell_glass", folder / "a.exr", {"--seed", "17", "--max-edges", "5"})).status, 0);
    const images::ExrPicture exr = images::read_exr(folder / "a.exr");
    const auto said = [&](const char* name) {
        const auto found = exr.metadata.find(name);
        return found == exr.metadata.end() ? "(nothing)" : found->second;
    };
    EXPECT_EQ(said("scene"), "cornell_glass");
    EXPECT_EQ(said("integrator"), "path");
    EXPECT_EQ(said("samples"), "8");
    EXPECT_EQ(said("batch_size"), "4");
    EXPECT_EQ(said("seed"), "17");
    EXPECT_EQ(said("max_edges"), "5");
    EXPECT_EQ(said("interrupted"), "(nothing)");
    EXPECT_EQ(run({"--version"}).out.rfind("plumbline " + said("version") + "\n", 0), 0u);
    ASSERT_TRUE(exr.standard_error);
    ASSERT_TRUE(exr.film);
    EXPECT_EQ(exr.film->batches(), 2u);
}

TEST(Render, AnyCaseOfAnEndingWillDo)
{
    const TemporaryFolder folder;
    const Outcome outcome =
        run(render("cornell_glass", folder / "A.EXR",
                   {"-o", (folder / "B.Pfm").string(), "-o", (folder / "C.PNG").string(), "--strategies",
                    (folder / "S.EXR").string(), "--strategies-picture", (folder / "S.PNG").string(),
                    "--max-edges", "3", "--keep-batches", "--exposure", "1"}));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(folder.entries(), 5u);
    const images::ExrPicture exr = images::read_exr(folder / "A.EXR");
    EXPECT_EQ(exr.mean, images::read_pfm(folder / "B.Pfm"));
    EXPECT_EQ(exr.layers.size(), 2u) << "the batches";
    EXPECT_EQ(read_bytes(folder / "C.PNG").substr(1, 3), "PNG");
    ASSERT_EQ(run(render("cornell_glass", folder / "B.EXR")).status, 0);
    const Outcome resumed =
        run(render("cornell_glass", folder / "B.EXR", {"--resume"}, {"--size", "24x16", "-s", "12"}));
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(images::read_exr(folder / "B.EXR").metadata.at("samples"), "12");
}

// Without --batch, the batch size is the largest of 4, 3, 2 and 1 that divides the number of samples.
TEST(Render, AnyNumberOfSamplesIsWholeBatches)
{
    const TemporaryFolder folder;
    for (const auto& [samples, batch] : {std::pair("1", "1"),
                                         {"2", "2"},
                                         {"3", "3"},
                                         {"5", "1"},
                                         {"6", "3"},
                                         {"8", "4"},
                                         {"9", "3"},
                                         {"10", "2"}}) {
        const Outcome outcome = run(
            render("point_over_plane", folder / "a.exr", {"--json"}, {"--size", "6x4", "-s", samples}));
        ASSERT_EQ(outcome.status, 0) << samples << outcome.err;
        EXPECT_EQ(images::read_exr(folder / "a.exr").metadata.at("batch_size"), batch) << samples;
        const auto json = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(std::to_string(json.at("batch_size").get<int>()), batch) << samples;
        EXPECT_EQ(std::to_string(json.at("samples_per_pixel").get<int>()), samples);
    }
    // A given batch size is not changed, even if it is the default.
    EXPECT_EQ(
        run(render("point_over_plane", folder / "b.exr", {"--batch", "4"}, {"--size", "6x4", "-s", "6"}))
            .status,
        2);
    EXPECT_FALSE(std::filesystem::exists(folder / "b.exr"));
}

TEST(Render, CountsMayHaveAnExponent)
{
    const TemporaryFolder folder;
    const auto samples = [&](const char* written) {
        const Outcome outcome = run(render("point_over_plane", folder / "a.exr", {"-t", "1e0"},
                                           {"--size", "1x1", "--batch", "1e1", "-s", written}));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return images::read_exr(folder / "a.exr").metadata.at("samples");
    };
    EXPECT_EQ(samples("1e3"), "1000");
    EXPECT_EQ(samples("1.5E+2"), "150");
    EXPECT_EQ(samples("2.50e2"), "250");
    // Exponents are accepted in every command.
    const Outcome made = run({"golden", scene_file("point_over_plane"), "--folder",
                              folder.path().string(), "--size", "6x4", "--pilot", "4", "-s", "1.6e2"});
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(images::read_exr(folder / "point_over_plane.exr").metadata.at("samples"), "160");
}

// The reference is always deterministic. So the option is fulfilled and is not refused as one without
// effect.
TEST(Render, TheReferenceFulfilsDeterministic)
{
    const TemporaryFolder folder;
    ASSERT_EQ(run(render("cornell_glass", folder / "a.exr")).status, 0);
    const Outcome outcome = run(render("cornell_glass", folder / "b.exr", {"--deterministic"}));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(read_bytes(folder / "a.exr") == read_bytes(folder / "b.exr"));
}

TEST(Render, JsonIsOneObjectWithWhatAScriptNeeds)
{
    const TemporaryFolder folder;
    const Outcome outcome = run(render("point_over_plane", folder / "a.exr",
                                       {"--json", "-t", "2", "-o", (folder / "b.png").string()}));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    ASSERT_EQ(lines_of(outcome.out).size(), 1u);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json.at("scene"), "point_over_plane");
    EXPECT_EQ(json.at("width"), 24);
    EXPECT_EQ(json.at("height"), 16);
    EXPECT_EQ(json.at("samples_per_pixel"), 8);
    EXPECT_EQ(json.at("samples"), 24 * 16 * 8);
    EXPECT_EQ(json.at("threads"), 2);
    EXPECT_EQ(json.at("complete"), true);
    EXPECT_EQ(json.at("outputs").size(), 2u);
    EXPECT_GT(json.at("seconds").get<double>(), 0.0);
    EXPECT_GT(json.at("cpu_seconds").get<double>(), 0.0);
    EXPECT_EQ(json.at("builder"), "sah-leaf");
    EXPECT_TRUE(json.at("peak_rss_bytes").is_number_integer());
    EXPECT_GT(json.at("peak_rss_bytes").get<double>(), 1e5);
    ASSERT_EQ(json.at("mean_rgb").size(), 3u);

    const images::Image mean = images::read_exr(folder / "a.exr").film->mean();
    glm::dvec3 sum(0.0);
    for (const auto& pixel : mean.pixels) sum += pixel;
    for (int i = 0; i < 3; ++i) // the same order of summation; only the printed digits differ
        EXPECT_NEAR(json.at("mean_rgb")[static_cast<std::size_t>(i)].get<double>(), sum[i] / (24 * 16),
                    1e-12);
}

// The build is not part of `seconds`. A mesh takes longer to build than a batch of one sample takes
// here.
TEST(Render, JsonTellsTheBuildFromTheSamples)
{
    for (const char* device : {"ref", "host"}) {
        const TemporaryFolder folder;
        const auto before = std::chrono::steady_clock::now();
        const Outcome outcome =
            run({"render", scene_file("mesh_knot"), "-o", (folder / "a.exr").string(), "--size", "1x1",
                 "-s", "1", "-t", "1", "--max-edges", "1", "--json", "--device", device});
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - before;
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const auto json = nlohmann::json::parse(outcome.out);
        const auto seconds = json.at("seconds").get<double>();
        const auto build = json.at("build_seconds").get<double>();
        EXPECT_GT(build, seconds) << device;
        EXPECT_LT(build + seconds, passed.count()) << device;
        EXPECT_GT(json.at("build_cpu_seconds").get<double>(), json.at("cpu_seconds").get<double>())
            << device;
    }
}

/// The standard deviation, per channel, of the mean of the whole picture over the batches in `file`.
std::array<double, 3> scatter_of_batches(const std::filesystem::path& file)
{
    std::vector<glm::dvec3> means;
    for (const auto& [name, batch] : images::read_exr(file).layers) {
        means.emplace_back(0.0);
        for (const auto& pixel : batch.pixels) means.back() += pixel / double(batch.pixels.size());
    }
    std::array<double, 3> deviation{};
    for (int c = 0; c < 3; ++c) {
        double mean = 0.0;
        double squares = 0.0;
        for (const auto& m : means) mean += m[c] / double(means.size());
        for (const auto& m : means) squares += (m[c] - mean) * (m[c] - mean);
        deviation[std::size_t(c)] = std::sqrt(squares / double(means.size() - 1));
    }
    return deviation;
}

// The pixels are correlated, because light walks splat on all of them. So the standard error is computed
// from the scatter of whole batches.
TEST(Render, JsonSaysHowExactTheMeanIs)
{
    const TemporaryFolder folder;
    const auto file = folder / "a.exr";
    for (const char* device : {"ref", "host"}) {
        const Outcome outcome = run(render(
            "cornell_glass", file,
            {"--json", "--keep-batches", "--integrator", "bdpt", "--max-edges", "5", "--device", device},
            {"--size", "24x16", "-s", "40"}));
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const auto error = nlohmann::json::parse(outcome.out).at("mean_rgb_standard_error");
        ASSERT_EQ(error.size(), 3u);
        const auto deviation = scatter_of_batches(file); // from sums of 384 floats
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(error[c].get<double>() / (deviation[c] / std::sqrt(10.0)), 1.0, 1e-4) << c;
    }
}

TEST(Render, JsonOfAResumedRenderTakesItsErrorFromTheBatchesOfThisRun)
{
    const TemporaryFolder folder;
    const auto error_after = [&](const char* samples, const Arguments& more = {}) {
        const Outcome outcome = run(render("cornell_glass", folder / "a.exr", Arguments{"--json"} + more,
                                           {"--size", "24x16", "--batch", "4", "-s", samples}));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out).at("mean_rgb_standard_error");
    };
    EXPECT_TRUE(error_after("4").is_null()) << "one batch has no scatter";
    ASSERT_EQ(error_after("8").size(), 3u);
    EXPECT_TRUE(error_after("8", {"--resume"}).is_null()) << "nothing was rendered";
    EXPECT_TRUE(error_after("12", {"--resume"}).is_null()) << "one batch was rendered";
    const auto resumed = error_after("40", {"--resume"}); // the last 7 batches of 10
    ASSERT_EQ(run(render("cornell_glass", folder / "all.exr", {"--keep-batches"},
                         {"--size", "24x16", "--batch", "4", "-s", "40"}))
                  .status,
              0);
    images::ExrPicture last = images::read_exr(folder / "all.exr");
    for (const char* first : {"batch.0000", "batch.0001", "batch.0002"})
        ASSERT_EQ(last.layers.erase(first), 1u);
    images::write_exr(folder / "last.exr", *last.film, {}, last.layers);
    const auto deviation = scatter_of_batches(folder / "last.exr");
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(resumed[c].get<double>() / (deviation[c] / std::sqrt(10.0)), 1.0, 1e-4) << c;
}

TEST(Render, JsonSaysWhatTheSceneRequiresAndWhichKernelWasUsed)
{
    const TemporaryFolder folder;
    const auto json_of = [&](const char* scene, const char* device) {
        const Outcome outcome = run(render(scene, folder / "a.exr", {"--json", "--device", device}));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    using Json = nlohmann::json;
    const Json glass = json_of("cornell_glass", "ref");
    EXPECT_EQ(glass.at("requirements"),
              Json({{"shapes", {"triangle", "sphere"}},
                    {"bsdfs", {"lambertian", "mirror", "glass"}},
                    {"emitters", {"mesh"}},
                    {"strategies", {"emission_hit", "next_event", "light_image", "inner_connection"}},
                    {"fov_axes", {"horizontal"}}}));
    EXPECT_TRUE(glass.at("kernel").is_null()) << "the reference has none";
    EXPECT_EQ(
        json_of("cornell_glass", "host").at("kernel"),
        Json({{"spheres", true}, {"specular", true}, {"other_lights", false}, {"coincident", false}}));
    EXPECT_EQ(
        json_of("mesh_knot", "host").at("kernel"),
        Json({{"spheres", false}, {"specular", false}, {"other_lights", false}, {"coincident", false}}));
    // Its light alone would do, but kernels are compiled for few combinations.
    EXPECT_EQ(
        json_of("point_over_plane", "host").at("kernel"),
        Json({{"spheres", true}, {"specular", true}, {"other_lights", true}, {"coincident", true}}));
}

TEST(Render, ThreadsChangeNoByteOfAFile)
{
    for (const char* integrator : {"path", "bdpt"}) {
        const TemporaryFolder folder;
        for (const char* threads : {"1", "2", "5"})
            ASSERT_EQ(run(render("cornell_glass", folder / (std::string(threads) + ".exr"),
                                 {"-t", threads, "--integrator", integrator, "--max-edges", "7"},
                                 {"--size", "40x33", "-s", "8"}))
                          .status,
                      0);
        const std::string one = read_bytes(folder / "1.exr");
        EXPECT_GT(one.size(), 1000u);
        EXPECT_TRUE(one == read_bytes(folder / "2.exr"));
        EXPECT_TRUE(one == read_bytes(folder / "5.exr"));
    }
}

TEST(Render, TheBuilderOfTheTreeChangesNoByteOfAFileAndAnotherOneMayGoOn)
{
    const TemporaryFolder folder;
    const auto rendered = [&](const std::string& name, const std::string& samples,
                              const Arguments& more) {
        const auto path = folder / (name + ".exr");
        const Outcome outcome = run(render("cornell_glass", path, more,
                                           {"--size", "24x16", "-s", samples, "--integrator", "bdpt"}));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return read_bytes(path);
    };
    const std::string expected = rendered("unnamed", "8", {});
    EXPECT_GT(expected.size(), 1000u);
    for (const char* builder : {"morton30", "morton63", "sah", "sah-leaf"})
        EXPECT_TRUE(expected == rendered(builder, "8", {"--builder", builder})) << builder;
    for (const char* size : {"1", "2", "16"})
        EXPECT_TRUE(expected == rendered("leaves", "8", {"--leaf-size", size})) << size;
    EXPECT_FALSE(expected == rendered("resumed", "4", {"--builder", "morton30"}));
    EXPECT_TRUE(expected == rendered("resumed", "8", {"--builder", "sah", "--resume"}));
}

TEST(Render, ASeedRepeatsItsNoiseAndAnotherMakesOther)
{
    const TemporaryFolder folder;
    const auto picture = [&](const char* seed) {
        EXPECT_EQ(run(render("cornell_glass", folder / "a.exr", {"--seed", seed})).status, 0);
        return images::read_exr(folder / "a.exr").mean;
    };
    const images::Image one = picture("1");
    EXPECT_EQ(one, picture("1"));
    EXPECT_NE(one, picture("2"));
    EXPECT_NE(one, picture("4294967297")); // 2^32 + 1: all 64 bits of a seed count
    EXPECT_NE(picture("18446744073709551615"), one);
}

TEST(Render, FrameMovesTheCamera)
{
    const char* folder_of_others = std::getenv("PLUMBLINE_SHARED");
    const auto course_scene =
        (folder_of_others != nullptr
             ? std::filesystem::path(folder_of_others)
             : std::filesystem::path(PLUMBLINE_SOURCE_DIR).parent_path() / "shared") /
        "scenes" / "CBspheres_lambertian.dae";
    std::vector<std::string> files = {scene_file("cornell_diffuse")};
    if (std::filesystem::exists(course_scene)) files.push_back(course_scene.string());
    for (const std::string& file : files) {
        const TemporaryFolder folder;
        const std::string out = (folder / "a.exr").string();
        const Arguments plain = Arguments{"render", file, "-o", out, "-q"} + small;
        ASSERT_EQ(run(plain).status, 0);
        const images::Image as_is = images::read_exr(out).mean;
        ASSERT_EQ(run(plain + Arguments{"--frame"}).status, 0);
        EXPECT_NE(as_is, images::read_exr(out).mean) << file;
        EXPECT_EQ(images::read_exr(out).metadata.at("camera"), "framed");
    }
}

TEST(Render, ExposureBrightensThePngAlone)
{
    const TemporaryFolder folder;
    const Arguments more = {"-o", (folder / "a.png").string()};
    ASSERT_EQ(run(render("cornell_glass", folder / "a.exr", more)).status, 0);
    const std::string exr = read_bytes(folder / "a.exr");
    const std::string png = read_bytes(folder / "a.png");
    ASSERT_EQ(
        run(render("cornell_glass", folder / "a.exr", more + Arguments{"--exposure", "1.5"})).status, 0);
    EXPECT_TRUE(exr == read_bytes(folder / "a.exr"));
    EXPECT_FALSE(png == read_bytes(folder / "a.png"));
}

TEST(Render, MaxEdgesOneShowsOnlyWhatShines)
{
    const TemporaryFolder folder;
    ASSERT_EQ(
        run(render("point_over_plane", folder / "a.exr", {"--max-edges", "1", "--no-roulette"})).status,
        0);
    EXPECT_EQ(images::read_exr(folder / "a.exr").mean, images::Image(24, 16));
}

const Arguments endless = {"--size", "64x64", "-s", "2147483648", "-t", "1"};

TEST(Progress, ShowsABarAndTheTimeLeftOnATerminal)
{
    const TemporaryFolder folder;
    Process process(render("point_over_plane", folder / "a.exr", {}, endless), {.terminal = true});
    EXPECT_TRUE(eventually([&] { return process.printed().find(" left") != std::string::npos; }));
    const std::string shown = process.printed();
    EXPECT_NE(shown.find('['), std::string::npos) << shown;
    EXPECT_NE(shown.find('%'), std::string::npos) << shown;
    process.send(SIGINT);
    EXPECT_EQ(process.finish().status, 130);
}

TEST(Progress, IsNotShownWhenQuiet)
{
    const TemporaryFolder folder;
    Process process(render("point_over_plane", folder / "a.exr", {"-q", "--watch", "0.1"}, endless),
                    {.terminal = true});
    // Wait for the first picture, then for the time of several updates of the progress bar.
    EXPECT_TRUE(eventually([&] { return std::filesystem::exists(folder / "a.exr"); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_EQ(process.printed(), "");
    process.send(SIGINT);
    EXPECT_EQ(process.finish().status, 130);
}

} // namespace
