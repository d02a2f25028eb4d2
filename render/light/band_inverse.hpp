#pragma once

#include <cstdint>
#include <memory>

#include "materials/radiation/band.hpp"

namespace diurna {

/// The black body that has a band's radiance, at radiances whose last bits are zero: 64 to an
/// octave. Each is found once in a program's run, by iteration (4 µs), and kept, since every
/// picture asks for the same few hundred. Safe to use from many threads; values do not depend on
/// who asks first.
class BandInverse {
 public:
    static constexpr int shift = 17;  // bits of a float below a place

    struct Value {
        double temperature = 0.0;          // [K]
        double radiance_per_kelvin = 0.0;  // [W m⁻² sr⁻¹ K⁻¹]
    };

    explicit BandInverse(const Band& band);
    ~BandInverse();
    BandInverse(const BandInverse&) = delete;
    BandInverse& operator=(const BandInverse&) = delete;

    const Band& band() const;
    /// - place: leading bits of a positive radiance
    Value at(std::uint32_t place) const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// That of a band with these nodes and weights; kept until the program ends.
const BandInverse& band_inverse(const Band& band);

/// [W m⁻² sr⁻¹ K⁻¹] about the temperature that a radiance looks like, within 2 %: for estimates of
/// errors.
double radiance_per_kelvin(const Band& band, double radiance);

}  // namespace diurna
