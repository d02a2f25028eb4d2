#include "terrain/visibility/ray_bundles.hpp"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "terrain/visibility/embree_scene.hpp"

namespace diurna {

namespace {

/// Bits of the rays that meet a facet at less than 3°.
std::uint32_t grazing(const RTCRayHit8& rays) {
    const auto dot = [](__m256 ax, __m256 ay, __m256 az, __m256 bx, __m256 by, __m256 bz) {
        return _mm256_fmadd_ps(ax, bx, _mm256_fmadd_ps(ay, by, _mm256_mul_ps(az, bz)));
    };
    const __m256 nx = _mm256_load_ps(rays.hit.Ng_x), ny = _mm256_load_ps(rays.hit.Ng_y),
                 nz = _mm256_load_ps(rays.hit.Ng_z);
    const __m256 across = dot(nx, ny, nz, _mm256_load_ps(rays.ray.dir_x),
                              _mm256_load_ps(rays.ray.dir_y), _mm256_load_ps(rays.ray.dir_z));
    const __m256 least = _mm256_mul_ps(_mm256_set1_ps(0.05f * 0.05f), dot(nx, ny, nz, nx, ny, nz));
    const __m256 flat = _mm256_cmp_ps(_mm256_mul_ps(across, across), least, _CMP_NGT_UQ);
    const __m256i id = _mm256_load_si256(reinterpret_cast<const __m256i*>(rays.hit.primID));
    const __m256i missed =
        _mm256_cmpeq_epi32(id, _mm256_set1_epi32(static_cast<int>(RTC_INVALID_GEOMETRY_ID)));
    return static_cast<std::uint32_t>(
        _mm256_movemask_ps(_mm256_andnot_ps(_mm256_castsi256_ps(missed), flat)));
}

/// Puts the numbers of what was met in copies' places. Returns their bits: Embree's normals are
/// those of the facets that they are copies of.
std::uint32_t number_copies(const EmbreeScene& scene, const RTCHit8& hit, std::uint32_t* met) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        met[i] = scene.met(hit.primID[i], hit.instID[0][i]);
        if (Copies::is_copied(met[i])) bits |= 1u << i;
    }
    return bits;
}

/// Ranges of some lanes of a packet, in double.
void recompute(const EmbreeScene& scene, const RTCRayHit8& packet, const std::uint32_t* met,
               std::uint32_t lanes, float* to_range) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
        const RTCRay8& all = packet.ray;
        const Ray ray{.origin = {all.org_x[i], all.org_y[i], all.org_z[i]},
                      .direction = {all.dir_x[i], all.dir_y[i], all.dir_z[i]},
                      .time = all.time[i]};
        to_range[i] = scene.range(ray, met[i], all.tfar[i]);
    }
}

}  // namespace

struct RayBundles::State {
    const EmbreeScene& scene;
    std::vector<float> rays;  // seven arrays, one after the other
    std::vector<std::uint32_t> facet;
    std::vector<float> range;
};

RayBundles::RayBundles(const RayScene& scene, std::size_t most)
    : state_(new State{.scene = scene.embree(),
                       .rays = std::vector<float>(7 * lanes * most),
                       .facet = std::vector<std::uint32_t>(lanes * most),
                       .range = std::vector<float>(lanes * most)}) {
    const std::size_t n = lanes * most;
    float* from = state_->rays.data();
    origin_x = from, origin_y = from + n, origin_z = from + 2 * n;
    direction_x = from + 3 * n, direction_y = from + 4 * n, direction_z = from + 5 * n;
    time = from + 6 * n;
    std::fill_n(time, n, 0.5f);
    facet = state_->facet.data();
    range = state_->range.data();
}

RayBundles::~RayBundles() = default;

void RayBundles::set_origin(const Eigen::Vector3f& origin) {
    const std::size_t n = state_->range.size();
    std::fill_n(origin_x, n, origin.x());
    std::fill_n(origin_y, n, origin.y());
    std::fill_n(origin_z, n, origin.z());
}

void RayBundles::closest(std::size_t bundles) {
    // Embree takes sixteen rays to pieces of eight where it runs with AVX2: eight are handed over.
    constexpr std::size_t some = 8;
    RTCIntersectContext context = intersect_context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    std::array<float, some> far;
    std::array<unsigned, some> none;
    far.fill(1e30f);
    none.fill(RTC_INVALID_GEOMETRY_ID);
    alignas(64) int valid[some];
    alignas(64) RTCRayHit8 packet;
    RTCRay8& ray = packet.ray;
    RTCHit8& hit = packet.hit;
    for (std::size_t i = 0; i < some; ++i) {
        valid[i] = -1;
        ray.tnear[i] = 0.0f;
        ray.mask[i] = 0xFFFFFFFFu;
        ray.flags[i] = 0;
        hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    const auto copy = [](const auto* from, auto* to) { std::memcpy(to, from, some * sizeof(*to)); };
    std::uint32_t* to_facet = state_->facet.data();
    float* to_range = state_->range.data();
    for (std::size_t at = 0; at < bundles * lanes; at += some) {
        copy(origin_x + at, ray.org_x);
        copy(origin_y + at, ray.org_y);
        copy(origin_z + at, ray.org_z);
        copy(direction_x + at, ray.dir_x);
        copy(direction_y + at, ray.dir_y);
        copy(direction_z + at, ray.dir_z);
        copy(time + at, ray.time);
        copy(far.data(), ray.tfar);
        copy(none.data(), hit.geomID);
        copy(none.data(), hit.primID);
        rtcIntersect8(valid, state_->scene.scene, &context, &packet);
        copy(hit.primID, to_facet + at);
        copy(ray.tfar, to_range + at);
        std::uint32_t flat = grazing(packet);
        if (!state_->scene.copies.empty()) flat |= number_copies(state_->scene, hit, to_facet + at);
        if (flat != 0) recompute(state_->scene, packet, to_facet + at, flat, to_range + at);
        if (state_->scene.other_side.empty()) continue;
        for (std::size_t i = 0; i < some; ++i) {
            to_facet[at + i] =
                state_->scene.facing(to_facet[at + i], {ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]});
        }
    }
}

}  // namespace diurna
