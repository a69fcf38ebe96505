#pragma once

// The command line of the programs in this folder, as in `plumbline`: --help, errors of one line, and
// exit status 2 for an error.

#include "scenes/read_scene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App; // only declared: CLI11 takes long to compile
}

namespace figures {

/// The scenes that a program measures.
struct SceneFiles {
    std::vector<std::string> as_they_are;
    std::vector<std::string> framed; // their cameras are moved back until they see everything
};

/// Options of a measurement in rounds.
struct RoundOptions {
    std::size_t rounds = 5;
    double seconds = 0.5;           // time for each picture
    double reference_seconds = 6.0; // time for the picture with which the others are compared
    std::uint64_t seed = 1;         // of the reference; pictures and order have other seeds
};

/// A program with its options. Those that are added set their variables when run() reads the command
/// line.
class Program {
public:
    Program(const std::string& description, const std::string& name);
    ~Program();
    void add(SceneFiles& files);
    void add(RoundOptions& options);
    /// A file that must be named.
    void add_file(const std::string& name, std::string& file, const std::string& description);
    void add_flag(const std::string& name, bool& flag, const std::string& description);
    /// A whole number from `least` to `most`; its value before is the default.
    void add_number(const std::string& name, int& number, int least, int most,
                    const std::string& description);
    /// The last lines of --help.
    void set_footer(const std::string& footer);
    /// Reads the command line, then calls `work`. Returns the exit status.
    int run(int argc, char** argv, const std::function<void()>& work);

private:
    std::unique_ptr<CLI::App> app_;
};

/// The scene in `file`, which must have a camera. If `framed`, the camera is moved back until it sees
/// everything. Throws scenes::SceneError, and std::invalid_argument for a scene without a camera.
scenes::Scene read_scene(const std::string& file, bool framed = false);

/// All scenes, as by read_scene. Throws std::invalid_argument if there is no file.
std::vector<scenes::Scene> read_scenes(const SceneFiles& files);

} // namespace figures
