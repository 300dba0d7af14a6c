#include "isolux/calc/filter_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "isolux/base/check.h"
#include "isolux/filter/picture_metrics.h"

namespace isolux {

namespace {

/// Seeds of the reference's halves: far from those of the pictures.
constexpr std::uint64_t reference_seeds = 0x100000000ULL;

RenderSettings settings_of(const FilterTask& task, std::size_t samples, std::uint64_t seed) {
    RenderSettings s;
    s.samples = samples;
    s.filter = PictureFilter::none;
    s.seed = seed;
    s.direct_only = task.direct_only;
    return s;
}

std::size_t count_of(const FilterTask& task, double multiple) {
    return std::max<std::size_t>(
        2, static_cast<std::size_t>(std::lround(multiple * static_cast<double>(task.samples))));
}

/// CPU seconds of an unfiltered picture of n samples: a straight line by least squares.
double seconds_at(const std::vector<FilterMeasurement>& runs, double n) {
    double sn = 0.0;
    double st = 0.0;
    double snn = 0.0;
    double snt = 0.0;
    const auto count = static_cast<double>(runs.size());
    for (const FilterMeasurement& m : runs) {
        const auto x = static_cast<double>(m.samples);
        sn += x;
        st += m.cpu_seconds;
        snn += x * x;
        snt += x * m.cpu_seconds;
    }
    const double slope = (count * snt - sn * st) / (count * snn - sn * sn);
    return (st - slope * sn) / count + slope * n;
}

} // namespace

double FilterRun::sample_ratio() const noexcept {
    return equal_samples / static_cast<double>(filtered.samples);
}

double FilterRun::time_ratio() const noexcept { return equal_seconds / filtered.cpu_seconds; }

Plane luminance_of(const Planes3& colour) {
    Plane y(colour.x.size());
    for (std::size_t i = 0; i < y.size(); ++i)
        y[i] = static_cast<float>(luminance_sum(colour.colour(i)));
    return y;
}

void find_equal_error(FilterRun& run) {
    const std::vector<FilterMeasurement>& u = run.unfiltered;
    ISOLUX_EXPECT(u.size() >= 2);
    const double wanted = run.filtered.relative_mse;
    std::size_t k = 0;
    while (k + 2 < u.size() && u[k + 1].relative_mse > wanted)
        ++k;
    const double slope =
        std::log(u[k + 1].relative_mse / u[k].relative_mse)
        / std::log(static_cast<double>(u[k + 1].samples) / static_cast<double>(u[k].samples));
    run.equal_samples = static_cast<double>(u[k].samples)
                        * std::exp(std::log(wanted / u[k].relative_mse) / slope);
    run.is_extrapolated = run.equal_samples > static_cast<double>(u.back().samples)
                          || run.equal_samples < static_cast<double>(u.front().samples);
    run.equal_seconds = seconds_at(u, run.equal_samples);
}

FilterComparison compare_filter(const Scene& scene,
                                const View& view,
                                const FilterTask& task,
                                const std::function<void(double)>& progress) {
    FilterComparison c;
    c.task = task;
    c.size = {view.camera.columns, view.camera.rows};
    const auto n = static_cast<double>(task.samples);
    double work = n * 2.0 * static_cast<double>(task.reference_factor);
    double per_seed = n;
    for (const double m : unfiltered_multiples)
        per_seed += n * m;
    work += per_seed * static_cast<double>(task.seeds);
    double done = 0.0;
    const auto picture = [&](const RenderSettings& settings) {
        ViewPicture p = render(scene, view, settings);
        done += static_cast<double>(settings.samples);
        progress(done / work);
        return p;
    };
    Reference reference;
    const std::size_t many = task.samples * task.reference_factor;
    reference.half_1 =
        luminance_of(picture(settings_of(task, many, reference_seeds + 2 * task.seed)).raw);
    reference.half_2 =
        luminance_of(picture(settings_of(task, many, reference_seeds + 2 * task.seed + 1)).raw);
    reference.mean = *reference.half_1;
    for (std::size_t i = 0; i < reference.mean.size(); ++i)
        reference.mean[i] = 0.5F * (reference.mean[i] + (*reference.half_2)[i]);
    double least = std::numeric_limits<double>::infinity();
    double noise = 0.0;
    const auto measure = [&](const RenderSettings& settings) {
        const ViewPicture p = picture(settings);
        const SquaredError e = relative_squared_error(luminance_of(p.shown()), reference);
        least = std::min(least, e.value);
        noise = e.reference_noise;
        return FilterMeasurement{
            settings.samples, e.value, p.cpu_seconds, p.filter_cpu_seconds};
    };
    std::vector<double> sample_ratios;
    std::vector<double> time_ratios;
    for (std::size_t s = 0; s < task.seeds; ++s) {
        FilterRun run;
        run.seed = task.seed + s;
        RenderSettings settings = settings_of(task, task.samples, run.seed);
        settings.filter = PictureFilter::axis_aligned;
        run.filtered = measure(settings);
        for (const double m : unfiltered_multiples)
            run.unfiltered.push_back(measure(settings_of(task, count_of(task, m), run.seed)));
        find_equal_error(run);
        sample_ratios.push_back(run.sample_ratio());
        time_ratios.push_back(run.time_ratio());
        c.runs.push_back(std::move(run));
    }
    c.sample_ratio = estimate_from_replicates(sample_ratios);
    c.time_ratio = estimate_from_replicates(time_ratios);
    c.reference_noise = noise / least;
    return c;
}

} // namespace isolux
