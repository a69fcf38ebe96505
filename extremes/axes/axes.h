#pragma once

// One function per axis; each has a file of its own, named after it.

#include "extremes/axis.h"

namespace extremes {

Axis ior_axis();

} // namespace extremes
