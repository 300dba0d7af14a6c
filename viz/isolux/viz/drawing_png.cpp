#include <cmath>
#include <memory>
#include <string>

#include <cairo.h>

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

void set_colour(cairo_t* c, const Colour& colour) {
    cairo_set_source_rgb(c, colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
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

/// Paints items with cairo, in millimetres.
class CairoPainter {
public:
    explicit CairoPainter(cairo_t* c) : c_(c) {
        cairo_set_fill_rule(c_, CAIRO_FILL_RULE_EVEN_ODD);
        cairo_set_line_join(c_, CAIRO_LINE_JOIN_ROUND);
        use_plain_outlines(c_);
    }

    void operator()(const Shape& s) {
        trace(c_, s.lines, s.ends);
        if (s.fill) {
            set_colour(c_, *s.fill);
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
        cairo_move_to(c_, -shift * advance(c_, text), 0.0);
        cairo_text_path(c_, text.c_str());
        if (t.halo) {
            set_colour(c_, *t.halo);
            cairo_set_dash(c_, nullptr, 0, 0.0);
            cairo_set_line_width(c_, 0.35 * t.size);
            cairo_stroke_preserve(c_);
        }
        set_colour(c_, t.colour);
        cairo_set_fill_rule(c_, CAIRO_FILL_RULE_WINDING);
        cairo_fill(c_);
        cairo_restore(c_);
    }

    void operator()(const Clip& clip) {
        cairo_save(c_);
        trace(c_, clip.lines, Ends::closed);
        cairo_clip(c_);
    }

    void operator()(const EndClip&) { cairo_restore(c_); }

private:
    cairo_t* c_;
};

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

void expect_success(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw DeviceError(std::string("cannot paint the picture: ")
                          + cairo_status_to_string(status));
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
    CairoPainter painter(context.get());
    for (const auto& item : drawing.items)
        std::visit(painter, item);
    expect_success(cairo_status(context.get()));
    std::string png;
    expect_success(cairo_surface_write_to_png_stream(surface.get(), append, &png));
    return png;
}

} // namespace isolux
