#include "materials/air/sight_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double lowest_km = -0.5;  // the shore of the Dead Sea lies at -0.43 km

/// A straight line from radius r under a zenith of cosine mu.
struct Ray {
    double r, mu;

    /// Distances at which the line crosses a sphere: nearer and farther; NaN if it misses.
    double near(double sphere) const { return -r * mu - root(sphere); }
    double far(double sphere) const { return -r * mu + root(sphere); }
    Ray after(double s) const {
        const double onward = r + rise(s);
        return {onward, (r * mu + s) / onward};
    }
    /// Gain of height over a distance, free of cancellation.
    double rise(double s) const {
        const double square = s * (2.0 * r * mu + s);
        return square / (std::sqrt(r * r + square) + r);
    }

 private:
    double root(double sphere) const {
        // r² (μ² − 1) + R², its large terms taken together.
        return std::sqrt((sphere - r) * (sphere + r) + r * r * mu * mu);
    }
};

/// Distance at which a line that points down meets the ground; 0 if it starts there, NaN if it
/// passes above it.
double to_ground(const Ray& ray, double height_km, double ground_km) {
    if (!(ray.mu < 0.0)) return std::numeric_limits<double>::quiet_NaN();
    return height_km <= ground_km ? 0.0 : ray.near(earth_radius_km + ground_km);
}

/// Exactly 0 at 90°, so that a level line does not meet the ground it starts on.
double cosine(double zenith_deg) {
    return zenith_deg == 90.0 ? 0.0 : std::cos(radians(zenith_deg));
}

}  // namespace

double SightLine::range_km() const {
    return std::accumulate(length_km.begin(), length_km.end(), 0.0);
}

double SightLine::height_within(std::size_t segment, double share) const {
    const double middle = height_km[segment];
    if (!edge_km.empty()) {
        const double low = edge_km[segment], high = edge_km[segment + 1];
        const double u = 2.0 * share - 1.0;
        return middle + 0.5 * u * (high - low) + 0.5 * u * u * (low + high - 2.0 * middle);
    }
    if (size() == 1) return middle;
    const std::size_t a = std::min(share < 0.5 && segment > 0 ? segment - 1 : segment, size() - 2);
    const double slope =
        (height_km[a + 1] - height_km[a]) / (0.5 * (length_km[a] + length_km[a + 1]));
    return middle + slope * (share - 0.5) * length_km[segment];
}

SightLine SightLine::first(std::size_t end) const {
    const auto cut = [](const std::vector<double>& from, std::size_t count) {
        return std::vector<double>(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
    };
    return {cut(height_km, end), cut(length_km, end),
            edge_km.empty() ? std::vector<double>{} : cut(edge_km, end + 1)};
}

SightLine joined(const SightLine& near, const SightLine& far) {
    if (near.size() == 0) return far;
    if (far.size() == 0) return near;
    SightLine line = near;
    const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    append(line.height_km, far.height_km);
    append(line.length_km, far.length_km);
    if (near.edge_km.empty() || far.edge_km.empty()) {
        line.edge_km.clear();
    } else {
        line.edge_km.pop_back();
        append(line.edge_km, far.edge_km);
    }
    return line;
}

bool meets_ground(double height_km, double zenith_deg) {
    const Ray ray{earth_radius_km + height_km, cosine(zenith_deg)};
    return !std::isnan(to_ground(ray, height_km, 0.0));
}

double refractivity(const Profile& profile, double height_km) {
    if (height_km >= atmosphere_top_km) return 0.0;
    const auto [pressure_hPa, temperature] = pressure_and_temperature_at(profile, height_km);
    return 77.6e-6 * pressure_hPa / temperature;
}

bool meets_ground(const Profile& profile, double height_km, double zenith_deg) {
    if (!(cosine(zenith_deg) < 0.0)) return false;
    if (height_km <= 0.0) return true;
    const auto bouguer = [&](double z) {
        return (1.0 + refractivity(profile, z)) * (earth_radius_km + z);
    };
    return bouguer(height_km) * std::sin(radians(zenith_deg)) < bouguer(0.0);
}

namespace {

void check_line(double height_km, double zenith_deg, double range_km) {
    if (!(zenith_deg >= 0.0 && zenith_deg <= 180.0)) {
        throw InputError("zenith angle",
                         fmt::format("found {:g}°, expected 0 (up) to 180 (down)", zenith_deg));
    }
    if (!(range_km >= 0.0)) {
        throw InputError("range", fmt::format("found {:g} km, expected at least 0", range_km));
    }
    if (!(height_km >= lowest_km && height_km <= 1e6)) {
        throw InputError("height",
                         fmt::format("found {:g} km, expected {:g} to 1e6", height_km, lowest_km));
    }
}

/// Change of height a segment may make that starts `here`.
double allowed_change(const Segmentation& segmentation, double here, double travelled) {
    const double thinness = std::max(here, 0.0) / segmentation.thinning_km;
    const double ceiling = segmentation.ceiling_km * (1.0 + thinness * thinness);
    return std::clamp(segmentation.growth * travelled, segmentation.first_km, ceiling);
}

}  // namespace

SightLine sight_line(double height_km, double zenith_deg, double range_km,
                     const Segmentation& segmentation) {
    check_line(height_km, zenith_deg, range_km);
    Ray ray{earth_radius_km + height_km, cosine(zenith_deg)};
    if (height_km > atmosphere_top_km) {
        const double entry = ray.near(earth_radius_km + atmosphere_top_km);
        if (!(entry >= 0.0 && entry < range_km)) return {};
        ray = ray.after(entry);
        height_km = atmosphere_top_km;
        range_km -= entry;
    }
    double end = std::min(range_km, ray.far(earth_radius_km + atmosphere_top_km));
    const double ground = to_ground(ray, height_km, std::isinf(range_km) ? 0.0 : lowest_km);
    if (!std::isnan(ground)) end = std::min(end, ground);

    SightLine line;
    double travelled = 0.0;  // all ups and downs so far [km]
    for (double s = 0.0; s < end;) {
        const double here = height_km + ray.rise(s);
        double allowed = allowed_change(segmentation, here, travelled);
        const Ray onward = ray.after(s);
        const double to_level = -onward.r * onward.mu;
        const bool falls = to_level > 1e-9;
        const double to_aerosol_top = (aerosol_top_km - here) * (falls ? -1.0 : 1.0);
        if (to_aerosol_top > 1e-6) allowed = std::min(allowed, to_aerosol_top);
        double length = falls ? onward.near(onward.r - allowed) : onward.far(onward.r + allowed);
        if (std::isnan(length)) length = to_level;  // it falls by less before it turns
        length = std::min(length, end - s);
        if (end - s - length < 1e-9) length = end - s;
        line.edge_km.push_back(here);
        line.height_km.push_back(here + onward.rise(0.5 * length));
        line.length_km.push_back(length);
        travelled += std::abs(onward.rise(length));
        s += length;
    }
    if (line.size() > 0) line.edge_km.push_back(height_km + ray.rise(end));
    return line;
}

int chord_segments(double height_change_km) {
    const double change = std::abs(height_change_km);
    return static_cast<int>(std::min(12.0 + 24.0 * change, 24.0 + 12.0 * change));
}

SightLine chord(double from_height_km, double to_height_km, double range_km, int segments) {
    if (segments <= 0) segments = chord_segments(to_height_km - from_height_km);
    // Height over the part t of the way: from + rise t + sag t².
    const double sag = range_km * range_km / (2.0 * earth_radius_km);
    const double rise = to_height_km - from_height_km - sag;
    std::vector<double> edge;
    for (int i = 0; i <= segments; ++i) {
        edge.push_back(double(i) * i / (double(segments) * segments));
    }
    // No segment lies across the top of the aerosol (sight_line.hpp).
    const double below = aerosol_top_km - from_height_km;
    const double root = std::sqrt(std::max(0.0, rise * rise + 4.0 * sag * below));
    for (const double denominator : {rise + root, rise - root}) {
        const double t = 2.0 * below / denominator;
        if (t > 1e-9 && t < 1.0) edge.push_back(t);
    }
    std::sort(edge.begin(), edge.end());

    const auto height = [&](double t) { return from_height_km + t * (rise + t * sag); };
    SightLine line;
    line.edge_km.push_back(from_height_km);
    for (std::size_t i = 1; i < edge.size(); ++i) {
        line.height_km.push_back(height(0.5 * (edge[i - 1] + edge[i])));
        line.length_km.push_back((edge[i] - edge[i - 1]) * range_km);
        line.edge_km.push_back(height(edge[i]));
    }
    return line;
}

SightLine refracted_line(const Profile& profile, double height_km, double zenith_deg,
                         double range_km, const Segmentation& segmentation) {
    check_line(height_km, zenith_deg, range_km);
    double mu = cosine(zenith_deg), here = height_km, left = range_km;
    if (here > atmosphere_top_km) {
        const Ray ray{earth_radius_km + here, mu};
        const double entry = ray.near(earth_radius_km + atmosphere_top_km);
        if (!(entry >= 0.0 && entry < left)) return {};
        mu = ray.after(entry).mu;
        left -= entry;
        here = atmosphere_top_km;
    }
    const double floor_km = std::isinf(range_km) ? 0.0 : lowest_km;
    SightLine line;
    double travelled = 0.0;
    while (left > 0.0 && !(mu < 0.0 && here <= floor_km) &&
           !(mu >= 0.0 && here >= atmosphere_top_km)) {
        // Within a segment the earth's radius is that of its curvature less the ray's.
        const bool falls = mu < -1e-12;
        double allowed = allowed_change(segmentation, here, travelled);
        if (falls) allowed = std::min(allowed, here - floor_km);
        const double to_aerosol_top = (aerosol_top_km - here) * (falls ? -1.0 : 1.0);
        if (to_aerosol_top > 1e-6) allowed = std::min(allowed, to_aerosol_top);
        if (!falls) allowed = std::min(allowed, atmosphere_top_km - here + 1e-9);
        const double low = falls ? here - allowed : here, high = falls ? here : here + allowed;
        // A sphere on which r grows over the segment as n r does: Bouguer's law holds at its ends,
        // and without air the line is straight.
        const double n_low = refractivity(profile, low), n_high = refractivity(profile, high);
        const double growth = std::log1p(n_high) - std::log1p(n_low) +
                              std::log1p((high - low) / (earth_radius_km + low));
        const double r_low = (high - low) / std::expm1(std::max(growth, 1e-9 * (high - low)));
        const Ray ray{falls ? r_low + (high - low) : r_low, mu};
        double length = falls ? ray.near(ray.r - allowed) : ray.far(ray.r + allowed);
        if (std::isnan(length)) length = -ray.r * mu;  // it turns before it has fallen so far
        length = std::min(length, left);
        if (left - length < 1e-9) length = left;
        if (!(length > 0.0)) break;
        line.edge_km.push_back(here);
        line.height_km.push_back(here + ray.rise(0.5 * length));
        line.length_km.push_back(length);
        const double rise = ray.rise(length);
        travelled += std::abs(rise);
        mu = ray.after(length).mu;
        here += rise;
        left -= length;
        if (std::abs(here - floor_km) < 1e-9) here = floor_km;
        if (std::abs(here - aerosol_top_km) < 1e-9) here = aerosol_top_km;
    }
    if (line.size() > 0) line.edge_km.push_back(here);
    return line;
}

}  // namespace diurna
