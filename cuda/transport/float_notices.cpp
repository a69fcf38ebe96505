#include "cuda/transport/float_notices.h"

#include "cuda/transport/scene_arrays.h"
#include "cuda/trees/rounding.h"
#include "scenes/largest_component.h"

#include <algorithm>
#include <optional>

namespace gpu {
namespace {

/// How many, and which is the first.
class Count {
public:
    void add(std::uint32_t primitive)
    {
        if (count_++ == 0) first_ = primitive;
    }
    /// Appends "3 triangles or spheres, first triangle 5 (material "wall"), ..." if there are any.
    void say(std::vector<std::string>& notices, const scenes::Scene& scene, const char* what) const
    {
        if (count_ == 0) return;
        const bool is_triangle = first_ < scene.triangles.size();
        const std::size_t number = is_triangle ? first_ : first_ - scene.triangles.size();
        notices.push_back(std::to_string(count_) + " surface(s), first " +
                          (is_triangle ? "triangle " : "sphere ") + std::to_string(number + 1) +
                          " (material \"" + scene.material_names[material_of(scene, first_)] + "\"), " +
                          what);
    }

private:
    std::size_t count_ = 0;
    std::uint32_t first_ = 0;
};

/// Whether an extent a at a distance M from the centre is less than its clearance, up to
/// sqrt(3) u (2 M + 8 a), with room for a chord to be met that is shorter than the surface is wide.
bool is_too_small(double extent, double distance)
{
    return extent < 16 * unit_roundoff * distance;
}

} // namespace

std::vector<std::string> float_notices(const scenes::Scene& scene)
{
    const Placement place = placement_of(scene);
    Count collapsed;
    Count small;
    std::uint32_t primitive = 0;
    for (const scenes::Triangle& triangle : scene.triangles) {
        const auto& v = triangle.vertices;
        const double extent =
            std::max(scenes::largest_component(v[1] - v[0]), scenes::largest_component(v[2] - v[0]));
        if (has_area_in_double(triangle)) {
            if (!has_area(triangle, place))
                collapsed.add(primitive);
            else if (is_too_small(extent, scenes::largest_component(v[0] - place.origin)))
                small.add(primitive);
        }
        ++primitive;
    }
    for (const scenes::Sphere& sphere : scene.spheres) {
        if (is_too_small(sphere.radius, scenes::largest_component(sphere.center - place.origin)))
            small.add(primitive);
        ++primitive;
    }
    std::vector<std::string> notices;
    collapsed.say(notices, scene,
                  "collapse to a line or a point in single precision: no ray meets them");
    small.say(notices, scene,
              "are so small for their distance from the centre of the scene that single precision "
              "cannot leave them safely: light to and from them may be wrong");
    return notices;
}

} // namespace gpu
