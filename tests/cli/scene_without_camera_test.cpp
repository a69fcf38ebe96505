// Scenes without a camera, and scenes from standard input.

#include "images/pfm.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace {

using namespace cli_test;

/// The text of a scene of this repository.
std::string text_of(const std::string& name)
{
    return read_bytes(scene_file(name));
}

/// `text` with the first `from` replaced by `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::invalid_argument("no " + from + " in the scene");
    return text.replace(at, from.size(), to);
}

/// `text` without any <instance_camera>.
std::string without_camera(std::string text)
{
    const std::size_t begin = text.find("<instance_camera");
    if (begin == std::string::npos) throw std::invalid_argument("no camera in the scene");
    return text.erase(begin, text.find("/>", begin) + 2 - begin);
}

class SceneWithoutCamera : public testing::Test {
protected:
    std::string write(const std::string& text, const std::string& name = "room.dae")
    {
        write_bytes(folder / name, text);
        return (folder / name).string();
    }
    TemporaryFolder folder;
};

TEST_F(SceneWithoutCamera, IsFramedWithANotice)
{
    const std::string file = write(without_camera(text_of("cornell_diffuse")));
    const std::string picture = (folder / "a.pfm").string();
    const Outcome outcome = run({"render", file, "-o", picture, "--size", "24x16", "-s", "4"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("no camera: seen from the front, right and above"), std::string::npos)
        << outcome.err;
    const Outcome trees =
        run({"bvh", file, "--builder", "sah", "--json", "--size", "24x16", "--repeats", "1"});
    EXPECT_EQ(trees.status, 0) << trees.err;
    EXPECT_NE(trees.err.find("no camera: seen from the front"), std::string::npos) << trees.err;
    // The scene is in view: rays hit it.
    const auto builder = nlohmann::json::parse(trees.out)["builders"][0];
    EXPECT_GT(builder["camera_primitives_per_ray"].get<double>(), 0.1);
}

TEST_F(SceneWithoutCamera, AndWithoutGeometryIsAnError)
{
    const std::string file = write("<COLLADA version=\"1.4.1\"><library_visual_scenes><visual_scene "
                                   "id=\"s\"/></library_visual_scenes>"
                                   "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
    const std::string picture = (folder / "a.pfm").string();
    for (const Arguments& arguments : {Arguments{"render", file, "-o", picture}, {"bvh", file}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.err, "plumbline: " + file +
                                   ": the scene has no camera, and no geometry to place one before\n");
    }
    EXPECT_FALSE(std::filesystem::exists(picture));
}

// A tree needs only triangles. Errors in the light, the material or the camera do not matter.
TEST_F(SceneWithoutCamera, HasTreesWhateverItsLightsMaterialsAndCameraAre)
{
    const auto cost = [&](const std::string& text) {
        const Outcome outcome =
            run({"bvh", write(text), "--builder", "sah", "--json", "--size", "4x4", "--repeats", "1"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const auto json = nlohmann::json::parse(outcome.out);
        return std::pair(json["primitives"].get<int>(), json["builders"][0]["sah_cost"].get<double>());
    };
    const std::string room = text_of("cornell_diffuse");
    const auto right = cost(room);
    EXPECT_EQ(cost(replaced(room, "<diffuse>", "<diffuse><texture texture=\"t\" texcoord=\"u\"/>")),
              right);
    EXPECT_EQ(cost(replaced(room, "<bind_material>", "<bind_material><none/>")), right);
    EXPECT_EQ(
        cost(replaced(room, "<instance_camera", "<instance_light url=\"#none\"/><instance_camera")),
        right);
    EXPECT_EQ(cost(replaced(room, "<perspective>", "<perspective><none/>")), right);
    EXPECT_EQ(cost(without_camera(room)), right);
}

TEST_F(SceneWithoutCamera, ACameraThatCannotBeReadIsANoticeForBvhAndAnErrorForRender)
{
    const std::string file =
        write(replaced(text_of("cornell_diffuse"), "<perspective>", "<perspective><none/>"));
    const Outcome trees = run({"bvh", file, "--builder", "sah", "--size", "4x4", "--repeats", "1"});
    EXPECT_EQ(trees.status, 0);
    EXPECT_NE(trees.err.find(": this camera is not used"), std::string::npos) << trees.err;
    EXPECT_EQ(run({"render", file, "-o", (folder / "a.pfm").string()}).status, 2);
}

/// `arguments` with standard input from `file`.
Outcome run_with_input(const std::string& file, const Arguments& arguments)
{
    std::string command = "exec \"$0\" \"$@\" < \"$INPUT\"";
    setenv("INPUT", file.c_str(), 1);
    return run(Arguments{"-c", command, PLUMBLINE_PROGRAM} + arguments, {.program = "/bin/sh"});
}

TEST_F(SceneWithoutCamera, OrAnyFromStandardInputGivesThePictureOfItsFile)
{
    const std::string scene = scene_file("cornell_diffuse");
    const std::string a = (folder / "a.pfm").string();
    const std::string b = (folder / "b.pfm").string();
    const Arguments more = {"--size", "12x8", "-s", "4", "-q", "--json"};
    EXPECT_EQ(run(Arguments{"render", scene, "-o", a} + more).status, 0);
    const Outcome piped = run_with_input(scene, Arguments{"render", "-", "-o", b} + more);
    EXPECT_EQ(piped.status, 0) << piped.err;
    EXPECT_EQ(read_bytes(a), read_bytes(b));
    EXPECT_EQ(nlohmann::json::parse(piped.out)["scene"], "stdin");

    const Outcome trees = run_with_input(
        scene, {"bvh", "-", "--builder", "sah", "--json", "--size", "4x4", "--repeats", "1"});
    EXPECT_EQ(trees.status, 0) << trees.err;
    EXPECT_EQ(nlohmann::json::parse(trees.out)["scene"], "stdin");
}

TEST_F(SceneWithoutCamera, StandardInputIsNamedInMessages)
{
    const std::string file =
        write(replaced(text_of("cornell_diffuse"), "<perspective>", "<perspektive>"));
    const std::string picture = (folder / "a.pfm").string();
    for (const Arguments& arguments : {Arguments{"render", "-", "-o", picture}, {"bvh", "-"}}) {
        const Outcome outcome = run_with_input(file, arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_TRUE(outcome.err.starts_with("plumbline: <stdin>:")) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        const Outcome empty = run_with_input("/dev/null", arguments);
        EXPECT_EQ(empty.err, "plumbline: <stdin>:1: the file is empty\n");
    }
}

} // namespace
