#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace diurna {

/// Uninitialised floats, in memory released by earlier frames: new memory from the system must be
/// cleared, which costs more than filling it. Large pieces are in large pages, as facets access
/// their neighbours' light all over it.
class ReusedFloats {
 public:
    explicit ReusedFloats(std::size_t size);
    ~ReusedFloats();
    ReusedFloats(const ReusedFloats&) = delete;
    ReusedFloats& operator=(const ReusedFloats&) = delete;
    float* data() { return memory_.get(); }
    const float* data() const { return memory_.get(); }
    float& operator[](std::size_t i) { return memory_.get()[i]; }
    const float& operator[](std::size_t i) const { return memory_.get()[i]; }

    struct Free {
        void operator()(float* memory) const { std::free(memory); }
    };
    using Memory = std::unique_ptr<float, Free>;

 private:
    Memory memory_;
    std::size_t size_;
};

}  // namespace diurna
