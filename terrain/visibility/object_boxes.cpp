#include "terrain/visibility/object_boxes.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

constexpr std::size_t facets_per_part = 64;
constexpr float no_sky = 1e30f;
// Origins of rays are lifted off their facets and rounded.
constexpr float margin_around = 0.02f;                         // [m]
constexpr auto disc_radius = float(1.1 * sun_angular_radius);  // [rad]

/// Raises the sectors in which a box is seen from anywhere in another.
void raise_by(const Eigen::AlignedBox3f& box, const Eigen::AlignedBox3f& from, OpenAbove& skyline) {
    const float rise = box.max().z() - from.min().z() + margin_around;
    if (rise <= 0.0f) return;
    // Seen from the middle of `from`, a box larger by its extent.
    const Eigen::Vector2f to = (box.center() - from.center()).head<2>();
    const Eigen::Vector2f half =
        0.5f * (box.sizes() + from.sizes()).head<2>() + Eigen::Vector2f::Constant(margin_around);
    const Eigen::Vector2f gap = (to.cwiseAbs() - half).cwiseMax(0.0f);
    const float away = gap.norm();
    if (away < margin_around) {
        skyline.fill(no_sky);
        return;
    }
    const float tangent = rise / away;
    const float middle = square_angle(to.x(), to.y());
    float least = 0.0f, most = 0.0f;
    for (int corner = 0; corner < 4; ++corner) {
        const Eigen::Vector2f at = to + Eigen::Vector2f(corner & 1 ? half.x() : -half.x(),
                                                        corner & 2 ? half.y() : -half.y());
        float turn = square_angle(at.x(), at.y()) - middle;
        turn -= 4.0f * std::round(0.25f * turn);
        least = std::min(least, turn);
        most = std::max(most, turn);
    }
    constexpr float per_side = compass_sectors / 4;
    constexpr float rounded = 1e-3f;
    const int first = static_cast<int>(std::floor((middle + least) * per_side - rounded));
    const int last = static_cast<int>(std::floor((middle + most) * per_side + rounded));
    constexpr int all = int(compass_sectors);
    for (int s = first; s <= std::min(last, first + all - 1); ++s) {
        float& here = skyline[static_cast<std::size_t>((s + 2 * all) % all)];
        here = std::max(here, tangent);
    }
}

/// Whether a box may be in the way from anywhere in another to any point of the sun's disc.
bool in_the_way(const Eigen::AlignedBox3f& box, const Eigen::AlignedBox3f& from,
                const Eigen::Vector3f& to_sun) {
    const float level = to_sun.head<2>().norm();
    const Eigen::Vector2f half =
        0.5f * (box.sizes() + from.sizes()).head<2>() + Eigen::Vector2f::Constant(margin_around);
    const Eigen::Vector2f to = (box.center() - from.center()).head<2>();
    if (level < 4.0f * disc_radius) return true;  // at the zenith
    const Eigen::Vector2f way = to_sun.head<2>() / level;
    const float along = to.dot(way), along_half = half.dot(way.cwiseAbs());
    const float farthest = along + along_half;
    if (farthest < 0.0f) return false;
    const float aside = std::abs(to.x() * way.y() - to.y() * way.x());
    const float aside_half = half.x() * std::abs(way.y()) + half.y() * std::abs(way.x());
    if (aside > aside_half + farthest * disc_radius / level) return false;
    const float nearest = std::max(0.0f, along - along_half);
    const float lowest = std::tan(std::max(0.0f, std::asin(to_sun.z()) - disc_radius));
    return from.min().z() + nearest * lowest < box.max().z() + margin_around;
}

}  // namespace

Eigen::AlignedBox3f box_around(const FacetSet& facets, std::size_t facet) {
    Eigen::AlignedBox3f box;
    for (const std::uint32_t v : facets.corner[facet]) box.extend(facets.vertex[v]);
    return box;
}

ObjectBoxes::ObjectBoxes(const FacetSet& facets, std::size_t first_object, const Copies& copies) {
    for (std::size_t f = first_object; f < facets.size();) {
        Object object{.box = {}, .first = part_.size(), .last = 0};
        const ObjectId id = facets.object[f];
        while (f < facets.size() && facets.object[f] == id) {
            Eigen::AlignedBox3f part;
            for (std::size_t k = 0;
                 k < facets_per_part && f < facets.size() && facets.object[f] == id; ++k, ++f) {
                part.extend(box_around(facets, f));
            }
            object.box.extend(part);
            part_.push_back(part);
        }
        object.last = part_.size();
        object_.push_back(object);
    }
    for (std::size_t c = 0; c < copies.size(); ++c) {
        part_.push_back(copies.box(facets, c).cast<float>());
        object_.push_back({part_.back(), part_.size() - 1, part_.size()});
    }
}

void ObjectBoxes::raise(const Eigen::AlignedBox3f& from, std::span<const std::uint32_t> among,
                        OpenAbove& skyline) const {
    for (const std::uint32_t number : among) {
        const Object& object = object_[number];
        const float away = std::sqrt(object.box.squaredExteriorDistance(from));
        if (object.last - object.first == 1 || away > 2.0f * object.box.sizes().maxCoeff()) {
            raise_by(object.box, from, skyline);
            continue;
        }
        for (std::size_t p = object.first; p < object.last; ++p) raise_by(part_[p], from, skyline);
    }
}

std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> ObjectBoxes::far_and_near(
    const Eigen::AlignedBox3f& from) const {
    constexpr float far_away = 16.0f;  // of either box's width
    std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> found;
    for (std::uint32_t number = 0; number < object_.size(); ++number) {
        const Eigen::AlignedBox3f& box = object_[number].box;
        const float wide = std::max(box.sizes().maxCoeff(), from.sizes().maxCoeff());
        const bool is_far = box.squaredExteriorDistance(from) > std::pow(far_away * wide, 2.0f);
        (is_far ? found.first : found.second).push_back(number);
    }
    return found;
}

void ObjectBoxes::shading(const Eigen::AlignedBox3f& from, const Eigen::Vector3f& to_sun,
                          std::span<const std::uint32_t> among,
                          std::vector<std::uint32_t>& found) const {
    found.clear();
    for (const std::uint32_t number : among) {
        if (in_the_way(object_[number].box, from, to_sun)) found.push_back(number);
    }
}

bool ObjectBoxes::may_shade(const Eigen::AlignedBox3f& from, const Eigen::Vector3f& to_sun,
                            std::span<const std::uint32_t> among) const {
    return std::any_of(among.begin(), among.end(), [&](std::uint32_t number) {
        const Object& object = object_[number];
        if (!in_the_way(object.box, from, to_sun)) return false;
        return std::any_of(
            part_.begin() + std::ptrdiff_t(object.first),
            part_.begin() + std::ptrdiff_t(object.last),
            [&](const Eigen::AlignedBox3f& part) { return in_the_way(part, from, to_sun); });
    });
}

}  // namespace diurna
