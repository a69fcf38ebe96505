#include "extremes/axes/axes.h"

namespace extremes {

std::vector<Axis> all_axes()
{
    return {ior_axis()};
}

} // namespace extremes
