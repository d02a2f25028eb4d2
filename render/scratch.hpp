#pragma once

#include <cstddef>
#include <memory>

namespace diurna {

/// Floats without a value yet, from memory that earlier frames have used and given back: what the
/// system would have to hand out and clear anew costs more than to fill it.
class Scratch {
 public:
    explicit Scratch(std::size_t size);
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    float* data() { return memory_.get(); }
    const float* data() const { return memory_.get(); }
    float& operator[](std::size_t i) { return memory_[i]; }
    const float& operator[](std::size_t i) const { return memory_[i]; }

 private:
    std::unique_ptr<float[]> memory_;
    std::size_t size_;
};

}  // namespace diurna
