#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/base/receiver.h"
#include "isolux/transport/clear_view.h"
#include "isolux/transport/image_light.h"
#include "isolux/transport/light_ledger.h"
#include "isolux/transport/point_randomness.h"

namespace isolux {

class OpeningLight;
struct LightBounds;

/// What of one receiver's direct light is known once and for all, and what has to be sampled in
/// every unit of work.
struct DirectPlan {
    struct Term {
        std::uint32_t luminaire = 0;
        double lux = 0.0;
    };

    /// A luminaire that may be partly hidden, or whose unshadowed light is not known.
    struct Opening {
        std::uint32_t luminaire = 0;
        float visible_share = 1.0F; ///< beta of METHODS eq. (13), from pilot rays
        float spread = 0.0F;        ///< of one look, roughly, lx: METHODS eq. (141)
        bool is_clear = false;      ///< nothing stands in between: no rays needed
        double unshadowed = -1.0;   ///< lx; negative: not known
    };

    /// A part of the light tree from which luminaires are drawn.
    struct Branch {
        std::uint32_t node = 0;
        double bound = 0.0; ///< lx
    };

    bool is_made = false;
    Rgb known;               ///< without noise, lx
    double seen = 0.0;       ///< that and what the pilot rays saw, roughly, lx
    std::vector<Term> terms; ///< `known` by luminaire; kept only when asked for
    std::vector<Opening> openings;
    std::vector<Branch> tail; ///< negligible luminaires, METHODS "Many luminaires"
    double tail_bound = 0.0;  ///< sum over the tail, lx
    std::uint32_t tail_draws = 0;
};

/// How much a receiver is looked after.
struct DirectEffort {
    /// Multiplies the number of samples, a power of two up to DirectLight::most_looks; with a
    /// larger one from some unit on no number is drawn twice.
    std::uint32_t looks = 1;
    /// What the receiver gets by reflections, roughly, lx: looks are spent where they matter
    /// beside all its light.
    double ambient = 0.0;
};

/// Light straight from the luminaires (and by imaged mirrors), METHODS "Direct illuminance".
///
/// A luminaire that nothing hides, or that counts as a point, is one exact number, calculated
/// once. Of other openings a few points are looked at; a control variate (METHODS eq. (13))
/// makes the noise that of the shadow alone. Where luminaires are many, those whose bound is
/// negligible are drawn from the light tree instead of looked at one by one.
class DirectLight {
public:
    static constexpr std::size_t most_looks = 16;

    DirectLight(const Scene& scene, const Emission& emission, const MirrorImages& images);

    /// @param keeps_terms  whether the known light is wanted by luminaire
    [[nodiscard]] DirectPlan plan(const Receiver& receiver,
                                  std::uint64_t receiver_index,
                                  std::uint64_t seed,
                                  bool keeps_terms,
                                  std::uint64_t& rays) const;

    /// Whether every unit and replicate of a plan gives the same value, without a ray.
    [[nodiscard]] bool is_exact(const DirectPlan& plan) const noexcept;

    /// What a receiver in the scene gets by reflections, lx, as far as can be said without a
    /// ray.
    [[nodiscard]] double ambient() const noexcept { return ambient_; }

    /// Samples of one unit and replicate, without those of images. @param ambient  of
    /// DirectEffort
    [[nodiscard]] double samples_of(const DirectPlan& plan, double ambient) const noexcept;

    /// Illuminance of unit `unit` for replicates [first_replicate, first_replicate + number of
    /// totals), lx per channel: adds to the ledger, whose "points" are the replicates.
    void estimate(const Receiver& receiver,
                  const DirectPlan& plan,
                  std::uint64_t receiver_index,
                  std::uint64_t seed,
                  std::uint32_t unit,
                  const DirectEffort& effort,
                  std::uint32_t first_replicate,
                  const LightLedger& ledger,
                  std::uint64_t& rays) const;

    /// One unit of a receiver whose plan is not kept. @param result  one a replicate,
    /// overwritten
    void estimate(const Receiver& receiver,
                  std::uint64_t receiver_index,
                  std::uint64_t seed,
                  std::uint32_t unit,
                  std::uint32_t first_replicate,
                  std::span<Rgb> result,
                  std::uint64_t& rays) const;

private:
    struct Task;

    /// A luminaire that is looked at by itself.
    struct Chosen {
        std::uint32_t luminaire = 0;
        bool is_clear = false; ///< nothing hides any of it; false: not known
    };

    [[nodiscard]] bool is_point_like(std::size_t luminaire, const Point3& at) const noexcept;
    [[nodiscard]] bool is_wholly_visible(std::size_t luminaire, const Point3& clear) const;
    [[nodiscard]] bool is_wholly_visible(const LightBounds& bounds, const Point3& clear) const;
    [[nodiscard]] std::vector<Chosen> choose(const Task& task, DirectPlan& plan) const;
    void plan_points(const Task& task,
                     std::span<const std::uint32_t> luminaires,
                     DirectPlan& plan,
                     std::uint64_t& rays) const;
    void plan_opening(const Task& task,
                      const Chosen& chosen,
                      DirectPlan& plan,
                      std::vector<double>& doubts,
                      std::uint64_t& rays) const;
    void
    know_openings(const Task& task, std::span<const double> doubts, DirectPlan& plan) const;
    [[nodiscard]] double
    know_opening(const Task& task, std::uint32_t luminaire, double negligible) const;
    void plan_images(const Task& task, DirectPlan& plan, std::uint64_t& rays) const;
    void add_opening(const Task& task,
                     const DirectPlan::Opening& opening,
                     const LightLedger& ledger,
                     std::uint64_t& rays) const;
    static double unshadowed(const Task& task,
                             const DirectPlan::Opening& opening,
                             const OpeningLight& light,
                             std::size_t replicate);
    void add_tail(const Task& task,
                  const DirectPlan& plan,
                  const LightLedger& ledger,
                  std::uint64_t& rays) const;
    void add_images(const Task& task, const LightLedger& ledger, std::uint64_t& rays) const;

    const Scene* scene_;
    const Emission* emission_;
    const MirrorImages* images_;
    ClearView view_;
    bool samples_images_ = false; ///< openings are seen in imaged mirrors
    double ambient_ = 0.0;        ///< lx
};

} // namespace isolux
