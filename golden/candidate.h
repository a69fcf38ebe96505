#pragma once

// The candidate of a comparison, batch by batch.

#include "golden/functionals.h"
#include "images/film.h"

#include <cstdint>
#include <vector>

namespace golden {

/// The batches of one stage of a candidate, each as its mean per pixel and as the values of a golden's
/// functionals. The functionals must outlive it.
class Candidate {
public:
    explicit Candidate(const Functionals& functionals);

    /// Adds one batch: for Method::ranks the mean of as many samples as the golden's batches are, else
    /// one of several independent pictures, each equally good. Throws std::invalid_argument if its size
    /// differs from the golden's or a pixel is NaN or infinite; the message names no file.
    void add_batch(const images::Image& batch);

    [[nodiscard]] std::uint64_t batches() const { return rows_.size(); }
    /// Of the batches, per pixel.
    [[nodiscard]] const images::BatchMoments& moments() const { return moments_; }
    [[nodiscard]] const images::Image& mean() const { return moments_.mean; }
    /// Sums over the batches of (batch - mean)^3, per pixel.
    [[nodiscard]] const images::Image& cubes() const { return cubes_; }
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
    [[nodiscard]] const Functionals& functionals() const { return *functionals_; }

private:
    const Functionals* functionals_;
    images::BatchMoments moments_;
    images::Image cubes_;
    std::vector<Row> rows_;
};

} // namespace golden
