#include "docs/figures/program.h"

#include "scenes/frame.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string_view>

namespace figures {

Program::Program(const std::string& description, const std::string& name)
    : app_(std::make_unique<CLI::App>(description, name))
{}

Program::~Program() = default;

void Program::add(SceneFiles& files)
{
    app_->add_option("scenes", files.as_they_are, "COLLADA files");
    app_->add_option("--frame", files.framed,
                     "COLLADA files whose cameras are moved back to where they see everything");
}

void Program::add(RoundOptions& options)
{
    app_->add_option("--rounds", options.rounds, "Rounds, each with other seeds and in another order")
        ->check(CLI::Range(std::size_t{2}, std::size_t{1000}))
        ->capture_default_str();
    app_->add_option("--seconds", options.seconds, "Time that each picture takes")
        ->check(CLI::Range(1e-3, 1e6))
        ->capture_default_str();
    app_->add_option("--reference-seconds", options.reference_seconds,
                     "Time of the picture that errors are measured by")
        ->check(CLI::Range(1e-3, 1e6))
        ->capture_default_str();
    app_->add_option("--seed", options.seed, "Of the reference; all others follow from it")
        ->capture_default_str();
}

void Program::add_file(const std::string& name, std::string& file, const std::string& description)
{
    app_->add_option(name, file, description)->required();
}

void Program::add_flag(const std::string& name, bool& flag, const std::string& description)
{
    app_->add_flag(name, flag, description);
}

void Program::add_number(const std::string& name, int& number, int least, int most,
                         const std::string& description)
{
    app_->add_option(name, number, description)->check(CLI::Range(least, most))->capture_default_str();
}

void Program::set_footer(const std::string& footer)
{
    app_->footer(footer);
}

int Program::run(int argc, char** argv, const std::function<void()>& work)
{
    const auto complain = [&](std::string_view message) {
        message = message.substr(0, message.find('\n'));
        std::fprintf(stderr, "%s: %.*s\n", app_->get_name().c_str(), static_cast<int>(message.size()),
                     message.data());
        return 2;
    };
    try {
        app_->parse(argc, argv);
        work();
        return std::fflush(stdout) == 0 ? 0 : complain("standard output cannot be written");
    } catch (const CLI::Success& help) {
        return app_->exit(help);
    } catch (const CLI::ParseError& error) {
        return complain(error.what() + (" (" + app_->get_name() + " --help lists the options)"));
    } catch (const std::exception& error) {
        return complain(error.what());
    }
}

scenes::Scene read_scene(const std::string& file, bool framed)
{
    scenes::Scene scene = scenes::read_scene(file);
    if (framed) scenes::frame_camera(scene);
    if (!scene.camera) throw std::invalid_argument(file + ": <COLLADA>: the scene has no camera");
    if (framed) scene.name += " (framed)";
    return scene;
}

std::vector<scenes::Scene> read_scenes(const SceneFiles& files)
{
    std::vector<scenes::Scene> all;
    for (const std::string& file : files.as_they_are) all.push_back(read_scene(file));
    for (const std::string& file : files.framed) all.push_back(read_scene(file, true));
    if (all.empty()) throw std::invalid_argument("no scene is named");
    return all;
}

} // namespace figures
