// Two outputs to the same file are an error before any work is done, even if the names are spelt
// differently. An output that is also an input is an error too.

#include "tests/cli/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace cli_test;
namespace fs = std::filesystem;

class OutputFiles : public testing::Test {
protected:
    TemporaryFolder folder;
    std::string scene = (folder / "room.dae").string();
    std::string out = (folder / "a.exr").string();

    OutputFiles() { write_bytes(scene, read_bytes(scene_file("point_over_plane"))); }

    [[nodiscard]] std::vector<std::string> contents() const
    {
        std::vector<std::string> all;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            if (entry.is_regular_file())
                all.push_back(entry.path().filename().string() + ": " + read_bytes(entry.path()));
        std::ranges::sort(all);
        return all;
    }

    /// Expects exit status 2, one line that contains all of `names`, and no change of any file.
    void expect_refused(const Arguments& arguments, const std::vector<std::string>& names) const
    {
        const auto before = contents();
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("are the same file"), std::string::npos) << outcome.err;
        for (const std::string& name : names)
            EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
        EXPECT_TRUE(contents() == before);
    }
    [[nodiscard]] Arguments render(const Arguments& more) const
    {
        return Arguments{"render", scene, "-o", out, "--size", "6x4", "-s", "4", "--max-edges", "3"} +
               more;
    }
};

TEST_F(OutputFiles, ThePictureIsNotTheLayersOfStrategies)
{
    expect_refused(render({"--strategies", out}), {"-o " + out, "--strategies " + out});
}

TEST_F(OutputFiles, ThePictureIsNotTheSheetOfStrategies)
{
    const std::string png = (folder / "a.png").string();
    expect_refused(render({"-o", png, "--strategies-picture", png}),
                   {"-o " + png, "--strategies-picture " + png});
}

TEST_F(OutputFiles, OneFileByAnotherSpelling)
{
    const std::string dotted = (folder / "." / "a.exr").string();
    const std::string back = (folder / "." / ".." / folder.path().filename() / "a.exr").string();
    for (const std::string& name : {out, dotted, back}) expect_refused(render({"-o", name}), {name});
    const std::string relative = fs::relative(out).string();
    ASSERT_NE(relative, out);
    expect_refused(render({"--strategies", relative}), {relative});
}

TEST_F(OutputFiles, OneFileBehindALink)
{
    write_bytes(out, "earlier");
    const std::string link = (folder / "link.exr").string();
    fs::create_symlink(out, link);
    expect_refused(render({"-o", link}), {link});
    const std::string hard_link = (folder / "hard.exr").string();
    fs::create_hard_link(out, hard_link);
    expect_refused(render({"--strategies", hard_link}), {hard_link});
    fs::create_directory(folder / "real");
    fs::create_directory_symlink(folder / "real", folder / "door");
    expect_refused(render({"-o", (folder / "real" / "b.exr").string(), "--strategies",
                           (folder / "door" / "b.exr").string()}),
                   {"door"});
}

TEST_F(OutputFiles, NeverTheSceneItself)
{
    const std::string link = (folder / "picture.exr").string();
    fs::create_symlink(scene, link);
    expect_refused({"render", scene, "-o", link, "--size", "6x4", "-s", "4"}, {link, scene});
    const std::string png = (folder / "tree.png").string();
    fs::create_hard_link(scene, png);
    expect_refused({"bvh", scene, "--picture", png}, {"--picture " + png, scene});
}

TEST_F(OutputFiles, NeverWhatIsCompared)
{
    write_bytes(out, "picture");
    const std::string page = (folder / "page.html").string();
    fs::create_symlink(out, page);
    expect_refused({"compare", out, (folder / "golden.exr").string(), "--report", page},
                   {"--report " + page, out});
    expect_refused({"compare", (folder / "b.exr").string(), out, "--report", page},
                   {"--report " + page, out});
}

TEST_F(OutputFiles, NeverOneGoldenOfTwoScenes)
{
    fs::create_directory(folder / "other");
    const std::string other = (folder / "other" / "room.dae").string();
    write_bytes(other, read_bytes(scene_file("sphere_over_plane")));
    expect_refused({"golden", scene, other, "--folder", folder.path().string()}, {scene, other});
}

TEST_F(OutputFiles, DifferentFilesAreWrittenTogether)
{
    const std::string layers = (folder / "b.exr").string();
    const std::string sheet = (folder / "a.png").string(); // differs only in the ending
    const Outcome outcome = run(render({"--strategies", layers, "--strategies-picture", sheet}));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const std::string& file : {out, layers, sheet}) EXPECT_TRUE(fs::exists(file)) << file;
}

} // namespace
