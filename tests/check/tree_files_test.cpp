// Files of primitives and of trees, as other programs and people write them.

#include "check/trees/tree_files.h"

#include "check/npy.h"
#include "check/trees/check_tree.h"
#include "check/trees/inputs.h"
#include "images/image_error.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace {

using check::NeutralTree;
using images_test::TemporaryFolder;
using images_test::write_bytes;

std::string message_of(const std::function<void()>& read)
{
    try {
        read();
    } catch (const images::ImageError& error) {
        const std::string text = error.what();
        return text.substr(text.rfind('/') + 1);
    }
    return "no error";
}

TEST(TreeFiles, GiveTrianglesTheBoxesThatTheyAreMadeFrom)
{
    const TemporaryFolder folder;
    for (const bool triangles : {false, true})
        for (const bool single_precision : {false, true}) {
            const auto boxes = check::input_boxes(check::InputKind::mixed, 50, 3, single_precision);
            write_bytes(folder / "p.npy", check::primitives_bytes(boxes, {triangles, single_precision}));
            const check::Primitives read = check::read_primitives(folder / "p.npy");
            EXPECT_EQ(read.boxes, boxes);
            EXPECT_EQ(read.format.triangles, triangles);
            EXPECT_EQ(read.format.single_precision, single_precision);
        }
}

TEST(TreeFiles, ReadJsonThatPeopleWrite)
{
    const check::Primitives primitives = check::primitives_of_json(
        R"({"triangles": [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 5], [1, 0, 5], [0, 1, 6]]]})",
        "p.json");
    const std::vector<ref::Aabb> boxes = {{{0, 0, 0}, {1, 1, 0}}, {{0, 0, 5}, {1, 1, 6}}};
    EXPECT_EQ(primitives.boxes, boxes);
    const NeutralTree tree = check::tree_of_json(
        R"({"root": 2, "nodes": [{"box": [0, 0, 0, 1, 1, 0], "primitives": [0]},
                                 {"box": [0, 0, 5, 1, 1, 6], "primitives": [1]},
                                 {"box": [[0, 0, 0], [1, 1, 6]], "children": [0, 1]}]})",
        "t.json");
    EXPECT_TRUE(check::check_tree(tree, boxes).passes());
}

TEST(TreeFiles, NameWhatIsWrongWithPrimitives)
{
    const TemporaryFolder folder;
    const auto of_npy = [&](const std::string& bytes) {
        write_bytes(folder / "p.npy", bytes);
        return message_of(
            [&] { expect_legal(check::read_primitives(folder / "p.npy"), folder / "p.npy"); });
    };
    const auto floats = [](std::vector<std::size_t> shape, std::vector<double> numbers) {
        return check::npy_bytes(shape, numbers, true);
    };
    EXPECT_EQ(of_npy(floats({1, 5}, {1, 2, 3, 4, 5})),
              "p.npy: has the shape (1, 5): it must be (n, 6) for boxes, or (n, 3, 3) for triangles");
    EXPECT_EQ(of_npy(floats({1, 6}, {0, 0, NAN, 1, 1, 1})),
              "p.npy: primitive 0: its box has z from nan to 1");
    EXPECT_EQ(of_npy(floats({2, 6}, {0, 0, 0, 1, 1, 1, 0, 2, 0, 1, 1, 1})),
              "p.npy: primitive 1: its box has y from 2 to 1");
    EXPECT_EQ(of_npy(floats({1, 3, 3}, {0, 0, 0, 1, NAN, 1, 2, 2, 2})),
              "p.npy: primitive 0: its box has y from nan to nan");
    EXPECT_EQ(of_npy(check::npy_bytes(std::array{std::size_t{1}, std::size_t{6}},
                                      std::array<std::int64_t, 6>{})),
              "p.npy: holds int32: there must be float32 or float64");
    const auto of_json = [](const char* text) {
        return message_of([&] { check::primitives_of_json(text, "p.json"); });
    };
    EXPECT_TRUE(of_json("{").starts_with("p.json: is no JSON: "));
    EXPECT_EQ(of_json("[]"), "p.json: must hold one JSON object");
    EXPECT_EQ(of_json("{}"), "p.json: the object has no array \"boxes\"");
    EXPECT_EQ(of_json(R"({"boxes": [[0, 0, 0, 1, 1, 1], [1]]})"),
              "p.json: primitive 1 has 1 numbers: there must be 6");
    EXPECT_EQ(of_json(R"({"boxes": [[0, 0, 0, 1, 1, "1"]]})"),
              "p.json: primitive 0: \"1\" is no number");
}

TEST(TreeFiles, NameWhatIsWrongWithATree)
{
    const TemporaryFolder folder;
    const auto message = [&] { return message_of([&] { check::read_tree(folder.path()); }); };
    const auto write = [&](const char* name, std::vector<std::size_t> shape,
                           std::vector<std::int64_t> numbers) {
        write_bytes(folder / name, check::npy_bytes(shape, numbers));
    };
    EXPECT_NE(message().find("nodes.npy"), std::string::npos) << message();
    write("nodes.npy", {1, 3}, {-1, 0, 1});
    EXPECT_EQ(
        message(),
        "nodes.npy: has the shape (1, 3): it must be (m, 4), or (m, k + 2) for nodes of k children");
    write("nodes.npy", {1, 4}, {-1, -1, 0, 1});
    write("boxes.npy", {1, 6}, {0, 0, 0, 1, 1, 1});
    EXPECT_EQ(message(), "boxes.npy: holds int32: there must be float32 or float64");
    write_bytes(folder / "boxes.npy", check::primitives_bytes(std::vector<ref::Aabb>(1), {}));
    write("primitives.npy", {1, 2}, {0, 0});
    EXPECT_EQ(message(), "primitives.npy: has the shape (1, 2): it must be (n,)");
    write("primitives.npy", {1, 1}, {0});
    EXPECT_EQ(message(), "no error");
    write("parents.npy", {1, 2}, {-1, -1});
    EXPECT_EQ(message(), "parents.npy: has the shape (1, 2): it must be (m,)");
    std::filesystem::remove(folder / "parents.npy");
    for (const char* name : {"nodes.npy", "boxes.npy", "primitives.npy"}) // numpy.array([])
        write_bytes(folder / name, check::npy_bytes(std::array{std::size_t{0}}, {}, false));
    EXPECT_TRUE(check::check_tree(check::read_tree(folder.path()), {}).passes());
    EXPECT_EQ(message_of([&] { check::read_tree(folder / "missing"); }), "missing: does not exist");
    EXPECT_EQ(message_of([&] { check::read_tree(folder / "nodes.npy"); }),
              "nodes.npy: is neither a folder nor a .json file");

    const auto of_json = [](const char* text) {
        return message_of([&] { check::tree_of_json(text, "t.json"); });
    };
    EXPECT_EQ(of_json(R"({"nodes": [3]})"), "t.json: node 0 must be an object");
    EXPECT_EQ(of_json(R"({"nodes": [{}]})"), "t.json: node 0 has no array \"box\"");
    EXPECT_EQ(of_json(R"({"nodes": [{"box": [0, 0, 0, 1, 1, 1], "children": [0.5, 1]}]})"),
              "t.json: node 0: 0.5 is no whole number");
    EXPECT_EQ(
        of_json(
            R"({"nodes": [{"box": [0, 0, 0, 1, 1, 1], "parent": null}, {"box": [0, 0, 0, 1, 1, 1]}]})"),
        "t.json: some nodes name their \"parent\", and some do not");
}

} // namespace
