#pragma once

// The command line of the programs in this folder, as in `plumbline`: --help, errors of one line, and
// exit status 2 for an error.

#include "scenes/frame.h"
#include "scenes/read_scene.h"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace figures {

/// Reads the command line into the options of `app`, then calls `work`. Returns the exit status.
template <class Work>
int run(CLI::App& app, int argc, char** argv, const Work& work)
{
    const auto complain = [&](std::string_view message) {
        message = message.substr(0, message.find('\n'));
        std::fprintf(stderr, "%s: %.*s\n", app.get_name().c_str(), static_cast<int>(message.size()),
                     message.data());
        return 2;
    };
    try {
        app.parse(argc, argv);
        work();
        return std::fflush(stdout) == 0 ? 0 : complain("standard output cannot be written");
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        return complain(error.what() + (" (" + app.get_name() + " --help lists the options)"));
    } catch (const std::exception& error) {
        return complain(error.what());
    }
}

/// The scenes that a program measures.
struct SceneFiles {
    std::vector<std::string> as_they_are;
    std::vector<std::string> framed; // their cameras are moved back until they see everything
};

inline void add_scene_options(CLI::App& app, SceneFiles& files)
{
    app.add_option("scenes", files.as_they_are, "COLLADA files");
    app.add_option("--frame", files.framed,
                   "COLLADA files whose cameras are moved back to where they see everything");
}

/// The scene in `file`, which must have a camera. If `framed`, the camera is moved back until it sees
/// everything. Throws scenes::SceneError, and std::invalid_argument for a scene without a camera.
inline scenes::Scene read_scene(const std::string& file, bool framed = false)
{
    scenes::Scene scene = scenes::read_scene(file);
    if (framed) scenes::frame_camera(scene);
    if (!scene.camera) throw std::invalid_argument(file + ": <COLLADA>: the scene has no camera");
    if (framed) scene.name += " (framed)";
    return scene;
}

/// All scenes, as by read_scene. Throws std::invalid_argument if there is no file.
inline std::vector<scenes::Scene> read_scenes(const SceneFiles& files)
{
    std::vector<scenes::Scene> all;
    for (const std::string& file : files.as_they_are) all.push_back(read_scene(file));
    for (const std::string& file : files.framed) all.push_back(read_scene(file, true));
    if (all.empty()) throw std::invalid_argument("no scene is named");
    return all;
}

/// Options of a measurement in rounds.
struct RoundOptions {
    std::size_t rounds = 5;
    double seconds = 0.5;           // time for each picture
    double reference_seconds = 6.0; // time for the picture with which the others are compared
    std::uint64_t seed = 1;         // of the reference; pictures and order have other seeds
};

inline void add_round_options(CLI::App& app, RoundOptions& options)
{
    app.add_option("--rounds", options.rounds, "Rounds, each with other seeds and in another order")
        ->check(CLI::Range(std::size_t{2}, std::size_t{1000}))
        ->capture_default_str();
    app.add_option("--seconds", options.seconds, "Time that each picture takes")
        ->check(CLI::Range(1e-3, 1e6))
        ->capture_default_str();
    app.add_option("--reference-seconds", options.reference_seconds,
                   "Time of the picture that errors are measured by")
        ->check(CLI::Range(1e-3, 1e6))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "Of the reference; all others follow from it")
        ->capture_default_str();
}

} // namespace figures
