#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/export/found.hpp"

namespace diurna {

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const FoundValue& value) {
    if (const auto* number = std::get_if<double>(&value)) {
        return std::isfinite(*number) ? Json(*number) : Json(nullptr);
    }
    return std::visit([](const auto& v) { return Json(v); }, value);
}

}  // namespace

std::string found_json(const std::string& file, const Found& found) {
    Json json{{"kind", found.kind}, {"file", file}};
    for (const FoundFact& fact : found.fact) {
        if (fact.value.size() == 1) {
            json[fact.name] = as_json(fact.value.front());
            continue;
        }
        json[fact.name] = Json::array();
        for (const FoundValue& value : fact.value) json[fact.name].push_back(as_json(value));
    }
    for (const FoundTable& table : found.table) {
        json[table.name] = Json::array();
        for (const auto& row : table.row) {
            Json line = Json::object();
            for (std::size_t c = 0; c < row.size(); ++c) line[table.column[c]] = as_json(row[c]);
            json[table.name].push_back(std::move(line));
        }
    }
    if (!found.next.empty()) json["next"] = found.next;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace diurna
