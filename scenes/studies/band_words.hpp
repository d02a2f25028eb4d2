#pragma once

#include <string>

namespace diurna {

/// A band's name in a sentence: "8-12 um", "lwir".
inline std::string band_words(const std::string& band) {
    return band.find_first_not_of("0123456789.-") == std::string::npos ? band + " um" : band;
}

}  // namespace diurna
