#pragma once

// A folder for files that only this run needs.

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace images {

/// A new folder in the system's folder for temporary files, removed with its content at the end. The
/// constructor throws std::runtime_error, with the reason, if there can be none.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "plumbline-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw std::runtime_error(
                name + ": a temporary folder cannot be made: " + std::generic_category().message(errno));
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace images
