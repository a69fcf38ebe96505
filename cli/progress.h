#pragma once

#include <chrono>
#include <string>

namespace cli {

/// A line on stderr that says how far a long piece of work has come and how long it will still take.
/// Silent unless stderr is a terminal. Not for concurrent use.
class Progress {
public:
    /// `what` names the work; `from` of `total` units were done before it began.
    Progress(std::string what, double from, double total, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `done` of the total units are done now. Cheap: writes a few times a second at most.
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

/// A duration as a person says it: "42 s", "3 min 05 s", "2 h 07 min".
std::string say_duration(double seconds);

} // namespace cli
