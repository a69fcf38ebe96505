#include "cli/scene_input.h"

#include "golden/file_ending.h"
#include "scenes/contacts.h"
#include "scenes/frame.h"
#include "scenes/placed.h"
#include "scenes/read_scene.h"

#include <charconv>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace cli {

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

void expect_ending(const std::string& path, const std::string& option, const std::string& ending)
{
    if (!path.empty() && !golden::has_ending(path, ending))
        throw std::invalid_argument(option + " " + path + ": its name must end in " + ending);
}

scenes::Scene load_scene(const std::string& file, bool frame, bool quiet)
{
    scenes::Scene scene = scenes::read_scene(file);
    if (frame) scenes::frame_camera(scene);
    if (!scene.camera) throw std::invalid_argument(file + ": <COLLADA>: the scene has no camera");
    scene = scenes::placed(std::move(scene));
    for (std::string& notice : scenes::contact_notices(scene))
        scene.notices.push_back(std::move(notice));
    if (!quiet)
        for (const std::string& notice : scene.notices) std::cerr << file << ": " << notice << '\n';
    return scene;
}

} // namespace cli
