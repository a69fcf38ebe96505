#pragma once

// The loop that all methods of leaving surfaces have in common.

#include "extremes/leave/leave_case.h"
#include "extremes/refusal.h"

namespace extremes {

/// Makes random scenes with `cases` rays in all. Calls found(case, tally), which returns a FoundOnward
/// for each ray, and adds all to `tally`. An exception by which the program refuses the scene, or a part
/// of it, counts for each of its rays. A ray whose exact answer is not the one that was intended,
/// because its scene does not fit into doubles, is Failure::missed.
template <class Found>
void for_each_leave_ray(MakeLeaveCase make, double parameter, Random& random, int cases, Tally& tally,
                        const Found& found)
{
    for (const AnsweredCase& answered : answered_cases(make, parameter, random, cases)) {
        const LeaveCase& from = answered.from;
        std::vector<FoundOnward> all;
        const bool accepted = unless_refused(tally, from.rays.size(), [&] { all = found(from, tally); });
        if (!accepted) continue;
        for (std::size_t i = 0; i < from.rays.size(); ++i) {
            if (const auto& truth = answered.truths[i])
                judge_onward(from, from.rays[i], *truth, all.at(i), tally);
            else
                tally.add(Failure::missed);
        }
    }
}

} // namespace extremes
