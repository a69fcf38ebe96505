#include "scenes/collada/geometries.h"

#include "scenes/collada/numbers.h"
#include "scenes/collada/polygons.h"
#include "scenes/collada/positions.h"
#include "scenes/polygons/cut.h"

#include <string_view>

namespace scenes::collada {
namespace {

LocalSphere read_sphere(const Element& technique)
{
    check_children(technique, {"sphere"});
    const Element& sphere = required_child(technique, "sphere");
    check_children(sphere, {"radius"});
    const Element& radius = required_child(sphere, "radius");
    if (!(number(radius) > 0)) fail(radius, "a radius is positive");
    return {number(radius)};
}

/// The vertices of a mesh: its <vertices> element and their positions.
struct Vertices {
    const Element* element;
    std::vector<Vec3> positions;
};

Vertices read_vertices(const Document& document, const Element& mesh)
{
    const Element& vertices = required_child(mesh, "vertices");
    check_children(vertices, {"input"});
    const Element& source = document.target(required_input(vertices, "POSITION"), "source", "source");
    return {&vertices, read_positions(document, source)};
}

void report(const polygons::PolygonFaults& faults, const Element& geometry,
            std::vector<std::string>& notices)
{
    const auto note = [&](std::size_t count, const char* what) {
        if (count > 0) notices.push_back(place(geometry) + std::to_string(count) + what);
    };
    note(faults.too_small, " polygon(s) with fewer than three corners: dropped");
    note(faults.zero_area, " triangle(s) of zero area: kept, but they neither stop a ray nor emit");
    note(faults.non_planar,
         " polygon(s) are not planar: cut into triangles as their projection on the mean plane");
    note(faults.small_holes, " hole(s) with fewer than three corners: dropped");
    note(faults.crossed,
         " polygon(s) cross themselves or their holes: cut into triangles around the first "
         "corner, which cover a different area");
}

Mesh read_mesh(const Document& document, const Element& mesh, polygons::PolygonFaults& faults,
               std::vector<std::string>& notices)
{
    check_children(mesh,
                   {"source", "vertices", "triangles", "polylist", "polygons", "lines", "linestrips"});
    const Vertices vertices = read_vertices(document, mesh);
    Mesh parts;
    for (const Element* e = mesh.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
        const std::string_view kind = e->Name();
        if (kind == "lines" || kind == "linestrips")
            notices.push_back(place(*e) + "ignored: lines have no area");
        if (kind != "triangles" && kind != "polylist" && kind != "polygons") continue;
        const polygons::Polygons faces = read_polygons(*e, vertices.positions.size());
        const Element& input = required_input(*e, "VERTEX");
        if (&document.target(input, "source", "vertices") != vertices.element)
            fail(input, "its source is the <vertices> of another mesh");
        polygons::triangulate(faces, vertices.positions, parts.emplace_back(Part{e, {}}).triangles,
                              faults);
        if (faults.too_large > 0)
            fail(*e, "a polygon that is not convex has more than " +
                         std::to_string(polygons::most_corners) + " corners");
    }
    return parts;
}

} // namespace

Geometry read_geometry(const Document& document, const Element& geometry,
                       std::vector<std::string>& notices)
{
    check_children(geometry, {"mesh"},
                   Cmu462::understood); // <convex_mesh> and <spline> are refused here
    if (const Element* technique = cmu462_technique(geometry)) return read_sphere(*technique);
    polygons::PolygonFaults faults;
    Mesh mesh = read_mesh(document, required_child(geometry, "mesh"), faults, notices);
    report(faults, geometry, notices);
    return mesh;
}

const Geometry& Geometries::get(const Element& geometry)
{
    const auto known = read_.find(&geometry);
    if (known != read_.end()) return known->second;
    return read_.emplace(&geometry, read_geometry(*document_, geometry, *notices_)).first->second;
}

} // namespace scenes::collada
