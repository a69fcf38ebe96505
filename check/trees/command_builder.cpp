#include "check/trees/command_builder.h"

#include "check/child_program.h"
#include "images/image_error.h"

#include <fstream>
#include <stdexcept>

namespace check {

namespace {

/// Not through a temporary name, and without waiting for the disk: nobody keeps this file.
void write_quickly(const std::filesystem::path& path, const std::string& bytes)
{
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

/// `text` with the name of the temporary folder replaced, and without what follows its first line.
std::string without_folder(std::string text, const std::string& folder, const std::string& name)
{
    for (std::size_t at = 0; (at = text.find(folder)) != std::string::npos;)
        text.replace(at, folder.size(), name);
    return text.substr(0, text.find('\n'));
}

/// The last line of the program's output that is not empty, after ": "; or nothing.
std::string last_line(const std::string& output)
{
    const std::size_t end = output.find_last_not_of(" \t\r\n");
    if (end == std::string::npos) return "";
    const std::size_t begin = output.find_last_of('\n', end);
    const std::size_t from = begin == std::string::npos ? 0 : begin + 1;
    return ": " + output.substr(from, end + 1 - from);
}

void read_result(BuildAttempt& attempt, const std::filesystem::path& tree)
{
    std::filesystem::path file = tree;
    file += ".json";
    try {
        attempt.tree = read_tree(std::filesystem::exists(file) ? file : tree);
        attempt.end = BuildAttempt::End::built;
    } catch (const images::ImageError& error) {
        attempt.end = BuildAttempt::End::no_tree;
        attempt.text = without_folder(error.what(), tree.string(), "{tree}");
    }
}

} // namespace

BuildAttempts command_builder(std::vector<std::string> command, PrimitiveFormat format,
                              std::filesystem::path folder, std::function<bool()> stop)
{
    const std::filesystem::path primitives = folder / "primitives.npy";
    const std::filesystem::path tree = folder / "tree";
    for (const char* placeholder : {"{primitives}", "{tree}"}) {
        bool found = false;
        for (const std::string& word : command)
            found = found || word.find(placeholder) != std::string::npos;
        if (!found)
            throw std::invalid_argument(std::string("the command has no ") + placeholder +
                                        ": it must take both {primitives} and {tree}");
    }
    const std::vector<std::string> words =
        filled_in(command, {{"primitives", primitives.string()}, {"tree", tree.string()}});
    return [=](std::span<const ref::Aabb> boxes, double limit_seconds) {
        std::filesystem::remove_all(tree);
        std::filesystem::remove(tree.string() + ".json");
        std::filesystem::create_directory(tree);
        write_quickly(primitives, primitives_bytes(boxes, format));
        const ChildEnd end = run_child(words, limit_seconds, stop);
        BuildAttempt attempt{BuildAttempt::End::built};
        attempt.seconds = end.seconds;
        attempt.text = describe(end) + last_line(end.last_lines);
        switch (end.how) {
        case ChildEnd::How::signalled:
            attempt.end = BuildAttempt::End::crashed;
            break;
        case ChildEnd::How::timed_out:
            attempt.end = BuildAttempt::End::timed_out;
            break;
        case ChildEnd::How::exited:
            if (end.code != 0)
                attempt.end = BuildAttempt::End::rejected;
            else
                read_result(attempt, tree);
            break;
        }
        return attempt;
    };
}

} // namespace check
