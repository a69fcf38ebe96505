#include "check/renderers/suite.h"

#include "check/renderers/features.h"
#include "scenes/read_scene.h"
#include "scenes/requirements.h"

#include <algorithm>
#include <stdexcept>

namespace check {

namespace fs = std::filesystem;

namespace {

const fs::path goldens_within = fs::path("golden") / "renders";

bool is_suite(const fs::path& folder)
{
    return fs::is_directory(folder / "scenes") && fs::is_directory(folder / goldens_within);
}

/// The names of all goldens, sorted.
std::vector<std::string> golden_names(const fs::path& suite)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(suite / goldens_within))
        if (entry.path().extension() == ".exr") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name)
{
    return std::ranges::find(names, name) != names.end();
}

/// Throws unless all of `without` are scenes or features.
void expect_known(const std::vector<std::string>& without, const std::vector<std::string>& scenes)
{
    const std::vector<Feature> features = all_features();
    for (const std::string& name : without)
        if (!contains(scenes, name) &&
            std::ranges::find(features, name, &Feature::name) == features.end())
            throw std::invalid_argument("--without " + name +
                                        ": no such feature or scene (--list lists them)");
}

SuiteScene read_suite_scene(const fs::path& suite, const std::string& name)
{
    SuiteScene result;
    result.name = name;
    result.scene = suite / "scenes" / (name + ".dae");
    result.golden = suite / goldens_within / (name + ".exr");
    const scenes::Scene scene = scenes::read_scene(result.scene);
    result.features = feature_names(scenes::requirements(scene));
    result.hash = scene.hash;
    return result;
}

} // namespace

fs::path find_suite(const std::string& named, const fs::path& program)
{
    if (!named.empty()) {
        if (!is_suite(named))
            throw std::invalid_argument("--suite " + named +
                                        ": has no folders scenes/ and golden/renders/");
        return fs::canonical(named);
    }
    if (is_suite(fs::current_path())) return fs::current_path();
    for (fs::path folder = program.parent_path(); folder.has_relative_path();
         folder = folder.parent_path())
        for (const fs::path& suite : {folder, folder / "share" / "plumbline"}) // built, and installed
            if (is_suite(suite)) return suite;
    throw std::invalid_argument(
        "neither this folder nor one above the program has scenes/ and golden/renders/: name one by "
        "--suite");
}

std::vector<SuiteScene> chosen_scenes(const fs::path& suite, const std::vector<std::string>& names,
                                      const std::vector<std::string>& without)
{
    const std::vector<std::string> known = golden_names(suite);
    for (const std::string& name : names)
        if (!contains(known, name))
            throw std::invalid_argument("--scenes " + name + ": no such golden (--list lists them)");
    expect_known(without, known);
    std::vector<SuiteScene> chosen;
    for (const std::string& name : known) {
        if ((!names.empty() && !contains(names, name)) || contains(without, name)) continue;
        SuiteScene scene = read_suite_scene(suite, name);
        const bool claimed = std::ranges::none_of(
            without, [&](const std::string& feature) { return scene.features.contains(feature); });
        if (claimed) chosen.push_back(std::move(scene));
    }
    if (chosen.empty()) throw std::invalid_argument("--without leaves no scene to render");
    return chosen;
}

} // namespace check
