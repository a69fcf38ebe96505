#include "images/atomic_file.h"
#include "images/image_error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace images {

namespace fs = std::filesystem;

namespace {

std::string reason(int error_number)
{
    return std::generic_category().message(error_number);
}

/// The target of a write to `path`, symbolic links followed. Throws if it cannot be a file.
fs::path destination(const fs::path& path)
{
    if (!path.has_filename()) throw ImageError(path, "names no file");
    std::error_code error;
    const bool link = fs::is_symlink(path, error);
    fs::path target = link ? fs::weakly_canonical(path, error) : path;
    if (link && error) throw ImageError(path, error.message());
    const fs::file_status status = fs::status(target, error);
    if (fs::is_directory(status)) throw ImageError(path, "is a folder, not a file");
    // A rename would replace a device or a pipe by a file.
    if (fs::exists(status) && !fs::is_regular_file(status)) throw ImageError(path, "is no regular file");
    if (fs::exists(status) && access(target.c_str(), W_OK) != 0) throw ImageError(path, reason(errno));
    return target;
}

/// A temporary file, removed unless it gets its final name.
class TemporaryFile {
public:
    /// Creates an empty file beside `target`. Throws ImageError, about `path`.
    TemporaryFile(const fs::path& path, const fs::path& target) : path_(path), target_(target)
    {
        // The name does not contain the target's, which may be as long as the system allows.
        const std::string stem = ".plumbline-" + std::to_string(getpid()) + "-";
        for (int attempt = 0; file_ < 0; ++attempt) {
            name_ = target.parent_path() / (stem + std::to_string(attempt) + ".tmp");
            file_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (file_ < 0 && errno != EEXIST) fail("cannot create a file in its folder");
        }
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile()
    {
        if (file_ >= 0) close(file_);
        if (!renamed_) unlink(name_.c_str());
    }

    void write(std::string_view bytes)
    {
        while (!bytes.empty()) {
            const ssize_t written = ::write(file_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail("cannot write");
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }

    void rename_to_target()
    {
        struct stat previous = {};
        if (stat(target_.c_str(), &previous) == 0 && fchmod(file_, previous.st_mode & 07777) != 0)
            fail("cannot keep its permissions");
        if (fsync(file_) != 0) fail("cannot write");
        if (close(std::exchange(file_, -1)) != 0) fail("cannot write");
        if (rename(name_.c_str(), target_.c_str()) != 0) fail("cannot rename");
        renamed_ = true;
    }

private:
    [[noreturn]] void fail(const std::string& what)
    {
        throw ImageError(path_, what + ": " + reason(errno));
    }

    const fs::path& path_;
    const fs::path& target_;
    fs::path name_;
    int file_ = -1;
    bool renamed_ = false;
};

} // namespace

void write_atomically(const fs::path& path, std::string_view bytes)
{
    const fs::path target = destination(path);
    TemporaryFile file(path, target);
    file.write(bytes);
    file.rename_to_target();
}

void check_place(const fs::path& path)
{
    const fs::path target = destination(path);
    TemporaryFile(path, target).write("");
}

std::string read_file(const fs::path& path)
{
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw ImageError(path, error ? error.message() : "no such file");
    if (!fs::is_regular_file(status)) throw ImageError(path, "is no regular file");
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    // Inserting an empty file's buffer counts as a failure of `bytes`, not of `file`.
    if (file.peek() != std::ifstream::traits_type::eof()) bytes << file.rdbuf();
    if (!file.is_open() || file.bad() || bytes.bad()) throw ImageError(path, "cannot be read");
    return std::move(bytes).str();
}

} // namespace images
