#include "isolux/calc/view_bands.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isolux {

namespace {

/// Rows begin at multiples of this: tiles, blocks and slices are then those of the whole
/// picture.
constexpr std::size_t step = 16;

/// As far as a pixel's filtered value depends on others by more than 5e-4: the largest radius,
/// half a window, what smooths widths and their choice, and the search for a second surface.
constexpr std::size_t margin = 96;

/// Kept are at least so many rows of a band, however wide the picture.
constexpr std::size_t fewest_rows = 160;

constexpr std::array colours{&ViewPicture::raw,
                             &ViewPicture::filtered,
                             &ViewPicture::emission,
                             &ViewPicture::direct,
                             &ViewPicture::indirect,
                             &ViewPicture::albedo,
                             &ViewPicture::normal,
                             &ViewPicture::position};
constexpr std::array planes{&ViewPicture::standard_error,
                            &ViewPicture::filtered_error,
                            &ViewPicture::filter_width,
                            &ViewPicture::depth,
                            &ViewPicture::illuminance,
                            &ViewPicture::filtered_illuminance,
                            &ViewPicture::samples};
constexpr std::size_t bytes_of_picture =
    (3 * colours.size() + planes.size() + 1) * sizeof(float);

template <class T>
void copy_rows(const std::vector<T>& from,
               std::vector<T>& to,
               PictureSize whole,
               const PictureBand& band) {
    if (from.empty())
        return;
    to.resize(whole.pixels());
    const std::size_t skipped = (band.kept.first - band.rendered.first) * whole.columns;
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(skipped),
                band.kept.count * whole.columns,
                to.begin() + static_cast<std::ptrdiff_t>(band.kept.first * whole.columns));
}

/// Takes a band's rows into the picture.
void join(ViewPicture& whole, ViewPicture&& part, const PictureBand& band) {
    const auto copy = [&](const auto& from, auto& to) {
        copy_rows(from, to, whole.size, band);
    };
    for (const auto plane : planes)
        copy(part.*plane, whole.*plane);
    for (const auto c : colours)
        for (const auto plane : {&Planes3::x, &Planes3::y, &Planes3::z})
            copy(part.*c.*plane, whole.*c.*plane);
    copy(part.object, whole.object);
    whole.object_names = std::move(part.object_names);
    whole.view = part.view;
    whole.filter = part.filter;
    whole.is_preview = part.is_preview;
    whole.interrupted = whole.interrupted || part.interrupted;
    whole.wall_seconds += part.wall_seconds;
    whole.cpu_seconds += part.cpu_seconds;
    whole.filter_cpu_seconds += part.filter_cpu_seconds;
    whole.rays += part.rays;
    const double share = static_cast<double>(band.rendered.count * whole.size.columns)
                         / static_cast<double>(whole.size.pixels());
    const double held = share * static_cast<double>(part.bytes_a_pixel);
    whole.bytes_a_pixel =
        std::max(whole.bytes_a_pixel, bytes_of_picture + static_cast<std::size_t>(held));
}

/// METHODS eq. (91).
double error_of(const ViewPicture& picture) {
    const std::size_t n = picture.size.pixels();
    double mean = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        mean += luminance_sum(picture.raw.colour(i)) / static_cast<double>(n);
    if (!(mean > 0.0))
        return 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double e = picture.standard_error[i];
        const double y = luminance_sum(picture.raw.colour(i));
        sum += e * e / (y * y + 0.01 * mean * mean);
    }
    return std::sqrt(sum / static_cast<double>(n));
}

} // namespace

std::vector<PictureBand> bands_of(const Camera& camera, const RenderSettings& settings) {
    const PictureSize size{camera.columns, camera.rows};
    const PictureRows all{0, size.rows};
    const bool is_filtered = settings.filter == PictureFilter::axis_aligned;
    // A lens mixes pixels from anywhere, and so does a denoiser.
    const bool is_one =
        settings.filter == PictureFilter::oidn || (is_filtered && camera.lens_radius > 0.0);
    if (size.pixels() <= settings.pixels_at_once || is_one)
        return {{all, all}};
    const std::size_t around = is_filtered ? margin : 0;
    const std::size_t at_once = settings.pixels_at_once / size.columns;
    const std::size_t wanted = std::max(fewest_rows, at_once - std::min(at_once, 2 * around));
    const std::size_t kept = (wanted + step - 1) / step * step;
    std::vector<PictureBand> bands;
    for (std::size_t first = 0; first < size.rows; first += kept) {
        const std::size_t end = std::min(size.rows, first + kept);
        const std::size_t from = first - std::min(first, around);
        const std::size_t to = std::min(size.rows, end + around);
        bands.push_back({{first, end - first}, {from, to - from}});
    }
    return bands;
}

ViewPicture render(const Scene& scene,
                   const View& view,
                   const RenderSettings& settings,
                   const Control& control) {
    const std::vector<PictureBand> bands = bands_of(view.camera, settings);
    if (bands.size() == 1)
        return render_rows(scene, view, settings, control, bands.front().rendered);
    const auto start = std::chrono::steady_clock::now();
    ViewPicture whole;
    whole.size = {view.camera.columns, view.camera.rows};
    for (std::size_t b = 0; b < bands.size(); ++b) {
        // Time that is up ends a band, the user all of them.
        if (b > 0 && control.stop.stop_requested()) {
            whole.interrupted = true;
            break;
        }
        RenderSettings part = settings;
        if (settings.time_limit)
            part.time_limit =
                (*settings.time_limit - (std::chrono::steady_clock::now() - start))
                / static_cast<double>(bands.size() - b);
        Control part_control = control;
        if (control.progress)
            part_control.progress = [&](const Progress& p) {
                Progress of_all = p;
                const auto n = static_cast<double>(bands.size());
                of_all.fraction = (static_cast<double>(b) + p.fraction) / n;
                if (p.seconds_left >= 0.0 && p.fraction > 0.0)
                    of_all.seconds_left = p.seconds_left / (1.0 - std::min(p.fraction, 0.999))
                                          * (1.0 - of_all.fraction) * n;
                control.progress(of_all);
            };
        join(whole, render_rows(scene, view, part, part_control, bands[b].rendered), bands[b]);
    }
    whole.error = error_of(whole);
    return whole;
}

} // namespace isolux
