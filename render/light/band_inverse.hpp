#pragma once

#include <cstdint>
#include <memory>

#include "materials/radiation/band.hpp"

namespace diurna {

/// The temperature of a black body from a band's radiance, at radiances whose last bits are zero:
/// 64 per octave. Each is computed once per run of the program, by iteration (4 µs), and stored,
/// since every picture needs the same few hundred. Thread-safe; values do not depend on the order
/// of calls.
class BandInverse {
 public:
    static constexpr int shift = 17;  // bits of a float below a table entry

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

/// The table of a band with these nodes and weights; stored until the program ends.
const BandInverse& band_inverse(const Band& band);

/// [W m⁻² sr⁻¹ K⁻¹] at the apparent temperature of a radiance, within 2 %: for error
/// estimates.
double radiance_per_kelvin(const Band& band, double radiance);

}  // namespace diurna
