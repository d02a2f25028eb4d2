#include "terrain/objects/near_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace diurna {

namespace {

/// Vertices that keep their place, by cells of twice the tolerance.
class Cells {
 public:
    Cells(std::size_t vertices, const Eigen::Vector3d& low, double size)
        : low_(low), size_(size), next_(vertices, none) {
        head_.reserve(vertices);
    }
    void put(std::uint32_t vertex, const Eigen::Vector3d& at) {
        std::uint32_t& head = head_.try_emplace(key(cell(at)), none).first->second;
        next_[vertex] = head;
        head = vertex;
    }
    /// Calls body(vertex) for those in the eight cells about a place.
    template <class Body>
    void each_near(const Eigen::Vector3d& at, const Body& body) const {
        const Eigen::Vector3d shift = Eigen::Vector3d::Constant(0.5 * size_);
        const Eigen::Array<std::int64_t, 3, 1> first = cell(at - shift);
        for (std::int64_t k = 0; k < 8; ++k) {
            const Eigen::Array<std::int64_t, 3, 1> here{first[0] + (k & 1), first[1] + (k >> 1 & 1),
                                                        first[2] + (k >> 2)};
            const auto found = head_.find(key(here));
            if (found == head_.end()) continue;
            for (std::uint32_t v = found->second; v != none; v = next_[v]) body(v);
        }
    }

 private:
    static constexpr auto none = std::uint32_t(-1);
    Eigen::Array<std::int64_t, 3, 1> cell(const Eigen::Vector3d& at) const {
        return ((at - low_) / size_).array().floor().cast<std::int64_t>();
    }
    /// Cells that share a key cost a comparison of distances, no more.
    static std::uint64_t key(const Eigen::Array<std::int64_t, 3, 1>& cell) {
        std::uint64_t key = 0;
        for (int k = 0; k < 3; ++k) {
            key = (key ^ std::uint64_t(cell[k])) * 0x9e3779b97f4a7c15u;
            key ^= key >> 29;
        }
        return key;
    }

    Eigen::Vector3d low_;
    double size_;
    std::vector<std::uint32_t> next_;
    std::unordered_map<std::uint64_t, std::uint32_t> head_;
};

}  // namespace

std::vector<std::uint32_t> near_vertices(std::span<const Eigen::Vector3d> vertex,
                                         std::span<const double> shortest, double tolerance) {
    std::vector<std::uint32_t> into(vertex.size());
    for (std::uint32_t v = 0; v < into.size(); ++v) into[v] = v;
    if (vertex.empty() || !(tolerance > 0.0)) return into;
    Eigen::Vector3d low = vertex[0];
    for (const Eigen::Vector3d& at : vertex) low = low.cwiseMin(at);
    Cells cells(vertex.size(), low, 2.0 * tolerance);
    for (std::uint32_t v = 0; v < vertex.size(); ++v) {
        if (shortest[v] < 0.0) continue;
        double nearest = tolerance;
        cells.each_near(vertex[v], [&](std::uint32_t other) {
            const double apart = (vertex[other] - vertex[v]).norm();
            if (apart > nearest || apart > 0.25 * std::min(shortest[v], shortest[other])) return;
            if (apart == nearest && into[v] != v) return;
            nearest = apart;
            into[v] = other;
        });
        if (into[v] == v) cells.put(v, vertex[v]);
    }
    return into;
}

}  // namespace diurna
