#include "golden/false_alarm.h"

#include "golden/multiplicity.h"
#include "golden/statistics.h"

namespace golden {

double false_alarm_bound(const Functionals& functionals, Method method, std::uint64_t golden_batches,
                         const std::vector<std::uint64_t>& stages, const CompareOptions& options)
{
    if (stages.size() < 2) return options.certainty_level;
    const Multiplicity multiplicity(functionals, method);
    std::vector<double> counts;
    for (const std::uint64_t batches : stages) counts.push_back(static_cast<double>(batches));
    double sum = options.certainty_level;
    for (const RegionKind kind : multiplicity.kinds()) {
        // The first stage is two-sided, the later ones test its direction: twice the chance of one sign.
        std::vector<double> levels(stages.size(), options.confirmation_level);
        levels[0] = options.screening_level / multiplicity.of(kind) / 2.0;
        sum += 2.0 * multiplicity.tests_of(kind) *
               all_exceed(counts, levels, static_cast<double>(golden_batches));
    }
    return sum;
}

} // namespace golden
