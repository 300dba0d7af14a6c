#include "isolux/viz/picture_png.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include <cairo.h>

#include "isolux/base/error.h"
#include "isolux/io/safe_file.h"
#include "isolux/viz/colour_scale.h"

namespace isolux {

namespace {

struct DestroyCairo {
    void operator()(cairo_t* c) const noexcept { cairo_destroy(c); }

    void operator()(cairo_surface_t* s) const noexcept { cairo_surface_destroy(s); }
};

template <class T> using Handle = std::unique_ptr<T, DestroyCairo>;

constexpr Colour without_value{222, 222, 222};
constexpr Colour line_colour{40, 40, 40};

/// Values that the scale spans: the rest takes the colours at its ends.
constexpr double low_share = 0.01;
constexpr double high_share = 0.995;

void expect_success(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw DeviceError(std::string("cannot paint the picture: ")
                          + cairo_status_to_string(status));
}

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

/// A page of pixels, white at first.
class Page {
public:
    Page(std::size_t width, std::size_t height)
        : surface_(cairo_image_surface_create(
            CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height))),
          context_(cairo_create(surface_.get())) {
        cairo_set_source_rgb(context_.get(), 1.0, 1.0, 1.0);
        cairo_paint(context_.get());
        expect_success(cairo_status(context_.get()));
    }

    void set_pixel(std::size_t x, std::size_t y, const Colour& c) noexcept {
        unsigned char* p =
            cairo_image_surface_get_data(surface_.get())
            + y * static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()))
            + 4 * x;
        const std::uint32_t word =
            (std::uint32_t{c.r} << 16U) | (std::uint32_t{c.g} << 8U) | std::uint32_t{c.b};
        std::memcpy(p, &word, sizeof word);
    }

    void begin_pixels() noexcept { cairo_surface_flush(surface_.get()); }

    void end_pixels() noexcept { cairo_surface_mark_dirty(surface_.get()); }

    void rectangle(double x, double y, double w, double h, const Colour& c) {
        source(c);
        cairo_rectangle(context_.get(), x, y, w, h);
        cairo_fill(context_.get());
    }

    void text(double x, double y, double size, const std::string& words, const Colour& c) {
        cairo_select_font_face(
            context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(context_.get(), size);
        source(c);
        cairo_move_to(context_.get(), x, y);
        cairo_show_text(context_.get(), printable(words).c_str());
    }

    [[nodiscard]] std::string png() {
        expect_success(cairo_status(context_.get()));
        std::string bytes;
        expect_success(cairo_surface_write_to_png_stream(surface_.get(), append, &bytes));
        return bytes;
    }

private:
    void source(const Colour& c) {
        cairo_set_source_rgb(context_.get(), c.r / 255.0, c.g / 255.0, c.b / 255.0);
    }

    Handle<cairo_surface_t> surface_;
    Handle<cairo_t> context_;
};

/// Values of the pixels; none where there is nothing to tell.
std::vector<std::optional<double>> values_of(const ViewPicture& p, PictureQuantity quantity) {
    std::vector<std::optional<double>> values(p.size.pixels());
    const Plane& e = p.filtered_illuminance.empty() ? p.illuminance : p.filtered_illuminance;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (quantity == PictureQuantity::luminance) {
            if (p.object[i] != 0 || p.luminance(i) > 0.0)
                values[i] = p.luminance(i);
        } else if (p.object[i] != 0) {
            values[i] = static_cast<double>(e[i]);
        }
    }
    return values;
}

/// Of the bands together, as a share of their largest value.
constexpr double least_span = 0.1;

struct Bands {
    std::vector<double> breaks;
    std::vector<Colour> colours;

    [[nodiscard]] std::size_t band_of(double value) const noexcept {
        return static_cast<std::size_t>(std::upper_bound(breaks.begin(), breaks.end(), value)
                                        - breaks.begin());
    }
};

Bands make_bands(const std::vector<std::optional<double>>& values) {
    std::vector<double> sorted;
    for (const auto& v : values)
        if (v)
            sorted.push_back(*v);
    Bands bands;
    if (!sorted.empty()) {
        std::sort(sorted.begin(), sorted.end());
        const auto at = [&](double share) {
            return sorted[static_cast<std::size_t>(share
                                                   * static_cast<double>(sorted.size() - 1))];
        };
        double high = at(high_share);
        double low = std::max(at(low_share), 1e-3 * high);
        if (high - low < least_span * high) { // or the bands of an even picture show its noise
            const double middle = at(0.5);
            low = (1.0 - 0.5 * least_span) * middle;
            high = (1.0 + 0.5 * least_span) * middle;
        }
        if (high > low)
            bands.breaks = choose_breaks(low, high, 0.0);
    }
    bands.colours = band_colours(bands.breaks.size() + 1);
    return bands;
}

/// Where two bands meet on one surface.
bool is_on_line(const ViewPicture& p,
                const std::vector<std::optional<double>>& values,
                const Bands& bands,
                std::size_t x,
                std::size_t y) {
    const std::size_t i = y * p.size.columns + x;
    const auto differs = [&](std::size_t j) {
        return values[j] && p.object[j] == p.object[i]
               && dot(p.normal.vector(i), p.normal.vector(j)) > 0.98
               && bands.band_of(*values[i]) > bands.band_of(*values[j]);
    };
    return (x > 0 && differs(i - 1)) || (x + 1 < p.size.columns && differs(i + 1))
           || (y > 0 && differs(i - p.size.columns))
           || (y + 1 < p.size.rows && differs(i + p.size.columns));
}

void paint_legend(Page& page,
                  const Bands& bands,
                  const char* unit,
                  const std::string& title,
                  double left,
                  double height,
                  double size) {
    page.text(left, 1.6 * size, size, title, line_colour);
    page.text(left, 3.1 * size, size, unit, line_colour);
    const double top = 4.0 * size;
    const double band =
        std::min(2.2 * size, (height - top - size) / static_cast<double>(bands.colours.size()));
    const std::size_t n = bands.colours.size();
    for (std::size_t k = 0; k < n; ++k) {
        const double y = top + static_cast<double>(n - 1 - k) * band;
        page.rectangle(left, y, 2.0 * size, band, bands.colours[k]);
        if (k > 0)
            page.text(left + 2.5 * size,
                      y + band + 0.36 * size,
                      size,
                      format_break(bands.breaks[k - 1]),
                      line_colour);
    }
}

} // namespace

void write_tone_mapped(const std::filesystem::path& path,
                       const ViewPicture& picture,
                       const Exposure& exposure) {
    const std::vector<std::uint8_t> bytes = tone_map(picture.shown(), exposure);
    Page page(picture.size.columns, picture.size.rows);
    page.begin_pixels();
    for (std::size_t y = 0; y < picture.size.rows; ++y)
        for (std::size_t x = 0; x < picture.size.columns; ++x) {
            const std::uint8_t* p = bytes.data() + 3 * (y * picture.size.columns + x);
            page.set_pixel(x, y, {p[0], p[1], p[2]});
        }
    page.end_pixels();
    write_file_safely(path, page.png());
}

void write_false_colours(const std::filesystem::path& path,
                         const ViewPicture& picture,
                         PictureQuantity quantity,
                         const std::string& title) {
    const auto values = values_of(picture, quantity);
    const Bands bands = make_bands(values);
    const bool has_lines = quantity == PictureQuantity::illuminance;
    const double size = std::clamp(static_cast<double>(picture.size.rows) / 32.0, 10.0, 64.0);
    const double gap = 0.8 * size;
    const double words =
        std::max(6.5, 0.66 * static_cast<double>(std::min<std::size_t>(title.size(), 40)));
    const auto margin = static_cast<std::size_t>(std::ceil(gap + (words + 0.8) * size));
    // Low pictures grow: a legend needs its bands.
    const auto least = static_cast<std::size_t>(
        (5.0 + 1.3 * static_cast<double>(bands.colours.size())) * size);
    Page page(picture.size.columns + margin, std::max(picture.size.rows, least));
    page.begin_pixels();
    for (std::size_t y = 0; y < picture.size.rows; ++y)
        for (std::size_t x = 0; x < picture.size.columns; ++x) {
            const auto& value = values[y * picture.size.columns + x];
            Colour c = without_value;
            if (value)
                c = has_lines && is_on_line(picture, values, bands, x, y)
                        ? line_colour
                        : bands.colours[bands.band_of(*value)];
            page.set_pixel(x, y, c);
        }
    page.end_pixels();
    paint_legend(page,
                 bands,
                 has_lines ? "lx" : "cd/m2",
                 title,
                 static_cast<double>(picture.size.columns) + gap,
                 static_cast<double>(std::max(picture.size.rows, least)),
                 size);
    write_file_safely(path, page.png());
}

} // namespace isolux
