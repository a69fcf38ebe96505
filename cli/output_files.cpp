#include "cli/output_files.h"

#include <stdexcept>
#include <system_error>

namespace cli {

namespace fs = std::filesystem;

namespace {

/// The path without symbolic links and dots, as far as it exists. A path with a folder that is missing
/// or not readable stays as it is: the write reports the error.
fs::path resolved(const fs::path& path)
{
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    if (error) return path;
    fs::path canonical = fs::weakly_canonical(absolute, error);
    return error ? absolute.lexically_normal() : canonical;
}

bool same_file(const fs::path& a, const fs::path& b)
{
    if (resolved(a) == resolved(b)) return true;
    std::error_code error; // also of files that do not exist, which are no hard links
    return fs::equivalent(a, b, error) && !error;
}

void expect_different(const NamedFile& a, const NamedFile& b)
{
    if (a.path.empty() || b.path.empty() || !same_file(a.path, b.path)) return;
    throw std::invalid_argument(a.option + " " + a.path.string() + " and " + b.option + " " +
                                b.path.string() + " are the same file");
}

} // namespace

void expect_different_files(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs)
{
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) expect_different(outputs[j], outputs[i]);
        for (const NamedFile& input : inputs) expect_different(outputs[i], input);
    }
}

} // namespace cli
