#include "golden/candidate.h"

namespace golden {

Candidate::Candidate(const Functionals& functionals)
    : functionals_(&functionals), moments_{images::Image(functionals.width(), functionals.height()),
                                           images::Image(functionals.width(), functionals.height())},
      cubes_(functionals.width(), functionals.height())
{}

void Candidate::add_batch(const images::Image& batch)
{
    rows_.push_back(functionals_->evaluate(batch)); // checks the batch
    // In one pass, from the moments of the batches before [Pebay 2008, eq. 1.1 to 1.3].
    const auto n = static_cast<double>(rows_.size());
    for (std::size_t i = 0; i < batch.pixels.size(); ++i) {
        const images::Rgb from_mean = batch.pixels[i] - moments_.mean.pixels[i];
        cubes_.pixels[i] += from_mean * (from_mean * from_mean * ((n - 1.0) * (n - 2.0) / (n * n)) -
                                         3.0 / n * moments_.squares.pixels[i]);
        moments_.mean.pixels[i] += from_mean / n;
        moments_.squares.pixels[i] += from_mean * (batch.pixels[i] - moments_.mean.pixels[i]);
    }
}

} // namespace golden
