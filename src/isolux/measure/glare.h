#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/base/receiver.h"

/// Discomfort glare at observers: UGR of CIE 117 indoors, GR of CIE 112 outdoors. METHODS
/// "Glare".
namespace isolux {

enum class GlareScale {
    unified, ///< UGR
    outdoor  ///< GR
};

/// Which sources of light count.
enum class GlareSources {
    in_front, ///< every one in front of the eye
    in_table  ///< only those with a place in the table of position indices, H/R <= 1.9
};

/// Observers that are rated together; the worst of them speaks for all.
struct ObserverGroup {
    std::string name;
    GlareScale scale = GlareScale::unified;
    GlareSources sources = GlareSources::in_front;
    std::vector<SightLine> sight_lines;
    std::string room;                  ///< where they are; empty outdoors
    std::optional<std::size_t> ground; ///< GR: surface of the mean horizontal illuminance
    double ground_reflectance = 0.2;   ///< GR
};

/// What one observer has to put up with.
struct GlareRating {
    Estimate value;          ///< no samples: there is none, see `reason`
    Estimate background;     ///< cd/m2: Lb of UGR, Lve of GR
    double source_sum = 0.0; ///< UGR: sum of L2 w/p2, cd2/m4; GR: Lvl, cd/m2
    std::size_t sources = 0; ///< luminaires that count
    std::string reason;      ///< why there is no value
};

struct ObserverGroupResult {
    ObserverGroup group;
    std::vector<GlareRating> ratings; ///< as group.sight_lines
    std::optional<std::size_t> worst; ///< the highest rating
    std::optional<double> by_table;   ///< UGR by the table method, for comparison
    std::string table_note; ///< what the table method assumed, or why it does not apply
};

/// A piece of a luminous opening as an eye sees it.
struct GlareSourcePart {
    double luminance = 0.0;   ///< cd/m2 towards the eye
    double solid_angle = 0.0; ///< sr, of what is visible
    UnitVector3 towards;      ///< from the eye to its centre
};

/// Guth's position index of what is seen along `towards`, METHODS "UGR table". The vertical
/// plane of the observer holds the line of sight and the world's vertical; for an eye that
/// looks straight up or down, world y.
[[nodiscard]] double position_index(const UnitVector3& sight,
                                    const UnitVector3& towards) noexcept;

/// Whether the source has a place in the table of position indices: in front of the eye and no
/// higher above the line of sight than 1.9 times its distance along it.
[[nodiscard]] bool is_in_position_table(const UnitVector3& sight,
                                        const UnitVector3& towards) noexcept;

/// Sum of L2 w/p2 over the parts in front of the eye, cd2/m4.
[[nodiscard]] double glare_sum(const UnitVector3& sight,
                               std::span<const GlareSourcePart> parts,
                               GlareSources which) noexcept;

/// UGR = 8 log10(0.25 pi S / Ei), METHODS eq. (109), with the jackknife over replicates.
/// @param source_sum  S, cd2/m4
/// @param indirect    replicates of the indirect illuminance at the eye on the plane it faces,
/// lx
[[nodiscard]] Estimate unified_glare_rating(double source_sum,
                                            std::span<const double> indirect);

/// GR = 27 + 24 log10(Lvl / Lve^0.9), METHODS eq. (111).
/// @param background  replicates of Lve, cd/m2
[[nodiscard]] Estimate outdoor_glare_rating(double veil, std::span<const double> background);

} // namespace isolux
