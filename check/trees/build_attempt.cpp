#include "check/trees/build_attempt.h"

#include <stdexcept>

namespace check {

namespace {

enum class Expected { tree, rejection, either };

Expected expected_of(std::span<const ref::Aabb> boxes)
{
    bool finite = true;
    for (const ref::Aabb& box : boxes)
        for (int axis = 0; axis < 3; ++axis) {
            if (!(box.lower[axis] <= box.upper[axis])) return Expected::rejection; // also for NaN
            finite = finite && std::isfinite(box.lower[axis]) && std::isfinite(box.upper[axis]);
        }
    return finite && !boxes.empty() ? Expected::tree : Expected::either;
}

} // namespace

Problem problem_of(const BuildAttempt& attempt, std::span<const ref::Aabb> boxes,
                   const TreeChecks& checks)
{
    const Expected expected = expected_of(boxes);
    switch (attempt.end) {
    case BuildAttempt::End::crashed:
        return {"crash", attempt.text};
    case BuildAttempt::End::timed_out:
        return {"timeout", attempt.text};
    case BuildAttempt::End::rejected:
        if (expected != Expected::tree) return {};
        return {"rejected", "legal primitives were rejected: " + attempt.text};
    case BuildAttempt::End::no_tree:
        if (expected == Expected::rejection)
            return {"accepted-nan", "NaN was not rejected: " + attempt.text};
        return {"no-tree", attempt.text};
    case BuildAttempt::End::built: {
        if (expected == Expected::rejection) return {"accepted-nan", "NaN was not rejected"};
        const TreeReport report = check_tree(attempt.tree, boxes, checks);
        const Property* failure = report.first_failure();
        return failure == nullptr ? Problem{} : Problem{failure->name, failure->example};
    }
    }
    throw std::logic_error("no such end");
}

} // namespace check
