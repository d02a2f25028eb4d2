#include "terrain/ground/ring_index.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <utility>

namespace diurna {

namespace {

namespace bg = boost::geometry;

using Point = bg::model::point<double, 2, bg::cs::cartesian>;
using Entry = std::pair<bg::model::box<Point>, std::int32_t>;

std::vector<Entry> entries(const std::vector<Ring>& rings) {
    std::vector<Entry> all;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        if (rings[i].empty()) continue;
        const RingExtent extent(rings[i]);
        all.push_back({{{extent.low.x(), extent.low.y()}, {extent.high.x(), extent.high.y()}},
                       std::int32_t(i)});
    }
    return all;
}

}  // namespace

struct RingIndex::Tree {
    bg::index::rtree<Entry, bg::index::quadratic<16>> boxes;
};

RingIndex::RingIndex(std::vector<Ring> rings)
    : rings_(std::move(rings)), tree_(new Tree{decltype(Tree::boxes)(entries(rings_))}) {}

RingIndex::~RingIndex() = default;

std::int32_t RingIndex::last_around(const Eigen::Vector2d& p) const {
    std::int32_t last = -1;
    for (auto it = tree_->boxes.qbegin(bg::index::intersects(Point(p.x(), p.y())));
         it != tree_->boxes.qend(); ++it) {
        if (it->second > last && contains(rings_[std::size_t(it->second)], p)) last = it->second;
    }
    return last;
}

}  // namespace diurna
