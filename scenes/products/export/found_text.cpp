#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/plain_text.hpp"
#include "scenes/products/export/found.hpp"

namespace diurna {

namespace {

std::string said(const FoundValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return plain(*text);
    if (const auto* number = std::get_if<double>(&value)) {
        return std::isfinite(*number) ? fmt::format("{:.8g}", *number) : "-";
    }
    if (const auto* whole = std::get_if<long long>(&value)) return fmt::format("{}", *whole);
    return std::get<bool>(value) ? "yes" : "no";
}

std::string said(const std::vector<FoundValue>& values) {
    std::string line;
    for (const FoundValue& value : values) line += (line.empty() ? "" : ", ") + said(value);
    return line.empty() ? "-" : line;
}

std::string said(const FoundTable& table) {
    std::vector<std::vector<std::string>> lines{table.column};
    for (const auto& row : table.row) {
        lines.emplace_back();
        for (const FoundValue& value : row) lines.back().push_back(said(value));
    }
    std::vector<std::size_t> width(table.column.size(), 0);
    for (const auto& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
    }
    std::string text = table.name + ":\n";
    for (const auto& line : lines) {
        std::string row = " ";
        for (std::size_t c = 0; c < line.size(); ++c)
            row += fmt::format(" {:<{}}", line[c], width[c]);
        row.erase(row.find_last_not_of(' ') + 1);
        text += row + "\n";
    }
    return text;
}

}  // namespace

std::string found_text(const Found& found) {
    std::string text = found.kind + "\n";
    for (const FoundFact& fact : found.fact) {
        text += fmt::format("{}: {}\n", fact.name, said(fact.value));
    }
    for (const FoundTable& table : found.table) text += said(table);
    if (!found.next.empty()) text += "next: " + plain(found.next) + "\n";
    return text;
}

}  // namespace diurna
