#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "materials/base/error.hpp"

namespace diurna {

/// The JSON part of a glTF file.
class Gltf {
 public:
    /// Throws InputError if it is not JSON of a glTF 2, or nested too deep to be read. `name` must
    /// outlive it.
    Gltf(const std::string& name, std::string_view json);

    /// An array of objects; empty if absent.
    const nlohmann::json& list(const char* key) const {
        const nlohmann::json& found = member(all_, key);
        const bool fits =
            found.is_null() ||
            (found.is_array() &&
             std::all_of(found.begin(), found.end(), [](auto& one) { return one.is_object(); }));
        if (!fits) throw fault(key, "is not an array of objects");
        return found;
    }
    const nlohmann::json& all() const { return all_; }
    static const nlohmann::json& member(const nlohmann::json& object, const char* key) {
        static const nlohmann::json none;
        if (!object.is_object()) return none;
        const auto found = object.find(key);
        return found != object.end() ? *found : none;
    }
    InputError fault(const std::string& where, const std::string& what) const {
        return {name_ + ": " + where, what};
    }
    /// An integer below `count`. Throws if it is not one.
    std::size_t index(const nlohmann::json& value, std::size_t count,
                      const std::string& where) const {
        if (value.is_number_unsigned() && value.get<std::size_t>() < count) {
            return value.get<std::size_t>();
        }
        throw fault(where,
                    fmt::format("found {}, expected a number below {}", shown(value), count));
    }
    /// An integer of at most 2⁴⁸, so that sums and products of it stay exact.
    double size(const nlohmann::json& value, double fallback, const std::string& where) const {
        if (value.is_null()) return fallback;
        if (value.is_number_unsigned() && value.get<double>() < 0x1p48) return value.get<double>();
        throw fault(where, fmt::format("found {}, expected a whole number", shown(value)));
    }
    static std::string shown(const nlohmann::json& value) {
        if (value.is_structured()) return value.is_array() ? "an array" : "an object";
        return value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace).substr(0, 40);
    }
    const std::string& name() const { return name_; }

 private:
    const std::string& name_;
    nlohmann::json all_;
};

}  // namespace diurna
