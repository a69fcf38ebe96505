#pragma once

// The subcommand `golden`: makes, checks and lists the reference pictures; see command.h.

#include "cli/command.h"
#include "cli/render_options.h"
#include "golden/golden.h"
#include "scenes/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace cli {

void add_golden_command(CLI::App& program, Work& work);

struct GoldenCommand {
    std::vector<std::string> scenes;
    bool all = false; // every .dae in `scene_folder`
    std::string scene_folder = "scenes";
    std::string folder = "golden/renders";
    std::string size = "64x64";
    std::uint64_t samples = 1024;
    std::uint32_t batch_size = 4;
    std::uint64_t pilot_batches = 32;
    int max_edges = 6;
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    double watch = 60.0; // seconds between writes of a golden in the making
    bool list = false;
    std::uint64_t verify = 0; // batches per golden; 0: make goldens instead
    bool quiet = false;
    /// Which of the options above were given: those must be what a golden that is there was made with,
    /// also where none is made.
    struct Given {
        bool size = false, samples = false, batch_size = false, pilot_batches = false, max_edges = false;
    } given;
};

/// Goldens have a seed of their own: no candidate may share their random numbers.
inline constexpr std::uint64_t golden_seed = 271828182845904523;

/// The render that a golden is made of, and that it says it was made of.
RenderCommand render_of(const GoldenCommand& options, const std::string& scene);

/// The same, read back from a golden's metadata. Throws std::invalid_argument if something is missing.
RenderCommand render_of(const golden::Golden& golden, const std::string& scene);

/// Where the golden of a scene file lies.
std::filesystem::path golden_file(const GoldenCommand& options, const std::string& scene);

/// A golden that is there, or one in the making.
struct FoundGolden {
    const std::filesystem::path& path;
    const images::Image& mean;
    const images::Metadata& metadata;
    bool finished;
};
enum class Ask { all_options, given_options };

/// Throws images::ImageError that names each difference, with both values, if the golden was not made as
/// the options say: all of them, or only those that were given. `render_says` is how the render of the
/// scene describes itself; what is not in it is not compared.
void expect_made_so(const GoldenCommand& options, Ask ask, const FoundGolden& found,
                    const images::Metadata& render_says);

/// Renders batches of each golden anew, drawn at random, and compares all their functionals, bit for
/// bit; with as many batches as the golden has, its mean too. Says what it finds line by line.
ExitStatus verify_goldens(const GoldenCommand& options);

/// A line per scene: what its golden holds, what error a comparison with it can see, and whether the
/// scene has changed since.
ExitStatus list_goldens(const GoldenCommand& options);

} // namespace cli
