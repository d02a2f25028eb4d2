#pragma once

#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather_file/read_weather.hpp"

/// What is said of files of weather that cannot be believed.
namespace diurna::testing {

/// What a file is refused with; "" if it is not.
inline std::string refused(const std::filesystem::path& file, const WeatherOptions& options) {
    try {
        read_weather(file, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}
/// The same of a file of this name and text.
inline std::string message_of(const std::filesystem::path& file, const std::string& text,
                              const WeatherOptions& options = {}) {
    write_text(file, text);
    return refused(file, options);
}

inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace diurna::testing
