#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace diurna {

/// Attributes of pictures ("camera.position_m": "0 -60 20") as JSON, those of a group under its
/// name: {"camera": {"position_m": [0, -60, 20]}}. Numbers apart by blanks are an array, one number
/// is itself, all else text. Names without a dot are skipped.
nlohmann::ordered_json attribute_json(const std::map<std::string, std::string>& attributes);

}  // namespace diurna
