#include "isolux/calc/calculate.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

#include "isolux/base/parallel.h"
#include "isolux/calc/accumulator.h"
#include "isolux/calc/books.h"
#include "isolux/calc/engine.h"
#include "isolux/calc/stopping.h"
#include "isolux/calc/two_stages.h"

namespace isolux {

namespace {

constexpr std::size_t replicates = Engine::replicates;

/// Fewer than this carry no error bar worth the name; an interrupted run then has no result.
constexpr std::size_t fewest_replicates = 4;

/// Up to so many open points all replicates of a unit run at once.
constexpr std::size_t points_worth_waiting = 2048;

/// ... as long as their vertices, of 200 bytes each, fit into so many.
constexpr double most_vertices_at_once = 2e6;

/// A part of a point's light whose variance is less than this share of what the point may have
/// rests while the other part is refined.
constexpr double good_enough = 0.3;

/// At the first look the error of a point with a heavy tail counts so many times: it takes as
/// much work as if half of its replicates were worth nothing.
constexpr double doubt_in_tails = std::numbers::sqrt2;

/// A point darker than this share of its surface's mean is held to the tolerance of that share.
constexpr double darkest_share = 0.02;

double cpu_seconds() noexcept {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

class Calculation {
public:
    Calculation(const Scene& scene,
                std::span<const CalculationSurface> surfaces,
                const Settings& settings,
                const Control& control)
        : surfaces_(surfaces), settings_(settings), control_(control), engine_(scene, settings),
          sums_(surfaces, replicates), books_(scene, settings, sums_.points(), replicates) {
        for (const CalculationSurface& s : surfaces)
            receivers_.insert(receivers_.end(), s.receivers.begin(), s.receivers.end());
        engine_.keep_books(books_.layout());
    }

    Results run() {
        report("pilot");
        const std::size_t chosen = engine_.prepare(receivers_, target());
        const std::size_t first = settings_.fixed_units.value_or(chosen);
        expected_ = first * sums_.points();
        std::size_t done = 0;
        for (std::size_t check = 0, target = first;; ++check) {
            while (done < target && !interrupted_) {
                if (!run_unit(static_cast<std::uint32_t>(done)))
                    break;
                ++done;
            }
            if (interrupted_)
                break;
            looks_ = check + 1;
            const std::vector<OpenPoint> open = close_points(check);
            if (open.empty() || settings_.fixed_units)
                break;
            const NextLook next = engine_.adapt(open, done);
            for (const std::size_t i : next.changed) {
                sums_.change_estimator(i);
                books_.change_estimator(i);
            }
            target = done + next.units;
            expected_ = work_done_ + open.size() * next.units;
            report("calculating");
        }
        caches_ = {};
        return collect(done);
    }

private:
    // ---- steps ---------------------------------------------------------------------------

    [[nodiscard]] PilotTarget target() const {
        PilotTarget t{settings_.tolerance,
                      surfaces_.empty() ? 2.0 : rule(0).factor(0, replicates),
                      settings_.absolute_tolerance,
                      darkest_share,
                      static_cast<double>(replicates),
                      {}};
        std::size_t end = 0;
        for (const CalculationSurface& s : surfaces_)
            t.ends.push_back(end += s.receivers.size());
        return t;
    }

    /// One unit for every open point. False if it was cut short; what is worth keeping is
    /// kept.
    bool run_unit(std::uint32_t unit) {
        const std::size_t open_points = sums_.open_points();
        std::vector<std::size_t> active;
        for (std::size_t t = 0; t < sums_.tiles().size(); ++t)
            if (sums_.is_open(sums_.tiles()[t]))
                active.push_back(t);
        std::vector<std::vector<double>> direct(active.size());
        std::vector<std::vector<double>> indirect(active.size());
        std::vector<BookPage> pages(active.size());
        std::vector<RayCounts> rays(active.size());

        std::atomic<bool> cut_short = false;
        for_each_index(active.size(), 1, [&](std::size_t a) {
            if (cut_short || must_stop()) {
                cut_short = true;
                return;
            }
            pages[a] = books_.open_page(sums_.tiles()[active[a]]);
            estimate_direct_tile(sums_.tiles()[active[a]], unit, direct[a], pages[a], rays[a]);
            indirect[a].assign(direct[a].size(), 0.0);
        });
        // Replicates are independent: few points run them side by side, many one after the
        // other, so that memory stays small and an interruption finds complete ones.
        const bool are_small = open_points <= points_worth_waiting
                               && engine_.vertices_of_a_unit() <= most_vertices_at_once;
        const std::size_t side_by_side = are_small ? replicates : 1;
        std::vector<ReplicateFlux> flux(replicates);
        std::size_t complete = 0;
        while (complete < replicates && !cut_short && !must_stop()) {
            std::vector<RayCounts> own(active.size() * side_by_side);
            caches_.resize(side_by_side);
            if (!settings_.direct_only)
                for_each_index(side_by_side, 1, [&](std::size_t k) {
                    const auto r = static_cast<std::uint32_t>(complete + k);
                    VertexCache& cache = caches_[k];
                    if (engine_.needs_paths() || unit == 0)
                        cache = engine_.build_cache(r, unit, std::move(cache));
                    else
                        cache = {};
                    for_each_index(active.size(), 1, [&](std::size_t a) {
                        if (unit > 0 && (cut_short || must_stop())) {
                            cut_short = true; // only the first unit is worth its end
                            return;
                        }
                        const Accumulator::Tile& tile = sums_.tiles()[active[a]];
                        engine_.estimate_indirect(
                            cache,
                            tile.first,
                            sums_.open_indirect(tile),
                            r,
                            unit,
                            std::span(indirect[a]).subspan(r * tile.points, tile.points),
                            own[k * active.size() + a],
                            books_.entries(pages[a], tile, r));
                    });
                });
            if (cut_short)
                break;
            for (std::size_t k = 0; k < side_by_side; ++k)
                count_flux(caches_[k], flux[complete + k]);
            rays.insert(rays.end(), own.begin(), own.end());
            complete += side_by_side;
            report("calculating",
                   static_cast<double>(complete) / static_cast<double>(replicates)
                       * static_cast<double>(open_points));
        }
        for (const RayCounts& c : rays) {
            rays_.shadow += c.shadow;
            rays_.gather += c.gather;
            rays_.degenerate += c.degenerate;
        }
        if (complete < replicates) {
            interrupted_ = true;
            // Later units are dropped whole; of the first one the complete replicates stand, if
            // they are enough for an error.
            if (unit > 0)
                return false;
            sums_.keep_replicates(complete < fewest_replicates ? 0 : complete);
            if (complete < fewest_replicates)
                return false;
        }
        for (std::size_t a = 0; a < active.size(); ++a) {
            const Accumulator::Tile& tile = sums_.tiles()[active[a]];
            sums_.add_unit(tile, direct[a], indirect[a]);
            books_.add(sums_, tile, pages[a]);
        }
        if (!settings_.direct_only && (engine_.needs_paths() || unit == 0))
            keep_flux(flux);
        work_done_ += open_points;
        return complete == replicates;
    }

    void estimate_direct_tile(const Accumulator::Tile& tile,
                              std::uint32_t unit,
                              std::vector<double>& direct,
                              BookPage& page,
                              RayCounts& rays) {
        direct.resize(replicates * tile.points);
        std::vector<double> values(replicates);
        std::vector<double> by_source;
        for (std::size_t p = 0; p < tile.points; ++p) {
            const std::size_t index = tile.first + p;
            if (!sums_.direct_is_open(index))
                continue;
            engine_.plan_direct(index, rays);
            by_source.assign(books_.layout().sources * replicates, 0.0);
            engine_.estimate_direct(index, unit, 0, values, rays, by_source);
            books_.enter_direct(page, tile, p, by_source);
            for (std::size_t r = 0; r < replicates; ++r)
                direct[r * tile.points + p] = values[r];
        }
    }

    void count_flux(const VertexCache& cache, ReplicateFlux& flux) {
        const double paths = static_cast<double>(std::max<std::size_t>(1, cache.paths));
        flux = {cache.flux.absorbed / paths, cache.flux.escaped / paths};
        rays_.path += cache.flux.rays;
        paths_ += cache.paths;
    }

    void keep_flux(std::span<const ReplicateFlux> unit) {
        flux_.resize(replicates);
        for (std::size_t r = 0; r < unit.size(); ++r) {
            flux_[r].absorbed += unit[r].absorbed;
            flux_[r].escaped += unit[r].escaped;
        }
        ++flux_units_;
    }

    /// Closes the points that are within the tolerance. @return the others
    std::vector<OpenPoint> close_points(std::size_t check) {
        const std::vector<double> means = surface_means();
        std::vector<OpenPoint> open;
        worst_ = 0.0;
        for (const Accumulator::Tile& tile : sums_.tiles()) {
            const StoppingRule r = rule(tile.surface);
            const double floor = floor_of(means[tile.surface]);
            const double factor = r.factor(check, sums_.replicates());
            for (std::size_t p = 0; p < tile.points; ++p) {
                if (!sums_.is_open(tile.first + p))
                    continue;
                const Accumulator::PointEstimates e = sums_.estimates(tile, p);
                const bool is_doubtful =
                    check == 0 && !settings_.fixed_units && sums_.flags(tile, p).heavy_tail;
                const double doubt = is_doubtful ? doubt_in_tails : 1.0;
                Estimate believed = e.total;
                believed.standard_error *= doubt;
                const double value = std::max(std::abs(e.total.mean), floor);
                if (value > 0.0)
                    worst_ = std::max(worst_, factor * believed.standard_error / value);
                // A point that has changed and sees nothing any more is no point in the dark.
                const bool sees_nothing = e.indirect.standard_error == 0.0
                                          && sums_.parked_units(tile.first + p) > 0
                                          && sums_.parked(tile.first + p).mean > 0.0;
                if (!sees_nothing && r.is_met(believed, check, floor)) {
                    sums_.refine(tile.first + p, false, false);
                    continue;
                }
                open.push_back(open_point(
                    tile.first + p, e, settings_.tolerance * value / (doubt * factor)));
            }
        }
        return open;
    }

    /// Decides what of a point the next units refine. @param allowed  standard error that it
    /// may have, lx
    OpenPoint
    open_point(std::size_t point, const Accumulator::PointEstimates& e, double allowed) {
        const auto squared = [](double x) { return x * x; };
        const double all = squared(allowed);
        const double direct = squared(e.direct.standard_error);
        const double indirect = squared(e.indirect.standard_error);
        const bool refines_direct = direct > good_enough * all;
        const bool refines_indirect = indirect > good_enough * all || !refines_direct;
        sums_.refine(point, refines_direct, refines_indirect);
        // Direct light keeps its share of the error, a smaller one where it is refined.
        const double rest = std::max(0.25 * all, all - (refines_direct ? 0.5 : 1.0) * direct);
        OpenPoint open{point, refines_indirect, e.indirect.mean, rest, {}, {}};
        open.current = {sums_.indirect_units(point), indirect / rest};
        if (const std::size_t units = sums_.parked_units(point); units > 0)
            open.parked = {units, squared(sums_.parked(point).standard_error) / rest};
        return open;
    }

    // ---- details -------------------------------------------------------------------------

    [[nodiscard]] StoppingRule rule(std::size_t surface) const {
        const bool all = settings_.statement == Statement::all_points;
        return {settings_.tolerance,
                settings_.confidence,
                all ? surfaces_[surface].receivers.size() : 1};
    }

    /// Illuminance below which a point needs no better absolute accuracy, lx.
    [[nodiscard]] double floor_of(double mean) const {
        return std::max(darkest_share * mean,
                        settings_.absolute_tolerance / settings_.tolerance);
    }

    [[nodiscard]] std::vector<double> surface_means() const {
        std::vector<double> sums(surfaces_.size(), 0.0);
        for (const Accumulator::Tile& tile : sums_.tiles())
            for (std::size_t p = 0; p < tile.points; ++p)
                sums[tile.surface] += sums_.estimates(tile, p).total.mean;
        for (std::size_t s = 0; s < sums.size(); ++s)
            sums[s] /=
                static_cast<double>(std::max<std::size_t>(1, surfaces_[s].receivers.size()));
        return sums;
    }

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    [[nodiscard]] bool must_stop() const {
        return control_.stop.stop_requested()
               || (settings_.time_limit && seconds() > settings_.time_limit->count());
    }

    void report(const char* stage, double inside_unit = 0.0) const {
        if (!control_.progress)
            return;
        Progress p;
        p.stage = stage;
        p.worst_relative_error = worst_;
        const double done = static_cast<double>(work_done_) + inside_unit;
        p.fraction = expected_ > 0 ? std::min(1.0, done / static_cast<double>(expected_)) : 0.0;
        p.seconds_left = p.fraction > 0.0 ? seconds() * (1.0 - p.fraction) / p.fraction : -1.0;
        control_.progress(p);
    }

    [[nodiscard]] FluxBalance flux_balance() const {
        FluxBalance balance;
        balance.emitted = {engine_.emission().total_flux(), 0.0, 1};
        std::vector<double> absorbed;
        std::vector<double> escaped;
        for (std::size_t r = 0; r < std::min(flux_.size(), sums_.replicates()); ++r) {
            absorbed.push_back(flux_[r].absorbed / static_cast<double>(flux_units_));
            escaped.push_back(flux_[r].escaped / static_cast<double>(flux_units_));
        }
        balance.absorbed = estimate_from_replicates(absorbed);
        balance.escaped = estimate_from_replicates(escaped);
        return balance;
    }

    /// Points that have changed and got nothing since go back to what they had.
    void change_back() {
        for (std::size_t p = 0; p < sums_.points(); ++p)
            if (sums_.indirect_units(p) == 0 && sums_.parked_units(p) > 0) {
                engine_.change_back(p);
                sums_.change_estimator(p);
                books_.change_estimator(p);
            }
    }

    Results collect(std::size_t units) {
        change_back();
        Results results;
        results.converged = true;
        std::size_t point = 0;
        for (std::size_t s = 0; s < surfaces_.size(); ++s) {
            results.surfaces.push_back(sums_.surface_result(surfaces_[s], s));
            SurfaceResult& surface = results.surfaces.back();
            for (PointResult& p : surface.points)
                p.near_surface = engine_.is_near_surface(point++);
            surface.converged = std::none_of(
                sums_.tiles().begin(), sums_.tiles().end(), [&](const Accumulator::Tile& t) {
                    return t.surface == s && sums_.is_open(t);
                });
            results.converged = results.converged && surface.converged;
        }
        results.interrupted = interrupted_;
        results.flux_balance = flux_balance();
        results.rays = rays_;
        results.wall_seconds = seconds();
        results.cpu_seconds = cpu_seconds() - cpu_start_;
        results.replicates = sums_.replicates();
        results.units = units;
        results.looks = std::max<std::size_t>(1, looks_);
        results.paths = paths_;
        results.estimator = engine_.describe();
        results.notices = engine_.notices();
        results.confidence = settings_.confidence;
        books_.close(sums_, results);
        if (rays_.degenerate > 0)
            results.notices.push_back(
                {"calculation",
                 std::to_string(rays_.degenerate) + " degenerate samples counted as zero",
                 "Is a luminaire, a point or a surface of no size in the project?"});
        if (results.replicates == 0)
            results.notices.push_back(
                {"calculation",
                 "stopped before the first results (too few replicates for an error)",
                 "Give it more time?"});
        return results;
    }

    std::span<const CalculationSurface> surfaces_;
    const Settings& settings_;
    const Control& control_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double cpu_start_ = cpu_seconds();
    Engine engine_;
    Accumulator sums_;
    std::vector<VertexCache> caches_; ///< of replicates that run side by side
    Books books_;
    std::vector<Receiver> receivers_;
    std::vector<ReplicateFlux> flux_;
    std::size_t flux_units_ = 0;
    RayCounts rays_;
    std::uint64_t paths_ = 0;
    std::size_t work_done_ = 0; ///< units of points
    std::size_t expected_ = 0;
    std::size_t looks_ = 0;
    double worst_ = 0.0;
    bool interrupted_ = false;
};

} // namespace

Results calculate(const Scene& scene,
                  std::span<const CalculationSurface> surfaces,
                  const Settings& settings,
                  const Control& control) {
    if (settings.stopping == Stopping::two_stages && !settings.fixed_units)
        return calculate_in_two_stages(scene, surfaces, settings, control);
    return Calculation(scene, surfaces, settings, control).run();
}

} // namespace isolux
