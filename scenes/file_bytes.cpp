#include "scenes/file_bytes.h"

#include "scenes/read_scene.h"

#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

namespace scenes {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30U;

[[noreturn]] void fail_too_large(const std::string& name)
{
    throw SceneError(name + ": larger than " + std::to_string(largest_file) + " bytes");
}

} // namespace

std::string file_bytes(const std::filesystem::path& path)
{
    const std::string name = path.filename().string();
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw SceneError(name + ": no such file");
    if (!std::filesystem::is_regular_file(status)) throw SceneError(name + ": not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw SceneError(name + ": " + error.message());
    if (size > largest_file) fail_too_large(name);

    std::ifstream file(path, std::ios::binary);
    if (!file) throw SceneError(name + ": " + std::strerror(errno));
    std::string bytes(size, '\0');
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size)))
        throw SceneError(name + ": cannot be read");
    return bytes;
}

std::string stream_bytes(std::istream& stream, const std::string& name)
{
    std::string bytes;
    std::array<char, 1 << 16> some{};
    while (stream) {
        stream.read(some.data(), some.size());
        bytes.append(some.data(), static_cast<std::size_t>(stream.gcount()));
        if (bytes.size() > largest_file) fail_too_large(name);
    }
    if (stream.bad()) throw SceneError(name + ": cannot be read");
    return bytes;
}

std::string hash_of(std::string_view bytes)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits(bytes.data(), bytes.size())));
    return text;
}

} // namespace scenes
