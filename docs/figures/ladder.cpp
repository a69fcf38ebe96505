// Climbs the ladder of docs/ladder.md: pictures of the same scenes by five estimators in equal CPU time,
// their errors with intervals, written into the page.
// Usage: figure_ladder --help

#include "cli/processor.h"
#include "docs/figures/ladder_rungs.h"
#include "docs/figures/measure.h"
#include "docs/figures/page_parts.h"
#include "docs/figures/program.h"
#include "images/atomic_file.h"
#include "images/film.h"
#include "images/label.h"
#include "images/png.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/renderer.h"
#include "trade/rounds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <thread>

namespace {

using images::Image;
constexpr int max_edges = 6;

struct Options {
    std::string page;
    std::string folder;
    int width = 150; // of a picture; its height is two thirds
    figures::RoundOptions rounds{.rounds = 5, .seconds = 2.0, .reference_seconds = 60.0, .seed = 1};
    [[nodiscard]] int height() const { return width * 2 / 3; }
};

Image rendered(const ref::World& world, ref::Integrator integrator, std::uint64_t seed,
               std::uint64_t samples)
{
    images::Film film(world.camera.width(), world.camera.height());
    images::fill(
        film, samples,
        *ref::renderer(world, integrator, {.seed = seed, .max_edges = max_edges, .batch_size = 1}));
    return film.mean();
}

/// CPU seconds of one sample per pixel of each rung. They are measured in turns, so that a change of the
/// machine's load affects all; each turn takes about a quarter of `seconds`.
std::vector<double> seconds_per_sample(const ref::World& world, double seconds)
{
    constexpr int turns = 4;
    const auto& rungs = figures::ladder();
    std::vector<std::uint64_t> samples(rungs.size(), 1);
    std::vector<double> cost(rungs.size(), 0.0);
    for (int turn = -1; turn < turns; ++turn)
        for (std::size_t i = 0; i < rungs.size(); ++i) {
            const double start = figures::cpu_seconds();
            rendered(world, rungs[i].integrator, 0, samples[i]);
            const double one = (figures::cpu_seconds() - start) / static_cast<double>(samples[i]);
            if (turn < 0) // only to choose the number of samples
                samples[i] = static_cast<std::uint64_t>(std::clamp(seconds / turns / one, 1.0, 1e6));
            else
                cost[i] += one / turns;
        }
    return cost;
}

double mean_of(const Image& image)
{
    double sum = 0.0;
    for (const images::Rgb& pixel : image.pixels) sum += pixel.x + pixel.y + pixel.z;
    return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

/// The root of the mean over pixels and channels of (a - b)^2.
double root_mean_square(const Image& a, const Image& b)
{
    const Image ones = [&] {
        Image image(a.width, a.height);
        for (images::Rgb& pixel : image.pixels) pixel = images::Rgb(1.0);
        return image;
    }();
    return std::sqrt(trade::weighted_square(ones, a, b));
}

/// What is measured of one rung on one scene.
struct Measured {
    std::uint64_t samples = 0;      // per pixel
    std::vector<double> seconds;    // CPU, by round
    std::vector<double> relative;   // relMSE
    std::vector<double> error;      // RMSE in percent of the mean of the reference
    std::vector<double> brightness; // mean in percent of that of the reference
    Image picture;                  // of the first round
};

struct Climbed {
    std::string name; // of the scene
    Image reference;
    std::vector<Measured> rungs;
};

Climbed climb(const scenes::Scene& scene, const Options& options, std::mt19937_64& random)
{
    const ref::World world(scene, options.width, options.height());
    const auto& rungs = figures::ladder();
    Climbed climbed{scene.name, {}, std::vector<Measured>(rungs.size())};
    // As many samples as the time allows at the cost that was measured: a whole number, fixed before.
    const std::vector<double> cost = seconds_per_sample(world, options.rounds.seconds);
    for (std::size_t i = 0; i < rungs.size(); ++i)
        climbed.rungs[i].samples =
            static_cast<std::uint64_t>(std::max(1.0, std::round(options.rounds.seconds / cost[i])));
    const double scale = options.rounds.reference_seconds / options.rounds.seconds;
    climbed.reference = rendered(world, ref::trace_bidirectionally, options.rounds.seed,
                                 static_cast<std::uint64_t>(std::ceil(
                                     scale * static_cast<double>(climbed.rungs.back().samples))));
    const double truth = mean_of(climbed.reference);
    std::vector<trade::Measurement> measurements;
    for (std::size_t i = 0; i < rungs.size(); ++i)
        measurements.emplace_back([&, i](std::size_t round) {
            Measured& rung = climbed.rungs[i];
            const std::uint64_t seed = options.rounds.seed + 1 + round * rungs.size() + i;
            const double start = figures::cpu_seconds();
            Image picture = rendered(world, rungs[i].integrator, seed, rung.samples);
            rung.seconds.push_back(figures::cpu_seconds() - start);
            rung.error.push_back(100.0 * root_mean_square(picture, climbed.reference) / truth);
            rung.relative.push_back(figures::relative_mean_square_error(picture, climbed.reference));
            rung.brightness.push_back(100.0 * mean_of(picture) / truth);
            if (round == 0) rung.picture = std::move(picture);
            return 0.0;
        });
    trade::measure_in_rounds(options.rounds.rounds, random, measurements);
    return climbed;
}

std::string table(const Climbed& climbed)
{
    std::string text =
        "| rung | samples per pixel | CPU seconds | RMSE, % of the mean | relMSE | brightness, % "
        "of the reference |\n"
        "|---|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < climbed.rungs.size(); ++i) {
        const Measured& rung = climbed.rungs[i];
        text += std::string("| ") + figures::ladder()[i].title + " | " + std::to_string(rung.samples) +
                " | " + to_text(trade::mean_of_rounds(rung.seconds)) + " | " +
                to_text(trade::mean_of_rounds(rung.error)) + " | " +
                to_text(trade::mean_of_rounds(rung.relative)) + " | " +
                to_text(trade::mean_of_rounds(rung.brightness)) + " |\n";
    }
    return text;
}

/// Copies `from` into `to` with its top left corner at (x, y).
void paste(Image& to, const Image& from, int x, int y)
{
    for (int row = 0; row < from.height; ++row)
        for (int column = 0; column < from.width; ++column)
            to.at(x + column, y + row) = from.at(column, row);
}

/// Half as wide and half as high; each pixel the mean of four.
Image halved(const Image& image)
{
    Image half(image.width / 2, image.height / 2);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            half.at(x, y) = (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) +
                             image.at(2 * x, 2 * y + 1) + image.at(2 * x + 1, 2 * y + 1)) /
                            4.0;
    return half;
}

/// The pictures of one rung, of all scenes side by side.
Image side_by_side(const std::vector<const Image*>& pictures)
{
    Image all(static_cast<int>(pictures.size()) * pictures[0]->width, pictures[0]->height);
    for (std::size_t i = 0; i < pictures.size(); ++i)
        paste(all, *pictures[i], static_cast<int>(i) * pictures[0]->width, 0);
    return all;
}

/// All rungs and the reference in half the size: a row for each rung, a column for each scene.
Image sheet(const std::vector<Climbed>& scenes)
{
    constexpr int label = 14;
    const int width = scenes[0].reference.width / 2;
    const int height = scenes[0].reference.height / 2;
    const auto& rungs = figures::ladder();
    const int columns = static_cast<int>(rungs.size()) + 1;
    Image all(columns * width, label + static_cast<int>(scenes.size()) * height);
    for (int column = 0; column < columns; ++column) {
        const auto i = static_cast<std::size_t>(column);
        images::draw_text(all, column * width + 2, 3, i < rungs.size() ? rungs[i].title : "reference",
                          images::Rgb(0.8));
        for (std::size_t row = 0; row < scenes.size(); ++row)
            paste(all, halved(i < rungs.size() ? scenes[row].rungs[i].picture : scenes[row].reference),
                  column * width, label + static_cast<int>(row) * height);
    }
    return all;
}

void write_all(const std::vector<Climbed>& scenes, const Options& options)
{
    std::map<std::string, std::string> parts;
    for (const Climbed& scene : scenes) parts[scene.name] = table(scene);
    char text[400];
    std::snprintf(text, sizeof text,
                  "*%d x %d pixels, at most %d edges, %.3g s of CPU time for each picture; %zu rounds "
                  "in random order, each with "
                  "other seeds; means with 95%% intervals. The reference is bidirectional path tracing "
                  "with %.3g times the "
                  "samples. %s, %u threads, one of them used, %s.*\n",
                  options.width, options.height(), max_edges, options.rounds.seconds,
                  options.rounds.rounds, options.rounds.reference_seconds / options.rounds.seconds,
                  cli::processor_name().c_str(), std::thread::hardware_concurrency(),
                  cli::today().c_str());
    parts["machine"] = text;
    const std::string page =
        figures::with_parts(images::read_file(options.page), "figure_ladder", parts);

    const std::filesystem::path folder = options.folder;
    const auto write = [&](const std::string& name, const Image& image) {
        images::write_png(folder / ("ladder_" + name + ".png"), image);
    };
    for (std::size_t i = 0; i < figures::ladder().size(); ++i) {
        std::vector<const Image*> pictures;
        for (const Climbed& scene : scenes) pictures.push_back(&scene.rungs[i].picture);
        write(figures::ladder()[i].name, side_by_side(pictures));
    }
    std::vector<const Image*> references;
    for (const Climbed& scene : scenes) references.push_back(&scene.reference);
    write("reference", side_by_side(references));
    write("sheet", sheet(scenes));
    images::write_atomically(options.page, page);
}

} // namespace

int main(int argc, char** argv)
{
    figures::Program program(
        "Draws the pictures of docs/ladder.md and writes its tables: five estimators in equal CPU time",
        "figure_ladder");
    Options options;
    figures::SceneFiles files;
    program.add_file("page", options.page, "Page with the marks: docs/ladder.md");
    program.add_file("folder", options.folder, "Folder of the pictures: docs/images");
    program.add(files);
    program.add(options.rounds);
    program.add_number("--width", options.width, 6, 1500,
                       "Of a picture, in pixels; its height is two thirds");
    program.set_footer("Example: figure_ladder docs/ladder.md docs/images scenes/cornell_glass.dae "
                       "scenes/ceiling_lamp.dae");
    return program.run(argc, argv, [&] {
        images::check_place(options.page);
        images::check_place(std::filesystem::path(options.folder) / "ladder_sheet.png");
        const std::vector<scenes::Scene> all = figures::read_scenes(files);
        std::mt19937_64 random(options.rounds.seed);
        std::vector<Climbed> climbed;
        for (const scenes::Scene& scene : all) climbed.push_back(climb(scene, options, random));
        write_all(climbed, options);
    });
}
