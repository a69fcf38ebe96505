// Draws the figures of docs/tree-by-hand.md and writes its numbers, from the tree of ref/trees/ over the
// eight keys of docs/scenes/karras_keys.dae.
// Usage: figure_tree_by_hand --help

#include "docs/figures/page_parts.h"
#include "docs/figures/program.h"
#include "docs/figures/tree_by_hand_pictures.h"
#include "docs/figures/tree_by_hand_text.h"
#include "images/atomic_file.h"

#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace {

using figures::EightKeys;

/// The same primitives, but those of keys 3 and 4 are moved to where key 2 is: three equal codes.
EightKeys with_duplicates(const EightKeys& keys)
{
    std::vector<ref::Aabb> boxes = keys.boxes;
    for (const std::size_t key : {3U, 4U})
        boxes[keys.tree.primitives[key]] = boxes[keys.tree.primitives[2]];
    return EightKeys(boxes);
}

/// The files that the page consists of, with their contents.
std::map<std::filesystem::path, std::string>
made_files(const std::string& scene_file, const std::string& page, const std::filesystem::path& folder)
{
    const scenes::Scene scene = figures::read_scene(scene_file);
    const EightKeys keys(ref::primitive_bounds(scene));
    if (keys.size() != 8) throw std::invalid_argument(scene_file + ": there must be eight primitives");
    const EightKeys duplicates = with_duplicates(keys);
    const std::vector<std::uint32_t> from_left = {0, 1, 2, 3, 4, 5, 6, 7};
    const std::vector<std::uint32_t> from_right(from_left.rbegin(), from_left.rend());
    std::string text;
    try {
        text = figures::with_parts(images::read_file(page), "figure_tree_by_hand",
                                   figures::tree_by_hand_parts(keys, duplicates));
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(page + ": " + error.what());
    }
    return {{page, text},
            {folder / "tree_by_hand_keys.svg", figures::draw_keys(keys)},
            {folder / "tree_by_hand_ranges.svg", figures::draw_ranges(keys)},
            {folder / "tree_by_hand_splits.svg", figures::draw_splits(keys)},
            {folder / "tree_by_hand_refit.svg", figures::draw_refit(keys, from_left)},
            {folder / "tree_by_hand_refit_right.svg", figures::draw_refit(keys, from_right)},
            {folder / "tree_by_hand_boxes.svg", figures::draw_boxes(keys)},
            {folder / "tree_by_hand_duplicates.svg", figures::draw_duplicates(duplicates)}};
}

} // namespace

int main(int argc, char** argv)
{
    figures::Program program("Draws the figures of docs/tree-by-hand.md and writes the numbers between "
                             "the marks of that page",
                             "figure_tree_by_hand");
    std::string scene;
    std::string page;
    std::string folder;
    bool check = false;
    program.add_file("scene", scene,
                     "Scene with eight primitives in the unit cube: docs/scenes/karras_keys.dae");
    program.add_file("page", page, "Page with the marks: docs/tree-by-hand.md");
    program.add_file("folder", folder, "Folder of the figures: docs/images");
    program.add_flag("--check", check,
                     "Write nothing; exit status 1 if a file is not what would be written");
    program.set_footer(
        "Example: figure_tree_by_hand docs/scenes/karras_keys.dae docs/tree-by-hand.md docs/images");
    int stale = 0;
    const int status = program.run(argc, argv, [&] {
        for (const auto& [path, content] : made_files(scene, page, folder)) {
            if (!check) {
                images::write_atomically(path, content);
            } else if (!exists(path) || images::read_file(path) != content) {
                std::printf("%s is not what figure_tree_by_hand writes\n", path.string().c_str());
                stale = 1;
            }
        }
    });
    return status != 0 ? status : stale;
}
