#include "trade/sentence.h"

#include <algorithm>

namespace trade {

namespace {

/// A value of a knob beside its reference.
struct Beside {
    std::string name;
    Estimate time;           // to equal noise, as a multiple of the reference's
    bool faster;             // certainly, among all comparisons of the study
    bool slower;             //
    Estimate pays;           // samples per pixel from which its longer build pays
    Estimate reference_pays; // the same of the reference's longer build
    bool decided;            // whether it is biased
    double detectable;       // relative error of the whole that would have been found
};

std::string joined(const std::vector<std::string>& parts, const char* between)
{
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
    return text;
}

/// The fastest value that is certainly faster; or else the slowest one.
std::string say_times(const std::vector<Beside>& unbiased, const std::string& reference)
{
    const Beside* fastest = nullptr;
    const Beside* slowest = nullptr;
    const Beside* least = nullptr;
    for (const Beside& one : unbiased) {
        const auto replaces = [&](const Beside* best, bool smaller) {
            return best == nullptr ||
                   (smaller ? one.time.value < best->time.value : one.time.value > best->time.value);
        };
        if (one.faster && replaces(fastest, true)) fastest = &one;
        if (one.slower && replaces(slowest, false)) slowest = &one;
        if (replaces(least, true)) least = &one;
    }
    if (least == nullptr) return "no value could be compared with " + reference;
    if (fastest != nullptr) {
        std::string text = fastest->name + " reaches the error of " + reference + " in " +
                           to_text(fastest->time) + " of the time";
        if (fastest->pays.value > 1.0)
            text +=
                ", and its longer build pays from " + to_text(fastest->pays) + " samples per pixel on";
        return text + (fastest->decided
                           ? " (no bias was found; one of " + percent_to_text(fastest->detectable) +
                                 " of the mean would have been)"
                           : "");
    }
    if (slowest != nullptr) {
        std::string text =
            unbiased.size() > 1 ? "no value is certainly faster than " + reference + "; " : "";
        text += slowest->name + " takes " + to_text(slowest->time) + " times as long to the error of " +
                reference;
        if (slowest->reference_pays.value > 1.0)
            text += ", whose longer build pays from " + to_text(slowest->reference_pays) +
                    " samples per pixel on";
        return text;
    }
    return "no difference is certain; to the error of " + reference + ", " + least->name + " takes " +
           to_text(least->time) + " times as long";
}

} // namespace

std::string sentence(const Knob& knob, const std::vector<std::optional<Estimates>>& estimates,
                     const std::vector<Measurements>& measured)
{
    const auto name_of = [&](const std::string& value) { return knob.name + "=" + value; };
    std::string reference = "the reference";
    std::vector<Beside> unbiased;
    std::vector<std::string> biased;
    std::vector<std::string> undecided;
    const double shared = 1.0 - 0.05 / static_cast<double>(std::max<std::size_t>(1, measured.size()));
    for (const Knob::Value& value : knob.values) {
        const auto& found = estimates[value.configuration];
        const bool is_reference = value.configuration == knob.reference;
        if (is_reference) reference = name_of(value.text);
        if (!found) continue;
        if (found->bias.verdict == BiasVerdict::biased) {
            biased.push_back(name_of(value.text) + ", by " + error_to_text(found->bias.whole));
            continue;
        }
        if (found->bias.verdict == BiasVerdict::undecided) undecided.push_back(name_of(value.text));
        if (is_reference) continue;
        const std::vector<Round>& rounds = measured[value.configuration].rounds;
        const std::vector<Round>& others = measured[knob.reference].rounds;
        const Estimate time = time_to_equal_noise(rounds, others);
        const Estimate wide = time_to_equal_noise(rounds, others, shared);
        if (!time.stated()) continue;
        const bool faster = wide.high < 1.0;
        const bool slower = wide.low > 1.0;
        unbiased.push_back({name_of(value.text), time, faster, slower,
                            samples_from_which_it_pays(rounds, others),
                            samples_from_which_it_pays(others, rounds),
                            found->bias.verdict == BiasVerdict::none_found, found->bias.detectable});
    }
    std::vector<std::string> parts;
    if (!unbiased.empty() || biased.empty()) parts.push_back(say_times(unbiased, reference));
    if (!biased.empty()) parts.push_back("biased: " + joined(biased, "; "));
    if (!undecided.empty())
        parts.push_back("too noisy to tell whether they are biased: " + joined(undecided, ", "));
    return joined(parts, "; ") + ".";
}

} // namespace trade
