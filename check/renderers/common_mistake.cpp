#include "check/renderers/common_mistake.h"

#include "check/renderers/common_cause.h"
#include "check/renderers/renderer_results.h"
#include "golden/explain.h"
#include "images/families.h"
#include "images/film.h"
#include "images/whole_number.h"
#include "scenes/read_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace check {

namespace {

constexpr std::size_t most_searched = 2; // scenes, among all usual mistakes

/// The options of the golden's render, with another seed; none if the mistakes are not defined for it.
std::optional<ref::PathOptions> options_of(const golden::Golden& golden)
{
    const auto entry = [&](const char* key) {
        const auto found = golden.metadata.find(key);
        return found == golden.metadata.end() ? std::string() : found->second;
    };
    const auto max_edges = images::whole_number(entry("max_edges"));
    const auto seed = images::whole_number(entry("seed"));
    if (entry("integrator") != "bdpt" || entry("camera") == "framed" || !seed || !max_edges ||
        *max_edges >= std::uint64_t{images::most_edges_of_strategies} ||
        golden.mean.pixels.size() > most_explained_pixels)
        return std::nullopt;
    ref::PathOptions options;
    options.seed = *seed + 1;
    options.max_edges = static_cast<int>(*max_edges);
    options.roulette = entry("roulette") != "off";
    return options;
}

/// How much a difference shows: in units of the error of the whole picture that would be found.
double shown_by(const SceneCheck& scene)
{
    const WholePicture whole = whole_picture(*scene.comparison());
    const double shown = std::abs(whole.ratio - 1.0) / whole.visible;
    return std::isfinite(shown) ? shown : 0.0;
}

/// The failing scenes of which mistakes can be rendered, those that show most first.
std::vector<SceneCheck*> explainable(RendererCheck& check)
{
    std::vector<SceneCheck*> scenes;
    for (SceneCheck& scene : check.scenes)
        if (scene.verdict() == SceneVerdict::fail && options_of(scene.golden()))
            scenes.push_back(&scene);
    std::ranges::stable_sort(scenes, std::ranges::greater(),
                             [](const SceneCheck* scene) { return shown_by(*scene); });
    return scenes;
}

/// What explains the pictures of a scene, among `only`, or all.
golden::FoundMistake mistake_of(const SceneCheck& scene, const MistakeSearch& search,
                                const std::optional<SomeMistakes>& only)
{
    const golden::Golden& golden = scene.golden();
    const scenes::Scene read = scenes::read_scene(scene.scene().scene);
    SceneExplanations explanations(read, golden.mean.width, golden.mean.height, *options_of(golden),
                                   search.threads, search.budget, only);
    if (explanations.empty()) return {};
    const std::vector<images::Image> pictures = scene.judged_pictures();
    images::Film film(golden.mean.width, golden.mean.height);
    for (const images::Image& picture : pictures) film.add_batch(picture);
    const auto more = [&]() -> std::vector<golden::Explanation> {
        const auto total = static_cast<double>(explanations.next_batches());
        const images::Monitor monitor{[&](double done) {
                                          if (search.progress) search.progress(scene, done, total);
                                      },
                                      search.stop};
        if (!explanations.render(monitor)) return {};
        return explanations.explanations(film.mean(), golden.mean);
    };
    golden::CompareOptions options;
    options.specification = scene.error();
    return golden::find_mistake(golden, pictures, static_cast<double>(scene.samples()), more, options);
}

/// A scene that has a diagnosis already, a factor, keeps it behind the mistake's.
void name_mistake(SceneCheck& scene, const std::string& sentence)
{
    scene.set_diagnosis(scene.diagnosis().empty() ? sentence : sentence + " Or: " + scene.diagnosis());
}

/// The sentence about `explained` of all scenes with a wrong picture.
std::string say_common(const golden::FoundMistake& mistake, const std::vector<std::string>& explained,
                       std::size_t wrong)
{
    const std::string of = std::to_string(wrong) + " scenes with a wrong picture";
    std::string text = "One mistake explains ";
    if (explained.size() == wrong)
        text += wrong == 2 ? "both scenes with a wrong picture" : "all " + of;
    else
        text += std::to_string(explained.size()) + " of the " + of + " (" +
                name_list(explained, " and ") + ")";
    return text + ": your picture is " + name_list(mistake.named, ", or ") + ".";
}

} // namespace

void find_common_mistake(RendererCheck& check, const MistakeSearch& search)
{
    const std::vector<SceneCheck*> scenes = explainable(check);
    if (scenes.empty() || (scenes.size() == 1 && !scenes.front()->diagnosis().empty())) return;
    golden::FoundMistake found;
    std::size_t first = 0;
    for (; first < std::min(most_searched, scenes.size()) && !search.stop(); ++first) {
        found = mistake_of(*scenes[first], search, std::nullopt);
        if (!found.named.empty()) break;
    }
    if (found.named.empty()) return;
    name_mistake(*scenes[first], found.sentence);
    std::vector<std::string> explained = {scenes[first]->scene().name};
    for (SceneCheck* scene : scenes) {
        if (scene == scenes[first]) continue;
        if (search.stop()) break;
        golden::FoundMistake again = mistake_of(
            *scene, search, found.fitted ? SomeMistakes{{}, true} : SomeMistakes{found.named, false});
        if (again.named.empty()) continue;
        name_mistake(*scene, again.sentence);
        explained.push_back(scene->scene().name);
        if (!found.fitted) found.named = std::move(again.named);
    }
    const std::size_t wrong = count(check, SceneVerdict::fail);
    if (wrong > 1 && explained.size() > 1) check.mistake = say_common(found, explained, wrong);
}

} // namespace check
