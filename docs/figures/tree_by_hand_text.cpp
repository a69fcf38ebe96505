#include "docs/figures/tree_by_hand_text.h"

#include <cstdio>
#include <initializer_list>

namespace figures {

namespace {

std::string text(std::int64_t number)
{
    return std::to_string(number);
}

/// A line of a table.
std::string row(std::initializer_list<std::string> cells)
{
    std::string line = "|";
    for (const std::string& cell : cells) line += " " + cell + " |";
    return line + "\n";
}

std::string head(std::initializer_list<std::string> cells)
{
    std::string line = row(cells) + "|";
    for (std::size_t i = 0; i < cells.size(); ++i) line += "---|";
    return line + "\n";
}

std::string key_table(const EightKeys& keys, bool with_index)
{
    std::string table =
        head({"key", "primitive", with_index ? "code, index" : "code", "delta to the next key"});
    for (std::size_t i = 0; i < keys.size(); ++i)
        table += row({text(static_cast<std::int64_t>(i)), "#" + text(keys.tree.primitives[i]),
                      "`" + keys.bits(i) + (with_index ? " " + EightKeys::index_bits(i) : "") + "`",
                      i + 1 < keys.size() ? text(keys.common(i, i + 1)) : "-1: there is none"});
    return table;
}

std::string directions(const EightKeys& keys)
{
    std::string table = head({"node i", "delta(i, i - 1)", "delta(i, i + 1)", "d", "delta_min"});
    for (const explain::NodeSearch& node : keys.searches)
        table += row({text(node.i), text(of_code(node.delta_left)), text(of_code(node.delta_right)),
                      node.d > 0 ? "+1" : "-1", text(of_code(node.delta_min))});
    return table;
}

/// Each question of a search, with its answer.
std::string probes(const explain::NodeSearch& node, const std::vector<explain::Probe>& asked, int bound)
{
    std::string cell;
    for (const explain::Probe& probe : asked)
        cell += (cell.empty() ? "" : "<br>") + text(probe.step) + ": delta(" + text(node.i) + ", " +
                text(probe.key) + ") = " + text(of_code(probe.delta)) + (probe.longer ? " > " : " <= ") +
                text(of_code(bound)) + (probe.longer ? ", yes" : ", no");
    return cell;
}

std::string keys_of(const explain::NodeSearch& node)
{
    return text(std::min(node.i, node.j)) + " to " + text(std::max(node.i, node.j));
}

std::string ranges(const EightKeys& keys)
{
    std::string table = head({"node i", "l_max", "t", "l", "j", "keys"});
    for (const explain::NodeSearch& node : keys.searches)
        table +=
            row({text(node.i), probes(node, node.doubling, node.delta_min),
                 probes(node, node.length, node.delta_min), text(node.l), text(node.j), keys_of(node)});
    return table;
}

std::string splits(const EightKeys& keys)
{
    std::string table = head({"node i", "delta_node", "t", "s", "gamma", "left child", "right child"});
    const auto child = [&](const explain::NodeSearch& node, std::size_t side) {
        const std::uint32_t number = keys.tree.nodes[static_cast<std::size_t>(node.i)].children[side];
        return keys.tree.is_leaf(number) ? "leaf " + text(keys.tree.leaf(number))
                                         : "node " + text(number);
    };
    for (const explain::NodeSearch& node : keys.searches)
        table +=
            row({text(node.i), text(of_code(node.delta_node)), probes(node, node.split, node.delta_node),
                 text(node.s), text(node.gamma), child(node, 0), child(node, 1)});
    return table;
}

std::string parents(const EightKeys& keys)
{
    std::string nodes = "| child |";
    std::string line = "|---|";
    std::string numbers = "| parent |";
    for (std::uint32_t node = 0; node < keys.tree.nodes.size(); ++node) {
        const std::uint32_t parent = keys.tree.nodes[node].parent;
        nodes +=
            (keys.tree.is_leaf(node) ? " leaf " + text(keys.tree.leaf(node)) : " node " + text(node)) +
            " |";
        line += "---|";
        numbers += (parent == ref::no_node ? " none" : " " + text(parent)) + " |";
    }
    return nodes + "\n" + line + "\n" + numbers + "\n";
}

/// The walks of a refit, one a line: what each reads in the counters, and where it stops.
std::string walks(const EightKeys& keys, const std::vector<std::uint32_t>& leaf_order)
{
    const auto arrivals = explain::refit_arrivals(keys.tree, leaf_order);
    std::string list;
    for (const std::uint32_t leaf : leaf_order) {
        list += "- walk " + text(leaf) + ":";
        std::uint32_t node = keys.tree.internal_count() + leaf;
        for (bool second = true; second;) {
            node = keys.tree.nodes[node].parent;
            if (node == ref::no_node) break;
            second = arrivals[node].leaves[1] == leaf;
            list +=
                " node " + text(node) + (second ? " reads 1: unites the two boxes;" : " reads 0: stops");
        }
        list += node == ref::no_node ? " that was the root\n" : "\n";
    }
    return list;
}

std::string corner(const ref::Vec3& p)
{
    char buffer[80];
    std::snprintf(buffer, sizeof buffer, "(%.4g, %.4g, %.4g)", p.x, p.y, p.z);
    return buffer;
}

std::string box_table(const EightKeys& keys)
{
    std::string table = head({"node", "keys", "lower corner", "upper corner"});
    for (std::size_t i = 0; i < keys.searches.size(); ++i)
        table += row({text(static_cast<std::int64_t>(i)), keys_of(keys.searches[i]),
                      corner(keys.tree.bounds[i].lower), corner(keys.tree.bounds[i].upper)});
    return table;
}

} // namespace

std::map<std::string, std::string> tree_by_hand_parts(const EightKeys& keys, const EightKeys& duplicates)
{
    std::vector<std::uint32_t> order(keys.size());
    for (std::uint32_t leaf = 0; leaf < order.size(); ++leaf) order[leaf] = leaf;
    const std::vector<std::uint32_t> backwards(order.rbegin(), order.rend());
    return {{"keys", key_table(keys, false)},
            {"directions", directions(keys)},
            {"ranges", ranges(keys)},
            {"splits", splits(keys)},
            {"parents", parents(keys)},
            {"walks", walks(keys, order)},
            {"walks from the right", walks(keys, backwards)},
            {"boxes", box_table(keys)},
            {"duplicate keys", key_table(duplicates, true)},
            {"duplicate ranges", ranges(duplicates)},
            {"duplicate splits", splits(duplicates)}};
}

} // namespace figures
