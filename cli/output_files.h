#pragma once

// Checks that the files of a command are different: of two outputs with one name the second would
// replace the first.

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

/// A file that a command reads or writes.
struct NamedFile {
    std::string option; // of the command line, or a description: "-o", "the scene"
    std::filesystem::path path;
};

/// Throws std::invalid_argument, naming both, if two of `outputs` are one file or if an output is one of
/// `inputs`, however the names are spelt: "a.exr" and "./a.exr", a symbolic link, a hard link. Files
/// without a name (an option that was not given) are left out.
void expect_different_files(const std::vector<NamedFile>& outputs,
                            const std::vector<NamedFile>& inputs = {});

} // namespace cli
