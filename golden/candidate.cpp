#include "golden/candidate.h"

namespace golden {

Candidate::Candidate(const Functionals& functionals)
    : functionals_(&functionals), film_(functionals.width(), functionals.height()),
      cubes_(functionals.width(), functionals.height())
{}

void Candidate::add_batch(const images::Image& batch)
{
    rows_.push_back(functionals_->evaluate(batch)); // checks the batch
    // In one pass, from the mean and the squares of the batches before [Pebay 2008, eq. 1.2].
    const auto n = static_cast<double>(film_.batches() + 1);
    for (std::size_t i = 0; i < batch.pixels.size(); ++i) {
        const images::Rgb from_mean = batch.pixels[i] - film_.mean().pixels[i];
        cubes_.pixels[i] += from_mean * (from_mean * from_mean * ((n - 1.0) * (n - 2.0) / (n * n)) -
                                         3.0 / n * film_.squares().pixels[i]);
    }
    film_.add_batch(batch);
}

} // namespace golden
