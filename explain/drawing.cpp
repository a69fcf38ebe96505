#include "explain/drawing.h"

#include "explain/names.h"
#include "explain/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace explain {

namespace {

using Kind = ref::Vertex::Kind;

constexpr double panel_height = 300.0;
constexpr double gap = 16.0;
constexpr double title_height = 22.0;
constexpr std::size_t most_triangles = 4000; // more make the picture slow and black

/// Okabe and Ito's colours, which differ for the colour-blind.
constexpr const char* style =
    "<style>.scene{stroke:#b9bec7;stroke-width:.6;fill:none}"
    ".eye{stroke:#0072b2;stroke-width:2.2;fill:none}.light{stroke:#d55e00;stroke-width:2.2;fill:none}"
    ".join{stroke:#009e73;stroke-width:1.2;fill:none}"
    ".blocked{stroke:#a3326b;stroke-width:1.2;stroke-dasharray:2 4;fill:none}"
    ".path{stroke:#000;stroke-width:3.2;fill:none;stroke-linejoin:round}"
    "text{font:13px sans-serif;fill:#1d2129}"
    "text.vertex{font-size:16px;paint-order:stroke;stroke:#fff;stroke-width:3px}"
    "</style>\n";

std::string coordinate(double x)
{
    // A line that leaves the panel is cut there by the viewer; far beyond, numbers lose their digits.
    std::array<char, 32> text{};
    (void)std::snprintf(text.data(), text.size(), "%.2f", std::clamp(x, -1e5, 1e5));
    return text.data();
}

/// Where a vertex is drawn: one at infinity a diagonal away from its neighbour on the path.
Vec3 place_of(const ref::World& world, const ref::Vertex& vertex, const ref::Vertex& neighbour)
{
    if (vertex.kind != Kind::infinity) return vertex.point.position;
    return neighbour.point.position + world.geometry.diagonal() * vertex.towards;
}

/// The vertices of a walk or of a path, as points.
std::vector<Vec3> points_of(const ref::World& world, const std::vector<ref::Vertex>& vertices)
{
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (vertices.size() == 1 && vertices[i].kind == Kind::infinity) break;
        const bool last = i + 1 == vertices.size();
        points.push_back(place_of(world, vertices[i], vertices[last ? i - (i > 0) : i + 1]));
    }
    return points;
}

std::vector<ref::Vertex> vertices_of_steps(const Walk& walk)
{
    std::vector<ref::Vertex> vertices;
    for (const Step& step : walk.steps) vertices.push_back(step.vertex);
    return vertices;
}

/// One panel, as an SVG element.
class Panel {
public:
    Panel(const ref::World& world, const View& view) : world_(world), view_(view) {}

    void add_scene()
    {
        text_ += "<path class='scene' d='";
        const auto& triangles = world_.scene.triangles;
        const std::size_t every = triangles.size() / most_triangles + 1;
        for (std::size_t i = 0; i < triangles.size(); i += every)
            for (std::size_t edge = 0; edge < 3; ++edge)
                add_segment(triangles[i].vertices[edge], triangles[i].vertices[(edge + 1) % 3]);
        for (const scenes::Sphere& sphere : world_.scene.spheres) {
            const auto outline = view_.outline(sphere.center, sphere.radius);
            for (std::size_t i = 0; i < outline.size(); ++i)
                text_ +=
                    (i == 0 ? "M" : "L") + coordinate(outline[i].x) + " " + coordinate(outline[i].y);
            if (!outline.empty()) text_ += "Z";
        }
        text_ += "'/>\n";
    }

    void add_polyline(const std::string& attributes, const std::vector<Vec3>& points)
    {
        text_ += "<path " + attributes + " d='";
        for (std::size_t i = 0; i + 1 < points.size(); ++i) add_segment(points[i], points[i + 1]);
        text_ += "'/>\n";
    }

    void add_vertices(const std::vector<Vec3>& points, char letter, const char* color)
    {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto line = view_.line(points[i], points[i]);
            if (!line) continue; // behind the camera
            const std::string x = coordinate(line->first.x);
            const std::string y = coordinate(line->first.y);
            text_ += "<circle cx='" + x + "' cy='" + y + "' r='3.2' fill='" + color + "'/>\n";
            const glm::dvec2 name = place_of_name(line->first);
            text_ += "<text class='vertex' x='" + coordinate(name.x) + "' y='" + coordinate(name.y) +
                     "'>" + letter + "<tspan dy='4' font-size='12'>" + std::to_string(i) +
                     "</tspan></text>\n";
        }
    }

    [[nodiscard]] std::string element(double x, double y) const
    {
        return "<text x='" + coordinate(x) + "' y='" + coordinate(y - 7.0) + "'>" + view_.title +
               "</text>\n<svg x='" + coordinate(x) + "' y='" + coordinate(y) + "' width='" +
               coordinate(view_.width) + "' height='" + coordinate(view_.height) +
               "'>\n<rect width='100%' height='100%' fill='#fff' stroke='#d9dce1'/>\n" + text_ +
               "</svg>\n";
    }

private:
    void add_segment(const Vec3& a, const Vec3& b)
    {
        if (const auto line = view_.line(a, b))
            text_ += "M" + coordinate(line->first.x) + " " + coordinate(line->first.y) + "L" +
                     coordinate(line->second.x) + " " + coordinate(line->second.y);
    }

    /// The left end of the base line of the name of the vertex at `at`: the first place around it where
    /// the name is inside the panel and on no other name, or else the first of all.
    glm::dvec2 place_of_name(const glm::dvec2& at)
    {
        constexpr double width = 18.0; // of a name, and its height
        constexpr double height = 16.0;
        // Beside the vertex, and a line further up or down.
        constexpr std::array<glm::dvec2, 12> places = {{{6.0, -6.0},
                                                        {6.0, 16.0},
                                                        {-22.0, -6.0},
                                                        {-22.0, 16.0},
                                                        {14.0, 5.0},
                                                        {-30.0, 5.0},
                                                        {6.0, -23.0},
                                                        {6.0, 33.0},
                                                        {-22.0, -23.0},
                                                        {-22.0, 33.0},
                                                        {25.0, -6.0},
                                                        {25.0, 16.0}}};
        glm::dvec2 chosen = at + places[0];
        for (const glm::dvec2& place : places) {
            const glm::dvec2 name = at + place;
            const bool inside = name.x >= 0.0 && name.x + width <= view_.width && name.y >= height &&
                                name.y + 4.0 <= view_.height;
            const bool is_free = std::ranges::none_of(names_, [&](const glm::dvec2& other) {
                return std::abs(other.x - name.x) < width && std::abs(other.y - name.y) < height;
            });
            if (!inside || !is_free) continue;
            chosen = name;
            break;
        }
        names_.push_back(chosen);
        return chosen;
    }

    const ref::World& world_;
    const View& view_;
    std::string text_;
    std::vector<glm::dvec2> names_; // of vertices: where they are
};

bool is_whole(const Strategy& strategy)
{
    return static_cast<int>(strategy.path.size()) == strategy.s + strategy.t;
}

/// Adds the sample to the panel.
void add_sample(Panel& panel, const ref::World& world, const Sample& sample, Paths paths)
{
    panel.add_scene();
    for (const Strategy& strategy : sample.strategies) {
        const bool blocked = strategy.blocker.has_value() || strategy.obstacle == Obstacle::in_plane;
        if (strategy.s == 0 || !is_whole(strategy) || !(strategy.made || blocked)) continue;
        const std::vector<Vec3> all = points_of(world, strategy.path);
        const auto s = static_cast<std::size_t>(strategy.s);
        panel.add_polyline(blocked ? "class='blocked'" : "class='join'", {all[s - 1], all[s]});
    }
    const std::vector<Vec3> eye = points_of(world, vertices_of_steps(sample.eye));
    const std::vector<Vec3> light = points_of(world, vertices_of_steps(sample.light));
    panel.add_polyline("class='light'", light);
    panel.add_polyline("class='eye'", eye);
    for (const Strategy& strategy : sample.strategies)
        if (paths == Paths::hidden && is_whole(strategy))
            panel.add_polyline("class='path' style='display:none' data-strategy='" +
                                   std::to_string(strategy.s) + "," + std::to_string(strategy.t) + "'",
                               points_of(world, strategy.path));
    panel.add_vertices(light, 'y', "#d55e00");
    panel.add_vertices(eye, 'z', "#0072b2");
}

std::string legend(double y)
{
    struct Entry {
        const char* style;
        const char* text;
    };
    constexpr std::array<Entry, 4> entries = {{{"eye", "eye walk"},
                                               {"light", "light walk"},
                                               {"join", "joined by a strategy"},
                                               {"blocked", "blocked"}}};
    std::string text;
    double x = gap;
    for (const Entry& entry : entries) {
        text += std::string("<path class='") + entry.style + "' d='M" + coordinate(x) + " " +
                coordinate(y - 4.0) + "h28'/><text x='" + coordinate(x + 34.0) + "' y='" +
                coordinate(y) + "'>" + entry.text + "</text>\n";
        x += 190.0;
    }
    return text;
}

} // namespace

std::string drawing(const ref::World& world, const Sample& sample, Paths paths)
{
    std::vector<Vec3> points = points_of(world, vertices_of_steps(sample.eye));
    for (const Vec3& p : points_of(world, vertices_of_steps(sample.light))) points.push_back(p);
    std::vector<View> views = {camera_view(world, panel_height)};
    for (const View& view : parallel_views(world, points, panel_height)) views.push_back(view);
    std::string panels;
    double x = gap;
    for (const View& view : views) {
        Panel panel(world, view);
        add_sample(panel, world, sample, paths);
        panels += panel.element(x, title_height);
        x += view.width + gap;
    }
    const double width = std::max(x, 4 * 190.0);
    const double height = title_height + panel_height + 30.0;
    return "<svg xmlns='http://www.w3.org/2000/svg' width='" + coordinate(width) + "' height='" +
           coordinate(height) + "' viewBox='0 0 " + coordinate(width) + " " + coordinate(height) +
           "'>\n" + style + "<rect width='100%' height='100%' fill='#fff'/>\n" + panels +
           legend(height - 10.0) + "</svg>\n";
}

} // namespace explain
