#pragma once

// One scene under check: its pictures so far, and what the judge says of them.

#include "check/renderers/suite.h"
#include "golden/comparison.h"
#include "golden/golden.h"
#include "images/image.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace check {

/// no_picture: the renderer crashed, ran too long, wrote no picture, or one that cannot be judged.
enum class SceneVerdict { pass, fail, inconclusive, no_picture };
std::string describe(SceneVerdict verdict); // "PASS", "FAIL", "INCONCLUSIVE", "NO PICTURE"

/// A picture that the renderer did not make.
struct Missing {
    std::string why; // as PictureAttempt::failure
    std::string last_lines;
    std::string command; // that makes it again, for a shell
};

struct JudgeOptions {
    std::uint64_t samples; // per pixel and picture
    bool limits_edges;     // the renderer is told the longest path
    double error = 0.005;  // PASS takes that a relative error of the whole picture of this size is seen
    std::uint64_t first = 16; // pictures of the first round
    std::uint64_t most = 256; // pictures in all
};

class SceneCheck {
public:
    /// Reads the golden. Throws images::ImageError, and std::invalid_argument if the golden is not of
    /// this scene or does not state its longest path.
    SceneCheck(SuiteScene scene, const JudgeOptions& options);

    /// Adds a picture of the golden's size, without NaN.
    void add(images::Image picture, double seconds, bool from_earlier_run);

    /// Ends the check: there is no picture, because of the renderer.
    void add_missing(Missing missing);

    /// Judges all pictures so far, if any was added since the last time. With fewer than two there is
    /// no verdict.
    void judge();

    /// Judges, and looks for what is wrong: nothing will be added any more.
    void finish();

    /// The number of pictures with which it should be judged next; that of the pictures so far if more
    /// are of no use: there is a verdict, or none can be reached.
    [[nodiscard]] std::uint64_t wanted() const { return wanted_; }
    [[nodiscard]] bool decided() const { return wanted_ == pictures_.size(); }

    [[nodiscard]] SceneVerdict verdict() const;
    /// Why, in sentences.
    [[nodiscard]] std::string reason() const;
    /// What is wrong with the pictures (golden/diagnosis.h); empty if that is not known.
    [[nodiscard]] const std::string& diagnosis() const { return diagnosis_; }

    /// Sets another diagnosis of pictures that FAIL. After finish.
    void set_diagnosis(const std::string& sentence);

    /// The pictures that the verdict is about: all, or only the first if they are not independent.
    [[nodiscard]] std::vector<images::Image> judged_pictures() const;
    [[nodiscard]] std::uint64_t samples() const { return options_.samples; } // per picture

    [[nodiscard]] const SuiteScene& scene() const { return scene_; }
    [[nodiscard]] const golden::Golden& golden() const { return golden_; }
    [[nodiscard]] const std::vector<images::Image>& pictures() const { return pictures_; }
    [[nodiscard]] std::size_t from_earlier_run() const { return from_earlier_run_; }
    [[nodiscard]] double seconds() const { return seconds_; } // of the renderer, without earlier runs
    /// The last judgement; none before the first. Of a single picture if they are not independent.
    [[nodiscard]] const std::optional<golden::Comparison>& comparison() const { return comparison_; }
    [[nodiscard]] const std::optional<Missing>& missing() const { return missing_; }
    /// The error that PASS takes: that of the options, or what the golden's own noise allows.
    [[nodiscard]] double error() const { return error_; }
    /// Upper bound of the chance that right pictures FAIL, all judgements so far together.
    [[nodiscard]] double false_alarm() const { return false_alarm_; }

private:
    [[nodiscard]] golden::Comparison judged(const std::vector<images::Image>& pictures,
                                            double error) const;
    void judge_dependent(const std::string& why);
    void diagnose();
    void say_causes();
    [[nodiscard]] std::uint64_t next() const;

    SuiteScene scene_;
    JudgeOptions options_;
    golden::Golden golden_;
    std::vector<images::Image> pictures_;
    std::size_t from_earlier_run_ = 0;
    std::size_t judged_ = 0; // pictures, the last time
    double seconds_ = 0.0;
    double error_;
    double false_alarm_ = 0.0;
    std::uint64_t wanted_;
    std::optional<golden::Comparison> comparison_;
    std::string dependent_; // why the pictures are not independent; empty if they are
    bool finished_ = false;
    std::string diagnosis_;
    std::string causes_;
    std::optional<Missing> missing_;
};

} // namespace check
