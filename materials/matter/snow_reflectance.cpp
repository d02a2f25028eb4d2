#include "materials/matter/snow_reflectance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "materials/base/data_folder.hpp"
#include "materials/matter/broadband.hpp"
#include "materials/matter/material.hpp"
#include "materials/matter/varied.hpp"

namespace diurna {

namespace {

struct Snow {
    Spectrum reflectance;
    double albedo;
};

/// From the brightest to the darkest.
const std::array<Snow, 3>& kinds_of_snow() {
    static const std::array<Snow, 3> kinds = [] {
        std::array<Snow, 3> all;
        constexpr std::array<const char*, 3> file{"snow_fine.csv", "snow_medium.csv",
                                                  "snow_coarse.csv"};
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i].reflectance = read_spectrum(data_folder() / "spectra" / file[i], 0.0, 1.0);
            all[i].albedo = solar_mean(all[i].reflectance);
        }
        return all;
    }();
    return kinds;
}

double at_or_end(const Spectrum& s, double um) {
    return s.at(std::clamp(um, s.wavelength_um.front(), s.wavelength_um.back()));
}

}  // namespace

Spectrum mixed_spectrum(const Spectrum& a, const Spectrum& b, double share) {
    Spectrum mixed;
    std::set_union(a.wavelength_um.begin(), a.wavelength_um.end(), b.wavelength_um.begin(),
                   b.wavelength_um.end(), std::back_inserter(mixed.wavelength_um));
    for (const double um : mixed.wavelength_um) {
        mixed.value.push_back(std::lerp(at_or_end(a, um), at_or_end(b, um), share));
    }
    return mixed;
}

Spectrum snow_reflectance(double albedo) {
    const auto& kinds = kinds_of_snow();
    const auto moved = [&](const Snow& snow) {
        Material material;
        material.reflectance = snow.reflectance;
        return with_albedo(std::move(material), albedo).reflectance;
    };
    if (albedo >= kinds.front().albedo) return moved(kinds.front());
    if (albedo <= kinds.back().albedo) return moved(kinds.back());
    const std::size_t darker = albedo >= kinds[1].albedo ? 1 : 2;
    const Snow &a = kinds[darker - 1], &b = kinds[darker];
    return mixed_spectrum(a.reflectance, b.reflectance,
                          (a.albedo - albedo) / (a.albedo - b.albedo));
}

}  // namespace diurna
