// Primitives and trees as JSON, for people to write.

#include "check/trees/tree_files.h"
#include "images/image_error.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace check {

namespace {

using images::ImageError;
using TreeJson = nlohmann::json;

/// Reads parts of one file; every error names the file and the place in it.
class JsonFile {
public:
    JsonFile(const std::string& text, std::filesystem::path path) : path_(std::move(path))
    {
        try {
            root_ = TreeJson::parse(text);
        } catch (const TreeJson::exception& error) {
            fail("is no JSON: " + std::string(error.what()));
        }
        if (!root_.is_object()) fail("must hold one JSON object");
    }

    [[noreturn]] void fail(const std::string& problem) const { throw ImageError(path_, problem); }
    [[nodiscard]] const TreeJson& root() const { return root_; }

    /// The array `key` of `object`.
    [[nodiscard]] const TreeJson& array(const TreeJson& object, const char* key,
                                        const std::string& where) const
    {
        const auto found = object.find(key);
        if (found == object.end() || !found->is_array()) fail(where + " has no array \"" + key + "\"");
        return *found;
    }
    /// Appends the numbers of nested arrays, which must be `count`, to `numbers`.
    void append(const TreeJson& json, std::size_t count, std::vector<double>& numbers,
                const std::string& where) const
    {
        const std::size_t before = numbers.size();
        append_all(json, numbers, where);
        if (numbers.size() - before != count)
            fail(where + " has " + std::to_string(numbers.size() - before) + " numbers: there must be " +
                 std::to_string(count));
    }
    [[nodiscard]] std::int64_t integer(const TreeJson& json, const std::string& where) const
    {
        if (!json.is_number_integer()) fail(where + ": " + json.dump() + " is no whole number");
        return json.get<std::int64_t>();
    }
    /// A child or a parent: null is none.
    [[nodiscard]] std::int64_t node(const TreeJson& json, const std::string& where) const
    {
        return json.is_null() ? NeutralTree::none : integer(json, where);
    }

private:
    void append_all(const TreeJson& json, std::vector<double>& numbers, const std::string& where) const
    {
        if (json.is_number())
            numbers.push_back(json.get<double>());
        else if (json.is_array())
            for (const TreeJson& part : json) append_all(part, numbers, where);
        else
            fail(where + ": " + json.dump() + " is no number");
    }

    std::filesystem::path path_;
    TreeJson root_;
};

ref::Aabb box_of(const JsonFile& file, const TreeJson& json, const std::string& where)
{
    std::vector<double> x;
    file.append(json, 6, x, where);
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
}

/// The children of a node, or its primitives, which become new slots. `width` grows if necessary.
void append_node(const JsonFile& file, const TreeJson& json, const std::string& where,
                 std::vector<std::vector<std::int64_t>>& children, NeutralTree& tree)
{
    if (!json.is_object()) file.fail(where + " must be an object");
    tree.boxes.push_back(box_of(file, file.array(json, "box", where), where + ": \"box\""));
    children.emplace_back();
    if (json.contains("children"))
        for (const TreeJson& child : file.array(json, "children", where))
            children.back().push_back(file.node(child, where));
    tree.width = std::max(tree.width, children.back().size());
    if (json.contains("parent")) tree.parents.push_back(file.node(json["parent"], where));
}

} // namespace

Primitives primitives_of_json(const std::string& text, const std::filesystem::path& path)
{
    const JsonFile file(text, path);
    Primitives result{{}, {file.root().contains("triangles"), false}};
    const char* key = result.format.triangles ? "triangles" : "boxes";
    for (const TreeJson& json : file.array(file.root(), key, "the object")) {
        const std::string where = "primitive " + std::to_string(result.boxes.size());
        if (!result.format.triangles) {
            result.boxes.push_back(box_of(file, json, where));
            continue;
        }
        std::vector<double> x;
        file.append(json, 9, x, where);
        ref::Aabb box;
        for (std::size_t i = 0; i < 9; i += 3) {
            const ref::Vec3 vertex(x[i], x[i + 1], x[i + 2]);
            box = unite(box, {vertex, vertex});
        }
        result.boxes.push_back(box);
    }
    return result;
}

NeutralTree tree_of_json(const std::string& text, const std::filesystem::path& path)
{
    const JsonFile file(text, path);
    NeutralTree tree;
    if (file.root().contains("root")) tree.root = file.integer(file.root()["root"], "\"root\"");
    const TreeJson& nodes = file.array(file.root(), "nodes", "the object");
    std::vector<std::vector<std::int64_t>> children;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        append_node(file, nodes[i], "node " + std::to_string(i), children, tree);
    if (!tree.parents.empty() && tree.parents.size() != nodes.size())
        file.fail("some nodes name their \"parent\", and some do not");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        children[i].resize(tree.width, NeutralTree::none);
        tree.nodes.insert(tree.nodes.end(), children[i].begin(), children[i].end());
        tree.nodes.push_back(static_cast<std::int64_t>(tree.primitives.size()));
        const std::size_t before = tree.primitives.size();
        const std::string where = "node " + std::to_string(i);
        if (nodes[i].contains("primitives"))
            for (const TreeJson& primitive : file.array(nodes[i], "primitives", where))
                tree.primitives.push_back(file.integer(primitive, where));
        tree.nodes.push_back(static_cast<std::int64_t>(tree.primitives.size() - before));
    }
    return tree;
}

} // namespace check
