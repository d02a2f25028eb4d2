#pragma once

#include <fmt/format.h>

#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "scenes/job/store/digest.hpp"
#include "scenes/job/store/inputs.hpp"

namespace diurna {

/// Values in a fixed order as bytes, arrays after their sizes, for a digest: equal digests, equal
/// values. Equal numbers have equal bytes: -0 counts as 0, and every NaN as one.
class KeyFacts {
 public:
    explicit KeyFacts(std::string begin) : text_(std::move(begin)) {}

    template <class T>
    void number(T value) {
        static_assert(std::is_arithmetic_v<T>);
        if constexpr (std::is_floating_point_v<T>) {
            if (value == T{0}) value = T{0};
            if (value != value) value = std::numeric_limits<T>::quiet_NaN();
        }
        text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class T>
    void array(std::span<const T> values) {
        number(values.size());
        text_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    }
    void line(const std::string& text) {
        number(text.size());
        text_ += text;
    }
    std::string digest() const { return sha256(text_); }

 private:
    std::string text_;
};

/// Facts of a stage's key: the version and the sources of the program come first.
inline KeyFacts stage_facts(const char* of) {
    return KeyFacts(fmt::format("{} {} {}\n", of, DIURNA_VERSION, job_key({}, {})));
}

}  // namespace diurna
