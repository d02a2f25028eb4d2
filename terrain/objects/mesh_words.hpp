#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// Reads a mesh's text line by line and word by word.
class MeshLines {
 public:
    MeshLines(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {}

    /// Moves to the next line; false at the end. A backslash at the end of a line of numbers joins
    /// the next line (OBJ); comments and names may end with one.
    bool next();
    /// Removes the text after the first '#': a comment after the data of a line.
    void drop_comment();
    const std::vector<std::string_view>& words() const { return words_; }
    /// "mesh.obj:41"
    std::string where() const { return name_ + ":" + std::to_string(line_); }
    std::size_t line() const { return line_; }
    std::string_view rest() const { return rest_; }

    /// The number in a word; throws InputError if it is no number or too large for a coordinate.
    double coordinate(std::string_view word) const;
    /// The integer in a word; throws InputError if it is none.
    long long whole(std::string_view word) const;

 private:
    std::string name_;
    std::string_view rest_;
    std::vector<std::string_view> words_;
    std::size_t line_ = 0;
};

/// Whether a word is a keyword (given in small letters), ignoring case.
bool is_keyword(std::string_view word, std::string_view keyword);

}  // namespace diurna
