#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// Walks through the lines of a mesh's text and the words of each.
class MeshLines {
 public:
    MeshLines(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {}

    /// Goes on to the next line; false at the end. A backslash at the end of a line of numbers
    /// joins the next (OBJ); comments and names may end with one.
    bool next();
    /// Leaves out what stands behind the first '#': a comment behind the data of a line.
    void drop_comment();
    const std::vector<std::string_view>& words() const { return words_; }
    /// "mesh.obj:41"
    std::string where() const { return name_ + ":" + std::to_string(line_); }
    std::size_t line() const { return line_; }
    std::string_view rest() const { return rest_; }

    /// The number that a word is; throws InputError if it is none or no coordinate can be it.
    double coordinate(std::string_view word) const;
    /// The whole number that a word is; throws InputError if it is none.
    long long whole(std::string_view word) const;

 private:
    std::string name_;
    std::string_view rest_;
    std::vector<std::string_view> words_;
    std::size_t line_ = 0;
};

/// Whether a word is a keyword, in small letters, whatever letters it is written in.
bool is_keyword(std::string_view word, std::string_view keyword);

}  // namespace diurna
