#pragma once

// What failing scenes have in common that passing ones do not have.

#include <set>
#include <string>
#include <vector>

namespace check {

/// A scene with a verdict: it failed, or it passed.
struct Judged {
    std::set<std::string> features; // by the names of features.h
    bool failed;
};

/// Sentences about the features of the failing scenes, the first that hold of
///
/// - the failing scenes are exactly those with one feature: "All 7 scenes with glass fail, and the 15
///   others pass." Features that the same scenes have are named together. It takes four scenes;
/// - they are exactly those with two features together;
/// - all of them have one feature, which passing scenes have as well.
///
/// The last two are said if they would hold by chance, for as many failing scenes drawn at random, in at
/// most 1 of 100 cases, all sets of scenes that are tried together. Empty if nothing holds.
std::vector<std::string> common_causes(const std::vector<Judged>& scenes);

/// "a, b or c", with " or " for `last`, which stands before the last name.
std::string name_list(const std::vector<std::string>& names, const char* last);

} // namespace check
