#pragma once

#include <cstddef>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// One mistake in an input, reported so that its author can correct it.
struct Mistake {
    std::string where;    ///< "ridge.toml:41:13: weather.wind_m_s", or a file's name
    std::string problem;  ///< what was found and what was expected, in one line
    std::string hint;     ///< nearest valid spelling or another remedy; may be empty

    /// "where: problem (hint)"; control bytes are printed as '?'
    std::string line() const;
};

inline constexpr std::size_t most_mistakes_reported = 20;

/// An input cannot be used. Thrown where text is converted to a value; `main` prints each mistake
/// on its own line and exits with code 2, before anything has been written.
class InputError : public std::runtime_error {
 public:
    InputError(std::string where, std::string problem, std::string hint = "");
    explicit InputError(std::vector<Mistake> mistakes);

    const std::vector<Mistake>& mistakes() const { return mistakes_; }
    /// A line for each of the first 20, then "and 4980 more".
    void print(std::FILE* to) const;

 private:
    std::vector<Mistake> mistakes_;
};

/// Throws InputError(where, "found 3, expected 0 to 1") for a value outside, or NaN.
void check_within(const std::string& where, double value, double least, double most);

/// Throws InputError(where, "found 'rurl', expected one of ...") with the nearest of the known
/// words.
[[noreturn]] void refuse_word(const std::string& where, std::string_view word,
                              std::span<const std::string> known);

/// A to Z as a to z; other bytes unchanged.
std::string small_letters(std::string_view text);

/// The candidate with the smallest edit distance to `word`, or "" if none is near enough
/// (distance at most 2, or a third of the word's length). Capitals count as small letters.
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// "did you mean 'emissivity'?", or "" if no candidate is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

}  // namespace diurna
