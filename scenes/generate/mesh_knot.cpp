// Writes scenes/mesh_knot.dae: a rope along a torus knot, 20480 triangles, in a lit room.
//
//   generate_mesh_knot FILE            writes FILE
//   generate_mesh_knot --check FILE    exits with 1 unless FILE holds exactly these bytes
//
// The bytes are the same on every machine: coordinates are rounded to four digits and printed without a
// locale. (sin and cos may differ in the last bit between libraries, but none of the numbers here is so
// close to the middle between two roundings that this changes a digit.)
//
// The curve is c(t) = ((2 + cos 3t) cos 2t, (2 + cos 3t) sin 2t, -sin 3t), 0 <= t < 2 pi: the (2,3)
// torus knot, or trefoil. Its Frenet frame T, N, B closes after one turn, and so does the mesh: each
// vertex is written once and shared by six triangles.

#include "scenes/generate/mesh_knot_frame.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <string_view>

namespace {

constexpr int rings = 320; // along the knot
constexpr int sides = 32;  // around the rope
constexpr double rope_radius = 0.5;
constexpr double ridge_height = 0.12; // as a fraction of the radius
constexpr int strands = 4;            // ridges around the rope
constexpr int twists = 9;             // turns of each ridge along the whole knot
constexpr int digits = 4;

void append_number(std::string& text, double value)
{
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::fixed, digits)
                         .ptr;
    std::string_view number(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    while (number.back() == '0') number.remove_suffix(1);
    if (number.back() == '.') number.remove_suffix(1);
    text += number == "-0" ? "0" : number;
}

/// The point of the rope's surface at angle t along the knot and angle u around the rope.
glm::dvec3 rope(double t, double u)
{
    const double r = 2 + std::cos(3 * t);
    const double dr = -3 * std::sin(3 * t);
    const double ddr = -9 * std::cos(3 * t);
    const glm::dvec3 radial(std::cos(2 * t), std::sin(2 * t), 0);
    const glm::dvec3 around(-std::sin(2 * t), std::cos(2 * t), 0);
    const glm::dvec3 axis(0, 0, 1);
    const glm::dvec3 center = r * radial - std::sin(3 * t) * axis;
    const glm::dvec3 first = dr * radial + 2 * r * around - 3 * std::cos(3 * t) * axis;
    const glm::dvec3 second = (ddr - 4 * r) * radial + 4 * dr * around + 9 * std::sin(3 * t) * axis;
    const glm::dvec3 binormal = glm::normalize(glm::cross(first, second));
    const glm::dvec3 normal = glm::normalize(glm::cross(binormal, first));
    const double radius = rope_radius * (1 + ridge_height * std::cos(strands * u + twists * t));
    return center + radius * (std::cos(u) * normal + std::sin(u) * binormal);
}

/// One line per ring: the coordinates of its vertices.
std::string positions()
{
    std::string text;
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < sides; ++j) {
            const glm::dvec3 p =
                rope(2 * std::numbers::pi * i / rings, 2 * std::numbers::pi * j / sides);
            for (int k = 0; k < 3; ++k) {
                text += j == 0 && k == 0 ? "            " : " ";
                append_number(text, p[k]);
            }
        }
        text += '\n';
    }
    return text;
}

/// One line per ring: two triangles for each quadrangle between it and the next, counter-clockwise seen
/// from outside.
std::string triangles()
{
    const auto vertex = [](int i, int j) { return std::to_string(i % rings * sides + j % sides); };
    std::string text;
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < sides; ++j) {
            const std::string a = vertex(i, j);
            const std::string b = vertex(i + 1, j);
            const std::string c = vertex(i + 1, j + 1);
            const std::string d = vertex(i, j + 1);
            text += j == 0 ? "            " : " ";
            text += a + ' ' + c + ' ' + b + ' ' + a + ' ' + d + ' ' + c;
        }
        text += '\n';
    }
    return text;
}

/// The whole file: the frame, with each `{word}` replaced by its text.
std::string scene()
{
    std::string text(frame);
    const auto replace = [&text](std::string_view word, const std::string& value) {
        for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
            text.replace(at, word.size(), value);
    };
    replace("{vertices}", std::to_string(rings * sides));
    replace("{coordinates}", std::to_string(3 * rings * sides));
    replace("{faces}", std::to_string(2 * rings * sides));
    replace("{positions}\n", positions());
    replace("{triangles}\n", triangles());
    return text;
}

int write(const char* path)
{
    std::ofstream file(path, std::ios::binary);
    file << scene() << std::flush;
    if (file) return 0;
    std::fprintf(stderr, "generate_mesh_knot: cannot write %s\n", path);
    return 2;
}

int compare_with(const char* path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string found{std::istreambuf_iterator<char>(file), {}};
    if (file && found == scene()) return 0;
    std::fprintf(stderr, "generate_mesh_knot: %s is not what this program writes\n", path);
    return 1;
}

} // namespace

int main(int count, char** arguments)
{
    if (count == 2 && arguments[1][0] != '-') return write(arguments[1]);
    if (count == 3 && std::string_view(arguments[1]) == "--check") return compare_with(arguments[2]);
    std::fputs("usage: generate_mesh_knot [--check] FILE\n", stderr);
    return 2;
}
