#include "terrain/visibility/ray_scene.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "terrain/visibility/embree_scene.hpp"
#include "terrain/visibility/some_facets.hpp"

namespace diurna {

namespace {

// Embree takes sixteen rays to pieces of eight where it runs with AVX2: eight are handed over.
constexpr std::size_t width = 8;
constexpr auto alike = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
constexpr auto scattered = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;

/// Lays up to `width` rays side by side.
void pack(std::span<const Ray> rays, RTCRay8& packet, int (&valid)[width]) {
    for (std::size_t i = 0; i < width; ++i) {
        const Ray& ray = rays[i < rays.size() ? i : 0];
        valid[i] = i < rays.size() ? -1 : 0;  // lanes without a ray are switched off
        packet.org_x[i] = ray.origin.x();
        packet.org_y[i] = ray.origin.y();
        packet.org_z[i] = ray.origin.z();
        packet.dir_x[i] = ray.direction.x();
        packet.dir_y[i] = ray.direction.y();
        packet.dir_z[i] = ray.direction.z();
        packet.tnear[i] = ray.near;
        packet.tfar[i] = ray.far;
        packet.time[i] = ray.time;
        packet.mask[i] = 0xFFFFFFFFu;
        packet.id[i] = 0;
        packet.flags[i] = 0;
    }
}

Ray ray_of(const RayPacket& rays, std::size_t i) {
    return {.origin = {rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]},
            .direction = {rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]}};
}

/// Rays that go apart take less time one after the other than side by side.
RTCRayHit alone(const Ray& ray) {
    RTCRayHit one;
    one.ray = {.org_x = ray.origin.x(),
               .org_y = ray.origin.y(),
               .org_z = ray.origin.z(),
               .tnear = ray.near,
               .dir_x = ray.direction.x(),
               .dir_y = ray.direction.y(),
               .dir_z = ray.direction.z(),
               .time = ray.time,
               .tfar = ray.far,
               .mask = 0xFFFFFFFFu,
               .id = 0,
               .flags = 0};
    one.hit.geomID = one.hit.primID = one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return one;
}

void nothing_hit(RTCHit8& hit) {
    std::fill_n(hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(hit.primID, width, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(hit.instID[0], width, RTC_INVALID_GEOMETRY_ID);
}

/// Embree marks a blocked ray by a far end of minus infinity.
bool is_blocked(const RTCRay8& packet, std::size_t lane) { return packet.tfar[lane] < 0.0f; }

/// blocked[i] = 1 if a facet of the scene is between near and far.
void ask_occluded(const EmbreeScene& in, std::span<const Ray> rays,
                  std::span<std::uint8_t> blocked) {
    RTCIntersectContext context = intersect_context(alike);
    alignas(32) int valid[width];
    alignas(32) RTCRay8 packet;
    for (std::size_t start = 0; start < rays.size(); start += width) {
        const auto some = rays.subspan(start, std::min(width, rays.size() - start));
        pack(some, packet, valid);
        rtcOccluded8(valid, in.scene, &context, &packet);
        for (std::size_t i = 0; i < some.size(); ++i) blocked[start + i] = is_blocked(packet, i);
    }
}

/// Facets through which some of the sun's beam goes on; null: none.
std::unique_ptr<EmbreeScene> see_through(const FacetSet& facets,
                                         std::span<const PassedLight> passed,
                                         const EmbreeScene& all, const FacetMotion& motion) {
    const auto passes = [](const PassedLight& p) { return !p.beam.empty(); };
    if (std::none_of(passed.begin(), passed.end(), passes)) return nullptr;
    std::vector<std::uint8_t> wanted(facets.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (!passes(passed[index(facets.material[f])])) continue;
        wanted[f] = 1;
        // Its other side may be the one that rays meet.
        if (all.other_side.empty() || all.other_side[f] == index(no_facet)) continue;
        wanted[all.other_side[f]] = 1;
    }
    if (std::find(wanted.begin(), wanted.end(), 1) == wanted.end()) return nullptr;
    const SomeFacets some = some_facets(facets, wanted, all.copies, motion);
    return std::make_unique<EmbreeScene>(some.facets, some.copies, some.motion);
}

/// Puts a ray's begin behind what it has met.
void step_past(float range, Ray& ray) { ray.near = range * (1.0f + 1e-6f) + 1e-3f; }

}  // namespace

RayScene::RayScene(const FacetSet& facets, std::vector<PassedLight> passed, Copies copies,
                   const FacetMotion& motion)
    : embree_(std::make_unique<EmbreeScene>(facets, std::move(copies), motion)),
      passed_(std::move(passed)) {
    // Sheets whose backs are facets have nothing hidden behind.
    for (std::size_t f = 0; f < embree_->other_side.size() && !passed_.empty(); ++f) {
        if (embree_->other_side[f] == index(no_facet)) continue;
        passed_[index(facets.material[f])].sheet = false;
    }
    const auto plain = [](const PassedLight& p) { return p.beam.empty() && !p.sheet; };
    if (std::all_of(passed_.begin(), passed_.end(), plain)) return;
    see_through_ = see_through(facets, passed_, *embree_, motion);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        facets_.push_back(
            {static_cast<std::uint16_t>(index(facets.material[f])), facets.normal[f]});
    }
}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

Eigen::Vector3d RayScene::gone(std::uint32_t met, float time) const {
    return embree_->gone(met, time);
}

const Copies& RayScene::copies() const { return embree_->copies; }

float RayScene::cosine(std::uint32_t met, const Eigen::Vector3f& direction) const {
    const auto [facet, copy] = copies().at(met);
    if (copy == no_copy) return facets_[facet].normal.dot(direction);
    const Eigen::Vector3d back = copies().turned_back(copy, direction.cast<double>());
    return facets_[facet].normal.dot(back.cast<float>());
}

void RayScene::closest(std::span<const Ray> rays, std::span<Hit> hits) const {
    assert(rays.size() == hits.size());
    constexpr std::size_t some = 64;
    std::array<Nearest, some> found;
    for (std::size_t start = 0; start < rays.size(); start += some) {
        const std::size_t count = std::min(some, rays.size() - start);
        nearest(rays.subspan(start, count), std::span(found).first(count));
        for (std::size_t i = 0; i < count; ++i) {
            const auto [facet, copy] = copies().at(found[i].met);
            hits[start + i] = {FacetId{facet}, found[i].range, copy};
        }
    }
}

void RayScene::nearest(std::span<const Ray> rays, std::span<Nearest> found) const {
    RTCIntersectContext context = intersect_context(alike);
    const auto none = Nearest{static_cast<std::uint32_t>(index(no_facet)), 0.0f};
    if (rays.size() == 1) {
        const Ray& ray = rays[0];
        RTCRayHit one = alone(ray);
        rtcIntersect1(embree_->scene, &context, &one);
        found[0] = none;
        if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
        const std::uint32_t met = embree_->met(one.hit.primID, one.hit.instID[0]);
        found[0] = {embree_->facing(met, ray.direction), embree_->range(ray, met, one.ray.tfar)};
        return;
    }
    alignas(32) int valid[width];
    alignas(32) RTCRayHit8 packet;
    for (std::size_t start = 0; start < rays.size(); start += width) {
        const auto some = rays.subspan(start, std::min(width, rays.size() - start));
        pack(some, packet.ray, valid);
        nothing_hit(packet.hit);
        rtcIntersect8(valid, embree_->scene, &context, &packet);
        for (std::size_t i = 0; i < some.size(); ++i) {
            if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
                found[start + i] = none;
                continue;
            }
            const std::uint32_t met = embree_->met(packet.hit.primID[i], packet.hit.instID[0][i]);
            found[start + i] = {embree_->facing(met, some[i].direction),
                                embree_->range(some[i], met, packet.ray.tfar[i])};
        }
    }
}

void RayScene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    assert(rays.size() == blocked.size());
    ask_occluded(*embree_, rays, blocked);
}

std::uint32_t RayScene::next(Ray& ray) const {
    Nearest found;
    nearest({&ray, 1}, {&found, 1});
    step_past(found.range, ray);
    return found.met;
}

void RayScene::beam(std::span<const Ray> rays, std::span<float> share) const {
    constexpr float too_little = 1e-7f;
    std::vector<std::uint8_t> blocked(rays.size());
    occluded(rays, blocked);
    for (std::size_t i = 0; i < rays.size(); ++i) share[i] = blocked[i] ? 0.0f : 1.0f;
    if (!see_through_) return;
    const auto through = [&](std::uint32_t met, const Eigen::Vector3f& direction) {
        const std::vector<float>& by_cosine = passed_[side_of(met).material].beam;
        if (by_cosine.empty()) return 0.0f;
        const float u =
            std::min(1.0f, std::abs(cosine(met, direction))) * float(by_cosine.size() - 1);
        const auto k = std::min(static_cast<std::size_t>(u), by_cosine.size() - 2);
        return std::lerp(by_cosine[k], by_cosine[k + 1], u - float(k));
    };
    // Only of rays that also meet a facet that transmits can something be left.
    std::vector<std::size_t> place;
    std::vector<Ray> doubtful;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!blocked[i]) continue;
        doubtful.push_back(rays[i]);
        place.push_back(i);
    }
    blocked.resize(doubtful.size());
    ask_occluded(*see_through_, doubtful, blocked);
    std::size_t left_over = 0;
    for (std::size_t k = 0; k < doubtful.size(); ++k) {
        if (!blocked[k]) continue;
        doubtful[left_over] = doubtful[k];
        place[left_over++] = place[k];
    }
    doubtful.resize(left_over);
    std::vector<Nearest> first(doubtful.size());
    nearest(doubtful, first);
    for (std::size_t k = 0; k < doubtful.size(); ++k) {
        Ray& ray = doubtful[k];
        std::uint32_t met = first[k].met;
        step_past(first[k].range, ray);
        float left = 1.0f;
        while (met != index(no_facet) && left > too_little) {
            left *= through(met, ray.direction);
            if (left > too_little) met = next(ray);
        }
        share[place[k]] = left > too_little ? left : 0.0f;
    }
}

void RayScene::along(const Ray& from, bool sunlight, std::vector<Met>& met) const {
    constexpr float too_little = 1e-7f;
    Ray ray = from;
    float left = 1.0f;
    met.clear();
    while (left > too_little) {
        const std::uint32_t number = next(ray);
        if (number == index(no_facet)) {
            met.push_back({.number = number, .share = left});
            return;
        }
        const PassedLight& passed = passed_[side_of(number).material];
        const float here = left * (1.0f - (sunlight ? passed.sunlight : passed.heat));
        met.push_back({.number = number,
                       .back = passed.sheet && cosine(number, ray.direction) > 0.0f,
                       .share = here});
        left -= here;
    }
}

void RayScene::closest(const RayPacket& rays, int lanes,
                       std::array<std::uint32_t, 16>& facet) const {
    RTCIntersectContext context = intersect_context(scattered);
    for (std::size_t i = 0; i < static_cast<std::size_t>(lanes); ++i) {
        const Ray ray = ray_of(rays, i);
        RTCRayHit one = alone(ray);
        rtcIntersect1(embree_->scene, &context, &one);
        facet[i] = embree_->facing(embree_->met(one.hit.primID, one.hit.instID[0]), ray.direction);
    }
}

void RayScene::occluded(const RayPacket& rays, int lanes,
                        std::array<std::uint8_t, 16>& blocked) const {
    RTCIntersectContext context = intersect_context(scattered);
    for (std::size_t i = 0; i < static_cast<std::size_t>(lanes); ++i) {
        RTCRayHit one = alone(ray_of(rays, i));
        rtcOccluded1(embree_->scene, &context, &one.ray);
        blocked[i] = one.ray.tfar < 0.0f;
    }
}

}  // namespace diurna
