#include "explain/tree_text.h"

#include "explain/names.h"

#include <nlohmann/json.hpp>

namespace explain {

namespace {

/// The bits of a code, three by three: x, y and z of one level.
std::string bits_of(std::uint64_t code, int bits_per_axis)
{
    std::string text;
    for (int level = bits_per_axis - 1; level >= 0; --level) {
        for (int bit = 3 * level + 2; bit >= 3 * level; --bit)
            text += (code >> bit & 1) != 0 ? '1' : '0';
        if (level > 0) text += ' ';
    }
    return text;
}

std::string key_line(const std::string& what, const Key& key, int bits)
{
    return "  " + what + ": key " + std::to_string(key.place) + ", primitive " +
           std::to_string(key.primitive) + ", delta " + std::to_string(key.delta) + "\n    " +
           bits_of(key.code, bits) + "\n";
}

std::string probes_text(const std::vector<Probe>& probes, const std::string& step)
{
    std::string text;
    for (const Probe& probe : probes)
        text += "    " + step + " = " + std::to_string(probe.step) + ": delta to key " +
                std::to_string(probe.key) + " is " + std::to_string(probe.delta) +
                (probe.longer ? ": longer, go on\n" : ": not longer\n");
    return text;
}

std::string search_text(const NodeSearch& search)
{
    const std::string i = std::to_string(search.i);
    const std::string bound = std::to_string(search.delta_min);
    return "\nInternal node " + i + ": its searches [Karras 2012, fig. 4]\n  Direction: delta is " +
           std::to_string(search.delta_right) + " to the right, " + std::to_string(search.delta_left) +
           " to the left: d = " + std::to_string(search.d) + ", delta_min = " + bound +
           "\n  Upper limit of the length: double l_max while delta(i, i + l_max d) > " + bound + "\n" +
           probes_text(search.doubling, "l_max") + "  Length: add t while delta(i, i + (l + t) d) > " +
           bound + "\n" + probes_text(search.length, "t") + "    l = " + std::to_string(search.l) +
           ": keys " + std::to_string(std::min(search.i, search.j)) + " to " +
           std::to_string(std::max(search.i, search.j)) +
           "\n  Split: add t while delta(i, i + (s + t) d) > delta_node = " +
           std::to_string(search.delta_node) + "\n" + probes_text(search.split, "t") +
           "    s = " + std::to_string(search.s) +
           ": the left child ends at key gamma = " + std::to_string(search.gamma) + "\n";
}

std::string way_text(const TreeExplanation& tree)
{
    std::string text =
        "\nThe way to the root in the refit, with walks from the leaves in order\n  leaf " +
        std::to_string(tree.key.place) + " is node " + std::to_string(tree.leaf) + "\n";
    for (const Ancestor& at : tree.way) {
        text += "  node " + std::to_string(at.node) + ": keys " + std::to_string(at.first) + " to " +
                std::to_string(at.last) + ", left child to " + std::to_string(at.gamma) +
                "\n    first arrives the walk from leaf " + std::to_string(at.arrives[0]) + " by node " +
                std::to_string(at.from[0]) + ", and stops\n    second arrives the walk from leaf " +
                std::to_string(at.arrives[1]) + " by node " + std::to_string(at.from[1]) +
                ", and unites the boxes:\n    " + numbers(at.bounds.lower) + " to " +
                numbers(at.bounds.upper) + "\n";
    }
    return text + (tree.way.empty() ? "  the leaf is the root\n" : "");
}

using Json = nlohmann::ordered_json;

Json of_vector(const ref::Vec3& v)
{
    return {v.x, v.y, v.z};
}

Json of_box(const ref::Aabb& box)
{
    return {of_vector(box.lower), of_vector(box.upper)};
}

Json of_key(const std::optional<Key>& key)
{
    if (!key) return nullptr;
    return {{"place", key->place},
            {"primitive", key->primitive},
            {"code", key->code},
            {"delta", key->delta}};
}

Json of_probes(const std::vector<Probe>& probes)
{
    Json json = Json::array();
    for (const Probe& probe : probes)
        json.push_back({{"step", probe.step},
                        {"key", probe.key},
                        {"delta", probe.delta},
                        {"longer", probe.longer}});
    return json;
}

Json of_search(const std::optional<NodeSearch>& search)
{
    if (!search) return nullptr;
    return {{"i", search->i},
            {"delta_right", search->delta_right},
            {"delta_left", search->delta_left},
            {"d", search->d},
            {"delta_min", search->delta_min},
            {"doubling", of_probes(search->doubling)},
            {"length", of_probes(search->length)},
            {"l", search->l},
            {"j", search->j},
            {"delta_node", search->delta_node},
            {"split", of_probes(search->split)},
            {"s", search->s},
            {"gamma", search->gamma}};
}

} // namespace

std::string describe(const TreeExplanation& tree, const std::string& name)
{
    const int bits = tree.bits_per_axis;
    std::string text = name + ": primitive " + std::to_string(tree.primitive) + " of " +
                       std::to_string(tree.primitives) + "\n  centroid " + numbers(tree.centroid) +
                       "\n  grid of the centroids " + numbers(tree.grid.lower) + " to " +
                       numbers(tree.grid.upper) + "\n  cell " + std::to_string(tree.cell[0]) + " " +
                       std::to_string(tree.cell[1]) + " " + std::to_string(tree.cell[2]) + " of 2^" +
                       std::to_string(bits) + " per axis\n  code " + std::to_string(tree.key.code) +
                       " of " + std::to_string(3 * bits) + " bits, x y z from the highest:\n    " +
                       bits_of(tree.key.code, bits) + "\n";
    text += "\nSorted by code it is key " + std::to_string(tree.key.place) +
            ". delta: the leading bits in common, of 64\n";
    text += tree.left ? key_line("left neighbour", *tree.left, bits) : "  no left neighbour: delta -1\n";
    text +=
        tree.right ? key_line("right neighbour", *tree.right, bits) : "  no right neighbour: delta -1\n";
    if (tree.search) text += search_text(*tree.search);
    return text + way_text(tree);
}

std::string json(const TreeExplanation& tree, const std::string& name)
{
    Json way = Json::array();
    for (const Ancestor& at : tree.way)
        way.push_back({{"node", at.node},
                       {"first", at.first},
                       {"last", at.last},
                       {"gamma", at.gamma},
                       {"arrives", at.arrives},
                       {"from", at.from},
                       {"bounds", of_box(at.bounds)}});
    const Json json = {{"scene", name},
                       {"primitive", tree.primitive},
                       {"primitives", tree.primitives},
                       {"bits_per_axis", tree.bits_per_axis},
                       {"centroid", of_vector(tree.centroid)},
                       {"box", of_box(tree.box)},
                       {"grid", of_box(tree.grid)},
                       {"cell", tree.cell},
                       {"key", of_key(tree.key)},
                       {"left", of_key(tree.left)},
                       {"right", of_key(tree.right)},
                       {"search", of_search(tree.search)},
                       {"leaf", tree.leaf},
                       {"way", way}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

} // namespace explain
