#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/viz/drawing.h"

namespace isolux {

namespace {

struct DestroyCairo {
    void operator()(cairo_t* c) const noexcept { cairo_destroy(c); }

    void operator()(cairo_surface_t* s) const noexcept { cairo_surface_destroy(s); }

    void operator()(cairo_font_options_t* o) const noexcept { cairo_font_options_destroy(o); }
};

template <class T> using Handle = std::unique_ptr<T, DestroyCairo>;

/// Outlines as designed: no snapping to pixels, so that widths do not depend on resolution.
void use_plain_outlines(cairo_t* c) {
    const Handle<cairo_font_options_t> options(cairo_font_options_create());
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(c, options.get());
}

void select_face(cairo_t* c, double size, Weight weight) {
    cairo_select_font_face(c,
                           "DejaVu Sans",
                           CAIRO_FONT_SLANT_NORMAL,
                           weight == Weight::bold ? CAIRO_FONT_WEIGHT_BOLD
                                                  : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, size);
}

double advance(cairo_t* c, const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(c, text.c_str(), &extents);
    return extents.x_advance;
}

void set_colour(cairo_t* c, const Colour& colour, double opacity = 1.0) {
    cairo_set_source_rgba(c, colour.r / 255.0, colour.g / 255.0, colour.b / 255.0, opacity);
}

void trace(cairo_t* c, const std::vector<Polyline>& lines, Ends ends) {
    cairo_new_path(c);
    for (const Polyline& line : lines) {
        if (line.empty())
            continue;
        cairo_move_to(c, line.front().x, line.front().y);
        for (const Point2& p : line)
            cairo_line_to(c, p.x, p.y);
        if (ends == Ends::closed)
            cairo_close_path(c);
    }
}

void expect_success(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw DeviceError(std::string("cannot paint the picture: ")
                          + cairo_status_to_string(status));
}

enum class Letters { as_outlines, as_text };

struct PngBytes {
    std::string_view left;
};

cairo_status_t read_png(void* closure, unsigned char* data, unsigned int length) {
    auto* bytes = static_cast<PngBytes*>(closure);
    if (bytes->left.size() < length)
        return CAIRO_STATUS_READ_ERROR;
    std::memcpy(data, bytes->left.data(), length);
    bytes->left.remove_prefix(length);
    return CAIRO_STATUS_SUCCESS;
}

/// Paints items with cairo, in millimetres.
class CairoPainter {
public:
    CairoPainter(cairo_t* c, Letters letters) : c_(c), letters_(letters) {
        cairo_set_fill_rule(c_, CAIRO_FILL_RULE_EVEN_ODD);
        cairo_set_line_join(c_, CAIRO_LINE_JOIN_ROUND);
        use_plain_outlines(c_);
    }

    void operator()(const Shape& s) {
        trace(c_, s.lines, s.ends);
        if (s.fill) {
            set_colour(c_, *s.fill, s.opacity);
            cairo_fill_preserve(c_);
        }
        if (s.stroke) {
            set_colour(c_, s.stroke->colour);
            cairo_set_line_width(c_, s.stroke->width);
            cairo_set_dash(c_, &s.stroke->dash, s.stroke->dash > 0.0 ? 1 : 0, 0.0);
            cairo_stroke(c_);
        }
        cairo_new_path(c_);
    }

    void operator()(const Text& t) {
        select_face(c_, t.size, t.weight);
        const double shift =
            t.anchor == Anchor::start ? 0.0 : (t.anchor == Anchor::middle ? 0.5 : 1.0);
        cairo_save(c_);
        cairo_translate(c_, t.at.x, t.at.y);
        cairo_rotate(c_, -t.turn * std::acos(-1.0) / 180.0);
        const std::string text = printable(t.text);
        const double start = -shift * advance(c_, text);
        cairo_move_to(c_, start, 0.0);
        if (t.halo || letters_ == Letters::as_outlines)
            cairo_text_path(c_, text.c_str());
        if (t.halo) {
            set_colour(c_, *t.halo);
            cairo_set_dash(c_, nullptr, 0, 0.0);
            cairo_set_line_width(c_, 0.35 * t.size);
            cairo_stroke_preserve(c_);
        }
        set_colour(c_, t.colour);
        cairo_set_fill_rule(c_, CAIRO_FILL_RULE_WINDING);
        if (letters_ == Letters::as_outlines) {
            cairo_fill(c_);
        } else {
            cairo_new_path(c_);
            cairo_move_to(c_, start, 0.0);
            cairo_show_text(c_, text.c_str());
            cairo_new_path(c_);
        }
        cairo_restore(c_);
    }

    void operator()(const Clip& clip) {
        cairo_save(c_);
        trace(c_, clip.lines, Ends::closed);
        cairo_clip(c_);
    }

    void operator()(const EndClip&) { cairo_restore(c_); }

    void operator()(const Picture& p) {
        PngBytes bytes{p.png};
        const Handle<cairo_surface_t> image(
            cairo_image_surface_create_from_png_stream(read_png, &bytes));
        expect_success(cairo_surface_status(image.get()));
        cairo_save(c_);
        cairo_translate(c_, p.at.x, p.at.y);
        cairo_scale(c_,
                    p.width / cairo_image_surface_get_width(image.get()),
                    p.height / cairo_image_surface_get_height(image.get()));
        cairo_set_source_surface(c_, image.get(), 0.0, 0.0);
        cairo_paint(c_);
        cairo_restore(c_);
    }

private:
    cairo_t* c_;
    Letters letters_;
};

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

} // namespace

struct FontRuler::Implementation {
    Handle<cairo_surface_t> surface{cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1)};
    Handle<cairo_t> context{cairo_create(surface.get())};
};

FontRuler::FontRuler() : implementation_(std::make_unique<Implementation>()) {
    use_plain_outlines(implementation_->context.get());
}

FontRuler::~FontRuler() = default;
FontRuler::FontRuler(FontRuler&&) noexcept = default;
FontRuler& FontRuler::operator=(FontRuler&&) noexcept = default;

double FontRuler::width(std::string_view text, double size, Weight weight) const {
    // Measured large and scaled: font files store whole numbers.
    constexpr double measured_size = 100.0;
    cairo_t* c = implementation_->context.get();
    select_face(c, measured_size, weight);
    return advance(c, printable(text)) * size / measured_size;
}

std::string to_png(const Drawing& drawing, double dots_per_inch) {
    constexpr double mm_per_inch = 25.4;
    const double scale = dots_per_inch / mm_per_inch;
    const Handle<cairo_surface_t> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                   static_cast<int>(std::ceil(drawing.width * scale)),
                                   static_cast<int>(std::ceil(drawing.height * scale))));
    const Handle<cairo_t> context(cairo_create(surface.get()));
    cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
    cairo_paint(context.get());
    cairo_scale(context.get(), scale, scale);
    CairoPainter painter(context.get(), Letters::as_outlines);
    for (const auto& item : drawing.items)
        std::visit(painter, item);
    expect_success(cairo_status(context.get()));
    std::string png;
    expect_success(cairo_surface_write_to_png_stream(surface.get(), append, &png));
    return png;
}

std::string to_pdf(std::span<const Drawing> pages, const std::string& title) {
    constexpr double points_per_mm = 72.0 / 25.4;
    std::string pdf;
    const double width = pages.empty() ? 210.0 : pages.front().width;
    const double height = pages.empty() ? 297.0 : pages.front().height;
    const Handle<cairo_surface_t> surface(cairo_pdf_surface_create_for_stream(
        append, &pdf, width * points_per_mm, height * points_per_mm));
    cairo_pdf_surface_set_metadata(
        surface.get(), CAIRO_PDF_METADATA_TITLE, printable(title).c_str());
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "isolux");
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
    const Handle<cairo_t> context(cairo_create(surface.get()));
    std::string bookmark;
    for (std::size_t k = 0; k < pages.size(); ++k) {
        const Drawing& page = pages[k];
        cairo_pdf_surface_set_size(
            surface.get(), page.width * points_per_mm, page.height * points_per_mm);
        if (page.title != bookmark && !page.title.empty())
            cairo_pdf_surface_add_outline(surface.get(),
                                          CAIRO_PDF_OUTLINE_ROOT,
                                          printable(page.title).c_str(),
                                          fmt::format("page={}", k + 1).c_str(),
                                          CAIRO_PDF_OUTLINE_FLAG_OPEN);
        bookmark = page.title;
        cairo_save(context.get());
        cairo_scale(context.get(), points_per_mm, points_per_mm);
        CairoPainter painter(context.get(), Letters::as_text);
        for (const auto& item : page.items)
            std::visit(painter, item);
        cairo_restore(context.get());
        cairo_show_page(context.get());
    }
    expect_success(cairo_status(context.get()));
    cairo_surface_finish(surface.get());
    expect_success(cairo_surface_status(surface.get()));
    return pdf;
}

} // namespace isolux
