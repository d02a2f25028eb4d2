#include "terrain/visibility/ray_scene.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <immintrin.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

namespace diurna {

namespace {

constexpr std::size_t width = 16;

void fail(void*, RTCError code, const char* message) {
    if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(fmt::format("Embree: {} (error {})", message, int(code)));
}

RTCIntersectContext context_for(Coherence coherence) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

/// Lays up to 16 rays side by side; lanes without a ray are switched off.
void pack(std::span<const Ray> rays, RTCRay16& packet, int (&valid)[width]) {
    for (std::size_t i = 0; i < width; ++i) {
        const bool used = i < rays.size();
        valid[i] = used ? -1 : 0;
        const Ray& ray = rays[used ? i : 0];
        packet.org_x[i] = ray.origin.x();
        packet.org_y[i] = ray.origin.y();
        packet.org_z[i] = ray.origin.z();
        packet.dir_x[i] = ray.direction.x();
        packet.dir_y[i] = ray.direction.y();
        packet.dir_z[i] = ray.direction.z();
        packet.tnear[i] = ray.near;
        packet.tfar[i] = ray.far;
        packet.time[i] = 0.0f;
        packet.mask[i] = 0xFFFFFFFFu;
        packet.id[i] = 0;
        packet.flags[i] = 0;
    }
}

void pack(const RayPacket& rays, int lanes, RTCRay16& packet, int (&valid)[width]) {
    for (std::size_t i = 0; i < width; ++i) {
        valid[i] = static_cast<int>(i) < lanes ? -1 : 0;
        packet.org_x[i] = rays.origin_x[i];
        packet.org_y[i] = rays.origin_y[i];
        packet.org_z[i] = rays.origin_z[i];
        packet.dir_x[i] = rays.direction_x[i];
        packet.dir_y[i] = rays.direction_y[i];
        packet.dir_z[i] = rays.direction_z[i];
        packet.tnear[i] = 0.0f;
        packet.tfar[i] = 1e30f;
        packet.time[i] = 0.0f;
        packet.mask[i] = 0xFFFFFFFFu;
        packet.id[i] = 0;
        packet.flags[i] = 0;
    }
}

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

}  // namespace

struct RayScene::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    const float* vertex = nullptr;     // Embree's own copies, three per vertex
    const unsigned* corner = nullptr;  // and three per facet

    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }

    Eigen::Vector3d corner_of(unsigned facet, int k) const {
        return Eigen::Map<const Eigen::Vector3f>(
                   vertex + 3 * std::size_t{corner[3 * std::size_t{facet} + k]})
            .cast<double>();
    }

    /// Where the ray meets the facet's plane, kept within the facet's own reach along the ray:
    /// at grazing incidence Embree's float range can be metres off, and so can the plane's where
    /// the ray met just an edge.
    float range(const Ray& ray, unsigned facet, float embree_range) const {
        const Eigen::Vector3d origin = ray.origin.cast<double>();
        const Eigen::Vector3d towards = ray.direction.cast<double>();
        const Eigen::Vector3d a = corner_of(facet, 0) - origin, b = corner_of(facet, 1) - origin,
                              c = corner_of(facet, 2) - origin;
        const Eigen::Vector3d normal = (b - a).cross(c - a);
        const double descent = normal.dot(towards);
        const double t = descent != 0.0 ? normal.dot(a) / descent : double{embree_range};
        const double along[] = {a.dot(towards), b.dot(towards), c.dot(towards)};
        const auto [first, last] = std::minmax_element(std::begin(along), std::end(along));
        const double scale = towards.squaredNorm();
        return static_cast<float>(
            std::max(double{ray.near}, std::clamp(t, *first / scale, *last / scale)));
    }

    /// That of some lanes of a packet.
    void recompute(const RTCRayHit8& packet, std::uint32_t lanes, float* to_range) const {
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
            const RTCRay8& all = packet.ray;
            const Ray ray{.origin = {all.org_x[i], all.org_y[i], all.org_z[i]},
                          .direction = {all.dir_x[i], all.dir_y[i], all.dir_z[i]}};
            to_range[i] = range(ray, packet.hit.primID[i], all.tfar[i]);
        }
    }
};

RayScene::RayScene(const FacetSet& facets) : impl_(std::make_unique<Impl>()) {
    // One instruction set for everyone, so that results repeat across machines.
    impl_->device = rtcNewDevice("isa=avx2");
    if (!impl_->device) throw std::runtime_error("Embree cannot start: it needs AVX2");
    rtcSetDeviceErrorFunction(impl_->device, fail, nullptr);
    impl_->scene = rtcNewScene(impl_->device);
    rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);

    if (facets.size() > 0) {
        RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertex = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), facets.vertex.size()));
        auto* corner = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned), facets.corner.size()));
        for (std::size_t v = 0; v < facets.vertex.size(); ++v) {
            assert(facets.vertex[v].allFinite());
            std::copy_n(facets.vertex[v].data(), 3, vertex + 3 * v);
        }
        for (std::size_t f = 0; f < facets.corner.size(); ++f) {
            for (std::size_t k = 0; k < 3; ++k) {
                assert(facets.corner[f][k] < facets.vertex.size());
                corner[3 * f + k] = facets.corner[f][k];
            }
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(impl_->scene, geometry);
        rtcReleaseGeometry(geometry);
        impl_->vertex = vertex;
        impl_->corner = corner;
    }
    rtcCommitScene(impl_->scene);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence) const {
    assert(rays.size() == hits.size());
    RTCIntersectContext context = context_for(coherence);
    alignas(64) int valid[width];
    RTCRayHit16 packet;
    for (std::size_t start = 0; start < rays.size(); start += width) {
        const auto some = rays.subspan(start, std::min(width, rays.size() - start));
        pack(some, packet.ray, valid);
        std::fill_n(packet.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(packet.hit.instID[0], width, RTC_INVALID_GEOMETRY_ID);
        rtcIntersect16(valid, impl_->scene, &context, &packet);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const unsigned facet = packet.hit.primID[i];
            hits[start + i] =
                packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                    ? Hit{}
                    : Hit{FacetId{facet}, impl_->range(some[i], facet, packet.ray.tfar[i])};
        }
    }
}

void RayScene::closest(const RayPacket& rays, int lanes,
                       std::array<std::uint32_t, 16>& facet) const {
    RTCIntersectContext context = context_for(Coherence::incoherent);
    alignas(64) int valid[width];
    alignas(64) RTCRayHit16 packet;
    pack(rays, lanes, packet.ray, valid);
    std::fill_n(packet.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.primID, width, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.instID[0], width, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect16(valid, impl_->scene, &context, &packet);
    std::copy_n(packet.hit.primID, width, facet.begin());
}

void RayScene::occluded(const RayPacket& rays, int lanes,
                        std::array<std::uint8_t, 16>& blocked) const {
    RTCIntersectContext context = context_for(Coherence::incoherent);
    alignas(64) int valid[width];
    alignas(64) RTCRay16 packet;
    pack(rays, lanes, packet, valid);
    rtcOccluded16(valid, impl_->scene, &context, &packet);
    for (std::size_t i = 0; i < width; ++i) blocked[i] = packet.tfar[i] < 0.0f ? 1 : 0;
}

void RayScene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        Coherence coherence) const {
    assert(rays.size() == blocked.size());
    RTCIntersectContext context = context_for(coherence);
    alignas(64) int valid[width];
    RTCRay16 packet;
    for (std::size_t start = 0; start < rays.size(); start += width) {
        const auto some = rays.subspan(start, std::min(width, rays.size() - start));
        pack(some, packet, valid);
        rtcOccluded16(valid, impl_->scene, &context, &packet);
        for (std::size_t i = 0; i < some.size(); ++i) {
            // Embree marks a blocked ray by a far end of minus infinity.
            blocked[start + i] = packet.tfar[i] < 0.0f ? 1 : 0;
        }
    }
}

struct RayBundles::State {
    const RayScene::Impl& scene;
    std::vector<float> rays;  // six arrays, one after the other
    std::vector<std::uint32_t> facet;
    std::vector<float> range;
};

RayBundles::RayBundles(const RayScene& scene, std::size_t most)
    : state_(new State{.scene = *scene.impl_,
                       .rays = std::vector<float>(6 * lanes * most),
                       .facet = std::vector<std::uint32_t>(lanes * most),
                       .range = std::vector<float>(lanes * most)}) {
    const std::size_t n = lanes * most;
    float* from = state_->rays.data();
    origin_x = from, origin_y = from + n, origin_z = from + 2 * n;
    direction_x = from + 3 * n, direction_y = from + 4 * n, direction_z = from + 5 * n;
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
    RTCIntersectContext context = context_for(Coherence::coherent);
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
        ray.time[i] = 0.0f;
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
        copy(far.data(), ray.tfar);
        copy(none.data(), hit.geomID);
        copy(none.data(), hit.primID);
        rtcIntersect8(valid, state_->scene.scene, &context, &packet);
        copy(hit.primID, to_facet + at);
        copy(ray.tfar, to_range + at);
        const std::uint32_t flat = grazing(packet);
        if (flat != 0) state_->scene.recompute(packet, flat, to_range + at);
    }
}

}  // namespace diurna
