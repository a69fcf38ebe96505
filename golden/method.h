#pragma once

// The methods by which a candidate is compared with a golden.

#include <string>

namespace golden {

/// Chosen by what is known of the candidate's noise.
enum class Method {
    ranks,  // same estimator and batch size, so equally distributed batches: Mann-Whitney
    welch,  // another estimator, several independent pictures: Welch's t
    picture // a single picture with a stated number of samples: Welch's t with an assumed noise
};
std::string describe(Method method);

} // namespace golden
