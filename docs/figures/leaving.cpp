// Draws the pictures of docs/leaving-a-surface.md and writes its tables: rays that leave surfaces by a
// fixed distance, too small, fitting and too large, beside the right picture. Usage: figure_leaving
// --help

#include "docs/figures/float_path.h"
#include "docs/figures/page_parts.h"
#include "docs/figures/program.h"
#include "images/atomic_file.h"
#include "images/label.h"
#include "images/png.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using figures::Leave;
using images::Image;
constexpr std::array epsilons = {5e-2F, 1e-4F, 1e-7F};
constexpr int label_height = 14;

/// Every length of `scene` times `factor`.
scenes::Scene scaled(scenes::Scene scene, double factor)
{
    for (scenes::Triangle& triangle : scene.triangles)
        for (scenes::Vec3& v : triangle.vertices) v *= factor;
    for (scenes::Sphere& sphere : scene.spheres) sphere.center *= factor, sphere.radius *= factor;
    scene.camera->eye *= factor;
    return scene;
}

std::string short_text(double number)
{
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
}

double mean_of(const Image& image)
{
    double sum = 0.0;
    for (const images::Rgb& pixel : image.pixels) sum += pixel.x + pixel.y + pixel.z;
    return sum;
}

/// The same part of a picture by each rule: three fixed distances, the bound, and in doubles. Adds a row
/// to `table` for each rule.
struct Row {
    std::string name; // of the scale or the scene
    scenes::Scene scene;
    int width, height; // of the whole picture
    figures::Region region;
    std::uint32_t samples;
    int max_edges;
};

/// By three fixed distances, by the bound, and in doubles. Adds a line to `table` for each rule.
std::vector<Image> draw_row(const Row& row, std::string& table)
{
    const ref::World world(row.scene, row.width, row.height);
    const ref::PathOptions options{.seed = 1, .max_edges = row.max_edges};
    const Image right = render_in_doubles(world, options, row.region, row.samples);
    std::vector<Image> pictures;
    const auto add = [&](const std::string& rule, Leave leave) {
        figures::SelfHits self;
        pictures.push_back(render_in_floats(world, options, leave, row.region, row.samples, self));
        char text[200];
        std::snprintf(text, sizeof text, "| %s | %s | %.3f%% | %.1f%% |\n", row.name.c_str(),
                      rule.c_str(),
                      100.0 * static_cast<double>(self.hits) / static_cast<double>(self.rays),
                      100.0 * mean_of(pictures.back()) / mean_of(right));
        table += text;
    };
    for (const float epsilon : epsilons)
        add("fixed, " + short_text(static_cast<double>(epsilon)), {epsilon});
    add("error bound", {});
    pictures.push_back(right);
    return pictures;
}

/// The pictures of all rows with a line of labels above.
Image sheet(const std::vector<std::vector<Image>>& rows)
{
    const int width = rows[0][0].width;
    const int height = rows[0][0].height;
    Image all(static_cast<int>(rows[0].size()) * width,
              label_height + static_cast<int>(rows.size()) * height);
    std::vector<std::string> labels;
    for (const float epsilon : epsilons) labels.push_back(short_text(static_cast<double>(epsilon)));
    labels.insert(labels.end(), {"error bound", "right"});
    for (std::size_t column = 0; column < labels.size(); ++column) {
        const int left = static_cast<int>(column) * width;
        images::draw_text(all, left + 3, 3, labels[column], images::Rgb(0.8));
        for (std::size_t row = 0; row < rows.size(); ++row)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    all.at(left + x, label_height + static_cast<int>(row) * height + y) =
                        rows[row][column].at(x, y);
    }
    return all;
}

struct Files {
    std::string page;
    std::string folder;
    std::string glass; // scenes
    std::string door;
    int samples = 40; // per pixel
};

void draw(const Files& files)
{
    const scenes::Scene glass = figures::read_scene(files.glass);
    const scenes::Scene door = figures::read_scene(files.door);
    const std::string head = "| scene | rays leave by | self-hits | brightness |\n|---|---|---|---|\n";
    std::map<std::string, std::string> parts;
    const std::filesystem::path folder = files.folder;
    const auto draw_sheet = [&](const std::string& name, double exposure, const std::vector<Row>& rows) {
        std::string table = head;
        std::vector<std::vector<Image>> pictures;
        for (const Row& row : rows) pictures.push_back(draw_row(row, table));
        parts[name] = table;
        images::write_png(folder / ("leaving_" + name + ".png"), sheet(pictures), exposure);
    };
    const scenes::Scene large = scaled(glass, 1000.0);
    const auto samples = static_cast<std::uint32_t>(files.samples);
    const figures::Region whole{0, 0, 108, 72};
    draw_sheet("scales", 0.0,
               {{"scale 1", glass, 108, 72, whole, samples, 6},
                {"scale 1000", large, 108, 72, whole, samples, 6}});
    const figures::Region ball{205, 120, 80, 80};
    draw_sheet("rings", 0.0,
               {{"scale 1", glass, 340, 226, ball, samples, 6},
                {"scale 1000", large, 340, 226, ball, samples, 6}});
    draw_sheet("leaks", 2.0, {{"scale 1", door, 108, 72, whole, 3 * samples, 2}});
    const std::string page = figures::with_parts(images::read_file(files.page), "figure_leaving", parts);
    images::write_atomically(files.page, page);
}

} // namespace

int main(int argc, char** argv)
{
    figures::Program program("Draws the pictures of docs/leaving-a-surface.md and writes its tables: "
                             "rays that leave surfaces by fixed "
                             "distances and by a bound",
                             "figure_leaving");
    Files files;
    program.add_file("page", files.page, "Page with the marks: docs/leaving-a-surface.md");
    program.add_file("folder", files.folder, "Folder of the pictures: docs/images");
    program.add_file("glass", files.glass, "Scene with a glass ball: scenes/cornell_glass.dae");
    program.add_file("door", files.door, "Scene with a thin wall: scenes/door_ajar.dae");
    program.add_number("--samples", files.samples, 1, 100'000,
                       "Samples per pixel; where paths are short, three times as many");
    program.set_footer(
        "Example: figure_leaving docs/leaving-a-surface.md docs/images scenes/cornell_glass.dae "
        "scenes/door_ajar.dae");
    return program.run(argc, argv, [&] { draw(files); });
}
