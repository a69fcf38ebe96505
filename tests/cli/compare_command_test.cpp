// `plumbline compare`: the verdict, the exit status, and pictures that cannot be compared.

#include "images/exr.h"
#include "images/pfm.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace {

using namespace cli_test;
using namespace std::string_literals;

/// A golden of a scene that is lit from one direction. Only the edge of the plane has noise, so few
/// samples are enough for a verdict.
class CompareCommand : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        shared = new TemporaryFolder;
        const Outcome outcome =
            run({"golden", scene_file("directional_over_plane"), "--folder", shared->path().string(),
                 "--size", "16x16", "--batch", "8", "--pilot", "16", "-s", "768"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    static void TearDownTestSuite()
    {
        delete shared;
        shared = nullptr;
    }
    static inline TemporaryFolder* shared = nullptr;

    TemporaryFolder folder;
    std::string golden_file = (*shared / "directional_over_plane.exr").string();
    std::string candidate = (folder / "candidate.exr").string();

    static void render(const std::string& output, const Arguments& more = {},
                       const std::string& scene = "directional_over_plane")
    {
        const Outcome outcome = run(Arguments{"render", scene_file(scene), "-o", output, "--size",
                                              "16x16", "-s", "512", "--batch", "8", "--max-edges", "6"} +
                                    more);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    [[nodiscard]] Outcome compare(const Arguments& candidates, const Arguments& more = {}) const
    {
        return run(Arguments{"compare"} + candidates + Arguments{golden_file} + more);
    }
    /// The candidate's mean times `factor`, in a file without metadata, as from another renderer.
    [[nodiscard]] std::string altered(double factor) const
    {
        images::Image image = images::read_exr(candidate).mean;
        for (images::Rgb& pixel : image.pixels) pixel *= factor;
        const std::string path = (folder / "altered.pfm").string();
        images::write_pfm(path, image);
        return path;
    }
};

TEST_F(CompareCommand, TheSameEstimatorPasses)
{
    render(candidate, {"--integrator", "bdpt", "--keep-batches"});
    const Outcome outcome = compare({candidate});
    EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
    EXPECT_EQ(outcome.out.rfind("PASS", 0), 0u) << outcome.out;
    EXPECT_LE(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 24) << "more than one screen";
}

TEST_F(CompareCommand, ASceneIsRenderedHereByAnyIntegrator)
{
    for (const char* integrator : {"bdpt", "path"}) {
        const Outcome outcome =
            compare({scene_file("directional_over_plane")}, {"--integrator", integrator, "--seed", "7"});
        EXPECT_EQ(outcome.status, 0) << integrator << outcome.err << outcome.out;
    }
}

TEST_F(CompareCommand, ASceneIsRenderedHereByTheFastPath)
{
    const Outcome outcome =
        compare({scene_file("directional_over_plane")}, {"--device", "host", "--seed", "7"});
    EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
}

TEST_F(CompareCommand, SeveralIndependentPicturesPass)
{
    Arguments files;
    for (const char* seed : {"1", "2", "3", "4", "5", "6", "7", "8"}) {
        files.push_back((folder / (std::string(seed) + ".exr")).string());
        render(files.back(), {"--seed", seed});
    }
    const Outcome outcome = compare(files);
    EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;

    // The same as of a renderer that writes no metadata. Eight pictures of few samples might lack rare
    // bright ones.
    for (std::string& file : files) {
        const images::Image image = images::read_exr(file).mean;
        file += ".pfm";
        images::write_pfm(file, image);
    }
    const Outcome unknown = compare(files);
    EXPECT_EQ(unknown.status, 3) << unknown.out;
    EXPECT_NE(unknown.out.find("give -s"), std::string::npos) << unknown.out;
    EXPECT_EQ(compare(files, {"-s", "512"}).status, 0);
}

TEST_F(CompareCommand, ADimmerPictureFails)
{
    render(candidate, {"--integrator", "bdpt"});
    const Outcome right = compare({altered(1.0)}, {"-s", "512"});
    EXPECT_EQ(right.status, 0);
    EXPECT_EQ(right.out.find("docs/bugs.md"), std::string::npos) << right.out;
    const Outcome outcome = compare({altered(0.95)}, {"-s", "512"});
    EXPECT_EQ(outcome.status, 1) << outcome.out;
    EXPECT_EQ(outcome.out.rfind("FAIL", 0), 0u) << outcome.out;
    EXPECT_NE(outcome.out.find("docs/bugs.md"), std::string::npos) << outcome.out;
}

TEST_F(CompareCommand, NamesAConstantFactor)
{
    render(candidate);
    const Outcome outcome = compare({altered(1 / 3.14159265358979)}, {"-s", "512"});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_NE(outcome.out.find("Your picture is 0.3183 = 1/pi times the golden everywhere"),
              std::string::npos)
        << outcome.out;
    const Outcome json = compare({altered(1.0)}, {"-s", "512", "--json"});
    EXPECT_EQ(nlohmann::json::parse(json.out).at("diagnosis"), "") << json.out;
}

TEST_F(CompareCommand, AnyCaseOfAnEndingWillDo)
{
    candidate = (folder / "CANDIDATE.EXR").string();
    render(candidate, {"--integrator", "bdpt"});
    const std::string page = (folder / "PAGE.HTML").string();
    EXPECT_EQ(compare({candidate}, {"--report", page}).status, 0);
    EXPECT_TRUE(std::filesystem::exists(page));
    std::filesystem::rename(altered(1.0), folder / "ALTERED.PFM");
    EXPECT_EQ(compare({(folder / "ALTERED.PFM").string()}, {"-s", "512"}).status, 0);
}

TEST_F(CompareCommand, TooFewSamplesAreInconclusive)
{
    TemporaryFolder goldens;
    ASSERT_EQ(run({"golden", scene_file("cornell_glass"), "--folder", goldens.path().string(), "--size",
                   "12x8", "--batch", "4", "--pilot", "4", "-s", "64"})
                  .status,
              0);
    ASSERT_EQ(run({"render", scene_file("cornell_glass"), "-o", candidate, "--size", "12x8", "-s", "16",
                   "--integrator", "bdpt", "--max-edges", "6"})
                  .status,
              0);
    const Outcome outcome = run({"compare", candidate, (goldens / "cornell_glass.exr").string()});
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("INCONCLUSIVE", 0), 0u) << outcome.out;
}

TEST_F(CompareCommand, NumbersThatDoNotExistAreWords)
{
    render(candidate);
    const Outcome outcome = compare({altered(1.125)}, {"-s", "512"});
    EXPECT_NE(outcome.out.find("  none\n"), std::string::npos) << outcome.out;
    for (const char* word : {"inf%", "nan%", " nan", " inf"})
        EXPECT_EQ(outcome.out.find(word), std::string::npos) << word << '\n' << outcome.out;
}

TEST_F(CompareCommand, TooFewSamplesAreAskedForByNumber)
{
    const Outcome few = compare({scene_file("directional_over_plane")}, {"-s", "64", "--seed", "7"});
    EXPECT_EQ(few.status, 3) << few.err << few.out;
    const std::string instead = " samples per pixel are needed instead of 64.";
    const std::size_t end = few.out.find(instead);
    ASSERT_NE(end, std::string::npos) << few.out;
    const std::string needed = few.out.substr(few.out.rfind(' ', end - 1) + 1);
    const auto json = nlohmann::json::parse(
        compare({scene_file("directional_over_plane")}, {"-s", "64", "--seed", "7", "--json"}).out);
    EXPECT_NEAR(json.at("needed").at("samples").get<double>(), std::stod(needed),
                0.1 * std::stod(needed));
    const Outcome enough = compare({scene_file("directional_over_plane")},
                                   {"-s", needed.substr(0, needed.find(' ')), "--seed", "7"});
    EXPECT_EQ(enough.status, 0) << needed << enough.err << enough.out;
}

TEST_F(CompareCommand, PicturesThatAreNotIndependentAreRefused)
{
    render(candidate, {"--integrator", "bdpt", "--seed", "3"});
    const std::string other = (folder / "other.exr").string();
    render(other, {"--integrator", "bdpt", "--seed", "4"});
    const std::string copy = altered(1.0); // has no metadata
    const std::string again = (folder / "again.pfm").string();
    std::filesystem::copy_file(copy, again);
    for (const auto& [files, complaint] :
         {std::pair(Arguments{candidate, candidate}, "candidate.exr have the same seed, 3"),
          {Arguments{copy, copy}, "are equal in all pixels: they are not independent"},
          {Arguments{copy, again}, "are equal in all pixels: they are not independent"},
          {Arguments{other, copy, again}, "have the same noise"},
          {Arguments{golden_file}, "golden's own seed"},
          {Arguments{golden_file, candidate}, "golden's own seed"}}) {
        const Outcome outcome = compare(files);
        EXPECT_EQ(outcome.status, 2) << outcome.out;
        EXPECT_NE(outcome.err.find(complaint), std::string::npos) << complaint << '\n' << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    const Outcome outcome = compare({copy, again});
    EXPECT_NE(outcome.err.find("Does the renderer ignore its seed?"), std::string::npos) << outcome.err;
    // The golden's own pixels, without its metadata.
    const std::string pixels = (folder / "pixels.pfm").string();
    images::write_pfm(pixels, images::read_exr(golden_file).mean);
    const Outcome own = compare({pixels}, {"-s", "768"});
    EXPECT_EQ(own.status, 2);
    EXPECT_NE(own.err.find("pixels.pfm: has the golden's own noise"), std::string::npos) << own.err;
}

TEST_F(CompareCommand, OddPixelsAreNamedBeforeAllStatistics)
{
    render(candidate, {"--integrator", "bdpt"});
    images::Image image = images::read_exr(candidate).mean;
    image.at(3, 12).g = -5.0;
    image.at(9, 13).r = 200.0;
    const std::string odd = (folder / "odd.pfm").string();
    images::write_pfm(odd, image);
    const Outcome outcome = compare({odd}, {"-s", "512"});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("FAIL  1 pixel is negative, which radiance cannot be: green of pixel "
                                "(3, 12) is -5. 1 pixel is far brighter than the golden: red of pixel "
                                "(9, 13) is 200,",
                                0),
              0u)
        << outcome.out;
    const auto json = nlohmann::json::parse(compare({odd}, {"-s", "512", "--json"}).out);
    ASSERT_EQ(json.at("odd_pixels").size(), 2u);
    EXPECT_EQ(json.at("odd_pixels")[0].at("kind"), "negative");
    EXPECT_EQ(json.at("odd_pixels")[0].at("x"), 3);
    EXPECT_EQ(json.at("odd_pixels")[0].at("y"), 12);
    EXPECT_EQ(json.at("odd_pixels")[0].at("value"), -5.0);
}

TEST_F(CompareCommand, PathsOfAnotherLengthAreNamed)
{
    // A picture whose metadata states another path length is refused. For a picture without metadata,
    // the program states the golden's path length.
    ASSERT_EQ(run({"render", scene_file("directional_over_plane"), "-o", candidate, "--size", "16x16",
                   "--max-edges", "2"})
                  .status,
              0);
    const Outcome ours = compare({candidate});
    EXPECT_EQ(ours.status, 2);
    EXPECT_NE(ours.err.find("candidate.exr: its greatest path length is 2, the golden's is 6"),
              std::string::npos)
        << ours.err;
    render(candidate, {"--integrator", "bdpt"});
    const Outcome brighter = compare({altered(1.125)}, {"-s", "512"});
    EXPECT_EQ(brighter.status, 1);
    EXPECT_NE(brighter.out.find("The golden's paths have at most 6 edges"), std::string::npos)
        << brighter.out;
}

TEST_F(CompareCommand, ALayerIsChosenByName)
{
    // The picture is one of two layers, as in the files of renderers that write several layers.
    render(candidate, {"--integrator", "bdpt"});
    const images::Image image = images::read_exr(candidate).mean;
    images::Film darker(image.width, image.height);
    darker.add_batch(images::Image(image.width, image.height));
    const std::string layers = (folder / "layers.exr").string();
    images::write_exr(layers, darker, {}, {{"View.Combined", image}}, images::FilmState::omit);
    EXPECT_EQ(compare({layers}, {"-s", "512"}).status, 1); // black
    const Outcome chosen = compare({layers}, {"-s", "512", "--layer", "View.Combined"});
    EXPECT_EQ(chosen.status, 0) << chosen.out << chosen.err;
    const Outcome none = compare({layers}, {"-s", "512", "--layer", "Combined"});
    EXPECT_EQ(none.status, 2);
    EXPECT_NE(
        none.err.find("has no layer Combined of R, G and B; choose one of its layers: View.Combined"),
        std::string::npos)
        << none.err;
    // Without R, G and B the only layer is taken, and named.
    std::string bytes = read_bytes(layers);
    const std::size_t red = bytes.find("\0R\0\2\0\0\0"s); // its name and type in the list of channels
    ASSERT_NE(red, std::string::npos);
    bytes[red + 1] = 'S';
    write_bytes(layers, bytes);
    const Outcome only = compare({layers}, {"-s", "512"});
    EXPECT_EQ(only.status, 0) << only.out << only.err;
    EXPECT_EQ(only.err, layers + ": its layer View.Combined is compared\n");
    EXPECT_EQ(compare({layers}, {"-s", "512", "-q"}).err, "");
    render(candidate, {"--integrator", "bdpt", "--keep-batches"});
    const Outcome batch = compare({candidate}, {"--layer", "batch.0001"});
    EXPECT_EQ(batch.status, 2);
    EXPECT_NE(batch.err.find("is one batch: give its samples by -s"), std::string::npos) << batch.err;
}

/// directional_over_plane with a mirror that stands on the plane: half of the light has paths of 3
/// edges.
std::string scene_with_mirror()
{
    std::string text = read_bytes(scene_file("directional_over_plane"));
    const auto insert_before = [&](const char* mark, const std::string& what) {
        text.insert(text.rfind(mark), what);
    };
    insert_before(
        "</library_effects>",
        R"(<effect id="mirror-effect"><profile_COMMON><technique sid="common"><lambert/></technique>
                  </profile_COMMON><extra><technique profile="CMU462"><mirror><reflectance>0.9 0.9 0.9
                  </reflectance></mirror></technique></extra></effect>)");
    insert_before("</library_materials>",
                  R"(<material id="mirror"><instance_effect url="#mirror-effect"/></material>)");
    insert_before(
        R"(<node id="ball-node">)",
        R"(<node id="mirror-node"><matrix>0.16 0 0.6 0.3  0.12 0 -0.8 0.2  0 0.2 0 0  0 0 0 1</matrix>
                  <instance_geometry url="#plane"><bind_material><technique_common>
                  <instance_material symbol="ground" target="#mirror"/>
                  </technique_common></bind_material></instance_geometry></node>)");
    return text;
}

TEST_F(CompareCommand, RendersOfTheSceneFindMoreMistakes)
{
    const std::string scene = (folder / "mirror.dae").string();
    const std::string other = (folder / "other.dae").string(); // the same angle along the other axis
    const std::string wrong = (folder / "wrong.pfm").string();
    std::string text = scene_with_mirror();
    write_bytes(scene, text);
    for (std::size_t place = text.find("yfov>"); place != std::string::npos; place = text.find("yfov>"))
        text[place] = 'x';
    write_bytes(other, text);
    golden_file = (folder / "mirror.exr").string();
    ASSERT_EQ(run({"golden", scene, "--folder", folder.path().string(), "--size", "18x12", "--batch",
                   "8", "--pilot", "64", "-s", "2048", "--max-edges", "3", "-q"})
                  .status,
              0);
    const auto render_wrong = [&](const std::string& file, const char* edges) {
        const Outcome outcome =
            run({"render", file, "-o", wrong, "--size", "18x12", "-s", "1024", "--batch", "8",
                 "--integrator", "bdpt", "--max-edges", edges, "-q"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    };
    const auto expect = [&](const std::string& mistake) {
        const Outcome outcome = compare({wrong}, {"-s", "1024", "--scene", scene});
        // Of 216 pixels few differ: one picture may be suspicious only.
        EXPECT_NE(outcome.status, 0) << outcome.err << outcome.out;
        EXPECT_NE(outcome.out.find("Your picture is " + mistake), std::string::npos) << outcome.out;
    };
    render_wrong(scene, "2");
    expect("one of direct light alone");
    const Outcome hint = compare({wrong}, {"-s", "1024"});
    EXPECT_NE(hint.out.find("--scene FILE"), std::string::npos) << hint.out;
    const Outcome not_its_scene = compare({wrong}, {"-s", "1024", "--scene", other});
    EXPECT_EQ(not_its_scene.status, 2);
    EXPECT_EQ(not_its_scene.err,
              "plumbline: --scene " + other + ": is not the scene of the golden (mirror)\n");

    render_wrong(other, "3");
    expect("one in which the vertical field of view was taken for the horizontal one");
}

TEST_F(CompareCommand, HalfAPixelIsFoundByARenderOfTheScene)
{
    // Pixels of half the size, taken together one to the left and above of where they should be.
    const std::string wrong = (folder / "wrong.pfm").string();
    ASSERT_EQ(run({"render", scene_file("directional_over_plane"), "-o", wrong, "--integrator", "bdpt",
                   "--size", "32x32", "-s", "128", "--batch", "8", "--max-edges", "6"})
                  .status,
              0);
    const images::Image fine = images::read_pfm(wrong);
    images::Image shifted(16, 16);
    for (int y = 0; y < shifted.height; ++y)
        for (int x = 0; x < shifted.width; ++x)
            for (int i = 0; i < 4; ++i)
                shifted.at(x, y) +=
                    0.25 * fine.at(std::max(0, 2 * x - 1 + i % 2), std::max(0, 2 * y - 1 + i / 2));
    images::write_pfm(wrong, shifted);
    const Outcome outcome =
        compare({wrong}, {"-s", "512", "--scene", scene_file("directional_over_plane")});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_NE(outcome.out.find("Your picture is shifted by half a pixel to the right and downwards"),
              std::string::npos)
        << outcome.out;
}

TEST_F(CompareCommand, PrintsOneJsonObject)
{
    render(candidate, {"--integrator", "bdpt", "--keep-batches"});
    const Outcome outcome = compare({candidate}, {"--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json.at("verdict"), "PASS");
    EXPECT_EQ(json.at("whole").size(), 3u);
    EXPECT_LE(json.at("whole")[0].at("low"), json.at("whole")[0].at("ratio"));
    EXPECT_LE(json.at("whole")[0].at("ratio"), json.at("whole")[0].at("high"));
    EXPECT_LE(json.at("detectable")[0], 0.005);
    EXPECT_LT(json.at("golden_limit")[0], json.at("detectable")[0]);
    EXPECT_EQ(json.at("odd_pixels").size(), 0u);
    EXPECT_EQ(json.at("tiles")[0].at("z").size(), json.at("tiles")[0].at("columns").get<std::size_t>() *
                                                      json.at("tiles")[0].at("rows").get<std::size_t>());
}

TEST_F(CompareCommand, WritesAPageAlsoOnFailure)
{
    render(candidate, {"--integrator", "bdpt"});
    const std::string page = (folder / "report.html").string();
    EXPECT_EQ(compare({altered(0.9)}, {"-s", "512", "--report", page}).status, 1);
    const std::string html = read_bytes(page);
    EXPECT_EQ(html.rfind("<!DOCTYPE html>", 0), 0u);
    EXPECT_NE(html.find("<strong>FAIL.</strong>"), std::string::npos);
    EXPECT_EQ(html.find("http://"), std::string::npos) << "loads something";
    EXPECT_EQ(html.find("https://"), std::string::npos) << "loads something";
    EXPECT_EQ(html.find("@DATA@"), std::string::npos);
}

TEST_F(CompareCommand, InputsThatCannotBeComparedAreNamedInOneLine)
{
    render(candidate, {"--integrator", "bdpt"});
    const std::string plain = altered(1.0); // no metadata
    const std::string other_size = (folder / "size.exr").string();
    ASSERT_EQ(run({"render", scene_file("directional_over_plane"), "-o", other_size, "--size", "8x8",
                   "-s", "4"})
                  .status,
              0);
    const std::string other_scene = (folder / "scene.exr").string();
    render(other_scene, {}, "spot_over_plane");
    const std::string not_a_number = (folder / "nan.pfm").string();
    images::Image broken(16, 16);
    broken.at(3, 4).y = std::numeric_limits<double>::quiet_NaN();
    images::write_pfm(not_a_number, broken);

    const struct {
        Arguments arguments;
        const char* complaint;
    } mistakes[] = {
        {{"compare"}, "pictures"},
        {{"compare", candidate}, "pictures"},
        {{"compare", candidate, (folder / "none.exr").string()}, "none.exr"},
        {{"compare", candidate, candidate}, "candidate.exr"}, // no golden
        {{"compare", (folder / "none.exr").string(), golden_file}, "none.exr"},
        {{"compare", plain, golden_file}, "give -s"},
        {{"compare", plain, golden_file, "-s", "0"}, "--samples"},
        {{"compare", plain, golden_file, "-s", "256", "--integrator", "path"}, "--integrator"},
        {{"compare", plain, golden_file, "-s", "256", "--device", "host"}, "--device"},
        {{"compare", plain, plain, golden_file, "-s", "256"}, "not independent"},
        {{"compare", other_size, golden_file}, "8x8"},
        {{"compare", other_scene, golden_file}, "scene"},
        {{"compare", not_a_number, golden_file, "-s", "4"}, "(3, 4)"},
        {{"compare", plain, golden_file, "-s", "4", "--layer", "a"}, "--layer"},
        {{"compare", scene_file("directional_over_plane"), golden_file, "--layer", "a"}, "--layer"},
        {{"compare", candidate, golden_file, "--report", "page.txt"}, "--report"},
        {{"compare", candidate, golden_file, "--report", "/nowhere/page.html"}, "/nowhere"},
        {{"compare", scene_file("spot_over_plane"), golden_file}, "scene"},
        {{"compare", scene_file("directional_over_plane"), candidate, golden_file}, "alone"},
    };
    for (const auto& [arguments, complaint] : mistakes) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << complaint << '\n' << outcome.out;
        EXPECT_NE(outcome.err.find(complaint), std::string::npos) << complaint << '\n' << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
}

} // namespace
