#include "thermal/network/sparse_factor.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;
constexpr std::uint32_t to_all = 0xFFFFFFFEu;

}  // namespace

/// Puts unknowns in groups by whole subtrees; the tops of subtrees that are too large are common.
/// Sets place_ (unknown of the factor) and group_.
void SparseFactor::group(const std::vector<std::uint32_t>& parent,
                         const std::vector<std::uint32_t>& entries) {
    const std::size_t size = parent.size();
    std::vector<std::uint64_t> weight(entries.begin(), entries.end());  // of subtrees
    for (std::size_t j = 0; j < size; ++j) ++weight[j];
    std::uint64_t all = 0;
    for (std::size_t j = 0; j < size; ++j) {  // children come before parents
        if (parent[j] == none) {
            all += weight[j];
        } else {
            weight[parent[j]] += weight[j];
        }
    }
    const std::uint64_t large = all / (4 * groups);
    // From the roots down: common as long as what hangs there is too large to be dealt out.
    std::vector<std::uint32_t> of(size, none), root;
    for (std::size_t j = size; j-- > 0;) {
        const bool top = parent[j] == none || of[parent[j]] == to_all;
        if (top && weight[j] > large) {
            of[j] = to_all;
        } else if (top) {
            root.push_back(std::uint32_t(j));
        }
    }
    std::stable_sort(root.begin(), root.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return weight[a] > weight[b]; });
    std::array<std::uint64_t, groups> load{};
    for (const std::uint32_t r : root) {
        const auto least = std::min_element(load.begin(), load.end());
        *least += weight[r];
        of[r] = std::uint32_t(least - load.begin());
    }
    for (std::size_t j = size; j-- > 0;) {
        if (of[j] == none) of[j] = of[parent[j]];
    }
    std::array<std::size_t, groups + 1> count{};
    for (const std::uint32_t g : of) ++count[g == to_all ? groups : g];
    std::size_t next = 0;
    for (std::size_t g = 0; g <= groups; ++g) {
        group_[g] = next;
        next += count[g];
    }
    std::array<std::size_t, groups + 1> at = group_;
    place_.resize(size);
    for (std::size_t j = 0; j < size; ++j) {
        place_[j] = std::uint32_t(at[of[j] == to_all ? groups : of[j]]++);
    }
}

void SparseFactor::compute(const Eigen::SparseMatrix<float>& lower) {
    constexpr float least = 0.003f;
    const auto size = std::size_t(lower.rows());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<float>> factor(lower);
    place_.resize(size);
    column_.assign(1, 0);
    shared_.clear();
    row_.clear();
    entry_.clear();
    inverse_.resize(size);
    work_.resize(size);
    if (factor.info() != Eigen::Success) {
        std::iota(place_.begin(), place_.end(), 0u);
        group_.fill(0);
        column_.assign(size + 1, 0);
        shared_.assign(size, 0);
        for (std::size_t k = 0; k < size; ++k) inverse_[k] = 1.0f / lower.coeff(int(k), int(k));
        return;
    }
    const auto& diagonal = factor.vectorD();
    const Eigen::SparseMatrix<float>& l = factor.matrixL().nestedExpression();
    struct Entry {
        std::uint32_t row;
        float value;
    };
    std::vector<std::vector<Entry>> kept(size);
    std::vector<std::uint32_t> parent(size, none), entries(size, 0);
    for (Eigen::Index j = 0; j < l.cols(); ++j) {
        for (Eigen::SparseMatrix<float>::InnerIterator at(l, j); at; ++at) {
            if (at.row() <= j) continue;
            const auto row = std::uint32_t(at.row()), column = std::uint32_t(j);
            parent[column] = std::min(parent[column], row);
            // As large as it is once both diagonals are one.
            if (!(std::abs(at.value()) * std::sqrt(diagonal[j] / diagonal[at.row()]) > least)) {
                continue;
            }
            kept[column].push_back({row, at.value()});
            ++entries[column];
        }
    }
    group(parent, entries);
    std::vector<std::uint32_t> of_place(size);
    for (std::size_t j = 0; j < size; ++j) of_place[place_[j]] = std::uint32_t(j);
    for (std::size_t k = 0; k < size; ++k) {
        std::vector<Entry>& column = kept[of_place[k]];
        for (Entry& entry : column) entry.row = place_[entry.row];
        std::sort(column.begin(), column.end(),
                  [](const Entry& a, const Entry& b) { return a.row < b.row; });
        shared_.push_back(std::uint32_t(row_.size()));
        for (const Entry& entry : column) {
            if (entry.row < common()) ++shared_.back();
            row_.push_back(entry.row);
            entry_.push_back(entry.value);
        }
        column_.push_back(std::uint32_t(row_.size()));
        inverse_[k] = 1.0f / diagonal[Eigen::Index(of_place[k])];
    }
    for (std::vector<float>& to : to_common_) to.resize(size - common());
    // From rows of the matrix: first to the factor's order, then to that of groups.
    const std::vector<std::uint32_t> of_factor = place_;
    for (std::size_t k = 0; k < size; ++k) {
        place_[k] = of_factor[std::size_t(factor.permutationP().indices()[Eigen::Index(k)])];
    }
}

void SparseFactor::forward(std::size_t group) {
    std::vector<float>& to_common = to_common_[group];
    std::fill(to_common.begin(), to_common.end(), 0.0f);
    const std::size_t first_common = common();
    for (std::size_t j = group_[group]; j < group_[group + 1]; ++j) {
        const float x = work_[j];
        for (std::uint32_t k = column_[j]; k < shared_[j]; ++k) work_[row_[k]] -= entry_[k] * x;
        for (std::uint32_t k = shared_[j]; k < column_[j + 1]; ++k) {
            to_common[row_[k] - first_common] -= entry_[k] * x;
        }
    }
}

void SparseFactor::backward(std::size_t begin, std::size_t end) {
    for (std::size_t j = end; j-- > begin;) {
        float x = work_[j] * inverse_[j];
        for (std::uint32_t k = column_[j]; k < column_[j + 1]; ++k) x -= entry_[k] * work_[row_[k]];
        work_[j] = x;
    }
}

void SparseFactor::solve(const std::vector<double>& r, std::vector<double>& z) {
    const std::size_t size = r.size();
    double large = 1e-300;  // scaled, for what is left may be as small as no float is
    for (const double one : r) large = std::max(large, std::abs(one));
    const double scale = 1.0 / large;
    for (std::size_t k = 0; k < size; ++k) work_[place_[k]] = float(scale * r[k]);
    for_each_index(
        groups, [&](std::size_t g) { forward(g); }, 1);
    const std::size_t first = common();
    if (first > 0) {
        for (const std::vector<float>& to_common : to_common_) {
            for (std::size_t k = first; k < size; ++k) work_[k] += to_common[k - first];
        }
    }
    for (std::size_t j = first; j < size; ++j) {
        const float x = work_[j];
        for (std::uint32_t k = column_[j]; k < column_[j + 1]; ++k) work_[row_[k]] -= entry_[k] * x;
    }
    backward(first, size);
    for_each_index(
        groups, [&](std::size_t g) { backward(group_[g], group_[g + 1]); }, 1);
    for (std::size_t k = 0; k < size; ++k) z[k] = large * double(work_[place_[k]]);
}

}  // namespace diurna
