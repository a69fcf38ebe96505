#pragma once

// Measures a time, with repetitions until a stated precision is reached.

#include <functional>

namespace cli {

/// When to stop measuring.
struct Precision {
    double relative = 0.02;  // standard error of the mean over the mean
    int fewest = 5;          // repetitions at least, as few values have no reliable scatter
    double most_seconds = 1; // of all repetitions; then two are enough
    double shortest = 0.001; // seconds of one repetition: work that takes less is done several times
};

struct Repetitions {
    double seconds = 0;                 // for the work once: the mean over the repetitions
    double relative_standard_error = 0; // of that mean
    int count = 0;                      // repetitions
};

/// Does `work` again and again, timed by `now` (seconds, never backwards), until the mean is as precise
/// as required, and returns the mean. The first repetition, which finds how often the work fits into
/// `shortest` and fills the caches, does not count. The standard error is computed as if repetitions
/// were independent; a slowdown that lasts for all of them is not detected.
Repetitions repeat_until_precise(const std::function<double()>& now, const std::function<void()>& work,
                                 const Precision& precision = {});

} // namespace cli
