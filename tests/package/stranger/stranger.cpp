#include <cmath>
#include <cstdio>
#include <numbers>

#include "isolux/photometry/intensity_distribution.h"

// The flux of a source of 100 cd in every direction is 400 pi lm.
int main() {
    using isolux::degrees;
    const isolux::IntensityDistribution lamp({degrees(0), degrees(360)},
                                             {degrees(0), degrees(60), degrees(180)},
                                             {100, 100, 100, 100, 100, 100});
    const double flux = isolux::in_lumen(lamp.flux());
    std::printf("luminous flux %.9g lm\n", flux);
    return std::abs(flux - 400 * std::numbers::pi) < 1e-9 ? 0 : 1;
}
