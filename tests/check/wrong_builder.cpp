// A program that builds a tree, right or with the defect that is its first argument:
// wrong_builder DEFECT PRIMITIVES TREE.

#include "check/npy.h"
#include "check/trees/tree_files.h"
#include "tests/check/wrong_builders.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

namespace {

using check_test::Defect;

void write(const std::string& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}

void write_tree(const check::NeutralTree& tree, const std::string& folder)
{
    const std::array nodes_shape{tree.size(), std::size_t{4}};
    const std::array primitives_shape{tree.primitives.size()};
    const std::string bytes = check::primitives_bytes(tree.boxes, {false, true});
    write(folder + "/nodes.npy", check::npy_bytes(nodes_shape, tree.nodes));
    write(folder + "/boxes.npy", bytes);
    write(folder + "/primitives.npy", check::npy_bytes(primitives_shape, tree.primitives));
}

int run(const std::string& name, const std::string& primitives, const std::string& folder)
{
    std::size_t number = 0;
    while (number < check_test::defect_names.size() && name != check_test::defect_names[number])
        ++number;
    const auto defect = static_cast<Defect>(number);
    const auto boxes = check::read_primitives(primitives).boxes;
    if (defect == Defect::one_primitive && boxes.size() == 1) std::raise(SIGSEGV);
    if (defect == Defect::tiny_input && boxes.size() == 2) pause();
    if (defect == Defect::writes_no_tree) return 0;
    write_tree(check_test::build(defect, boxes), folder);
    if (defect == Defect::writes_garbage) write(folder + "/nodes.npy", "garbage");
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return argc == 4 ? run(argv[1], argv[2], argv[3]) : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
