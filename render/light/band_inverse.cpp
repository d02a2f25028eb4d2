#include "render/light/band_inverse.hpp"

#include <bit>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "materials/radiation/planck.hpp"

namespace diurna {

struct BandInverse::State {
    Band band;
    std::mutex mutex{};
    std::unordered_map<std::uint32_t, Value> known{};
};

BandInverse::BandInverse(const Band& band) : state_(new State{.band = band}) {}
BandInverse::~BandInverse() = default;

const Band& BandInverse::band() const { return state_->band; }

BandInverse::Value BandInverse::at(std::uint32_t place) const {
    {
        const std::scoped_lock lock(state_->mutex);
        const auto found = state_->known.find(place);
        if (found != state_->known.end()) return found->second;
    }
    const double radiance = double{std::bit_cast<float>(place << shift)};
    Value value;
    value.temperature = brightness_temperature(state_->band, radiance);
    value.radiance_per_kelvin = band_radiance_derivative(state_->band, value.temperature);
    const std::scoped_lock lock(state_->mutex);
    state_->known.emplace(place, value);
    return value;
}

const BandInverse& band_inverse(const Band& band) {
    static std::mutex mutex;
    static std::vector<std::unique_ptr<const BandInverse>> all;
    const std::scoped_lock lock(mutex);
    for (const auto& known : all) {
        if (known->band().node_um == band.node_um && known->band().weight == band.weight) {
            return *known;
        }
    }
    all.push_back(std::make_unique<const BandInverse>(band));
    return *all.back();
}

double radiance_per_kelvin(const Band& band, double radiance) {
    const auto single = static_cast<float>(radiance);
    if (!(single > 1e-30f && single < 1e30f)) {
        return band_radiance_derivative(band, brightness_temperature(band, radiance));
    }
    return band_inverse(band)
        .at(std::bit_cast<std::uint32_t>(single) >> BandInverse::shift)
        .radiance_per_kelvin;
}

}  // namespace diurna
