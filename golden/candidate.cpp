#include "golden/candidate.h"

namespace golden {

Candidate::Candidate(const Functionals& functionals)
    : functionals_(&functionals), film_(functionals.width(), functionals.height())
{}

void Candidate::add_batch(const images::Image& batch)
{
    rows_.push_back(functionals_->evaluate(batch));
    film_.add_batch(batch);
}

} // namespace golden
