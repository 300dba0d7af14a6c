#pragma once

#include <string>
#include <vector>

#include "isolux/photometry/luminaire_photometry.h"

/// A sample luminaire: its file name without extension and its light.
struct Sample {
    std::string file;
    isolux::LuminairePhotometry luminaire;
};

/// All sample luminaires, in the order of the README's table.
[[nodiscard]] std::vector<Sample> make_catalogue();
