#include "isolux/calc/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "isolux/base/parallel.h"
#include "isolux/calc/view_finish.h"
#include "isolux/calc/view_render.h"
#include "isolux/filter/denoiser.h"

namespace isolux {

namespace {

constexpr std::size_t most_samples = 65535;
constexpr std::size_t grain = 4096;          ///< pixels
constexpr double least_planned = 8.0;        ///< below, all pixels get the same
constexpr double samples_of_a_cycle = 16.0;  ///< a pixel, on average
constexpr std::size_t tile_rows_at_once = 4; ///< between looks at the clock

double cpu_seconds() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

class Rendering {
public:
    Rendering(const Scene& scene,
              const View& view,
              const RenderSettings& settings,
              const Control& control,
              const PictureRows& rows)
        : view_(view), settings_(settings), control_(control),
          denoiser_(load_denoiser(settings)), setup_(scene, view, settings_, rows),
          buffers_(make_view_buffers(setup_)), sums_(setup_.size.pixels()) {
        const std::size_t n = setup_.size.pixels();
        pilot_.is_near_edge.assign(n, 0);
        pilot_.faint.assign(n, 0);
        pilot_.has_more.assign(n, 0);
        pilot_.has_luminaire.assign(n, 0);
        pilot_.reflected.assign(n, 0.0F);
        for_each_index(buffers_.lights.size(), 1, [&](std::size_t k) {
            buffers_.lights[k].visible_a.assign(n, 0.0F);
            buffers_.lights[k].visible_b.assign(n, 0.0F);
        });
    }

    ViewPicture run() {
        const std::size_t samples = std::clamp<std::size_t>(settings_.samples, 2, most_samples);
        passes_ = static_cast<std::uint32_t>(samples);
        wanted_ = static_cast<double>(samples * setup_.size.pixels());
        plan_.active = {setup_.size.pixels()};
        if (!walk_pilot())
            return finish();
        make_plan(static_cast<double>(samples));
        std::size_t next_check = 2 * picture_replicates;
        for (std::uint32_t pass = passes_done_; pass < passes_; ++pass) {
            if (!run_pass(pass))
                break;
            // Complete sets of replicates only, at doublings.
            if (settings_.tolerance && (pass + 1) % picture_replicates == 0
                && taken_ >= static_cast<double>(next_check * setup_.size.pixels())) {
                next_check *= 2;
                if (sums_.error() <= *settings_.tolerance)
                    break;
            }
        }
        return finish();
    }

private:
    /// Before the long work, so that its absence is told at once.
    static std::optional<OpenImageDenoise> load_denoiser(const RenderSettings& settings) {
        if (settings.filter != PictureFilter::oidn)
            return std::nullopt;
        return OpenImageDenoise();
    }

    /// Previews take their first samples on the way, along the pilot's rays.
    bool walk_pilot() {
        const std::uint32_t first_passes = settings_.is_preview ? rays_of_preview : 0;
        for (std::uint32_t pass = 0; pass < first_passes; ++pass)
            prepare_caches(pass, 0);
        for (std::size_t row = 0; row < tiles_.rows; row += tile_rows_at_once) {
            if (must_stop())
                return false;
            const double share = static_cast<double>(row) / static_cast<double>(tiles_.rows);
            report("pilot", settings_.is_preview ? share : 0.0);
            for_tiles(row, [&](std::size_t first_column, std::size_t first_row) {
                thread_local SeenTile seen;
                SeenTile* const keep = settings_.is_preview ? &seen : nullptr;
                run_pilot(setup_, first_column, first_row, buffers_, pilot_, keep);
                for (std::uint32_t pass = 0; pass < first_passes; ++pass)
                    run_tile(pass, 0, first_column, first_row, keep);
            });
        }
        passes_done_ = first_passes;
        taken_ = static_cast<double>(first_passes * setup_.size.pixels());
        return true;
    }

    /// Calls f(first_column, first_row) for the tiles of some rows of them, in parallel.
    template <class F> void for_tiles(std::size_t first, F&& f) const {
        const std::size_t rows = std::min(tile_rows_at_once, tiles_.rows - first);
        for_each_index(rows * tiles_.columns, 1, [&](std::size_t t) {
            f(t % tiles_.columns * tile_side, (first + t / tiles_.columns) * tile_side);
        });
    }

    /// Pictures that are filtered along surfaces get their samples where they are needed.
    void make_plan(double samples) {
        const bool is_even = settings_.filter != PictureFilter::axis_aligned
                             || settings_.is_preview || samples < least_planned;
        if (!is_even) {
            report("pilot", 0.0);
            const double cycles = std::max(1.0, std::round(samples / samples_of_a_cycle));
            plan_ = plan_samples(setup_, pilot_, buffers_, samples / cycles);
            passes_ = static_cast<std::uint32_t>(
                cycles * static_cast<double>(plan_.active.size() * picture_replicates));
        }
        pilot_.has_more = {};
        pilot_.has_luminaire = {};
        pilot_.reflected = {};
    }

    bool run_pass(std::uint32_t pass) {
        if (must_stop())
            return false;
        const std::size_t block = pass / picture_replicates % plan_.active.size();
        prepare_caches(pass, block);
        for (std::size_t first = 0; first < tiles_.rows; first += tile_rows_at_once) {
            if (must_stop())
                return false;
            const double share = static_cast<double>(first) / static_cast<double>(tiles_.rows);
            report("rendering",
                   (taken_ + share * static_cast<double>(plan_.active[block])) / wanted_);
            for_tiles(first, [&](std::size_t first_column, std::size_t first_row) {
                run_tile(pass, block, first_column, first_row, nullptr);
            });
        }
        taken_ += static_cast<double>(plan_.active[block]);
        return true;
    }

    void prepare_caches(std::uint32_t pass, std::size_t block) {
        const std::uint32_t replicate = pass % picture_replicates;
        std::vector<VertexCache>& caches = caches_[replicate];
        // Few pixels go on with other slices of the paths they have.
        constexpr std::size_t many = 4;
        used_[replicate] += plan_.active[block];
        if (caches.empty() || used_[replicate] * many >= setup_.size.pixels()) {
            caches = build_caches(setup_, replicate, pass / picture_replicates);
            used_[replicate] = 0;
        }
    }

    void run_tile(std::uint32_t pass,
                  std::size_t block,
                  std::size_t first_column,
                  std::size_t first_row,
                  const SeenTile* seen) {
        add_samples(setup_,
                    pass,
                    plan_,
                    block,
                    caches_[pass % picture_replicates],
                    first_column,
                    first_row,
                    pilot_,
                    buffers_,
                    sums_,
                    seen);
    }

    [[nodiscard]] bool must_stop() {
        const bool stop =
            control_.stop.stop_requested()
            || (settings_.time_limit
                && std::chrono::steady_clock::now() - start_ > *settings_.time_limit);
        interrupted_ = interrupted_ || stop;
        return stop;
    }

    void report(const char* stage, double fraction) const {
        if (!control_.progress)
            return;
        const double seconds = this->seconds();
        Progress p;
        p.stage = stage;
        p.fraction = fraction;
        p.seconds_left = fraction > 0.02 ? seconds * (1.0 - fraction) / fraction : -1.0;
        control_.progress(p);
    }

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    /// Sums become means, in the buffers and in the picture.
    ViewPicture finish() {
        const std::size_t n = setup_.size.pixels();
        ViewPicture picture;
        picture.view = view_.name;
        picture.size = setup_.size;
        picture.error = sums_.error();
        picture.standard_error.resize(n);
        picture.samples.resize(n);
        for_each_index(n, grain, [&](std::size_t i) {
            picture.standard_error[i] = static_cast<float>(sums_.standard_error(i));
            picture.samples[i] = static_cast<float>(sums_.passes[i]);
        });
        sums_.divide(buffers_);
        picture.raw = std::move(sums_.raw);
        picture.direct = std::move(sums_.direct);
        picture.emission = std::move(sums_.emission);
        picture.albedo = std::move(sums_.albedo);
        picture.illuminance = std::move(sums_.illuminance);
        picture.indirect = subtract(picture.raw, picture.direct, picture.emission);
        picture.bytes_a_pixel = bytes_held(buffers_);
        sums_.replicate.clear();
        picture.is_preview = settings_.is_preview;
        picture.interrupted = interrupted_;
        const double before = cpu_seconds();
        if (settings_.filter == PictureFilter::axis_aligned) {
            report("filtering", 1.0);
            filter_along_surfaces(buffers_, picture);
        }
        take_geometry(setup_.scene, buffers_, picture);
        if (denoiser_)
            denoise(picture);
        picture.filter_cpu_seconds = cpu_seconds() - before;
        picture.wall_seconds = seconds();
        picture.cpu_seconds = cpu_seconds() - cpu_start_;
        return picture;
    }

    void denoise(ViewPicture& picture) {
        report("denoising", 1.0);
        // Through a lens every ray of a pixel may show something else.
        constexpr std::size_t many_samples = 16;
        const bool is_noise_free = !setup_.camera.has_lens() && !picture.interrupted
                                   && settings_.samples >= many_samples;
        picture.filtered = denoiser_->apply(
            {picture.size, &picture.raw, &picture.albedo, &picture.normal, is_noise_free});
        picture.filter = "oidn";
    }

    const View& view_;
    RenderSettings settings_;
    const Control& control_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double cpu_start_ = cpu_seconds();
    std::optional<OpenImageDenoise> denoiser_;
    ViewSetup setup_;
    PictureSize tiles_{(setup_.size.columns + tile_side - 1) / tile_side,
                       (setup_.size.rows + tile_side - 1) / tile_side};
    PixelBuffers buffers_;
    PilotPlanes pilot_;
    SamplePlan plan_;
    std::uint32_t passes_ = 0;
    std::uint32_t passes_done_ = 0; ///< with the pilot
    double wanted_ = 0.0;           ///< samples, of all pixels together
    double taken_ = 0.0;
    std::array<std::vector<VertexCache>, picture_replicates> caches_;
    std::array<std::size_t, picture_replicates> used_{}; ///< pixels that used them
    PictureSums sums_;
    bool interrupted_ = false;
};

} // namespace

ViewPicture render_rows(const Scene& scene,
                        const View& view,
                        const RenderSettings& settings,
                        const Control& control,
                        const PictureRows& rows) {
    return Rendering(scene, view, settings, control, rows).run();
}

} // namespace isolux
