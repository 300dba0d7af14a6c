#include <array>
#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "isolux/io/project_reader.h"
#include "isolux/io/text_file.h"
#include "isolux/photometry/read_photometry.h"
#include "isolux/scene/luminaire_body.h"

namespace isolux {

namespace {

constexpr NumberRange any_maintenance_factor{0.0, 1.0, true};
constexpr NumberRange any_power{0.0, 1e7, false, " W"};
constexpr NumberRange any_colour_rendering{0.0, 100.0};

std::optional<Lumen> require_flux(const JsonObject& object) {
    const std::optional<double> flux = object.require(
        "flux", [](const JsonNode& node) { return read_number(node, any_flux); });
    return flux ? std::optional(Lumen(*flux)) : std::nullopt;
}

bool read_lambertian(const JsonNode& node, LuminaireType& type) {
    const JsonObject object(node, "a lambertian opening", {"size", "diameter", "flux"});
    const std::optional<Lumen> flux = require_flux(object);
    const std::optional<std::string> form = object.require_one_of({"size", "diameter"});
    if (!form)
        return false;
    const JsonNode extent = *object.find(*form);
    type.body = BodyModel::absorbing;
    if (*form == "size") {
        const std::optional<Point2> size = read_size2(extent);
        if (size)
            type.opening = {
                OpeningShape::rectangle, Metre(size->x), Metre(size->y), Metre(0.0)};
        if (!size || !flux)
            return false;
    } else {
        const std::optional<double> diameter = read_number(extent, any_length);
        if (!diameter || !flux)
            return false;
        type.opening = {OpeningShape::ellipse, Metre(*diameter), Metre(*diameter), Metre(0.0)};
    }
    type.source = LambertianSource{*flux};
    return true;
}

bool read_isotropic(const JsonNode& node, LuminaireType& type) {
    const JsonObject object(node, "an isotropic point", {"flux"});
    const std::optional<Lumen> flux = require_flux(object);
    if (flux)
        type.source = IsotropicSource{*flux};
    return flux.has_value();
}

/// Lets the photometric reader ask for files beside its own (TILT=file).
std::optional<std::string> read_sibling(const std::filesystem::path& beside,
                                        std::string_view name,
                                        ProjectReader& reader) {
    const std::filesystem::path file = std::filesystem::path(name).filename();
    try {
        std::string bytes =
            read_file_bytes(beside.parent_path() / file, FileLimits::photometry);
        reader.add_input(file.generic_string(), bytes);
        return bytes;
    } catch (const InputError&) {
        return std::nullopt; // the photometric reader says what is missing
    }
}

bool read_photometric_file(const JsonObject& object,
                           ProjectReader& reader,
                           LuminaireType& type) {
    const JsonNode node = *object.find("file");
    const std::optional<std::string> file = read_text(node, 4096);
    const std::optional<JsonNode> lamp_set = object.find("lamp_set");
    const std::optional<std::int64_t> set =
        lamp_set ? read_integer(*lamp_set, 1, 20) : std::optional<std::int64_t>(1);
    const std::optional<std::string> bytes =
        file ? reader.read_file(node, FileLimits::photometry) : std::nullopt;
    if (!bytes || !set)
        return false;
    const std::filesystem::path path = reader.path_of(node);
    PhotometryOptions options;
    options.lamp_set = static_cast<std::size_t>(*set - 1);
    if (const std::optional<JsonNode> variant = object.find("variant"))
        options.variant = read_text(*variant, 200).value_or("");
    options.sibling = [&](std::string_view name) { return read_sibling(path, name, reader); };
    try {
        Parsed<LuminairePhotometry> parsed =
            parse_photometry(*bytes, path.generic_string(), options);
        reader.problems.add_notices(std::move(parsed.notices));
        type.file = *file;
        type.opening = parsed.value.opening;
        type.source = std::move(parsed.value);
        return true;
    } catch (const InputError& error) {
        reader.problems.add_errors(error.messages());
        return false;
    }
}

void read_flux_override(const JsonObject& object, LuminaireType& type) {
    const std::optional<JsonNode> node = object.find("flux");
    const std::optional<double> wanted = node ? read_number(*node, any_flux) : std::nullopt;
    const auto* photometry = std::get_if<LuminairePhotometry>(&type.source);
    if (!wanted || photometry == nullptr)
        return;
    const double own = in_lumen(photometry->distribution.flux());
    if (own > 0.0)
        type.flux_scale = *wanted / own;
    else
        node->error("the file's intensities are all zero (no factor makes light of them)");
}

void read_opening_override(const JsonObject& type_object, LuminaireType& type) {
    constexpr std::array<std::string_view, 9> words{"point",
                                                    "rectangle",
                                                    "box",
                                                    "ellipse",
                                                    "vertical cylinder",
                                                    "cylinder along x",
                                                    "cylinder along y",
                                                    "ellipsoid",
                                                    "vertical ellipse"};
    const std::optional<JsonNode> node = type_object.find("opening");
    if (!node)
        return;
    const JsonObject object(*node, "an opening", {"shape", "size"});
    const std::optional<JsonNode> shape_node = object.require("shape");
    const std::optional<std::size_t> choice =
        shape_node ? read_choice(*shape_node, words) : std::nullopt;
    if (!choice)
        return;
    const auto shape = static_cast<OpeningShape>(*choice);
    if (shape == OpeningShape::point) {
        if (const std::optional<JsonNode> size = object.find("size"))
            size->error("a point has no size (leave the key out)");
        type.opening = {};
        return;
    }
    const std::optional<JsonNode> size_node = object.require("size");
    if (!size_node)
        return;
    const bool is_upright = shape == OpeningShape::vertical_ellipse;
    const bool is_flat =
        is_upright || shape == OpeningShape::rectangle || shape == OpeningShape::ellipse;
    const std::string_view form = is_upright ? "[y, z]" : is_flat ? "[x, y]" : "[x, y, z]";
    const std::size_t count = is_flat ? 2 : 3;
    const auto size = read_numbers(*size_node, count, count, form, any_length);
    if (!size)
        return;
    const std::vector<double>& s = *size;
    if (is_upright)
        type.opening = {shape, Metre(0.0), Metre(s[0]), Metre(s[1])};
    else
        type.opening = {shape, Metre(s[0]), Metre(s[1]), Metre(is_flat ? 0.0 : s[2])};
}

void read_body(const JsonObject& object, LuminaireType& type) {
    const std::optional<JsonNode> node = object.find("body");
    if (!node)
        return;
    constexpr std::array<std::string_view, 2> words{"none", "absorbing"};
    const std::optional<std::size_t> choice = read_choice(*node, words);
    if (!choice)
        return;
    type.body = static_cast<BodyModel>(*choice);
    if (type.body == BodyModel::absorbing && type.opening.shape == OpeningShape::point)
        node->error("a luminaire with a point for an opening has no body (it has no size)",
                    "Give it an \"opening\"?");
}

void read_colour(const JsonObject& object, LuminaireType& type) {
    const std::optional<JsonNode> node = object.find("colour");
    const auto rgb =
        node ? read_numbers(*node, 3, 3, "[red, green, blue]", {0.0, 1e6}) : std::nullopt;
    if (!rgb)
        return;
    const Rgb colour{(*rgb)[0], (*rgb)[1], (*rgb)[2]};
    const double sum = luminance_sum(colour);
    if (sum > 0.0)
        type.colour = 1.0 / sum * colour;
    else
        node->error("the colour is black (a luminaire of that colour gives no light)");
}

/// The source and everything that only files have. False if the source could not be read.
bool read_source(const JsonObject& object, ProjectReader& reader, LuminaireType& type) {
    const std::optional<std::string> form =
        object.require_one_of({"file", "lambertian", "isotropic"});
    if (!form)
        return false;
    if (*form == "file") {
        if (!read_photometric_file(object, reader, type))
            return false;
        read_flux_override(object, type);
        read_opening_override(object, type);
        return true;
    }
    object.exclude(*form, {"flux", "lamp_set", "variant", "opening"});
    const JsonNode node = *object.find(*form);
    return *form == "lambertian" ? read_lambertian(node, type) : read_isotropic(node, type);
}

/// Ra from a file's words: a number, or a group of the older colour rendering classes.
std::optional<double> colour_rendering_of(const std::string& text) {
    constexpr std::array<std::pair<std::string_view, double>, 6> groups{
        {{"1A", 90.0}, {"1B", 80.0}, {"2A", 70.0}, {"2B", 60.0}, {"3", 40.0}, {"4", 20.0}}};
    for (const auto& [group, least] : groups)
        if (text == group)
            return least;
    const std::size_t digit = text.find_first_of("0123456789");
    if (digit == std::string::npos)
        return std::nullopt;
    double value = 0.0;
    std::from_chars(text.data() + digit, text.data() + text.size(), value);
    return value >= 20.0 && value <= 100.0 ? std::optional(value) : std::nullopt;
}

ScheduleEntry make_schedule_entry(const JsonObject& object,
                                  const LuminaireType& type,
                                  const MaintenanceFactor& maintenance) {
    ScheduleEntry e;
    e.type = type.name;
    e.file = type.file;
    e.flux = in_lumen(luminous_flux(type));
    e.maintenance = maintenance;
    if (const auto* photometry = std::get_if<LuminairePhotometry>(&type.source)) {
        e.manufacturer = photometry->manufacturer;
        e.product = photometry->name;
        if (photometry->input_watts > 0.0)
            e.watts = photometry->input_watts;
        if (photometry->lamp_set < photometry->lamp_sets.size())
            e.colour_rendering = colour_rendering_of(
                photometry->lamp_sets[photometry->lamp_set].colour_rendering);
    }
    if (const std::optional<JsonNode> node = object.find("power"))
        e.watts = read_number(*node, any_power);
    if (const std::optional<JsonNode> node = object.find("colour_rendering"))
        e.colour_rendering = read_number(*node, any_colour_rendering);
    return e;
}

LuminaireTypeEntry
read_type(const JsonNode& node, const std::string& name, ProjectReader& reader) {
    const JsonObject object(node,
                            "a luminaire type",
                            {"file",
                             "lambertian",
                             "isotropic",
                             "flux",
                             "maintenance_factor",
                             "dimming",
                             "lamp_set",
                             "variant",
                             "opening",
                             "body",
                             "colour",
                             "align_length_axis",
                             "power",
                             "colour_rendering",
                             "glare_factor"});
    LuminaireType type;
    type.name = name;
    type.source = IsotropicSource{};
    LuminaireTypeEntry entry;
    MaintenanceFactor maintenance = reader.maintenance;
    if (const std::optional<JsonNode> own = object.find("maintenance_factor"))
        maintenance = read_maintenance(*own).value_or(maintenance);
    reader.states_maintenance |= object.has("maintenance_factor");
    entry.scale = maintenance.value * object.number("dimming", any_share, 1.0);
    read_colour(object, type);
    const bool align = object.boolean("align_length_axis", false);
    if (!read_source(object, reader, type))
        return entry;
    read_body(object, type);
    const std::optional<LongSide> long_side = find_long_side(type);
    entry.turn_length_to_x = align && long_side && long_side->is_along_y;
    if (align)
        reader.project.length_aligned.push_back(name);
    entry.id = LuminaireTypeId(reader.project.scene.luminaire_types.size());
    reader.project.glare_factors.push_back(object.number("glare_factor", {1.0, 100.0}, 1.0));
    reader.project.schedule.push_back(make_schedule_entry(object, type, maintenance));
    reader.project.scene.luminaire_types.push_back(std::move(type));
    return entry;
}

} // namespace

std::optional<MaintenanceFactor> read_maintenance(const JsonNode& node) {
    MaintenanceFactor m;
    if (!node.is(JsonValue::Kind::object)) {
        const std::optional<double> value = read_number(node, any_maintenance_factor);
        m.value = value.value_or(1.0);
        return value ? std::optional(m) : std::nullopt;
    }
    const JsonObject object(node, "a maintenance factor", {"LLMF", "LSF", "LMF", "RSMF"});
    m.has_parts = true;
    m.lamp_flux = object.number("LLMF", any_maintenance_factor, 1.0);
    m.lamp_survival = object.number("LSF", any_maintenance_factor, 1.0);
    m.luminaire = object.number("LMF", any_maintenance_factor, 1.0);
    m.room_surface = object.number("RSMF", any_maintenance_factor, 1.0);
    m.value = m.lamp_flux * m.lamp_survival * m.luminaire * m.room_surface; // METHODS eq. (107)
    return m;
}

void read_luminaire_types(const JsonNode& node, ProjectReader& reader) {
    if (!node.is(JsonValue::Kind::object)) {
        node.error(
            fmt::format("luminaire_types is an object {{...}} with a member for each type "
                        "(found {})",
                        kind_in_words(node.value())));
        return;
    }
    if (node.value().members.empty())
        node.error("there are no luminaire types (a project needs at least one)");
    check_repeated_keys(node);
    for (const JsonMember& member : node.value().members)
        reader.luminaire_types.emplace(
            member.key, read_type(node.member(member.key, member.value), member.key, reader));
    if (!reader.states_maintenance)
        reader.problems.notice("",
                               "no maintenance factor is given (1 is used: the results are "
                               "initial values)",
                               "Set \"maintenance_factor\"?");
}

} // namespace isolux
