#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// A copy of a range of facets at a second place; rays meet them there, too.
struct Copy {
    std::uint32_t first = 0, facets = 0;  // [first, first + facets) of the scene's
    ObjectId object{};                    // object at the copy's place
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // original to copy
};

inline constexpr std::uint32_t no_copy = 0xFFFFFFFFu;

/// The copies of a scene, and numbers for the facets that rays meet in them. A facet of a copy has
/// its own number, from 2³¹ on; its material, temperature and light are those of the original
/// facet.
class Copies {
 public:
    Copies() = default;
    /// Throws InputError if they have 2³¹ facets or more in total.
    explicit Copies(std::vector<Copy> all);

    bool empty() const { return all_.empty(); }
    std::size_t size() const { return all_.size(); }
    const Copy& operator[](std::size_t copy) const { return all_[copy]; }

    static bool is_copied(std::uint32_t met) { return met >= first_number && met != none; }
    /// Number of the k-th facet of a copy.
    std::uint32_t number(std::size_t copy, std::uint32_t k) const {
        return first_number + begin_[copy] + k;
    }
    struct Place {
        std::uint32_t facet;  // original facet, or index(no_facet)
        std::uint32_t copy;   // the copy it is in, or no_copy
    };
    /// Facet and copy of a ray's hit.
    Place at(std::uint32_t met) const {
        return is_copied(met) ? found(met - first_number) : Place{met, no_copy};
    }

    /// Transforms a point to a copy's place; unchanged for no_copy.
    Eigen::Vector3d placed(std::uint32_t copy, const Eigen::Vector3d& at) const {
        return copy == no_copy ? at : all_[copy].pose * at;
    }
    Eigen::Vector3d turned(std::uint32_t copy, const Eigen::Vector3d& way) const {
        return copy == no_copy ? way : all_[copy].pose.linear() * way;
    }
    /// Rotates a direction back from a copy's place.
    Eigen::Vector3d turned_back(std::uint32_t copy, const Eigen::Vector3d& way) const {
        return copy == no_copy ? way : all_[copy].pose.linear().transpose() * way;
    }

    /// The axis-aligned box around a copy [m].
    Eigen::AlignedBox3d box(const FacetSet& facets, std::size_t copy) const;

 private:
    static constexpr std::uint32_t first_number = 1u << 31;
    static constexpr std::uint32_t none = 0xFFFFFFFFu;
    Place found(std::uint32_t k) const;

    std::vector<Copy> all_;
    std::vector<std::uint32_t> begin_;  // (copy + 1) facets before it
};

/// Some facets as a separate set, with their own vertices, at a copy's place.
FacetSet in_place(const FacetSet& facets, const Copy& copy);

}  // namespace diurna
