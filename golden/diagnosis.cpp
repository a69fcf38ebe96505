#include "golden/diagnosis.h"

#include "golden/faults.h"
#include "golden/reason.h"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace golden {

namespace {

constexpr double diagnosis_level = 1e-6; // the share of right pictures that get a diagnosis is smaller

bool passes(const std::vector<images::Image>& pictures, const JudgePictures& judge)
{
    try {
        return judge(pictures).verdict == Verdict::pass;
    } catch (const std::invalid_argument&) {
        return false; // not a picture that can be judged, as one without noise of its own
    }
}

/// Pictures without `fault`; none if one of them cannot have it.
std::optional<std::vector<images::Image>> undone(const std::vector<images::Image>& pictures,
                                                 const Fault& fault, const images::Image& golden)
{
    std::vector<images::Image> result;
    for (const images::Image& picture : pictures) {
        auto without = fault.undo(picture, golden);
        if (!without) return std::nullopt;
        result.push_back(std::move(*without));
    }
    return result;
}

std::vector<images::Image> scaled(std::vector<images::Image> pictures, double factor)
{
    for (images::Image& picture : pictures)
        for (images::Rgb& pixel : picture.pixels) pixel *= factor;
    return pictures;
}

/// The sum of all channels of all pixels.
double sum_of(const images::Image& image)
{
    double sum = 0.0;
    for (const images::Rgb& pixel : image.pixels) sum += pixel.r + pixel.g + pixel.b;
    return sum;
}

/// The sentence for the first of the mistakes without which the pictures PASS.
std::optional<std::string> first_of(const std::vector<Fault>& faults, const Golden& golden,
                                    const std::vector<images::Image>& pictures,
                                    const JudgePictures& judge)
{
    for (const Fault& fault : faults)
        if (const auto without = undone(pictures, fault, golden.mean);
            without && passes(*without, judge))
            return "Your picture is " + fault.is + ": with this undone, it PASSes.";
    return std::nullopt;
}

/// The sum of the pictures' values over that of the golden; none if that is no factor.
std::optional<double> factor_of(const Golden& golden, const std::vector<images::Image>& pictures)
{
    double sum = 0.0;
    for (const images::Image& picture : pictures)
        sum += sum_of(picture) / static_cast<double>(pictures.size());
    const double factor = sum / sum_of(golden.mean);
    return factor > 0.0 && std::isfinite(factor) ? std::optional(factor) : std::nullopt;
}

constexpr const char* everywhere = " times the golden everywhere: divided by it, it PASSes.";

/// The sentence for a factor that has a name.
std::optional<std::string> known_factor(double factor, const std::vector<images::Image>& pictures,
                                        double samples, const JudgePictures& judge)
{
    for (const KnownFactor& known : known_factors(samples))
        if (std::abs(factor / known.value - 1.0) < 0.1 &&
            passes(scaled(pictures, 1.0 / known.value), judge))
            return "Your picture is " + say(known.value, 4) + " = " + known.name + everywhere;
    return std::nullopt;
}

} // namespace

std::string diagnose(const Golden& golden, const Comparison& comparison,
                     const std::vector<images::Image>& pictures, double samples,
                     const JudgePictures& judge, const Explain& explain,
                     const std::vector<MakeFaults>& more)
{
    const bool wrong = comparison.verdict == Verdict::fail ||
                       (comparison.verdict == Verdict::inconclusive && comparison.p < diagnosis_level);
    if (!wrong || pictures.empty()) return "";
    if (const auto usual = first_of(usual_faults(), golden, pictures, judge)) return *usual;
    const std::optional<double> factor = factor_of(golden, pictures);
    if (factor)
        if (const auto known = known_factor(*factor, pictures, samples, judge)) return *known;
    std::string explained = explain ? explain() : "";
    if (factor && passes(scaled(pictures, 1.0 / *factor), judge)) {
        if (!explained.empty())
            return explained + " It is as well " + say(*factor, 4) + " times the golden everywhere.";
        return "Your picture is " + say(*factor, 4) + everywhere;
    }
    if (!explained.empty()) return explained;
    for (const MakeFaults& make : more)
        if (const auto found = first_of(make(), golden, pictures, judge)) return *found;
    return "";
}

} // namespace golden
