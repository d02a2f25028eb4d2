#pragma once

#include <array>
#include <string_view>

namespace diurna {

/// A task of an observer, and the criterion met by half of a group of trained observers.
struct Task {
    std::string_view name;
    double cycles_across;  // over the target's least dimension: Johnson 1958, as rounded since
    double cycles_square;  // over the root of its area: ACQUIRE, two-dimensional N50
    double v50;            // of the Targeting Task Performance metric: NVThermIP for tracked
                           // vehicles, side and front in thermal contrast
};

/// The numbers are those in common use under these names, not checked against the originals:
/// Johnson, "Analysis of image forming systems" (1958): 1.0, 4.0 and (as for identification in
/// the two-sided average of vehicles) 8.0 cycles across the least dimension. ACQUIRE (NVESD 1995):
/// 0.75, 3.0, 6.0 over √area. NVThermIP User's Manual (NVESD, 2006) and Vollmerhausen & Jacobs,
/// "The Targeting Task Performance Metric", AMSEL-NV-TR-230 (2004): 2.7, 14.5, 18.8.
inline constexpr std::array<Task, 3> tasks{{{"detection", 1.0, 0.75, 2.7},
                                            {"recognition", 4.0, 3.0, 14.5},
                                            {"identification", 8.0, 6.0, 18.8}}};

/// Target transfer probability function: P = x^E / (1 + x^E), x = N/N50, E = 2.7 + 0.7 x (NVESD's
/// fit to the field data of Ratches and others 1975; ACQUIRE).
double johnson_probability(double cycles, double cycles_at_half);

/// The same of the Targeting Task Performance metric: E = 1.51 + 0.24 x, x = V/V50 (Vollmerhausen &
/// Jacobs 2004).
double ttp_probability(double value, double value_at_half);

/// x at which P = x^(a + b x) / (1 + x^(a + b x)) is `probability`, 0 to 1 exclusive; to 1e-12.
double johnson_ratio(double probability);
double ttp_ratio(double probability);

}  // namespace diurna
