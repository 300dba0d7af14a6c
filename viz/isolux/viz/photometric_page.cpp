#include "isolux/viz/photometric_page.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "isolux/photometry/quantities.h"
#include "isolux/scene/luminaire_body.h"
#include "isolux/viz/colour_scale.h"
#include "isolux/viz/intensity_diagrams.h"
#include "isolux/viz/photometric_web.h"

namespace isolux {

namespace {

constexpr double margin = 8.0; // mm
constexpr double title_size = 5.0;
constexpr double caption_size = 3.0;
constexpr double fact_size = 2.7;
constexpr double fact_space = 4.3;

/// A name and a value of the list of figures.
using Fact = std::pair<std::string, std::string>;

const LuminairePhotometry* table_of(const LuminaireType& type) {
    return std::get_if<LuminairePhotometry>(&type.source);
}

std::string title_of(const LuminaireType& type) {
    const LuminairePhotometry* table = table_of(type);
    return table != nullptr && !table->name.empty() ? table->name : type.name;
}

/// 0.6 × 0.6 × 0.08 m; the height only where there is one.
std::string size_in_words(const LuminousOpening& o) {
    std::string size =
        fmt::format("{:.3g} × {:.3g}", in_metre(o.extent_x), in_metre(o.extent_y));
    if (in_metre(o.extent_z) > 0.0)
        size += fmt::format(" × {:.3g}", in_metre(o.extent_z));
    return size + " m";
}

std::string beam_in_words(const LuminairePhotometry& table, Angle plane) {
    const auto beam = find_beam(table.distribution, plane, 0.5);
    return beam ? fmt::format("{:.0f}°", beam->full().in_degrees()) : "none";
}

void add_table_facts(std::vector<Fact>& facts, const LuminairePhotometry& table, double scale) {
    const MaximumIntensity most = find_maximum(table.distribution);
    facts.emplace_back("maximum",
                       fmt::format("{} cd at C {:.4g}°, gamma {:.4g}°",
                                   format_lux(scale * in_candela(most.value)),
                                   most.plane.in_degrees(),
                                   most.gamma.in_degrees()));
    facts.emplace_back("beam angle (half maximum)",
                       fmt::format("C0-C180 {}, C90-C270 {}",
                                   beam_in_words(table, degrees(0)),
                                   beam_in_words(table, degrees(90))));
    facts.emplace_back("downward share",
                       fmt::format("{:.1f} %", 100.0 * downward_fraction(table.distribution)));
    if (const auto ratio = light_output_ratio(table))
        facts.emplace_back("light output ratio", fmt::format("{:.1f} %", 100.0 * *ratio));
    if (table.input_watts > 0.0)
        facts.emplace_back("power",
                           fmt::format("{:.4g} W{}",
                                       table.input_watts,
                                       scale == 1.0 && luminous_efficacy(table) ? fmt::format(
                                           ", {:.0f} lm/W", *luminous_efficacy(table))
                                                                                : ""));
    facts.emplace_back("symmetry", table.symmetry);
}

std::vector<Fact> collect_facts(const LuminaireType& type) {
    std::vector<Fact> facts;
    const double flux = in_lumen(luminous_flux(type));
    const LuminairePhotometry* table = table_of(type);
    const auto lamps = table != nullptr ? rated_lamp_flux(*table) : std::nullopt;
    facts.emplace_back(
        "luminous flux",
        fmt::format("{:.0f} lm{}",
                    flux,
                    lamps ? fmt::format(", lamps {:.0f} lm", in_lumen(*lamps) * type.flux_scale)
                          : ""));
    if (table != nullptr)
        add_table_facts(facts, *table, type.flux_scale);
    if (type.opening.shape != OpeningShape::point)
        facts.emplace_back("luminous opening",
                           to_string(type.opening.shape) + ", " + size_in_words(type.opening));
    const LuminousOpening body = visible_body(type);
    if (body.shape != OpeningShape::point)
        facts.emplace_back("body (x × y × z)", size_in_words(body));
    const auto side = find_long_side(type);
    facts.emplace_back("long axis",
                       side ? (side->is_along_y ? "along C90-C270 (y)" : "along C0-C180 (x)")
                            : "none");
    return facts;
}

IntensityScale scale_for(const LuminaireType& type, IntensityUnit unit) {
    const double flux = reference_flux(type);
    if (unit == IntensityUnit::candela || !(flux > 0.0))
        return {};
    return {1000.0 / flux, "cd/klm"};
}

/// What "klm" means here.
std::string unit_remark(const LuminaireType& type, const IntensityScale& scale) {
    if (scale.unit == "cd")
        return "cd";
    const LuminairePhotometry* table = table_of(type);
    return table != nullptr && rated_lamp_flux(*table) ? "cd per 1000 lm of the lamps"
                                                       : "cd per 1000 lm of the luminaire";
}

/// Writes header, captions, legend and figures; knows where things are.
class PageWriter {
public:
    PageWriter(double width, double height, const LuminaireType& type)
        : page_{width, height, title_of(type), {}}, type_(type) {}

    void write_header(const std::string& source) {
        double y = margin + title_size;
        const double width = page_.width - 2.0 * margin;
        add(make_text(shorten(page_.title, width, title_size, Weight::bold, ruler_),
                      {margin, y},
                      title_size,
                      Anchor::start,
                      Weight::bold));
        std::string words;
        if (const LuminairePhotometry* table = table_of(type_))
            for (const std::string& part : {table->manufacturer,
                                            table->catalogue_number,
                                            source,
                                            to_string(table->format)})
                if (!part.empty() && part != page_.title)
                    words += (words.empty() ? "" : "  ·  ") + part;
        y += 1.7 * caption_size;
        add(make_text(shorten(words, width, caption_size, Weight::normal, ruler_),
                      {margin, y},
                      caption_size,
                      Anchor::start,
                      Weight::normal,
                      ink::grey));
    }

    void write_caption(const Box& box, const std::string& words) {
        add(make_text(words, {box.x, box.y - 1.5}, caption_size, Anchor::start, Weight::bold));
    }

    /// The two strokes and what they mean. Returns how wide it is.
    void write_legend(Point2 at) {
        const auto entry = [&](const Stroke& stroke, const std::string& words) {
            const double y = at.y - 0.5 * cap_height * fact_size;
            add(make_line({{at.x, y}, {at.x + 9.0, y}}, stroke));
            add(make_text(words, {at.x + 11.0, at.y}, fact_size));
            at.x += 11.0 + ruler_.width(words, fact_size, Weight::normal) + 6.0;
        };
        entry(c0_stroke, "C0-C180");
        entry(c90_stroke, "C90-C270");
    }

    void write_facts(const Box& box) {
        double y = box.y;
        const std::vector<Fact> facts = collect_facts(type_);
        double names = 0.0;
        for (const Fact& f : facts)
            names = std::max(names, ruler_.width(f.first, fact_size, Weight::normal));
        for (const auto& [name, value] : facts) {
            y += fact_space;
            if (y > box.bottom())
                break;
            add(make_text(
                name, {box.x, y}, fact_size, Anchor::start, Weight::normal, ink::grey));
            const double left = names + 4.0;
            add(make_text(shorten(value, box.width - left, fact_size, Weight::normal, ruler_),
                          {box.x + left, y},
                          fact_size));
        }
    }

    [[nodiscard]] Drawing& page() { return page_; }

private:
    template <class Item> void add(Item item) { page_.items.emplace_back(std::move(item)); }

    Drawing page_;
    const LuminaireType& type_;
    FontRuler ruler_;
};

constexpr double header = 25.0;

Drawing draw_one(const LuminaireType& type,
                 const std::string& source,
                 const PhotometricPageOptions& options,
                 const IntensityScale& scale) {
    constexpr double width = 170.0;
    const bool is_flat = options.kind == DiagramKind::cartesian;
    const Box box{margin, header + 2.0, width - 2.0 * margin, is_flat ? 95.0 : 130.0};
    const double facts_height = 10.5 * fact_space;
    PageWriter writer(width, box.bottom() + 10.0 + facts_height + margin, type);
    writer.write_header(source);
    switch (*options.kind) {
    case DiagramKind::polar:
        writer.write_caption(box, "Luminous intensity, " + unit_remark(type, scale));
        draw_polar(writer.page(), box, sample_polar_curves(type), scale);
        break;
    case DiagramKind::cartesian:
        writer.write_caption(box, "Luminous intensity, " + unit_remark(type, scale));
        draw_cartesian(writer.page(), box, sample_polar_curves(type), scale);
        break;
    case DiagramKind::web:
        writer.write_caption(box, "Photometric solid; body not to its scale");
        draw_web(writer.page(), box, type, options.view);
        break;
    }
    if (options.kind != DiagramKind::web)
        writer.write_legend({margin, box.bottom() + 6.0});
    writer.write_facts({margin, box.bottom() + 8.0, width - 2.0 * margin, facts_height});
    return std::move(writer.page());
}

Drawing draw_all(const LuminaireType& type,
                 const std::string& source,
                 const PhotometricPageOptions& options,
                 const IntensityScale& scale) {
    PageWriter writer(297.0, 210.0, type);
    writer.write_header(source);
    const PolarCurves curves = sample_polar_curves(type);
    const Box polar{margin, header + 2.0, 136.0, 122.0};
    const Box web{150.0, header + 2.0, 139.0, 96.0};
    const Box cartesian{150.0, 130.0, 139.0, 72.0};
    writer.write_caption(polar, "Polar diagram, " + unit_remark(type, scale));
    draw_polar(writer.page(), polar, curves, scale);
    writer.write_legend({margin, polar.bottom() + 5.5});
    writer.write_facts({margin, polar.bottom() + 7.5, 136.0, 200.0 - polar.bottom()});
    writer.write_caption(web, "Photometric solid; body not to its scale");
    draw_web(writer.page(), web, type, options.view);
    writer.write_caption(cartesian, "Cartesian diagram, " + unit_remark(type, scale));
    draw_cartesian(writer.page(), cartesian, curves, scale);
    return std::move(writer.page());
}

} // namespace

Drawing draw_photometric_page(const LuminaireType& type,
                              const std::string& source,
                              const PhotometricPageOptions& options) {
    const IntensityScale scale = scale_for(type, options.unit);
    return options.kind ? draw_one(type, source, options, scale)
                        : draw_all(type, source, options, scale);
}

} // namespace isolux
