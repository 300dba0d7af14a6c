#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/base/colour.h"
#include "isolux/base/ids.h"

namespace isolux {

/// The diffuse reflections of paths, written down backwards: every entry names a material and
/// the entry before it, so that paths with a common beginning share it. 8 bytes an entry.
class Trails {
public:
    static constexpr std::uint32_t none = 0;

    void clear() noexcept { entries_.clear(); }

    /// One reflection more. @return the trail that ends with it
    std::uint32_t add(MaterialId material, std::uint32_t before) {
        entries_.push_back({material, before});
        return static_cast<std::uint32_t>(entries_.size());
    }

    /// Calls `f(material)` for every reflection of a trail, the last one first.
    template <class F> void visit(std::uint32_t trail, F&& f) const {
        for (; trail != none; trail = entries_[trail - 1].before)
            f(entries_[trail - 1].material);
    }

private:
    struct Entry {
        MaterialId material;
        std::uint32_t before = none;
    };

    std::vector<Entry> entries_;
};

/// What books are kept of besides the light as a whole.
struct LedgerLayout {
    std::vector<std::uint32_t> source_of; ///< by luminaire; empty: sources are not told apart
    std::size_t sources = 0;
    /// By material of the scene: its row, and 1 / rho; 0 for one whose derivative is not
    /// wanted.
    std::vector<std::uint32_t> row_of;
    std::vector<double> inverse_reflectance; ///< empty: no derivatives are wanted
    std::size_t materials = 0;               ///< rows
};

/// Where the light that reaches neighbouring points is written down, lx: as a whole, and, where
/// asked for, by the luminaires' sources (METHODS "Contributions") and as derivatives by the
/// materials' reflectances (METHODS "Derivatives"). Refers to memory of its owner; adds, never
/// clears.
struct LightLedger {
    std::span<Rgb> total; ///< by point
    const LedgerLayout* layout = nullptr;
    std::span<double> by_source;   ///< Y-sum, [source][point]; empty: not told apart
    std::span<double> by_material; ///< lx for a reflectance of 1, [row][point]; empty: not kept

    [[nodiscard]] bool wants_trails() const noexcept { return !by_material.empty(); }

    void add(std::size_t point, std::size_t luminaire, const Rgb& light) const noexcept {
        total[point] += light;
        add_to_source(point, luminaire, light);
    }

    void
    add_to_source(std::size_t point, std::size_t luminaire, const Rgb& light) const noexcept {
        if (!by_source.empty())
            by_source[layout->source_of[luminaire] * total.size() + point] +=
                luminance_sum(light);
    }

    /// The light of a path was also reflected by `material`.
    void add_reflection(std::size_t point, MaterialId material, double lux) const noexcept {
        const std::size_t m = material.index();
        if (layout->inverse_reflectance[m] > 0.0)
            by_material[layout->row_of[m] * total.size() + point] +=
                lux * layout->inverse_reflectance[m];
    }

    /// Light and all its reflections.
    void add(std::size_t point,
             std::size_t luminaire,
             const Rgb& light,
             const Trails& trails,
             std::uint32_t trail) const noexcept {
        add(point, luminaire, light);
        if (!wants_trails())
            return;
        const double lux = luminance_sum(light);
        trails.visit(trail, [&](MaterialId m) { add_reflection(point, m, lux); });
    }
};

} // namespace isolux
