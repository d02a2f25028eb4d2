#pragma once

#include <string>
#include <variant>
#include <vector>

/// Result of `diurna inspect` for a file.
namespace diurna {

/// A number that is not finite is omitted.
using FoundValue = std::variant<std::string, double, long long, bool>;

/// One line: "size_px: 403 x 344". A name ends with its unit unless the value is a pure number.
struct FoundFact {
    std::string name;
    std::vector<FoundValue> value;  // a single value, or a list
};

/// Rows of the same columns, such as the planes of a picture.
struct FoundTable {
    std::string name;
    std::vector<std::string> column;
    std::vector<std::vector<FoundValue>> row;
};

struct Found {
    std::string kind;  // "elevation raster"
    std::vector<FoundFact> fact{};
    std::vector<FoundTable> table{};
    std::string next{};  // a suggested command for the file; may be empty
};

/// Readable lines: facts, then tables with aligned columns, then the suggested command. Control
/// characters of the file become "?".
std::string found_text(const Found& found);

/// One JSON object: kind, file, every fact by its name, every table as an array of objects,
/// next.
std::string found_json(const std::string& file, const Found& found);

}  // namespace diurna
