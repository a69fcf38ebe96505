#pragma once

#include "extremes/tally.h"

#include "scenes/read_scene.h"

#include <stdexcept>

namespace extremes {

/// Calls compute(). If it throws an exception by which the program refuses a scene or a part of it, adds
/// `cases` cases to `tally` as Failure::refused. Other exceptions are passed on. Whether it returned.
template <class Compute>
bool unless_refused(Tally& tally, std::size_t cases, const Compute& compute)
{
    const auto refuse = [&](const char* message) {
        for (std::size_t i = 0; i < cases; ++i) tally.refuse(message);
        return false;
    };
    try {
        compute();
        return true;
    } catch (const scenes::SceneError& error) {
        return refuse(error.what());
    } catch (const std::invalid_argument& error) {
        return refuse(error.what());
    }
}

} // namespace extremes
