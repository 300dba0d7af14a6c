#include "isolux/photometry/gldf.h"

#include <cmath>
#include <utility>
#include <vector>

#include "isolux/photometry/file_number.h"
#include "isolux/photometry/gldf_product.h"
#include "isolux/photometry/quantities.h"
#include "isolux/photometry/source_text.h"
#include "isolux/photometry/sum_distributions.h"
#include "isolux/photometry/zip_entries.h"

namespace isolux {

namespace {

std::string read_light_file(const ZipEntries& zip, const GldfLight& light, Findings& findings) {
    if (!ZipEntries::is_inside(light.file_name))
        findings.fail(light.line,
                      "the file name " + quoted(light.file_name)
                          + " leads out of the container (such files are not opened)");
    if (auto bytes = zip.read("ldc/" + light.file_name))
        return std::move(*bytes);
    if (auto bytes = zip.read(light.file_name)) {
        findings.warn(light.line,
                      quoted(light.file_name)
                          + " is not in the folder ldc of the container (found beside it)");
        return std::move(*bytes);
    }
    findings.fail(light.line,
                  "ldc/" + light.file_name + " is not in the container (the light is missing)");
}

/// The emitter's own flux never scales the file, but a difference is worth knowing.
void check_rated_flux(const GldfLight& light,
                      const LuminairePhotometry& l,
                      Findings& findings) {
    constexpr double allowed_ratio = 0.10;
    if (!light.rated_flux || !(*light.rated_flux > 0.0))
        return;
    const double table = in_lumen(l.distribution.flux_trapezoid());
    const auto lamps = rated_lamp_flux(l);
    const auto is_near = [&](double flux) {
        return std::abs(flux / *light.rated_flux - 1.0) <= allowed_ratio;
    };
    if (!is_near(table) && !(lamps && is_near(in_lumen(*lamps))))
        findings.warn(light.flux_line,
                      "rated flux " + to_text(*light.rated_flux) + " lm, but the table of "
                          + quoted(light.file_name) + " gives " + to_text(std::round(table))
                          + " lm (the table is used as it is)",
                      "Override the flux?");
}

LuminairePhotometry parse_light(std::string_view bytes,
                                const std::string& source,
                                const GldfLight& light,
                                const PhotometryOptions& options,
                                Findings& findings) {
    if (bytes.starts_with("PK"))
        findings.fail(light.line, "a container within the container (not opened)");
    PhotometryOptions inner = options;
    inner.strict = false; // whoever called us refuses, with everything on the table
    inner.sibling = nullptr;
    inner.variant.clear();
    Findings of_light(source + "/ldc/" + light.file_name);
    LuminairePhotometry l = parse_text_photometry(bytes, inner, of_light);
    findings.add(of_light);
    check_rated_flux(light, l, findings);
    return l;
}

/// What several lights have in common is the first one's; light, power and flux are added up.
LuminairePhotometry add_up(std::vector<LuminairePhotometry> lights) {
    LuminairePhotometry sum = lights.front();
    if (lights.size() == 1)
        return sum;
    std::vector<IntensityDistribution> tables;
    sum.input_watts = 0.0;
    LampSet lamps;
    lamps.lamps = 0;
    std::optional<Lumen> declared = Lumen();
    for (const LuminairePhotometry& l : lights) {
        tables.push_back(l.distribution);
        sum.input_watts += l.input_watts;
        sum.is_absolute = sum.is_absolute || l.is_absolute;
        if (l.lamp_set < l.lamp_sets.size()) {
            const LampSet& set = l.lamp_sets[l.lamp_set];
            lamps.lamps += std::abs(set.lamps) < 10000 ? std::abs(set.lamps) : 1;
            lamps.flux += set.flux;
            lamps.type += (lamps.type.empty() || set.type.empty() ? "" : ", ") + set.type;
            lamps.watts += set.watts;
        }
        if (declared && l.declared_flux)
            *declared += *l.declared_flux;
        else
            declared.reset();
    }
    if (sum.is_absolute)
        lamps.lamps = -lamps.lamps;
    sum.lamp_sets = {lamps};
    sum.lamp_set = 0;
    sum.declared_flux = declared;
    sum.symmetry = "sum of emitters";
    sum.distribution = sum_distributions(tables);
    return sum;
}

} // namespace

LuminairePhotometry
parse_gldf(std::string_view bytes, const PhotometryOptions& options, Findings& findings) {
    const ZipEntries zip(bytes, findings);
    const auto xml = zip.read("product.xml");
    if (!xml)
        findings.fail(1,
                      "a ZIP container without product.xml (a GLDF container has one)",
                      "Unpack it and name the luminaire file inside");
    Findings of_product(findings.source() + "/product.xml");
    const SourceText text(*xml, of_product);
    const GldfProduct product =
        read_gldf_product(parse_xml(text, of_product), options.variant, of_product);
    std::vector<LuminairePhotometry> lights;
    std::string names;
    for (const GldfLight& light : product.lights) {
        lights.push_back(parse_light(read_light_file(zip, light, of_product),
                                     findings.source(),
                                     light,
                                     options,
                                     of_product));
        names += (names.empty() ? "" : ", ") + light.file_name;
    }
    findings.add(of_product);
    LuminairePhotometry l = add_up(std::move(lights));
    l.format = PhotometricFormat::gldf;
    l.contained_file = names;
    if (!product.manufacturer.empty())
        l.manufacturer = product.manufacturer;
    if (!product.name.empty())
        l.name = product.name;
    if (!product.number.empty())
        l.catalogue_number = product.number;
    return l;
}

} // namespace isolux
