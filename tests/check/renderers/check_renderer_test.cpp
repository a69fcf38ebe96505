// A renderer as a program: right, or wrong in each way that has a verdict of its own.

#include "check/renderers/check_renderer.h"

#include "check/renderers/renderer_page.h"
#include "check/renderers/renderer_results.h"
#include "check/renderers/seeds.h"
#include "tests/check/renderers/small_suite.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace {

namespace fs = std::filesystem;

using check::RendererCheck;
using check::SceneVerdict;
using renderers_test::fake;

class CheckRenderer : public testing::Test {
protected:
    static void SetUpTestSuite() { shared = new images_test::TemporaryFolder; }
    static void TearDownTestSuite()
    {
        delete shared;
        shared = nullptr;
    }
    static inline images_test::TemporaryFolder* shared = nullptr;

    check::RendererOptions options = [] {
        check::RendererOptions few;
        few.ending = ".pfm";
        few.samples = 25;
        few.first_pictures = 16;
        few.most_pictures = 32;
        few.error = 0.03;
        few.time_limit = 20.0;
        return few;
    }();

    /// Checks the fake renderer with this defect.
    RendererCheck check_fake(const std::string& defect,
                             const std::vector<std::string>& names = {"spot_over_plane"})
    {
        options.command = fake(defect);
        for (const std::string& name : names) renderers_test::add_scene(shared->path(), name);
        const check::PictureFolder folder;
        return check_renderer(check::chosen_scenes(shared->path(), names, {}), options, folder);
    }
    /// The only scene of a check with this defect.
    check::SceneCheck only(const std::string& defect) { return check_fake(defect).scenes.at(0); }

    void expect_missing(const std::string& defect, const std::string& why)
    {
        const check::SceneCheck scene = only(defect);
        EXPECT_EQ(scene.verdict(), SceneVerdict::no_picture) << defect << ": " << scene.reason();
        EXPECT_EQ(scene.reason(), "Did not render: " + why + ".");
        EXPECT_TRUE(scene.pictures().empty());
        ASSERT_TRUE(scene.missing());
        EXPECT_EQ(scene.missing()->command.find(PLUMBLINE_FAKE_RENDERER), 0U);
        EXPECT_TRUE(scene.missing()->command.ends_with(
            " 16 16 25 " + std::to_string(check::seed_of(1, 1)) + " picture" + options.ending));
    }
    void expect_diagnosis(const std::string& defect, const std::string& part)
    {
        const check::SceneCheck scene = only(defect);
        EXPECT_EQ(scene.verdict(), SceneVerdict::fail) << defect << ": " << scene.reason();
        EXPECT_NE(scene.diagnosis().find(part), std::string::npos)
            << defect << ": " << scene.reason() << "\ndiagnosis: " << scene.diagnosis();
    }
};

TEST_F(CheckRenderer, PassesARightRendererWithTheFirstPictures)
{
    const RendererCheck check = check_fake("right", {"spot_over_plane", "cornell_glass"});
    ASSERT_EQ(check.scenes.size(), 2U);
    for (const check::SceneCheck& scene : check.scenes) {
        EXPECT_EQ(scene.verdict(), SceneVerdict::pass) << scene.reason();
        EXPECT_EQ(scene.pictures().size(), 16U);
        EXPECT_LT(check::whole_picture(*scene.comparison()).visible, 0.03);
        EXPECT_GT(check::whole_picture(*scene.comparison()).high, 1.0);
        EXPECT_LT(check::whole_picture(*scene.comparison()).low, 1.0);
    }
    EXPECT_TRUE(in_common(check).empty());
    EXPECT_EQ(summary(check), "2 PASS");
}

TEST_F(CheckRenderer, RendersMoreWhileInconclusiveAndNoMore)
{
    options.samples = 1;
    options.first_pictures = 4;
    options.most_pictures = 512;
    const check::SceneCheck noisy = only("right");
    EXPECT_EQ(noisy.verdict(), SceneVerdict::pass) << noisy.reason();
    EXPECT_GT(noisy.pictures().size(), 4U);
    EXPECT_LT(noisy.pictures().size(), 64U);

    options.most_pictures = 5;
    const check::SceneCheck limited = only("right");
    EXPECT_EQ(limited.verdict(), SceneVerdict::inconclusive);
    EXPECT_EQ(limited.pictures().size(), 5U);
    EXPECT_NE(limited.reason().find("such pictures are needed instead of 5"), std::string::npos)
        << limited.reason();
}

// The variance of few pictures is often far too small by chance: by Welch's test alone half of these
// fail.
TEST_F(CheckRenderer, FewPicturesOfARightRendererDoNotFail)
{
    options.samples = 1;
    options.first_pictures = 2;
    options.most_pictures = 2;
    for (options.series = 1; options.series <= 4; ++options.series) {
        const check::SceneCheck scene = only("right");
        EXPECT_EQ(scene.verdict(), SceneVerdict::inconclusive) << scene.reason();
    }
}

TEST_F(CheckRenderer, PassesAtTheErrorThatTheGoldenAllows)
{
    options.error = 1e-5; // far below the golden's noise
    options.most_pictures = 64;
    const check::SceneCheck scene = only("right");
    EXPECT_EQ(scene.verdict(), SceneVerdict::pass) << scene.reason();
    EXPECT_GT(scene.error(), 1e-3);
    EXPECT_LE(check::whole_picture(*scene.comparison()).visible, scene.error());
}

TEST_F(CheckRenderer, FailsWrongPicturesWithTheirDiagnosis)
{
    expect_diagnosis("upside_down", "upside down");
    expect_diagnosis("over_pi", "= 1/pi times");
    expect_diagnosis("gamma", "gamma of 2.2");
    options.samples = 400;
    expect_diagnosis("two_percent", "0.98");
}

TEST_F(CheckRenderer, SaysWhyThereIsNoPicture)
{
    expect_missing("crash", "killed by signal 11 (Segmentation fault)");
    EXPECT_EQ(only("crash").missing()->last_lines, "loading\nan assertion failed: eta > 0");
    expect_missing("exit_status", "exit status 3");
    expect_missing("no_picture", "exit status 0, but it wrote no picture");
    expect_missing("wrong_size", "its picture: has 16x8 pixels instead of 16x16");
    expect_missing("nan", "its picture: pixel (2, 1) is NaN or infinite");
    expect_missing("damaged", "its picture: truncated: 86 bytes of pixels instead of 3072");
    options.time_limit = 0.2;
    const check::SceneCheck hangs = only("hang");
    EXPECT_EQ(hangs.verdict(), SceneVerdict::no_picture);
    EXPECT_EQ(hangs.reason().find("Did not render: still running after "), 0U) << hangs.reason();
}

TEST_F(CheckRenderer, JudgesOnlyOnePictureOfARendererThatIgnoresItsSeed)
{
    const check::SceneCheck scene = only("same_noise");
    EXPECT_EQ(scene.reason().find("The pictures are not independent: pictures 1 and 2 are equal in all "
                                  "pixels. Does the renderer ignore its seed?"),
              0U)
        << scene.reason();
    EXPECT_EQ(scene.pictures().size(), 16U);
}

TEST_F(CheckRenderer, FindsWhatTheFailuresHaveInCommon)
{
    const std::vector<std::string> all = {"cornell_glass", "furnace_grey", "spot_over_plane",
                                          "door_ajar"};
    const std::vector<std::string> glass = {
        "Both scenes with a mirror or glass fail, and the 2 others pass."};
    const RendererCheck dim = check_fake("glass_dim", all);
    EXPECT_EQ(in_common(dim), glass);
    EXPECT_EQ(summary(dim), "2 PASS, 2 FAIL");
    const RendererCheck crash = check_fake("glass_crash", all);
    EXPECT_EQ(in_common(crash), glass);
    EXPECT_EQ(summary(crash), "2 PASS, 2 NO PICTURE"); // goes on after a crash
    const std::vector<std::string> upside_down = in_common(check_fake("upside_down", all));
    ASSERT_EQ(upside_down.size(), 1U);
    EXPECT_EQ(
        upside_down[0].find("All 4 failing scenes have one diagnosis. Your picture is upside down"), 0U);
}

TEST_F(CheckRenderer, ReportsAreWholeAndHoldEachScene)
{
    const RendererCheck check = check_fake("glass_crash", {"cornell_glass", "spot_over_plane"});
    const std::string table = results_table(check);
    for (const char* part : {"cornell_glass    NO PICTURE", "spot_over_plane  PASS",
                             "        an assertion failed: eta > 0\n", "1 PASS, 1 NO PICTURE, after "})
        EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
    const nlohmann::ordered_json json = results_json(check, options);
    EXPECT_EQ(json["verdict"], "NO PICTURE");
    EXPECT_EQ(json["scenes"][0]["missing"]["why"], "killed by signal 11 (Segmentation fault)");
    EXPECT_EQ(json["scenes"][1]["pictures"], 16);
    EXPECT_EQ(json["scenes"][1]["visible_error"].size(), 3U);
    const std::string page = renderer_page(check, options);
    EXPECT_EQ(page.find("@"), std::string::npos); // no mark is left
    EXPECT_EQ(page.find("http"), std::string::npos);
    std::size_t pictures = 0;
    for (std::size_t at = page.find("src=\""); at != std::string::npos;
         at = page.find("src=\"", at + 1)) {
        EXPECT_EQ(page.compare(at + 5, 22, "data:image/png;base64,"), 0);
        ++pictures;
    }
    EXPECT_EQ(pictures, 4U); // golden; golden, candidate, difference
}

TEST_F(CheckRenderer, EndsWithItsBudgetOrWhenStopped)
{
    options.budget = 0.3;
    const RendererCheck spent = check_fake("hang");
    EXPECT_TRUE(spent.time_up);
    EXPECT_EQ(spent.scenes[0].verdict(),
              SceneVerdict::inconclusive); // the time was ours, not the renderer's
    EXPECT_LT(spent.seconds, 15.0);
    EXPECT_NE(results_table(spent).find("\nThe time was spent before"), std::string::npos);

    options.budget = 60.0;
    int asked = 0;
    options.stop = [&] { return ++asked > 3; };
    const RendererCheck stopped = check_fake("hang");
    EXPECT_TRUE(stopped.stopped);
    EXPECT_EQ(stopped.scenes[0].verdict(), SceneVerdict::inconclusive);
    EXPECT_EQ(stopped.scenes[0].reason(), "Not rendered before the end of the check.");
}

TEST_F(CheckRenderer, TakesKeptPicturesOfTheSameCommandOnly)
{
    const images_test::TemporaryFolder keep;
    renderers_test::add_scene(shared->path(), "spot_over_plane");
    const auto scenes = check::chosen_scenes(shared->path(), {"spot_over_plane"}, {});
    const fs::path folder_path = keep / "pictures";
    const auto origin = [&] {
        return check::Origin{options.command, options.samples, options.series, options.ending};
    };
    options.command = fake("right");
    options.ending = ".exr";
    options.most_pictures = 3;
    {
        const check::PictureFolder folder(folder_path, origin(), scenes);
        EXPECT_EQ(check_renderer(scenes, options, folder).scenes[0].from_earlier_run(), 0U);
    }
    fs::resize_file(folder_path / "spot_over_plane/0002.exr", 10); // rendered again
    options.most_pictures = 6;
    const check::PictureFolder again(folder_path, origin(), scenes);
    const check::SceneCheck scene = check_renderer(scenes, options, again).scenes[0];
    EXPECT_EQ(scene.from_earlier_run(), 2U);
    EXPECT_EQ(scene.pictures().size(), 6U);
    const check::PictureFolder fresh;
    const auto without_folder = check_renderer(scenes, options, fresh).scenes[0];
    EXPECT_TRUE(scene.pictures() == without_folder.pictures());

    const auto refusal = [&](const check::Origin& other) {
        return images_test::error_of<std::invalid_argument>(
            [&] { check::PictureFolder(folder_path, other, scenes); });
    };
    check::Origin other = origin();
    other.samples = 26;
    EXPECT_NE(refusal(other).find("holds pictures of another samples"), std::string::npos);
    other = origin();
    other.command[1] = "gamma";
    EXPECT_NE(refusal(other).find("holds pictures of another command"), std::string::npos);
}

TEST_F(CheckRenderer, NoticesThatTheProgramHasChanged)
{
    const images_test::TemporaryFolder folder;
    const std::string script = (folder / "mine.sh").string();
    images_test::write_bytes(script, "one");
    const check::Origin origin{{"sh", script, "{scene}", "{out}"}, 1, 1, ".exr"};
    check::PictureFolder(folder / "kept", origin, {});
    check::PictureFolder(folder / "kept", origin, {});
    images_test::write_bytes(script, "another");
    EXPECT_NE(images_test::error_of<std::invalid_argument>([&] {
                  check::PictureFolder(folder / "kept", origin, {});
              }).find("another version of " + script),
              std::string::npos);
}

TEST_F(CheckRenderer, SaysWhichNameIsUnknown)
{
    const auto error = [&](const std::vector<std::string>& names,
                           const std::vector<std::string>& without) {
        return images_test::error_of<std::invalid_argument>(
            [&] { check::chosen_scenes(shared->path(), names, without); });
    };
    for (const char* name : {"cornell_glass", "spot_over_plane", "door_ajar"})
        renderers_test::add_scene(shared->path(), name);
    EXPECT_EQ(error({"nothing"}, {}), "--scenes nothing: no such golden (--list lists them)");
    EXPECT_EQ(error({}, {"fog"}), "--without fog: no such feature or scene (--list lists them)");
    EXPECT_EQ(error({}, {"triangle", "sphere"}), "--without leaves no scene to render");
    const auto chosen = check::chosen_scenes(shared->path(), {}, {"glass", "door_ajar"});
    ASSERT_EQ(chosen.size(), 1U);
    EXPECT_EQ(chosen[0].name, "spot_over_plane");
}

TEST(Seeds, AreFarApartAndFitAnyRenderer)
{
    std::set<std::uint64_t> seeds;
    for (std::uint64_t number = 1; number <= 1000; ++number) seeds.insert(check::seed_of(3, number));
    EXPECT_EQ(seeds.size(), 1000U);
    EXPECT_GE(*seeds.begin(), 1U);
    EXPECT_LT(*seeds.rbegin(), (std::uint64_t{1} << 31) - 1);
    for (auto seed = seeds.begin(), next = std::next(seed); next != seeds.end(); ++seed, ++next)
        EXPECT_GT(*next - *seed, 2'000'000U);
}

} // namespace
