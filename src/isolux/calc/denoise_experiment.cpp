#include "isolux/calc/denoise_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "isolux/base/error.h"
#include "isolux/calc/filter_experiment.h"
#include "isolux/filter/denoiser.h"
#include "isolux/filter/picture_metrics.h"

namespace isolux {

namespace {

/// Seeds of the reference's halves: far from those of the pictures.
constexpr std::uint64_t reference_seeds = 0x200000000ULL;

/// What one filter did to one picture.
struct Denoised {
    Plane grey; ///< 8-bit
    double similarity_to_own = 0.0;
    double ssim = 0.0;
    double relative_mse = 0.0;
    double seconds = 0.0;
};

struct Noisy {
    std::size_t samples = 0;
    double ssim = 0.0;
    double relative_mse = 0.0;
    double seconds = 0.0;
    std::vector<Denoised> filters;
};

Plane to_8_bit(Plane encoded) {
    constexpr float levels = 255.0F;
    for (float& v : encoded)
        v = std::round(v * levels) / levels;
    return encoded;
}

double similarity(PictureSize size, const Plane& a, const Plane& b) {
    return similarity_percent(ssim(size, a, b, SsimWindow::uniform_7, 1.0).value_or(1.0));
}

class Study {
public:
    Study(const Scene& scene,
          const View& view,
          const DenoiseTask& task,
          const std::function<void(double)>& progress)
        : scene_(scene), view_(view), progress_(progress) {
        study_.task = task;
        study_.size = {view.camera.columns, view.camera.rows};
        study_.filters = {"axis-aligned"};
        try {
            (void)OpenImageDenoise();
            study_.filters.emplace_back("oidn");
        } catch (const DeviceError& e) {
            study_.missing = e.what();
        }
        const double all = static_cast<double>(task.steps * (task.steps + 1) / 2);
        work_ = static_cast<double>(task.step_samples)
                * (all * static_cast<double>(task.seeds * study_.filters.size())
                   + static_cast<double>(task.steps * task.reference_factor));
    }

    DenoiseStudy run() {
        const DenoiseTask& task = study_.task;
        const std::size_t half = std::max<std::size_t>(
            2, task.steps * task.step_samples * task.reference_factor / 2);
        reference_.half_1 = luminance_of(
            picture(half, reference_seeds + 2 * task.seed, PictureFilter::none).raw);
        reference_.half_2 = luminance_of(
            picture(half, reference_seeds + 2 * task.seed + 1, PictureFilter::none).raw);
        reference_.mean = *reference_.half_1;
        for (std::size_t i = 0; i < reference_.mean.size(); ++i)
            reference_.mean[i] = 0.5F * (reference_.mean[i] + (*reference_.half_2)[i]);
        median_ = median_of(reference_.mean);
        encoded_reference_ = display_encoded(reference_.mean, median_);
        std::vector<std::vector<Noisy>> seeds;
        for (std::size_t s = 0; s < task.seeds; ++s) {
            seeds.emplace_back();
            for (std::size_t k = 1; k <= task.steps; ++k)
                seeds.back().push_back(measure(k * task.step_samples, task.seed + s));
        }
        for (std::size_t k = 0; k < task.steps; ++k)
            study_.steps.push_back(summarise(seeds, k));
        for (std::size_t f = 0; f < study_.filters.size(); ++f)
            study_.exponents.push_back(exponent(f));
        study_.reference_noise = noise_ / least_;
        return std::move(study_);
    }

private:
    ViewPicture picture(std::size_t samples, std::uint64_t seed, PictureFilter filter) {
        RenderSettings s;
        s.samples = samples;
        s.seed = seed;
        s.filter = filter;
        ViewPicture p = render(scene_, view_, s);
        done_ += static_cast<double>(samples);
        progress_(done_ / work_);
        return p;
    }

    double error_of(const Plane& luminance) {
        const SquaredError e = relative_squared_error(luminance, reference_);
        least_ = std::min(least_, e.value);
        noise_ = e.reference_noise;
        return e.value;
    }

    double ssim_of(const Plane& encoded) const {
        return ssim(study_.size, encoded, encoded_reference_, SsimWindow::gaussian_11, 1.0)
            .value_or(1.0);
    }

    Noisy measure(std::size_t samples, std::uint64_t seed) {
        Noisy noisy;
        noisy.samples = samples;
        Plane grey;
        for (const std::string& name : study_.filters) {
            const ViewPicture p =
                picture(samples,
                        seed,
                        name == "oidn" ? PictureFilter::oidn : PictureFilter::axis_aligned);
            if (grey.empty()) { // the raw picture is the same for every filter
                const Plane raw = luminance_of(p.raw);
                const Plane encoded = display_encoded(raw, median_);
                noisy.ssim = ssim_of(encoded);
                noisy.relative_mse = error_of(raw);
                noisy.seconds = p.cpu_seconds - p.filter_cpu_seconds;
                grey = to_8_bit(encoded);
            }
            const Plane filtered = luminance_of(p.filtered);
            const Plane encoded = display_encoded(filtered, median_);
            Denoised d;
            d.ssim = ssim_of(encoded);
            d.relative_mse = error_of(filtered);
            d.seconds = p.filter_cpu_seconds;
            d.grey = to_8_bit(encoded);
            d.similarity_to_own = similarity(study_.size, grey, d.grey);
            noisy.filters.push_back(std::move(d));
        }
        return noisy;
    }

    /// Samples of the unfiltered picture for the error of a filtered one, of one seed.
    static FilterRun
    equal_error(const std::vector<Noisy>& steps, std::size_t k, std::size_t f) {
        FilterRun run;
        run.filtered = {steps[k].samples, steps[k].filters[f].relative_mse, 1.0, 0.0};
        for (const Noisy& n : steps)
            run.unfiltered.push_back({n.samples, n.relative_mse, n.seconds, 0.0});
        find_equal_error(run);
        return run;
    }

    DenoiseStep summarise(const std::vector<std::vector<Noisy>>& seeds, std::size_t k) const {
        const auto over_seeds = [&](const auto& value) {
            std::vector<double> values;
            for (const std::vector<Noisy>& steps : seeds)
                values.push_back(value(steps));
            return estimate_from_replicates(values);
        };
        DenoiseStep step;
        step.samples = seeds.front()[k].samples;
        step.ssim = over_seeds([&](const auto& s) { return s[k].ssim; });
        step.relative_mse = over_seeds([&](const auto& s) { return s[k].relative_mse; });
        step.render_seconds = over_seeds([&](const auto& s) { return s[k].seconds; });
        for (std::size_t f = 0; f < study_.filters.size(); ++f) {
            DenoisedStep d;
            d.similarity_to_own =
                over_seeds([&](const auto& s) { return s[k].filters[f].similarity_to_own; });
            d.similarity_to_first = over_seeds([&](const auto& s) {
                return similarity(study_.size, s.front().filters[f].grey, s[k].filters[f].grey);
            });
            d.ssim = over_seeds([&](const auto& s) { return s[k].filters[f].ssim; });
            d.relative_mse =
                over_seeds([&](const auto& s) { return s[k].filters[f].relative_mse; });
            d.filter_seconds =
                over_seeds([&](const auto& s) { return s[k].filters[f].seconds; });
            d.speed_up = over_seeds([&](const auto& s) {
                const FilterRun run = equal_error(s, k, f);
                d.is_extrapolated = d.is_extrapolated || run.is_extrapolated;
                return run.sample_ratio();
            });
            step.filters.push_back(d);
        }
        return step;
    }

    /// Of 1/SSIM - 1 over the samples, by least squares of the logarithms.
    [[nodiscard]] double exponent(std::size_t f) const {
        double sx = 0.0;
        double sy = 0.0;
        double sxx = 0.0;
        double sxy = 0.0;
        const auto n = static_cast<double>(study_.steps.size());
        for (const DenoiseStep& step : study_.steps) {
            const double x = std::log(static_cast<double>(step.samples));
            const double own = ssim_of_similarity(step.filters[f].similarity_to_own.mean);
            const double y = std::log(1.0 / own - 1.0);
            sx += x;
            sy += y;
            sxx += x * x;
            sxy += x * y;
        }
        return (n * sxy - sx * sy) / (n * sxx - sx * sx);
    }

    const Scene& scene_;
    const View& view_;
    const std::function<void(double)>& progress_;
    DenoiseStudy study_;
    Reference reference_;
    Plane encoded_reference_;
    double median_ = 0.0;
    double least_ = std::numeric_limits<double>::infinity();
    double noise_ = 0.0;
    double work_ = 1.0;
    double done_ = 0.0;
};

} // namespace

DenoiseStudy study_denoising(const Scene& scene,
                             const View& view,
                             const DenoiseTask& task,
                             const std::function<void(double)>& progress) {
    return Study(scene, view, task, progress).run();
}

} // namespace isolux
