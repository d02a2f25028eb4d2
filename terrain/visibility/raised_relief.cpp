#include "terrain/visibility/raised_relief.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace diurna {

namespace {

/// An object's box, in (column, row) of the relief.
struct ObjectBox {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e30);
    Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e30);
    float top = -1e30f;  // [m]
};

std::map<ObjectId, ObjectBox> object_boxes(const FacetSet& facets, const HeightField& relief,
                                           std::size_t ground_facets, const Copies& copies) {
    std::map<ObjectId, ObjectBox> boxes;
    const auto grow = [&](ObjectBox& box, const Eigen::Vector3f& v) {
        const Eigen::Vector2d p = relief.post(v.head<2>().cast<double>());
        box.low = box.low.cwiseMin(p);
        box.high = box.high.cwiseMax(p);
        box.top = std::max(box.top, v.z());
    };
    for (std::size_t f = ground_facets; f < facets.size(); ++f) {
        ObjectBox& box = boxes[facets.object[f]];
        for (const std::uint32_t corner : facets.corner[f]) grow(box, facets.vertex[corner]);
    }
    for (std::size_t c = 0; c < copies.size(); ++c) {
        const Eigen::AlignedBox3f around = copies.box(facets, c).cast<float>();
        for (int corner = 0; corner < 8; ++corner) {
            grow(boxes[copies[c].object],
                 around.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)));
        }
    }
    return boxes;
}

}  // namespace

RaisedRelief raised_relief(const FacetSet& facets, const HeightField& relief,
                           std::size_t ground_facets, const Copies& copies) {
    const int columns = relief.columns(), rows = relief.rows();
    std::vector<float> up(relief.size());
    std::vector<std::uint8_t> touched(relief.size(), 0);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float h = relief.up(row, column);
            up[std::size_t(row) * columns + column] = h == no_ground ? std::nanf("") : h;
        }
    }
    for (const auto& [id, box] : object_boxes(facets, relief, ground_facets, copies)) {
        const auto first = [](double x) { return std::max(0, int(std::floor(x)) - 1); };
        const int last_column = std::min(columns - 1, int(std::ceil(box.high.x())) + 1);
        const int last_row = std::min(rows - 1, int(std::ceil(box.high.y())) + 1);
        for (int row = first(box.low.y()); row <= last_row; ++row) {
            for (int column = first(box.low.x()); column <= last_column; ++column) {
                float& h = up[std::size_t(row) * columns + column];
                if (!(h >= box.top)) h = box.top;
                touched[std::size_t(row) * columns + column] = 1;
            }
        }
    }
    return {relief.with_heights(up), std::move(touched)};
}

}  // namespace diurna
