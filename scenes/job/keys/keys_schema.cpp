#include "scenes/job/keys/keys_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "materials/base/csv.hpp"
#include "materials/base/files.hpp"

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson array_of(OrderedJson items, std::size_t count) {
    OrderedJson schema{{"type", "array"}, {"items", std::move(items)}};
    if (count != 0) {
        schema["minItems"] = count;
        schema["maxItems"] = count;
    }
    return schema;
}

/// The widest of the ranges.
void add_range(const std::vector<Range>& ranges, OrderedJson& schema) {
    Range all{Range::infinity, -Range::infinity};
    for (const Range& range : ranges) {
        all.least = std::min(all.least, range.least);
        all.most = std::max(all.most, range.most);
    }
    if (std::isfinite(all.least)) schema["minimum"] = all.least;
    if (std::isfinite(all.most)) schema["maximum"] = all.most;
}

/// The value in place of an absent one, where it is one and no text about it.
void add_default(const KeyEntry& entry, OrderedJson& schema) {
    if (entry.fallbacks.size() != 1) return;
    const std::string& fallback = entry.fallbacks.front();
    double value = 0.0;
    switch (entry.kind) {
        case Key::Kind::number:
        case Key::Kind::whole:
            if (!parse_number(fallback, value)) return;
            schema["default"] = value;
            break;
        case Key::Kind::flag:
            schema["default"] = fallback == "true";
            break;
        case Key::Kind::word:
            if (std::find(entry.words.begin(), entry.words.end(), fallback) == entry.words.end()) {
                return;
            }
            schema["default"] = fallback;
            break;
        default:
            break;
    }
}

OrderedJson table_schema(const std::vector<KeyEntry>& entries, const std::string& table);

OrderedJson value_schema(const std::vector<KeyEntry>& entries, const KeyEntry& entry) {
    const OrderedJson number{{"type", "number"}};
    switch (entry.kind) {
        case Key::Kind::number: {
            OrderedJson schema = number;
            add_range(entry.ranges, schema);
            if (entry.words.empty()) return schema;
            return {{"anyOf", OrderedJson::array({schema, OrderedJson{{"enum", entry.words}}})}};
        }
        case Key::Kind::whole: {
            OrderedJson schema{{"type", "integer"}};
            add_range(entry.ranges, schema);
            return schema;
        }
        case Key::Kind::word:
            return {{"enum", entry.words}};
        case Key::Kind::flag:
            return {{"type", "boolean"}};
        case Key::Kind::numbers: {
            const OrderedJson schema = array_of(number, entry.count);
            if (entry.words.empty()) return schema;
            return {{"anyOf", OrderedJson::array({schema, OrderedJson{{"enum", entry.words}}})}};
        }
        case Key::Kind::texts:
            return array_of({{"type", "string"}}, 0);
        case Key::Kind::files: {
            const OrderedJson text{{"type", "string"}};
            return {{"anyOf", OrderedJson::array({text, array_of(text, 0)})}};
        }
        case Key::Kind::rows:
            return array_of(array_of(number, entry.count), 0);
        case Key::Kind::values:
            return {{"type", "array"}};
        case Key::Kind::table:
            return table_schema(entries, entry.path());
        case Key::Kind::tables: {
            const OrderedJson table = table_schema(entries, entry.path() + "[]");
            if (entry.count != 1) return array_of(table, 0);
            return {{"anyOf", OrderedJson::array({array_of(table, 0), table})}};
        }
        default:
            return {{"type", "string"}};
    }
}

OrderedJson table_schema(const std::vector<KeyEntry>& entries, const std::string& table) {
    OrderedJson schema{{"type", "object"}};
    OrderedJson required = OrderedJson::array();
    schema["additionalProperties"] = false;
    for (const KeyEntry& entry : entries) {
        if (entry.table != table) continue;
        OrderedJson value = value_schema(entries, entry);
        const std::string unit = unit_of(entry.name);
        value["description"] =
            fmt::format("{}{}", fmt::join(entry.says, "; "), unit.empty() ? "" : " [" + unit + "]");
        add_default(entry, value);
        if (entry.name == "NAME") {
            schema["additionalProperties"] = std::move(value);
            continue;
        }
        if (entry.need == KeyEntry::Need::always) required.push_back(entry.name);
        schema["properties"][entry.name] = std::move(value);
    }
    if (!required.empty()) schema["required"] = std::move(required);
    return schema;
}

/// A file's keys with those of the materials in it.
OrderedJson file_schema(std::vector<KeyEntry> entries, const std::vector<KeyEntry>& materials,
                        const std::string& material_table, const std::string& title) {
    for (KeyEntry& entry : entries_within(material_table, materials)) {
        entries.push_back(std::move(entry));
    }
    OrderedJson schema = table_schema(entries, "");
    schema["title"] = title;
    return schema;
}

}  // namespace

std::string keys_schema(const KeyBook& book) {
    OrderedJson schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", "scene and column files of diurna " DIURNA_VERSION}};
    schema["$defs"]["scene"] =
        file_schema(book.scene, book.material, "material.NAME", "a scene file");
    schema["$defs"]["column"] =
        file_schema(book.column, book.material, "material", "a column file");
    schema["anyOf"] = {{{"$ref", "#/$defs/scene"}}, {{"$ref", "#/$defs/column"}}};
    return schema.dump(1) + "\n";
}

}  // namespace diurna
