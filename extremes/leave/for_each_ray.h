#pragma once

// The loop that all methods of leaving surfaces have in common.

#include "extremes/leave/leave_case.h"
#include "extremes/refusal.h"

#include <algorithm>

namespace extremes {

constexpr int rays_of_scene = 25; // of one random scene

/// Makes random scenes with `cases` rays in all. Calls found(case, tally), which returns a FoundOnward
/// for each ray, and adds all to `tally`. An exception by which the program refuses the scene, or a part
/// of it, counts for each of its rays. A ray whose exact answer is not the one that was intended,
/// because its scene does not fit into doubles, is Failure::missed.
template <class Found>
void for_each_leave_ray(MakeLeaveCase make, double parameter, Random& random, int cases, Tally& tally,
                        const Found& found)
{
    for (int done = 0; done < cases; done += rays_of_scene) {
        const LeaveCase from = make(parameter, random, std::min(rays_of_scene, cases - done));
        std::vector<FoundOnward> all;
        const bool accepted = unless_refused(tally, from.rays.size(), [&] { all = found(from, tally); });
        if (!accepted) continue;
        for (std::size_t i = 0; i < from.rays.size(); ++i) {
            if (const auto truth = exact_onward(from.scene, from.rays[i]))
                judge_onward(from, from.rays[i], *truth, all.at(i), tally);
            else
                tally.add(Failure::missed);
        }
    }
}

} // namespace extremes
