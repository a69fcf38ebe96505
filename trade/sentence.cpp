#include "trade/sentence.h"

#include <algorithm>

namespace trade {

namespace {

/// A value of a knob beside its reference.
struct Beside {
    std::string name;
    Estimate time; // to equal noise, as a multiple of the reference's
    Estimate pays; // samples per pixel from which a longer build pays
};

std::string joined(const std::vector<std::string>& parts, const char* between)
{
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
    return text;
}

/// The times to equal noise: the best and the worst that are certain.
std::string say_times(const std::vector<Beside>& unbiased, const std::string& reference)
{
    const auto by_time = [](const Beside& a, const Beside& b) { return a.time.value < b.time.value; };
    const auto best = std::ranges::min_element(unbiased, by_time);
    const auto worst = std::ranges::max_element(unbiased, by_time);
    if (best == unbiased.end()) return "no value could be compared with " + reference;
    if (best->time.high < 1.0) {
        const std::string pays = best->pays.stated() ? ", and its longer build pays from " +
                                                           to_text(best->pays) + " samples per pixel on"
                                                     : "";
        return best->name + " reaches the error of " + reference + " in " + to_text(best->time) +
               " of the time" + pays;
    }
    if (worst->time.low > 1.0)
        return std::string(unbiased.size() > 1 ? "no value is certainly faster to the error of "
                                               : "it does not reach the error sooner than ") +
               reference + "; " + worst->name + " takes " + to_text(worst->time) +
               " times as long to reach it";
    return "no difference in the time to equal error was measured: " + best->name + " takes " +
           to_text(best->time) + " times as long as " + reference;
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
        if (time.stated())
            unbiased.push_back({name_of(value.text), time, samples_from_which_it_pays(rounds, others)});
    }
    std::vector<std::string> parts;
    if (!unbiased.empty() || biased.empty()) parts.push_back(say_times(unbiased, reference));
    if (!biased.empty()) parts.push_back("biased: " + joined(biased, "; "));
    if (!undecided.empty())
        parts.push_back("too noisy to tell whether they are biased: " + joined(undecided, ", "));
    return joined(parts, "; ") + ".";
}

} // namespace trade
