#include "terrain/visibility/embree_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <new>
#include <stdexcept>

#include "terrain/visibility/two_sides.hpp"

namespace diurna {

namespace {

void fail(void*, RTCError code, const char* message) {
    if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(fmt::format("Embree: {} (error {})", message, int(code)));
}

}  // namespace

EmbreeScene::EmbreeScene(const FacetSet& facets, const FacetMotion& motion)
    : EmbreeScene() {  // whole, so that a throw lets go
    other_side = other_sides(facets);
    // One instruction set for everyone, so that results repeat across machines.
    device = rtcNewDevice("isa=avx2");
    if (!device) throw std::runtime_error("Embree cannot start: it needs AVX2");
    rtcSetDeviceErrorFunction(device, fail, nullptr);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);

    if (facets.size() > 0) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        const bool moves = !motion.after.empty();
        if (moves) rtcSetGeometryTimeStepCount(geometry, 2);
        const auto own_places = [&](unsigned time, const std::vector<Eigen::Vector3f>& place) {
            assert(place.size() == facets.vertex.size());
            auto* own = static_cast<float*>(
                rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, time, RTC_FORMAT_FLOAT3,
                                        3 * sizeof(float), place.size()));
            for (std::size_t v = 0; v < place.size(); ++v) {
                assert(place[v].allFinite());
                std::copy_n(place[v].data(), 3, own + 3 * v);
            }
            return own;
        };
        vertex = own_places(0, moves ? motion.before : facets.vertex);
        if (moves) after = own_places(1, motion.after);
        auto* own_corner = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned), facets.corner.size()));
        for (std::size_t f = 0; f < facets.corner.size(); ++f) {
            // Its other side stands there already: a triangle of no area is never met.
            const bool again = !other_side.empty() && other_side[f] < f;
            for (std::size_t k = 0; k < 3; ++k) {
                assert(facets.corner[f][k] < facets.vertex.size());
                own_corner[3 * f + k] = facets.corner[f][again ? 0 : k];
            }
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        corner = own_corner;
    }
    rtcCommitScene(scene);
}

EmbreeScene::~EmbreeScene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
}

Eigen::Vector3d EmbreeScene::corner_of(unsigned facet, int k, float time) const {
    const std::size_t at = 3 * std::size_t{corner[3 * std::size_t{facet} + k]};
    const Eigen::Vector3d place = Eigen::Map<const Eigen::Vector3f>(vertex + at).cast<double>();
    if (after == nullptr) return place;
    return place +
           double{time} * (Eigen::Map<const Eigen::Vector3f>(after + at).cast<double>() - place);
}

Eigen::Vector3d EmbreeScene::gone(unsigned facet, float time) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    if (after == nullptr) return sum;
    for (int k = 0; k < 3; ++k) sum += corner_of(facet, k, time) - corner_of(facet, k);
    return sum / 3.0;
}

bool EmbreeScene::looks_at(std::uint32_t facet, const Eigen::Vector3f& direction) const {
    const Eigen::Vector3d a = corner_of(facet, 0);
    const Eigen::Vector3d normal = (corner_of(facet, 1) - a).cross(corner_of(facet, 2) - a);
    return normal.dot(direction.cast<double>()) < 0.0;
}

float EmbreeScene::range(const Ray& ray, unsigned facet, float embree_range) const {
    const Eigen::Vector3d origin = ray.origin.cast<double>();
    const Eigen::Vector3d towards = ray.direction.cast<double>();
    const Eigen::Vector3d a = corner_of(facet, 0, ray.time) - origin,
                          b = corner_of(facet, 1, ray.time) - origin,
                          c = corner_of(facet, 2, ray.time) - origin;
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double descent = normal.dot(towards);
    const double t = descent != 0.0 ? normal.dot(a) / descent : double{embree_range};
    const double along[] = {a.dot(towards), b.dot(towards), c.dot(towards)};
    const auto [first, last] = std::minmax_element(std::begin(along), std::end(along));
    const double scale = towards.squaredNorm();
    return static_cast<float>(
        std::max(double{ray.near}, std::clamp(t, *first / scale, *last / scale)));
}

RTCIntersectContext intersect_context(RTCIntersectContextFlags flags) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

}  // namespace diurna
