#include "check/renderers/check_renderer.h"

#include "check/renderers/common_cause.h"
#include "check/renderers/common_mistake.h"
#include "check/renderers/render_picture.h"
#include "check/renderers/seeds.h"
#include "check/shell_line.h"
#include "images/image_error.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>

namespace check {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

/// The check while it runs.
class Rounds {
public:
    Rounds(const RendererOptions& options, const PictureFolder& folder, RendererCheck& check)
        : options_(options), folder_(folder), check_(check)
    {}

    [[nodiscard]] double seconds() const
    {
        return std::chrono::duration<double>(Clock::now() - begin_).count();
    }

    /// Whether the check goes on.
    bool goes_on()
    {
        check_.stopped = check_.stopped || options_.stop();
        check_.time_up = check_.time_up || seconds() >= options_.budget;
        return !check_.stopped && !check_.time_up;
    }

    /// Gives the scene the pictures that it wants, and judges it.
    void play(SceneCheck& scene)
    {
        while (!scene.missing() && scene.pictures().size() < scene.wanted() && goes_on()) {
            if (options_.progress) options_.progress(scene, scene.pictures().size(), scene.wanted());
            const std::uint64_t number = scene.pictures().size() + 1;
            if (!take_kept(scene, number)) render(scene, number);
        }
        scene.judge();
    }

    /// In what is left of the budget.
    void find_mistake()
    {
        MistakeSearch search;
        search.threads = options_.threads;
        search.stop = [&] { return options_.stop() || seconds() >= options_.budget; }; // by any thread
        search.progress = options_.mistakes_progress;
        search.budget = options_.mistakes_budget;
        find_common_mistake(check_, search);
        check_.stopped = check_.stopped || options_.stop();
    }

private:
    [[nodiscard]] PictureTask task_of(const SceneCheck& scene, std::uint64_t number) const
    {
        return {scene.scene().scene,
                scene.golden().mean.width,
                scene.golden().mean.height,
                options_.samples,
                seed_of(options_.series, number),
                scene.golden().metadata.at("max_edges"),
                folder_.unfinished(scene.scene().name, number, options_.ending)};
    }

    /// Takes the picture of an earlier run. A file that cannot be read, because a disk was full, is
    /// rendered again.
    bool take_kept(SceneCheck& scene, std::uint64_t number)
    {
        const fs::path place = folder_.place(scene.scene().name, number, options_.ending);
        if (!folder_.is_kept() || !fs::exists(place)) return false;
        try {
            scene.add(read_candidate(place, scene.golden().mean.width, scene.golden().mean.height), 0.0,
                      true);
            return true;
        } catch (const images::ImageError&) {
            return false;
        }
    }

    void render(SceneCheck& scene, std::uint64_t number)
    {
        const PictureTask task = task_of(scene, number);
        const double left = options_.budget - seconds();
        PictureAttempt attempt =
            render_picture(options_.command, task, std::min(options_.time_limit, left), options_.stop);
        if (attempt.picture) {
            if (folder_.is_kept())
                fs::rename(task.out, folder_.place(scene.scene().name, number, options_.ending));
            else
                fs::remove(task.out);
            scene.add(std::move(*attempt.picture), attempt.seconds, false);
            return;
        }
        // Stopped, or killed at the end of the budget: that is not the renderer's mistake.
        if (attempt.failure.empty() || (attempt.seconds >= left && left < options_.time_limit)) {
            check_.stopped = check_.stopped || attempt.failure.empty();
            check_.time_up = check_.time_up || !attempt.failure.empty();
            return;
        }
        PictureTask again = task;
        again.out = "picture" + options_.ending;
        scene.add_missing(
            {attempt.failure, attempt.last_lines, shell_line(words_for(options_.command, again))});
    }

    const RendererOptions& options_;
    const PictureFolder& folder_;
    RendererCheck& check_;
    Clock::time_point begin_ = Clock::now();
};

bool mentions(const std::vector<std::string>& command, const std::string& placeholder)
{
    return std::ranges::any_of(
        command, [&](const std::string& word) { return word.find(placeholder) != std::string::npos; });
}

bool failed(SceneVerdict verdict)
{
    return verdict == SceneVerdict::fail || verdict == SceneVerdict::no_picture;
}

/// The causes of those scenes that have one of the verdicts `failing`, beside those that pass.
std::vector<std::string> causes_of(const RendererCheck& check, const std::vector<SceneVerdict>& failing)
{
    std::vector<Judged> judged;
    for (const SceneCheck& scene : check.scenes) {
        const bool fails = std::ranges::find(failing, scene.verdict()) != failing.end();
        if (fails || scene.verdict() == SceneVerdict::pass)
            judged.push_back({scene.scene().features, fails});
    }
    return common_causes(judged);
}

/// The diagnosis of all failing scenes, two at least; empty if they differ.
std::string common_diagnosis(const RendererCheck& check)
{
    std::optional<std::string> same;
    std::size_t scenes = 0;
    for (const SceneCheck& scene : check.scenes) {
        if (!failed(scene.verdict())) continue;
        if (same && *same != scene.diagnosis()) return "";
        same = scene.diagnosis();
        ++scenes;
    }
    return scenes < 2 || same->empty()
               ? ""
               : "All " + std::to_string(scenes) + " failing scenes have one diagnosis. " + *same;
}

} // namespace

RendererCheck check_renderer(const std::vector<SuiteScene>& scenes, const RendererOptions& options,
                             const PictureFolder& folder)
{
    const JudgeOptions judge{options.samples, mentions(options.command, "{max_edges}"), options.error,
                             std::min(options.first_pictures, options.most_pictures),
                             options.most_pictures};
    RendererCheck check;
    Rounds rounds(options, folder, check);
    for (const SuiteScene& scene : scenes) check.scenes.emplace_back(scene, judge);
    // A round for each scene that is not decided, and so on until there is none.
    for (bool any = true; any && rounds.goes_on();) {
        any = false;
        for (SceneCheck& scene : check.scenes) {
            if (scene.decided() || !rounds.goes_on()) continue;
            rounds.play(scene);
            any = true;
        }
    }
    for (SceneCheck& scene : check.scenes) scene.finish();
    if (options.mistakes && common_diagnosis(check).empty()) rounds.find_mistake();
    check.seconds = rounds.seconds();
    return check;
}

std::vector<std::string> in_common(const RendererCheck& check)
{
    std::vector<std::string> sentences;
    if (!check.mistake.empty())
        sentences.push_back(check.mistake);
    else if (std::string diagnosis = common_diagnosis(check); !diagnosis.empty())
        sentences.push_back(std::move(diagnosis));
    std::vector<std::string> causes = causes_of(check, {SceneVerdict::fail, SceneVerdict::no_picture});
    // Two mistakes at once: a crash in some scenes, and wrong pictures of others.
    const bool both = count(check, SceneVerdict::fail) > 0 && count(check, SceneVerdict::no_picture) > 0;
    if (causes.empty() && both) {
        for (const std::string& cause : causes_of(check, {SceneVerdict::fail}))
            causes.push_back("Of those with a wrong picture: " + cause);
        for (const std::string& cause : causes_of(check, {SceneVerdict::no_picture}))
            causes.push_back("Of those without a picture: " + cause);
    }
    sentences.insert(sentences.end(), causes.begin(), causes.end());
    return sentences;
}

std::size_t count(const RendererCheck& check, SceneVerdict verdict)
{
    return static_cast<std::size_t>(std::ranges::count_if(
        check.scenes, [&](const SceneCheck& scene) { return scene.verdict() == verdict; }));
}

} // namespace check
