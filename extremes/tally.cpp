#include "extremes/tally.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace extremes {

void Tally::add(double error)
{
    if (!std::isfinite(error)) {
        add(Failure::not_finite);
        return;
    }
    ++cases_;
    ++errors_;
    largest_ = std::max(largest_, error);
    if (error > largest_error) ++failures_.at(static_cast<std::size_t>(Failure::inaccurate));
    const double bin =
        error > 0.0 ? std::floor((std::log10(error) - lowest_decade) * bins_per_decade) + 1.0 : 0.0;
    ++histogram_.at(static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins))));
}

void Tally::add(Failure failure)
{
    ++cases_;
    ++failures_.at(static_cast<std::size_t>(failure));
}

void Tally::refuse(const std::string& message)
{
    add(Failure::refused);
    if (refusal_.empty()) refusal_ = message;
}

void Tally::notice(const std::string& message)
{
    if (notice_.empty()) notice_ = message;
}

void Tally::leave_out(const std::string& reason)
{
    if (left_out_.empty()) left_out_ = reason;
}

Tally& Tally::operator+=(const Tally& other)
{
    cases_ += other.cases_;
    errors_ += other.errors_;
    for (std::size_t i = 0; i < failures_.size(); ++i) failures_[i] += other.failures_[i];
    for (std::size_t i = 0; i < histogram_.size(); ++i) histogram_[i] += other.histogram_[i];
    largest_ = std::max(largest_, other.largest_);
    if (refusal_.empty()) refusal_ = other.refusal_;
    if (notice_.empty()) notice_ = other.notice_;
    if (left_out_.empty()) left_out_ = other.left_out_;
    return *this;
}

std::uint64_t Tally::failures() const
{
    return std::accumulate(failures_.begin(), failures_.end(), std::uint64_t{0});
}

double Tally::quantile(double q) const
{
    if (errors_ == 0) return 0.0;
    const double wanted = q * static_cast<double>(errors_);
    std::uint64_t sum = histogram_[0];
    if (sum > 0 && static_cast<double>(sum) >= wanted) return 0.0;
    for (std::size_t i = 1; i < histogram_.size(); ++i) {
        sum += histogram_[i];
        if (static_cast<double>(sum) < wanted || sum == 0) continue;
        const double upper =
            std::pow(10.0, static_cast<double>(i) / bins_per_decade + lowest_decade); // of the bin
        return std::min(largest_, upper);
    }
    return largest_;
}

} // namespace extremes
