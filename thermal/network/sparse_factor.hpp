#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// Incomplete L D Lᵀ of a symmetric positive definite matrix, without negligible entries of L, as a
/// preconditioner of conjugate gradients: for 10 000 triangles of a steel sheet a quarter of the
/// entries and half as many iterations more. Unknowns coupled only through the last ones (subtrees
/// of L's elimination tree) form groups, which are solved in parallel.
class SparseFactor {
 public:
    /// Of the lower half. Does not throw: without a factor the diagonal is used.
    void compute(const Eigen::SparseMatrix<float>& lower);
    /// z = (L D Lᵀ)⁻¹ r
    void solve(const std::vector<double>& r, std::vector<double>& z);

 private:
    static constexpr std::size_t groups = 4;
    void group(const std::vector<std::uint32_t>& parent, const std::vector<std::uint32_t>& entries);
    void forward(std::size_t group);
    void backward(std::size_t begin, std::size_t end);
    std::size_t common() const { return group_[groups]; }

    std::vector<std::uint32_t> place_;  // (row of the matrix) in the factor
    /// First index of each group, then of the rows common to all.
    std::array<std::size_t, groups + 1> group_{};
    std::vector<std::uint32_t> column_;  // (size + 1) into the entries below the diagonal
    std::vector<std::uint32_t> shared_;  // (size) the same: entries from there on are common rows
    std::vector<std::uint32_t> row_;
    std::vector<float> entry_, inverse_, work_;
    std::array<std::vector<float>, groups> to_common_;  // contribution of each group to these
};

}  // namespace diurna
