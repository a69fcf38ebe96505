#include "images/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>

namespace images {

namespace {

namespace fs = std::filesystem;

struct TemporaryFolders {
    std::mutex mutex;
    std::set<fs::path> paths;
};

/// Never destroyed: another thread may remove the folders while the program ends.
TemporaryFolders& all_folders()
{
    static auto* const folders = new TemporaryFolders;
    return *folders;
}

} // namespace

TemporaryFolder::TemporaryFolder()
{
    std::string name = (fs::temp_directory_path() / "plumbline-XXXXXX").string();
    const std::lock_guard lock(all_folders().mutex);
    if (mkdtemp(name.data()) == nullptr)
        throw std::runtime_error(
            name + ": a temporary folder cannot be made: " + std::generic_category().message(errno));
    path_ = name;
    all_folders().paths.insert(path_);
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    const std::lock_guard lock(all_folders().mutex);
    all_folders().paths.erase(path_);
}

void remove_temporary_folders()
{
    const std::lock_guard lock(all_folders().mutex);
    std::error_code ignored;
    for (const fs::path& path : all_folders().paths)
        // Another thread may write a last file while the folder is removed.
        for (int i = 0; i < 10 && fs::exists(path, ignored); ++i) fs::remove_all(path, ignored);
}

} // namespace images
