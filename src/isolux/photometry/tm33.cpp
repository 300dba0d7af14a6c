#include "isolux/photometry/tm33.h"

#include <algorithm>
#include <cmath>

#include "isolux/photometry/findings.h"

namespace isolux {

namespace {

FileNumber number_of(const XmlElement& e, const Findings& findings) {
    const auto value = parse_number(trim(e.text));
    if (!value)
        findings.fail(e.line, quoted(e.text) + " is not a number (expected in " + e.name + ")");
    return {*value, e.line};
}

/// The first child with one of these names, as a number.
std::optional<FileNumber> find_number(const XmlElement& parent,
                                      std::initializer_list<std::string_view> names,
                                      const Findings& findings) {
    for (const std::string_view name : names)
        if (const XmlElement* const e = parent.find(name); e != nullptr && !e->text.empty())
            return number_of(*e, findings);
    return std::nullopt;
}

/// A number that nothing depends on: what cannot be read is noticed and left out.
std::optional<FileNumber> find_informative(const XmlElement& parent,
                                           std::initializer_list<std::string_view> names,
                                           Findings& findings) {
    try {
        return find_number(parent, names, findings);
    } catch (const InputError&) {
        for (const std::string_view name : names)
            if (const XmlElement* const e = parent.find(name); e != nullptr)
                findings.warn(e->line,
                              quoted(e->text) + " in " + e->name
                                  + " is not a number (nothing depends on it; left out)");
        return std::nullopt;
    }
}

bool is_true(const XmlElement* e) {
    return e != nullptr && (e->text == "true" || e->text == "1");
}

double read_angle(const XmlElement& e,
                  std::initializer_list<std::string_view> names,
                  const Findings& findings) {
    for (const std::string_view name : names)
        if (const std::string_view text = trim(e.attribute(name)); !text.empty()) {
            const auto value = parse_number(text);
            if (!value)
                findings.fail(e.line,
                              quoted(text) + " is not a number (expected: the angle "
                                  + std::string(name) + ")");
            return *value;
        }
    findings.fail(e.line,
                  e.name + " without the attribute " + std::string(*names.begin())
                      + " (its direction is unknown)");
}

std::vector<Tm33Value> read_values(const XmlElement& table, const Findings& findings) {
    std::vector<Tm33Value> values;
    for (const XmlElement& e : table.children) {
        if (e.name != "IntData" && e.name != "IntensityData")
            continue;
        const double h = read_angle(e, {"h", "horz", "horizontal"}, findings);
        const double v = read_angle(e, {"v", "vert", "vertical"}, findings);
        values.push_back({{h, e.line}, {v, e.line}, number_of(e, findings)});
    }
    return values;
}

bool holds_intensities(const XmlElement& e) {
    return e.find("IntData") != nullptr || e.find("IntensityData") != nullptr;
}

/// Type C, however its name is spaced.
bool is_type_c(std::string name) {
    std::erase_if(name, [](char c) { return c == ' ' || c == '_'; });
    return name.empty() || name == "C" || name == "TypeC" || name == "CIEC" || name == "IESC";
}

/// The table of luminous intensity; null where the emitter has only other data. The editions
/// keep it in three places.
const XmlElement* find_table(const XmlElement& emitter, const Findings& findings) {
    if (const XmlElement* const t = emitter.find_path({"LuminousData", "LuminousIntensity"}))
        return t;
    const XmlElement* table = emitter.find("IntensityDistribution");
    if (const XmlElement* const data = emitter.find("LuminousData");
        table == nullptr && data != nullptr && holds_intensities(*data))
        table = data;
    if (table == nullptr)
        return nullptr;
    const std::string type = table->text_of({"PhotometryType"});
    if (!is_type_c(type))
        findings.fail(table->find("PhotometryType")->line,
                      "photometry type " + quoted(type) + " (only type C is read from TM-33)");
    const std::string metric = table->text_of({"Metric"});
    return metric.empty() || metric == "Luminous" ? table : nullptr;
}

void check_counts(const XmlElement& table, std::size_t found, Findings& findings) {
    const auto horizontal = find_number(table, {"NumberHorz"}, findings);
    const auto vertical = find_number(table, {"NumberVert"}, findings);
    if (horizontal && vertical
        && horizontal->value * vertical->value != static_cast<double>(found))
        findings.warn(horizontal->line,
                      to_text(horizontal->value) + " x " + to_text(vertical->value)
                          + " angles announced, " + std::to_string(found)
                          + " intensities found (those that are there are used)");
}

std::string colour_of(const XmlElement& emitter) {
    std::string kelvin = emitter.text_of({"ColorTemperature", "FixedCCT"});
    if (kelvin.empty())
        kelvin = emitter.text_of({"CCT"});
    return kelvin.empty() ? kelvin : kelvin + " K";
}

std::string rendering_of(const XmlElement& emitter) {
    const std::string ra = emitter.text_of({"ColorRendering", "CIE_CRI", "Ra"});
    return ra.empty() ? emitter.text_of({"ColorRendering", "Ra"}) : ra;
}

Tm33Emitter read_emitter(const XmlElement& e, const XmlElement& table, Findings& findings) {
    Tm33Emitter emitter;
    emitter.line = e.line;
    emitter.table_line = table.line;
    emitter.description = e.text_of({"Description"});
    emitter.colour = colour_of(e);
    emitter.colour_rendering = rendering_of(e);
    emitter.quantity = find_informative(e, {"Quantity"}, findings).value_or(emitter.quantity);
    emitter.rated_lumens = find_informative(e, {"RatedLumens"}, findings);
    emitter.luminous_flux = find_informative(e, {"MeasuredLumens"}, findings);
    if (const XmlElement* const data = e.find("LuminousData"))
        if (const auto flux = find_informative(*data, {"LuminousFlux"}, findings))
            emitter.luminous_flux = flux;
    emitter.input_watts =
        find_informative(e, {"InputWattage", "InputWatts"}, findings).value_or(FileNumber{});
    emitter.ballast_factor =
        find_number(e, {"BallastFactor"}, findings).value_or(emitter.ballast_factor);
    emitter.multiplier =
        find_number(table, {"Multiplier"}, findings).value_or(emitter.multiplier);
    emitter.is_absolute = is_true(table.find("AbsolutePhotometry"));
    emitter.is_per_kilolumen = table.text_of({"Units"}).find("klm") != std::string::npos;
    emitter.values = read_values(table, findings);
    check_counts(table, emitter.values.size(), findings);
    return emitter;
}

/// Metres per unit of the file's sizes. The editions differ, and files follow neither strictly.
double unit_of_sizes(const XmlElement& root, double largest, std::size_t line, Findings& f) {
    constexpr double largest_in_metres = 20.0;
    constexpr double least_in_millimetres = 10.0;
    const bool is_s001 = root.name == "LuminaireOpticalData";
    if (is_s001 && largest > 0.0 && largest < least_in_millimetres) {
        f.warn(line,
               "no size above " + to_text(largest)
                   + " (S001 has millimetres; read as metres, since no luminaire is so small)");
        return 1.0;
    }
    if (!is_s001 && largest > largest_in_metres) {
        f.warn(
            line,
            "a size of " + to_text(largest)
                + " (TM-33 has metres; read as millimetres, since no luminaire is so large)");
        return 1e-3;
    }
    return is_s001 ? 1e-3 : 1.0;
}

double size_of(const XmlElement& parent, std::string_view name, Findings& findings) {
    const auto n = find_number(parent, {name}, findings);
    if (n && n->value < 0.0)
        findings.warn(n->line,
                      std::string(name) + " " + to_text(n->value)
                          + " (sizes are not negative; the amount is used)");
    return n ? std::abs(n->value) : 0.0;
}

/// The largest area of a face; several are noticed.
std::optional<Tm33Face> read_face(const XmlElement& areas,
                                  std::string_view face_name,
                                  std::string_view area_name,
                                  std::string_view across,
                                  Findings& findings) {
    const XmlElement* const face = areas.find(face_name);
    if (face == nullptr)
        return std::nullopt;
    std::optional<Tm33Face> largest;
    int count = 0;
    for (const XmlElement& area : face->children) {
        if (area.name != area_name)
            continue;
        ++count;
        const double first = area.find("Length") != nullptr ? size_of(area, "Length", findings)
                                                            : size_of(area, "Width", findings);
        const Tm33Face f{
            first, size_of(area, across, findings), is_true(area.find("Circular"))};
        if (!largest || f.along_y * f.across > largest->along_y * largest->across)
            largest = f;
    }
    if (count > 1)
        findings.warn(face->line,
                      std::to_string(count) + " luminous areas in " + face->name
                          + " (the largest stands for all)");
    return largest;
}

void read_faces(Tm33Document& d, const XmlElement& areas, Findings& findings) {
    d.states_faces = true;
    d.horizontal_face = read_face(areas, "BottomFace", "BottomArea", "Width", findings);
    if (!d.horizontal_face)
        d.horizontal_face = read_face(areas, "TopFace", "TopArea", "Width", findings);
    constexpr std::array<std::array<std::string_view, 2>, 4> sides{{{"C0Face", "C0Area"},
                                                                    {"C90Face", "C90Area"},
                                                                    {"C180Face", "C180Area"},
                                                                    {"C270Face", "C270Area"}}};
    for (std::size_t i = 0; i < sides.size(); ++i)
        if (const auto f = read_face(areas, sides[i][0], sides[i][1], "Height", findings))
            d.side_heights[i] = f->across;
}

/// S001's short way to say what shines.
void read_opening(Tm33Document& d, const XmlElement& opening, Findings& findings) {
    d.states_faces = true;
    const double diameter = size_of(opening, "Diameter", findings);
    if (diameter > 0.0)
        d.horizontal_face = Tm33Face{diameter, diameter, true};
    else
        d.horizontal_face = Tm33Face{size_of(opening, "Length", findings),
                                     size_of(opening, "Width", findings),
                                     opening.text_of({"Shape"}).starts_with("Circ")};
}

void scale_sizes(Tm33Document& d, double metres_per_unit) {
    for (double* size : {&d.length, &d.width, &d.height})
        *size *= metres_per_unit;
    for (double& h : d.side_heights)
        h *= metres_per_unit;
    if (d.horizontal_face) {
        d.horizontal_face->along_y *= metres_per_unit;
        d.horizontal_face->across *= metres_per_unit;
    }
}

void read_sizes(Tm33Document& d, const XmlElement& root, Findings& findings) {
    std::size_t line = root.line;
    if (const XmlElement* const body = root.find_path({"Luminaire", "Dimensions"})) {
        line = body->line;
        d.length = size_of(*body, "Length", findings);
        d.width = size_of(*body, "Width", findings);
        d.height = size_of(*body, "Height", findings);
    }
    for (const XmlElement& e : root.children)
        if (const XmlElement* const areas = e.find("EmissionAreas");
            e.name == "Emitter" && areas != nullptr && !d.states_faces)
            read_faces(d, *areas, findings);
    if (const XmlElement* const opening = root.find_path({"Luminaire", "LuminousOpening"});
        opening != nullptr && !d.states_faces)
        read_opening(d, *opening, findings);
    double largest = std::max({d.length, d.width, d.height});
    if (d.horizontal_face)
        largest = std::max({largest, d.horizontal_face->along_y, d.horizontal_face->across});
    scale_sizes(d, unit_of_sizes(root, largest, line, findings));
}

void read_header(Tm33Document& d, const XmlElement& root) {
    d.manufacturer = root.text_of({"Header", "Manufacturer"});
    d.catalogue_number = root.text_of({"Header", "CatalogNumber"});
    d.description = root.text_of({"Header", "Description"});
    d.laboratory = root.text_of({"Header", "Laboratory"});
    d.report = root.text_of({"Header", "ReportNumber"});
    d.date = root.text_of({"Header", "ReportDate"});
}

} // namespace

Tm33Document parse_tm33(const SourceText& text, Findings& findings) {
    const XmlElement root = parse_xml(text, findings);
    if (!root.name.starts_with("IESTM33") && root.name != "LuminaireOpticalData")
        findings.fail(root.line,
                      "XML with the root " + quoted(root.name)
                          + " (TM-33 has IESTM33-22 or LuminaireOpticalData)",
                      "Another kind of XML file?");
    Tm33Document d;
    read_header(d, root);
    std::size_t emitters = 0;
    for (const XmlElement& e : root.children) {
        if (e.name != "Emitter")
            continue;
        ++emitters;
        if (const XmlElement* const table = find_table(e, findings))
            d.emitters.push_back(read_emitter(e, *table, findings));
        else
            findings.warn(e.line,
                          "an emitter without luminous intensity (radiant, photon or spectral "
                          "data give no candelas; left out)");
    }
    if (d.emitters.empty())
        findings.fail(root.line,
                      std::to_string(emitters)
                          + " emitters, none with luminous intensity (there is no light to "
                            "calculate with)");
    read_sizes(d, root, findings);
    return d;
}

} // namespace isolux
