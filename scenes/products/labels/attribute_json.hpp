#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace diurna {

/// Attributes of pictures ("camera.position_m": "0 -60 20") as JSON, grouped by the first part of
/// their name: {"camera": {"position_m": [0, -60, 20]}}. Several numbers become an array, one
/// number a number, everything else text. Names without a dot are skipped.
nlohmann::ordered_json attribute_json(const std::map<std::string, std::string>& attributes);

}  // namespace diurna
