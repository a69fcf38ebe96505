#include "check/renderers/picture_folder.h"

#include "images/atomic_file.h"

#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace check {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// The file that a word of a command names: as a path, or, for the program, on the PATH. Empty if there
/// is none.
fs::path file_of(const std::string& word, bool program)
{
    std::error_code ignored;
    if (fs::is_regular_file(word, ignored)) return word;
    if (!program || word.find('/') != std::string::npos) return {};
    const char* path = std::getenv("PATH"); // NOLINT(concurrency-mt-unsafe)
    const std::string folders = path == nullptr ? "" : path;
    for (std::size_t begin = 0; begin <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', begin), folders.size());
        fs::path file = fs::path(folders.substr(begin, end - begin)) / word;
        if (fs::is_regular_file(file, ignored)) return file;
        begin = end + 1;
    }
    return {};
}

/// Size and time of the last change of each file that the command names. A renderer that was built
/// again makes other pictures.
Json versions_of(const std::vector<std::string>& command)
{
    Json versions = Json::object();
    for (const std::string& word : command) {
        const fs::path file = file_of(word, &word == command.data());
        if (file.empty()) continue;
        const auto changed = fs::last_write_time(file).time_since_epoch();
        versions[word] = {fs::file_size(file),
                          std::chrono::duration_cast<std::chrono::nanoseconds>(changed).count()};
    }
    return versions;
}

/// The first key whose value differs.
std::string first_difference(const Json& a, const Json& b)
{
    for (const auto& [key, value] : a.items())
        if (!b.contains(key) || b[key] != value) return key;
    return "";
}

} // namespace

PictureFolder::PictureFolder()
{
    folder_ = temporary_.emplace().path();
}

PictureFolder::PictureFolder(const fs::path& kept, const Origin& origin,
                             const std::vector<SuiteScene>& scenes)
{
    std::error_code error;
    fs::create_directories(kept, error);
    if (error) throw std::invalid_argument("--keep " + kept.string() + ": " + error.message());
    folder_ = fs::canonical(kept);
    const fs::path file = folder_ / "pictures.json";
    Json state = {{"command", origin.command},
                  {"files", versions_of(origin.command)},
                  {"samples", origin.samples},
                  {"seed", origin.series},
                  {"format", origin.ending}};
    Json hashes = Json::object();
    const auto refuse = [&](const std::string& why) {
        throw std::invalid_argument("--keep " + kept.string() + ": holds pictures of " + why +
                                    ": name another folder, or remove this one");
    };
    if (fs::exists(file)) {
        Json before = Json::parse(images::read_file(file), nullptr, false);
        if (!before.is_object()) throw std::invalid_argument(file.string() + ": is no JSON object");
        if (before.contains("scenes")) hashes = before["scenes"];
        const std::string other = first_difference(state, before);
        if (other == "files")
            refuse("another version of " + first_difference(state["files"], before["files"]));
        if (!other.empty()) refuse("another " + other);
    } else if (!fs::is_empty(folder_))
        throw std::invalid_argument("--keep " + kept.string() +
                                    ": is neither empty nor a folder of kept pictures");
    for (const SuiteScene& scene : scenes) {
        if (hashes.contains(scene.name) && hashes[scene.name] != scene.hash)
            refuse("another version of the scene " + scene.name);
        hashes[scene.name] = scene.hash;
    }
    state["scenes"] = hashes;
    images::write_atomically(file, state.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

fs::path PictureFolder::place(const std::string& scene, std::uint64_t number,
                              const std::string& ending) const
{
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%04llu", static_cast<unsigned long long>(number));
    return folder_ / scene / (digits.data() + ending);
}

fs::path PictureFolder::unfinished(const std::string& scene, std::uint64_t number,
                                   const std::string& ending) const
{
    fs::path path = place(scene, number, ".unfinished" + ending);
    fs::create_directories(path.parent_path());
    return path;
}

} // namespace check
