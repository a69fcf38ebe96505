#pragma once

// The names of the tree builders on the command line.

#include "ref/trees/bvh.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace cli {

struct NamedBuilder {
    const char* name;
    ref::Builder builder;
};

inline constexpr std::array builders = {
    NamedBuilder{"morton30", ref::Builder::morton30}, NamedBuilder{"morton63", ref::Builder::morton63},
    NamedBuilder{"sah", ref::Builder::sah}, NamedBuilder{"sah-leaf", ref::Builder::sah_leaf}};

/// All names, as the values that an option accepts.
inline std::vector<std::string> builder_names()
{
    std::vector<std::string> names;
    for (const NamedBuilder& named : builders) names.emplace_back(named.name);
    return names;
}

/// The builder of that name. Throws std::invalid_argument for others.
inline ref::Builder builder_named(const std::string& name)
{
    for (const NamedBuilder& named : builders)
        if (name == named.name) return named.builder;
    throw std::invalid_argument("no builder is called " + name);
}

} // namespace cli
