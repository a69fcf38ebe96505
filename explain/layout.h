#pragma once

// How samples are laid out as text. Only for text.cpp and fast_text.cpp.

#include "explain/names.h"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace explain {

/// `text` with spaces up to the width; one space if it is longer.
inline std::string padded(std::string text, std::size_t width)
{
    text.append(text.size() < width ? width - text.size() : 1, ' ');
    return text;
}

/// The number and the noun.
inline std::string plural(std::size_t count, const std::string& what_one, const std::string& what_many)
{
    return std::to_string(count) + " " + (count == 1 ? what_one : what_many);
}

/// A line without spaces at its end.
inline std::string trimmed(std::string line)
{
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

/// Four digits, for tables.
inline std::string short_number(double x)
{
    std::array<char, 32> text{};
    (void)std::snprintf(text.data(), text.size(), "%.4g", x);
    return text.data();
}

inline std::string short_numbers(const Vec3& v)
{
    return short_number(v.x) + " " + short_number(v.y) + " " + short_number(v.z);
}

/// A row of a table. The last cells may be longer than their columns.
inline std::string row(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths)
{
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
        line += i < widths.size() ? padded(cells[i], widths[i]) : cells[i];
    return trimmed(line);
}

/// Scene, sample and options.
inline std::string heading(const ref::World& world, const Sample& sample)
{
    const int width = world.camera.width();
    const ref::PathOptions& options = sample.options;
    std::string text = world.scene.name + ", " + std::to_string(width) + " x " +
                       std::to_string(world.camera.height()) + " pixels: pixel " +
                       pixel_name(sample.id.pixel, width) + ", sample " +
                       std::to_string(sample.id.sample) + ", seed " + std::to_string(options.seed) +
                       "\nIntegrator " + std::string(name_of(sample.integrator));
    if (sample.integrator == images::Integrator::bdpt)
        text += ", heuristic " + std::string(name_of(options.heuristic));
    if (options.max_edges != images::unlimited_edges)
        text +=
            ", paths of at most " + plural(static_cast<std::size_t>(options.max_edges), "edge", "edges");
    text += options.roulette ? ", roulette from bounce " + std::to_string(options.roulette_from)
                             : std::string(", no roulette");
    if (world.scene.unit != 1.0)
        text += "\nThe unit of length is " + number(1.0 / world.scene.unit) + " units of the scene file";
    return text + "\n";
}

} // namespace explain
