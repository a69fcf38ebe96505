// `plumbline render`: a scene file in, pictures out.

#include "ref/transport/render.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "golden/exr.h"
#include "golden/write_image.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "scenes/frame.h"
#include "scenes/read_scene.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace cli {

namespace {

struct Options {
    std::string scene;
    std::vector<std::string> outputs;
    std::string size = "240x160";
    std::uint64_t samples = 64;
    std::uint32_t batch_size = 4;
    unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    std::string integrator = "path";
    std::string heuristic = "balance";
    int max_edges = ref::unlimited_edges;
    bool no_roulette = false;
    std::uint64_t seed = 0;
    double exposure = 0.0;
    bool frame = false;
    bool resume = false;
    bool json = false;
    bool quiet = false;
};

struct Size {
    int width, height;
};

const std::map<std::string, ref::Integrator> integrators = {
    {"path", ref::trace_path}, {"bdpt", ref::trace_bidirectionally}, {"light", ref::trace_light}};
const std::map<std::string, ref::Heuristic> heuristics = {{"balance", ref::Heuristic::balance},
                                                          {"power", ref::Heuristic::power}};

/// Reads "WxH". Throws std::invalid_argument.
Size parse_size(const std::string& text)
{
    Size size{};
    const char* const end = text.data() + text.size();
    const auto [x, width_error] = std::from_chars(text.data(), end, size.width);
    if (width_error == std::errc() && x != end && *x == 'x') {
        const auto [rest, height_error] = std::from_chars(x + 1, end, size.height);
        constexpr int largest = 1 << 16;
        if (height_error == std::errc() && rest == end && size.width > 0 && size.height > 0 &&
            size.width <= largest && size.height <= largest &&
            size.width * 1ll * size.height <= 1ll << 28)
            return size;
    }
    throw std::invalid_argument("--size " + text +
                                ": expected WxH, such as 240x160, each from 1 to 65536 " +
                                "and at most 2^28 pixels together");
}

/// Everything that shapes the picture, and so must be the same for one render to go on from another.
golden::Metadata describe(const Options& options, const scenes::Scene& scene)
{
    return {{"scene", scene.name},
            {"scene_hash", scene.hash},
            {"integrator", options.integrator},
            {"heuristic", options.heuristic},
            {"batch_size", std::to_string(options.batch_size)},
            {"max_edges", options.max_edges == ref::unlimited_edges ? "unlimited"
                                                                    : std::to_string(options.max_edges)},
            {"roulette", options.no_roulette ? "off" : "on"},
            {"seed", std::to_string(options.seed)},
            {"camera", options.frame ? "framed" : "of the scene"},
            {"version", PLUMBLINE_VERSION}};
}

/// The film to start from: that of the file to resume, or an empty one. Throws if the file holds
/// another picture than the one asked for.
golden::Film starting_film(const Options& options, const golden::Metadata& description, const Size& size,
                           std::uint64_t batches)
{
    if (!options.resume) return {size.width, size.height};
    const auto exr =
        std::find_if(options.outputs.begin(), options.outputs.end(), [](const std::string& path) {
            return std::filesystem::path(path).extension() == ".exr";
        });
    if (exr == options.outputs.end())
        throw std::invalid_argument(
            "--resume needs an .exr among the outputs: only it holds all digits");
    if (!std::filesystem::exists(*exr)) return {size.width, size.height};

    golden::ExrPicture picture = golden::read_exr(*exr);
    if (!picture.film) throw std::invalid_argument(*exr + ": holds no state to resume from");
    for (const auto& [name, value] : description) {
        const auto found = picture.metadata.find(name);
        if (found == picture.metadata.end() || found->second != value)
            throw std::invalid_argument(*exr + ": cannot resume: its " + name + " is '" +
                                        (found == picture.metadata.end() ? "" : found->second) +
                                        "', not '" + value + "'");
    }
    const golden::Image& mean = picture.film->mean();
    if (mean.width != size.width || mean.height != size.height)
        throw std::invalid_argument(*exr + ": cannot resume: it has " + std::to_string(mean.width) +
                                    "x" + std::to_string(mean.height) + " pixels, not " + options.size);
    if (picture.film->batches() > batches)
        throw std::invalid_argument(
            *exr + ": holds " + std::to_string(picture.film->batches() * options.batch_size) +
            " samples per pixel already, more than -s " + std::to_string(options.samples));
    return std::move(*picture.film);
}

void check(const Options& options)
{
    if (options.samples % options.batch_size != 0)
        throw std::invalid_argument("-s " + std::to_string(options.samples) +
                                    ": not a multiple of the " + std::to_string(options.batch_size) +
                                    " samples of a batch (--batch)");
    if (options.no_roulette && options.max_edges == ref::unlimited_edges)
        throw std::invalid_argument("--no-roulette needs --max-edges: paths would never end");
    for (const std::string& path : options.outputs) golden::check_writable(path);
}

double cpu_seconds(const rusage& usage)
{
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

rusage resources()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}

glm::dvec3 mean_rgb(const golden::Image& image)
{
    glm::dvec3 sum(0.0);
    for (const auto& pixel : image.pixels) sum += pixel;
    return sum / static_cast<double>(image.pixels.size());
}

ExitStatus render(const Options& options)
{
    const Size size = parse_size(options.size);
    check(options);
    scenes::Scene scene = scenes::read_scene(options.scene);
    if (!options.quiet)
        for (const std::string& notice : scene.notices)
            std::cerr << options.scene << ": " << notice << '\n';
    if (options.frame) scenes::frame_camera(scene);
    if (!scene.camera)
        throw std::invalid_argument(options.scene + ": <COLLADA>: the scene has no camera");

    golden::Metadata metadata = describe(options, scene);
    const std::uint64_t batches = options.samples / options.batch_size;
    golden::Film film = starting_film(options, metadata, size, batches);
    const std::uint64_t batches_before = film.batches();

    const ref::World world(scene, size.width, size.height);
    const ref::RenderOptions render_options{
        {options.seed, options.max_edges, !options.no_roulette, heuristics.at(options.heuristic)},
        batches,
        options.batch_size,
        options.threads};
    catch_interrupts();
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpu_seconds(resources());
    bool complete = false;
    {
        Progress progress(scene.name, static_cast<double>(batches_before), static_cast<double>(batches),
                          options.quiet);
        complete = ref::render(world, integrators.at(options.integrator), render_options, film,
                               {[&](double done) { progress.update(done); }, interrupt_requested});
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double cpu = cpu_seconds(resources()) - cpu_start;

    const std::uint64_t held = film.batches() * options.batch_size;
    metadata["samples"] = std::to_string(held);
    if (!complete) metadata["interrupted"] = "before " + std::to_string(options.samples) + " samples";
    if (film.batches() > 0)
        for (const std::string& path : options.outputs)
            golden::write_image(path, film, metadata, options.exposure);

    const auto samples = static_cast<double>((film.batches() - batches_before) * options.batch_size) *
                         size.width * size.height;
    if (options.json) {
        const auto mean = mean_rgb(film.mean());
        const nlohmann::json report = {{"scene", scene.name},
                                       {"integrator", options.integrator},
                                       {"width", size.width},
                                       {"height", size.height},
                                       {"samples_per_pixel", held},
                                       {"samples", samples},
                                       {"seconds", seconds},
                                       {"cpu_seconds", cpu},
                                       {"samples_per_second", seconds > 0.0 ? samples / seconds : 0.0},
                                       {"mean_rgb", {mean.x, mean.y, mean.z}},
                                       {"peak_rss_bytes", resources().ru_maxrss * 1024},
                                       {"threads", options.threads},
                                       {"complete", complete},
                                       {"outputs", options.outputs}};
        std::cout << report.dump() << std::endl;
    }
    if (!complete) {
        std::cerr << "plumbline: interrupted: "
                  << (film.batches() > 0 ? "kept " : "nothing written, no batch was finished: ") << held
                  << " of " << options.samples << " samples per pixel\n";
        return interrupted;
    }
    return fine;
}

} // namespace

void add_render_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        program.add_subcommand("render", "Render a scene file with the reference integrators");
    command->add_option("scene", options->scene, "COLLADA file")->required();
    command->add_option("-o,--output", options->outputs, "Picture: .exr, .pfm or .png; may be repeated")
        ->required();
    command->add_option("--size", options->size, "Width x height in pixels")->capture_default_str();
    command->add_option("-s,--samples", options->samples, "Samples per pixel in the end")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31))
        ->capture_default_str();
    command
        ->add_option("--batch", options->batch_size,
                     "Samples per pixel in a batch, the unit of error and resuming")
        ->check(CLI::Range(1u, 1u << 20))
        ->capture_default_str();
    command->add_option("-t,--threads", options->threads, "Threads; the picture does not depend on them")
        ->check(CLI::Range(1u, 1024u))
        ->capture_default_str();
    command->add_option("--integrator", options->integrator, "path, bdpt (bidirectional) or light")
        ->check(CLI::IsMember(integrators))
        ->capture_default_str();
    command
        ->add_option("--max-edges", options->max_edges,
                     "Longest path, the camera's edge counted [no limit]")
        ->check(CLI::Range(1, 1 << 20));
    command->add_flag("--no-roulette", options->no_roulette, "Never end a path by chance");
    command->add_option("--seed", options->seed, "Another seed, another noise")->capture_default_str();
    command
        ->add_option("--exposure", options->exposure,
                     "For .png: stops that the picture is brightened by")
        ->check(CLI::Range(-64.0, 64.0))
        ->capture_default_str();
    command->add_flag("--frame", options->frame,
                      "Move the camera back to where it sees the whole scene");
    command->add_flag("--resume", options->resume,
                      "Go on from the samples in the .exr output, if it is there");
    command->add_flag("--json", options->json, "Print one JSON object with time, samples and mean");
    command->add_flag("-q,--quiet", options->quiet, "No progress and no notices");
    command->footer(
        "Example: plumbline render scenes/cornell_glass.dae -o glass.exr -o glass.png -s 256");
    command->callback([options, &work] { work = [options] { return render(*options); }; });
}

} // namespace cli
