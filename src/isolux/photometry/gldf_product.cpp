#include "isolux/photometry/gldf_product.h"

#include <algorithm>

#include "isolux/photometry/file_number.h"

namespace isolux {

namespace {

class ProductReader {
public:
    ProductReader(const XmlElement& root, Findings& findings)
        : root_(root), findings_(findings) {}

    std::vector<GldfLight> read_lights(const std::string& variant) {
        if (const XmlElement* const chosen = choose_variant(variant))
            if (const XmlElement* const geometry = chosen->find("Geometry"))
                add_references(*geometry);
        const XmlElement* const emitters = root_.find_path({"GeneralDefinitions", "Emitters"});
        if (lights_.empty() && emitters != nullptr && !emitters->children.empty()) {
            findings_.note(emitters->line,
                           "the variant refers to no emitter (the first one is taken)");
            add_emitter(emitters->children.front());
        }
        if (lights_.empty())
            take_only_photometry();
        if (lights_.size() > 1)
            findings_.note(lights_.front().line,
                           std::to_string(lights_.size())
                               + " emitters (all shine at full power, from one point; their "
                                 "light is added up)");
        return std::move(lights_);
    }

private:
    const XmlElement* choose_variant(const std::string& wanted) {
        const XmlElement* const variants = root_.find_path({"ProductDefinitions", "Variants"});
        if (variants == nullptr || variants->children.empty()) {
            if (!wanted.empty())
                findings_.fail(root_.line,
                               "variant " + quoted(wanted) + " asked for (there are none)");
            return nullptr;
        }
        const auto& all = variants->children;
        if (wanted.empty()) {
            if (all.size() > 1)
                findings_.note(variants->line,
                               std::to_string(all.size()) + " variants (the first, "
                                   + quoted(all.front().attribute("id")) + ", is taken)",
                               "Choose another by its id?");
            return &all.front();
        }
        for (const XmlElement& v : all)
            if (v.attribute("id") == wanted)
                return &v;
        const auto number = parse_number(wanted);
        if (number && is_whole(*number) && *number >= 1.0
            && *number <= static_cast<double>(all.size()))
            return &all[static_cast<std::size_t>(*number) - 1];
        findings_.fail(variants->line,
                       "variant " + quoted(wanted) + " asked for (there are "
                           + std::to_string(all.size()) + ", the first is "
                           + quoted(all.front().attribute("id")) + ")");
    }

    /// Every element below that names an emitter, in the order of the file.
    void add_references(const XmlElement& below) {
        for (const XmlElement& e : below.children) {
            if (const std::string_view id = e.attribute("emitterId"); !id.empty())
                add_emitter(find("Emitters", id, e));
            add_references(e);
        }
    }

    const XmlElement& find(std::string_view list, std::string_view id, const XmlElement& from) {
        if (const XmlElement* const all = root_.find_path({"GeneralDefinitions", list}))
            for (const XmlElement& e : all->children)
                if (e.attribute("id") == id)
                    return e;
        findings_.fail(from.line,
                       from.name + " names " + quoted(id) + ", which " + std::string(list)
                           + " does not have (the reference leads nowhere)");
    }

    void add_emitter(const XmlElement& emitter) {
        const XmlElement* part = nullptr;
        std::size_t parts = 0;
        for (const XmlElement& e : emitter.children) {
            if (!e.name.ends_with("LightEmitter"))
                continue;
            ++parts;
            const bool is_for_emergency = e.attribute("emergencyBehaviour") == "EmergencyOnly";
            if (part == nullptr && !is_for_emergency)
                part = &e;
        }
        if (part == nullptr) {
            findings_.note(emitter.line,
                           "emitter " + quoted(emitter.attribute("id"))
                               + " has no light for everyday use (left out)");
            return;
        }
        if (parts > 1)
            findings_.note(
                emitter.line,
                "emitter " + quoted(emitter.attribute("id")) + " has " + std::to_string(parts)
                    + " parts (the first that is not for emergencies only is taken)");
        check_rotation(*part);
        if (part->name == "MultiChannelLightEmitter")
            add_channels(*part);
        else if (const XmlElement* const reference = part->find("PhotometryReference"))
            add_photometry(*reference, part->find("RatedLuminousFlux"));
        else
            findings_.fail(part->line,
                           part->name + " without a photometry (its light is unknown)");
    }

    void check_rotation(const XmlElement& part) {
        const XmlElement* const rotation = part.find("Rotation");
        if (rotation == nullptr)
            return;
        for (const XmlElement& axis : rotation->children)
            if (parse_number(trim(axis.text)).value_or(1.0) != 0.0) {
                findings_.warn(rotation->line,
                               "the emitter is rotated (rotations within the luminaire are not "
                               "applied)",
                               "Turn the luminaire in the project?");
                return;
            }
    }

    void add_channels(const XmlElement& part) {
        const XmlElement* const reference = part.find("LightSourceReference");
        const std::string_view id = reference != nullptr
                                        ? reference->attribute("multiChannelLightSourceId")
                                        : std::string_view{};
        if (id.empty())
            findings_.fail(part.line, part.name + " without a light source (no light follows)");
        const XmlElement* const channels =
            find("LightSources", id, *reference).find("Channels");
        if (channels == nullptr)
            findings_.fail(part.line, "light source " + quoted(id) + " has no channels");
        for (const XmlElement& channel : channels->children)
            if (const XmlElement* const photometry = channel.find("PhotometryReference"))
                add_photometry(*photometry, channel.find("RatedLuminousFlux"));
    }

    void add_photometry(const XmlElement& reference, const XmlElement* flux) {
        add_file(find("Photometries", reference.attribute("photometryId"), reference));
        if (flux == nullptr)
            return;
        lights_.back().rated_flux = parse_number(trim(flux->text));
        lights_.back().flux_line = flux->line;
    }

    void add_file(const XmlElement& photometry) {
        const XmlElement* const reference = photometry.find("PhotometryFileReference");
        if (reference == nullptr)
            findings_.fail(photometry.line,
                           "photometry " + quoted(photometry.attribute("id"))
                               + " names no file (descriptions alone give no light "
                                 "distribution)");
        const XmlElement& file = find("Files", reference->attribute("fileId"), *reference);
        constexpr std::size_t most_lights = 64;
        if (lights_.size() >= most_lights)
            findings_.fail(file.line, "more than 64 emitters (no luminaire needs them)");
        if (file.attribute("type") == "url")
            findings_.fail(file.line,
                           "the photometry is at " + quoted(trim(file.text))
                               + " (nothing is fetched from the net)",
                           "Download it and use it in place of the container");
        lights_.push_back({std::string(trim(file.text)), file.line, std::nullopt, 1});
    }

    /// Products without emitters: their first photometry.
    void take_only_photometry() {
        const XmlElement* const all = root_.find_path({"GeneralDefinitions", "Photometries"});
        if (all == nullptr || all->children.empty())
            findings_.fail(
                root_.line,
                "the product has no photometry (there is no light to calculate with)");
        findings_.note(all->line, "no emitter shines (the first photometry is taken)");
        add_file(all->children.front());
    }

    const XmlElement& root_;
    Findings& findings_;
    std::vector<GldfLight> lights_;
};

} // namespace

GldfProduct
read_gldf_product(const XmlElement& root, const std::string& variant, Findings& findings) {
    if (root.name != "Root")
        findings.fail(root.line,
                      "the root is " + quoted(root.name) + " (GLDF products have Root)");
    GldfProduct product;
    product.manufacturer = root.text_of({"Header", "Manufacturer"});
    product.name = root.text_of({"ProductDefinitions", "ProductMetaData", "Name", "Locale"});
    product.number =
        root.text_of({"ProductDefinitions", "ProductMetaData", "ProductNumber", "Locale"});
    product.lights = ProductReader(root, findings).read_lights(variant);
    return product;
}

} // namespace isolux
