#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// A further place of some facets: rays meet them there, too.
struct Copy {
    std::uint32_t first = 0, facets = 0;  // [first, first + facets) of the scene's
    ObjectId object{};                    // that stands there
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // from these facets to the copy's
};

inline constexpr std::uint32_t no_copy = 0xFFFFFFFFu;

/// The copies of a scene and numbers for what rays meet of them. A facet in a copy's place has a
/// number of its own, from 2³¹ on; what it is made of, its heat and its light are those of the
/// facet that it is a copy of.
class Copies {
 public:
    Copies() = default;
    /// Throws InputError where they have 2³¹ facets or more, all in all.
    explicit Copies(std::vector<Copy> all);

    bool empty() const { return all_.empty(); }
    std::size_t size() const { return all_.size(); }
    const Copy& operator[](std::size_t copy) const { return all_[copy]; }

    static bool is_copied(std::uint32_t met) { return met >= first_number && met != none; }
    /// Of the k-th facet of a copy.
    std::uint32_t number(std::size_t copy, std::uint32_t k) const {
        return first_number + begin_[copy] + k;
    }
    struct Place {
        std::uint32_t facet;  // of the scene's, or index(no_facet)
        std::uint32_t copy;   // whose place it is in, or no_copy
    };
    /// What a ray has met, copied or not.
    Place at(std::uint32_t met) const {
        return is_copied(met) ? found(met - first_number) : Place{met, no_copy};
    }

    /// In a copy's place; of no_copy what is given.
    Eigen::Vector3d placed(std::uint32_t copy, const Eigen::Vector3d& at) const {
        return copy == no_copy ? at : all_[copy].pose * at;
    }
    Eigen::Vector3d turned(std::uint32_t copy, const Eigen::Vector3d& way) const {
        return copy == no_copy ? way : all_[copy].pose.linear() * way;
    }
    /// Turned back from a copy's place.
    Eigen::Vector3d turned_back(std::uint32_t copy, const Eigen::Vector3d& way) const {
        return copy == no_copy ? way : all_[copy].pose.linear().transpose() * way;
    }

    /// The upright box round a copy [m].
    Eigen::AlignedBox3d box(const FacetSet& facets, std::size_t copy) const;

 private:
    static constexpr std::uint32_t first_number = 1u << 31;
    static constexpr std::uint32_t none = 0xFFFFFFFFu;
    Place found(std::uint32_t k) const;

    std::vector<Copy> all_;
    std::vector<std::uint32_t> begin_;  // (copy + 1) facets before it
};

/// Some facets as a set of their own, each with corners of its own, in a copy's place.
FacetSet in_place(const FacetSet& facets, const Copy& copy);

}  // namespace diurna
