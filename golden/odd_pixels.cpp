#include "golden/odd_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace golden {

namespace {

/// A picture and the golden, value by value, with the noise of both.
class Look {
public:
    Look(const Golden& golden, const images::Image& picture)
        : golden_(golden), picture_(picture), batches_(static_cast<double>(golden.batches()))
    {
        for (std::size_t c = 0; c < channel_count; ++c) {
            for (std::size_t i = 0; i < pixels(); ++i)
                brightness_ += expected(i, c) / static_cast<double>(channel_count * pixels());
            noise_[c] = noise_of(c);
        }
    }

    [[nodiscard]] std::size_t pixels() const { return picture_.pixels.size(); }
    [[nodiscard]] double value(std::size_t i, std::size_t c) const
    {
        return picture_.pixels[i][static_cast<int>(c)];
    }
    [[nodiscard]] double expected(std::size_t i, std::size_t c) const
    {
        return golden_.mean.pixels[i][static_cast<int>(c)];
    }
    [[nodiscard]] double golden_error(std::size_t i, std::size_t c) const
    {
        return golden_.standard_error.pixels[i][static_cast<int>(c)];
    }
    /// The golden's mean, over pixels and channels.
    [[nodiscard]] double brightness() const { return brightness_; }

    /// The variance of one batch of the golden, at least that of the rule of three (functionals.cpp).
    [[nodiscard]] double batch_variance_of(std::size_t i, std::size_t c) const
    {
        const double error = golden_error(i, c);
        const double mean = expected(i, c);
        return std::max(error * error * batches_, 3.0 * mean * mean / batches_);
    }

    /// The difference from the golden in standard deviations: those of the golden's noise, scaled by the
    /// median over this picture, so that neither its number of samples nor an error everywhere matters.
    [[nodiscard]] double deviations(std::size_t i, std::size_t c) const
    {
        const double floor = 1e-4 * brightness_; // smaller differences are never odd
        const double deviation = std::sqrt(noise_[c] * batch_variance_of(i, c) + floor * floor);
        return deviation > 0.0 ? (value(i, c) - expected(i, c)) / deviation : 0.0;
    }

private:
    /// The median squared difference as a variance, in units of that of a batch of the golden.
    [[nodiscard]] double noise_of(std::size_t c) const
    {
        std::vector<double> squares;
        for (std::size_t i = 0; i < pixels(); ++i)
            if (const double variance = batch_variance_of(i, c); variance > 0.0)
                squares.push_back(std::pow(value(i, c) - expected(i, c), 2.0) / variance);
        if (squares.empty()) return 0.0;
        const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
        std::nth_element(squares.begin(), middle, squares.end());
        constexpr double median_of_squares = 0.4549; // of standard normal values
        return *middle / median_of_squares;
    }

    const Golden& golden_;
    const images::Image& picture_;
    double batches_;
    double brightness_ = 0.0;
    std::array<double, channel_count> noise_{};
};

/// The pixels of one kind, and the worst of them.
class Gatherer {
public:
    Gatherer(Oddity kind, const Look& look, int width) : look_(look), width_(width) { odd_.kind = kind; }

    void add(std::size_t i, std::size_t c, double badness)
    {
        odd_.pixels.push_back(i);
        if (badness <= worst_) return;
        worst_ = badness;
        const auto width = static_cast<std::size_t>(width_);
        odd_.place = {static_cast<int>(i % width), static_cast<int>(i / width)};
        odd_.channel = c;
        odd_.value = look_.value(i, c);
        odd_.expected = look_.expected(i, c);
        odd_.deviations = std::abs(look_.deviations(i, c));
    }

    /// Appends what was gathered, unless there is no such pixel or there are more than `most`.
    void give(std::vector<OddPixels>& to, bool wrong, std::size_t most)
    {
        std::sort(odd_.pixels.begin(), odd_.pixels.end());
        odd_.pixels.erase(std::unique(odd_.pixels.begin(), odd_.pixels.end()), odd_.pixels.end());
        odd_.wrong = wrong;
        if (!odd_.pixels.empty() && odd_.pixels.size() <= most) to.push_back(std::move(odd_));
    }

private:
    const Look& look_;
    int width_;
    OddPixels odd_{};
    double worst_ = -std::numeric_limits<double>::infinity();
};

/// The pixels of a channel that are clipped, by their numbers: at least three of exactly the same value,
/// where the golden is brighter by more than its own error, while at most one in a hundred of them is
/// exceeded in the picture.
std::vector<std::size_t> cut_off(const Look& look, std::size_t c)
{
    std::vector<std::size_t> order(look.pixels());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return look.value(a, c) > look.value(b, c); });
    std::vector<std::size_t> most;
    for (std::size_t first = 0; first < order.size();) {
        const double value = look.value(order[first], c);
        if (!(value > 0.0)) break;
        std::vector<std::size_t> equal;
        std::size_t next = first;
        for (; next < order.size() && look.value(order[next], c) == value; ++next) {
            const std::size_t i = order[next];
            const double missing = look.expected(i, c) - value;
            if (missing > 5.0 * look.golden_error(i, c) && missing > 1e-3 * value) equal.push_back(i);
        }
        const bool top = first <= std::max<std::size_t>(2, equal.size() / 100);
        if (top && equal.size() >= 3 && equal.size() > most.size()) most = std::move(equal);
        first = next;
    }
    return most;
}

/// Sorts the values of a picture by their oddity.
class Sorter {
public:
    Sorter(const Look& look, int width, double batches, double level)
        : look_(look), batches_(batches), level_(level), negative_(Oddity::negative, look, width),
          clipped_(Oddity::clipped, look, width), dead_(Oddity::dark, look, width),
          dark_(Oddity::dark, look, width), bright_(Oddity::bright, look, width)
    {}

    void sort(std::size_t c)
    {
        std::vector<bool> cut(look_.pixels());
        for (const std::size_t i : cut_off(look_, c)) {
            cut[i] = true;
            clipped_.add(i, c, look_.expected(i, c) - look_.value(i, c));
        }
        for (std::size_t i = 0; i < look_.pixels(); ++i) {
            golden_negative_ = golden_negative_ || look_.expected(i, c) < 0.0;
            const double value = look_.value(i, c);
            const double deviations = look_.deviations(i, c);
            constexpr double rounding = 1e-5; // of conversions between colour spaces
            constexpr double far = 30.0;      // standard deviations
            if (value < -rounding * std::max(0.0, look_.brightness()))
                negative_.add(i, c, -value);
            else if (cut[i])
                continue;
            else if (is_dead(i, c))
                dead_.add(i, c, -deviations);
            else if (deviations < -far)
                dark_.add(i, c, -deviations);
            else if (deviations > far)
                bright_.add(i, c, deviations);
        }
    }

    [[nodiscard]] std::vector<OddPixels> found()
    {
        const std::size_t all = look_.pixels();
        const std::size_t few = std::max<std::size_t>(1, all / 500);
        std::vector<OddPixels> found;
        negative_.give(found, !golden_negative_, all);
        clipped_.give(found, true, all);
        dead_.give(found, true, few);
        dark_.give(found, false, few);
        bright_.give(found, false, few);
        return found;
    }

private:
    /// Whether the chance of such a dark value in a right picture is below the level, all values
    /// together. Assumes ten times the golden's variance in this pixel, as another estimator may have,
    /// and a golden that is too bright by eight of its standard errors.
    [[nodiscard]] bool is_dead(std::size_t i, std::size_t c) const
    {
        constexpr double more_noise = 10.0;
        constexpr double golden_errors = 8.0;
        const double at_least = look_.expected(i, c) - golden_errors * look_.golden_error(i, c);
        const double chance = chance_of_darkness(std::max(0.0, look_.value(i, c)), at_least,
                                                 more_noise * look_.batch_variance_of(i, c), batches_);
        return static_cast<double>(channel_count * look_.pixels()) * chance < level_;
    }

    const Look& look_;
    double batches_, level_;
    Gatherer negative_, clipped_, dead_, dark_, bright_;
    bool golden_negative_ = false;
};

std::string say_short(double number)
{
    std::ostringstream text;
    text.precision(4);
    text << number;
    return text.str();
}

} // namespace

std::string describe(Oddity oddity)
{
    switch (oddity) {
    case Oddity::negative:
        return "negative";
    case Oddity::clipped:
        return "clipped";
    case Oddity::dark:
        return "dark";
    case Oddity::bright:
        return "bright";
    }
    return "";
}

std::string describe(const OddPixels& odd)
{
    const std::size_t n = odd.pixels.size();
    const std::string pixels = n == 1 ? "1 pixel is " : std::to_string(n) + " pixels are ";
    const std::string worst = std::string(n == 1 ? "" : "foremost ") + channel_names[odd.channel] +
                              " of pixel (" + std::to_string(odd.place.x) + ", " +
                              std::to_string(odd.place.y) + ")" +
                              (odd.picture ? " of picture " + std::to_string(*odd.picture) : "");
    const std::string value = say_short(odd.value);
    const std::string golden = say_short(odd.expected);
    switch (odd.kind) {
    case Oddity::negative:
        return pixels + "negative, which radiance cannot be: " + worst + " is " + value;
    case Oddity::clipped:
        return pixels + "clipped, exactly " + value + " where the golden is brighter: " + worst + ", " +
               golden + " in the golden";
    case Oddity::dark:
    case Oddity::bright:
        return pixels +
               (odd.kind == Oddity::dark ? "far darker than the golden: "
                                         : "far brighter than the golden: ") +
               worst + " is " + value + ", in the golden " + golden + " (" + say_short(odd.deviations) +
               " standard deviations)";
    }
    return "";
}

std::vector<OddPixels> odd_pixels(const Golden& golden, const images::Image& picture, double batches,
                                  double level)
{
    const Look look(golden, picture);
    Sorter sorter(look, picture.width, batches, level);
    for (std::size_t c = 0; c < channel_count; ++c) sorter.sort(c);
    return sorter.found();
}

std::vector<std::size_t> pixels_of(const std::vector<OddPixels>& odd)
{
    std::vector<std::size_t> pixels;
    for (const OddPixels& found : odd)
        pixels.insert(pixels.end(), found.pixels.begin(), found.pixels.end());
    return pixels;
}

std::vector<std::size_t> bright_pixels(const std::vector<OddPixels>& odd)
{
    for (const OddPixels& found : odd)
        if (found.kind == Oddity::bright) return found.pixels;
    return {};
}

images::Image replaced(images::Image picture, const std::vector<std::size_t>& pixels,
                       const images::Image& other)
{
    for (const std::size_t i : pixels) picture.pixels[i] = other.pixels[i];
    return picture;
}

double chance_of_darkness(double value, double mean, double variance, double batches)
{
    if (!(value < mean) || !(batches > 0.0)) return 1.0;
    const double missing = mean - value;
    return std::exp(-batches * missing * missing / (2.0 * (variance + mean * mean)));
}

} // namespace golden
