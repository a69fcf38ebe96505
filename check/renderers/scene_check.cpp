#include "check/renderers/scene_check.h"

#include "golden/compare.h"
#include "golden/diagnosis.h"
#include "golden/independence.h"
#include "golden/reason.h"
#include "images/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace check {

namespace {

/// A mistake that a diagnosis names changes a picture by more than this, and fewer samples show that a
/// picture is right but for such a mistake.
constexpr double error_of_diagnosis = 0.05;

/// Where the golden's own noise hides the error, PASS takes this times what it hides: then four
/// ninths of the variance of the difference are left to the pictures.
constexpr double beyond_golden_noise = 1.34;

double largest(const std::array<double, golden::channel_count>& errors)
{
    double result = 0.0;
    for (const double error : errors) result = std::fmax(result, error); // ignores NaN: black channels
    return result;
}

images::Image mean_of(const std::vector<images::Image>& pictures)
{
    images::Film film(pictures.front().width, pictures.front().height);
    for (const images::Image& picture : pictures) film.add_batch(picture);
    return film.mean();
}

} // namespace

std::string describe(SceneVerdict verdict)
{
    switch (verdict) {
    case SceneVerdict::pass:
        return "PASS";
    case SceneVerdict::fail:
        return "FAIL";
    case SceneVerdict::inconclusive:
        return "INCONCLUSIVE";
    case SceneVerdict::no_picture:
        return "NO PICTURE";
    }
    throw std::logic_error("no such verdict");
}

SceneCheck::SceneCheck(SuiteScene scene, const JudgeOptions& options)
    : scene_(std::move(scene)), options_(options), golden_(golden::read_golden(scene_.golden)),
      error_(options.error), wanted_(options.first)
{
    const auto entry = [&](const char* key) {
        const auto found = golden_.metadata.find(key);
        if (found == golden_.metadata.end())
            throw std::invalid_argument(scene_.golden.string() + ": does not state its " + key);
        return found->second;
    };
    if (entry("scene_hash") != scene_.hash)
        throw std::invalid_argument(scene_.golden.string() + ": is a golden of another version of " +
                                    scene_.scene.string());
    entry("max_edges");
}

void SceneCheck::add(images::Image picture, double seconds, bool from_earlier_run)
{
    pictures_.push_back(std::move(picture));
    seconds_ += seconds;
    if (from_earlier_run) ++from_earlier_run_;
}

void SceneCheck::add_missing(Missing missing)
{
    missing_ = std::move(missing);
    wanted_ = pictures_.size();
}

golden::Comparison SceneCheck::judged(const std::vector<images::Image>& pictures, double error) const
{
    golden::CompareOptions options;
    options.specification = error;
    options.picture_samples = static_cast<double>(options_.samples);
    return pictures.size() == 1 ? golden::compare_picture(golden_, pictures.front(),
                                                          static_cast<double>(options_.samples), options)
                                : golden::compare_pictures(golden_, pictures, options);
}

void SceneCheck::judge()
{
    if (missing_ || pictures_.size() < 2 || judged_ == pictures_.size()) return;
    judged_ = pictures_.size();
    if (const auto shared = golden::shared_noise(golden_, pictures_)) {
        judge_dependent("pictures " + std::to_string(shared->first + 1) + " and " +
                        std::to_string(shared->second + 1) + " " + shared->why);
        return;
    }
    comparison_ = judged(pictures_, error_);
    const double hidden = largest(comparison_->golden_limit);
    if (std::isfinite(hidden) && beyond_golden_noise * hidden > error_) {
        error_ = beyond_golden_noise * hidden;
        comparison_ = judged(pictures_, error_);
    }
    false_alarm_ += comparison_->false_alarm;
    wanted_ = next();
}

void SceneCheck::finish()
{
    judge();
    if (comparison_ && !finished_) diagnose();
    finished_ = true;
}

/// A renderer without a seed, or that ignores it, makes one picture, which is judged as such.
void SceneCheck::judge_dependent(const std::string& why)
{
    dependent_ = why;
    wanted_ = pictures_.size();
    try {
        comparison_ = judged({pictures_.front()}, error_);
        false_alarm_ += comparison_->false_alarm;
    } catch (const std::invalid_argument& error) {
        comparison_.reset(); // the picture has the golden's own noise
        dependent_ += std::string("; the first ") + error.what();
    }
}

void SceneCheck::diagnose()
{
    const std::vector<images::Image> of = judged_pictures();
    for (const double error : {error_, error_of_diagnosis}) {
        const auto compared = [&](const std::vector<images::Image>& undone) {
            return judged(undone, error);
        };
        diagnosis_ =
            golden::diagnose(golden_, *comparison_, of, static_cast<double>(options_.samples), compared);
        if (!diagnosis_.empty()) break;
    }
    say_causes();
}

void SceneCheck::say_causes()
{
    comparison_->diagnosis = diagnosis_;
    images::Metadata known;
    if (options_.limits_edges) known["max_edges"] = golden_.metadata.at("max_edges");
    causes_ = golden::say_possible_causes(*comparison_, golden_, known, mean_of(judged_pictures()));
}

void SceneCheck::set_diagnosis(const std::string& sentence)
{
    diagnosis_ = sentence;
    say_causes();
}

std::vector<images::Image> SceneCheck::judged_pictures() const
{
    if (dependent_.empty()) return pictures_;
    return {pictures_.front()};
}

std::uint64_t SceneCheck::next() const
{
    const std::uint64_t now = pictures_.size();
    if (comparison_->verdict != golden::Verdict::inconclusive) return now;
    std::uint64_t more = 2 * now;
    if (const auto& shortfall = comparison_->shortfall) {
        if (std::isinf(shortfall->candidate)) return now; // no number of pictures is enough
        // The estimate is rough: a tenth more than it, and at least a quarter more than there are.
        const double enough = std::clamp(1.1 * shortfall->candidate, 1.25 * static_cast<double>(now),
                                         static_cast<double>(more));
        more = static_cast<std::uint64_t>(std::ceil(enough));
    }
    return std::max(now, std::min(more, options_.most));
}

SceneVerdict SceneCheck::verdict() const
{
    if (missing_) return SceneVerdict::no_picture;
    if (!comparison_) return SceneVerdict::inconclusive;
    switch (comparison_->verdict) {
    case golden::Verdict::pass:
        return SceneVerdict::pass;
    case golden::Verdict::fail:
        return SceneVerdict::fail;
    case golden::Verdict::inconclusive:
        break;
    }
    return SceneVerdict::inconclusive;
}

std::string SceneCheck::reason() const
{
    if (missing_) return "Did not render: " + missing_->why + ".";
    std::string text;
    if (!dependent_.empty())
        text =
            "The pictures are not independent: " + dependent_ +
            ". Does the renderer ignore its seed? Only the first is judged; more samples per pixel (-s) "
            "would help. ";
    if (comparison_) return text + comparison_->reason + causes_;
    if (!text.empty()) return text;
    return pictures_.empty() ? "Not rendered before the end of the check."
                             : "Only one picture was rendered before the end of the check.";
}

} // namespace check
