#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "isolux/base/vec.h"
#include "isolux/transport/light_tree.h"

namespace isolux {

/// A few luminaires, all of them weighed for every place that wants the light of one: METHODS
/// "Many luminaires". What weighs stands side by side in single precision, so that the
/// processor weighs several at a time; the draws follow these very numbers.
class LuminairePick {
public:
    static constexpr std::size_t most = 64;

    /// So many are weighed at a time.
    static constexpr std::size_t wide = 8;

    /// @pre  called less than `most` times
    void add(const LightBounds& bounds, const Point3& centre, double largest_dimension);

    /// One of them, drawn with one number in [0, 1).
    [[nodiscard]] LightTree::Pick pick(const Point3& place, double u) const noexcept;

    /// Probability with which pick(place, u) draws a luminaire.
    [[nodiscard]] double probability(const Point3& place, std::size_t luminaire) const noexcept;

    /// Intensities by the cosine to the axis, from -1.
    static constexpr std::size_t cells = 32;

    using Lanes = std::array<float, most>;

    struct Lights {
        Lanes x{}, y{}, z{};                ///< m, from the first one
        Lanes axis_x{}, axis_y{}, axis_z{}; ///< their light is spread about it
        Lanes spread{};                     ///< m2, added to the squared distance
        std::vector<float> glow;            ///< cd, at least the intensity: cells of each
    };

private:
    struct Weights {
        Lanes of;
        std::array<double, most / wide> of_block; ///< of `wide` each
        double sum = 0.0;
    };

    [[nodiscard]] Weights weigh(const Point3& place) const noexcept;

    std::size_t count_ = 0;
    std::size_t blocks_ = 0;
    Point3 first_;
    Lights lights_;
};

} // namespace isolux
