#pragma once

// A folder with real scenes and small simulated goldens for them: what is checked here is the check, and
// not what the pictures show.

#include "golden/golden.h"
#include "scenes/read_scene.h"
#include "tests/check/renderers/simple_picture.h"
#include "tests/images/temporary_folder.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace renderers_test {

namespace fs = std::filesystem;

/// Copies the scene into the folder, and makes a golden for it, unless they are there.
inline void add_scene(const fs::path& suite, const std::string& name)
{
    constexpr int size = 16;
    fs::create_directories(suite / "scenes");
    fs::create_directories(suite / "golden/renders");
    const fs::path scene = suite / "scenes" / (name + ".dae");
    if (fs::exists(scene)) return;
    fs::copy_file(fs::path(PLUMBLINE_SOURCE_DIR) / "scenes" / (name + ".dae"), scene);
    golden::GoldenMaker maker(size, size, 32);
    std::mt19937_64 random(name.size() * 1000 + static_cast<unsigned char>(name.front()));
    std::uniform_real_distribution<double> noise(-0.3, 0.3);
    for (int batch = 0; batch < 96; ++batch) {
        images::Image image = simple_picture(size);
        for (images::Rgb& pixel : image.pixels) pixel *= 1.0 + noise(random);
        maker.add_batch(image);
    }
    maker.write(suite / "golden/renders" / (name + ".exr"),
                {{"scene_hash", scenes::read_scene(scene).hash},
                 {"batch_size", "4"},
                 {"max_edges", "6"},
                 {"samples", "384"}},
                images::FilmState::omit);
}

/// The command line of the fake renderer.
inline std::vector<std::string> fake(const std::string& defect)
{
    return {PLUMBLINE_FAKE_RENDERER,
            defect,
            "{scene}",
            "{width}",
            "{height}",
            "{samples}",
            "{seed}",
            "{out}"};
}

} // namespace renderers_test
