#include "scenes/collada/polygons.h"

#include "scenes/collada/numbers.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>

namespace scenes::collada {
namespace {

/// Each corner of a polygon has `stride` indices; that at position `vertex` is the index of its vertex.
struct IndexLayout {
    std::uint32_t stride;
    std::uint32_t vertex;
};

IndexLayout read_layout(const Element& element)
{
    constexpr std::uint32_t most = 1000; // keeps corners * stride far from wrapping around
    IndexLayout layout{0, count_attribute(required_input(element, "VERTEX"), "offset")};
    for (const Element* input : children(element, "input")) {
        const std::uint32_t offset = count_attribute(*input, "offset");
        if (offset >= most)
            fail(*input, "offset " + std::to_string(offset) + " is not below " + std::to_string(most));
        layout.stride = std::max(layout.stride, offset + 1);
    }
    return layout;
}

/// Appends the vertex of each corner that <p> lists; returns the number of corners.
std::uint32_t append_corners(const Element& p, const IndexLayout& layout, std::uint64_t vertex_count,
                             std::vector<std::uint32_t>& corners)
{
    const std::vector<std::uint32_t> list = indices(p);
    if (list.size() % layout.stride != 0)
        fail(p, std::to_string(list.size()) + " indices are no multiple of the " +
                    std::to_string(layout.stride) + " that each corner takes");
    for (std::size_t i = layout.vertex; i < list.size(); i += layout.stride) {
        if (list[i] >= vertex_count)
            fail(p, "vertex index " + std::to_string(list[i]) + " is out of range: there are " +
                        std::to_string(vertex_count) + " vertices");
        corners.push_back(list[i]);
    }
    return static_cast<std::uint32_t>(list.size() / layout.stride);
}

void check_count(const Element& element, std::size_t found)
{
    const std::uint32_t count = count_attribute(element, "count");
    if (found != count)
        fail(element, "count is " + std::to_string(count) + ", but it holds " + std::to_string(found) +
                          " polygons");
}

/// <polygons>: each is a <p>, or a <ph> with its outline as <p> and its holes as <h>.
polygons::Polygons read_each_polygon(const Element& element, std::uint64_t vertex_count)
{
    check_children(element, {"input", "p", "ph"});
    const IndexLayout layout = read_layout(element);
    polygons::Polygons faces;
    const auto append_ring = [&](const Element& ring) {
        faces.sizes.push_back(append_corners(ring, layout, vertex_count, faces.corners));
        ++faces.rings.back();
    };
    for (const Element* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
        const std::string_view kind = e->Name();
        if (kind != "p" && kind != "ph") continue;
        faces.rings.push_back(0);
        if (kind == "p") {
            append_ring(*e);
            continue;
        }
        check_children(*e, {"p", "h"});
        append_ring(required_child(*e, "p"));
        for (const Element* hole : children(*e, "h")) append_ring(*hole);
    }
    check_count(element, faces.rings.size());
    return faces;
}

} // namespace

const Element& required_input(const Element& element, const char* semantic)
{
    const Element* found = nullptr;
    for (const Element* input : children(element, "input")) {
        if (required_attribute(*input, "semantic") != semantic) continue;
        if (found != nullptr) fail(*input, "a second one of that semantic");
        found = input;
    }
    if (found == nullptr) fail(element, "no <input semantic=\"" + std::string(semantic) + "\"> in it");
    return *found;
}

polygons::Polygons read_polygons(const Element& element, std::uint64_t vertex_count)
{
    const std::string_view kind = element.Name();
    if (kind == "polylist")
        check_children(element, {"input", "vcount", "p"});
    else if (kind == "triangles")
        check_children(element, {"input", "p"});
    else
        return read_each_polygon(element, vertex_count);
    const IndexLayout layout = read_layout(element);
    polygons::Polygons faces;
    if (const Element* p = optional_child(element, "p"))
        append_corners(*p, layout, vertex_count, faces.corners);
    const std::uint64_t corners = faces.corners.size();

    if (kind == "polylist") {
        if (const Element* vcount = optional_child(element, "vcount")) faces.sizes = indices(*vcount);
    } else {
        if (corners % 3 != 0) fail(element, std::to_string(corners) + " corners do not make triangles");
        faces.sizes.assign(corners / 3, 3);
    }
    check_count(element, faces.sizes.size());
    if (const auto needed = std::accumulate(faces.sizes.begin(), faces.sizes.end(), std::uint64_t{0});
        needed != corners)
        fail(element, "<vcount> asks for " + std::to_string(needed) + " corners, but <p> lists " +
                          std::to_string(corners));
    return faces;
}

} // namespace scenes::collada
