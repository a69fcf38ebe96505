// A renderer for the tests of check-renderer: it adds noise and a named defect to the right picture.
//
//   fake_renderer DEFECT SCENE WIDTH HEIGHT SAMPLES SEED OUT

#include "images/exr.h"
#include "images/file_ending.h"
#include "images/pfm.h"
#include "scenes/read_scene.h"
#include "scenes/requirements.h"
#include "tests/check/renderers/simple_picture.h"

#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <string>

namespace {

namespace fs = std::filesystem;
using images::Image;

Image upside_down(const Image& image)
{
    Image result(image.width, image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) result.at(x, y) = image.at(x, image.height - 1 - y);
    return result;
}

void scale(Image& image, double factor, int rows)
{
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < image.width; ++x) image.at(x, y) *= factor;
}

bool has_glass(const fs::path& scene)
{
    return scenes::requirements(scenes::read_scene(scene)).bsdfs.contains(scenes::Bsdf::glass);
}

void add_noise(Image& image, double samples, unsigned long long seed)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> noise(-1.0, 1.0);
    for (images::Rgb& pixel : image.pixels) pixel *= 1.0 + noise(random) / std::sqrt(samples);
}

/// Changes the picture; or ends the program.
void spoil(const std::string& defect, const fs::path& scene, Image& image)
{
    const bool glass = defect.starts_with("glass_") && has_glass(scene);
    if (defect == "upside_down") image = upside_down(image);
    if (defect == "over_pi") scale(image, 1.0 / std::numbers::pi, image.height);
    if (defect == "two_percent") scale(image, 0.98, image.height);
    if (defect == "gamma")
        for (images::Rgb& pixel : image.pixels)
            for (int c = 0; c < 3; ++c) pixel[c] = std::pow(pixel[c], 1.0 / 2.2);
    if (defect == "glass_dim" && glass) scale(image, 0.9, image.height / 2);
    if (defect == "nan") image.at(2, 1).g = std::numeric_limits<double>::quiet_NaN();
    if (defect == "wrong_size") image = Image(image.width, image.height / 2);
    if (defect == "crash" || (defect == "glass_crash" && glass)) {
        std::cerr << "loading\nan assertion failed: eta > 0\n";
        std::raise(SIGSEGV);
    }
    if (defect == "hang") pause();
    if (defect == "no_picture") std::exit(0);
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 8) return 64;
    const std::string defect = argv[1];
    const fs::path scene = argv[2];
    const fs::path out = argv[7];
    Image image = renderers_test::simple_picture(std::stoi(argv[3]));
    if (std::to_string(image.height) != argv[4]) return 65;
    add_noise(image, std::stod(argv[5]), defect == "same_noise" ? 1 : std::stoull(argv[6]));
    spoil(defect, scene, image);
    if (images::has_ending(out, ".pfm"))
        images::write_pfm(out, image);
    else {
        images::Film film(image.width, image.height);
        film.add_batch(image);
        images::write_exr(out, film, {}, {}, images::FilmState::omit);
    }
    if (defect == "damaged") fs::resize_file(out, 100);
    return defect == "exit_status" ? 3 : 0;
}
