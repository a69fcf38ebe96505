// `plumbline render --device host|cuda`: the same options, files and behaviour as the reference.

#include "cuda/launch/device.h"
#include "cuda/launch/instruction_set.h"
#include "images/exr.h"
#include "tests/cli/run_program.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace {

using namespace cli_test;

class FastRender : public testing::Test {
protected:
    TemporaryFolder folder;
    std::string out = (folder / "out.exr").string();
    std::string other = (folder / "other.exr").string();

    static Arguments render(const std::string& output, const std::string& samples,
                            const std::string& device = "host")
    {
        return {"render",   scene_file("cornell_glass"),
                "-o",       output,
                "--size",   "32x24",
                "-s",       samples,
                "--device", device};
    }
};

TEST_F(FastRender, TakesEveryIntegratorAndSaysWhoRendered)
{
    for (const char* integrator : {"path", "bdpt", "light"}) {
        const Outcome outcome = run(render(out, "8") + Arguments{"--integrator", integrator, "--json"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const auto json = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(json["device"], "host");
        EXPECT_EQ(json["integrator"], integrator);
        EXPECT_GT(json["mean_rgb"][0].get<double>(), 0.0);
        const images::ExrPicture picture = images::read_exr(out);
        EXPECT_EQ(picture.metadata.at("device"), "host");
        EXPECT_EQ(picture.metadata.at("samples"), "8");
        EXPECT_TRUE(picture.film);
    }
}

TEST_F(FastRender, DeterministicFilesDoNotDependOnThreads)
{
    const Arguments exactly = {"--integrator", "bdpt", "--deterministic"};
    ASSERT_EQ(run(render(out, "8") + exactly + Arguments{"-t", "1"}).status, 0);
    ASSERT_EQ(run(render(other, "8") + exactly + Arguments{"-t", "3"}).status, 0);
    EXPECT_TRUE(read_bytes(out) == read_bytes(other));
}

TEST_F(FastRender, TreeAndNeedsOfTheKernelChangeNoByteAndAreNamed)
{
    const auto json_of = [&](const std::string& file, const Arguments& more) {
        const Arguments render = {"render",
                                  scene_file("mesh_knot"),
                                  "-o",
                                  file,
                                  "--size",
                                  "24x16",
                                  "-s",
                                  "4",
                                  "--device",
                                  "host",
                                  "--integrator",
                                  "bdpt",
                                  "--max-edges",
                                  "5",
                                  "--deterministic",
                                  "--json"};
        const Outcome outcome = run(render + more);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.status == 0 ? nlohmann::json::parse(outcome.out) : nlohmann::json();
    };
    const nlohmann::json plain = json_of(out, {});
    EXPECT_EQ(plain["builder"], "hploc63");
    using Choice = std::pair<const char*, const char*>; // as given, and in full
    for (const auto& [given, name] :
         {Choice{"morton30", "morton30"}, Choice{"morton63", "morton63"}, Choice{"hploc30", "hploc30"},
          Choice{"hploc63", "hploc63"}, Choice{"hploc", "hploc63"}}) {
        EXPECT_EQ(json_of(other, {"--builder", given})["builder"], name);
        EXPECT_TRUE(read_bytes(out) == read_bytes(other)) << given;
    }
    const auto kernel = [](bool specular, bool all) {
        return nlohmann::json{
            {"spheres", specular}, {"specular", specular}, {"other_lights", all}, {"coincident", all}};
    };
    EXPECT_EQ(plain["kernel"], kernel(false, false));
    EXPECT_EQ(json_of(other, {"--kernel-needs", "scene"})["kernel"], kernel(false, false));
    EXPECT_EQ(json_of(other, {"--kernel-needs", "specular"})["kernel"], kernel(true, false));
    EXPECT_TRUE(read_bytes(out) == read_bytes(other));
    EXPECT_EQ(json_of(other, {"--kernel-needs", "all"})["kernel"], kernel(true, true));
    EXPECT_TRUE(read_bytes(out) == read_bytes(other));
}

TEST_F(FastRender, FastMathGivesNearlyTheSamePictureOrSaysThatItIsNotBuilt)
{
    const Arguments fastmath = {"--instructions", "fastmath"};
    const Outcome outcome = run(render(out, "64") + fastmath);
    if (!fast::has_fast_math()) {
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.err, "plumbline: --instructions fastmath: the program was built without it "
                               "(PLUMBLINE_FAST_MATH_KERNELS in CMake), or this processor lacks its "
                               "instructions\n");
        EXPECT_EQ(folder.entries(), 0u);
        return;
    }
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    ASSERT_EQ(run(render(other, "64")).status, 0);
    const images::ExrPicture picture = images::read_exr(out);
    const images::ExrPicture plain = images::read_exr(other);
    EXPECT_EQ(picture.metadata.at("device"), "host, fastmath");
    // The same random numbers: only paths that rounding turns elsewhere differ much.
    std::size_t different = 0;
    for (std::size_t i = 0; i < plain.mean.pixels.size(); ++i)
        if (glm::length(picture.mean.pixels[i] - plain.mean.pixels[i]) >
            1e-3 * glm::length(plain.mean.pixels[i]))
            ++different;
    EXPECT_LE(different, plain.mean.pixels.size() / 20);
    EXPECT_FALSE(picture.mean == plain.mean);

    const Outcome onwards = run(render(out, "128") + Arguments{"--resume"});
    EXPECT_EQ(onwards.status, 2);
    EXPECT_NE(onwards.err.find("its device is 'host, fastmath', not 'host'"), std::string::npos);
    EXPECT_EQ(run(render(out, "128") + fastmath + Arguments{"--resume"}).status, 0);
}

TEST_F(FastRender, OptionsReachTheRenderer)
{
    const auto with = [&](const Arguments& more) {
        EXPECT_EQ(run(render(out, "4") + Arguments{"--integrator", "bdpt", "-t", "1"} + more).status, 0);
        return images::read_exr(out).mean;
    };
    const images::Image plain = with({});
    EXPECT_TRUE(plain == with({}));
    EXPECT_FALSE(plain == with({"--seed", "1"}));
    EXPECT_FALSE(plain == with({"--heuristic", "power"}));
    EXPECT_FALSE(plain == with({"--max-edges", "3"}));
    EXPECT_FALSE(plain == with({"--frame"}));
    EXPECT_FALSE(with({"--max-edges", "8"}) == with({"--max-edges", "8", "--no-roulette"}));
}

TEST_F(FastRender, InterruptedAndResumedItGivesTheSamePicture)
{
    Process process(render(out, "2147483648") +
                    Arguments{"--integrator", "bdpt", "--deterministic", "--watch", "0.001"});
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(out); }));
    process.send(SIGINT);
    const Outcome outcome = process.finish();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_NE(outcome.err.find("interrupted: kept "), std::string::npos) << outcome.err;
    const auto held = std::stoull(images::read_exr(out).metadata.at("samples"));
    const std::string all = std::to_string(held + 8);
    const Arguments exactly = {"--integrator", "bdpt", "--deterministic"};
    ASSERT_EQ(run(render(out, all) + exactly + Arguments{"--resume"}).status, 0);
    ASSERT_EQ(run(render(other, all) + exactly).status, 0);
    EXPECT_TRUE(read_bytes(out) == read_bytes(other));
}

TEST_F(FastRender, WritesLayersAndTheirSheet)
{
    const std::string layers = (folder / "layers.exr").string();
    const std::string sheet = (folder / "sheet.png").string();
    const Outcome outcome =
        run(render(out, "8") + Arguments{"--integrator", "bdpt", "--max-edges", "4", "--strategies",
                                         layers, "--strategies-picture", sheet});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const images::ExrPicture picture = images::read_exr(layers);
    images::Image sum(picture.mean.width, picture.mean.height);
    for (const auto& [name, layer] : picture.layers)
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += layer.pixels[i];
    EXPECT_TRUE(picture.layers.contains("s2t2"));
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) // files hold floats; the error is smaller
            EXPECT_NEAR(sum.pixels[i][channel], picture.mean.pixels[i][channel],
                        1e-4 * picture.mean.pixels[i][channel]);
    EXPECT_TRUE(std::filesystem::exists(sheet));
}

TEST_F(FastRender, DoesNotGoOnFromAnotherDevicesPicture)
{
    ASSERT_EQ(run(render(out, "4")).status, 0);
    const std::string before = read_bytes(out);
    const Outcome onwards = run(render(out, "8", "ref") + Arguments{"--resume"});
    EXPECT_EQ(onwards.status, 2);
    EXPECT_NE(onwards.err.find("its device is 'host', not 'ref'"), std::string::npos) << onwards.err;
    EXPECT_TRUE(read_bytes(out) == before);
    ASSERT_EQ(run(render(other, "4", "ref")).status, 0);
    const Outcome back = run(render(other, "8") + Arguments{"--resume"});
    EXPECT_EQ(back.status, 2);
    EXPECT_NE(back.err.find("its device is 'ref', not 'host'"), std::string::npos) << back.err;
}

TEST_F(FastRender, SaysWhyThereIsNoGpu)
{
    const fast::Device device = fast::find_device();
    if (device.usable) GTEST_SKIP() << "there is one: " << device.description;
    const Outcome outcome = run(render(out, "4", "cuda"));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err, "plumbline: --device cuda: " + device.description + "\n");
    EXPECT_EQ(folder.entries(), 0u);
}

} // namespace
