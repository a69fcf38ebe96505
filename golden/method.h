#pragma once

// How a candidate is compared with a golden.

#include <string>

namespace golden {

/// What is known of the candidate's noise, and so how means are compared.
enum class Method {
    ranks,  // same estimator, same batch size: batches are distributed alike. Mann-Whitney
    welch,  // another estimator, of which there are several independent pictures. Welch's t
    picture // a single picture with a stated number of samples. Welch's t with an assumed noise
};
std::string describe(Method method);

} // namespace golden
