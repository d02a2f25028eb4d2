#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diurna {

/// A number of a column file that is to be fitted.
struct SoughtNumber {
    std::string key;  // its path: "material.layers.0.conductivity_W_mK"
    double low = 0.0, high = 1.0, start = 0.5;
    std::string where{};  // in the file
};

/// Which temperature of the facet was measured.
enum class MeasuredOf { surface, back, ground, leaf };

/// The measurement to which a column is fitted: [calibrate] of its file.
struct Calibration {
    std::filesystem::path file;       // CSV of time (instants with their offset) and `column`
    std::string column{};             // its name; "": the only one besides time
    double factor = 1.0, zero = 0.0;  // K = factor · value + zero
    MeasuredOf of = MeasuredOf::surface;
    double depth = 0.0;                  // [m] below the surface, replaces `of`; 0: none
    std::vector<SoughtNumber> sought{};  // one to four
    std::string where{};                 // in the file
};

}  // namespace diurna
