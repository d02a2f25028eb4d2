#pragma once

#include <string>
#include <variant>
#include <vector>

/// What `diurna inspect` has found in a file.
namespace diurna {

/// A number that is not finite is reported as nothing.
using FoundValue = std::variant<std::string, double, long long, bool>;

/// One line: "size_px: 403 x 344". A name that is no plain number ends with its unit.
struct FoundFact {
    std::string name;
    std::vector<FoundValue> value;  // of one; several are a list
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
    std::string next{};  // a command that goes on with the file; may be empty
};

/// Lines to read: facts, then tables with aligned columns, then what to call next. Control
/// characters of the file are "?".
std::string found_text(const Found& found);

/// One JSON object: kind, file, every fact under its name, every table as an array of objects,
/// next.
std::string found_json(const std::string& file, const Found& found);

}  // namespace diurna
