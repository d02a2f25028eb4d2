#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <vector>

namespace diurna {

/// Incomplete L D Lᵀ of a symmetric positive definite matrix, without negligible entries of L, as a
/// preconditioner of conjugate gradients: for 10 000 triangles of a steel sheet a quarter of the
/// entries and half as many iterations more. Unknowns coupled only through the last ones (subtrees
/// of L's elimination tree) form groups, which are solved in parallel; within a group, those that
/// do not depend on one another are solved side by side.
class SparseFactor {
 public:
    /// Of the lower half. Does not throw: without a factor the diagonal is used. The order of
    /// elimination is kept while the pattern stays.
    void compute(const Eigen::SparseMatrix<float>& lower);
    /// z = (L D Lᵀ)⁻¹ r
    void solve(const std::vector<double>& r, std::vector<double>& z);

 private:
    static constexpr std::size_t groups = 4, lanes = 8;
    using Lanes [[gnu::vector_size(4 * lanes)]] = float;
    /// Off-diagonal entries of L: (unknown) its row, or its column.
    struct Entry {
        std::uint32_t at;
        float value;
    };
    using Entries = std::vector<std::vector<Entry>>;
    /// The unknowns of a group, or those common to all, in chunks of `lanes` that do not depend on
    /// one another; entries of a chunk [entry][lane], zero where a lane has fewer.
    struct Sweep {
        std::vector<std::uint32_t> unknown;  // (chunk, lane); an unused slot where there are fewer
        std::vector<std::uint32_t> first;    // (chunk + 1) entry
        std::vector<std::uint32_t> at;       // (entry, lane)
        std::vector<Lanes> value;            // (entry)
        std::size_t chunks() const { return first.size() - 1; }
    };
    using Order = std::array<std::vector<std::uint32_t>, groups + 1>;

    bool factorise(const Eigen::SparseMatrix<float>& lower);
    /// (group) its unknowns, ascending; last those common to all.
    static Order group(const std::vector<std::uint32_t>& parent,
                       const std::vector<std::uint32_t>& entries);
    static Sweep sweep(std::vector<std::uint32_t> unknowns, const std::vector<std::uint32_t>& level,
                       const Entries& entries, std::uint32_t unused);
    void build(const Order& order, const Entries& rows, const Entries& columns);
    void run(const Sweep& sweep, const float* scale);

    Eigen::SimplicialLDLT<Eigen::SparseMatrix<float>> factor_;
    std::vector<int> pattern_;                     // of the matrix that factor_ is ordered for
    std::vector<std::uint32_t> place_;             // (row of the matrix) unknown of the factor
    std::array<Sweep, groups + 1> down_{}, up_{};  // (group, then the common ones)
    std::vector<float> inverse_, work_;            // (unknown, then one unused slot for each sweep)
};

}  // namespace diurna
