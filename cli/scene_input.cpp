#include "cli/scene_input.h"

#include "images/file_ending.h"
#include "scenes/contacts.h"
#include "scenes/file_bytes.h"
#include "scenes/frame.h"
#include "scenes/placed.h"
#include "scenes/read_mesh.h"
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
    if (!path.empty() && !images::has_ending(path, ending))
        throw std::invalid_argument(option + " " + path + ": its name must end in " + ending);
}

namespace {

/// The file name that means standard input.
constexpr const char* standard_input = "-";

/// Reads the COLLADA file, or standard input. Throws scenes::SceneError.
scenes::Scene read_collada(const std::string& file, scenes::Parts parts)
{
    if (file != standard_input) return scenes::read_scene(file, parts);
    const std::string name = shown_name(file);
    scenes::Scene scene = scenes::parse_scene(scenes::stream_bytes(std::cin, name), name, parts);
    scene.name = "stdin";
    return scene;
}

/// Moves the camera if `frame`, and gives the scene one if it has none.
void place_camera(scenes::Scene& scene, const std::string& file, bool frame)
{
    if (scene.camera && frame) scenes::frame_camera(scene);
    if (scene.camera) return;
    if (scenes::primitive_count(scene) == 0)
        throw std::invalid_argument(shown_name(file) +
                                    ": the scene has no camera, and no geometry to place one before");
    scenes::add_camera(scene);
}

void print_notices(const scenes::Scene& scene, const std::string& file)
{
    for (const std::string& notice : scene.notices)
        std::cerr << shown_name(file) << ": " << notice << '\n';
}

/// A scene with materials and lights, as the file says it.
scenes::Scene read_with_camera(const std::string& file, bool frame)
{
    if (scenes::is_mesh_file(file))
        throw std::invalid_argument(
            file + ": a mesh without lights, which cannot be rendered: plumbline bvh reads such files");
    scenes::Scene scene = read_collada(file, scenes::Parts::all);
    place_camera(scene, file, frame);
    return scene;
}

/// The scene near the origin. Prints the notices, unless `quiet`.
scenes::Scene placed_with_notices(scenes::Scene scene, const std::string& file, bool quiet)
{
    scene = scenes::placed(std::move(scene));
    for (std::string& notice : scenes::contact_notices(scene))
        scene.notices.push_back(std::move(notice));
    if (!quiet) print_notices(scene, file);
    return scene;
}

/// Throws std::invalid_argument for a file name with the ending of a format that is not supported.
void expect_triangles(const std::string& file)
{
    const std::string ending = std::filesystem::path(file).extension().string();
    const bool collada = ending.empty() || images::has_ending(file, ".dae") ||
                         images::has_ending(file, ".xml") || file == standard_input;
    if (!collada && !scenes::is_mesh_file(file))
        throw std::invalid_argument(file + ": its name ends in " + ending +
                                    ", not in .dae, .obj, .ply, .stl, .gltf or .glb");
}

} // namespace

std::string shown_name(const std::string& file)
{
    return file == standard_input ? "<stdin>" : file;
}

scenes::Scene load_scene(const std::string& file, bool frame, bool quiet)
{
    return placed_with_notices(read_with_camera(file, frame), file, quiet);
}

scenes::Scene load_scene_as_written(const std::string& file, bool frame, bool quiet)
{
    scenes::Scene scene = read_with_camera(file, frame);
    (void)placed_with_notices(scene, file, quiet); // for its errors and notices
    return scene;
}

scenes::Scene load_triangles(const std::string& file, bool frame, bool quiet)
{
    expect_triangles(file);
    scenes::Scene scene = scenes::is_mesh_file(file) ? scenes::read_mesh(file)
                                                     : read_collada(file, scenes::Parts::geometry);
    place_camera(scene, file, frame);
    scene = scenes::placed(std::move(scene));
    if (!quiet) print_notices(scene, file);
    return scene;
}

} // namespace cli
