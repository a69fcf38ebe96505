#pragma once

// The names of the tree builders on the command line: those of the reference, and those of the fast
// path.

#include "cuda/trees/tree_builder.h"
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

/// All names of the reference, as the values that an option accepts.
inline std::vector<std::string> builder_names()
{
    std::vector<std::string> names;
    for (const NamedBuilder& named : builders) names.emplace_back(named.name);
    return names;
}

/// The default of `plumbline render` for the reference.
inline constexpr const char* default_builder = "sah-leaf";

/// The builder of that name. Throws std::invalid_argument for others.
inline ref::Builder builder_named(const std::string& name)
{
    for (const NamedBuilder& named : builders)
        if (name == named.name) return named.builder;
    throw std::invalid_argument("no builder is called " + name);
}

/// The names that the option accepts with `device`, "ref", "host" or "cuda".
inline std::vector<std::string> builder_names(const std::string& device)
{
    if (device == "ref") return builder_names();
    std::vector<std::string> names;
    for (const fast::TreeBuilder builder : fast::tree_builders) names.emplace_back(name_of(builder));
    names.emplace_back("hploc");
    return names;
}

/// The builder of the fast path of that name; the default for an empty name and for "hploc". Throws
/// std::invalid_argument for others.
inline fast::TreeBuilder fast_builder_named(const std::string& name)
{
    if (name.empty() || name == "hploc") return fast::default_tree_builder;
    for (const fast::TreeBuilder builder : fast::tree_builders)
        if (name == name_of(builder)) return builder;
    throw std::invalid_argument("no builder of the fast path is called " + name);
}

} // namespace cli
