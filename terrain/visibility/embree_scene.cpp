#include "terrain/visibility/embree_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <map>
#include <new>
#include <stdexcept>
#include <utility>

#include "terrain/visibility/two_sides.hpp"

namespace diurna {

namespace {

void fail(void*, RTCError code, const char* message) {
    if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(fmt::format("Embree: {} (error {})", message, int(code)));
}

RTCScene new_scene(RTCDevice device) {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    return scene;
}

/// Whether a facet's other side stands there already: a triangle of no area is never met.
bool is_second_side(const std::vector<std::uint32_t>& other_side, std::size_t facet) {
    return !other_side.empty() && other_side[facet] < facet;
}

}  // namespace

EmbreeScene::EmbreeScene(const FacetSet& facets, Copies all_copies, const FacetMotion& motion)
    : EmbreeScene() {  // whole, so that a throw lets go
    copies = std::move(all_copies);
    other_side = other_sides(facets);
    // One instruction set for everyone, so that results repeat across machines.
    device = rtcNewDevice("isa=avx2");
    if (!device) throw std::runtime_error("Embree cannot start: it needs AVX2");
    rtcSetDeviceErrorFunction(device, fail, nullptr);
    scene = new_scene(device);
    if (facets.size() > 0) add_facets(facets, motion);
    add_copies(facets);
    rtcCommitScene(scene);
}

void EmbreeScene::add_facets(const FacetSet& facets, const FacetMotion& motion) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const bool moves = !motion.after.empty();
    if (moves) rtcSetGeometryTimeStepCount(geometry, 2);
    const auto own_places = [&](unsigned time, const std::vector<Eigen::Vector3f>& place) {
        assert(place.size() == facets.vertex.size());
        auto* own = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
                                                                time, RTC_FORMAT_FLOAT3,
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
        for (std::size_t k = 0; k < 3; ++k) {
            assert(facets.corner[f][k] < facets.vertex.size());
            own_corner[3 * f + k] = facets.corner[f][is_second_side(other_side, f) ? 0 : k];
        }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, 0);
    rtcReleaseGeometry(geometry);
    corner = own_corner;
}

RTCScene EmbreeScene::copied(const FacetSet& facets, const Copy& copy,
                             const Eigen::Vector3d& origin) {
    RTCScene part = new_scene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::map<std::uint32_t, unsigned> place;  // of a vertex
    for (std::uint32_t f = copy.first; f < copy.first + copy.facets; ++f) {
        for (const std::uint32_t v : facets.corner[f]) {
            place.try_emplace(v, static_cast<unsigned>(place.size()));
        }
    }
    auto* own_vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), place.size()));
    auto* own_corner = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), copy.facets));
    for (const auto& [v, at] : place) {
        const Eigen::Vector3f moved = (facets.vertex[v].cast<double>() - origin).cast<float>();
        std::copy_n(moved.data(), 3, own_vertex + 3 * std::size_t{at});
    }
    for (std::uint32_t f = 0; f < copy.facets; ++f) {
        const auto& from = facets.corner[copy.first + f];
        const bool again = is_second_side(other_side, copy.first + f);
        for (std::size_t k = 0; k < 3; ++k) own_corner[3 * f + k] = place[from[again ? 0 : k]];
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(part, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(part);
    return part;
}

void EmbreeScene::add_copies(const FacetSet& facets) {
    struct Part {
        RTCScene scene;
        Eigen::Vector3d origin;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Part> parts;  // by their facets
    for (unsigned c = 0; c < copies.size(); ++c) {
        const Copy& copy = copies[c];
        const auto [known, is_new] = parts.try_emplace({copy.first, copy.facets});
        Part& part = known->second;
        if (is_new) {
            part.origin = facets.centroid[copy.first].cast<double>();
            part.scene = copied(facets, copy, part.origin);
        }
        Eigen::Isometry3d to = copy.pose;
        to.translate(part.origin);
        const Eigen::Matrix<float, 3, 4> columns = to.matrix().topRows<3>().cast<float>();
        RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, part.scene);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
        rtcCommitGeometry(instance);
        rtcAttachGeometryByID(scene, instance, c + 1);
        rtcReleaseGeometry(instance);
    }
    for (const auto& [of, part] : parts) rtcReleaseScene(part.scene);  // its instances hold it
}

EmbreeScene::~EmbreeScene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
}

std::array<Eigen::Vector3d, 3> EmbreeScene::corners_of(std::uint32_t met, float time) const {
    const auto [facet, copy] = copies.at(met);
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t v = corner[3 * std::size_t{facet} + k];
        Eigen::Vector3d place = Eigen::Map<const Eigen::Vector3f>(vertex + 3 * v).cast<double>();
        if (after != nullptr) {
            const Eigen::Vector3d end =
                Eigen::Map<const Eigen::Vector3f>(after + 3 * v).cast<double>();
            place += double{time} * (end - place);
        }
        corners[k] = copies.placed(copy, place);
    }
    return corners;
}

Eigen::Vector3d EmbreeScene::gone(std::uint32_t met, float time) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    if (after == nullptr) return sum;
    const auto then = corners_of(met, time), now = corners_of(met);
    for (std::size_t k = 0; k < 3; ++k) sum += then[k] - now[k];
    return sum / 3.0;
}

bool EmbreeScene::looks_at(std::uint32_t met, const Eigen::Vector3f& direction) const {
    const auto [a, b, c] = corners_of(met);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    return normal.dot(direction.cast<double>()) < 0.0;
}

float EmbreeScene::range(const Ray& ray, std::uint32_t met, float embree_range) const {
    const Eigen::Vector3d origin = ray.origin.cast<double>();
    const Eigen::Vector3d towards = ray.direction.cast<double>();
    auto [a, b, c] = corners_of(met, ray.time);
    a -= origin, b -= origin, c -= origin;
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
