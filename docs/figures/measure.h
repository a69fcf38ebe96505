#pragma once

// Measures the time and the error of renders.

#include "images/image.h"
#include "trade/relative_error.h"
#include "trade/round.h"

namespace figures {

/// CPU time of this process so far, in seconds.
inline double cpu_seconds()
{
    return trade::process_clock().cpu;
}

/// The relMSE of `image` (trade/relative_error.h).
inline double relative_mean_square_error(const images::Image& image, const images::Image& reference)
{
    return trade::weighted_square(trade::relative_weights(reference), image, reference);
}

} // namespace figures
