#include "cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace cli {

Progress::Progress(std::string what, double from, double total, bool quiet)
    : what_(std::move(what)), from_(from), total_(total), shown_(!quiet && isatty(STDERR_FILENO) == 1)
{}

Progress::~Progress()
{
    if (shown_) std::fputs("\r\033[K", stderr); // clears the line for the next output
}

void Progress::update(double done)
{
    const auto now = Clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(200)) return;
    last_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double fraction = std::clamp(done / total_, 0.0, 1.0);
    const double left = done > from_ ? elapsed * (total_ - done) / (done - from_) : 0.0;

    constexpr int bar_width = 30;
    const int filled = static_cast<int>(std::lround(fraction * bar_width));
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(bar_width - filled), '.');
    std::fprintf(stderr, "\r\033[K%s [%s] %3.0f%%  %s left", what_.c_str(), bar.c_str(),
                 100.0 * fraction, say_duration(left).c_str());
}

std::string say_duration(double seconds)
{
    const auto s = static_cast<long long>(std::ceil(seconds));
    std::array<char, 64> text{};
    if (s < 60)
        std::snprintf(text.data(), text.size(), "%lld s", s);
    else if (s < 3600)
        std::snprintf(text.data(), text.size(), "%lld min %02lld s", s / 60, s % 60);
    else
        std::snprintf(text.data(), text.size(), "%lld h %02lld min", s / 3600, s / 60 % 60);
    return text.data();
}

} // namespace cli
