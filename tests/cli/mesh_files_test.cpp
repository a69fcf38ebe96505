// `plumbline bvh` on mesh files: the same box in each format, and damaged files.

#include "scenes/read_mesh.h"
#include "scenes/read_scene.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace {

using namespace cli_test;

// A build without Assimp reads no meshes. This test links the source file of such a build.
TEST(MeshFilesNone, ABuildWithoutAssimpSaysSo)
{
    try {
        (void)scenes::read_mesh("folder/cube.obj");
        FAIL() << "nothing was thrown";
    } catch (const scenes::SceneError& error) {
        EXPECT_STREQ(error.what(), "cube.obj: .obj files are read by the library Assimp, and this build "
                                   "is without it");
    }
}

// A box of 1 x 2 x 4 with one corner at the origin. Each side has four corners, counter-clockwise as
// seen from outside.
constexpr std::array<std::array<float, 3>, 8> corners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 4}, {1, 0, 4}, {1, 2, 4}, {0, 2, 4}}};
constexpr std::array<std::array<std::uint16_t, 4>, 6> sides = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
constexpr std::size_t triangles = 12;

/// Calls visit(a, b, c) with the corners of each triangle. Each side is a triangle fan around its first
/// corner.
template <typename Visit>
void for_each_triangle(Visit visit)
{
    for (const auto& side : sides)
        for (const std::size_t i : {1u, 2u}) visit(side[0], side[i], side[i + 1]);
}

std::string text_of(const std::array<float, 3>& v)
{
    std::ostringstream text;
    text << v[0] << ' ' << v[1] << ' ' << v[2];
    return text.str();
}

std::string all_corners(const std::string& before, const std::string& after)
{
    std::string text;
    for (const auto& corner : corners) text += before + text_of(corner) + after;
    return text;
}

/// Each side as its indices, counted from `first`.
std::string all_sides(const std::string& before, int first)
{
    std::string text;
    for (const auto& side : sides) {
        text += before;
        for (const int corner : side) text += ' ' + std::to_string(corner + first);
        text += '\n';
    }
    return text;
}

/// The bytes of `value` in little-endian order.
template <typename Value>
std::string raw(Value value)
{
    static_assert(std::endian::native == std::endian::little);
    const auto bytes = std::bit_cast<std::array<char, sizeof(Value)>>(value);
    return {bytes.begin(), bytes.end()};
}

std::string raw_corners()
{
    std::string bytes;
    for (const auto& corner : corners)
        for (const float x : corner) bytes += raw(x);
    return bytes;
}

std::string obj()
{
    return "# a box\n" + all_corners("v ", "\n") + all_sides("f", 1);
}

std::string ply_header(const std::string& format)
{
    return "ply\nformat " + format +
           " 1.0\ncomment a box\nelement vertex 8\nproperty float x\nproperty float y\nproperty float "
           "z\n"
           "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string ply()
{
    return ply_header("ascii") + all_corners("", "\n") + all_sides("4", 0);
}

std::string binary_ply()
{
    std::string bytes = ply_header("binary_little_endian") + raw_corners();
    for (const auto& side : sides) {
        bytes += raw(std::uint8_t{4});
        for (const std::uint16_t corner : side) bytes += raw(std::int32_t{corner});
    }
    return bytes;
}

std::string stl()
{
    std::string text = "solid box\n";
    for_each_triangle([&](std::size_t a, std::size_t b, std::size_t c) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const std::size_t i : {a, b, c}) text += "vertex " + text_of(corners.at(i)) + '\n';
        text += "endloop\nendfacet\n";
    });
    return text + "endsolid box\n";
}

std::string binary_stl()
{
    std::string bytes = std::string(80, '\0') + raw(std::uint32_t{triangles});
    for_each_triangle([&](std::size_t a, std::size_t b, std::size_t c) {
        bytes += std::string(12, '\0');
        for (const std::size_t i : {a, b, c})
            for (const float x : corners.at(i)) bytes += raw(x);
        bytes += std::string(2, '\0');
    });
    return bytes;
}

std::string gltf_buffer()
{
    std::string bytes = raw_corners();
    for_each_triangle(
        [&](std::uint16_t a, std::uint16_t b, std::uint16_t c) { bytes += raw(a) + raw(b) + raw(c); });
    return bytes;
}

/// `node`: the transform of the node, as JSON members.
std::string gltf_text(const std::string& uri, const std::string& node = "")
{
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node +
           R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{)" +
           uri +
           R"("byteLength":168}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},)"
           R"({"buffer":0,"byteOffset":96,"byteLength":72}],"accessors":[{"bufferView":0,)"
           R"("componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[1,2,4]},)"
           R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}]})";
}

std::string base64(const std::string& bytes) // the length is a multiple of 3
{
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t j = 0; j < 3; ++j)
            three = three << 8 | static_cast<unsigned char>(bytes.at(i + j));
        for (const int shift : {18, 12, 6, 0}) text += letters.at(three >> shift & 63);
    }
    return text;
}

std::string gltf(const std::string& node = "")
{
    return gltf_text("\"uri\":\"data:application/octet-stream;base64," + base64(gltf_buffer()) + "\",",
                     node);
}

std::string glb()
{
    std::string json = gltf_text("");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string buffer = gltf_buffer();
    const auto size = [](std::size_t n) { return raw(static_cast<std::uint32_t>(n)); };
    return "glTF" + size(2) + size(12 + 8 + json.size() + 8 + buffer.size()) + size(json.size()) +
           "JSON" + json + size(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

std::string collada()
{
    return "<COLLADA version=\"1.4.1\"><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
           "<float_array id=\"a\" count=\"24\">" +
           all_corners(" ", "") +
           "</float_array><technique_common><accessor source=\"#a\" count=\"8\" stride=\"3\">"
           "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
           "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
           "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
           "<polylist count=\"6\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
           "<vcount>4 4 4 4 4 4</vcount><p>" +
           all_sides("", 0) +
           "</p></polylist></mesh></geometry></library_geometries><library_visual_scenes>"
           "<visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/></node></visual_scene>"
           "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

constexpr double tolerance = 1e-12; // coordinates are integers; only the sums of costs are rounded

struct Cost {
    int primitives;
    double sah;
};

class MeshFiles : public testing::Test {
protected:
#ifndef PLUMBLINE_READS_MESHES
    void SetUp() override
    {
        GTEST_SKIP() << "built without Assimp";
    }
#endif
    Outcome trees(const std::string& name, const std::string& bytes)
    {
        write_bytes(folder / name, bytes);
        return run({"bvh", (folder / name).string(), "--builder", "sah", "--json", "--size", "4x4",
                    "--repeats", "1"});
    }
    Cost cost(const std::string& name, const std::string& bytes)
    {
        const Outcome outcome = trees(name, bytes);
        EXPECT_EQ(outcome.status, 0) << name << ": " << outcome.err;
        if (outcome.status != 0) return {};
        const auto json = nlohmann::json::parse(outcome.out);
        return {json["primitives"].get<int>(), json["builders"][0]["sah_cost"].get<double>()};
    }
    void expect_refused(const std::string& name, const std::string& bytes, const std::string& why = "")
    {
        const Outcome outcome = trees(name, bytes);
        EXPECT_EQ(outcome.status, 2) << name << ": " << outcome.out << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("plumbline: ")) << outcome.err;
        EXPECT_NE(outcome.err.find(name + ": "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    TemporaryFolder folder;
};

TEST_F(MeshFiles, OfEachFormatHaveTheTreesOfTheSameMeshInCollada)
{
    const Cost right = cost("box.dae", collada());
    EXPECT_EQ(right.primitives, 12);
    EXPECT_GT(right.sah, 1);
    const std::pair<const char*, std::string> files[] = {
        {"box.obj", obj()}, {"box.ply", ply()},           {"binary.ply", binary_ply()},
        {"box.stl", stl()}, {"binary.stl", binary_stl()}, {"box.gltf", gltf()},
        {"box.glb", glb()}, {"BOX.OBJ", obj()},
    };
    for (const auto& [name, bytes] : files) {
        const Cost found = cost(name, bytes);
        EXPECT_EQ(found.primitives, 12) << name;
        EXPECT_NEAR(found.sah, right.sah, tolerance) << name;
    }
}

// After a rotation by 45 degrees about z, the boxes of the tree are larger than their contents.
TEST_F(MeshFiles, HaveTheTransformsOfTheirNodes)
{
    std::string turned = collada();
    const std::string node = "<node>";
    turned.insert(turned.find(node) + node.size(), "<rotate>0 0 1 45</rotate>");
    const Cost right = cost("turned.dae", turned);
    EXPECT_GT(std::abs(right.sah - cost("box.dae", collada()).sah), 0.01);
    // The rotation is given by sin and cos of 22.5 degrees. The matrix holds floats, so the error is
    // 2^-24 times a few operations.
    EXPECT_NEAR(cost("turned.gltf", gltf(R"(,"rotation":[0,0,0.38268343236,0.92387953251])")).sah,
                right.sah, 1e-5);
}

TEST_F(MeshFiles, KeepTrianglesWithoutAreaAndLeaveLinesOutWithANotice)
{
    const Outcome outcome = trees("box.obj", obj() + "f 1 1 2\nf 1 1 2\nl 1 2\n");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["primitives"], 14);
    EXPECT_NE(outcome.err.find("2 triangle(s) of zero area"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("1 line(s) and point(s): ignored"), std::string::npos) << outcome.err;
}

// A file that is cut at any byte is an error, unless only the last words are missing and nothing depends
// on them.
TEST_F(MeshFiles, CutShortAreErrors)
{
    const std::pair<const char*, std::string> files[] = {
        {"cut.ply", ply()},         {"cutb.ply", binary_ply()}, {"cut.stl", stl()},
        {"cutb.stl", binary_stl()}, {"cut.gltf", gltf()},       {"cut.glb", glb()}};
    for (const auto& [name, bytes] : files) {
        for (const std::size_t part : {0u, 1u, 5u, 20u, 50u, 80u, 95u})
            expect_refused(name, bytes.substr(0, bytes.size() * part / 100));
        const bool text_ends = bytes.back() == '\n';
        expect_refused(name, bytes.substr(0, bytes.size() - (text_ends ? 14 : 1)));
    }
}

TEST_F(MeshFiles, DamagedAreErrorsThatNameTheFile)
{
    const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    expect_refused("a.obj", "", "a.obj");
    expect_refused("a.obj", "this is no mesh, but a text of some length\nof two lines\n");
    expect_refused("a.obj", all_corners("v ", "\n"));                    // no faces
    expect_refused("a.obj", replaced(obj(), "f 1", "f 9"));              // no such vertex
    expect_refused("a.obj", replaced(obj(), "v 1", "v 1e39"), "finite"); // infinite as a float
    expect_refused("a.ply", replaced(ply(), "1 0 0", "nan 0 0"), "finite");
    expect_refused("a.ply", replaced(ply(), "1 0 0", "one 0 0"), "element 2 of 8 (\"vertex\")");
    expect_refused("a.ply", replaced(ply(), "vertex 8", "vertex 4000000000"), "not whole");
    expect_refused("a.ply", replaced(ply(), "\n4 0 3", "\n4 8 3"));
    expect_refused("a.ply", replaced(ply(), "\n4 0 3", "\n-4 0 3"), "element 1 of 6 (\"face\")");
    expect_refused("a.stl", replaced(stl(), "endloop", "endlop"), "facet 1");
    expect_refused("a.stl", replaced(binary_stl(), raw(std::uint32_t{12}), raw(std::uint32_t{13})));
    expect_refused("a.gltf", "{}");
    expect_refused("a.gltf", replaced(gltf(), "\"count\":8", "\"count\":9"));
    expect_refused("a.gltf", replaced(gltf(), "\"count\":8", "\"count\":7"), "some faces are damaged");
    expect_refused("a.gltf", replaced(gltf(), "\"mesh\":0", "\"mesh\":1"));
    std::string long_chunk = glb();
    long_chunk.replace(12, 4, raw(std::uint32_t{0x5b000000}));
    expect_refused("a.glb", long_chunk, "a chunk reaches beyond the end");
}

TEST_F(MeshFiles, OfOtherEndingsOrMissingAreErrors)
{
    expect_refused("box.fbx", obj(), "not in .dae, .obj, .ply, .stl, .gltf or .glb");
    const Outcome outcome = run({"bvh", "/nowhere/box.obj"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err, "plumbline: box.obj: no such file\n");
}

TEST_F(MeshFiles, AreNotRendered)
{
    write_bytes(folder / "box.obj", obj());
    const std::string picture = (folder / "a.exr").string();
    const Outcome outcome = run({"render", (folder / "box.obj").string(), "-o", picture});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("plumbline bvh reads such files"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(picture));
}

} // namespace
