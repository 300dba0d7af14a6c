#pragma once

#include <array>

#include "isolux/transport/direct_light.h"

namespace isolux {

/// Looks at an opening before its first unit, to see which share of it is visible.
inline constexpr std::uint32_t pilot_rays = 8;
inline constexpr std::uint32_t pilot_replicate = 0xffffU;

/// What the steps of DirectLight share about one receiver: where it is, and which numbers its
/// samples take, Sobol' pairs of their own for every luminaire, purpose and replicate.
struct DirectLight::Task {
    const Receiver& receiver;
    Point3 clear; ///< where its rays start
    std::uint64_t seed = 0;
    std::uint64_t receiver_index = 0;
    std::uint32_t unit = 0;
    std::uint32_t first_replicate = 0;
    std::uint32_t looks = 1;  ///< multiplies the numbers of samples
    double illuminance = 0.0; ///< of the receiver, roughly, lx
    bool keeps_terms = false;

    struct Pair {
        std::uint32_t scramble_u;
        std::uint32_t scramble_v;

        [[nodiscard]] std::array<double, 2> operator()(std::uint32_t index) const noexcept {
            return {sobol_owen(index, 0, scramble_u), sobol_owen(index, 1, scramble_v)};
        }
    };

    /// @param use  0 for points that are looked at, 1 for others
    /// @param chain  0: straight, else the number of the mirror chain + 1
    [[nodiscard]] Pair pair(std::size_t luminaire,
                            std::uint32_t replicate,
                            std::uint32_t use,
                            std::uint32_t chain = 0) const noexcept {
        const auto words = words_of(luminaire, replicate, chain, false);
        return {words[2 * use], words[2 * use + 1]};
    }

    /// Tells in which units something that is not looked at in every unit has its turn.
    [[nodiscard]] Pair turns(std::size_t luminaire,
                             std::uint32_t replicate,
                             std::uint32_t chain = 0) const noexcept {
        const auto words = words_of(luminaire, replicate, chain, true);
        return {words[0], words[1]};
    }

    /// Seven bits of the chain, one for turns and the luminaire in one word; what chains have
    /// beyond that beside the receiver.
    [[nodiscard]] std::array<std::uint32_t, 4> words_of(std::size_t luminaire,
                                                        std::uint32_t replicate,
                                                        std::uint32_t chain,
                                                        bool turns) const noexcept {
        const std::uint32_t code = (chain & 0x7fU) | (turns ? 0x80U : 0U);
        const RandomStream stream(seed, StreamPurpose::direct, replicate);
        return stream.words(receiver_index + (std::uint64_t{chain >> 7U} << 40U),
                            static_cast<std::uint32_t>(luminaire) + (code << 24U));
    }

    void keep(DirectPlan& plan, std::size_t luminaire, const Rgb& light) const {
        plan.known += light;
        if (keeps_terms)
            plan.terms.push_back({static_cast<std::uint32_t>(luminaire), luminance_sum(light)});
    }
};

/// Whether light of a luminaire on its straight way to the image of a receiver can meet the
/// mirror nearest to the luminaire at all.
[[nodiscard]] bool may_reflect(const MirrorImages& images,
                               std::uint32_t mirror,
                               const Luminaire& luminaire,
                               const Point3& image) noexcept;

/// Light of one emission point over a chain of mirrors, lx of the receiver, over its density.
[[nodiscard]] double image_light(const Scene& scene,
                                 const Emission& emission,
                                 const MirrorImages& images,
                                 const std::vector<std::uint32_t>& chain,
                                 const Receiver& receiver,
                                 const Point3& clear,
                                 const OpeningView& view,
                                 const std::array<double, 2>& uv,
                                 std::uint64_t& rays) noexcept;

} // namespace isolux
