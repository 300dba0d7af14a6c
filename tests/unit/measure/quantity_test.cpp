#include <gtest/gtest.h>

#include "isolux/measure/quantity.h"

namespace isolux {
namespace {

TEST(Quantity, NamesAndFindsEveryIlluminance) {
    for (const IlluminanceKind kind : {IlluminanceKind::planar,
                                       IlluminanceKind::cylindrical,
                                       IlluminanceKind::semi_cylindrical,
                                       IlluminanceKind::hemispherical,
                                       IlluminanceKind::mean_spherical})
        EXPECT_EQ(find_quantity(quantity_name(kind)), kind);
    EXPECT_EQ(quantity_name(IlluminanceKind::planar), "illuminance");
    EXPECT_EQ(find_quantity("luminance"), std::nullopt);
}

} // namespace
} // namespace isolux
