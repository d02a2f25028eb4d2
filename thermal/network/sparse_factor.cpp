#include "thermal/network/sparse_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;
constexpr std::uint32_t to_all = 0xFFFFFFFEu;

/// Column pointers and rows of a matrix.
std::vector<int> pattern_of(const Eigen::SparseMatrix<float>& matrix) {
    std::vector<int> pattern(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1);
    pattern.insert(pattern.end(), matrix.innerIndexPtr(),
                   matrix.innerIndexPtr() + matrix.nonZeros());
    return pattern;
}

}  // namespace

/// Puts unknowns in groups by whole subtrees; the tops of subtrees that are too large are common.
SparseFactor::Order SparseFactor::group(const std::vector<std::uint32_t>& parent,
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
    Order order;
    for (std::size_t j = 0; j < size; ++j) {
        order[of[j] == to_all ? groups : of[j]].push_back(std::uint32_t(j));
    }
    return order;
}

/// Unknowns by level, those with the most entries first, so that lanes are about equally long.
SparseFactor::Sweep SparseFactor::sweep(std::vector<std::uint32_t> unknowns,
                                        const std::vector<std::uint32_t>& level,
                                        const Entries& entries, std::uint32_t unused) {
    std::stable_sort(unknowns.begin(), unknowns.end(), [&](std::uint32_t a, std::uint32_t b) {
        return level[a] != level[b] ? level[a] < level[b] : entries[a].size() > entries[b].size();
    });
    Sweep all;
    all.first.push_back(0);
    for (std::size_t begin = 0; begin < unknowns.size();) {
        std::size_t end = begin + 1;
        while (end < std::min(unknowns.size(), begin + lanes) &&
               level[unknowns[end]] == level[unknowns[begin]]) {
            ++end;
        }
        const std::size_t longest = entries[unknowns[begin]].size(), base = all.at.size();
        all.at.resize(base + longest * lanes, unused);
        all.value.resize(all.value.size() + longest, Lanes{});
        for (std::size_t l = 0; l < lanes; ++l) {
            all.unknown.push_back(begin + l < end ? unknowns[begin + l] : unused);
            if (begin + l >= end) continue;
            const std::vector<Entry>& own = entries[unknowns[begin + l]];
            for (std::size_t k = 0; k < own.size(); ++k) {
                all.at[base + k * lanes + l] = own[k].at;
                all.value[base / lanes + k][l] = own[k].value;
            }
        }
        all.first.push_back(std::uint32_t(all.at.size() / lanes));
        begin = end;
    }
    return all;
}

/// A level is one above those of all that an unknown depends on within its group; the common
/// ones come after all groups on the way down, and before them on the way up.
void SparseFactor::build(const Order& order, const Entries& rows, const Entries& columns) {
    const std::size_t size = rows.size();
    std::vector<std::uint32_t> group_of(size), level(size, 0);
    for (std::size_t g = 0; g <= groups; ++g) {
        for (const std::uint32_t j : order[g]) group_of[j] = std::uint32_t(g);
    }
    const auto set_level = [&](std::size_t j, const Entries& entries) {
        std::uint32_t above = 0;
        for (const Entry& entry : entries[j]) {
            if (group_of[entry.at] == group_of[j]) above = std::max(above, level[entry.at] + 1);
        }
        level[j] = above;
    };
    for (std::size_t j = 0; j < size; ++j) set_level(j, rows);
    for (std::size_t g = 0; g <= groups; ++g) {
        down_[g] = sweep(order[g], level, rows, std::uint32_t(size + g));
    }
    for (std::size_t j = size; j-- > 0;) set_level(j, columns);
    for (std::size_t g = 0; g <= groups; ++g) {
        up_[g] = sweep(order[g], level, columns, std::uint32_t(size + g));
    }
}

bool SparseFactor::factorise(const Eigen::SparseMatrix<float>& lower) {
    std::vector<int> pattern = pattern_of(lower);
    if (pattern != pattern_) {
        factor_.analyzePattern(lower);
        pattern_ = std::move(pattern);
    }
    factor_.factorize(lower);
    return factor_.info() == Eigen::Success;
}

void SparseFactor::compute(const Eigen::SparseMatrix<float>& lower) {
    constexpr float least = 0.003f;
    const auto size = std::size_t(lower.rows());
    place_.resize(size);
    inverse_.assign(size + groups + 1, 0.0f);
    work_.assign(size + groups + 1, 0.0f);
    std::vector<std::uint32_t> parent(size, none), entries(size, 0);
    Entries rows(size), columns(size);
    if (!factorise(lower)) {
        std::iota(place_.begin(), place_.end(), 0u);
        for (std::size_t k = 0; k < size; ++k) inverse_[k] = 1.0f / lower.coeff(int(k), int(k));
        build(group(parent, entries), rows, columns);
        return;
    }
    const auto& diagonal = factor_.vectorD();
    const Eigen::SparseMatrix<float>& l = factor_.matrixL().nestedExpression();
    for (Eigen::Index j = 0; j < l.cols(); ++j) {
        for (Eigen::SparseMatrix<float>::InnerIterator at(l, j); at; ++at) {
            if (at.row() <= j) continue;
            const auto row = std::uint32_t(at.row()), column = std::uint32_t(j);
            parent[column] = std::min(parent[column], row);
            // As large as it is once both diagonals are one.
            if (!(std::abs(at.value()) * std::sqrt(diagonal[j] / diagonal[at.row()]) > least)) {
                continue;
            }
            columns[column].push_back({row, at.value()});
            rows[row].push_back({column, at.value()});
            ++entries[column];
        }
    }
    build(group(parent, entries), rows, columns);
    for (std::size_t k = 0; k < size; ++k) {
        inverse_[k] = 1.0f / diagonal[Eigen::Index(k)];
        place_[k] = std::uint32_t(factor_.permutationP().indices()[Eigen::Index(k)]);
    }
}

void SparseFactor::run(const Sweep& sweep, const float* scale) {
    float* const work = work_.data();
    for (std::size_t c = 0; c < sweep.chunks(); ++c) {
        const std::uint32_t* const unknown = &sweep.unknown[c * lanes];
        Lanes x{};
        for (std::size_t l = 0; l < lanes; ++l) x[l] = work[unknown[l]];
        if (scale != nullptr) {
            for (std::size_t l = 0; l < lanes; ++l) x[l] *= scale[unknown[l]];
        }
        for (std::size_t k = sweep.first[c]; k < sweep.first[c + 1]; ++k) {
            const std::uint32_t* const at = &sweep.at[k * lanes];
            Lanes known{};
            for (std::size_t l = 0; l < lanes; ++l) known[l] = work[at[l]];
            x -= sweep.value[k] * known;
        }
        for (std::size_t l = 0; l < lanes; ++l) work[unknown[l]] = x[l];
    }
}

void SparseFactor::solve(const std::vector<double>& r, std::vector<double>& z) {
    const std::size_t size = r.size();
    double large = 1e-300;  // scaled, for what is left may be as small as no float is
    for (const double one : r) large = std::max(large, std::abs(one));
    const double scale = 1.0 / large;
    for (std::size_t k = 0; k < size; ++k) work_[place_[k]] = float(scale * r[k]);
    for_each_index(
        groups, [&](std::size_t g) { run(down_[g], nullptr); }, 1);
    run(down_[groups], nullptr);
    run(up_[groups], inverse_.data());
    for_each_index(
        groups, [&](std::size_t g) { run(up_[g], inverse_.data()); }, 1);
    for (std::size_t k = 0; k < size; ++k) z[k] = large * double(work_[place_[k]]);
}

}  // namespace diurna
