// Notices for the user about surfaces that touch. The rules are in contacts.h.

#include "scenes/contacts.h"

#include "scenes/for_each_light.h"
#include "scenes/largest_component.h"
#include "scenes/primitive_name.h"

#include <glm/geometric.hpp>

namespace scenes {
namespace {

/// Whether a picture can show which of two coincident surfaces is seen: not where two opaque ones face
/// each other, as where a body stands on the ground; nor where their materials are one.
bool is_worth_a_word(const Scene& scene, std::uint32_t a, std::uint32_t b)
{
    const std::uint32_t material_a = material_of(scene, a);
    const std::uint32_t material_b = material_of(scene, b);
    if (material_a == material_b) return false;
    const auto is_opaque = [&](std::uint32_t material) {
        return std::holds_alternative<Lambertian>(scene.materials[material]) ||
               std::holds_alternative<Mirror>(scene.materials[material]);
    };
    if (!is_opaque(material_a) || !is_opaque(material_b) || a >= scene.triangles.size()) return true;
    const auto normal = [&](std::uint32_t triangle) { // of no known length
        const auto& v = scene.triangles[triangle].vertices;
        const Vec3 across = glm::cross(v[1] - v[0], v[2] - v[0]);
        return across / largest_component(across); // those that coincide have an area
    };
    return glm::dot(normal(a), normal(b)) > 0;
}

void add_end(std::vector<std::string>& notices, const Scene& scene, const std::string& what,
             const Vec3& position)
{
    const std::vector<std::uint32_t> on = surfaces_at(scene, position);
    if (on.empty()) return;
    const std::string others =
        on.size() > 1 ? " and " + std::to_string(on.size() - 1) + " more surface(s)" : "";
    notices.push_back(what + " lies on " + primitive_name(scene, on[0]) + others +
                      ": it is not hidden by what it lies on");
}

/// From how many surfaces in one place on a person should know that they cost time: a leaf of a tree
/// holds a few, and a ray into it tests them all.
constexpr std::size_t many = 64;

void add_crowd(std::vector<std::string>& notices, const Scene& scene, const Coincidences& coincident)
{
    std::uint32_t fullest = 0;
    for (std::uint32_t i = 0; i < primitive_count(scene); ++i)
        if (coincident.of(i).size() > coincident.of(fullest).size()) fullest = i;
    if (primitive_count(scene) == 0 || coincident.of(fullest).size() < many) return;
    notices.push_back(std::to_string(coincident.of(fullest).size()) + " surfaces coincide with " +
                      primitive_name(scene, fullest) +
                      ": no tree can part them, and every ray that comes near tests them all");
}

} // namespace

std::vector<std::string> contact_notices(const Scene& scene)
{
    std::vector<std::string> notices;
    if (scene.camera) add_end(notices, scene, "the eye", scene.camera->eye);
    for_each_light_position(scene, [&](const Vec3& position, const std::string& name) {
        add_end(notices, scene, name, position);
    });

    bool complete = true;
    const Coincidences coincident = coincidences(scene, double_rounding, &complete);
    std::size_t pairs = 0;
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    for (std::uint32_t i = 0; i < primitive_count(scene); ++i)
        for (const std::uint32_t other : coincident.of(i)) {
            if (other < i || !is_worth_a_word(scene, i, other)) continue;
            if (pairs++ > 0) continue;
            first = i;
            second = other;
        }
    if (pairs > 0)
        notices.push_back(
            std::to_string(pairs) + " pair(s) of surfaces coincide, first " +
            primitive_name(scene, first) + " and " + primitive_name(scene, second) +
            ": a ray sees an emitter from its shining side before an opaque surface, and this before "
            "glass; of two of one kind the one that comes first in the file");
    if (!complete)
        notices.emplace_back(
            "more than 4096 surfaces overlap in one place: no tree can part them, every ray that comes "
            "near tests them all, and which of those that coincide it sees depends on rounding");
    else
        add_crowd(notices, scene, coincident);
    return notices;
}

} // namespace scenes
