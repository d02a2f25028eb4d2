#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/products/export/found.hpp"

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson as_json(const FoundValue& value) {
    if (const auto* number = std::get_if<double>(&value)) {
        return std::isfinite(*number) ? OrderedJson(*number) : OrderedJson(nullptr);
    }
    return std::visit([](const auto& v) { return OrderedJson(v); }, value);
}

}  // namespace

std::string found_json(const std::string& file, const Found& found) {
    OrderedJson json{{"kind", found.kind}, {"file", file}};
    for (const FoundFact& fact : found.fact) {
        if (fact.value.size() == 1) {
            json[fact.name] = as_json(fact.value.front());
            continue;
        }
        json[fact.name] = OrderedJson::array();
        for (const FoundValue& value : fact.value) json[fact.name].push_back(as_json(value));
    }
    for (const FoundTable& table : found.table) {
        json[table.name] = OrderedJson::array();
        for (const auto& row : table.row) {
            OrderedJson line = OrderedJson::object();
            for (std::size_t c = 0; c < row.size(); ++c) line[table.column[c]] = as_json(row[c]);
            json[table.name].push_back(std::move(line));
        }
    }
    if (!found.next.empty()) json["next"] = found.next;
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace diurna
