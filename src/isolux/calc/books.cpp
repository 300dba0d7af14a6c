#include "isolux/calc/books.h"

#include <utility>

#include <fmt/format.h>

#include "isolux/calc/study_estimators.h"

namespace isolux {

Books::Books(const Scene& scene,
             const Settings& settings,
             std::size_t points,
             std::size_t replicates)
    : points_(points), replicates_(replicates) {
    // The estimators for study say how much light there is, not whose.
    const bool keeps = !StudyEstimators::serves(settings.estimator);
    if (!keeps && (settings.contributions > SourceSplit::none || settings.sensitivities))
        notices_.push_back({"calculation",
                            "neither contributions nor sensitivities were kept (the estimators "
                            "for study do not tell whose light it is)",
                            "Take the default estimator?"});
    if (keeps && settings.contributions != SourceSplit::none) {
        const bool is_automatic = settings.contributions == SourceSplit::automatic;
        sources_ = find_light_sources(
            scene, is_automatic ? SourceSplit::groups : settings.contributions);
        const std::size_t values = 2 * sources_.size() * points * replicates;
        if (is_automatic && values > most_automatic_values) {
            notices_.push_back(
                {"calculation",
                 fmt::format(
                     "the light of {} sources at {} points is not kept apart (the table "
                     "would take {} MiB)",
                     sources_.size(),
                     points,
                     values * sizeof(float) >> 20U),
                 "Set \"contributions\" to \"groups\" in the settings?"});
            sources_.clear();
        }
    }
    if (!sources_.empty()) {
        layout_.source_of = source_of_luminaires(sources_, scene.luminaires.size());
        layout_.sources = sources_.size();
    }
    if (keeps && settings.sensitivities) {
        materials_ = find_sensitive_materials(scene);
        layout_.materials = materials_.size();
        layout_.row_of.assign(scene.materials.size(), 0);
        layout_.inverse_reflectance.assign(scene.materials.size(), 0.0);
        for (std::uint32_t m = 0; m < materials_.size(); ++m) {
            layout_.row_of[materials_[m].id.index()] = m;
            layout_.inverse_reflectance[materials_[m].id.index()] =
                1.0 / materials_[m].reflectance;
        }
    }
    direct_ = make_book(sources_.size());
    indirect_ = make_book(sources_.size());
    derivatives_ = make_book(materials_.size());
}

Books::Book Books::make_book(std::size_t rows) const {
    return {rows, std::vector<float>(rows * replicates_ * points_, 0.0F), {}};
}

BookPage Books::open_page(const Accumulator::Tile& tile) const {
    const std::size_t n = replicates_ * tile.points;
    return {std::vector<double>(direct_.rows * n, 0.0),
            std::vector<double>(indirect_.rows * n, 0.0),
            std::vector<double>(derivatives_.rows * n, 0.0)};
}

BookEntries
Books::entries(BookPage& page, const Accumulator::Tile& tile, std::size_t replicate) const {
    const auto part = [&](std::vector<double>& values, std::size_t rows) {
        const std::size_t n = rows * tile.points;
        return std::span(values).subspan(replicate * n, n);
    };
    return {part(page.indirect, indirect_.rows), part(page.derivatives, derivatives_.rows)};
}

void Books::enter_direct(BookPage& page,
                         const Accumulator::Tile& tile,
                         std::size_t point_in_tile,
                         std::span<const double> by_source) const {
    for (std::size_t s = 0; s < direct_.rows; ++s)
        for (std::size_t r = 0; r < replicates_; ++r)
            page.direct[(r * direct_.rows + s) * tile.points + point_in_tile] =
                by_source[s * replicates_ + r];
}

void Books::add(Book& book,
                Part part,
                const Accumulator& sums,
                const Accumulator::Tile& tile,
                const std::vector<double>& page) {
    std::size_t i = 0;
    for (std::size_t r = 0; r < replicates_; ++r)
        for (std::size_t row = 0; row < book.rows; ++row)
            for (std::size_t p = 0; p < tile.points; ++p, ++i) {
                const std::size_t point = tile.first + p;
                if (part == Part::direct ? !sums.direct_is_open(point)
                                         : !sums.indirect_is_open(point))
                    continue;
                book.sums[(row * replicates_ + r) * points_ + point] +=
                    static_cast<float>(page[i]);
            }
}

void Books::add(const Accumulator& sums, const Accumulator::Tile& tile, const BookPage& page) {
    add(direct_, Part::direct, sums, tile, page.direct);
    add(indirect_, Part::indirect, sums, tile, page.indirect);
    add(derivatives_, Part::indirect, sums, tile, page.derivatives);
}

std::vector<float> Books::means(const Book& book, Part part, const Accumulator& sums) const {
    const std::size_t kept = sums.replicates();
    std::vector<float> values(book.rows * kept * points_, 0.0F);
    for (std::size_t p = 0; p < sums.points(); ++p) {
        const std::size_t units =
            part == Part::direct ? sums.direct_units(p) : sums.indirect_units(p);
        if (units == 0)
            continue;
        for (std::size_t row = 0; row < book.rows; ++row)
            for (std::size_t r = 0; r < kept; ++r)
                values[(row * kept + r) * points_ + p] =
                    book.sums[(row * replicates_ + r) * points_ + p]
                    / static_cast<float>(units);
    }
    return values;
}

void Books::change_estimator(std::size_t point) {
    for (Book* book : {&indirect_, &derivatives_}) {
        std::vector<float>& other = book->parked[point];
        other.resize(book->rows * replicates_);
        for (std::size_t i = 0; i < other.size(); ++i)
            std::swap(other[i], book->sums[i * points_ + point]);
    }
}

void Books::close(const Accumulator& sums, Results& results) const {
    const std::size_t kept = sums.replicates();
    results.notices.insert(results.notices.end(), notices_.begin(), notices_.end());
    if (!sources_.empty() && kept > 0)
        results.contributions = Contributions{sources_,
                                              kept,
                                              points_,
                                              means(direct_, Part::direct, sums),
                                              means(indirect_, Part::indirect, sums)};
    if (!materials_.empty() && kept > 0)
        results.sensitivities =
            Sensitivities{materials_, kept, points_, means(derivatives_, Part::indirect, sums)};
}

} // namespace isolux
