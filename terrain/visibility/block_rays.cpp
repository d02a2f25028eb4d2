#include "terrain/visibility/block_rays.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace diurna {

void RayQueue::take(std::size_t count, RayPacket& rays, std::array<std::uint32_t, 16>& owners) {
    const auto first = [&](auto& all, auto& some) {
        std::copy_n(all.begin(), 16, some.begin());
        std::copy_n(all.begin() + 16, 16, all.begin());
    };
    first(origin_x, rays.origin_x);
    first(origin_y, rays.origin_y);
    first(origin_z, rays.origin_z);
    first(direction_x, rays.direction_x);
    first(direction_y, rays.direction_y);
    first(direction_z, rays.direction_z);
    first(owner, owners);
    size -= count;
}

void BlockRays::trace(const RayPacket& rays, int lanes, std::uint32_t from,
                      const SkyBound::Sines& sines, const OpenAbove* skyline) {
    const auto doubtful = [&](std::size_t k) {
        const float east = rays.direction_x[k], north = rays.direction_y[k];
        const float up = rays.direction_z[k];
        if (up > sines[compass_octant(east, north)]) return false;
        if (skyline == nullptr) return true;
        return up <= (*skyline)[compass_sector(east, north)] * std::hypot(east, north);
    };
    const auto count = static_cast<std::size_t>(lanes);
    const std::size_t before = doubtful_.size;
    std::size_t down = 0;
    for (std::size_t k = 0; k < count; ++k) {
        // What goes down almost surely meets something: the nearest is searched at once.
        const bool goes_down = nearest_ && rays.direction_z[k] < 0.0f;
        blocked_.put(rays, k, from, goes_down);
        down += goes_down ? 1 : 0;
        doubtful_.put(rays, k, from, !goes_down && doubtful(k));
    }
    sky[from] += lanes - static_cast<int>(down + doubtful_.size - before);
    while (blocked_.size >= 16) ask_which(16);
    if (doubtful_.size >= 16) ask_whether(16);
}

void BlockRays::finish() {
    if (doubtful_.size > 0) ask_whether(doubtful_.size);
    if (blocked_.size > 0) ask_which(blocked_.size);
    sort_by_owner();
}

void BlockRays::sort_by_owner() {
    std::array<std::uint32_t, facets_per_block + 1> place{};
    for (const std::uint32_t of : owner) ++place[of + 1];
    std::partial_sum(place.begin(), place.end(), place.begin());
    std::vector<std::uint32_t> sorted_owner(owner.size());
    std::vector<Seen> sorted(seen.size(), Seen{0, 0.0f});
    for (std::size_t k = 0; k < owner.size(); ++k) {
        const std::uint32_t to = place[owner[k]]++;
        sorted_owner[to] = owner[k];
        sorted[to] = seen[k];
    }
    owner.swap(sorted_owner);
    seen.swap(sorted);
}

void BlockRays::ask_whether(std::size_t count) {
    doubtful_.take(count, packet_, owners_);
    std::array<std::uint8_t, 16> blocked;
    scene_.occluded(packet_, static_cast<int>(count), blocked);
    for (std::size_t k = 0; k < count; ++k) {
        if (blocked[k]) {
            cover(k, 1.0f);
        } else {
            escaped(owners_[k], packet_.direction_z[k]);
        }
        blocked_.put(packet_, k, owners_[k], blocked[k] && nearest_);
    }
    if (blocked_.size >= 16) ask_which(16);
}

void BlockRays::cover(std::size_t k, float share) {
    if (packet_.direction_z[k] < 0.0f) return;
    const SkyVector at =
        sky_functions_at({packet_.direction_x[k], packet_.direction_y[k], packet_.direction_z[k]});
    SkyVector& sum = covered[owners_[k]];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share * at[i];
}

void BlockRays::ask_which(std::size_t count) {
    blocked_.take(count, packet_, owners_);
    std::array<std::uint32_t, 16> nearest;
    scene_.closest(packet_, static_cast<int>(count), nearest);
    for (std::size_t k = 0; k < count; ++k) {
        if (nearest[k] == index(no_facet)) {
            escaped(owners_[k], packet_.direction_z[k]);
            cover(k, -1.0f);
            continue;
        }
        if (scene_.to_follow(nearest[k])) {
            follow(k);
            continue;
        }
        if (from_behind(k, nearest[k])) {
            hidden[owners_[k]] += 1.0;
            continue;
        }
        owner.push_back(owners_[k]);
        seen.push_back({nearest[k], 1.0f});
    }
}

bool BlockRays::from_behind(std::size_t k, std::uint32_t met) const {
    const auto [facet, copy] = scene_.copies().at(met);
    // What meets ground from below began in a crease of it.
    if (facet < ground_) return false;
    const Eigen::Vector3f way{packet_.direction_x[k], packet_.direction_y[k],
                              packet_.direction_z[k]};
    if (copy == no_copy) return facets_.normal[facet].dot(way) > 0.0f;
    const Eigen::Vector3d back = scene_.copies().turned_back(copy, way.cast<double>());
    return facets_.normal[facet].dot(back.cast<float>()) > 0.0f;
}

void BlockRays::follow(std::size_t k) {
    scene_.along(
        {.origin = {packet_.origin_x[k], packet_.origin_y[k], packet_.origin_z[k]},
         .direction = {packet_.direction_x[k], packet_.direction_y[k], packet_.direction_z[k]}},
        sunlight_, met_);
    for (const RayScene::Met& met : met_) {
        if (met.number == index(no_facet)) {
            escaped(owners_[k], packet_.direction_z[k], double{met.share});
            cover(k, -met.share);
        } else if (met.back) {
            hidden[owners_[k]] += double{met.share};
        } else {
            owner.push_back(owners_[k]);
            seen.push_back({met.number, met.share});
        }
    }
}

}  // namespace diurna
