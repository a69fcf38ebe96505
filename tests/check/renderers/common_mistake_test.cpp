// The mistake of light transport that explains all failing scenes of a renderer: our own program behind
// a wrong option.

#include "check/renderers/common_mistake.h"

#include "check/renderers/renderer_results.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/renderer.h"
#include "tests/check/renderers/small_suite.h"

#include <gtest/gtest.h>

#include <set>

namespace {

namespace fs = std::filesystem;

constexpr int edges = 3; // of the goldens

/// A folder with goldens of real scenes, 16 x 16 pixels.
class CommonMistake : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        suite = new images_test::TemporaryFolder;
        for (const char* name :
             {"directional_over_plane", "integrating_sphere", "integrating_sphere_lamp"})
            add_scene(name);
    }
    static void TearDownTestSuite()
    {
        delete suite;
        suite = nullptr;
    }
    static inline images_test::TemporaryFolder* suite = nullptr;

    static void add_scene(const std::string& name)
    {
        constexpr int size = 16;
        fs::create_directories(*suite / "scenes");
        fs::create_directories(*suite / "golden/renders");
        const fs::path file = *suite / "scenes" / (name + ".dae");
        fs::copy_file(fs::path(PLUMBLINE_SOURCE_DIR) / "scenes" / (name + ".dae"), file);
        const scenes::Scene scene = scenes::read_scene(file);
        images::RenderOptions options;
        options.seed = 1;
        options.max_edges = edges;
        options.batch_size = 1;
        const ref::World world(scene, size, size);
        const auto renderer = ref::renderer(world, ref::trace_bidirectionally, options, 2);
        golden::GoldenMaker maker(size, size, 16);
        for (std::uint64_t batch = 0; batch < 112; ++batch)
            maker.add_batch(renderer->render_batch(batch)->mean);
        maker.write(*suite / "golden/renders" / (name + ".exr"),
                    {{"scene_hash", scene.hash},
                     {"batch_size", "1"},
                     {"max_edges", std::to_string(edges)},
                     {"samples", "112"},
                     {"integrator", "bdpt"},
                     {"roulette", "on"},
                     {"camera", "of the scene"},
                     {"seed", "1"}},
                    images::FilmState::omit);
    }

    const images_test::TemporaryFolder kept;
    check::RendererOptions options = [] {
        check::RendererOptions few;
        few.samples = 16;
        few.first_pictures = 16;
        few.most_pictures = 16;
        few.error = 0.1;
        few.threads = 2;
        few.mistakes_budget = {1 << 8, 8, 32};
        return few;
    }();
    std::set<std::string> searched; // the scenes in which mistakes were looked for

    /// Checks our own program with paths of up to so many edges: a number or a placeholder. Pictures of
    /// an earlier check are taken.
    check::RendererCheck check_with(const std::string& longest)
    {
        options.command = {PLUMBLINE_PROGRAM,
                           "render",
                           "{scene}",
                           "--size",
                           "{width}x{height}",
                           "-s",
                           "{samples}",
                           "--seed",
                           "{seed}",
                           "--max-edges",
                           longest,
                           "-o",
                           "{out}",
                           "-q",
                           "--device",
                           "host",
                           "-t",
                           "1"};
        options.mistakes_progress = [&](const check::SceneCheck& scene, double done, double total) {
            searched.insert(scene.scene().name);
            EXPECT_LE(done, total);
        };
        const auto scenes = check::chosen_scenes(suite->path(), {}, {});
        const check::PictureFolder folder(
            kept / longest,
            check::Origin{options.command, options.samples, options.series, options.ending}, scenes);
        return check_renderer(scenes, options, folder);
    }
};

TEST_F(CommonMistake, OfAllFailingScenesIsNamed)
{
    options.mistakes = false;
    check::RendererCheck wrong = check_with("2");
    ASSERT_EQ(summary(wrong), "1 PASS, 2 FAIL") << results_table(wrong);
    check::MistakeSearch stopped;
    stopped.stop = [] { return true; };
    find_common_mistake(wrong, stopped);
    EXPECT_EQ(wrong.mistake, "");
    EXPECT_TRUE(searched.empty());

    options.mistakes = true;
    const check::RendererCheck check = check_with("2");
    const std::string mistake = "one of direct light alone (paths of up to 2 edges)";
    EXPECT_EQ(
        in_common(check),
        (std::vector<std::string>{
            "One mistake explains both scenes with a wrong picture: your picture is " + mistake + "."}))
        << results_table(check);
    for (const check::SceneCheck& scene : check.scenes)
        EXPECT_EQ(scene.diagnosis().find("Your picture is " + mistake) == 0,
                  scene.verdict() == check::SceneVerdict::fail)
            << scene.scene().name << ": " << scene.diagnosis();
    EXPECT_EQ(searched, (std::set<std::string>{"integrating_sphere", "integrating_sphere_lamp"}));
}

TEST_F(CommonMistake, OfARightRendererIsNotLookedFor)
{
    EXPECT_EQ(summary(check_with("{max_edges}")), "3 PASS");
    EXPECT_TRUE(searched.empty());
}

} // namespace
