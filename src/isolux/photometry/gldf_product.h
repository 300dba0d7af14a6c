#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/xml_tree.h"

namespace isolux {

/// A photometric file that shines in the chosen variant.
struct GldfLight {
    std::string file_name;            ///< as product.xml has it
    std::size_t line = 1;             ///< of the File element
    std::optional<double> rated_flux; ///< lm, of the emitter
    std::size_t flux_line = 1;
};

/// What product.xml says about one variant.
struct GldfProduct {
    std::string manufacturer;
    std::string name;
    std::string number;
    std::vector<GldfLight> lights;
};

/// @param variant  id or number from 1; empty: the first
/// @throws InputError  a reference that leads nowhere, no photometry, no such variant
[[nodiscard]] GldfProduct
read_gldf_product(const XmlElement& root, const std::string& variant, Findings& findings);

} // namespace isolux
