#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "isolux/base/vec.h"
#include "isolux/transport/light_tree.h"

namespace isolux {

/// How intensities are spread about an axis, as draws weigh them: luminaires of one type share
/// a table.
class GlowTables {
public:
    /// Intensities by the cosine to the axis, from -1.
    static constexpr std::size_t cells = 32;

    GlowTables();

    /// @return  where the table of these luminaires begins in values()
    int add(const LightBounds& bounds);

    [[nodiscard]] const float* values() const noexcept { return values_.data(); }

private:
    using Table = std::array<float, cells>;

    std::map<Table, int> known_;
    std::vector<float> values_; ///< cd, at least the intensity; the first table is dark
};

/// A few luminaires, or groups of them, all of them weighed for every place that wants the
/// light of one: METHODS "Many luminaires". What weighs stands side by side in single
/// precision, so that the processor weighs several at a time; the draws follow these very
/// numbers.
class LuminairePick {
public:
    static constexpr std::size_t most = 64;

    /// So many are weighed at a time.
    static constexpr std::size_t wide = 8;

    explicit LuminairePick(std::shared_ptr<const GlowTables> tables)
        : tables_(std::move(tables)) {}

    [[nodiscard]] std::size_t size() const noexcept { return count_; }

    /// @pre  called less than `most` times
    /// @param glow  where the table begins  @param axis  that it is about
    void add(int glow, const UnitVector3& axis, const Point3& centre, double largest_dimension);

    struct Pick {
        std::size_t entry = 0;
        double probability = 0.0;
        double rest = 0.0; ///< as good as a new number in [0, 1)
    };

    /// One of them, drawn with one number in [0, 1).
    [[nodiscard]] Pick pick(const Point3& place, double u) const noexcept;

    /// Probability with which pick(place, u) draws an entry.
    [[nodiscard]] double probability(const Point3& place, std::size_t entry) const noexcept;

    using Lanes = std::array<float, most>;

    struct Lights {
        Lanes x{}, y{}, z{};                ///< m, from the first one
        Lanes axis_x{}, axis_y{}, axis_z{}; ///< their light is spread about it
        Lanes spread{};                     ///< m2, added to the squared distance
        std::array<int, most> glow{};       ///< beginning of their table
    };

private:
    struct Weights {
        Lanes of;
        std::array<double, most / wide> of_block; ///< of `wide` each
        double sum = 0.0;
    };

    [[nodiscard]] Weights weigh(const Point3& place) const noexcept;

    std::shared_ptr<const GlowTables> tables_;
    std::size_t count_ = 0;
    std::size_t blocks_ = 0;
    Point3 first_;
    Lights lights_;
};

} // namespace isolux
