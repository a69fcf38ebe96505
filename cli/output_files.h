#pragma once

// Two files of one name: the later write would replace the earlier one without a word.

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

/// A file that a command reads or writes.
struct NamedFile {
    std::string option; // that names it on the command line, or what it is: "-o", "scene"
    std::filesystem::path path;
};

/// Throws std::invalid_argument, naming both, if two of `outputs` are one file or if an output is one of
/// `inputs`, however the names are spelt: "a.exr" and "./a.exr", a symbolic link, a hard link. Files
/// without a name (an option that was not given) are left out.
void expect_different_files(const std::vector<NamedFile>& outputs,
                            const std::vector<NamedFile>& inputs = {});

} // namespace cli
