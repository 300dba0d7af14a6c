#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "isolux/calc/accumulator.h"
#include "isolux/calc/project.h"
#include "isolux/transport/light_ledger.h"

namespace isolux {

/// What one unit of a tile enters into the books: rows of [replicate][row][point in tile], lx.
struct BookPage {
    std::vector<double> direct; ///< rows: sources
    std::vector<double> indirect;
    std::vector<double> derivatives; ///< rows: materials
};

/// Where the indirect light of one replicate and tile is entered: [row][point in tile]. Empty
/// where no such book is kept.
struct BookEntries {
    std::span<double> by_source;
    std::span<double> by_material;
};

/// The books of a calculation beside its totals: the light of every source by itself and the
/// derivatives by reflectance, as the settings ask for. One float for each value, and two
/// doubles while a unit runs.
class Books {
public:
    Books(const Scene& scene,
          const Settings& settings,
          std::size_t points,
          std::size_t replicates);

    /// What the estimators have to tell apart.
    [[nodiscard]] const LedgerLayout& layout() const noexcept { return layout_; }

    /// An empty page for one unit of a tile.
    [[nodiscard]] BookPage open_page(const Accumulator::Tile& tile) const;

    /// The part of a page that indirect light of a replicate goes to.
    [[nodiscard]] BookEntries
    entries(BookPage& page, const Accumulator::Tile& tile, std::size_t replicate) const;

    /// Enters the direct light of one point for all replicates. @param by_source
    /// [source][replicate]
    void enter_direct(BookPage& page,
                      const Accumulator::Tile& tile,
                      std::size_t point_in_tile,
                      std::span<const double> by_source) const;

    /// Adds a complete unit to what is open of the tile's points. Different tiles may be added
    /// by different threads.
    void add(const Accumulator& sums, const Accumulator::Tile& tile, const BookPage& page);

    /// Another estimator takes over the indirect light of a point, as in Accumulator.
    void change_estimator(std::size_t point);

    /// Puts the means over the units into the results, and says what was left out.
    void close(const Accumulator& sums, Results& results) const;

private:
    /// One kind of value: [row][replicate][point], sums over units.
    struct Book {
        std::size_t rows = 0;
        std::vector<float> sums;
        std::map<std::size_t, std::vector<float>> parked{}; ///< by point: [row][replicate]
    };

    [[nodiscard]] Book make_book(std::size_t rows) const;
    enum class Part { direct, indirect };

    void add(Book& book,
             Part part,
             const Accumulator& sums,
             const Accumulator::Tile& tile,
             const std::vector<double>& page);
    [[nodiscard]] std::vector<float>
    means(const Book& book, Part part, const Accumulator& sums) const;

    std::size_t points_;
    std::size_t replicates_;
    LedgerLayout layout_;
    std::vector<LightSource> sources_;
    std::vector<SensitiveMaterial> materials_;
    Book direct_;
    Book indirect_;
    Book derivatives_;
    std::vector<Message> notices_;
};

} // namespace isolux
