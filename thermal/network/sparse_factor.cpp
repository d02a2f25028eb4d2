#include "thermal/network/sparse_factor.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <numeric>

namespace diurna {

void SparseFactor::compute(const Eigen::SparseMatrix<float>& lower) {
    constexpr float least = 0.003f;
    const auto size = std::size_t(lower.rows());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<float>> factor(lower);
    place_.resize(size);
    column_.assign(1, 0);
    row_.clear();
    entry_.clear();
    inverse_.resize(size);
    work_.resize(size);
    if (factor.info() != Eigen::Success) {
        std::iota(place_.begin(), place_.end(), 0u);
        column_.assign(size + 1, 0);
        for (std::size_t k = 0; k < size; ++k) inverse_[k] = 1.0f / lower.coeff(int(k), int(k));
        return;
    }
    for (std::size_t k = 0; k < size; ++k) {
        place_[k] = std::uint32_t(factor.permutationP().indices()[Eigen::Index(k)]);
    }
    const auto& diagonal = factor.vectorD();
    const Eigen::SparseMatrix<float>& l = factor.matrixL().nestedExpression();
    for (Eigen::Index j = 0; j < l.cols(); ++j) {
        for (Eigen::SparseMatrix<float>::InnerIterator at(l, j); at; ++at) {
            if (at.row() <= j) continue;
            // As large as it is once both diagonals are one.
            if (!(std::abs(at.value()) * std::sqrt(diagonal[j] / diagonal[at.row()]) > least)) {
                continue;
            }
            row_.push_back(std::uint32_t(at.row()));
            entry_.push_back(at.value());
        }
        column_.push_back(std::uint32_t(row_.size()));
        inverse_[std::size_t(j)] = 1.0f / diagonal[j];
    }
}

void SparseFactor::solve(const std::vector<double>& r, std::vector<double>& z) {
    const std::size_t size = r.size();
    double large = 1e-300;  // scaled, for what is left may be as small as no float is
    for (const double one : r) large = std::max(large, std::abs(one));
    const double scale = 1.0 / large;
    for (std::size_t k = 0; k < size; ++k) work_[place_[k]] = float(scale * r[k]);
    for (std::size_t j = 0; j < size; ++j) {
        const float x = work_[j];
        for (std::uint32_t k = column_[j]; k < column_[j + 1]; ++k) work_[row_[k]] -= entry_[k] * x;
    }
    for (std::size_t j = size; j-- > 0;) {
        float x = work_[j] * inverse_[j];
        for (std::uint32_t k = column_[j]; k < column_[j + 1]; ++k) x -= entry_[k] * work_[row_[k]];
        work_[j] = x;
    }
    for (std::size_t k = 0; k < size; ++k) z[k] = large * double(work_[place_[k]]);
}

}  // namespace diurna
