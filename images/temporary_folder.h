#pragma once

// A folder for files that only this run needs.

#include <filesystem>

namespace images {

/// A new folder in the system's folder for temporary files, removed with its content at the end. The
/// constructor throws std::runtime_error, with the reason, if there can be none.
class TemporaryFolder {
public:
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Removes all temporary folders of this process, for a program that is about to be ended without its
/// destructors. May be called from any thread.
void remove_temporary_folders();

} // namespace images
