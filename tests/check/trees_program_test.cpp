// `plumbline check-tree` and `plumbline check-builder` as a user runs them.

#include "check/npy.h"
#include "check/trees/check_tree.h"
#include "check/trees/inputs.h"
#include "check/trees/tree_files.h"
#include "ref/trees/bvh.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>

namespace {

using cli_test::Arguments;
using cli_test::Outcome;
using cli_test::run;
using cli_test::TemporaryFolder;
using cli_test::write_bytes;
using cli_test::operator+;
using Json = nlohmann::json;

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// Ten boxes and our tree over them, as files.
struct TreeOnDisk {
    TemporaryFolder folder;
    std::string primitives = (folder / "p.npy").string();
    std::string tree = (folder / "tree").string();
    check::NeutralTree built;

    TreeOnDisk()
    {
        const auto boxes = check::input_boxes(check::InputKind::uniform, 10, 1);
        built = check::neutral(ref::build(boxes, ref::Builder::morton63));
        write_bytes(primitives, check::primitives_bytes(boxes, {}));
        write();
    }
    void write() const
    {
        std::filesystem::create_directory(tree);
        const std::array nodes_shape{built.size(), std::size_t{4}};
        write_bytes(tree + "/nodes.npy", check::npy_bytes(nodes_shape, built.nodes));
        write_bytes(tree + "/boxes.npy", check::primitives_bytes(built.boxes, {}));
        write_bytes(tree + "/primitives.npy",
                    check::npy_bytes(std::array{built.primitives.size()}, built.primitives));
    }
};

TEST(CheckTreeCommand, PassesARightTree)
{
    const TreeOnDisk files;
    const Outcome outcome = run({"check-tree", files.primitives, files.tree});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.out, "10 primitives, 19 nodes, 10 leaves")) << outcome.out;
    EXPECT_TRUE(says(outcome.out, "holds  one-parent")) << outcome.out;
    EXPECT_TRUE(says(outcome.out, "SAH cost: ")) << outcome.out;
    EXPECT_FALSE(says(outcome.out, "FAILS")) << outcome.out;
}

TEST(CheckTreeCommand, ReportsAWrongTreeInJson)
{
    TreeOnDisk files;
    files.built.boxes[3].upper.x = 99;
    files.write();
    const Outcome outcome = run({"check-tree", files.primitives, files.tree, "--json"});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_FALSE(json["passes"].get<bool>());
    std::size_t failing = 0;
    for (const Json& property : json["properties"]) failing += property["verdict"] == "fails" ? 1 : 0;
    EXPECT_EQ(failing, 2U) << outcome.out; // too large itself, and for its parent
    EXPECT_EQ(json["shape"]["root"], 0);
    EXPECT_TRUE(json["sah_cost"].is_null());
}

TEST(CheckTreeCommand, RejectsBadInputInOneLine)
{
    const TreeOnDisk files;
    auto boxes = check::input_boxes(check::InputKind::nan, 5, 1);
    const std::string bad = (files.folder / "bad.npy").string();
    write_bytes(bad, check::primitives_bytes(boxes, {}));
    for (const Arguments& arguments :
         {Arguments{bad, files.tree}, Arguments{files.primitives, "missing"},
          Arguments{"missing", files.tree}, Arguments{files.tree, files.tree},
          Arguments{files.primitives, files.primitives},
          Arguments{files.primitives, files.tree, "--morton", "31"}, Arguments{files.primitives}}) {
        const Outcome outcome = run(Arguments{"check-tree"} + arguments);
        EXPECT_EQ(outcome.status, 2) << outcome.out;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    }
    EXPECT_TRUE(says(run({"check-tree", bad, files.tree}).err, "bad.npy: primitive "));
}

/// check-builder on tests/check/wrong_builder.cpp with this defect.
Outcome check_builder(const std::string& defect, const std::string& keep, const Arguments& options)
{
    return run(Arguments{"check-builder", "--keep", keep} + options +
               Arguments{"--", WRONG_BUILDER, defect, "{primitives}", "{tree}"});
}

TEST(CheckBuilderCommand, PassesARightProgram)
{
    const TemporaryFolder folder;
    const std::string keep = (folder / "keep.npy").string();
    for (const Arguments& format : {Arguments{}, Arguments{"--triangles"}}) {
        const Outcome outcome =
            check_builder("none", keep, format + Arguments{"--largest", "8", "--cases", "0"});
        EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
        EXPECT_TRUE(says(outcome.out, "No input fails.")) << outcome.out;
        EXPECT_TRUE(says(outcome.out, "nan        ")) << outcome.out;
    }
    EXPECT_EQ(folder.entries(), 0U);
}

TEST(CheckBuilderCommand, KeepsTheSmallestInputOfEveryFailure)
{
    struct Case {
        const char* defect;
        const char* problem;
        std::size_t most;
        Arguments options;
    };
    const Arguments few = {"--largest", "8", "--cases", "0", "--json"};
    const std::vector<Case> cases = {
        {"one_primitive", "crash", 1, few + Arguments{"--only", "uniform"}},
        {"tiny_input", "timeout", 2, few + Arguments{"--only", "uniform", "--timeout", "0.2"}},
        {"writes_no_tree", "no-tree", 0, few + Arguments{"--only", "uniform"}},
        {"writes_garbage", "no-tree", 0, few + Arguments{"--only", "uniform"}},
        {"accepts_nan", "accepted-nan", 1, few + Arguments{"--only", "nan"}},
        {"shared_child", "one-parent", 3, few + Arguments{"--only", "coincident"}},
    };
    for (const auto& [defect, problem, most, options] : cases) {
        const TemporaryFolder folder;
        const std::string keep = (folder / "keep.npy").string();
        const Outcome outcome = check_builder(defect, keep, options);
        EXPECT_EQ(outcome.status, 1) << defect << outcome.out << outcome.err;
        const Json json = Json::parse(outcome.out);
        EXPECT_EQ(json["smallest"]["problem"]["name"], problem) << outcome.out;
        EXPECT_LE(check::read_primitives(keep).boxes.size(), most) << defect;

        // The kept file fails again.
        const Arguments short_time =
            problem == std::string("timeout") ? Arguments{"--timeout", "0.2"} : Arguments{};
        const Outcome again = check_builder(defect, (folder / "again.npy").string(),
                                            short_time + Arguments{"--input", keep, "--json"});
        EXPECT_EQ(again.status, 1) << defect << again.out << again.err;
        EXPECT_EQ(Json::parse(again.out)["smallest"]["problem"]["name"], problem) << again.out;
    }
}

TEST(CheckBuilderCommand, FindsAProgramThatRefusesEverything)
{
    const TemporaryFolder folder;
    const Outcome outcome = run({"check-builder", "--keep", (folder / "keep.npy").string(), "--only",
                                 "grid", "--json", "--", WRONG_BUILDER, "{primitives}", "{tree}"});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["smallest"]["problem"]["name"], "rejected");
}

TEST(CheckBuilderCommand, GivesEveryRunAnEmptyFolder)
{
    // Builds a tree in its first run only.
    const TemporaryFolder folder;
    const std::string once = (folder / "once").string();
    const std::string script = "test -e " + once + " && exit 0; touch " + once + "; exec " +
                               WRONG_BUILDER + " none {primitives} {tree}";
    const Outcome outcome = run({"check-builder", "--keep", (folder / "keep.npy").string(), "--only",
                                 "grid", "--json", "--", "sh", "-c", script});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["kinds"][0]["tried"], 2) << outcome.out;
    EXPECT_EQ(json["kinds"][0]["problem"]["name"], "no-tree") << outcome.out;
}

TEST(CheckBuilderCommand, KeepsWhatFailedBeforeAnInterruption)
{
    const TemporaryFolder folder;
    const std::string keep = (folder / "keep.npy").string();
    const std::string crashed = (folder / "crashed").string();
    const std::string started = (folder / "started").string();
    // Crashes in its first run, and takes long in its second.
    const std::string script = "test -e " + crashed + " && touch " + started + " && sleep 60; touch " +
                               crashed + "; kill -SEGV $$";
    cli_test::Process process({"check-builder", "--keep", keep, "--only", "grid", "--", "sh", "-c",
                               script + " # {primitives} {tree}"});
    ASSERT_TRUE(cli_test::eventually([&] { return std::filesystem::exists(started); }));
    process.send(SIGINT);
    const Outcome outcome = process.finish();
    EXPECT_EQ(outcome.status, 130) << outcome.out << outcome.err;
    EXPECT_TRUE(says(outcome.out, "interrupted")) << outcome.out;
    EXPECT_FALSE(check::read_primitives(keep).boxes.empty());
}

TEST(CheckBuilderCommand, SaysInWordsWhatFailedAndHowToRepeatIt)
{
    const TemporaryFolder folder;
    const std::string keep = (folder / "keep.npy").string();
    const Outcome outcome =
        check_builder("shared_child", keep, {"--largest", "8", "--cases", "0", "--only", "coincident"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(says(outcome.out, "coincident FAILS for n = 3: one-parent: node ")) << outcome.out;
    EXPECT_TRUE(says(outcome.out, "  primitive 0: (0, 0, 0) to (0, 0, 0)")) << outcome.out;
    EXPECT_TRUE(says(outcome.out, "plumbline check-builder --input " + keep + " -- ")) << outcome.out;
}

TEST(CheckBuilderCommand, RejectsBadUsageInOneLine)
{
    const TemporaryFolder folder;
    const std::string keep = (folder / "keep.npy").string();
    const Arguments command = {"--", WRONG_BUILDER, "none", "{primitives}", "{tree}"};
    const std::vector<Arguments> wrong = {
        {"--keep", keep},
        {"--keep", keep, "--", WRONG_BUILDER, "{primitives}"},
        {"--keep", keep, "--", WRONG_BUILDER, "{primitives}", "{tree}", "{scene}"},
        {"--keep", keep, "--", (folder / "no_program").string(), "{primitives}", "{tree}"},
        Arguments{"--keep", (folder / "no_folder" / "x.npy").string()} + command,
        Arguments{"--keep", keep, "--only", "round"} + command,
        Arguments{"--keep", keep, "--only", "nan", "--skip", "nan"} + command,
        Arguments{"--keep", keep, "--timeout", "0"} + command,
        Arguments{"--keep", keep, "--input", "missing.npy"} + command,
    };
    for (const Arguments& arguments : wrong) {
        const Outcome outcome = run(Arguments{"check-builder"} + arguments);
        EXPECT_EQ(outcome.status, 2) << outcome.out << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    }
    EXPECT_EQ(folder.entries(), 0U);
}

TEST(OwnCodeDocument, NamesEveryKindOfInputAndEveryProperty)
{
    const std::string text =
        cli_test::read_bytes(std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "docs/own-code.md");
    for (const check::InputKind kind : check::input_kinds)
        EXPECT_TRUE(says(text, "`" + name(kind) + "`")) << name(kind);
    const TreeOnDisk files;
    const auto boxes = check::input_boxes(check::InputKind::uniform, 10, 1);
    for (const check::Property& property :
         check_tree(files.built, boxes, {true, 9, 30, false}).properties)
        EXPECT_TRUE(says(text, "| `" + property.name + "` | ")) << property.name;
}

} // namespace
