#pragma once

#include <chrono>
#include <string>

namespace cli {

/// A line on stderr with the progress of a long piece of work and the time left.
/// Silent unless stderr is a terminal. Not for concurrent use.
class Progress {
public:
    /// `what`: the name of the work; `from` of its `total` units were done before.
    Progress(std::string what, double from, double total, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `done` of the total units are done now. Writes at most five times a second.
    void update(double done);

private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    double from_;
    double total_;
    bool shown_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
};

/// A duration in words: "42 s", "3 min 05 s", "2 h 07 min".
std::string say_duration(double seconds);

} // namespace cli
