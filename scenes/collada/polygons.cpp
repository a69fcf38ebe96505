#include "scenes/collada/polygons.h"

#include "scenes/collada/numbers.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>

namespace scenes::collada {
namespace {

/// Each corner of a polygon has `stride` indices, of which the one at `vertex` is that of its vertex.
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

Polygons read_polygons(const Element& element, std::uint64_t vertex_count)
{
    const std::string_view kind = element.Name();
    if (kind == "polylist")
        check_children(element, {"input", "vcount", "p"});
    else
        check_children(element, {"input", "p"}); // <ph>, a polygon with holes, is refused here
    const std::uint32_t count = count_attribute(element, "count");
    const IndexLayout layout = read_layout(element);

    Polygons polygons;
    std::vector<std::uint32_t> sizes_of_p;
    for (const Element* p = element.FirstChildElement("p"); p != nullptr; p = p->NextSiblingElement("p"))
        sizes_of_p.push_back(append_corners(*p, layout, vertex_count, polygons.corners));
    const std::uint64_t corners = polygons.corners.size();

    if (kind == "polygons") {
        polygons.sizes = std::move(sizes_of_p); // one <p> for each
    } else {
        optional_child(element, "p"); // not more than one
        if (kind == "polylist") {
            if (const Element* vcount = optional_child(element, "vcount"))
                polygons.sizes = indices(*vcount);
        } else {
            if (corners % 3 != 0)
                fail(element, std::to_string(corners) + " corners do not make triangles");
            polygons.sizes.assign(corners / 3, 3);
        }
    }
    if (polygons.sizes.size() != count)
        fail(element, "count is " + std::to_string(count) + ", but it holds " +
                          std::to_string(polygons.sizes.size()) + " polygons");
    if (const auto needed =
            std::accumulate(polygons.sizes.begin(), polygons.sizes.end(), std::uint64_t{0});
        needed != corners)
        fail(element, "<vcount> asks for " + std::to_string(needed) + " corners, but <p> lists " +
                          std::to_string(corners));
    return polygons;
}

} // namespace scenes::collada
